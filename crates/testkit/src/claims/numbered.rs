//! The sphere numbers of a pile of any size have no gap across rows, layers and sign changes.

use arbitrary::Unstructured;
use cannonpile::Error;
use cannonpile::lattice::{MAX_LAYERS, Region, Row, Site};
use cannonpile::shape::Shape;
use cannonpile::stacking::Stacking;
use num_bigint::{BigInt, BigUint};

use super::{Checked, same};
use crate::generators::{pile, rarely, region, stacking};

/// Checks a row of any pile: its spheres, the next sphere, and the first sphere of its layer.
pub fn any_pile(u: &mut Unstructured<'_>) -> Checked {
    let Some(shape) = tall_shape(u)? else {
        return Ok(());
    };
    let floor = shape.layers() - 1;
    let k = match u.int_in_range(0..=2)? {
        0 => u.int_in_range(0..=floor)?,
        1 => u.int_in_range(0..=floor.min(6))?,
        _ => floor - u.int_in_range(0..=floor.min(6))?,
    };
    let layer = shape.layer(k)?;
    let [low, high] = [*layer.y().start(), *layer.y().end()];
    let j = u.int_in_range(low..=high)?;
    let first = first_of(&layer, k, j)?;
    has_consecutive_numbers(&first, &shape, |site| shape.before(site))
}

/// The number after the last sphere of a row belongs to the next sphere.
fn has_consecutive_numbers(
    row: &Row,
    shape: &Shape,
    before: impl Fn(Site) -> Result<BigUint, Error>,
) -> Checked {
    let Row { k, j, ref i } = *row;
    let [first, last] = [i.start, i.end - 1].map(|i| Site { i, j, k });
    let length = BigInt::from(i.end - i.start);
    let [at_first, at_last] = [before(first)?, before(last)?].map(BigInt::from);
    let after = at_first.clone() + length;
    same("the number after the row", &(at_last + 1), &after)?;
    let layer = shape.layer(k)?;
    let next = if j < *layer.y().end() {
        Some((k, first_of(&layer, k, j + 1)?))
    } else if k + 1 < shape.layers() {
        let below = shape.layer(k + 1)?;
        Some((k + 1, first_of(&below, k + 1, *below.y().start())?))
    } else {
        None
    };
    let next = next.map(|(k, row)| Site {
        i: row.i.start,
        j: row.j,
        k,
    });
    let number = match next {
        Some(next) => before(next)?,
        None => shape.sphere_count(),
    };
    same("the next number", &number.into(), &after)?;
    let above = (k > 0).then(|| shape.layer(k - 1)).transpose()?;
    let start = Site {
        i: first_of(&layer, k, *layer.y().start())?.i.start,
        j: *layer.y().start(),
        k,
    };
    let before_above = above.map_or(Ok(BigUint::default()), |above| {
        let row = first_of(&above, k - 1, *above.y().start())?;
        Ok::<_, Error>(
            before(Site {
                i: row.i.start,
                j: row.j,
                k: k - 1,
            })? + above.site_count(),
        )
    })?;
    same(
        "the number that a layer begins with",
        &before(start)?,
        &before_above,
    )
}

/// A shape that grows down from any region, or up from a wider base. The base has additional sites on each side, few or
/// many, so some of its sides vanish with the height. Some are the shapes of straight piles, discs among them. `None` if the runs are invalid or exceed the limit.
fn tall_shape(u: &mut Unstructured<'_>) -> arbitrary::Result<Option<Shape>> {
    if rarely(u, 4)? {
        return Ok(Some(pile::pile(u)?.shape().clone()));
    }
    let top = region::region(u)?;
    let made =
        Stacking::from_runs(stacking::runs(u)?).and_then(|stacking| Shape::under(top, stacking));
    let Ok(shape) = made else {
        return Ok(None);
    };
    if u.arbitrary()? {
        return Ok(Some(shape));
    }
    let base = shape.base();
    // The extra width is small, similar to the height, or much larger.
    let most = [9, shape.layers(), MAX_LAYERS / 2][u.choose_index(3)?];
    let mut sides = [base.x(), base.y(), base.s()];
    for side in &mut sides {
        let [low, high] = [u.int_in_range(0..=most)?, u.int_in_range(0..=most)?];
        *side = side.start() - low..=side.end() + high;
    }
    let [x, y, s] = sides;
    let base = Region::new(x, y, s).unwrap_or(base);
    Ok(Shape::on(base, shape.stacking().clone()).ok())
}

/// The row j of a layer, from its ends.
pub fn first_of(layer: &Region, k: i128, j: i128) -> Result<Row, Error> {
    let only = Region::new(layer.x(), j..=j, layer.s())?;
    let (start, end) = only.x().into_inner();
    Ok(Row {
        k,
        j,
        i: start..end + 1,
    })
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    #[test]
    fn numbers_with_a_gap_are_caught() {
        let shape = Shape::under(Region::SITE, "+-".parse().unwrap()).unwrap();
        let row = first_of(&shape.layer(1).unwrap(), 1, 1).unwrap();
        assert!(has_consecutive_numbers(&row, &shape, |site| shape.before(site)).is_ok());
        let off = |site: Site| Ok(shape.before(site)? + u32::from(site.k == 2));
        assert!(has_consecutive_numbers(&row, &shape, off).is_err());
    }
}
