//! Limits of stackings, regions and row iterators.

use std::panic::catch_unwind;

use cannonpile::Error;
use cannonpile::lattice::{Dimension, Region, Sign};
use cannonpile::shape::{Selection, Shape};
use cannonpile::stacking::{MAX_RUNS, Run, Stacking};

fn has_too_many_runs(made: &Result<Stacking, Error>) -> bool {
    matches!(
        made,
        Err(Error::TooManyRuns {
            limit: MAX_RUNS,
            ..
        })
    )
}

/// All notations share the limit.
#[test]
fn the_limit_of_runs_holds_in_every_notation() {
    let runs = MAX_RUNS + 1;
    let hagg = "+-".repeat(runs / 2) + "+";
    assert_eq!(hagg.len(), runs);
    let zhdanov = format!("({}1)", "1,".repeat(runs - 1));
    assert!(has_too_many_runs(&hagg.parse()), "in Hägg's notation");
    assert!(has_too_many_runs(&zhdanov.parse()), "in Zhdanov's notation");
}

#[test]
fn the_limit_of_runs_holds_for_runs_and_signs() {
    let signs = || [Sign::Plus, Sign::Minus].into_iter().cycle();
    let from_signs = Stacking::from_signs(signs().take(MAX_RUNS + 1));
    assert!(has_too_many_runs(&from_signs), "from_signs");
    let runs = signs().map(|sign| Run { sign, steps: 2 });
    let from_runs = Stacking::from_runs(runs.take(MAX_RUNS + 1));
    assert!(has_too_many_runs(&from_runs), "from_runs");
}

#[test]
fn the_limit_of_runs_holds_for_dhcp() {
    // A million runs of two steps, and one of a single step.
    let layers = 2 * i128::try_from(MAX_RUNS).expect("small") + 2;
    assert!(Stacking::dhcp(layers - 1).is_ok());
    assert!(has_too_many_runs(&Stacking::dhcp(layers)), "dhcp({layers})");
}

/// A region is never empty, for any argument.
#[test]
fn dilation_never_returns_an_empty_region() {
    for sign in [Sign::Plus, Sign::Minus] {
        let region = Region::SITE.dilated_by(sign, -1);
        let kept = region.as_ref().is_ok_and(|r| r.x().is_empty());
        assert!(!kept, "{region:?}");
    }
}

#[test]
fn any_site_is_a_valid_query() {
    for [i, j] in [[i128::MIN; 2], [i128::MAX; 2], [i128::MIN, i128::MAX]] {
        for sign in [Sign::Plus, Sign::Minus] {
            let result = catch_unwind(|| Region::SITE.spheres_above(i, j, sign, 5));
            assert!(result.is_ok(), "spheres_above({i}, {j}, {sign:?}, 5)");
        }
    }
}

#[test]
fn rows_of_the_base_without_the_floor_are_empty() {
    let pyramid = Shape::pyramid(3, Dimension::Three).expect("three layers");
    let mut rows = pyramid.rows(Selection::Base).expect("a base");
    rows.next();
    let rows = rows.off_the_floor();
    assert_eq!(rows.clone().count(), 0);
    let sites = catch_unwind(|| rows.site_count());
    assert_eq!(sites.ok(), Some(0_u32.into()));
}
