//! Scenes as records, with the keys of scene files, but for the anchor and the loads.

use alloc::vec::Vec;

use ::serde::{Deserialize, Deserializer, Serialize, Serializer};
use num_rational::BigRational;
use num_traits::One;

use super::number;
use crate::lattice::{Dimension, Region};
use crate::scene::parse::At;
use crate::scene::{Anchor, Scene};
use crate::stacking::Pattern;

records! {
    At as AtRecord;
    Anchor as AnchorRecord;
    Scene as SceneRecord;
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "At", rename = "At", deny_unknown_fields)]
struct AtRecord {
    #[serde(with = "number", default)]
    layer: Option<i128>,
    #[serde(with = "number")]
    i: i128,
    #[serde(with = "number", default)]
    j: i128,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Anchor", rename = "Anchor", rename_all = "lowercase")]
enum AnchorRecord {
    Top(Region),
    Base(Region),
}

#[derive(Serialize, Deserialize)]
#[serde(
    remote = "Scene",
    rename = "Scene",
    rename_all = "kebab-case",
    deny_unknown_fields
)]
struct SceneRecord {
    #[serde(with = "number", default)]
    layers: Option<i128>,
    #[serde(default = "spheres")]
    dimension: Dimension,
    #[serde(with = "number", default)]
    sin_phi: Option<BigRational>,
    #[serde(default)]
    stacking: Option<Pattern>,
    #[serde(default)]
    anchor: Option<Anchor>,
    #[serde(with = "scene_loads", default)]
    loads: Vec<(At, BigRational)>,
    #[serde(default)]
    weightless: bool,
    #[serde(with = "number", default)]
    spacing: Option<BigRational>,
    #[serde(with = "number", default = "BigRational::one")]
    radius: BigRational,
    #[serde(with = "number", default = "BigRational::one")]
    mass: BigRational,
    #[serde(with = "number", default = "BigRational::one")]
    gravity: BigRational,
}

fn spheres() -> Dimension {
    Dimension::Three
}

/// Loads as records `{"at": …, "weight": …}`.
mod scene_loads {
    use super::{At, BigRational, Deserialize, Deserializer, Serialize, Serializer, Vec, number};

    #[derive(Serialize, Deserialize)]
    #[serde(rename = "Load", deny_unknown_fields)]
    struct Load {
        at: At,
        #[serde(with = "number")]
        weight: BigRational,
    }

    pub(super) fn serialize<S: Serializer>(
        loads: &[(At, BigRational)],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(
            loads
                .iter()
                .cloned()
                .map(|(at, weight)| Load { at, weight }),
        )
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Vec<(At, BigRational)>, D::Error> {
        let loads: Vec<Load> = Deserialize::deserialize(deserializer)?;
        Ok(loads
            .into_iter()
            .map(|load| (load.at, load.weight))
            .collect())
    }
}
