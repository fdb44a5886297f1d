//! The data types with `Serialize` and `Deserialize` of [serde](https://serde.rs), without a digit lost.
//!
//! ```
//! use cannonpile::lattice::Region;
//! use cannonpile::shape::Selection;
//! use cannonpile::{ContactForce, Pile};
//! use num_rational::BigRational;
//!
//! let pile = Pile::under(Region::hexagon(2, 2)?, "+-".parse()?)?;
//! let text = serde_json::to_string(&pile)?;
//! assert_eq!(serde_json::from_str::<Pile>(&text)?, pile);
//!
//! let forces: Result<Vec<ContactForce<BigRational>>, _> =
//!     pile.statics().contacts(pile.rows(Selection::Layer(1))?).collect();
//! let text = serde_json::to_string(&forces?[0])?;
//! assert_eq!(text, r#"{"site":{"i":"0","j":"-1","k":"1"},"direction":"alpha","force":"2/3"}"#);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Serde
//! | written as | |
//! |---|---|
//! | a string, as it prints | rationals, big integers and `i128` (`"7/3"`, `"12"`), [`Surd`] and [`Spacing`](crate::geometry::Spacing) (`"7/3*sqrt(2)"`), [`FixedRational`], [`Stacking`](crate::stacking::Stacking), [`Pattern`](crate::stacking::Pattern), [`Region`](crate::lattice::Region) (`"hexagon:3,2"`), and names: [`Sign`](crate::lattice::Sign) (`"+"`), [`Direction`](crate::lattice::Direction), [`Verdict`](crate::Verdict), [`Method`](crate::Method), [`Quantity`](crate::Quantity) |
//! | a number | [`Dimension`](crate::lattice::Dimension) (2 or 3), counts below 2⁶⁴, `f32` and `f64` in answers |
//! | a record of its fields | [`Site`](crate::lattice::Site), [`Run`](crate::stacking::Run), [`Row`](crate::lattice::Row), [`Apart`](crate::geometry::Apart), [`Vector`](crate::geometry::Vector), [`Enclosure`](crate::scalar::Enclosure), [`ContactForce`](crate::ContactForce), [`FloorForce`](crate::FloorForce), [`PackedContact`](crate::PackedContact), [`BaseExtremes`](crate::BaseExtremes), [`Standing`](crate::Standing), [`Plan`](crate::Plan), [`Question`](crate::Question), [`Counters`](crate::Counters), [`Entry`](crate::census::Entry), [`At`](crate::scene::parse::At), [`Scene`](crate::scene::Scene) |
//! | a record of strings | [`Interval`] (`lower`, `upper`) and [`DoubleDouble`] (`high`, `low`): many readers of JSON take the last digit of a float less seriously than a bound can bear |
//! | a name and what belongs to it | [`Selection`](crate::shape::Selection), [`Anchor`](crate::scene::Anchor): `"base"`, `{"layer":"3"}` |
//! | what it is made of | [`Pile`](crate::Pile): `dimension`, `sin_phi`, `stacking` (from the top), `anchor`, `weightless`, `weights`, `loads` |
//!
//! What is read goes through the parsers of [`scene::parse`](crate::scene::parse) and the checked constructors: there is
//! no way to a region without a site, a pile that overhangs its base, or 1/0. Keys that are not known are refused. Of a
//! [`Scene`](crate::scene::Scene) any key may be left out. Formats that are not self-describing (postcard, bincode) do as well
//! as JSON.
//!
//! What is written is read back, with two exceptions: exact numbers longer than those parsers read (5,000 digits, which a sum
//! of loads or the forces after thousands of changes of sign can have), and in JSON an `f32` or `f64` that is not finite,
//! for which it has no word. Both are errors, on the way in.
//!
//! Not data, and not here: what borrows a pile ([`Statics`](crate::Statics), [`Packing`](crate::Packing), sweeps),
//! theorems and their polynomials, errors.
//!
//! [`number`] serves fields of your own: `#[serde(with = "cannonpile::serde::number")]`.

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

mod floats;
mod parts;
mod records;
mod scenes;
mod words;

use alloc::vec::Vec;
use core::fmt;

use ::serde::de::{self, Visitor};
use ::serde::{Deserialize, Deserializer, Serialize, Serializer};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;

use crate::Error;
use crate::scalar::{DoubleDouble, FixedInteger, FixedRational, Interval, Surd};
use crate::scene::parse;

/// A number, as the answers of piles hold them: exact ones are strings, floats are numbers.
///
/// Options, vectors and arrays of three of them count as numbers too. A scalar of your own needs this for
/// [`ContactForce`](crate::ContactForce) and its like to be written.
///
/// # Examples
/// ```
/// use num_rational::BigRational;
/// use serde::Serialize;
///
/// #[derive(Serialize)]
/// struct Probe {
///     #[serde(with = "cannonpile::serde::number")]
///     force: BigRational,
///     #[serde(with = "cannonpile::serde::number")]
///     offset: Option<i128>,
/// }
///
/// let probe = Probe { force: BigRational::new(7.into(), 3.into()), offset: None };
/// assert_eq!(serde_json::to_string(&probe)?, r#"{"force":"7/3","offset":null}"#);
/// # Ok::<(), serde_json::Error>(())
/// ```
pub trait Number: Sized {
    /// Writes the number.
    ///
    /// # Errors
    /// Those of the serializer, and of a number that has no value.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error>;

    /// Reads the number.
    ///
    /// # Errors
    /// Those of the deserializer, and of a text that is not such a number.
    fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error>;
}

/// For `#[serde(with = "cannonpile::serde::number")]` on fields that are a [`Number`].
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
    /// let written = cannonpile::serde::number::serialize(&BigInt::from(12), serde_json::value::Serializer)?;
    /// assert_eq!(written, "12");
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
    /// let number: BigRational = cannonpile::serde::number::deserialize(&mut text)?;
    /// assert_eq!(number.to_string(), "6/5");
    /// let mut text = serde_json::Deserializer::from_str(r#""1/0""#);
    /// assert!(cannonpile::serde::number::deserialize::<BigRational, _>(&mut text).is_err());
    /// # Ok::<(), serde_json::Error>(())
    /// ```
    pub fn deserialize<'de, T: Number, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<T, D::Error> {
        T::deserialize(deserializer)
    }
}

/// Reads a string by a parser.
fn read_text<'de, T, D: Deserializer<'de>>(
    deserializer: D,
    parser: fn(&str) -> Result<T, Error>,
) -> Result<T, D::Error> {
    struct Text<T>(fn(&str) -> Result<T, Error>);

    impl<T> Visitor<'_> for Text<T> {
        type Value = T;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("a string")
        }

        fn visit_str<E: de::Error>(self, text: &str) -> Result<T, E> {
            (self.0)(text).map_err(E::custom)
        }
    }

    deserializer.deserialize_str(Text(parser))
}

/// Numbers that are written as they print.
macro_rules! as_text {
    ($($type:ty: $parser:expr;)*) => {$(
        impl Number for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }

            fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                read_text(deserializer, $parser)
            }
        }
    )*};
}

as_text! {
    BigRational: parse::rational;
    i128: parse::integer;
    BigInt: parse::big_integer;
    BigUint: natural;
}

fn natural(text: &str) -> Result<BigUint, Error> {
    let natural = BigUint::try_from(parse::big_integer(text)?);
    natural.map_err(|_| Error::syntax(text, "a number that is not negative"))
}

/// Numbers that serde knows, or that have their implementation here.
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

/// A number for serde's own containers.
struct Written<'a, T>(&'a T);

impl<T: Number> Serialize for Written<'_, T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

/// A number from serde's own containers.
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
        Serialize::serialize(&self.each_ref().map(Written), serializer)
    }

    fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let read: [Read<T>; 3] = Deserialize::deserialize(deserializer)?;
        Ok(read.map(|read| read.0))
    }
}
