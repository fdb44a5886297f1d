//! What is one string, as it prints: names, stackings, regions, roots. And the dimension, which is one number.

use alloc::string::ToString;

use ::serde::de::Error as _;
use ::serde::{Deserialize, Deserializer, Serialize, Serializer};
use num_bigint::BigInt;

use super::{Number, read_text};
use crate::geometry::Spacing;
use crate::lattice::Sign;
use crate::lattice::{Dimension, Direction, Region};
use crate::scalar::{FixedInteger, FixedRational, RealSign, Surd};
use crate::scene::{parse, text};
use crate::stacking::{Pattern, Stacking};
use crate::{Error, Method, Quantity, Verdict};

macro_rules! words {
    ($($type:ty: $shown:expr, $parser:expr;)*) => {$(
        impl Serialize for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let shown: fn(&$type) -> _ = $shown;
                serializer.collect_str(&shown(self))
            }
        }

        impl<'de> Deserialize<'de> for $type {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                read_text(deserializer, $parser)
            }
        }
    )*};
}

words! {
    Direction: |direction| direction.name(), parse::direction;
    Sign: |sign| sign.symbol(), sign;
    Verdict: |verdict| verdict.name(), verdict;
    Method: ToString::to_string, method;
    Quantity: ToString::to_string, quantity;
    Region: text::shape, parse::region;
    Stacking: ToString::to_string, str::parse;
    Pattern: text::pattern, parse::stacking;
    Surd: ToString::to_string, parse::surd;
    Spacing: ToString::to_string, spacing;
}

fn sign(text: &str) -> Result<Sign, Error> {
    match text {
        "+" => Ok(Sign::Plus),
        "-" => Ok(Sign::Minus),
        _ => Err(Error::syntax(text, "a sign: + or -")),
    }
}

/// The one of these that prints so.
fn named<T: ToString>(
    text: &str,
    all: impl IntoIterator<Item = T>,
    expected: &'static str,
) -> Result<T, Error> {
    let found = all.into_iter().find(|name| name.to_string() == text);
    found.ok_or_else(|| Error::syntax(text, expected))
}

fn verdict(text: &str) -> Result<Verdict, Error> {
    let all = [Verdict::Yes, Verdict::No, Verdict::Undetermined];
    named(text, all, "a verdict: yes, no or undetermined")
}

fn method(text: &str) -> Result<Method, Error> {
    let all = [Method::Closed, Method::Tree, Method::Sweep];
    named(text, all, "a method: closed, tree or sweep")
}

fn quantity(text: &str) -> Result<Quantity, Error> {
    let all = [
        Quantity::ContactMultiples,
        Quantity::ContactMagnitudes,
        Quantity::ContactVectors,
        Quantity::FloorMultiples,
        Quantity::FloorForces,
        Quantity::Positions,
    ];
    named(
        text,
        all,
        "a quantity: contact multiples, contact magnitudes, contact vectors, floor multiples, floor forces or positions",
    )
}

fn spacing(text: &str) -> Result<Spacing, Error> {
    let ratio = parse::surd(text)?;
    match ratio.sign() {
        RealSign::Positive => Spacing::from_square(ratio.square()),
        _ => Err(Error::syntax(text, "a spacing, which is positive")),
    }
}

impl Serialize for Dimension {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u32(self.number())
    }
}

impl<'de> Deserialize<'de> for Dimension {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let number = u32::deserialize(deserializer)?;
        parse::dimension(&number.to_string()).map_err(D::Error::custom)
    }
}

impl<I: FixedInteger> Serialize for FixedRational<I> {
    /// A fault is no number, and an error.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.to_rational() {
            Some(value) => Number::serialize(&value, serializer),
            None => Err(::serde::ser::Error::custom(Error::Overflow {
                quantity: "a number",
                scalar: I::RATIONAL_NAME,
            })),
        }
    }
}

impl<'de, I: FixedInteger> Deserialize<'de> for FixedRational<I> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        read_text(deserializer, |text| {
            let (numer, denom) = parse::rational(text)?.into_raw();
            let part = |n: BigInt| I::try_from(n).ok();
            let parts = part(numer).zip(part(denom));
            let value = parts.map(|(numer, denom)| Self::new(numer, denom));
            value
                .filter(|value| value.parts().is_some())
                .ok_or(Error::Overflow {
                    quantity: "a number",
                    scalar: I::RATIONAL_NAME,
                })
        })
    }
}
