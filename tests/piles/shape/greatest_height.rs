//! The number of layers that a base supports, and closed counts of piles whose sides vanish on the way up.
//!
//! On the way up, the sides of a layer vanish at different heights, and the count then follows another polynomial. The tests
//! enumerate all such cases in a box.

use cannonpile::Error;
use cannonpile::lattice::{Region, Row, Sign, Site};
use cannonpile::shape::{Selection, Shape};
use cannonpile::stacking::{Run, Stacking};

use crate::lattice::{each_bounds, each_signs, random_bounds, region, sites_of};
use cannonpile_testkit::oracles::sets::{Sites, on};

/// Checks the pile that is as high as `signs` permit: its closed counts equal those of the sets. For a higher pile, the
/// error must name this height.
fn fits_exactly(base: Region, signs: &[Sign]) {
    let layers = on(sites_of(&base), signs);
    let carried = layers.iter().rev().take_while(|layer| !layer.is_empty());
    let (most, wanted) = (carried.count(), layers.len());
    let stacking = Stacking::from_signs(signs.iter().copied()).expect("short");
    let made = Shape::on(base, stacking.clone());
    if most < wanted {
        let [layers, greatest] = [wanted, most].map(|n| i128::try_from(n).expect("few"));
        let refused = made.expect_err("a pile that is too high");
        let Error::TooHigh {
            layers: named,
            greatest: most,
            base: of,
            ..
        } = &refused
        else {
            panic!("{stacking:?}: {refused:?}");
        };
        assert_eq!(
            (*named, *most, **of),
            (layers, greatest, base),
            "{stacking:?}"
        );
        let message = refused.to_string();
        let remedy =
            format!("on the base {base}: with this stacking it carries at most {greatest}");
        assert!(message.contains(&remedy), "{message}");
    } else {
        counts(&made.expect("it fits"), &layers);
    }
}

/// The closed counts of all spheres, and of the spheres before the first of each row.
fn counts(shape: &Shape, layers: &[Sites]) {
    let all: usize = layers.iter().map(Sites::len).sum();
    assert_eq!(shape.sphere_count(), all.into(), "{shape:?}");
    let mut before: usize = 0;
    for row in shape.rows(Selection::All).expect("all") {
        let Row { k, j, i } = row;
        let first = Site { i: i.start, j, k };
        assert_eq!(shape.before(first), Ok(before.into()), "{first} {shape:?}");
        before += usize::try_from(i.end - i.start).expect("short");
    }
    assert_eq!(before, all, "{shape:?}");
}

/// Straight stackings of either sign up to the last layer.
#[test]
fn straight_on_every_small_base() {
    each_bounds(2, |bounds| {
        if let Ok(base) = region(bounds) {
            for sign in [Sign::Plus, Sign::Minus] {
                (0..=5).for_each(|steps| fits_exactly(base, &vec![sign; steps]));
            }
        }
    });
}

#[test]
fn straight_on_random_bases() {
    random_bounds(12, 300, |bounds| {
        if let Ok(base) = region(bounds) {
            for sign in [Sign::Plus, Sign::Minus] {
                (0..=13).for_each(|steps| fits_exactly(base, &vec![sign; steps]));
            }
        }
    });
}

/// All bases of up to four sites a side, with all bounds on i+j that cut off their corners. Each base has every stacking
/// that fits and every one that is too high.
#[test]
fn every_stacking_on_every_base_in_a_box() {
    let widths = (0..4).flat_map(|x| (0..4).map(move |y| (x, y)));
    let boxes = widths.flat_map(|(x, y)| (0..=x + y).map(move |s0| (x, y, s0)));
    for (x, y, s0) in boxes {
        for s1 in s0..=x + y {
            let Ok(base) = region([0, x, 0, y, s0, s1]) else {
                continue;
            };
            for steps in 0..=4 {
                each_signs(steps).for_each(|signs| fits_exactly(base, &signs));
            }
        }
    }
}

/// Every stacking that fits, and every one that is too high.
#[test]
fn every_stacking_on_random_bases() {
    random_bounds(4, 40, |bounds| {
        if let Ok(base) = region(bounds) {
            for steps in 0..=5 {
                each_signs(steps).for_each(|signs| fits_exactly(base, &signs));
            }
        }
    });
}

/// The runs are so long that several sides vanish within one run. Newton's differences then sum each piece.
#[test]
fn long_runs_on_random_bases() {
    random_bounds(20, 120, |bounds| {
        let Ok(base) = region(bounds) else {
            return;
        };
        for [top, middle, bottom] in [[0, 3, 9], [4, 1, 7], [9, 3, 1], [2, 8, 3], [12, 0, 5]] {
            let of = |sign: Sign, steps: usize| vec![sign; steps];
            let signs = [
                of(Sign::Minus, top),
                of(Sign::Plus, middle),
                of(Sign::Minus, bottom),
            ];
            fits_exactly(base, &signs.concat());
        }
    });
}

/// A tetrahedron fits on the greatest triangle. One more layer does not.
#[test]
fn the_greatest_base() {
    let n = 10_i128.pow(36);
    let base = Region::triangle(n).expect("a side");
    let tetrahedron =
        Shape::on(base, Stacking::fcc(n).expect("a valid number of layers")).expect("it fits");
    let pyramid = Shape::under(
        Region::SITE,
        Stacking::fcc(n).expect("a valid number of layers"),
    );
    assert_eq!(
        tetrahedron.sphere_count(),
        pyramid.expect("it fits").sphere_count()
    );
    assert_eq!(tetrahedron.layer(0), Ok(Region::SITE));
    // The inverted pile loses two sites a side in each layer, because it uses every third hole of the triangle.
    let run = |sign, steps| Run { sign, steps };
    let flipped = Stacking::from_runs([run(Sign::Minus, n - 1)]).expect("a valid number of layers");
    let refused = Shape::on(base, flipped).expect_err("too high");
    let greatest = (n - 1) / 2 + 1;
    assert!(
        matches!(refused, Error::TooHigh { greatest: most, .. } if most == greatest),
        "{refused}"
    );
}
