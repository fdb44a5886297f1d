//! Every error occurs, and states the given value and a remedy in one line.

use cannonpile::lattice::Dimension;
use cannonpile::stacking::Pattern;
use cannonpile_dem::scene::{Case, Scene, parse};
use cannonpile_dem::{Error, Key};
use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::errors::says;

#[test]
fn layers() {
    let digits = "12345678901234567890123456789012345678901234567890";
    let error = parse::layers(digits).unwrap_err();
    assert!(matches!(
        error,
        Error::Core(cannonpile::Error::Layers { .. })
    ));
    says(&error, &[digits, "at least 1", "10^36"]);
}

#[test]
fn sin_phi_of_discs() {
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
fn syntax() {
    let refused = [
        (parse::layers("ten").unwrap_err(), "ten", "10"),
        (parse::at("5", Dimension::Three).unwrap_err(), "5", "K,I,J"),
        (
            parse::at("5,5,5", Dimension::Two).unwrap_err(),
            "5,5,5",
            "K,I",
        ),
    ];
    for (error, given, remedy) in refused {
        assert!(matches!(
            error,
            Error::Core(cannonpile::Error::Syntax { .. })
        ));
        says(&error, &[given, remedy]);
    }
}

#[test]
fn cases() {
    let error = Case::named("C0").unwrap_err();
    assert!(matches!(error, Error::UnknownCase { .. }));
    says(&error, &["'C0'", "did you mean 'C1'?"]);
    let long = "C".repeat(1000);
    let error = Case::named(&long).unwrap_err();
    says(&error, &["'cannonpile cases' lists"]);
    assert!(error.to_string().len() < 200, "{error}");
}

#[test]
fn options_that_exclude_each_other() {
    let message = |scene: Scene| {
        let error = scene.pile().unwrap_err();
        assert!(matches!(error, Error::Excluded { .. }), "{error:?}");
        error.to_string()
    };
    let stacked = Scene {
        stacking: Some(Pattern::Hcp),
        ..Scene::default()
    };
    let (stacking, dimension) = (Key::Stacking, Key::Dimension);
    assert_eq!(
        message(Scene {
            dimension: Dimension::Two,
            ..stacked.clone()
        }),
        format!("{stacking} has no meaning with {dimension} 2: leave one of the two out")
    );
    assert_eq!(
        message(Scene {
            sin_phi: Some(ratio(1, 3)),
            ..stacked
        }),
        format!(
            "{} has no meaning with {stacking}: leave one of the two out",
            Key::SinPhi
        )
    );
}

#[test]
fn contradicting_lengths_are_both_named() {
    let scene = Scene {
        layers: Some(4),
        stacking: Some("++-+-".parse().unwrap()),
        ..Scene::default()
    };
    let error = scene.pile().unwrap_err();
    assert!(
        matches!(
            error,
            Error::Core(cannonpile::Error::LayersOfStacking { .. })
        ),
        "{error:?}"
    );
    says(&error, &["4", "6"]);
}
