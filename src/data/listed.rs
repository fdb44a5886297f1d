//! Serialisation of maps as lists of records, since their keys are not strings.

use alloc::collections::BTreeMap;
use alloc::format;
use core::fmt;
use core::marker::PhantomData;

use ::serde::de::{DeserializeOwned, Error as _, SeqAccess, Visitor};
use ::serde::{Deserialize, Deserializer, Serialize, Serializer};
use num_rational::BigRational;

use crate::data::number;
use crate::lattice::{Axis, HorizontalContact, Site};

/// The key of a map, and the record that represents an entry.
pub trait Key: Copy + Ord + fmt::Display {
    /// The value type of the map.
    type Held;
    /// The record of key and value.
    type Entry: Serialize + DeserializeOwned;
    /// The values in the message about a duplicate key, such as `forces of the horizontal contact`.
    const HELD: &'static str;

    fn entry(self, held: &Self::Held) -> Self::Entry;

    fn parts(entry: Self::Entry) -> (Self, Self::Held);
}

/// The record of the force of a horizontal contact.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Push {
    site: Site,
    axis: Axis,
    #[serde(with = "number")]
    force: BigRational,
}

impl Key for HorizontalContact {
    type Held = BigRational;
    type Entry = Push;
    const HELD: &'static str = "forces of the horizontal contact";

    fn entry(self, force: &BigRational) -> Push {
        let (Self { site, axis }, force) = (self, force.clone());
        Push { site, axis, force }
    }

    fn parts(Push { site, axis, force }: Push) -> (Self, BigRational) {
        (Self { site, axis }, force)
    }
}

/// The record of the values of a field on a sphere, by direction.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Values {
    site: Site,
    #[serde(with = "number")]
    alpha: BigRational,
    #[serde(with = "number")]
    beta: BigRational,
    #[serde(with = "number")]
    gamma: BigRational,
}

impl Key for Site {
    type Held = [BigRational; 3];
    type Entry = Values;
    const HELD: &'static str = "values of the field on the sphere (i,j,k) =";

    fn entry(self, field: &[BigRational; 3]) -> Values {
        let (site, [alpha, beta, gamma]) = (self, field.clone());
        Values {
            site,
            alpha,
            beta,
            gamma,
        }
    }

    fn parts(values: Values) -> (Self, [BigRational; 3]) {
        let Values {
            site,
            alpha,
            beta,
            gamma,
        } = values;
        (site, [alpha, beta, gamma])
    }
}

/// Writes a map as a list of records.
///
/// # Errors
/// The errors of the serializer.
pub fn serialize<K: Key, S: Serializer>(
    map: &BTreeMap<K, K::Held>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(map.iter().map(|(key, held)| key.entry(held)))
}

/// Reads a map from a list of records.
///
/// # Errors
/// The errors of the deserializer; a duplicate key.
pub fn deserialize<'de, K: Key, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<BTreeMap<K, K::Held>, D::Error> {
    deserializer.deserialize_seq(Listed(PhantomData))
}

struct Listed<K>(PhantomData<K>);

impl<'de, K: Key> Visitor<'de> for Listed<K> {
    type Value = BTreeMap<K, K::Held>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut map = BTreeMap::new();
        while let Some(entry) = list.next_element()? {
            let (key, held) = K::parts(entry);
            if map.insert(key, held).is_some() {
                // Otherwise one of the two values would be ignored silently.
                return Err(A::Error::custom(format!(
                    "two {} {key}: leave one of them out",
                    K::HELD
                )));
            }
        }
        Ok(map)
    }
}
