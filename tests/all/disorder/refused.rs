//! What is refused, with the remedy.

use cannonpile::disorder::{FirstSign, RandomPiles, RandomStackings};
use cannonpile::lattice::{MAX_LAYERS, Region, Site};
use cannonpile::{Culprit, Error};

use crate::support::answers::ratio;

fn stackings(layers: i128) -> RandomStackings {
    RandomStackings::new(layers, FirstSign::Plus).unwrap()
}

fn one() -> num_rational::BigRational {
    ratio(1, 1)
}

fn site(i: i128, j: i128, k: i128) -> Site {
    Site { i, j, k }
}

fn says(error: &Error, culprit: Culprit, parts: &[&str]) {
    let message = error.to_string();
    assert!(!message.chars().any(char::is_control), "{message:?}");
    for part in parts {
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
    assert_eq!(error.culprit(), Some(culprit), "{message}");
}

#[test]
fn layers() {
    for layers in [0, -1, MAX_LAYERS + 1] {
        let error = RandomStackings::new(layers, FirstSign::Plus).unwrap_err();
        says(&error, Culprit::Layers, &[&layers.to_string()]);
    }
    let error = stackings(10_001).registry(&0.5).unwrap_err();
    says(&error, Culprit::Layers, &["10001", "10000", "fewer"]);
}

#[test]
fn loads() {
    let under = RandomPiles::under(Region::SITE, stackings(4));
    let error = under.clone().with_load(site(0, 0, 1), one()).unwrap_err();
    says(&error, Culprit::Load, &["(0,0,1)", "k = 0"]);
    let error = under.clone().with_load(site(1, 0, 0), one()).unwrap_err();
    assert!(matches!(error, Error::SiteOutside { .. }));
    let error = under.with_load(site(0, 0, 0), ratio(-1, 2)).unwrap_err();
    says(&error, Culprit::Load, &["-1/2", "negative"]);
    let on = RandomPiles::on(Region::triangle(4).unwrap(), stackings(3));
    let error = on.with_load(site(0, 0, 0), one()).unwrap_err();
    says(&error, Culprit::Load, &["leave loads out"]);
    let plane = RandomPiles::plane(stackings(4));
    let error = plane
        .with_load(site(MAX_LAYERS + 1, 0, 0), one())
        .unwrap_err();
    assert!(matches!(error, Error::SiteOutside { .. }));
}

#[test]
fn the_plane_bears_loads_alone() {
    let plane = RandomPiles::plane(stackings(4));
    let loaded = plane.clone().with_load(site(0, 0, 0), one()).unwrap();
    says(
        &loaded.mean(&0.5).unwrap_err(),
        Culprit::Weightless,
        &["weightless"],
    );
    let error = plane.weightless().by_faults().unwrap_err();
    says(&error, Culprit::Load, &["put a load"]);
    let heavy = RandomPiles::under(Region::SITE, stackings(4));
    says(
        &heavy.mean_square(&0.5).unwrap_err(),
        Culprit::Weightless,
        &["mean square"],
    );
    says(
        &heavy.pair_moments(&0.5).unwrap_err(),
        Culprit::Weightless,
        &["pair moments"],
    );
}

#[test]
fn probabilities() {
    let piles = RandomPiles::under(Region::SITE, stackings(4));
    let by_faults = piles.by_faults().unwrap();
    for q in [ratio(-1, 9), ratio(10, 9)] {
        let error = piles.exact(&q).unwrap_err();
        says(
            &error,
            Culprit::FaultProbability,
            &[&q.to_string(), "at least 0 and at most 1"],
        );
        assert_eq!(by_faults.at(&q).unwrap_err(), error);
    }
    for q in [f64::NAN, f64::INFINITY] {
        assert!(matches!(
            piles.mean(&q).unwrap_err(),
            Error::Overflow { scalar: "f64", .. }
        ));
    }
}

#[test]
fn what_no_memory_holds() {
    let large = [
        RandomPiles::under(Region::SITE, stackings(MAX_LAYERS)),
        RandomPiles::under(Region::hexagon(MAX_LAYERS, 1).unwrap(), stackings(2)),
        RandomPiles::on(Region::triangle(MAX_LAYERS).unwrap(), stackings(2)),
        RandomPiles::on(Region::triangle(3000).unwrap(), stackings(100)),
        RandomPiles::under(Region::SITE, stackings(5000)),
        RandomPiles::plane(stackings(5000))
            .weightless()
            .with_load(site(0, 0, 0), one())
            .unwrap(),
        {
            let far = site(MAX_LAYERS, -MAX_LAYERS, 0);
            let plane = RandomPiles::plane(stackings(3)).weightless();
            let plane = plane.with_load(far, one()).unwrap();
            plane.with_load(site(0, 0, 0), one()).unwrap()
        },
    ];
    for piles in large {
        for error in [
            piles.mean(&0.5).unwrap_err(),
            piles.exact(&ratio(1, 3)).unwrap_err(),
            piles.by_faults().unwrap_err(),
        ] {
            says(&error, Culprit::Layers, &["more than", "fewer layers"]);
        }
    }
    let plane = RandomPiles::plane(stackings(60)).weightless();
    let plane = plane.with_load(site(0, 0, 0), one()).unwrap();
    says(
        &plane.pair_moments(&0.5).unwrap_err(),
        Culprit::Layers,
        &["mean square"],
    );
    let plane = RandomPiles::plane(stackings(5000)).weightless();
    let plane = plane.with_load(site(0, 0, 0), one()).unwrap();
    says(
        &plane.mean_square(&0.5).unwrap_err(),
        Culprit::Layers,
        &["fewer"],
    );
}

/// Far from the origin all is the same.
#[test]
fn far_away() {
    let far = site(MAX_LAYERS, -MAX_LAYERS, 0);
    let plane = RandomPiles::plane(stackings(3)).weightless();
    let near = plane.clone().with_load(site(0, 0, 0), one()).unwrap();
    let far = plane.with_load(far, one()).unwrap();
    let numbers = |piles: &RandomPiles| {
        let rows = piles.mean(&0.25).unwrap().into_rows().into_iter();
        rows.map(|row| (row.probability, row.normal, row.shear_x))
            .collect::<Vec<_>>()
    };
    assert_eq!(numbers(&near), numbers(&far));
    let top = Region::new(
        MAX_LAYERS - 1..=MAX_LAYERS,
        -MAX_LAYERS..=1 - MAX_LAYERS,
        -9..=9,
    )
    .unwrap();
    let far = RandomPiles::under(top, stackings(4));
    let same = Region::new(0..=1, 0..=1, 0..=2).unwrap();
    assert_eq!(
        numbers(&far),
        numbers(&RandomPiles::under(same, stackings(4)))
    );
}

#[test]
fn a_base_that_carries_no_stacking_so_high() {
    let base = Region::triangle(4).unwrap();
    for layers in [5, 1000, MAX_LAYERS] {
        let error = RandomPiles::on(base, stackings(layers))
            .mean(&0.5)
            .unwrap_err();
        says(
            &error,
            Culprit::Layers,
            &[&layers.to_string(), "the highest has 4", "0..3,0..3,0..3"],
        );
        assert_eq!(error.conflicts_with(), Some(Culprit::Base));
    }
    // Four layers of this triangle begin with +.
    let minus = RandomStackings::new(4, FirstSign::Minus).unwrap();
    let error = RandomPiles::on(base, minus).mean(&0.5).unwrap_err();
    says(&error, Culprit::Layers, &["4 layers", "the highest has 3"]);
    let hexagon = Region::hexagon(3, 3).unwrap();
    assert!(RandomPiles::on(hexagon, stackings(5)).mean(&0.5).is_ok());
    assert!(RandomPiles::on(hexagon, stackings(6)).mean(&0.5).is_err());
}
