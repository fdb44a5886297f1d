//! Serialisation of integers with [serde](https://serde.rs): numbers up to 2⁵³ − 1, which `f64` represents exactly,
//! else strings.

use core::fmt;
use core::marker::PhantomData;

use ::serde::de::{self, Visitor};
use ::serde::{Deserialize, Deserializer, Serialize, Serializer};
use alloc::string::ToString;
use num_bigint::{BigInt, BigUint};
use num_traits::ToPrimitive;

use exact_surd::text::read_text;

use super::Number;
use crate::Error;
use crate::scalar::parse::{big_integer, integer};

/// The greatest integer that text formats contain as a number. Up to this limit, distinct integers remain distinct as
/// `f64`.
const GREATEST: i64 = (1 << 53) - 1;

/// Returns the value as a number if it is within the limit.
fn small(value: &impl ToPrimitive) -> Option<i64> {
    let value = value.to_i64()?;
    (-GREATEST..=GREATEST).contains(&value).then_some(value)
}

/// Implements [`Number`] for integers of any size, which are strings in binary formats.
macro_rules! integers {
    ($($type:ty: $parser:expr;)*) => {$(
        impl Number for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                match small(self) {
                    Some(value) if serializer.is_human_readable() => serializer.serialize_i64(value),
                    _ => serializer.collect_str(self),
                }
            }

            fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                if deserializer.is_human_readable() {
                    deserializer.deserialize_any(Integer($parser, PhantomData))
                } else {
                    read_text(deserializer, $parser)
                }
            }
        }
    )*};
}

integers! {
    i128: integer;
    BigInt: big_integer;
    BigUint: natural;
}

/// Implements [`Number`] for counts, which are numbers in binary formats.
macro_rules! counts {
    ($($type:ty)*) => {$(
        impl Number for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                if serializer.is_human_readable() && small(self).is_none() {
                    serializer.collect_str(self)
                } else {
                    Serialize::serialize(self, serializer)
                }
            }

            fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                if deserializer.is_human_readable() {
                    deserializer.deserialize_any(Integer(count, PhantomData))
                } else {
                    Deserialize::deserialize(deserializer)
                }
            }
        }
    )*};
}

counts!(u64 usize);

fn natural(text: &str) -> Result<BigUint, Error> {
    let natural = BigUint::try_from(big_integer(text)?);
    natural.map_err(|_| Error::syntax(text, "a number that is not negative"))
}

fn count<T: TryFrom<BigUint>>(text: &str) -> Result<T, Error> {
    let count = T::try_from(natural(text)?);
    count.map_err(|_| Error::syntax(text, "a count, which is below 2^64"))
}

/// Reads an integer or a string with a parser.
struct Integer<T, E>(fn(&str) -> Result<T, E>, PhantomData<E>);

/// Converts integers of every width to text and parses it.
macro_rules! visit_as_text {
    ($($visit:ident: $type:ty;)*) => {$(
        fn $visit<E: de::Error>(self, value: $type) -> Result<T, E> {
            self.visit_str(&value.to_string())
        }
    )*};
}

impl<T, P: fmt::Display> Visitor<'_> for Integer<T, P> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an integer, as a string if it is beyond 2^53")
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<T, E> {
        (self.0)(text).map_err(E::custom)
    }

    visit_as_text! {
        visit_i64: i64;
        visit_i128: i128;
        visit_u64: u64;
        visit_u128: u128;
    }
}

#[cfg(test)]
mod tests {
    use alloc::format;

    use ::serde::de::IntoDeserializer;
    use ::serde::de::value::Error as Refused;

    use super::*;

    fn read<'de, T: Number>(value: impl IntoDeserializer<'de, Refused>) -> Result<T, Refused> {
        T::deserialize(value.into_deserializer())
    }

    #[test]
    fn integers_are_read_as_numbers_and_as_strings() {
        assert_eq!(
            [read(-12_i64), read(-12_i128), read("-12")],
            [(); 3].map(|()| Ok(-12_i128))
        );
        assert_eq!(
            [read(12_u8), read(12_u64), read("12")],
            [(); 3].map(|()| Ok(12_u64))
        );
        assert_eq!(read("1e36"), Ok(10_i128.pow(36)));
        assert_eq!(read(u64::MAX), Ok(BigUint::from(u64::MAX)));
        assert_eq!(read(u128::MAX), Ok(BigInt::from(u128::MAX)));
        assert_eq!([read(7_u64), read("7")], [Ok(7_usize), Ok(7)]);
    }

    #[test]
    fn rejects_values_of_other_types() {
        assert!(read::<BigUint>(-1_i64).is_err() && read::<u64>("-1").is_err());
        assert!(read::<u64>("18446744073709551616").is_err());
        assert!(read::<i128>(u128::MAX).is_err() && read::<i128>("1/2").is_err());
        let float = read::<i128>(1.5).unwrap_err();
        assert!(
            format!("{float}").ends_with("expected an integer, as a string if it is beyond 2^53")
        );
        assert!(read::<i128>(true).is_err());
    }

    #[test]
    fn only_integers_that_floats_represent_are_numbers() {
        for value in [0, 1, -1, GREATEST, -GREATEST] {
            assert_eq!(small(&value), Some(value));
        }
        for value in [GREATEST + 1, -GREATEST - 1, i64::MAX, i64::MIN] {
            assert_eq!(small(&value), None);
        }
        assert_eq!(small(&BigInt::from(u128::MAX)), None);
    }
}
