//! The positions of the spheres, by rows: the first sphere of each row, and the step between neighbours.

use cannonpile::engine::bug;
use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile_dem::{Error, NumberedPile};
use serde_json::{Value, json};

use super::encoding::floats;
use crate::subject::difference;

/// Returns the rows of spheres, in the order of their numbers.
///
/// Indices and positions are relative to the first sphere of the pile, so that both stay exact at a distance of 10³⁰ R from
/// the apex. Each row also has the numbers of the spheres below its first one.
pub(super) fn rows(pile: &NumberedPile<'_>) -> Result<Value, Error> {
    let mut rows = pile.pile().rows(Selection::All)?;
    let first = rows.next().ok_or_else(|| bug("a pile has a row"))?;
    let origin = Site {
        i: first.i.start,
        j: first.j,
        k: first.k,
    };
    let mut step = None;
    let (mut layers, mut i, mut j, mut counts) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut places = [Vec::new(), Vec::new(), Vec::new()];
    let centre = pile.packing().position(origin)?;
    for row in pile.pile().rows(Selection::All)? {
        let site = Site {
            i: row.i.start,
            j: row.j,
            k: row.k,
        };
        layers.push(small(site.k)?);
        i.push(small(site.i - origin.i)?);
        j.push(small(site.j - origin.j)?);
        counts.push(small(row.i.end - row.i.start)?);
        let own = pile.packing().position(site)?;
        if step.is_none() && row.i.end - row.i.start > 1 {
            let i = site.i + 1;
            let next = pile.packing().position(Site { i, ..site })?;
            let steps = own
                .iter()
                .zip(next)
                .map(|(from, to)| Ok(difference(&to, from)?));
            step = Some(floats(steps)?);
        }
        let from = centre.iter().zip(own);
        for (along, (from, to)) in places.iter_mut().zip(from) {
            along.push(Ok(difference(&to, from)?));
        }
    }
    let mut below = Vec::new();
    for row in pile.linked_rows()? {
        below.push(row?.below.into_iter().map(|(_, id)| id).collect::<Vec<_>>());
    }
    let [x, y, z] = places;
    Ok(json!({
        "origin": { "i": origin.i.to_string(), "j": origin.j.to_string() },
        "k": layers,
        "i": i,
        "j": j,
        "spheres": counts,
        "step": step.map_or_else(|| floats([0.0; 3].map(Ok)), Ok)?,
        "x": floats(x)?,
        "y": floats(y)?,
        "z": floats(z)?,
        "below": below,
    }))
}

/// Converts an index relative to the first sphere. It is small, because the viewer limits the number of spheres.
fn small(index: i128) -> Result<i64, Error> {
    i64::try_from(index).map_err(|_| bug("the indices of a pile in a viewer fit in i64").into())
}
