//! Numbers made of two floats, each a string that reads back the same.

use alloc::format;
use alloc::string::String;

use ::serde::de::Error as _;
use ::serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::read_text;
use crate::Error;
use crate::scalar::{DoubleDouble, Interval};

/// A float.
struct Float(f64);

impl Serialize for Float {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let shortest: String = format!("{:?}", self.0);
        serializer.serialize_str(&shortest)
    }
}

impl<'de> Deserialize<'de> for Float {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read_text(deserializer, |text| {
            let float = text.parse().map(Self);
            float.map_err(|_| Error::syntax(text, "a float such as 0.1, 1e-3 or inf"))
        })
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Interval", deny_unknown_fields)]
struct Ends {
    lower: Float,
    upper: Float,
}

impl Serialize for Interval {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (lower, upper) = (Float(self.lower()), Float(self.upper()));
        Ends { lower, upper }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Interval {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Ends { lower, upper } = Ends::deserialize(deserializer)?;
        let (lower, upper) = (lower.0, upper.0);
        Self::new(lower, upper).ok_or_else(|| {
            D::Error::custom(format!(
                "no real number lies between {lower:?} and {upper:?}: lower must be at most upper"
            ))
        })
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "DoubleDouble", deny_unknown_fields)]
struct Parts {
    high: Float,
    low: Float,
}

impl Serialize for DoubleDouble {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (high, low) = (Float(self.high()), Float(self.low()));
        Parts { high, low }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for DoubleDouble {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Parts { high, low } = Parts::deserialize(deserializer)?;
        Self::from_parts(high.0, low.0).ok_or_else(|| {
            D::Error::custom(format!(
                "{:?} is too great beside {:?}: at most half a unit in the last place",
                low.0, high.0
            ))
        })
    }
}
