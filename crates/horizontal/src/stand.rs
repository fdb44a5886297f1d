//! Stability: the existence of compressive forces that balance a pile.

use cannonpile::Pile;
use cannonpile::engine::bug;
use core::fmt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::Error;
use crate::beginning::{beginning, certified, certified_down_to};
use crate::certificate::{Certificate, Claim};
use crate::exact_simplex::{Program, Solution, solve};
use crate::network::{MAX_EQUATIONS, Network};
use crate::program::accepted;
use crate::run::{run_starts, too_long_run};

/// The first truncated pile that is tested has this many layers above its fixed floor, unless the first failure is
/// lower.
const FIRST: i128 = 6;

/// The kind of proof that decides whether a pile is stable at a = R.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::census;
/// use cannonpile_horizontal::census::DecidedBy;
///
/// let entries: Result<Vec<_>, _> = census::under_one_sphere(6, false)?.collect();
/// let entries = entries?;
/// let horizontal = entries.iter().filter(|entry| entry.decided_by == DecidedBy::Horizontal);
/// let stackings: Vec<_> = horizontal.map(|entry| entry.pile.shape().stacking().to_string()).collect();
/// // Of these only HCP needs horizontal contacts.
/// assert_eq!(stackings, ["+-+-+"]);
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DecidedBy {
    /// Stable without horizontal forces: no sloping contact is tensile.
    Sloping,
    /// Stable with the horizontal forces of the certificate.
    Horizontal,
    /// Unstable: a run before a sign change is too long, as the balance of the spheres of an edge shows (lemma 1 of
    /// [`census`](crate::census)).
    Run,
    /// Unstable: the field of the certificate is a Farkas certificate, found by a linear program.
    Work,
}

impl DecidedBy {
    /// Returns `sloping`, `horizontal`, `run` or `work`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_horizontal::census::DecidedBy;
    ///
    /// assert_eq!(DecidedBy::Run.name(), "run");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sloping => "sloping",
            Self::Horizontal => "horizontal",
            Self::Run => "run",
            Self::Work => "work",
        }
    }
}

impl fmt::Display for DecidedBy {
    /// Writes `sloping`, `horizontal`, `run` or `work`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Returns a certificate that the pile is stable or unstable at a = R, with horizontal contacts.
///
/// * A run that is too long before a sign change is detected first ([`census`](crate::census)).
/// * If the pile is stable with sloping contacts alone, the cost is that of [`standing`](Pile::standing).
/// * Below the last sign change all forces increase, so those layers need no test. Under gravity or a load that leans far,
///   some sphere has a negative increment, and all layers are tested.
/// * The layers above it are tested as truncated piles, from the shortest on. A pile is stable only if all of its
///   truncated piles are.
/// * For a pile of more than 10⁵ spheres the certificate is about its first layers, for the same reasons. Its
///   [`pile`](Certificate::pile) has only these layers.
///
/// Horizontal forces that were assigned to the pile are ignored.
///
/// # Errors
/// * [`NoHorizontalContacts`](cannonpile::Error::NoHorizontalContacts) if neighbours in a layer do not touch.
/// * [`TooLarge`](cannonpile::Error::TooLarge) if the program has more than 15,000 equations.
/// * The errors of [`standing`](Pile::standing).
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Region;
/// use cannonpile_horizontal::certificate::Claim;
/// use cannonpile_horizontal::equilibrium;
///
/// // Six layers of HCP are unstable without horizontal contacts.
/// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
/// assert_eq!(pile.first_failure()?, Some(4));
/// let certificate = equilibrium(&pile)?;
/// assert_eq!(certificate.claim, Claim::Stands);
/// assert_eq!(certificate.check(), Ok(()));
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
pub fn equilibrium(pile: &Pile) -> Result<Certificate, Error> {
    decided(pile).map(|(certificate, _)| certificate)
}

/// Decides stability, and returns the certificate and the kind of proof.
pub(crate) fn decided(pile: &Pile) -> Result<(Certificate, DecidedBy), Error> {
    pile.check_horizontal()?;
    decided_bare(&pile.clone().without_horizontal_forces())
}

fn decided_bare(pile: &Pile) -> Result<(Certificate, DecidedBy), Error> {
    if let Some(certificate) = too_long_run(pile)? {
        return Ok((certificate, DecidedBy::Run));
    }
    // The layer below the last sign change can be taken as fixed, if the forces below it grow.
    let held = run_starts(pile.shape()).last().map(|from| from + 1);
    let held = if pile.forces_grow() {
        held
    } else {
        held.map(|_| pile.layers() - 1)
    };
    let Some(failure) = pile.first_failure()? else {
        let pile = match held {
            Some(layer) => certified_down_to(pile, layer)?,
            None => pile.clone(),
        };
        return Ok((certified(pile, Claim::Stands), DecidedBy::Sloping));
    };
    let last = held.ok_or_else(|| bug("an unstable pile has a step"))?;
    let mut floor = (failure + 1).max(FIRST).min(last);
    loop {
        let certificate = equilibrium_above(pile, floor, floor == last)?;
        match certificate.claim {
            Claim::CannotStand => return Ok((certificate, DecidedBy::Work)),
            _ if floor == last => return Ok((certificate, DecidedBy::Horizontal)),
            _ => floor = (floor + floor / 2).min(last),
        }
    }
}

/// Returns `true` if a certificate proves that the pile is unstable, and `false` if one proves that it is stable.
pub(crate) fn cannot_stand(pile: &Pile) -> Result<bool, Error> {
    Ok(equilibrium(pile)?.claim == Claim::CannotStand)
}

/// Decides the stability of the layers above `floor`, whose spheres are taken as fixed.
///
/// An exact linear program minimises the sum of tensile forces. If it is zero, the layers are stable. Otherwise the dual
/// solution is a Farkas certificate. `is_whole` says that the pile below has no further sign change, so the result holds for
/// all of it.
fn equilibrium_above(pile: &Pile, floor: i128, is_whole: bool) -> Result<Certificate, Error> {
    let network = Network::above(pile, floor, MAX_EQUATIONS)?;
    let (mut columns, all) = (network.columns.clone(), network.columns.len());
    let mut tension = network.columns[..network.weights.len()].to_vec();
    for (_, coefficient) in tension.iter_mut().flatten() {
        *coefficient = -coefficient.clone();
    }
    columns.append(&mut tension);
    // In floats compressive forces have slight costs. So the optimum is a vertex, and its positive forces are a basis.
    let slight = |unknown: usize| BigRational::new((64 + 37 * unknown % 64).into(), 1280.into());
    let mut cost: Vec<BigRational> = (0..all).map(slight).collect();
    cost.resize(columns.len(), BigRational::one());
    let mut program = Program {
        columns: columns.into(),
        sums: network.weights.clone(),
        cost,
    };
    let suggested = program.suggested();
    program.cost[..all].fill(BigRational::zero());
    let Solution::Optimal {
        unknowns,
        multipliers,
    } = solve(&program, suggested)?
    else {
        return Err(bug("tensile forces balance every pile").into());
    };
    // An unstable beginning makes the whole pile unstable. A stable one proves nothing about the layers below it.
    accepted(
        if unknowns[all..].iter().any(|tension| !tension.is_zero()) {
            Certificate {
                field: network.field(&multipliers),
                ..certified(certified_down_to(pile, floor)?, Claim::CannotStand)
            }
        } else {
            let pile = if is_whole {
                certified_down_to(pile, floor)?
            } else {
                beginning(pile, floor)?
            };
            Certificate {
                horizontal: network.horizontal(&unknowns),
                ..certified(pile, Claim::Stands)
            }
        },
    )
}
