//! Which rows of spheres lie in a vertical section.

use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive};

use crate::Error;
use crate::figure::Subject;
use crate::figure::response::middle;
use crate::lattice::{Dimension, Site};
use crate::scalar::Ring;

/// (k, j) of the row of each layer that is nearest to the plane of the section, where one is at most half a row away.
pub(super) fn rows(subject: &Subject<'_>) -> Result<Vec<(i128, i128)>, Error> {
    let pile = subject.pile();
    let forces = subject.packing().forces();
    if pile.dimension() == Dimension::Two {
        return Ok((0..pile.layers()).map(|k| (k, 0)).collect());
    }
    let plane = forces.position(middle(pile, 0)?)?.x;
    let [a, _, c] = pile.directions::<BigRational>();
    let step = a.x - &c.x;
    let half = BigRational::new(1.into(), 2.into());
    let mut rows = Vec::new();
    for k in 0..pile.layers() {
        let region = pile.shape().layer(k)?;
        let first = *region.y().start();
        let site = Site {
            i: region.row(first).start,
            j: first,
            k,
        };
        let apart = (&plane - forces.position(site)?.x) / &step;
        let nearest = apart.round().to_integer().to_i128();
        let Some(j) = nearest.and_then(|steps| first.checked_add(steps)) else {
            continue;
        };
        let j = j.clamp(first, *region.y().end());
        let off = apart - BigRational::from_i128(j - first);
        if off.abs() <= half {
            rows.push((k, j));
        }
    }
    Ok(rows)
}
