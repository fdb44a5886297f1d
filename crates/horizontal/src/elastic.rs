//! The elastic state: equilibrium of linear unilateral springs in the rigid limit.

use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::engine::{bug, check_interrupt, positive};
use cannonpile::lattice::{Dimension, Site, count};
use cannonpile::scalar::ByValue;
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

use crate::certificate::{Certificate, Claim};
use crate::network::{MAX_CERTIFIED, MAX_EQUATIONS, Network};
use crate::program::{accepted, in_floats, of_formulas};
use crate::springs::{Springs, State};
use crate::stand::cannot_stand;
use crate::straight::factor_of;
use crate::{Each, Error, formula};

/// The elastic state of a pile at a = R, from [`elastic`].
///
/// Each contact is a linear spring that carries compression only. Of all admissible forces, the elastic state
/// minimises the energy Σ f²/2κ + Σ X²/2κ′. The energy is strictly convex, so the state is unique.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Region;
/// use cannonpile_horizontal::elastic;
/// use num_rational::BigRational;
///
/// let equal = BigRational::from_integer(1.into());
/// // The straight pile has the forces of the paper: all horizontal contacts open.
/// let straight = elastic(&Pile::triangular(100)?, &equal)?;
/// assert_eq!(straight.pile().horizontal_forces().len(), 0);
///
/// // Six layers of HCP need horizontal forces.
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

/// Returns the elastic state at a = R. `stiffness_ratio` is κ′/κ, the stiffness of horizontal contacts over that of
/// sloping ones.
///
/// In a straight pile of equal weights, of any size, the horizontal contacts open and the forces are those without
/// them ([`paper`](cannonpile::paper#elastic-state)). For other piles a test at linear cost decides whether this
/// holds. If not, a quadratic program in floats suggests the active contacts, and an active-set method in rationals
/// (Goldfarb & Idnani 1983) finds the exact ones. It terminates for all weights. Horizontal forces that were
/// assigned to the pile are ignored.
///
/// # Errors
/// * [`NotPositive`](cannonpile::Error::NotPositive) if the stiffness ratio is zero or negative.
/// * [`NoHorizontalContacts`](cannonpile::Error::NoHorizontalContacts) if neighbours in a layer do not touch.
/// * [`Error::CannotStand`] if the pile is unstable.
/// * [`TooLarge`](cannonpile::Error::TooLarge) if the program has too many equations.
/// * The errors of [`standing`](Pile::standing).
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
    positive("stiffness-ratio", stiffness_ratio.clone())?;
    let certificate = match certified(&pile, stiffness_ratio) {
        Err(Error::Core(cannonpile::Error::TooLarge { .. }))
            if pile.shape().stacking().is_straight() && pile.is_uniform() =>
        {
            None
        }
        // It is cheap to detect that the first layers are unstable, for piles of any size.
        Err(Error::Core(cannonpile::Error::TooLarge { .. })) if cannot_stand(&pile)? => {
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
    /// Returns the pile with the horizontal forces of this state. Its contact forces, in any scalar and unit, are
    /// those of the elastic state.
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

    /// Returns the certificate: the forces, and the displacements that cause them.
    ///
    /// `None` for a straight pile with more than 10⁵ spheres above the floor, for which a theorem proves the state.
    ///
    /// # Examples
    /// See [`ElasticState`].
    #[must_use]
    pub const fn certificate(&self) -> Option<&Certificate> {
        self.certificate.as_ref()
    }
}

/// Returns the maximum number of equations for which a certificate is computed without a program.
fn most_certified(dimension: Dimension) -> u64 {
    u64::from(MAX_CERTIFIED * dimension.number())
}

/// Computes the elastic state and returns its certificate.
fn certified(pile: &Pile, stiffness_ratio: &BigRational) -> Result<Certificate, Error> {
    if pile.is_paper_pile() && pile.sphere_count() <= MAX_CERTIFIED.into() {
        return Ok(of_formulas(of_straight(pile, stiffness_ratio))?);
    }
    // If a contact is tensile without horizontal forces, these forces are needed, and with them a program.
    let is_tensile = pile.first_failure()?.is_some();
    let most = if is_tensile {
        MAX_EQUATIONS
    } else {
        most_certified(pile.dimension())
    };
    let springs = Springs {
        network: Network::above(pile, pile.layers() - 1, most)?,
        stiffness_ratio,
    };
    let alone = if is_tensile {
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
    accepted(certificate(&springs, &state))
}

/// Returns the certificate of the paper's pile: all horizontal contacts open.
fn of_straight(pile: &Pile, stiffness_ratio: &BigRational) -> Certificate {
    let directions = pile.dimension().directions();
    let (floor, sigma) = (pile.layers() - 1, factor_of(pile));
    let mut field = BTreeMap::new();
    for site in pile.shape().sites().take_while(|site| site.k < floor) {
        let Site { i, j, k } = site;
        let height = BigRational::from_integer((floor - k).into());
        let mut along = [(); 3].each(|()| BigRational::zero());
        for (direction, n) in directions
            .iter()
            .zip(count::above(&(sigma * i), &(sigma * j), &k))
        {
            let n = BigRational::from_integer(n.into());
            along[direction.index()] = formula::elastic_field(&n, &height);
        }
        field.insert(site, along);
    }
    Certificate {
        pile: pile.clone(),
        claim: Claim::Elastic {
            stiffness_ratio: stiffness_ratio.clone(),
        },
        horizontal: BTreeMap::new(),
        field,
    }
}

/// Returns a gap for each contact, zero if it is closed, from a quadratic program in floats.
///
/// If the solver finds nothing, the result has all horizontal contacts open and all others closed.
fn guess(springs: &Springs<'_>) -> Result<Vec<f64>, Error> {
    let network = &springs.network;
    let sloping = network.weights.len();
    // Horizontal forces are scaled by √(κ′/κ), so that the objective of the program is a plain sum of squares. A ratio
    // outside the range of `f64` becomes infinite, and is clamped below.
    let ratio = springs.stiffness_ratio.to_f64().unwrap_or(f64::INFINITY);
    // Beyond these ratios the set of active contacts hardly changes. The result is only a guess for the exact method.
    let unit = ratio.clamp(1e-6, 1e6).sqrt();
    let unit = BigRational::from_float(unit).ok_or_else(|| bug("a stiffness ratio is finite"))?;
    let mut columns = network.columns.clone();
    for (_, coefficient) in columns.iter_mut().skip(sloping).flatten() {
        *coefficient *= &unit;
    }
    let cost = vec![BigRational::zero(); columns.len()];
    let by_program = |sums: &[BigRational]| in_floats(&columns, sums, &cost, true);
    let found = with_light_spheres(&network.weights).and_then(|sums| by_program(&sums));
    if let Some(found) = found.or_else(|| by_program(&network.weights)) {
        let gap = |[x, slack]: [f64; 2]| if x > slack { 0.0 } else { slack };
        return Ok(found.into_iter().map(gap).collect());
    }
    check_interrupt()?;
    if cannot_stand(network.pile)? {
        return Err(Error::CannotStand);
    }
    let gap = |contact| f64::from(u8::from(contact >= sloping));
    Ok((0..columns.len()).map(gap).collect())
}

/// Returns the weights with a small weight for each weightless sphere: a thousandth of the smallest weight. With it
/// the float solution shows which contacts of these spheres are open. `None` if no sphere or every sphere is
/// weightless.
fn with_light_spheres(weights: &[BigRational]) -> Option<Vec<BigRational>> {
    let weighed = weights.iter().filter(|weight| !weight.is_zero());
    let least = weighed.min_by_key(|weight| ByValue(weight))?;
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

/// Returns the certificate of an elastic state.
fn certificate(springs: &Springs<'_>, state: &State) -> Certificate {
    let network = &springs.network;
    Certificate {
        pile: network.pile.clone(),
        claim: Claim::Elastic {
            stiffness_ratio: springs.stiffness_ratio.clone(),
        },
        horizontal: network.horizontal(&state.forces),
        field: network.field(&state.field),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three equations for each sphere, two for each disc.
    #[test]
    fn up_to_100_000_spheres_are_certified() {
        let most = [Dimension::Three, Dimension::Two].map(most_certified);
        assert_eq!(most, [300_000, 200_000]);
    }
}
