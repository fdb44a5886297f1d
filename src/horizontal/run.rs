//! Runs that are too long before a change of sign.

use alloc::collections::BTreeMap;

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::certificate::{Certificate, Claim};
use crate::error::bug;
use crate::lattice::{Direction, Site};
use crate::{Error, Pile};

/// The longest run from the top before a change of sign that may stand, in steps; after a change it may have one more.
const LONGEST: i128 = 3;

/// The most spheres of an edge that are added up, if the one at the change is heavier than others.
const MOST_SPHERES: usize = 1000;

impl Pile {
    /// Returns the proof that a run is too long before a change of sign, from the spheres of an edge
    /// ([`census`](super::census), 1); the first of them, if there are several.
    pub(super) fn too_long_run(&self) -> Result<Option<Certificate>, Error> {
        let shape = self.shape();
        for change in 1..=shape.stacking().changes() {
            let runs = shape.stretch(change - 1).zip(shape.stretch(change));
            let (before, after) =
                runs.ok_or_else(|| bug("a change of sign is between two runs"))?;
            // What a sphere at a change passes on may be nothing, whatever it weighs.
            let (first, k) = (before.from + i128::from(before.from > 0), after.from);
            if k - first <= LONGEST {
                continue;
            }
            for [i, j] in shape.layer(k)?.corners() {
                for direction in Direction::ALL {
                    let Some(field) = self.edge(Site { i, j, k }, direction, first) else {
                        continue;
                    };
                    let certificate = Certificate {
                        field,
                        ..self.certified_down_to(k + 1)?.certified(Claim::CannotStand)
                    };
                    if certificate.check().is_ok() {
                        return Ok(Some(certificate));
                    }
                }
            }
        }
        Ok(None)
    }

    /// φ = −3 on the lowest sphere of a line and 1 on those above it, as many as outweigh it, down to a layer at most.
    fn edge(
        &self,
        lowest: Site,
        direction: Direction,
        first: i128,
    ) -> Option<BTreeMap<Site, [BigRational; 3]>> {
        let shape = self.shape();
        // On an edge nothing else rests on it.
        let mut others = Direction::ALL.into_iter().filter(|l| *l != direction);
        if others.any(|other| shape.above(lowest, other).is_some()) {
            return None;
        }
        let along = |number: BigRational| {
            let mut field = core::array::from_fn(|_| BigRational::zero());
            field[direction.index()] = number;
            field
        };
        let minus_three = BigRational::from_integer((-3).into());
        let mut work = self.loading().total(lowest) * &minus_three;
        let mut field = BTreeMap::from([(lowest, along(minus_three))]);
        let mut line = core::iter::successors(Some(lowest), |site| shape.above(*site, direction));
        let mut above = line.by_ref().skip(1).take(MOST_SPHERES);
        while !work.is_positive() {
            let site = above.next().filter(|site| site.k >= first)?;
            work += self.loading().total(site);
            field.insert(site, along(BigRational::one()));
        }
        Some(field)
    }
}
