//! Serialisation of enums as the strings that `Display` prints.

use alloc::string::ToString;

use ::serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::data::read_text;
use crate::{Error, Method, Quantity, Verdict};

macro_rules! words {
    ($($type:ty: $parser:expr;)*) => {$(
        impl Serialize for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
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
    Verdict: verdict;
    Method: method;
    Quantity: quantity;
}

/// Returns the value in `all` that prints as `text`.
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
