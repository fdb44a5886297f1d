//! Scene files: each key, each format of a number, and errors with line and key.

use cannonpile::lattice::{Dimension, Region};
use cannonpile::stacking::Pattern;
use cannonpile::{Load, Pile};
use cannonpile_dem::Error;
use cannonpile_dem::scene::{Anchor, Floor, Scene, SceneFile, State, parse};
use cannonpile_testkit::answers::ratio;

/// Returns the error message for a file.
fn refusal(text: &str) -> String {
    let message = Scene::from_toml(text).unwrap_err().to_string();
    assert!(!message.contains(char::is_control), "{message:?}");
    message
}

#[test]
fn every_key() {
    let text = r#"
        layers = 7
        stacking = "hcp"
        base = "region:-2..7,-2..7,-2..7"
        dimension = 3
        sin-phi = "1/3"
        load = ["6,1,0=5/2", { at = [1, 0], weight = 0.25, y = "-1/3" }, { weight = 3, at = "0,0,0" }, "1,0,0=0,.5,1e-1"]
        tilt = [0.125, "-1/16"]
        weightless = true
        spacing = 1.2
        radius = 5e-3
        mass = "1/7"
        gravity = 9.81
        state = "elastic"
        stiffness-ratio = "2/7"
        floor = "rough"
        friction = 0.45
        floor-friction = "1/8"
    "#;
    let at = |text| parse::at(text, Dimension::Three).unwrap();
    let load = |parts: [(i64, i64); 3]| {
        let [down, x, y] = parts.map(|(n, d)| ratio(n, d));
        Load { down, x, y }
    };
    let scene = Scene {
        layers: Some(7),
        dimension: Dimension::Three,
        sin_phi: Some(ratio(1, 3)),
        stacking: Some(Pattern::Hcp),
        anchor: Some(Anchor::Base(Region::new(-2..=7, -2..=7, -2..=7).unwrap())),
        loads: vec![
            (at("6,1,0"), ratio(5, 2).into()),
            (at("1,0"), load([(1, 4), (0, 1), (-1, 3)])),
            (at("0,0,0"), ratio(3, 1).into()),
            (at("1,0,0"), load([(0, 1), (1, 2), (1, 10)])),
        ],
        tilt: [ratio(1, 8), ratio(-1, 16)],
        weightless: true,
        spacing: Some("6/5".parse().unwrap()),
        radius: ratio(1, 200),
        mass: ratio(1, 7),
        gravity: ratio(981, 100),
        state: State::Elastic,
        stiffness_ratio: ratio(2, 7),
        floor: Floor::Rough,
        friction: Some(ratio(9, 20)),
        floor_friction: Some(ratio(1, 8)),
    };
    assert_eq!(Scene::from_toml(text).unwrap(), scene);
    assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
    assert_eq!(Scene::from_toml("").unwrap(), Scene::default());
}

#[test]
fn arrays_of_tables_are_loads_too() {
    let text =
        "layers = 3\n[[load]]\nat = [0, 0, 0]\nweight = '1/3'\n[[load]]\nat = '1,1'\nweight = 2\n";
    let scene = Scene::from_toml(text).unwrap();
    let pile = Pile::triangular(3).unwrap();
    let loaded = |pile: Pile, [i, j, k]: [i128; 3], load| {
        let site = cannonpile::lattice::Site { i, j, k };
        pile.with_load(site, load).unwrap()
    };
    let pile = loaded(pile, [0, 0, 0], ratio(1, 3));
    assert_eq!(scene.pile().unwrap(), loaded(pile, [1, 1, 2], ratio(2, 1)));
    // A disc has no component along y.
    let discs = Scene::from_toml("dimension = 2\nload = ['1=1,1/4']\ntilt = '1/8'").unwrap();
    assert_eq!(discs.tilt, [ratio(1, 8), ratio(0, 1)]);
    let written = discs.to_toml();
    assert!(written.contains("\"1=1,1/4\"") && written.contains("\ntilt = \"1/8\"\n"));
    assert_eq!(Scene::from_toml(&written).unwrap(), discs);
    for text in ["tilt = [0, 1]", "load = ['1=1,0,2']"] {
        let scene = Scene::from_toml(&format!("dimension = 2\n{text}")).unwrap();
        let refused = scene.pile().unwrap_err().to_string();
        assert!(
            refused.contains("no component along y: set it to 0"),
            "{refused}"
        );
        assert_eq!(Scene::from_toml(&scene.to_toml()).unwrap(), scene);
    }
    // Loads may precede the dimension.
    let discs = Scene::from_toml("load = ['1=1', '0,0=2']\nlayers = 2\ndimension = 2").unwrap();
    let pile = Pile::discs(2).unwrap();
    let pile = loaded(pile, [1, 0, 1], ratio(1, 1));
    assert_eq!(discs.pile().unwrap(), loaded(pile, [0, 0, 0], ratio(2, 1)));
}

#[test]
fn numbers_are_read_exactly() {
    for (written, n, d) in [
        ("6", 6, 1),
        ("+6", 6, 1),
        ("1.2", 6, 5),
        // A tenth is not a float.
        ("0.1", 1, 10),
        ("0.1000000000000000000", 1, 10),
        ("1_0.2_5", 41, 4),
        ("25e-1", 5, 2),
        ("2.5E+1", 25, 1),
        ("-0.5", -1, 2),
        ("0x1F", 31, 1),
        ("0o17", 15, 1),
        ("0b101", 5, 1),
        ("'6/5'", 6, 5),
        ("\"\"\"6/5\"\"\"", 6, 5),
    ] {
        let scene = Scene::from_toml(&format!("mass = {written}")).unwrap();
        assert_eq!(scene.mass, ratio(n, d), "{written}");
    }
    let huge = 10_i128.pow(30);
    for written in [
        format!("{huge}"),
        format!("'{huge}'"),
        format!("{huge:#x}"),
        "1e30".into(),
        "'1e30'".into(),
    ] {
        let scene = Scene::from_toml(&format!("layers = {written}")).unwrap();
        assert_eq!(scene.layers, Some(huge), "{written}");
    }
    let scene = Scene {
        layers: Some(huge),
        ..Scene::default()
    };
    assert!(
        scene
            .to_toml()
            .contains(&format!("\nlayers = \"{huge}\"\n"))
    );
}

#[test]
fn refusals_name_the_line_and_the_key() {
    for (text, parts) in [
        (
            "\nspcaing = 1",
            &["line 2", "'spcaing'", "did you mean 'spacing'?"][..],
        ),
        ("sin_phi = 0.5", &["line 1", "did you mean 'sin-phi'?"]),
        (
            "colour = 1",
            &["line 1", "'colour'", "the keys are layers, stacking,"],
        ),
        ("[scene]\nlayers = 1", &["line 1", "'scene'"]),
        ("\"a\\nb\" = 1", &["line 1", "'a\\nb'"]),
        (
            "layers = 1\n\nlayers = 1",
            &["line 3", "duplicate key", "'layers'"],
        ),
        ("layers = ", &["line 1"]),
        ("layers = 07", &["line 1"]),
        ("mass = .5", &["line 1"]),
        ("layers = 0", &["line 1, layers", "at least 1", "not 0"]),
        ("layers = 1.5", &["line 1, layers", "'1.5'"]),
        ("layers = true", &["line 1, layers", "'true'", "such as 10"]),
        ("layers = [1]", &["line 1, layers", "'[…]'"]),
        ("spacing = inf", &["line 1, spacing", "'inf'", "6/5"]),
        ("spacing = -nan", &["line 1, spacing", "'-nan'"]),
        ("spacing = '1/0'", &["line 1, spacing", "other than zero"]),
        ("spacing.x = 1", &["line 1, spacing", "'{…}'"]),
        ("mass = 1979-05-27", &["line 1, mass", "'1979-05-27'"]),
        ("mass = 1e5000", &["line 1, mass", "at most 5000 digits"]),
        (
            "mass = 1e-99_999_999_999",
            &["line 1, mass", "at most 5000 digits"],
        ),
        ("mass = '1e'", &["line 1, mass", "1e-3"]),
        ("mass = '1.x'", &["line 1, mass", "1e-3"]),
        (
            "dimension = 4",
            &["line 1, dimension", "2 (discs) or 3 (spheres)"],
        ),
        (
            "weightless = 'true'",
            &["line 1, weightless", "true or false"],
        ),
        ("weightless = 1", &["line 1, weightless", "'1'"]),
        ("stacking = 'bcc'", &["line 1, stacking", "'bcc'"]),
        ("stacking = 2", &["line 1, stacking", "such as ++-+"]),
        ("top = 'hexagon:0'", &["line 1, top", "at least 1"]),
        (
            "base = 'hexagon:2'\n\ntop = 'hexagon:2'",
            &["line 3, top", "with base"],
        ),
        ("load = '0,0,0=1'", &["line 1, load", "an array of loads"]),
        ("load = [\n'0,0,0=1',\n'0,0=x']", &["line 3, load", "'x'"]),
        ("load = [1]", &["line 1, load", "K,I,J=W"]),
        ("load = ['0,0,0=1,2']", &["line 1, load", "K,I,J=W,X,Y"]),
        ("load = ['0,0,0=1,2,x']", &["line 1, load", "'x'"]),
        (
            "[[load]]\nat = [0, 0]\nweight = 1\nx = 'one'",
            &["line 4, x", "'one'"],
        ),
        ("tilt = 1", &["line 1, tilt", "'1'", "such as 1/4,0"]),
        ("tilt = [1, 2, 3]", &["line 1, tilt", "such as 1/4,0"]),
        ("tilt = ['a', 2]", &["line 1, tilt", "'a'"]),
        ("tilt = [[1], 2]", &["line 1, tilt", "'[…]'"]),
        ("dimension = 2\ntilt = ''", &["line 2, tilt", "''", "1e-3"]),
        ("load = [[0, 0, 0]]", &["line 1, load", "K,I,J=W"]),
        (
            "load = [{ at = '0,0,0' }]",
            &["line 1, load", "the keys at and weight"],
        ),
        (
            "[[load]]\nat = '0,0,0'\nwieght = 1",
            &["line 3", "did you mean 'weight'?"],
        ),
        ("[[load]]\nat = [0]\nweight = 1", &["line 2, at", "K,I,J"]),
        (
            "[[load]]\nat = ['0', 0]\nweight = 1",
            &["line 2, at", "'[…]'"],
        ),
        (
            "[[load]]\nat = [0, 0]\nweight = '1/0'",
            &["line 3, weight", "'1/0'"],
        ),
        (
            "dimension = 2\nload = ['0,0,0=1']",
            &["line 2, load", "a disc"],
        ),
    ] {
        let message = refusal(text);
        for part in parts {
            assert!(message.contains(part), "{text:?}: no {part:?} in {message}");
        }
    }
}

#[test]
fn the_first_error_of_a_file_is_reported() {
    // The order of the file counts, not the alphabet.
    assert!(refusal("zebra = 1\nant = 1").contains("line 1"));
    assert!(refusal("spacing = 'x'\nmass = 'y'").contains("line 1, spacing"));
}

#[test]
fn texts_that_could_exhaust_the_parser_are_refused() {
    refusal(&format!("mass = {}", "[".repeat(100_000)));
    refusal(&format!("mass = {}", "{a=".repeat(100_000)));
    refusal(&format!("{}mass = 1", "a.".repeat(100_000)));
    refusal(&format!("[{}mass]", "a.".repeat(100_000)));
    refusal(&format!("mass = {}", "9".repeat(100_000)));
    let long = refusal(&format!("mass = 0.{}", "9".repeat(5_000)));
    assert!(long.contains("at most 5000 digits"), "{long}");
    refusal(&format!("mass = 0x{}", "f".repeat(100_000)));
    refusal(&format!("layers = 0x{}", "f".repeat(100_000)));
    refusal(&format!("{} = 1", "a".repeat(100_000)));
    assert!(matches!(
        " ".repeat((16 << 20) + 1).parse::<SceneFile>(),
        Err(Error::NotToml { line: 1, .. })
    ));
}

#[test]
fn a_file_is_short_and_canonical() {
    let text = Scene::default().to_toml();
    let keys: Vec<&str> = text
        .lines()
        .filter_map(|line| line.split_once(" = ").map(|(key, _)| key))
        .collect();
    assert_eq!(keys, ["dimension", "radius", "mass", "gravity"]);
    assert!(!text.contains('\r') && text.ends_with('\n'));
    for (shape, written) in [
        ("region:0..0,0..0,0..0", "hexagon:1"),
        ("region:0..3,0..3,0..3", "triangle:4"),
        ("hexagon:3,3", "hexagon:3"),
        ("hexagon:3,2", "hexagon:3,2"),
        ("hexagon:1,2", "hexagon:1,2"),
        ("region:0..1,0..1,0..2", "region:0..1,0..1,0..2"),
    ] {
        let top = Some(Anchor::Top(shape.parse::<Region>().unwrap()));
        let text = Scene {
            anchor: top,
            ..Scene::default()
        }
        .to_toml();
        assert!(
            text.contains(&format!("\ntop = \"{written}\"\n")),
            "{shape}: {text}"
        );
    }
}
