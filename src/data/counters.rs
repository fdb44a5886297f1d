//! Serialisation of [`Counters`] as a record of numbers, because its fields are atomic.

use ::serde::{Serialize, Serializer};

use crate::Counters;
use crate::data::number;

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
