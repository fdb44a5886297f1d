//! Serialisation of numbers as strings, with [serde](https://serde.rs).

use alloc::format;
use alloc::string::String;
use core::fmt;
use core::marker::PhantomData;

use serde::de::{self, Error as _, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::{DoubleDouble, Error, Surd};

/// Deserialises a string and parses it.
///
/// # Errors
/// Returns the errors of the deserialiser and of the parser.
pub fn read_text<'de, T, E: fmt::Display, D: Deserializer<'de>>(
    deserializer: D,
    parser: fn(&str) -> Result<T, E>,
) -> Result<T, D::Error> {
    struct Text<T, E>(fn(&str) -> Result<T, E>, PhantomData<E>);

    impl<T, P: fmt::Display> Visitor<'_> for Text<T, P> {
        type Value = T;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("a string")
        }

        fn visit_str<E: de::Error>(self, text: &str) -> Result<T, E> {
            (self.0)(text).map_err(E::custom)
        }
    }

    deserializer.deserialize_str(Text(parser, PhantomData))
}

impl Serialize for Surd {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Surd {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read_text(deserializer, str::parse)
    }
}

/// A float, written as its shortest decimal that parses to the same float. It is a string because many JSON
/// readers change the last digit of a number.
#[derive(Clone, Copy, Debug)]
pub struct Float(pub f64);

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
                "{:?} is too large as the low part of {:?}; it may be at most half a unit in the last place",
                low.0, high.0
            ))
        })
    }
}
