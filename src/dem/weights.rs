//! What spheres weigh and bear, as a simulation needs it.

use std::collections::BTreeMap;

use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::numbered::{NumberedPile, nearest};

use crate::Error;
use crate::lattice::Site;

/// The nearest float to a rational.
pub(super) fn nearest_rational(number: &BigRational, quantity: &'static str) -> Result<f64, Error> {
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
        .ok_or(Error::Overflow { quantity, scalar })
}

/// A quantity that is the same for all spheres but a few, rounded.
pub(super) struct PerSphere {
    ordinary: f64,
    special: BTreeMap<Site, f64>,
}

impl PerSphere {
    /// The masses, in kg.
    pub(super) fn masses(pile: &NumberedPile<'_>) -> Result<Self, Error> {
        let (loading, mass) = (pile.pile().loading(), pile.packing().mass());
        Self::new(
            pile,
            "mass",
            &loading.ordinary(),
            |site| loading.weight(site),
            mass,
        )
    }

    /// The weights, in N.
    pub(super) fn weights(pile: &NumberedPile<'_>) -> Result<Self, Error> {
        let (loading, mg) = (pile.pile().loading(), pile.packing().sphere_weight());
        Self::new(
            pile,
            "weight",
            &loading.ordinary(),
            |site| loading.weight(site),
            &mg,
        )
    }

    /// The loads, in N: what acts downwards besides the weight.
    pub(super) fn loads(pile: &NumberedPile<'_>) -> Result<Self, Error> {
        let (loading, mg) = (pile.pile().loading(), pile.packing().sphere_weight());
        Self::new(
            pile,
            "load",
            &BigRational::zero(),
            |site| loading.load(site),
            &mg,
        )
    }

    fn new(
        pile: &NumberedPile<'_>,
        quantity: &'static str,
        ordinary: &BigRational,
        special: impl Fn(Site) -> BigRational,
        unit: &BigRational,
    ) -> Result<Self, Error> {
        let sites = pile.pile().loading().special_sites();
        let special =
            sites.map(|site| Ok((site, nearest_rational(&(special(site) * unit), quantity)?)));
        Ok(Self {
            ordinary: nearest_rational(&(ordinary * unit), quantity)?,
            special: special.collect::<Result<_, Error>>()?,
        })
    }

    pub(super) fn of(&self, site: Site) -> f64 {
        self.special.get(&site).copied().unwrap_or(self.ordinary)
    }
}

/// A force that acts on a sphere besides the weight of its mass.
pub(super) struct Burden {
    pub(super) id: u64,
    /// Downwards, in N.
    pub(super) force: f64,
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
    let sites = pile.pile().loading().special_weights();
    let masses = sites.map(|site| Ok((site, normal(&inertia(pile, site)?, "mass")?)));
    masses.collect()
}

/// The spheres off the floor on which more or less acts than the weight of their mass.
pub(super) fn burdens(pile: &NumberedPile<'_>) -> Result<Vec<Burden>, Error> {
    let (packing, loading) = (pile.packing(), pile.pile().loading());
    let floor = pile.pile().layers() - 1;
    let mut burdens = Vec::new();
    for site in loading.special_sites().filter(|site| site.k < floor) {
        let pulled = inertia(pile, site)? * packing.gravity() * loading.ordinary();
        let force = loading.total(site) * packing.sphere_weight() - pulled;
        if !force.is_zero() {
            burdens.push(Burden {
                id: pile.numbering().id(site)?,
                force: nearest_rational(&force, "a load")?,
            });
        }
    }
    Ok(burdens)
}
