//! Scenes through serde: a scene that is written and read is unchanged, and invalid values are rejected.

use cannonpile::Load;
use cannonpile::lattice::{MAX_LAYERS, Region};
use cannonpile::stacking::Pattern;
use cannonpile_dem::scene::parse::At;
use cannonpile_dem::scene::{Anchor, Scene};
use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::json::{back, refusal};

#[test]
fn scenes() {
    let scene = Scene {
        layers: Some(MAX_LAYERS),
        stacking: Some(Pattern::Hcp),
        anchor: Some(Anchor::Base(Region::hexagon(3, 2).unwrap())),
        loads: vec![(
            At {
                layer: None,
                i: 1,
                j: -2,
            },
            Load {
                down: ratio(5, 2),
                x: ratio(-1, 3),
                y: ratio(0, 1),
            },
        )],
        tilt: [ratio(1, 8), ratio(0, 1)],
        spacing: Some("6/5".parse().unwrap()),
        ..Scene::default()
    };
    assert_eq!(
        back(&scene),
        format!(
            r#"{{"layers":"{MAX_LAYERS}","dimension":3,"sin-phi":null,"stacking":"hcp","anchor":{{"base":"hexagon:3,2"}},"#
        ) + r#""loads":[{"at":{"layer":null,"i":1,"j":-2},"weight":"5/2","x":"-1/3","y":"0"}],"#
            + r#""tilt":{"x":"1/8","y":"0"},"weightless":false,"#
            + r#""spacing":"6/5","radius":"1","mass":"1","gravity":"1","state":"isostatic","stiffness-ratio":"1","floor":"glued","friction":null,"floor-friction":null}"#
    );
    back(&Scene::default());
    assert_eq!(
        serde_json::from_str::<Scene>("{}").unwrap(),
        Scene::default()
    );
    let given: Scene =
        serde_json::from_str(r#"{"layers":"4","anchor":{"top":"triangle:2"},"mass":"0.1"}"#)
            .unwrap();
    assert_eq!((given.layers, given.mass), (Some(4), ratio(1, 10)));
    let vertical = r#"{"loads":[{"at":{"i":"0","j":"0"},"weight":"1/2"}]}"#;
    let given: Scene = serde_json::from_str(vertical).unwrap();
    assert_eq!(given.loads[0].1, ratio(1, 2).into());
    assert!(refusal::<Scene>(r#"{"spcaing":"1"}"#).contains("`spcaing`"));
    assert!(refusal::<Scene>(r#"{"anchor":{"side":"hexagon:1"}}"#).contains("`side`"));
    assert!(refusal::<Scene>(r#"{"radius":"1/0"}"#).contains("other than zero"));
}
