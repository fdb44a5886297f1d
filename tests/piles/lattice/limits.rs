//! Regions near the greatest coordinates, ±10³⁶. Regions beyond this limit are rejected, and nothing overflows within
//! it.

use cannonpile::Error;
use cannonpile::lattice::{Axis, HorizontalContact, MAX_LAYERS, Region, Row, Sign, Site};
use num_bigint::{BigInt, BigUint};

use crate::lattice::region;

const MAX: i128 = MAX_LAYERS;

fn hexagon(p: i128, q: i128) -> Region {
    Region::hexagon(p, q).expect("sides within the limit")
}

/// A hexagon with sides of p and q spheres: the triangle of p + 2(q−1) without three corners of q−1.
fn sites_of_hexagon(p: i128, q: i128) -> BigUint {
    let triangle = |n: BigInt| -> BigInt { &n * (&n + 1) / 2 };
    let (p, q) = (BigInt::from(p), BigInt::from(q));
    let sites: BigInt = triangle(p + 2 * (&q - 1)) - 3 * triangle(q - 1);
    sites.try_into().expect("a count")
}

#[test]
fn the_greatest_regions_are_counted() {
    for [p, q] in [[MAX, MAX], [MAX, 1], [1, MAX], [MAX, 2], [3, 4]] {
        let hexagon = hexagon(p, q);
        assert_eq!(hexagon.site_count(), sites_of_hexagon(p, q), "{p} {q}");
        assert!(
            hexagon
                .corners()
                .iter()
                .all(|[i, j]| hexagon.contains(*i, *j))
        );
        assert_eq!(hexagon.is_its_own_mirror_image(), p == q, "{p} {q}");
        assert_eq!(hexagon.mirrored().mirrored(), hexagon);
        assert_eq!(hexagon.mirrored().site_count(), hexagon.site_count());
    }
    // The largest region. The bounds of i+j cut two corners off the square.
    let all = region([-MAX, MAX, -MAX, MAX, -MAX, MAX]).expect("at the limit");
    let n = BigUint::from(MAX.unsigned_abs());
    assert_eq!(all.site_count(), 3_u32 * &n * &n + 3_u32 * &n + 1_u32);
    let lengths = all.rows(0).take(3).map(|row| row.i.end - row.i.start);
    assert!(lengths.eq([MAX + 1, MAX + 2, MAX + 3]));
}

#[test]
fn bounds_beyond_the_limit_are_rejected() {
    let whole = [-MAX, MAX, -MAX, MAX, -MAX, MAX];
    assert!(region(whole).is_ok());
    for n in 0..6 {
        for beyond in [MAX + 1, -MAX - 1, i128::MAX, i128::MIN] {
            let mut bounds = whole;
            bounds[n] = beyond;
            let refused = region(bounds).expect_err("beyond the limit");
            assert!(matches!(refused, Error::RegionTooLarge { .. }), "{refused}");
            let message = refused.to_string();
            assert!(message.contains(&beyond.to_string()), "{message}");
            assert!(message.contains("+-10^36: use a smaller one"), "{message}");
        }
    }
}

#[test]
fn sides_beyond_the_limit_are_rejected() {
    for side in [0, -1, MAX + 1, i128::MIN, i128::MAX] {
        let want = format!("a side must be at least 1 and at most 10^36 spheres, not {side}");
        for region in [
            Region::triangle(side),
            Region::hexagon(side, 2),
            Region::hexagon(2, side),
        ] {
            let refused = region.expect_err("no region has this side");
            assert!(matches!(refused, Error::RegionSide { given, .. } if given == side));
            assert_eq!(refused.to_string(), want);
        }
    }
}

#[test]
fn dilation_stops_at_the_limit() {
    let near = region([MAX - 2, MAX - 1, -MAX + 1, -MAX + 2, -3, 3]).expect("at the limit");
    for sign in [Sign::Plus, Sign::Minus] {
        assert!(near.dilated(sign).is_ok());
        assert_eq!(
            near.dilated(sign).expect("one step").eroded(sign),
            Some(near)
        );
        for steps in [2, 3, MAX, 3 * MAX, i128::MAX] {
            let refused = near.dilated_by(sign, steps).expect_err("beyond the limit");
            assert!(matches!(refused, Error::RegionTooLarge { .. }), "{refused}");
            assert!(refused.to_string().contains(&near.to_string()));
        }
    }
    let far = Region::SITE
        .dilated_by(Sign::Minus, MAX)
        .expect("at the limit");
    assert_eq!(
        far,
        Region::hexagon(1, MAX).map_or(far, |h| h.dilated(Sign::Minus).expect("one"))
    );
    assert!(far.dilated(Sign::Minus).is_err() && far.dilated(Sign::Plus).is_ok());
}

#[test]
fn erosion_at_the_limit_is_exact() {
    let corner = region([-MAX, -MAX, -MAX, -MAX, -MAX, MAX]);
    assert!(
        matches!(corner, Err(Error::EmptyRegion { .. })),
        "i+j would be −2·10³⁶"
    );
    let corner = region([-MAX, -MAX + 1, 0, 1, -MAX, -MAX + 1]).expect("three sites or four");
    assert_eq!(corner.site_count(), 3_u32.into());
    let top = corner.eroded(Sign::Plus).expect("one site");
    assert_eq!(
        top,
        region([-MAX, -MAX, 0, 0, -MAX, -MAX]).expect("one site")
    );
    assert_eq!(corner.eroded(Sign::Minus), None);
    assert_eq!(top.eroded(Sign::Plus), None);
    assert_eq!(top.eroded(Sign::Minus), None);
}

/// Bounds at the limit, and a run with as many steps.
#[test]
fn lines_are_counted_at_the_limit() {
    let base = hexagon(MAX, MAX);
    let [low, high] = [1 - MAX, MAX - 1];
    for (i, j) in base.corners().map(|[i, j]| (i, j)) {
        for (sign, steps) in [(Sign::Plus, MAX), (Sign::Minus, MAX), (Sign::Plus, 1)] {
            // At least two of the three lines end at a corner.
            let above = base.spheres_above(i, j, sign, steps);
            let ended = above.iter().filter(|n| **n == 0).count();
            assert!(
                ended >= 2 && above.iter().all(|n| (0..=steps).contains(n)),
                "{above:?}"
            );
        }
    }
    assert_eq!(base.spheres_above(0, 0, Sign::Plus, MAX), [high; 3]);
    assert_eq!(base.spheres_above(0, 0, Sign::Minus, MAX), [-low; 3]);
    assert_eq!(base.spheres_above(0, 0, Sign::Minus, 5), [5; 3]);
    for steps in [0, -1, -MAX, i128::MIN] {
        assert_eq!(base.spheres_above(0, 0, Sign::Plus, steps), [0; 3]);
    }
}

/// The neighbour exists exactly if its coordinates fit into `i128`.
#[test]
fn a_neighbour_beyond_the_integers_is_none() {
    for axis in Axis::ALL {
        let neighbour = |i, j, k| {
            let site = Site { i, j, k };
            HorizontalContact { site, axis }.neighbour()
        };
        let Site { i: di, j: dj, .. } = neighbour(0, 0, 0).expect("near");
        for k in [i128::MIN, i128::MAX] {
            for end in [i128::MIN, i128::MAX] {
                let sum = |n: i128, d: i128| n.checked_add(d);
                let there = sum(end, di).zip(sum(end, dj));
                let there = there.map(|(i, j)| Site { i, j, k });
                assert_eq!(neighbour(end, end, k), there, "{axis} {end} {k}");
            }
        }
    }
}

/// A region can grow from one limit to the other, by more steps than one side has coordinates.
#[test]
fn a_region_grows_from_one_limit_to_the_other() {
    let half = MAX / 2;
    let corner = region([-half, -half, -half, -half, -MAX, -MAX]).expect("at the limit");
    let grown = corner
        .dilated_by(Sign::Plus, 3 * half)
        .expect("to the limit");
    let expected = region([-half, MAX, -half, MAX, -MAX, half]).expect("at the limit");
    assert_eq!(grown, expected);
    for steps in [3 * half + 1, 2 * MAX, i128::MAX] {
        let refused = corner.dilated_by(Sign::Plus, steps);
        assert!(
            matches!(refused, Err(Error::RegionTooLarge { .. })),
            "{steps}"
        );
    }
}

/// The last piece has the full length if the row divides evenly, and no piece follows it.
#[test]
fn rows_are_cut_into_pieces() {
    let pieces = |start: i128, end: i128, sites| {
        let i = start..end;
        let pieces = Row { k: 5, j: 1, i }.pieces(sites);
        pieces
            .map(|piece| (piece.i.start, piece.i.end))
            .collect::<Vec<_>>()
    };
    assert_eq!(pieces(-3, 3, 3), [(-3, 0), (0, 3)]);
    assert_eq!(pieces(-3, 4, 3), [(-3, 0), (0, 3), (3, 4)]);
    assert_eq!(pieces(2, 4, 3), [(2, 4)]);
    assert_eq!(pieces(2, 2, 3), []);
    assert_eq!(pieces(MAX - 1, MAX, 1), [(MAX - 1, MAX)]);
}
