//! Scenes of every kind, and the files of their piles.

use std::collections::BTreeMap;

use cannonpile::lattice::Dimension;
use cannonpile::{Packing, Pile};
use cannonpile_dem::scene::{Anchor, Scene, State, parse};
use cannonpile_dem::{PileExport, PileFile};

/// Returns scenes of every kind: straight, isosceles and discs, stackings under and on regions, loads, tilted gravity, zero
/// weight, SI scales.
pub fn scenes() -> Vec<Scene> {
    let rational = |text| parse::rational(text).expect("a number");
    let region = |text: &str| text.parse().expect("a region");
    let stacking = |text: &str| Some(text.parse().expect("a stacking"));
    let load = |text, dimension| parse::load(text, dimension).expect("a load");
    let plain = || Scene {
        layers: Some(6),
        ..Scene::default()
    };
    let three = Dimension::Three;
    let two = Dimension::Two;
    let mut scenes = vec![
        plain(),
        Scene {
            layers: Some(1),
            ..plain()
        },
        Scene {
            radius: rational("1e-3"),
            mass: rational("1e-5"),
            gravity: rational("9.81"),
            spacing: Some("1.05".parse().expect("a spacing")),
            ..plain()
        },
        Scene {
            sin_phi: Some(rational("2/5")),
            ..plain()
        },
        Scene {
            dimension: two,
            ..plain()
        },
        Scene {
            loads: vec![load("2,0,1=5/2", three), load("5,0,0=1", three)],
            ..plain()
        },
        Scene {
            loads: vec![load("0,0,0=3", three)],
            weightless: true,
            ..plain()
        },
        Scene {
            dimension: two,
            loads: vec![load("1,1=7", two)],
            ..plain()
        },
        Scene {
            anchor: Some(Anchor::Top(region("hexagon:3,2"))),
            stacking: stacking("hcp"),
            layers: Some(4),
            ..plain()
        },
        Scene {
            anchor: Some(Anchor::Base(region("hexagon:4"))),
            stacking: stacking("+-++"),
            layers: None,
            ..plain()
        },
        Scene {
            anchor: Some(Anchor::Top(region("region:-3..2,5..5,2..7"))),
            stacking: stacking("--+"),
            layers: None,
            ..plain()
        },
        Scene {
            stacking: stacking("+-+-++"),
            layers: None,
            state: State::Elastic,
            gravity: rational("9.81"),
            ..plain()
        },
        Scene {
            stacking: stacking("hcp"),
            loads: vec![load("0,0,0=1/7", three)],
            state: State::Elastic,
            stiffness_ratio: rational("2/3"),
            ..plain()
        },
    ];
    scenes.extend(tilted_scenes());
    scenes
}

/// Returns scenes with tilted gravity, and with loads of any direction.
fn tilted_scenes() -> [Scene; 4] {
    let rational = |text| parse::rational(text).expect("a number");
    let load = |text, dimension| parse::load(text, dimension).expect("a load");
    let [two, three] = [Dimension::Two, Dimension::Three];
    let tilted = |text| Scene {
        layers: Some(6),
        tilt: parse::tilt(text, three).expect("a tilt"),
        ..Scene::default()
    };
    [
        tilted("1/4,-1/16"),
        Scene {
            sin_phi: Some(rational("2/5")),
            loads: vec![load("2,0,1=0,1/4,-1/8", three), load("5,0,0=1,0,1", three)],
            gravity: rational("9.81"),
            ..tilted("0.02,0.1")
        },
        Scene {
            dimension: two,
            loads: vec![load("1,1=1/2,1/3", two)],
            ..tilted("-1/7,0")
        },
        Scene {
            anchor: Some(Anchor::Top("hexagon:2".parse().expect("a region"))),
            stacking: Some("+--+".parse().expect("a stacking")),
            layers: None,
            ..tilted("1/9,1/11")
        },
    ]
}

/// Calls `judge` with each of the [`scenes`] and its export.
pub fn for_each_pile(mut judge: impl FnMut(&Scene, &PileExport<'_>)) {
    for scene in scenes() {
        let pile = scene.pile().and_then(|pile| scene.in_state(pile));
        let pile = pile.expect("a pile");
        let packing = scene.packing(&pile).expect("a sweep within its limit");
        judge(&scene, &PileExport::new(&packing).expect("files"));
    }
}

/// Returns the pile with the default radius, mass, gravity and spacing of a scene.
pub fn packing(pile: &Pile) -> Packing<'_> {
    Scene::default()
        .packing(pile)
        .expect("a sweep within its limit")
}

/// Writes a file into memory and checks that the export reports all rows.
pub fn bytes(export: &PileExport<'_>, file: PileFile) -> Vec<u8> {
    let (mut out, mut rows) = (Vec::new(), 0);
    export
        .write_file(file, &mut out, &mut |more| rows += more)
        .expect("a file");
    assert_eq!(rows, export.rows(file).unwrap_or(0), "{file:?}");
    out
}

/// Returns a file as text.
pub fn text(export: &PileExport<'_>, file: PileFile) -> String {
    String::from_utf8(bytes(export, file)).expect("text")
}

/// Returns the numeric columns of a CSV file as floats.
pub fn columns(csv: &str) -> BTreeMap<String, Vec<f64>> {
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let mut columns: BTreeMap<String, Vec<f64>> = names
        .iter()
        .map(|name| ((*name).to_owned(), Vec::new()))
        .collect();
    for line in lines {
        for (name, cell) in names.iter().zip(line.split(',')) {
            let column = columns.get_mut(*name).expect("a column");
            if *name != "direction" {
                column.push(cell.parse().expect("a number"));
            }
        }
    }
    columns
}
