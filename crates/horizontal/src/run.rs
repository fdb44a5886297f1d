//! Farkas certificates for runs that are too long before a sign change.

use crate::Each;
use std::collections::BTreeMap;

use cannonpile::lattice::{Direction, Site};
use cannonpile::shape::Shape;
use cannonpile::{Error, Pile};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::beginning::{certified, certified_down_to};
use crate::certificate::{Certificate, Claim};

/// The longest stable run between the top and a sign change, in steps. After a sign change one more step is
/// possible.
const LONGEST: i128 = 3;

/// The maximum number of spheres of an edge in a field. More than four are needed if the sphere at the sign change
/// is heavier.
const MAX_SPHERES: usize = 1000;

/// Returns the layer above the first step of each run, from the top.
pub(crate) fn run_starts(shape: &Shape) -> impl Iterator<Item = i128> {
    shape.stacking().runs().scan(0, |below, run| {
        let above = *below;
        *below += run.steps;
        Some(above)
    })
}

/// Returns a certificate that some run before a sign change is too long, for the first such run.
///
/// The field is nonzero on spheres of one edge only (lemma 1 of [`census`](crate::census)).
pub(crate) fn too_long_run(pile: &Pile) -> Result<Option<Certificate>, Error> {
    let shape = pile.shape();
    for (from, k) in run_starts(shape).zip(run_starts(shape).skip(1)) {
        // At a sign change a sphere can transmit zero force along the edge, whatever its weight.
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

/// Returns the field φ = −3 on the lowest sphere of a line and φ = 1 on those above it, as many as make the work
/// positive.
///
/// The line goes up to layer `first`. `None` if the sphere is not on an edge, or the line is too short.
fn edge(
    pile: &Pile,
    lowest: Site,
    direction: Direction,
    first: i128,
) -> Option<BTreeMap<Site, [BigRational; 3]>> {
    let shape = pile.shape();
    // On an edge the sphere is loaded from above along this line only.
    let mut others = Direction::ALL.into_iter().filter(|l| *l != direction);
    if others.any(|other| shape.above(lowest, other).is_some()) {
        return None;
    }
    let along = |number: BigRational| {
        let mut field = [(); 3].each(|()| BigRational::zero());
        field[direction.index()] = number;
        field
    };
    let minus_three = BigRational::from_integer((-3).into());
    let own = |site| pile.own_increments(site)[direction.index()].clone();
    let mut work = own(lowest) * &minus_three;
    let mut field = BTreeMap::from([(lowest, along(minus_three))]);
    let mut line = core::iter::successors(Some(lowest), |site| shape.above(*site, direction));
    let mut above = line.by_ref().skip(1).take(MAX_SPHERES);
    while !work.is_positive() {
        let site = above.next().filter(|site| site.k >= first)?;
        work += own(site);
        field.insert(site, along(BigRational::one()));
    }
    Some(field)
}
