//! Scenes through serde: a scene that is written and read is unchanged, and invalid values are rejected.

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
            ratio(5, 2),
        )],
        spacing: Some("6/5".parse().unwrap()),
        ..Scene::default()
    };
    assert_eq!(
        back(&scene),
        format!(
            r#"{{"layers":"{MAX_LAYERS}","dimension":3,"sin-phi":null,"stacking":"hcp","anchor":{{"base":"hexagon:3,2"}},"#
        ) + r#""loads":[{"at":{"layer":null,"i":1,"j":-2},"weight":"5/2"}],"weightless":false,"#
            + r#""spacing":"6/5","radius":"1","mass":"1","gravity":"1","state":"isostatic","stiffness-ratio":"1"}"#
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
    assert!(refusal::<Scene>(r#"{"spcaing":"1"}"#).contains("`spcaing`"));
    assert!(refusal::<Scene>(r#"{"anchor":{"side":"hexagon:1"}}"#).contains("`side`"));
    assert!(refusal::<Scene>(r#"{"radius":"1/0"}"#).contains("other than zero"));
}
