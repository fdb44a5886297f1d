//! Runs that are too long before a change of sign.

use std::collections::BTreeMap;

use cannonpile::lattice::{Direction, Site};
use cannonpile::shape::Shape;
use cannonpile::{Error, Pile};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::beginning::{certified, certified_down_to};
use crate::certificate::{Certificate, Claim};

/// The longest run from the top before a change of sign that may stand, in steps; after a change it may have one more.
const LONGEST: i128 = 3;

/// The most spheres of an edge that are added up, if the one at the change is heavier than others.
const MOST_SPHERES: usize = 1000;

/// Returns the layer above the first step of each run, from the top.
pub(crate) fn run_starts(shape: &Shape) -> impl Iterator<Item = i128> {
    shape.stacking().runs().scan(0, |below, run| {
        let above = *below;
        *below += run.steps;
        Some(above)
    })
}

/// Returns the proof that a run is too long before a change of sign, from the spheres of an edge
/// ([`census`](crate::census), 1); the first of them, if there are several.
pub(crate) fn too_long_run(pile: &Pile) -> Result<Option<Certificate>, Error> {
    let shape = pile.shape();
    for (from, k) in run_starts(shape).zip(run_starts(shape).skip(1)) {
        // What a sphere at a change passes on may be nothing, whatever it weighs.
        let first = from + i128::from(from > 0);
        if k - first <= LONGEST {
            continue;
        }
        for [i, j] in shape.layer(k)?.corners() {
            for direction in Direction::ALL {
                let Some(field) = edge(pile, Site { i, j, k }, direction, first) else {
                    continue;
                };
                let certificate = Certificate {
                    field,
                    ..certified(certified_down_to(pile, k + 1)?, Claim::CannotStand)
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
    pile: &Pile,
    lowest: Site,
    direction: Direction,
    first: i128,
) -> Option<BTreeMap<Site, [BigRational; 3]>> {
    let shape = pile.shape();
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
    let mut work = pile.total_load(lowest) * &minus_three;
    let mut field = BTreeMap::from([(lowest, along(minus_three))]);
    let mut line = core::iter::successors(Some(lowest), |site| shape.above(*site, direction));
    let mut above = line.by_ref().skip(1).take(MOST_SPHERES);
    while !work.is_positive() {
        let site = above.next().filter(|site| site.k >= first)?;
        work += pile.total_load(site);
        field.insert(site, along(BigRational::one()));
    }
    Some(field)
}
