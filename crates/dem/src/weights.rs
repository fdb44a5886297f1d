//! What spheres weigh and bear, as a simulation needs it.

use std::collections::{BTreeMap, BTreeSet};

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::numbered::{NumberedPile, nearest};
use crate::Error;
use cannonpile::Pile;
use cannonpile::lattice::Site;

/// The nearest float to a rational.
///
/// # Errors
/// [`Error::Overflow`](cannonpile::Error::Overflow) beyond the floats.
pub fn nearest_rational(number: &BigRational, quantity: &'static str) -> Result<f64, Error> {
    nearest(&number.clone().into(), quantity)
}

/// The nearest float, if it is positive and has all its digits.
pub(super) fn normal(number: &BigRational, quantity: &'static str) -> Result<f64, Error> {
    checked(nearest(&number.clone().into(), quantity)?, quantity)
}

/// A float, if it is positive and has all its digits.
pub(super) fn checked(number: f64, quantity: &'static str) -> Result<f64, Error> {
    let scalar = "f64";
    let fits = number.is_normal() && number.is_sign_positive();
    fits.then_some(number)
        .ok_or_else(|| Error::overflow(quantity, scalar))
}

/// What most spheres weigh, in mg.
#[must_use]
pub fn ordinary_weight(pile: &Pile) -> BigRational {
    if pile.is_weightless() {
        BigRational::zero()
    } else {
        BigRational::one()
    }
}

/// The spheres that were given a load or a weight of their own.
fn special_sites(pile: &Pile) -> BTreeSet<Site> {
    let loads = pile.loads().map(|(site, _)| site);
    loads.chain(pile.weights().map(|(site, _)| site)).collect()
}

/// The greatest difference of weight and load together from the ordinary weight, in mg.
pub(super) fn greatest_extra(pile: &Pile) -> Result<BigRational, Error> {
    let ordinary = ordinary_weight(pile);
    let mut greatest = BigRational::zero();
    for site in special_sites(pile) {
        let extra = pile.sphere_weight(site)? + pile.load(site)? - &ordinary;
        greatest = greatest.max(extra.abs());
    }
    Ok(greatest)
}

/// A quantity that is the same for all spheres but a few, rounded.
pub(super) struct PerSphere {
    ordinary: f64,
    special: BTreeMap<Site, f64>,
}

impl PerSphere {
    /// The masses, in kg.
    pub(super) fn masses(pile: &NumberedPile<'_>) -> Result<Self, Error> {
        Self::of_weights(pile, "mass", pile.packing().mass())
    }

    /// The weights, in N.
    pub(super) fn weights(pile: &NumberedPile<'_>) -> Result<Self, Error> {
        Self::of_weights(pile, "weight", &pile.packing().sphere_weight())
    }

    /// The loads, in N: what acts downwards besides the weight.
    pub(super) fn loads(pile: &NumberedPile<'_>) -> Result<Self, Error> {
        let (quantity, unit) = ("load", pile.packing().sphere_weight());
        let special = |site| Ok(pile.pile().load(site)?);
        Self::new(pile, quantity, &BigRational::zero(), special, &unit)
    }

    fn of_weights(
        pile: &NumberedPile<'_>,
        quantity: &'static str,
        unit: &BigRational,
    ) -> Result<Self, Error> {
        let special = |site| Ok(pile.pile().sphere_weight(site)?);
        Self::new(pile, quantity, &ordinary_weight(pile.pile()), special, unit)
    }

    fn new(
        pile: &NumberedPile<'_>,
        quantity: &'static str,
        ordinary: &BigRational,
        special: impl Fn(Site) -> Result<BigRational, Error>,
        unit: &BigRational,
    ) -> Result<Self, Error> {
        let sites = special_sites(pile.pile()).into_iter();
        let special =
            sites.map(|site| Ok((site, nearest_rational(&(special(site)? * unit), quantity)?)));
        Ok(Self {
            ordinary: nearest_rational(&(ordinary * unit), quantity)?,
            special: special.collect::<Result<_, Error>>()?,
        })
    }

    pub(super) fn of(&self, site: Site) -> f64 {
        self.special.get(&site).copied().unwrap_or(self.ordinary)
    }
}

/// The mass that a sphere has in a code in which nothing may have none: its own, or m if it weighs nothing.
fn inertia(pile: &NumberedPile<'_>, site: Site) -> Result<BigRational, Error> {
    let mass = pile.packing().mass_of(site)?;
    Ok(if mass.is_positive() {
        mass
    } else {
        pile.packing().mass().clone()
    })
}

/// That mass of the spheres that have a weight of their own.
pub(super) fn inertias(pile: &NumberedPile<'_>) -> Result<BTreeMap<Site, f64>, Error> {
    let sites = pile.pile().weights().map(|(site, _)| site);
    let masses = sites.map(|site| Ok((site, normal(&inertia(pile, site)?, "mass")?)));
    masses.collect()
}

/// The spheres off the floor on which another force acts than the weight of their mass: their numbers, and how much more,
/// downwards, in N.
pub(super) fn burdens(pile: &NumberedPile<'_>) -> Result<Vec<(u64, f64)>, Error> {
    let (packing, ordinary) = (pile.packing(), ordinary_weight(pile.pile()));
    let floor = pile.pile().layers() - 1;
    let mut burdens = Vec::new();
    let special = special_sites(pile.pile()).into_iter();
    for site in special.filter(|site| site.k < floor) {
        let pulled = inertia(pile, site)? * packing.gravity() * &ordinary;
        let total = pile.pile().sphere_weight(site)? + pile.pile().load(site)?;
        let force = total * packing.sphere_weight() - pulled;
        if !force.is_zero() {
            let id = pile.numbering().id(site)?;
            burdens.push((id, nearest_rational(&force, "a load")?));
        }
    }
    Ok(burdens)
}
