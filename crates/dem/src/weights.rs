//! Masses, weights and loads of spheres for simulation codes.

use std::collections::{BTreeMap, BTreeSet};

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::numbered::{NumberedPile, nearest};
use crate::Error;
use cannonpile::Pile;
use cannonpile::lattice::Site;

/// Returns a rational, correctly rounded.
///
/// # Errors
/// [`Error::Overflow`](cannonpile::Error::Overflow) if the number is outside the range of `f64`.
pub fn nearest_rational(number: &BigRational, quantity: &'static str) -> Result<f64, Error> {
    nearest(&number.clone().into(), quantity)
}

/// Returns a rational, correctly rounded, if it is a positive normal float.
pub(super) fn normal(number: &BigRational, quantity: &'static str) -> Result<f64, Error> {
    checked(nearest(&number.clone().into(), quantity)?, quantity)
}

/// Returns the number if it is a positive normal float.
pub(super) fn checked(number: f64, quantity: &'static str) -> Result<f64, Error> {
    let scalar = "f64";
    let fits = number.is_normal() && number.is_sign_positive();
    fits.then_some(number)
        .ok_or_else(|| Error::overflow(quantity, scalar))
}

/// Returns the weight of ordinary spheres, in mg.
#[must_use]
pub fn ordinary_weight(pile: &Pile) -> BigRational {
    if pile.is_weightless() {
        BigRational::zero()
    } else {
        BigRational::one()
    }
}

/// Returns the spheres with a load or a weight of their own.
fn special_sites(pile: &Pile) -> BTreeSet<Site> {
    let loads = pile.loads().map(|(site, _)| site);
    loads.chain(pile.weights().map(|(site, _)| site)).collect()
}

/// Returns the greatest deviation of weight plus load from the ordinary weight, in mg.
pub(super) fn greatest_extra(pile: &Pile) -> Result<BigRational, Error> {
    let ordinary = ordinary_weight(pile);
    let mut greatest = BigRational::zero();
    for site in special_sites(pile) {
        let extra = pile.sphere_weight(site)? + pile.load(site)?.down - &ordinary;
        greatest = greatest.max(extra.abs());
    }
    Ok(greatest)
}

/// A rounded quantity that is the same for all but a few spheres.
pub(super) struct PerSphere {
    ordinary: f64,
    special: BTreeMap<Site, f64>,
}

impl PerSphere {
    /// Returns the masses, in kg.
    pub(super) fn masses(pile: &NumberedPile<'_>) -> Result<Self, Error> {
        Self::of_weights(pile, "mass", pile.packing().mass())
    }

    /// Returns the weights, in N.
    pub(super) fn weights(pile: &NumberedPile<'_>) -> Result<Self, Error> {
        Self::of_weights(pile, "weight", &pile.packing().sphere_weight())
    }

    /// Returns the loads, in N: the downward forces in addition to the weights.
    pub(super) fn loads(pile: &NumberedPile<'_>) -> Result<Self, Error> {
        let (quantity, unit) = ("load", pile.packing().sphere_weight());
        let special = |site| Ok(pile.pile().load(site)?.down);
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

/// Returns the mass of a sphere for codes that need positive masses: its own mass, or m if it is weightless.
fn inertia(pile: &NumberedPile<'_>, site: Site) -> Result<BigRational, Error> {
    let mass = pile.packing().mass_of(site)?;
    Ok(if mass.is_positive() {
        mass
    } else {
        pile.packing().mass().clone()
    })
}

/// Returns the masses of [`inertia`] for the spheres with a weight of their own.
pub(super) fn inertias(pile: &NumberedPile<'_>) -> Result<BTreeMap<Site, f64>, Error> {
    let sites = pile.pile().weights().map(|(site, _)| site);
    let masses = sites.map(|site| Ok((site, normal(&inertia(pile, site)?, "mass")?)));
    masses.collect()
}

/// Returns the spheres above the floor whose weight and load differ from the weight of their [`inertia`]: the sphere
/// number, and the additional downward force in N.
pub(super) fn burdens(pile: &NumberedPile<'_>) -> Result<Vec<(u64, f64)>, Error> {
    let (packing, ordinary) = (pile.packing(), ordinary_weight(pile.pile()));
    let floor = pile.pile().layers() - 1;
    let mut burdens = Vec::new();
    let special = special_sites(pile.pile()).into_iter();
    for site in special.filter(|site| site.k < floor) {
        let pulled = inertia(pile, site)? * packing.gravity() * &ordinary;
        let total = pile.pile().sphere_weight(site)? + pile.pile().load(site)?.down;
        let force = total * packing.sphere_weight() - pulled;
        if !force.is_zero() {
            let id = pile.numbering().id(site)?;
            burdens.push((id, nearest_rational(&force, "a load")?));
        }
    }
    Ok(burdens)
}
