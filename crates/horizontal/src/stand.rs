//! Whether there are forces that only push.

use cannonpile::Pile;
use cannonpile::engine::bug;
use core::fmt;
use core::iter::repeat_n;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::Error;
use crate::beginning::{beginning, certified, certified_down_to};
use crate::certificate::{Certificate, Claim};
use crate::network::{Column, MOST_EQUATIONS, Network};
use crate::program::{Aim, Closeness, Program, accepted};
use crate::run::{run_starts, too_long_run};

/// The layers above the one that is held in the first beginning that is looked at, if the pile fails no further down.
const FIRST: i128 = 6;

/// What all pulls may come to in floats, of weights of order 1, if there are none.
const NO_PULL: f64 = 1e-5;

/// What decides whether a pile stands at a = R.
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
/// // Only HCP needs them.
/// assert_eq!(stackings, ["+-+-+"]);
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DecidedBy {
    /// It stands without horizontal contacts: no force along α, β, γ pulls.
    Sloping,
    /// It stands by the forces of horizontal contacts that the certificate has.
    Horizontal,
    /// It cannot stand: a run is too long before a change of sign, by the spheres of an edge (module documentation, 1).
    Run,
    /// It cannot stand: the field of the certificate would do work for nothing.
    Work,
}

impl DecidedBy {
    /// `sloping`, `horizontal`, `run`, `work`.
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
    /// `sloping`, `horizontal`, `run`, `work`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Returns a certificate that the pile stands at a = R, with horizontal contacts, or that it cannot.
///
/// A run that is too long before a change of sign is found at once ([`census`](crate::census)). Where the
/// sloping contacts alone bear it nothing is computed but [`standing`](Pile::standing). Below the last
/// change of sign nothing has to be looked at, since there every force only grows; and of what is above it first the
/// beginnings, since a pile stands only if each of them does. Of a pile of more than 10⁵ spheres the certificate is
/// that of its first layers, by the same reasons: its [`pile`](Certificate::pile) are these.
///
/// The horizontal forces that a pile was given are left out.
///
/// # Errors
/// [`NoHorizontalContacts`](cannonpile::Error::NoHorizontalContacts); [`TooLarge`](cannonpile::Error::TooLarge) if more
/// than 15,000 equations would have to be solved; [`Error::NotSolved`] if they are, in floats, and what comes of it is no
/// proof; as for [`standing`](Pile::standing).
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Region;
/// use cannonpile_horizontal::certificate::Claim;
/// use cannonpile_horizontal::equilibrium;
///
/// // Six layers of HCP do not stand without horizontal contacts.
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

/// Whether it is in equilibrium, with the proof, and what decides it.
pub(crate) fn decided(pile: &Pile) -> Result<(Certificate, DecidedBy), Error> {
    pile.check_horizontal()?;
    decided_bare(&pile.clone().without_horizontal_forces())
}

fn decided_bare(pile: &Pile) -> Result<(Certificate, DecidedBy), Error> {
    if let Some(certificate) = too_long_run(pile)? {
        return Ok((certificate, DecidedBy::Run));
    }
    // Held is what lies under the last change of sign.
    let held = run_starts(pile.shape()).last().map(|from| from + 1);
    let Some(failure) = pile.first_failure()? else {
        let pile = match held {
            Some(layer) => certified_down_to(pile, layer)?,
            None => pile.clone(),
        };
        return Ok((certified(pile, Claim::Stands), DecidedBy::Sloping));
    };
    let last = held.ok_or_else(|| bug("a pile that fails has a step"))?;
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

/// Whether it is known that no forces balance it which only push.
pub(crate) fn cannot_stand(pile: &Pile) -> bool {
    let certificate = equilibrium(pile);
    certificate.is_ok_and(|certificate| certificate.claim == Claim::CannotStand)
}

/// Why a program over its forces, of so many equations, has no solution.
pub(crate) fn unsolved(pile: &Pile, equations: usize) -> Error {
    if cannot_stand(pile) {
        Error::CannotStand
    } else {
        Error::NotSolved { equations }
    }
}

/// Of the layers above one that is held: the least sum of all pulls is 0, or a field proves that it is not. Below
/// them forces only grow, if they are the whole.
fn equilibrium_above(pile: &Pile, floor: i128, is_whole: bool) -> Result<Certificate, Error> {
    let network = Network::above(pile, floor, MOST_EQUATIONS)?;
    let (equations, unknowns) = (network.weights.len(), network.columns.len());
    let not_solved = || Error::NotSolved { equations };
    let pulls = network.columns[..equations].iter();
    let pulls = pulls.map(|column| {
        column
            .iter()
            .map(|(equation, c)| (*equation, -c.clone()))
            .collect()
    });
    let cost =
        repeat_n(BigRational::zero(), unknowns).chain(repeat_n(BigRational::one(), equations));
    let with_pulls: Vec<Column> = network.columns.iter().cloned().chain(pulls).collect();
    let program = Program {
        columns: with_pulls.as_slice().into(),
        sums: network.weights.clone(),
        aim: Aim::Cost(cost.collect()),
    };
    let (program, scale) = program.scaled();
    let mut guess = program.guess(Closeness::Tight).ok_or_else(not_solved)?;
    // What is said is checked, whatever floats say.
    let stands = guess.unknowns[unknowns..].iter().sum::<f64>() < NO_PULL;
    // What cannot stand cannot with more below it; what stands does so as far as it was looked at.
    let pile = if is_whole || !stands {
        certified_down_to(pile, floor)?
    } else {
        beginning(pile, floor)?
    };
    let certificate = if stands {
        // Without the pulls.
        guess.unknowns.truncate(unknowns);
        guess.positive.truncate(unknowns);
        program.exact_unknowns(&guess).map(|forces| {
            let forces = network.horizontal(&forces);
            Certificate {
                horizontal: forces
                    .map(|(contact, force)| (contact, force * &scale))
                    .collect(),
                ..certified(pile, Claim::Stands)
            }
        })
    } else {
        program
            .exact_multipliers(&guess)
            .map(|multipliers| Certificate {
                field: network.field(&multipliers).collect(),
                ..certified(pile, Claim::CannotStand)
            })
    };
    accepted(certificate.ok_or_else(not_solved)?, not_solved)
}

#[cfg(test)]
mod tests {
    use super::*;
    use cannonpile::lattice::Region;

    #[test]
    fn what_has_no_solution_cannot_stand_or_was_not_solved() {
        let unsolved = |stacking: &str| {
            let pile = Pile::under(Region::SITE, stacking.parse().unwrap()).unwrap();
            unsolved(&pile, 7)
        };
        assert_eq!(unsolved("+++"), Error::NotSolved { equations: 7 });
        // A run of five steps before a change of sign.
        assert_eq!(unsolved("+++++-"), Error::CannotStand);
    }
}
