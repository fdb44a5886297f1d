//! A region of any size dilates and erodes as its set of sites does, site by site.

use arbitrary::Unstructured;
use cannonpile::Error;
use cannonpile::lattice::{Direction, MAX_LAYERS, Region, Sign};

use super::numbered::first_of;
use super::{Checked, demand, one_line, same};
use crate::generators::region;

/// Checks one step down and up again, and many steps down, at single sites.
pub fn grown(u: &mut Unstructured<'_>) -> Checked {
    let region = region::region(u)?;
    let sign = *u.choose(&[Sign::Plus, Sign::Minus])?;
    let site = region::site_about(u, &region)?;
    let steps = u.int_in_range(0..=2 * MAX_LAYERS)? >> u.int_in_range(0..=127)?;
    let below = region.dilated(sign);
    if let Ok(below) = &below {
        let again = below.eroded(sign);
        same("erosion of the dilation", &again, &Some(region))?;
        dilation_has_the_supports(&region, below, sign, site)?;
    }
    if let Some(above) = region.eroded(sign) {
        dilation_has_the_supports(&above, &above.dilated(sign)?, sign, site)?;
        erosion_has_the_supported(&region, Some(&above), sign, site)?;
    } else {
        erosion_has_the_supported(&region, None, sign, site)?;
    }
    match region.dilated_by(sign, steps) {
        Ok(last) => lines_end_at_the_surface(&region, &last, sign, steps, site),
        Err(refusal) => {
            one_line(&refusal)?;
            // Dilation may fail only near the limit. Here some bound is further than `steps` from it.
            let furthest = [region.x(), region.y(), region.s()].map(|side| match sign {
                Sign::Plus => *side.end(),
                Sign::Minus => -*side.start(),
            });
            let most = furthest.into_iter().max().unwrap_or_default();
            demand(most + steps > MAX_LAYERS, || {
                format!("{region} rejects {steps} steps of {sign:?}: {refusal}")
            })
        }
    }
}

/// A site is in the layer below exactly if it supports a site in `above`.
fn dilation_has_the_supports(
    above: &Region,
    below: &Region,
    sign: Sign,
    [i, j]: [i128; 2],
) -> Checked {
    let is_support = Direction::ALL.iter().any(|direction| {
        let [di, dj] = sign.descent(*direction);
        above.contains(i - di, j - dj)
    });
    demand(below.contains(i, j) == is_support, || {
        format!("({i}, {j}) below {above}, {sign:?}: {below}")
    })
}

/// A site is in the layer above exactly if all its three supports are in `below`.
fn erosion_has_the_supported(
    below: &Region,
    above: Option<&Region>,
    sign: Sign,
    [i, j]: [i128; 2],
) -> Checked {
    let is_supported = Direction::ALL.iter().all(|direction| {
        let [di, dj] = sign.descent(*direction);
        below.contains(i + di, j + dj)
    });
    let kept = above.is_some_and(|above| above.contains(i, j));
    demand(kept == is_supported, || {
        format!("({i}, {j}) above {below}, {sign:?}: {above:?}")
    })
}

/// The last sphere on a line lies n steps up, and the next step leaves the pile. The site is moved into the last layer
/// first.
fn lines_end_at_the_surface(
    top: &Region,
    last: &Region,
    sign: Sign,
    steps: i128,
    [i, j]: [i128; 2],
) -> Checked {
    let inside = |j: i128| j.clamp(*last.y().start(), *last.y().end());
    let row = first_of(last, 0, inside(j))?;
    let (i, j) = (i.clamp(row.i.start, row.i.end - 1), row.j);
    let above = last.spheres_above(i, j, sign, steps);
    for direction in Direction::ALL {
        let [di, dj] = sign.descent(direction);
        let n = above[direction.index()];
        demand((0..=steps).contains(&n), || {
            format!("{n} spheres above in {steps} steps")
        })?;
        let there = |up: i128| -> Result<bool, Error> {
            let layer = top.dilated_by(sign, steps - up)?;
            Ok(layer.contains(i - di * up, j - dj * up))
        };
        let ends = n == steps || !there(n + 1)?;
        demand(there(n)? && ends, || {
            format!("{n} spheres above ({i}, {j}) along {direction}, {steps} steps under {top}")
        })?;
    }
    Ok(())
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    #[test]
    fn a_wrong_dilation_is_caught() {
        let region = Region::triangle(4).unwrap();
        let [plus, minus] = [Sign::Plus, Sign::Minus].map(|sign| region.dilated(sign).unwrap());
        let corner = [4, 0];
        assert!(dilation_has_the_supports(&region, &plus, Sign::Plus, corner).is_ok());
        assert!(dilation_has_the_supports(&region, &minus, Sign::Plus, corner).is_err());
        let [plus, minus] = [Sign::Plus, Sign::Minus].map(|sign| region.eroded(sign));
        let corner = [2, 0];
        assert!(erosion_has_the_supported(&region, plus.as_ref(), Sign::Plus, corner).is_ok());
        assert!(erosion_has_the_supported(&region, minus.as_ref(), Sign::Plus, corner).is_err());
        assert!(erosion_has_the_supported(&region, None, Sign::Plus, corner).is_err());
    }

    #[test]
    fn a_wrong_line_is_caught() {
        let top = Region::triangle(2).unwrap();
        let last = top.dilated_by(Sign::Plus, 5).unwrap();
        assert!(lines_end_at_the_surface(&top, &last, Sign::Plus, 5, [1, 1]).is_ok());
        let lower = top.dilated_by(Sign::Plus, 6).unwrap();
        assert!(lines_end_at_the_surface(&top, &lower, Sign::Plus, 5, [1, 1]).is_err());
    }
}
