//! Masses, weights and loads of spheres for simulation codes.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::numbered::{NumberedPile, nearest, rounded};
use crate::{Each, Error};
use cannonpile::lattice::Site;
use cannonpile::scalar::{ByValue, Surd};
use cannonpile::{FloorForce, Load, Packing, Pile};

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

/// Returns the spheres with a load or a weight of their own, in row order.
pub(super) fn special_sites(pile: &Pile) -> Vec<Site> {
    let loads = pile.loads().map(|(site, _)| site);
    let mut sites: Vec<Site> = loads.chain(pile.weights().map(|(site, _)| site)).collect();
    sites.sort_unstable();
    sites.dedup();
    sites
}

/// Returns an upper bound of the magnitude of a load, in mg or mg·tanθ: |w| + |x| + 2|y|.
pub(super) fn magnitude(Load { down, x, y }: &Load) -> BigRational {
    down.abs() + x.abs() + y.abs() + y.abs()
}

/// Returns the greatest deviation of weight plus load from the ordinary weight, as a [`magnitude`].
pub(super) fn greatest_extra(pile: &Pile) -> Result<BigRational, Error> {
    let ordinary = ordinary_weight(pile);
    let mut greatest = BigRational::zero();
    for site in special_sites(pile) {
        let weight = pile.sphere_weight(site)? - &ordinary;
        let extra = Load::leaning(weight, pile.tilt()) + &pile.load(site)?;
        let extra = magnitude(&extra);
        if ByValue(&extra) > ByValue(&greatest) {
            greatest = extra;
        }
    }
    Ok(greatest)
}

/// Returns a load as a force vector, in N: x, y and z (up).
pub(crate) fn newtons(packing: &Packing<'_>, load: Load) -> [Surd; 3] {
    // Loads have the units of the forces on the floor.
    let FloorForce {
        normal,
        shear_x,
        shear_y,
        ..
    } = packing.floor_force_in_si(FloorForce {
        site: Site::APEX,
        normal: load.down,
        shear_x: load.x,
        shear_y: load.y,
    });
    [shear_x, shear_y, -normal]
}

/// Returns a load as a correctly rounded force vector, in N: x, y and z (up).
pub(crate) fn rounded_newtons(
    packing: &Packing<'_>,
    load: Load,
    quantity: &'static str,
) -> Result<[f64; 3], Error> {
    // Adding 0 turns −0 into 0.
    Ok(rounded(&newtons(packing, load), quantity)?.each(|part| part + 0.0))
}

/// Returns the acceleration of gravity, in m/s²: x, y and z (up); 0 for weightless spheres.
pub(super) fn gravity(pile: &NumberedPile<'_>) -> Result<[f64; 3], Error> {
    let packing = pile.packing();
    let weight = ordinary_weight(pile.pile()) / packing.mass();
    let gravity = newtons(packing, Load::leaning(weight, pile.pile().tilt()));
    Ok(rounded(&gravity, "gravity")?.each(|part| part + 0.0))
}

/// A rounded quantity that is the same for all but a few spheres.
pub(super) struct PerSphere {
    ordinary: f64,
    /// In row order.
    special: Vec<(Site, f64)>,
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
        Self::new(pile, quantity, &BigRational::zero(), &special, &unit)
    }

    /// Returns the horizontal components of the loads along x and y, in N.
    pub(super) fn horizontal_loads(pile: &NumberedPile<'_>) -> Result<[Self; 2], Error> {
        let mut along = [(); 2].each(|()| Self {
            ordinary: 0.0,
            special: Vec::new(),
        });
        for (site, load) in pile.pile().loads() {
            let [x, y, _] = rounded_newtons(pile.packing(), load.clone(), "load")?;
            for (along, part) in along.iter_mut().zip([x, y]) {
                along.special.push((site, part));
            }
        }
        Ok(along)
    }

    fn of_weights(
        pile: &NumberedPile<'_>,
        quantity: &'static str,
        unit: &BigRational,
    ) -> Result<Self, Error> {
        let special = |site| Ok(pile.pile().sphere_weight(site)?);
        Self::new(
            pile,
            quantity,
            &ordinary_weight(pile.pile()),
            &special,
            unit,
        )
    }

    fn new(
        pile: &NumberedPile<'_>,
        quantity: &'static str,
        ordinary: &BigRational,
        special: &dyn Fn(Site) -> Result<BigRational, Error>,
        unit: &BigRational,
    ) -> Result<Self, Error> {
        let mut numbers = Self {
            ordinary: nearest_rational(&(ordinary * unit), quantity)?,
            special: Vec::new(),
        };
        for site in special_sites(pile.pile()) {
            let number = nearest_rational(&(special(site)? * unit), quantity)?;
            numbers.special.push((site, number));
        }
        Ok(numbers)
    }

    pub(super) fn of(&self, site: Site) -> f64 {
        find(&self.special, site).unwrap_or(self.ordinary)
    }
}

/// Returns the number of a site in a list in row order.
pub(super) fn find(numbers: &[(Site, f64)], site: Site) -> Option<f64> {
    let place = numbers.binary_search_by_key(&site, |(site, _)| *site);
    Some(numbers[place.ok()?].1)
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

/// Returns the masses of [`inertia`] for the spheres with a weight of their own, in row order.
pub(super) fn inertias(pile: &NumberedPile<'_>) -> Result<Vec<(Site, f64)>, Error> {
    let mut masses = Vec::new();
    for (site, _) in pile.pile().weights() {
        masses.push((site, normal(&inertia(pile, site)?, "mass")?));
    }
    Ok(masses)
}

/// Returns the spheres above the floor on which gravity and load differ from gravity on their [`inertia`]: the sphere
/// number, and the additional force in N as x, y and z (up).
pub(super) fn burdens(pile: &NumberedPile<'_>) -> Result<Vec<(u64, [f64; 3])>, Error> {
    burdens_above(pile, pile.pile().layers() - 1)
}

/// Returns the same for the spheres of all layers, for a bottom layer that is free to move.
pub(super) fn burdens_of_all(pile: &NumberedPile<'_>) -> Result<Vec<(u64, [f64; 3])>, Error> {
    burdens_above(pile, pile.pile().layers())
}

fn burdens_above(pile: &NumberedPile<'_>, floor: i128) -> Result<Vec<(u64, [f64; 3])>, Error> {
    let (packing, ordinary) = (pile.packing(), ordinary_weight(pile.pile()));
    let mut burdens = Vec::new();
    let special = special_sites(pile.pile()).into_iter();
    for site in special.filter(|site| site.k < floor) {
        let pulled = inertia(pile, site)? / packing.mass() * &ordinary;
        let weight = pile.pile().sphere_weight(site)? - pulled;
        let force = Load::leaning(weight, pile.pile().tilt()) + &pile.pile().load(site)?;
        if !force.is_zero() {
            let id = pile.numbering().id(site)?;
            burdens.push((id, rounded_newtons(packing, force, "a load")?));
        }
    }
    Ok(burdens)
}
