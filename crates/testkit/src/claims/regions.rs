//! Regions of any size are tight and nonempty. Small ones have exactly the expected sites.
//!
//! A value of i occurs if the three intervals for j intersect. The oracle eliminates one coordinate after the other, in
//! integers of any size.

use arbitrary::Unstructured;
use cannonpile::Error;
use cannonpile::lattice::{MAX_LAYERS, Region, Sign};
use num_bigint::BigInt;

use super::{Checked, demand, one_line, same};
use crate::generators::region;
use crate::oracles::sets::{Sites, dilated, eroded, within};

/// A bound that lies outside the small regions and everything grown from them.
const REACH: i128 = 9;

/// Any six bounds are tightened or rejected.
pub fn any_bounds(u: &mut Unstructured<'_>) -> Checked {
    let bounds = region::bounds(u)?;
    let [x0, x1, y0, y1, s0, s1] = bounds;
    tightened(bounds, &Region::new(x0..=x1, y0..=y1, s0..=s1))
}

/// Checks a small region and its neighbours, site by site.
pub fn small(u: &mut Unstructured<'_>) -> Checked {
    let region = region::small_region(u)?;
    let [x, y, s] = [region.x(), region.y(), region.s()];
    let bounds = [
        *x.start(),
        *x.end(),
        *y.start(),
        *y.end(),
        *s.start(),
        *s.end(),
    ];
    let sites = within(bounds, REACH);
    walks(&region, &sites)?;
    for sign in [Sign::Plus, Sign::Minus] {
        walks(&region.dilated(sign)?, &dilated(&sites, sign))?;
        let left = eroded(&sites, sign);
        match region.eroded(sign) {
            Some(above) => walks(&above, &left)?,
            None => same("the erosion", &left, &Sites::new())?,
        }
    }
    Ok(())
}

/// The range of attained values of each coordinate. For i it is the intersection of [x₀, x₁] with the range of s − j.
fn attained([x0, x1, y0, y1, s0, s1]: [i128; 6]) -> [[BigInt; 2]; 3] {
    let [x0, x1, y0, y1, s0, s1] = [x0, x1, y0, y1, s0, s1].map(BigInt::from);
    let meet = |[a, b]: [&BigInt; 2], [c, d]: [BigInt; 2]| [a.max(&c).clone(), b.min(&d).clone()];
    [
        meet([&x0, &x1], [&s0 - &y1, &s1 - &y0]),
        meet([&y0, &y1], [&s0 - &x1, &s1 - &x0]),
        meet([&s0, &s1], [&x0 + &y0, &x1 + &y1]),
    ]
}

fn tightened(bounds: [i128; 6], made: &Result<Region, Error>) -> Checked {
    let within_limit = bounds
        .iter()
        .all(|b| (-MAX_LAYERS..=MAX_LAYERS).contains(b));
    let sides = attained(bounds);
    // Nonempty intervals have a common value if each two of them have one.
    let crossed = bounds.chunks(2).any(|pair| pair[0] > pair[1]);
    let empty = crossed || sides.iter().any(|[low, high]| low > high);
    match made {
        Ok(region) => {
            demand(within_limit && !empty, || {
                format!("{bounds:?} are {region}")
            })?;
            let got =
                [region.x(), region.y(), region.s()].map(core::ops::RangeInclusive::into_inner);
            let got = got.map(|(low, high)| [low, high].map(BigInt::from));
            same("the bounds", &got, &sides)?;
            let outside = region
                .corners()
                .into_iter()
                .find(|[i, j]| !region.contains(*i, *j));
            same("a corner outside", &outside, &None)
        }
        Err(refusal) => {
            one_line(refusal)?;
            let right = match refusal {
                Error::RegionTooLarge { .. } => !within_limit,
                Error::EmptyRegion { .. } => within_limit && empty,
                _ => false,
            };
            demand(right, || format!("{bounds:?} are rejected: {refusal}"))
        }
    }
}

/// The region iterates over exactly these sites, in order.
fn walks(region: &Region, sites: &Sites) -> Checked {
    let walked = region.rows(0).flatten().map(|site| (site.j, site.i));
    demand(walked.eq(sites.iter().copied()), || {
        format!("{region} does not have the sites {sites:?}")
    })?;
    same("the count", &region.site_count(), &sites.len().into())
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    const TRIANGLE: [i128; 6] = [0, 3, 0, 3, 0, 3];

    #[test]
    fn loose_bounds_are_caught() {
        let made = |[x0, x1, y0, y1, s0, s1]: [i128; 6]| Region::new(x0..=x1, y0..=y1, s0..=s1);
        let loose = [0, 5, 0, 7, 0, 3];
        assert!(tightened(loose, &made(TRIANGLE)).is_ok());
        for n in 0..6 {
            let mut bounds = TRIANGLE;
            bounds[n] += if n % 2 == 0 { 1 } else { -1 };
            assert!(tightened(TRIANGLE, &made(bounds)).is_err(), "bound {n}");
        }
        let empty = [3, 4, 3, 4, 0, 1];
        assert!(tightened(empty, &made(empty)).is_ok());
        assert!(tightened(empty, &made(TRIANGLE)).is_err());
        assert!(tightened(TRIANGLE, &made(empty)).is_err());
        assert!(tightened(TRIANGLE, &Region::triangle(0)).is_err());
    }

    #[test]
    fn a_missing_site_is_caught() {
        let region = Region::triangle(4).unwrap();
        let mut sites = within(TRIANGLE, REACH);
        assert!(walks(&region, &sites).is_ok());
        sites.remove(&(1, 2));
        assert!(walks(&region, &sites).is_err());
    }
}
