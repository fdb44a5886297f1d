//! Errors and their remedies.

use cannonpile::Error as Core;
use cannonpile::lattice::{MAX_LAYERS, Region, Site};
use cannonpile_disorder::{Error, FirstSign, RandomPiles, RandomStackings};
use cannonpile_testkit::errors::says;

use cannonpile_testkit::answers::ratio;

fn stackings(layers: i128) -> RandomStackings {
    RandomStackings::new(layers, FirstSign::Plus).unwrap()
}

fn one() -> num_rational::BigRational {
    ratio(1, 1)
}

fn site(i: i128, j: i128, k: i128) -> Site {
    Site { i, j, k }
}

/// Asserts the kind of an error. Its message must be one line that contains all these parts.
macro_rules! is_refused {
    ($error:expr, $kind:pat, $parts:expr) => {{
        let error: &Error = &$error;
        assert!(matches!(error, $kind), "{error:?}");
        says(error, $parts);
    }};
}

#[test]
fn layers_are_limited() {
    for layers in [0, -1, MAX_LAYERS + 1] {
        let error = RandomStackings::new(layers, FirstSign::Plus).unwrap_err();
        is_refused!(
            error,
            Error::Core(Core::Layers { .. }),
            &[&layers.to_string()]
        );
    }
    let error = stackings(10_001).registry(&0.5).unwrap_err();
    is_refused!(
        error,
        Error::Core(Core::TooLarge { .. }),
        &["10001", "10000", "fewer"]
    );
}

#[test]
fn invalid_loads_are_rejected() {
    let under = RandomPiles::under(Region::SITE, stackings(4));
    let error = under.clone().with_load(site(0, 0, 1), one()).unwrap_err();
    is_refused!(
        error,
        Error::PlaceOfLoad { on_base: false, .. },
        &["(0,0,1)", "k = 0"]
    );
    let error = under.clone().with_load(site(1, 0, 0), one()).unwrap_err();
    assert!(matches!(error, Error::Core(Core::SiteOutside { .. })));
    let error = under.with_load(site(0, 0, 0), ratio(-1, 2)).unwrap_err();
    is_refused!(
        error,
        Error::Core(Core::NegativeLoad { .. }),
        &["-1/2", "negative"]
    );
    let on = RandomPiles::on(Region::triangle(4).unwrap(), stackings(3));
    let error = on.with_load(site(0, 0, 0), one()).unwrap_err();
    is_refused!(
        error,
        Error::PlaceOfLoad { on_base: true, .. },
        &["remove the loads"]
    );
    let plane = RandomPiles::plane(stackings(4));
    let error = plane
        .with_load(site(MAX_LAYERS + 1, 0, 0), one())
        .unwrap_err();
    assert!(matches!(error, Error::Core(Core::SiteOutside { .. })));
}

#[test]
fn responses_need_loads_and_weightless_spheres() {
    let plane = RandomPiles::plane(stackings(4));
    let loaded = plane.clone().with_load(site(0, 0, 0), one()).unwrap();
    is_refused!(
        loaded.mean(&0.5).unwrap_err(),
        Error::NotAResponse {
            weightless: false,
            ..
        },
        &["weightless"]
    );
    let error = plane.weightless().by_faults().unwrap_err();
    is_refused!(
        error,
        Error::NotAResponse {
            weightless: true,
            ..
        },
        &["add a load"]
    );
    let heavy = RandomPiles::under(Region::SITE, stackings(4));
    is_refused!(
        heavy.mean_square(&0.5).unwrap_err(),
        Error::NotAResponse {
            weightless: false,
            ..
        },
        &["mean square"]
    );
}

#[test]
fn probabilities_are_checked() {
    let piles = RandomPiles::under(Region::SITE, stackings(4));
    let by_faults = piles.by_faults().unwrap();
    for q in [ratio(-1, 9), ratio(10, 9)] {
        let error = piles.exact(&q).unwrap_err();
        is_refused!(
            error,
            Error::FaultProbability { .. },
            &[&q.to_string(), "at least 0 and at most 1"]
        );
        assert_eq!(by_faults.at(&q).unwrap_err(), error);
    }
    for q in [f64::NAN, f64::INFINITY] {
        assert!(matches!(
            piles.mean(&q).unwrap_err(),
            Error::Core(Core::Overflow { scalar: "f64", .. })
        ));
    }
}

#[test]
fn memory_is_limited() {
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
            is_refused!(
                error,
                Error::Core(Core::TooLarge { .. }),
                &["more than", "fewer layers"]
            );
        }
    }
    let plane = RandomPiles::plane(stackings(5000)).weightless();
    let plane = plane.with_load(site(0, 0, 0), one()).unwrap();
    is_refused!(
        plane.mean_square(&0.5).unwrap_err(),
        Error::Core(Core::TooLarge { .. }),
        &["fewer"]
    );
}

/// Returns the quantity, its size and the limit.
fn too_large<T: std::fmt::Debug>(answer: Result<T, Error>) -> (&'static str, u64, u64) {
    let Error::Core(Core::TooLarge {
        quantity,
        needed,
        limit,
        ..
    }) = answer.unwrap_err()
    else {
        panic!("it is too large");
    };
    (quantity, u64::try_from(needed).unwrap(), limit)
}

/// A plane has (2n+3)² cells. The size is the number of stored numbers, plus n. The limit is divided by the words of
/// each number.
#[test]
fn size_errors_state_the_size() {
    const MEAN: &str = "the mean over random stackings";
    let plane = |layers, first| {
        let stackings = RandomStackings::new(layers, first).unwrap();
        let plane = RandomPiles::plane(stackings).weightless();
        plane.with_load(site(0, 0, 0), one()).unwrap()
    };
    let under = |layers| RandomPiles::under(Region::SITE, stackings(layers));
    let half = ratio(1, 2);
    // Three contacts, two signs and two layers, in 10001² cells.
    let needed = 10_001 * 10_001 * 12 + 4999;
    for piles in [plane(5000, FirstSign::Plus), under(5000)] {
        let found = too_large(piles.mean(&0.5));
        assert_eq!(found, (MEAN, needed, 100_000_000));
        assert_eq!(too_large(piles.exact(&half)), found);
    }
    // There are 4999 numbers of faults, and each determines the sign.
    let needed = 10_001 * 10_001 * 6 * 4999 + 4999;
    assert_eq!(
        too_large(plane(5000, FirstSign::Plus).by_faults()),
        (MEAN, needed, 100_000_000)
    );
    let needed = 10_001 * 10_001 * 12 * 4999 + 4999;
    assert_eq!(
        too_large(plane(5000, FirstSign::Random).by_faults()),
        (MEAN, needed, 100_000_000)
    );
    // The greatest 3^d C(99,d) has 195 bits. It needs three words, and a big integer needs six more.
    let needed = 203 * 203 * 6 * 100 + 100;
    assert_eq!(
        too_large(plane(101, FirstSign::Plus).by_faults()),
        (MEAN, needed, 100_000_000 / 9)
    );
    // The bound of 6^999 is 3 bits per step: 2997 bits, or 46 words.
    let needed = 2003 * 2003 * 12 + 1000;
    assert_eq!(
        too_large(under(1001).exact(&half)),
        (MEAN, needed, 100_000_000 / 52)
    );
    // A base has one set for each net number of the remaining steps, −99 to 99.
    let base = Region::triangle(300).unwrap();
    let needed = 302 * 302 * 12 * 199 + 99;
    assert_eq!(
        too_large(RandomPiles::on(base, stackings(100)).mean(&0.5)),
        (MEAN, needed, 100_000_000)
    );
    // Nine products of contacts, two signs and two layers.
    let needed = 10_001 * 10_001 * 36 + 4999;
    assert_eq!(
        too_large(plane(5000, FirstSign::Plus).mean_square(&0.5)),
        ("the mean square of random stackings", needed, 100_000_000)
    );
}

/// Billions of layers are rejected before their bit lengths are computed.
#[test]
fn billions_of_layers_are_rejected_at_once() {
    for layers in [2_000_000_000, 1 << 40] {
        let piles = RandomPiles::under(Region::SITE, stackings(layers));
        let Error::Core(Core::TooLarge { quantity, .. }) = piles.by_faults().unwrap_err() else {
            panic!("it is too large");
        };
        assert_eq!(quantity, "the mean over random stackings");
    }
}

/// A translation far from the origin does not change the forces.
#[test]
fn forces_do_not_depend_on_the_origin() {
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
    let near = RandomPiles::on(Region::new(0..=4, 0..=3, 0..=4).unwrap(), stackings(3));
    for [i, j] in [[50, 60], [-50, 60], [50, -60], [-50, -60]] {
        let base = Region::new(i..=i + 4, j..=j + 3, i + j..=i + j + 4).unwrap();
        let far = RandomPiles::on(base, stackings(3));
        assert_eq!(numbers(&near), numbers(&far), "{base}");
    }
}

#[test]
fn heights_on_a_base_are_limited() {
    let base = Region::triangle(4).unwrap();
    for layers in [5, 1000, MAX_LAYERS] {
        let error = RandomPiles::on(base, stackings(layers))
            .mean(&0.5)
            .unwrap_err();
        is_refused!(
            error,
            Error::NoStacking { greatest: 4, .. },
            &[
                &layers.to_string(),
                "at most 4 layers, not",
                "0..3,0..3,0..3"
            ]
        );
    }
    // The only four-layer stacking on this triangle has a first +. On the rotated triangle it has a first −.
    let minus = RandomStackings::new(4, FirstSign::Minus).unwrap();
    let turned = Region::hexagon(1, 4).unwrap();
    for (base, stackings) in [(base, minus), (turned, stackings(4))] {
        let error = RandomPiles::on(base, stackings).mean(&0.5).unwrap_err();
        is_refused!(
            error,
            Error::NoStacking {
                layers: 4,
                greatest: 3,
                ..
            },
            &["at most 3 layers, not 4"]
        );
    }
    let hexagon = Region::hexagon(3, 3).unwrap();
    assert!(RandomPiles::on(hexagon, stackings(5)).mean(&0.5).is_ok());
    assert!(RandomPiles::on(hexagon, stackings(6)).mean(&0.5).is_err());
}
