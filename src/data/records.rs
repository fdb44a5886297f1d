//! Serialisation of types that are records of their fields. The copies below add the format of each field.

use ::serde::{Deserialize, Deserializer, Serialize, Serializer};
use num_bigint::BigUint;
use num_rational::BigRational;

use crate::census::Entry;
use crate::data::{Number, number};
use crate::lattice::{ContactKind, Direction, Site};
use crate::scalar::Surd;
use crate::shape::Selection;
use crate::{
    BaseExtremes, ContactForce, Counters, FloorForce, Method, PackedContact, Pile, Plan, Quantity,
    Question, Standing,
};

/// Implements the traits of serde for a type through the derived implementations of its copy.
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
    ContactForce as ContactForceRecord<T>;
    FloorForce as FloorForceRecord<T>;
    PackedContact as PackedContactRecord;
    BaseExtremes as BaseExtremesRecord;
    Standing as StandingRecord;
    Entry as EntryRecord;
    Question as QuestionRecord;
    Plan as PlanRecord;
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
    direction: ContactKind,
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
    #[serde(with = "number")]
    runs: usize,
    #[serde(with = "number")]
    visited: BigUint,
    #[serde(with = "number")]
    turned: BigUint,
    #[serde(with = "number")]
    passes: BigUint,
    #[serde(with = "number")]
    numbers: BigUint,
    #[serde(with = "number")]
    bits: u64,
    #[serde(with = "number")]
    reserved: u64,
    #[serde(with = "number")]
    planes: usize,
    #[serde(with = "number")]
    roots: u64,
    #[serde(with = "number")]
    rows: BigUint,
    #[serde(with = "number")]
    bytes: BigUint,
}

#[derive(Serialize)]
#[serde(rename = "Counters")]
struct CountersRecord {
    #[serde(with = "number")]
    visited: u64,
    #[serde(with = "number")]
    turned: u64,
    #[serde(with = "number")]
    passes: u64,
    #[serde(with = "number")]
    rows: u64,
}

impl Serialize for Counters {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let record = CountersRecord {
            visited: self.visited(),
            turned: self.turned(),
            passes: self.passes(),
            rows: self.rows(),
        };
        record.serialize(serializer)
    }
}
