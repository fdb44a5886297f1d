//! Every error can occur. Its message is one line with the given value and the remedy.

use cannonpile::geometry::{Inclination, Spacing};
use cannonpile::lattice::{Dimension, Direction, MAX_LAYERS, Site};
use cannonpile::scalar::{FixedRational, Surd, parse};
use cannonpile::shape::Selection;
use cannonpile::{Error, Packing, Pile};
use cannonpile_testkit::answers::{Shape, ratio};
use cannonpile_testkit::errors::says;
use num_rational::BigRational;

fn site(i: i128, j: i128, k: i128) -> Site {
    Site { i, j, k }
}

fn spacing(n: i64, d: i64) -> Spacing {
    Spacing::new(ratio(n, d)).unwrap()
}

#[test]
fn layers() {
    for given in [0, -7, MAX_LAYERS + 1] {
        let error = Pile::triangular(given).unwrap_err();
        assert!(matches!(error, Error::Layers { .. }));
        says(&error, &[&given.to_string(), "at least 1", "10^36"]);
    }
    let digits = "12345678901234567890123456789012345678901234567890";
    let error = Error::Layers {
        given: digits.parse().unwrap(),
    };
    says(&error, &[digits]);
}

#[test]
fn sin_phi() {
    for given in [ratio(0, 1), ratio(1, 1), ratio(-1, 2), ratio(3, 2)] {
        let error = Pile::isosceles(5, given.clone()).unwrap_err();
        assert!(matches!(&error, Error::SinPhi { given: named, .. } if *named == given));
        says(&error, &[&given.to_string(), "between 0 and 1", "1/2"]);
    }
}

#[test]
fn sites_and_layers_outside() {
    let pile = Pile::triangular(10).unwrap();
    let forces = pile.forces::<BigRational>();
    let error = forces.from_above(site(3, 4, 6)).unwrap_err();
    assert!(matches!(error, Error::SiteOutside { .. }));
    says(
        &error,
        &["k=6", "i=3", "j=4", "0 <= k <= 9", "0 <= i <= k-j"],
    );
    let discs = Pile::discs(10).unwrap();
    let error = discs.forces::<f64>().from_above(site(0, 1, 6)).unwrap_err();
    says(&error, &["j=1", "0 <= i <= k", "j = 0"]);
    let error = pile.rows(Selection::Layer(10)).unwrap_err();
    assert!(matches!(error, Error::LayerOutside { .. }));
    says(&error, &["layer 10", "from 0", "to 9"]);
}

#[test]
fn queries_of_the_wrong_sphere() {
    let pile = Pile::triangular(3).unwrap();
    let forces = pile.forces::<BigRational>();
    let below = |site| forces.contact(site, Direction::Alpha).unwrap_err();
    let site = Site { i: 1, j: 0, k: 2 };
    assert_eq!(below(site), Error::OnFloor { site });
    assert_eq!(forces.unbalanced(site), Err(Error::OnFloor { site }));
    says(
        &below(site),
        &["(1,0,2)", "floor", "ask for the force on the floor"],
    );
    let (site, floor) = (Site { i: 1, j: 0, k: 1 }, 2);
    let error = forces.on_floor(site).unwrap_err();
    assert_eq!(error, Error::NotOnFloor { site, floor });
    says(&error, &["(1,0,1)", "k = 2"]);
    let discs = Pile::discs(3).unwrap();
    let forces = discs.forces::<f64>();
    let error = forces.contact(Site::APEX, Direction::Gamma).unwrap_err();
    assert!(matches!(
        error,
        Error::NoSuchDirection {
            direction: Direction::Gamma,
            ..
        }
    ));
    says(&error, &["gamma", "alpha and beta"]);
}

#[test]
fn not_positive() {
    for given in [ratio(0, 1), ratio(-6, 5)] {
        let pile = Pile::triangular(3).unwrap();
        let packing = Packing::new(&pile, &spacing(6, 5)).unwrap();
        let text = given.to_string();
        let refused = [
            ("radius", packing.clone().with_radius(given.clone()).err()),
            ("mass", packing.clone().with_mass(given.clone()).err()),
            ("gravity", packing.with_gravity(given.clone()).err()),
            ("spacing", Spacing::new(given.clone()).err()),
            ("spacing", Spacing::from_square(given.clone()).err()),
        ];
        for (quantity, error) in refused {
            let error = error.unwrap();
            assert_eq!(
                error,
                Error::NotPositive {
                    quantity,
                    given: given.clone()
                }
            );
            says(&error, &[quantity, &text, "must be positive"]);
        }
    }
}

#[test]
fn overlap() {
    let tall = Pile::triangular(10).unwrap();
    let error = Packing::new(&tall, &spacing(164, 100)).unwrap_err();
    assert!(matches!(error, Error::Overlap { .. }));
    says(
        &error,
        &[
            "41/25",
            "3 layers apart",
            "at least 1",
            "at most 2/3*sqrt(6) = 1.632993…",
        ],
    );
    let error = Packing::new(&tall, &spacing(99, 100)).unwrap_err();
    says(
        &error,
        &["99/100", "in one layer", "at least 1 ", "1.632993…"],
    );
    // No upper bound exists before the contacts become horizontal, so the message has only the lower one.
    let low = Pile::triangular(3).unwrap();
    let error = Packing::new(&low, &spacing(1, 2)).unwrap_err();
    says(&error, &["1/2", "in one layer", "a/R must be at least 1"]);
}

#[test]
fn too_flat() {
    let low = Pile::triangular(2).unwrap();
    for given in [spacing(2, 1), Spacing::from_square(ratio(3, 1)).unwrap()] {
        let error = Packing::new(&low, &given).unwrap_err();
        assert!(matches!(error, Error::TooFlat { .. }), "{error:?}");
        says(&error, &[&given.to_string(), "below sqrt(3) = 1.732050…"]);
    }
    let error = Inclination::new(&spacing(2, 1), Dimension::Two).unwrap_err();
    assert!(matches!(error, Error::TooFlat { .. }));
    says(&error, &["spacing 2", "below 2"]);
}

/// The remedy names a sin φ and a number of layers. Either of them helps on its own.
#[test]
fn no_spacing() {
    for (layers, sin_phi) in [
        (3, ratio(6, 7)),
        (10, ratio(9, 10)),
        (2, ratio(9, 10)),
        (2, ratio(7, 8)),
    ] {
        let pile = Pile::isosceles(layers, sin_phi.clone()).unwrap();
        let error = pile.clearance().check(&spacing(6, 5)).unwrap_err();
        assert!(matches!(error, Error::NoSpacing { .. }), "{error:?}");
        says(
            &error,
            &[&format!("{layers} layers"), &sin_phi.to_string(), "5/6"],
        );
        let message = error.to_string();
        let fits = |shape: &Shape, layers| {
            let clearance = shape.pile(layers).clearance();
            clearance
                .least()
                .is_none_or(|least| clearance.check(&least).is_ok())
        };
        assert!(fits(&Shape::Spheres(ratio(5, 6)), layers));
        for fewer in 1..=9 {
            if message.contains(&format!("at most {fewer} layer")) {
                let helps = fits(&Shape::Spheres(sin_phi.clone()), fewer);
                assert!(helps, "{message:?}: {fewer} layers do not fit either");
            }
        }
    }
}

#[test]
fn overflow() {
    let pile = Pile::triangular(1000).unwrap();
    let forces = pile.forces::<FixedRational<i8>>();
    let error = forces
        .contact(site(0, 0, 500), Direction::Alpha)
        .unwrap_err();
    assert!(matches!(error, Error::Overflow { .. }));
    says(
        &error,
        &["contact force", "FixedRational<i8>", "exact numbers"],
    );
}

/// An error about a single number has the message of the number crate.
#[test]
fn numbers() {
    let given = ratio(-7, 3);
    let error = Error::from(Surd::sqrt(given).unwrap_err());
    assert!(matches!(error, Error::Number(_)));
    says(&error, &["-7/3", "must not be negative"]);
    let error = Error::from(parse::rational("a third").unwrap_err());
    says(&error, &["a third", "6/5"]);
}

#[test]
fn syntax() {
    let refused = [
        (
            "4".parse::<Dimension>().unwrap_err(),
            "4",
            "2 (discs) or 3 (spheres)",
        ),
        (
            "delta".parse::<Direction>().unwrap_err(),
            "delta",
            "alpha, beta or gamma",
        ),
        (
            "line\nbreak\u{7}".parse::<Direction>().unwrap_err(),
            "line\\nbreak",
            "alpha",
        ),
    ];
    for (error, given, remedy) in refused {
        assert!(matches!(error, Error::Syntax { .. }));
        says(&error, &[given, remedy]);
    }
    let long = "9".repeat(20_000);
    let error = long.parse::<Direction>().unwrap_err();
    says(&error, &["999…"]);
    assert!(error.to_string().len() < 200);
}

/// Errors of tables and of a census.
#[test]
fn too_many_rows() {
    let error = Error::TooManyRows {
        rows: Pile::triangular(MAX_LAYERS).unwrap().contact_count(),
        limit: 100_000_000_000,
        remedy: "ask for one layer with --layer",
    };
    says(&error, &["10^107", "100000000000", "--layer"]);
}
