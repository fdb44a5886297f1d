//! Serialisation of numbers with [serde](https://serde.rs): exact numbers as strings. For integers see
//! [integers](super::integers).

use alloc::format;
use alloc::vec::Vec;
use core::ops::Range;

use ::serde::de::Error as _;
use ::serde::{Deserialize, Deserializer, Serialize, Serializer};
use num_bigint::BigInt;
use num_rational::BigRational;

use exact_surd::text::{Float, read_text};

use crate::Error;
use crate::each::Each;
use crate::scalar::parse::rational;
use crate::scalar::{DoubleDouble, FixedInteger, FixedRational, Interval, Surd};

/// A number in the results of this crate. Rationals and surds are strings, and floats are numbers.
///
/// In a text format such as JSON an integer within ±(2⁵³ − 1) is a number, and a greater one is a string, since many
/// parsers store numbers as floats. Both forms are accepted. In a binary format `i128` and big integers are strings,
/// and counts are numbers.
///
/// Options, vectors and arrays of three numbers implement the trait too. A scalar of your own needs it for the
/// serialisation of [`ContactForce`](crate::ContactForce) and similar types.
///
/// # Examples
/// ```
/// use num_rational::BigRational;
/// use serde::Serialize;
///
/// #[derive(Serialize)]
/// struct Probe {
///     #[serde(with = "cannonpile::data::number")]
///     force: BigRational,
///     #[serde(with = "cannonpile::data::number")]
///     offset: Option<i128>,
/// }
///
/// let written = |offset| {
///     let force = BigRational::new(7.into(), 3.into());
///     serde_json::to_string(&Probe { force, offset })
/// };
/// assert_eq!(written(None)?, r#"{"force":"7/3","offset":null}"#);
/// assert_eq!(written(Some(-12))?, r#"{"force":"7/3","offset":-12}"#);
/// assert_eq!(written(Some(1 << 53))?, r#"{"force":"7/3","offset":"9007199254740992"}"#);
/// # Ok::<(), serde_json::Error>(())
/// ```
pub trait Number: Sized {
    /// Writes the number.
    ///
    /// # Errors
    /// The errors of the serializer; a number without a value, such as a fault.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error>;

    /// Reads the number.
    ///
    /// # Errors
    /// The errors of the deserializer; a text that does not represent such a number.
    fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error>;
}

/// Functions for `#[serde(with = "cannonpile::data::number")]` on fields that implement [`Number`].
pub mod number {
    use super::{Deserializer, Number, Serializer};

    /// Writes the number.
    ///
    /// # Errors
    /// As for [`Number::serialize`].
    ///
    /// # Examples
    /// ```
    /// use num_bigint::BigInt;
    ///
    /// let written = cannonpile::data::number::serialize(&BigInt::from(12), serde_json::value::Serializer)?;
    /// assert_eq!(written, 12);
    /// # Ok::<(), serde_json::Error>(())
    /// ```
    pub fn serialize<T: Number, S: Serializer>(
        value: &T,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        value.serialize(serializer)
    }

    /// Reads the number.
    ///
    /// # Errors
    /// As for [`Number::deserialize`].
    ///
    /// # Examples
    /// ```
    /// use num_rational::BigRational;
    ///
    /// let mut text = serde_json::Deserializer::from_str(r#""1.2""#);
    /// let number: BigRational = cannonpile::data::number::deserialize(&mut text)?;
    /// assert_eq!(number.to_string(), "6/5");
    /// for text in ["12", r#""12""#] {
    ///     let mut text = serde_json::Deserializer::from_str(text);
    ///     assert_eq!(cannonpile::data::number::deserialize::<i128, _>(&mut text)?, 12);
    /// }
    /// let mut text = serde_json::Deserializer::from_str(r#""1/0""#);
    /// assert!(cannonpile::data::number::deserialize::<BigRational, _>(&mut text).is_err());
    /// # Ok::<(), serde_json::Error>(())
    /// ```
    pub fn deserialize<'de, T: Number, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<T, D::Error> {
        T::deserialize(deserializer)
    }
}

/// Implements serde for types that are written as a string. `Display` prints the string, and `FromStr` parses it. An
/// optional format replaces `{}`.
#[doc(hidden)]
#[macro_export]
macro_rules! as_text {
    ($($type:ty $(: $format:literal)?),*) => {$(
        impl ::serde::Serialize for $type {
            fn serialize<S: ::serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(&format_args!(concat!("{" $(, $format)?, "}"), self))
            }
        }

        impl<'de> ::serde::Deserialize<'de> for $type {
            fn deserialize<D: ::serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $crate::data::read_text(deserializer, str::parse)
            }
        }
    )*};
}

pub use as_text;

impl Number for BigRational {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }

    fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read_text(deserializer, rational)
    }
}

/// Implements [`Number`] for numbers that implement the traits of serde.
macro_rules! as_it_is {
    ($($type:ty)*) => {$(
        impl Number for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                Serialize::serialize(self, serializer)
            }

            fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                Deserialize::deserialize(deserializer)
            }
        }
    )*};
}

as_it_is!(f32 f64 Surd Interval DoubleDouble);

impl<I: FixedInteger> Number for FixedRational<I> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Serialize::serialize(self, serializer)
    }

    fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Deserialize::deserialize(deserializer)
    }
}

/// A reference to a number that implements `Serialize`, for the containers of serde.
struct Written<'a, T>(&'a T);

impl<T: Number> Serialize for Written<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

/// A number that implements `Deserialize`, for the containers of serde.
struct Read<T>(T);

impl<'de, T: Number> Deserialize<'de> for Read<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::deserialize(deserializer).map(Self)
    }
}

impl<T: Number> Number for Option<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Serialize::serialize(&self.as_ref().map(Written), serializer)
    }

    fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read: Option<Read<T>> = Deserialize::deserialize(deserializer)?;
        Ok(read.map(|read| read.0))
    }
}

impl<T: Number> Number for Vec<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter().map(Written))
    }

    fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read: Vec<Read<T>> = Deserialize::deserialize(deserializer)?;
        Ok(read.into_iter().map(|read| read.0).collect())
    }
}

impl<T: Number> Number for [T; 3] {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Serialize::serialize(&self.each_ref().each(Written), serializer)
    }

    fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read: [Read<T>; 3] = Deserialize::deserialize(deserializer)?;
        Ok(read.each(|read| read.0))
    }
}

impl Number for Range<i128> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Ends::serialize(self, serializer)
    }

    fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ends::deserialize(deserializer)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Range<i128>", rename = "Range", deny_unknown_fields)]
struct Ends {
    #[serde(with = "number")]
    start: i128,
    #[serde(with = "number")]
    end: i128,
}

impl<I: FixedInteger> Serialize for FixedRational<I> {
    /// Writes the number. A fault is an error.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.to_rational() {
            Some(value) => Number::serialize(&value, serializer),
            None => Err(::serde::ser::Error::custom(Error::overflow(
                "a number",
                I::RATIONAL_NAME,
            ))),
        }
    }
}

impl<'de, I: FixedInteger> Deserialize<'de> for FixedRational<I> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read_text(deserializer, |text| {
            let (numer, denom) = rational(text)?.into_raw();
            let part = |n: BigInt| I::try_from(n).ok();
            let parts = part(numer).zip(part(denom));
            let value = parts.map(|(numer, denom)| Self::new(numer, denom));
            value
                .filter(|value| value.parts().is_some())
                .ok_or(Error::overflow("a number", I::RATIONAL_NAME))
        })
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Interval", deny_unknown_fields)]
struct Bounds {
    lower: Float,
    upper: Float,
}

impl Serialize for Interval {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (lower, upper) = (Float(self.lower()), Float(self.upper()));
        Bounds { lower, upper }.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Interval {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let Bounds { lower, upper } = Bounds::deserialize(deserializer)?;
        let (lower, upper) = (lower.0, upper.0);
        Self::new(lower, upper).ok_or_else(|| {
            D::Error::custom(format!(
                "no real number lies between {lower:?} and {upper:?}: lower must be at most upper"
            ))
        })
    }
}
