//! The state of springs that only push.

use cannonpile::Pile;
use cannonpile::engine::{bug, check_interrupt};
use cannonpile::lattice::{Dimension, Site, count};
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

use crate::certificate::{Certificate, Claim};
use crate::network::{MOST_CERTIFIED, MOST_EQUATIONS, Network};
use crate::program::{Aim, Closeness, Program, accepted, of_formulas};
use crate::springs::{Springs, State};
use crate::stand::cannot_stand;
use crate::straight::factor_of;
use crate::{Error, formula};

/// The forces of a pile at a = R whose contacts are springs that only push: of all forces that balance it those of least
/// energy, Σ f²/2κ + Σ X²/2κ′, and there is only one such state.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Region;
/// use cannonpile_horizontal::elastic;
/// use num_rational::BigRational;
///
/// let equal = BigRational::from_integer(1.into());
/// // The paper's forces: horizontal contacts open.
/// let straight = elastic(&Pile::triangular(100)?, &equal)?;
/// assert_eq!(straight.pile().horizontal_forces().len(), 0);
///
/// // Six layers of HCP stand only with them.
/// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
/// let elastic = elastic(&pile, &equal)?;
/// assert!(pile.first_failure()?.is_some() && elastic.pile().first_failure()?.is_none());
/// assert_eq!(elastic.certificate().map(|c| c.check()), Some(Ok(())));
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ElasticState {
    pile: Pile,
    certificate: Option<Certificate>,
}

/// Returns the elastic state at a = R, κ′/κ being the stiffness of horizontal contacts over that of sloping ones.
///
/// Straight piles of equal weights bear what they bear without horizontal contacts
/// ([`paper`](cannonpile::paper#elastic-state)), of any number of layers. For others it is tested whether they do, in time
/// proportional to the number of spheres; if not, a quadratic program in floats guesses which contacts push, and from
/// there an active-set method in rationals goes on to those that do (Goldfarb & Idnani 1983), which ends whatever the
/// weights are. The horizontal forces that a pile was given are left out of it.
///
/// # Errors
/// [`NotPositive`](cannonpile::Error::NotPositive) of a stiffness ratio;
/// [`NoHorizontalContacts`](cannonpile::Error::NoHorizontalContacts); [`Error::CannotStand`];
/// [`TooLarge`](cannonpile::Error::TooLarge); as for [`standing`](Pile::standing).
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::{Direction, Site};
/// use cannonpile_horizontal::elastic;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(10)?;
/// let elastic = elastic(&pile, &BigRational::new(2.into(), 7.into()))?;
/// let forces = elastic.pile().forces::<BigRational>();
/// assert_eq!(forces.contact(Site { i: 1, j: 2, k: 5 }, Direction::Alpha)?.to_string(), "3");
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
pub fn elastic(pile: &Pile, stiffness_ratio: &BigRational) -> Result<ElasticState, Error> {
    let mut pile = pile.clone().without_horizontal_forces();
    pile.check_horizontal()?;
    if !stiffness_ratio.is_positive() {
        let given = stiffness_ratio.clone();
        return Err(cannonpile::Error::not_positive("stiffness-ratio", given).into());
    }
    let certificate = match certified(&pile, stiffness_ratio) {
        Err(Error::Core(cannonpile::Error::TooLarge { .. }))
            if pile.shape().stacking().is_straight() && pile.is_uniform() =>
        {
            None
        }
        // What fails early is known to, however large the pile is.
        Err(Error::Core(cannonpile::Error::TooLarge { .. })) if cannot_stand(&pile) => {
            return Err(Error::CannotStand);
        }
        certificate => Some(certificate?),
    };
    for (contact, force) in certificate.iter().flat_map(|c| &c.horizontal) {
        pile = pile.with_horizontal_force(*contact, force.clone())?;
    }
    Ok(ElasticState { pile, certificate })
}

impl ElasticState {
    /// Returns the pile with the horizontal forces of this state: its forces, of any scalar and in any units, are those of the
    /// state.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile_horizontal::elastic;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
    /// let elastic = elastic(&pile, &BigRational::from_integer(1.into()))?;
    /// assert!(elastic.pile().horizontal_forces().all(|(contact, _)| contact.site.k < 5));
    /// # Ok::<(), cannonpile_horizontal::Error>(())
    /// ```
    #[must_use]
    pub const fn pile(&self) -> &Pile {
        &self.pile
    }

    /// Returns the certificate: the forces, and the displacements that they follow from. None where the pile is straight and
    /// has more than 10⁵ spheres off the floor: there it is a theorem.
    ///
    /// # Examples
    /// See [`ElasticState`].
    #[must_use]
    pub const fn certificate(&self) -> Option<&Certificate> {
        self.certificate.as_ref()
    }
}

/// The most equations of a pile that is certified.
fn most_certified(dimension: Dimension) -> u64 {
    u64::from(MOST_CERTIFIED * dimension.number())
}

/// Returns the certificate of the elastic state.
fn certified(pile: &Pile, stiffness_ratio: &BigRational) -> Result<Certificate, Error> {
    if pile.is_paper_pile() && pile.sphere_count() <= MOST_CERTIFIED.into() {
        return Ok(of_formulas(of_straight(pile, stiffness_ratio))?);
    }
    // What pulls without horizontal contacts needs them, and a program.
    let pulls = pile.first_failure()?.is_some();
    let most = if pulls {
        MOST_EQUATIONS
    } else {
        most_certified(pile.dimension())
    };
    let springs = Springs {
        network: Network::above(pile, pile.layers() - 1, most)?,
        stiffness_ratio,
    };
    let alone = if pulls {
        None
    } else {
        Some(springs.without_horizontal()?).filter(State::is_least_energy)
    };
    let state = if let Some(state) = alone {
        state
    } else {
        springs.network.check_size()?;
        springs.least_energy(guess(&springs)?)?
    };
    accepted(certificate(&springs, &state), || {
        bug("the state of least energy is accepted").into()
    })
}

/// That the paper's pile bears what it bears without horizontal contacts.
fn of_straight(pile: &Pile, stiffness_ratio: &BigRational) -> Certificate {
    let directions = pile.dimension().directions();
    let (floor, sigma) = (pile.layers() - 1, factor_of(pile));
    let sites = pile.shape().sites().take_while(|site| site.k < floor);
    let field = sites.map(|site| {
        let Site { i, j, k } = site;
        let height = BigRational::from_integer((floor - k).into());
        let mut field = [(); 3].map(|()| BigRational::zero());
        for (direction, n) in directions
            .iter()
            .zip(count::above(&(sigma * i), &(sigma * j), &k))
        {
            let n = BigRational::from_integer(n.into());
            field[direction.index()] = formula::elastic_field(&n, &height);
        }
        (site, field)
    });
    Certificate {
        pile: pile.clone(),
        claim: Claim::Elastic {
            stiffness_ratio: stiffness_ratio.clone(),
        },
        horizontal: [].into(),
        field: field.collect(),
    }
}

/// The gaps of contacts, zero where they are shut, by a quadratic program in floats; if that finds nothing, any
/// gaps of all horizontal ones.
fn guess(springs: &Springs<'_>) -> Result<Vec<f64>, Error> {
    let network = &springs.network;
    let sloping = network.weights.len();
    // In units of √(κ′/κ) horizontal forces are as soft as the others.
    // Not a default: what is too great for a float is too great for a guess.
    let ratio = springs.stiffness_ratio.to_f64().unwrap_or(f64::INFINITY);
    // Not a default: beyond these ratios which forces push hardly changes, and what is guessed is made exact.
    let unit = ratio.clamp(1e-6, 1e6).sqrt();
    let unit = BigRational::from_float(unit).ok_or_else(|| bug("a stiffness ratio is a number"))?;
    let mut columns = network.columns.clone();
    for (_, coefficient) in columns.iter_mut().skip(sloping).flatten() {
        *coefficient *= &unit;
    }
    let by_program = |sums: Vec<BigRational>| {
        let program = Program {
            columns: columns.as_slice().into(),
            sums,
            aim: Aim::Squares,
        };
        let (program, _) = program.scaled();
        program.guess(Closeness::Tight)
    };
    let guess = with_light_spheres(&network.weights).and_then(by_program);
    let guess = guess.or_else(|| by_program(network.weights.clone()));
    let Some(guess) = guess else {
        check_interrupt()?;
        if cannot_stand(network.pile) {
            return Err(Error::CannotStand);
        }
        let gap = |contact| f64::from(u8::from(contact >= sloping));
        return Ok((0..network.columns.len()).map(gap).collect());
    };
    let contacts = guess.positive.iter().zip(&guess.slacks);
    Ok(contacts
        .map(|(positive, slack)| if *positive { 0.0 } else { *slack })
        .collect())
}

/// The weights, with a thousandth of the least for each sphere that weighs nothing: floats can tell then which of its contacts
/// are open. `None` if all weigh something, or nothing does.
fn with_light_spheres(weights: &[BigRational]) -> Option<Vec<BigRational>> {
    let least = weights.iter().filter(|weight| !weight.is_zero()).min()?;
    let light = least / BigRational::from_integer(1000.into());
    let heavier = |weight: &BigRational| {
        if weight.is_zero() {
            light.clone()
        } else {
            weight.clone()
        }
    };
    let is_needed = weights.iter().any(Zero::is_zero);
    is_needed.then(|| weights.iter().map(heavier).collect())
}

/// The certificate of a state of springs.
fn certificate(springs: &Springs<'_>, state: &State) -> Certificate {
    Certificate {
        pile: springs.network.pile.clone(),
        claim: Claim::Elastic {
            stiffness_ratio: springs.stiffness_ratio.clone(),
        },
        horizontal: springs.network.horizontal(&state.forces).collect(),
        field: springs.network.field(&state.field).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three equations for each sphere, two for each disc.
    #[test]
    fn a_hundred_thousand_spheres_are_certified() {
        let most = [Dimension::Three, Dimension::Two].map(most_certified);
        assert_eq!(most, [300_000, 200_000]);
    }
}
