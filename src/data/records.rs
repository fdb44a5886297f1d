//! What is a record of its public fields: here they are again, each with the way it is written.

use ::serde::{Deserialize, Deserializer, Serialize, Serializer};
use num_bigint::BigUint;
use num_rational::BigRational;

use crate::census::Entry;
use crate::data::{Number, number};
use crate::lattice::{Direction, Link, Site};
use crate::scalar::Surd;
use crate::shape::Selection;
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
    ContactForce as ContactForceRecord<T>;
    FloorForce as FloorForceRecord<T>;
    PackedContact as PackedContactRecord;
    BaseExtremes as BaseExtremesRecord;
    Standing as StandingRecord;
    Entry as EntryRecord;
    Question as QuestionRecord;
    Plan as PlanRecord;
    Counters as CountersRecord;
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
    direction: Link,
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
    #[serde(getter = "Counters::rows")]
    rows: u64,
}

impl From<CountersRecord> for Counters {
    fn from(record: CountersRecord) -> Self {
        Self::of([record.visited, record.turned, record.passes, record.rows])
    }
}
