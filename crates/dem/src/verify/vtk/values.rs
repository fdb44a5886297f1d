//! The numbers of an array.

use core::fmt::Write;
use core::str::FromStr;

use cannonpile::engine::refuse_beyond_memory;

use super::coding::{MOST, Order};
use crate::Error;

/// The numbers or texts of an array.
pub(super) enum Values {
    Floats(Vec<f64>),
    Integers(Vec<i64>),
    Texts(Vec<String>),
}

impl Values {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Floats(values) => values.len(),
            Self::Integers(values) => values.len(),
            Self::Texts(values) => values.len(),
        }
    }

    /// Appends the n-th value to `text`. A number parses to the same number. Returns `None` beyond the end.
    pub(super) fn write(&self, n: usize, text: &mut String) -> Option<()> {
        // The shortest floats that are integers beyond this one have zeros in place of digits.
        const LARGEST: f64 = 1e15;
        // Writing to a String never fails.
        let _ = match self {
            // Kinds and sphere numbers may be floats.
            Self::Floats(values) => match values.get(n)? {
                x if x.fract() == 0.0 && x.abs() < LARGEST => write!(text, "{x}"),
                x => write!(text, "{x:?}"),
            },
            Self::Integers(values) => write!(text, "{}", values.get(n)?),
            Self::Texts(values) => write!(text, "{}", values.get(n)?),
        };
        Some(())
    }

    /// Returns the numbers if their type is an integer type.
    pub(super) fn integers(self) -> Option<Vec<i64>> {
        match self {
            Self::Integers(values) => Some(values),
            Self::Floats(_) | Self::Texts(_) => None,
        }
    }

    /// Returns the n-th number if the type is an integer type.
    pub(super) fn integer(&self, n: usize) -> Option<i64> {
        match self {
            Self::Integers(values) => values.get(n).copied(),
            Self::Floats(_) | Self::Texts(_) => None,
        }
    }

    /// Returns the texts of bytes in which a zero ends each text.
    fn texts(bytes: &[u8]) -> Self {
        let texts = bytes
            .strip_suffix(b"\0")
            .unwrap_or(bytes)
            .split(|byte| *byte == 0);
        Self::Texts(
            texts
                .map(|text| String::from_utf8_lossy(text).into_owned())
                .collect(),
        )
    }

    /// Reads numbers in text. VTK's XML writes texts as the numbers of their bytes, and legacy files as lines.
    pub(super) fn of_text(kind: &str, text: &[u8]) -> Result<Self, String> {
        let text = core::str::from_utf8(text).map_err(|_| "its numbers are not text".to_owned())?;
        match kind {
            "Float32" | "Float64" => numbers(text, "a number").map(Self::Floats),
            "Int8" | "UInt8" | "Int16" | "UInt16" | "Int32" | "UInt32" | "Int64" | "UInt64" => {
                numbers(text, "a whole number").map(Self::Integers)
            }
            "String" => Ok(Self::texts(&numbers(text, "the number of a byte")?)),
            // The first text is on the next line.
            "string" => Ok(Self::Texts(
                text.lines().skip(1).map(str::to_owned).collect(),
            )),
            other => Err(unknown(other)),
        }
    }

    /// Reads numbers in binary form, each of eight bytes in memory.
    pub(super) fn of_bytes(kind: &str, order: Order, bytes: &[u8]) -> Result<Self, String> {
        macro_rules! numbers {
            ($kind:ty, $values:ident, $to:ty) => {{
                let parts = bytes.chunks_exact(size_of::<$kind>());
                refuse_beyond_memory(
                    "an array",
                    &parts.len().into(),
                    (MOST, size_of::<$to>()),
                    "write only the numbers of the spheres and contacts",
                )
                .map_err(|error| error.to_string())?;
                let numbers = parts.map(|part| {
                    // Each chunk has this length, so the default is never used.
                    let part = part.try_into().unwrap_or([0; size_of::<$kind>()]);
                    let number = match order {
                        Order::Big => <$kind>::from_be_bytes(part),
                        Order::Little => <$kind>::from_le_bytes(part),
                    };
                    <$to>::try_from(number).ok()
                });
                let numbers: Option<Vec<$to>> = numbers.collect();
                Self::$values(numbers.ok_or("a number beyond i64")?)
            }};
        }
        Ok(match kind {
            "Float64" => numbers!(f64, Floats, f64),
            "Float32" => numbers!(f32, Floats, f64),
            "Int8" => numbers!(i8, Integers, i64),
            "UInt8" => numbers!(u8, Integers, i64),
            "Int16" => numbers!(i16, Integers, i64),
            "UInt16" => numbers!(u16, Integers, i64),
            "Int32" => numbers!(i32, Integers, i64),
            "UInt32" => numbers!(u32, Integers, i64),
            "Int64" => numbers!(i64, Integers, i64),
            "UInt64" => numbers!(u64, Integers, i64),
            "String" => Self::texts(bytes),
            other => return Err(unknown(other)),
        })
    }
}

/// Parses the numbers in a text.
fn numbers<T: FromStr>(text: &str, expected: &'static str) -> Result<Vec<T>, String> {
    let words = text.split_ascii_whitespace();
    let numbers = words.map(|word| word.parse().map_err(|_| Error::syntax(word, expected)));
    numbers
        .collect::<Result<_, _>>()
        .map_err(|error| error.to_string())
}

fn unknown(kind: &str) -> String {
    Error::syntax(
        kind,
        "one of the types Float32, Float64, String and integers of 8 to 64 bits",
    )
    .to_string()
}
