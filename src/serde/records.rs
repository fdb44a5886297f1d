//! What is a record of its public fields: here they are again, each with the way it is written.

use alloc::vec::Vec;
use core::ops::Range;

use ::serde::{Deserialize, Deserializer, Serialize, Serializer};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::One;

use super::{Number, number};
use crate::census::Entry;
use crate::geometry::{Apart, Vector};
use crate::lattice::{Dimension, Direction, Region, Row, Selection, Site};
use crate::scalar::{Enclosure, Surd};
use crate::scene::parse::At;
use crate::scene::{Anchor, Scene};
use crate::stacking::{Pattern, Run, Sign};
use crate::{
    BaseExtremes, ContactForce, Counters, FloorForce, Method, PackedContact, Pile, Plan, Quantity,
    Question, Standing,
};

/// The implementations that serde derives for the copy of a type of this name.
macro_rules! records {
    ($($type:ident as $copy:ident $(<$scalar:ident>)?;)*) => {$(
        impl $(<$scalar: Number>)? Serialize for $type $(<$scalar>)? {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $copy::serialize(self, serializer)
            }
        }

        impl<'de $(, $scalar: Number)?> Deserialize<'de> for $type $(<$scalar>)? {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $copy::deserialize(deserializer)
            }
        }
    )*};
}

records! {
    Site as SiteRecord;
    Run as RunRecord;
    Row as RowRecord;
    Selection as SelectionRecord;
    Apart as ApartRecord;
    Vector as VectorRecord<T>;
    Enclosure as EnclosureRecord;
    ContactForce as ContactForceRecord<T>;
    FloorForce as FloorForceRecord<T>;
    PackedContact as PackedContactRecord;
    BaseExtremes as BaseExtremesRecord;
    Standing as StandingRecord;
    Entry as EntryRecord;
    Question as QuestionRecord;
    Plan as PlanRecord;
    Counters as CountersRecord;
    At as AtRecord;
    Anchor as AnchorRecord;
    Scene as SceneRecord;
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Site", rename = "Site", deny_unknown_fields)]
struct SiteRecord {
    #[serde(with = "number")]
    i: i128,
    #[serde(with = "number")]
    j: i128,
    #[serde(with = "number")]
    k: i128,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Run", rename = "Run", deny_unknown_fields)]
struct RunRecord {
    sign: Sign,
    #[serde(with = "number")]
    steps: i128,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Row", rename = "Row", deny_unknown_fields)]
struct RowRecord {
    #[serde(with = "number")]
    k: i128,
    #[serde(with = "number")]
    j: i128,
    #[serde(with = "RangeRecord")]
    i: Range<i128>,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Range<i128>", rename = "Range", deny_unknown_fields)]
struct RangeRecord {
    #[serde(with = "number")]
    start: i128,
    #[serde(with = "number")]
    end: i128,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Selection", rename = "Selection", rename_all = "lowercase")]
enum SelectionRecord {
    One(Site),
    Layer(#[serde(with = "number")] i128),
    Base,
    All,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Apart", rename = "Apart", deny_unknown_fields)]
struct ApartRecord {
    layers: u8,
}

#[derive(Serialize, Deserialize)]
#[serde(
    remote = "Vector",
    rename = "Vector",
    bound = "T: Number",
    deny_unknown_fields
)]
struct VectorRecord<T> {
    #[serde(with = "number")]
    x: T,
    #[serde(with = "number")]
    y: T,
    #[serde(with = "number")]
    z: T,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Enclosure", rename = "Enclosure", deny_unknown_fields)]
struct EnclosureRecord {
    #[serde(with = "number")]
    lower: BigRational,
    #[serde(with = "number")]
    upper: BigRational,
}

#[derive(Serialize, Deserialize)]
#[serde(
    remote = "ContactForce",
    rename = "ContactForce",
    bound = "T: Number",
    deny_unknown_fields
)]
struct ContactForceRecord<T> {
    site: Site,
    direction: Direction,
    #[serde(with = "number")]
    force: T,
}

#[derive(Serialize, Deserialize)]
#[serde(
    remote = "FloorForce",
    rename = "FloorForce",
    bound = "T: Number",
    deny_unknown_fields
)]
struct FloorForceRecord<T> {
    site: Site,
    #[serde(with = "number")]
    normal: T,
    #[serde(with = "number")]
    shear_x: T,
    #[serde(with = "number")]
    shear_y: T,
}

#[derive(Serialize, Deserialize)]
#[serde(
    remote = "PackedContact",
    rename = "PackedContact",
    deny_unknown_fields
)]
struct PackedContactRecord {
    site: Site,
    direction: Direction,
    force: Surd,
    vector: [Surd; 3],
    point: [Surd; 3],
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "BaseExtremes", rename = "BaseExtremes", deny_unknown_fields)]
struct BaseExtremesRecord {
    #[serde(with = "number")]
    normal_min: BigRational,
    #[serde(with = "number")]
    normal_max: BigRational,
    max_shear_ratio: Surd,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Standing", rename = "Standing", deny_unknown_fields)]
struct StandingRecord {
    least: Option<ContactForce<BigRational>>,
    #[serde(with = "number")]
    first_failure: Option<i128>,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Entry", rename = "Entry", deny_unknown_fields)]
struct EntryRecord {
    pile: Pile,
    standing: Standing,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Question", rename = "Question", deny_unknown_fields)]
struct QuestionRecord {
    part: Selection,
    quantity: Quantity,
    method: Option<Method>,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Plan", rename = "Plan", deny_unknown_fields)]
struct PlanRecord {
    method: Method,
    runs: usize,
    #[serde(with = "number")]
    visited: BigUint,
    #[serde(with = "number")]
    turned: BigUint,
    #[serde(with = "number")]
    passes: BigUint,
    #[serde(with = "number")]
    numbers: BigUint,
    bits: u64,
    reserved: u64,
    planes: usize,
    roots: u64,
    #[serde(with = "number")]
    rows: BigUint,
    #[serde(with = "number")]
    bytes: BigUint,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Counters", rename = "Counters", deny_unknown_fields)]
struct CountersRecord {
    #[serde(getter = "Counters::visited")]
    visited: u64,
    #[serde(getter = "Counters::turned")]
    turned: u64,
    #[serde(getter = "Counters::passes")]
    passes: u64,
    #[serde(getter = "Counters::roots")]
    roots: u64,
    #[serde(getter = "Counters::rows")]
    rows: u64,
}

impl From<CountersRecord> for Counters {
    fn from(record: CountersRecord) -> Self {
        Self::of([
            record.visited,
            record.turned,
            record.passes,
            record.roots,
            record.rows,
        ])
    }
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

/// With the keys of scene files, but for the anchor and the loads.
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
