//! The greatest and the least contact force, exactly, and the number of contacts with a force.

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::error::bug;
use crate::{Each, Error};
use cannonpile::Pile;
use cannonpile::lattice::{ContactKind, Direction, Site};
use cannonpile::scalar::ByValue;
use cannonpile::shape::Selection;

/// A contact, and its force in f₀.
#[derive(Clone)]
pub(super) struct Extreme {
    /// The upper sphere; for two neighbours, the sphere that names the contact.
    pub(super) site: Site,
    pub(super) link: ContactKind,
    pub(super) force: BigRational,
}

/// Exact statistics of all contact forces of a pile.
#[derive(Default)]
pub(super) struct Extremes {
    /// The first contact with the greatest force; `None` for a single layer.
    pub(super) greatest: Option<Extreme>,
    /// The first contact with the least force; `None` for a single layer.
    pub(super) least: Option<Extreme>,
    /// The least magnitude among the forces other than 0.
    pub(super) weakest: Option<BigRational>,
    /// The number of contacts with a force, compressive or tensile.
    pub(super) bearing: BigUint,
    /// The number of contacts between layers without a force.
    pub(super) idle: BigUint,
    /// The number of contacts that need a tensile force.
    pub(super) pulling: BigUint,
}

impl Extremes {
    /// Examines every contact, layer by layer, in integer arithmetic.
    pub(super) fn of(pile: &Pile) -> Result<Self, Error> {
        let mut extremes = Self::default();
        let directions = pile.dimension().directions();
        let layers = pile.forces::<BigRational>().layers(Selection::All)?;
        let mut layers = layers.numerators::<BigInt>()?;
        while let Some(layer) = layers.next_layer()? {
            if layer.is_floor() {
                break;
            }
            let mut slices = [(); 3].each(|()| vec![BigInt::ZERO; layer.sphere_count()]);
            layer.fill(slices.each_mut().each(Vec::as_mut_slice))?;
            // Sphere by sphere, as in the tables.
            let spheres = 0..layer.sphere_count();
            let all = spheres.flat_map(|n| directions.iter().map(move |line| (n, *line)));
            let force = |(n, line): &(usize, Direction)| &slices[line.index()][*n];
            all.clone().for_each(|at| extremes.count(force(&at)));
            let in_units = |n: &BigInt| BigRational::new(n.clone(), layer.denominator().clone());
            let some = all.clone().filter(|at| !force(at).is_zero());
            if let Some(weakest) = some.min_by_key(|at| force(at).magnitude()) {
                extremes.weaken(in_units(force(&weakest)).abs());
            }
            // Of equal forces, the first is taken: that is the last of the reversed ones.
            let greatest = all.clone().rev().max_by_key(force);
            let least = all.min_by_key(force);
            for at in [greatest, least].into_iter().flatten() {
                let site = pile.rows(Selection::Layer(layer.k()))?.flatten().nth(at.0);
                extremes.meet(Extreme {
                    site: site.ok_or_else(|| bug("a layer has a sphere for each of its forces"))?,
                    link: at.1.into(),
                    force: in_units(force(&at)),
                });
            }
        }
        for (contact, force) in pile.horizontal_forces() {
            extremes.count(force.numer());
            if !force.is_zero() {
                extremes.weaken(force.abs());
            }
            extremes.meet(Extreme {
                site: contact.site,
                link: contact.axis.into(),
                force: force.clone(),
            });
        }
        Ok(extremes)
    }

    fn count(&mut self, force: &BigInt) {
        if force.is_zero() {
            self.idle += 1_u32;
            return;
        }
        self.bearing += 1_u32;
        if force.is_negative() {
            self.pulling += 1_u32;
        }
    }

    fn weaken(&mut self, magnitude: BigRational) {
        let known = self.weakest.as_ref();
        if known.is_none_or(|weakest| ByValue(&magnitude) < ByValue(weakest)) {
            self.weakest = Some(magnitude);
        }
    }

    fn meet(&mut self, met: Extreme) {
        let greatest = self.greatest.as_ref();
        if greatest.is_none_or(|greatest| ByValue(&met.force) > ByValue(&greatest.force)) {
            self.greatest = Some(met.clone());
        }
        let least = self.least.as_ref();
        if least.is_none_or(|least| ByValue(&met.force) < ByValue(&least.force)) {
            self.least = Some(met);
        }
    }
}
