//! Every error can happen, and says in one line what was given and what would do.

use crate::support::answers::{Shape, ratio};
use cannonpile::geometry::{Inclination, Spacing};
use cannonpile::lattice::{Dimension, Direction, MAX_LAYERS, Site};
use cannonpile::scalar::{FixedRational, Surd};
use cannonpile::scene::{Scene, parse};
use cannonpile::shape::Selection;
use cannonpile::{Culprit, Error, Packing, Pile};
use num_rational::BigRational;

/// The message is one plain line that holds all of `parts`.
fn says(error: &Error, parts: &[&str]) {
    let message = error.to_string();
    assert!(
        !message.chars().any(char::is_control),
        "{message:?} is more than a line"
    );
    for part in parts {
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}

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
    let error = parse::layers("12345678901234567890123456789012345678901234567890").unwrap_err();
    assert!(matches!(error, Error::Layers { .. }));
    says(
        &error,
        &["12345678901234567890123456789012345678901234567890"],
    );
}

#[test]
fn sin_phi() {
    for given in [ratio(0, 1), ratio(1, 1), ratio(-1, 2), ratio(3, 2)] {
        let error = Pile::isosceles(5, given.clone()).unwrap_err();
        assert_eq!(
            error,
            Error::SinPhi {
                given: given.clone()
            }
        );
        says(&error, &[&given.to_string(), "between 0 and 1", "1/2"]);
    }
    let scene = Scene {
        dimension: Dimension::Two,
        sin_phi: Some(ratio(1, 2)),
        ..Scene::default()
    };
    let error = scene.pile().unwrap_err();
    assert_eq!(error, Error::SinPhiOfDiscs);
    says(&error, &["sin phi", "leave it out", "dimension 3"]);
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
fn questions_to_the_wrong_sphere() {
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
    let (forces, direction) = (discs.forces::<f64>(), Direction::Gamma);
    let error = forces.contact(Site::APEX, direction).unwrap_err();
    assert_eq!(error, Error::NoSuchDirection { direction });
    says(&error, &["gamma", "alpha and beta"]);
}

#[test]
fn not_positive() {
    for given in [ratio(0, 1), ratio(-6, 5)] {
        let pile = Pile::triangular(3).unwrap();
        let packing = Packing::new(&pile, &spacing(6, 5)).unwrap();
        let text = given.to_string();
        let refused = [
            (
                Culprit::Radius,
                packing.clone().with_radius(given.clone()).unwrap_err(),
            ),
            (
                Culprit::Mass,
                packing.clone().with_mass(given.clone()).unwrap_err(),
            ),
            (
                Culprit::Gravity,
                packing.with_gravity(given.clone()).unwrap_err(),
            ),
            (Culprit::Spacing, Spacing::new(given.clone()).unwrap_err()),
            (
                Culprit::Spacing,
                Spacing::from_square(given.clone()).unwrap_err(),
            ),
        ];
        for (quantity, error) in refused {
            let given = given.clone();
            assert_eq!(error.culprit(), Some(quantity));
            assert_eq!(error, Error::NotPositive { quantity, given });
            says(&error, &[quantity.name(), &text, "must be positive"]);
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
    // Without an upper bound before the contacts are horizontal, only the lower one is named.
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

/// The remedy names a sin φ and a number of layers; either of them alone helps.
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

#[test]
fn negative_radicand() {
    let given = ratio(-7, 3);
    let error = Surd::sqrt(given.clone()).unwrap_err();
    assert_eq!(error, Error::NegativeRadicand { given });
    says(&error, &["-7/3", "must not be negative"]);
}

#[test]
fn syntax() {
    let refused = [
        (parse::rational("a third").unwrap_err(), "a third", "6/5"),
        (
            parse::rational("1/0").unwrap_err(),
            "1/0",
            "other than zero",
        ),
        (parse::integer("1.5").unwrap_err(), "1.5", "integer"),
        (parse::layers("ten").unwrap_err(), "ten", "10"),
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
        (parse::at("5", Dimension::Three).unwrap_err(), "5", "K,I,J"),
        (
            parse::at("5,5,5", Dimension::Two).unwrap_err(),
            "5,5,5",
            "K,I",
        ),
        (
            parse::rational("line\nbreak\u{7}").unwrap_err(),
            "line\\nbreak",
            "6/5",
        ),
    ];
    for (error, given, remedy) in refused {
        assert!(matches!(error, Error::Syntax { .. }));
        says(&error, &[given, remedy]);
    }
    let long = "9".repeat(20_000);
    let error = parse::rational(&long).unwrap_err();
    says(&error, &["999…", "5000 digits"]);
    assert!(error.to_string().len() < 200);
}

/// Made by the tables alone (feature `export`); the message is the library's.
#[test]
fn too_many_rows() {
    let error = Error::TooManyRows {
        rows: Pile::triangular(MAX_LAYERS).unwrap().contact_count(),
        limit: 100_000_000_000,
        remedy: "ask for one layer with --layer",
    };
    says(&error, &["10^107", "100000000000", "--layer"]);
}

/// Made by the figures alone (feature `plot`); the message is the library's.
#[test]
fn too_many_marks() {
    let error = Error::TooManyMarks {
        marks: Pile::triangular(MAX_LAYERS).unwrap().base_spheres(),
        what: "bottom spheres",
        limit: 20_000,
        remedy: "use fewer layers",
    };
    says(
        &error,
        &["5000000", "bottom spheres", "20000", "use fewer layers"],
    );
}

#[cfg(feature = "toml")]
#[test]
fn cases() {
    let error = cannonpile::scene::Case::named("C0").unwrap_err();
    assert!(matches!(error, Error::UnknownCase { .. }));
    says(&error, &["'C0'", "did you mean 'C1'?"]);
    let long = "C".repeat(1000);
    let error = cannonpile::scene::Case::named(&long).unwrap_err();
    says(&error, &["'cannonpile cases' lists"]);
    assert!(error.to_string().len() < 200, "{error}");
}

#[cfg(feature = "export")]
#[test]
fn tests_of_suites() {
    use cannonpile::dem::{PileExport, PileFile};
    use cannonpile::stacking::Pattern;
    use cannonpile::table::WriteError;

    let refused = |scene: &Scene, file| {
        let pile = scene.pile().expect("a pile");
        let packing = scene.packing(&pile).expect("room");
        let export = PileExport::new(&packing).expect("files");
        match export.write_file(file, &mut Vec::new(), &mut |_| {}) {
            Err(WriteError::Answer(error)) => error,
            written => panic!("{file:?}: {written:?}"),
        }
    };
    let falls = Scene {
        stacking: Some(Pattern::Hcp),
        layers: Some(7),
        ..Scene::default()
    };
    let error = refused(&falls, PileFile::LammpsTest);
    assert!(matches!(error, Error::MustPull { .. }));
    says(&error, &["would have to pull", "--to yade-check"]);
    assert_eq!(error.culprit(), None);
    // Without weight it is no pile that falls, and no state of rest either.
    let response = Scene {
        loads: vec![parse::load("0,0,0=1", Dimension::Three).expect("a load")],
        weightless: true,
        ..falls
    };
    let error = refused(&response, PileFile::YadeCheck);
    says(&error, &["would have to pull", "--to yade"]);
    let large = Scene {
        layers: Some(22),
        ..Scene::default()
    };
    for file in [PileFile::LammpsTest, PileFile::YadeCheck] {
        let error = refused(&large, file);
        assert!(matches!(error, Error::TooLarge { .. }));
        says(&error, &["2024", "2000", "fewer layers"]);
        assert_eq!(error.culprit(), Some(Culprit::Layers));
    }
}

#[test]
fn what_excludes_each_other() {
    let message = |given, beside| Error::Excluded { given, beside }.to_string();
    let (stacking, dimension) = (Culprit::Stacking, Culprit::Dimension);
    assert_eq!(
        message(stacking, dimension),
        format!("{stacking} has no meaning with {dimension} 2: leave one of the two out")
    );
    assert_eq!(
        message(Culprit::SinPhi, stacking),
        format!(
            "{} has no meaning with {stacking}: leave one of the two out",
            Culprit::SinPhi
        )
    );
}

#[test]
fn what_does_not_go_together_names_both() {
    let scene = Scene {
        layers: Some(4),
        stacking: Some("++-+-".parse().unwrap()),
        ..Scene::default()
    };
    let error = scene.pile().unwrap_err();
    assert!(matches!(error, Error::LayersOfStacking { .. }), "{error:?}");
    assert_eq!(error.conflicts_with(), Some(Culprit::Stacking));
    let error = Pile::isosceles(5, ratio(3, 2)).unwrap_err();
    assert_eq!(error.conflicts_with(), None);
}
