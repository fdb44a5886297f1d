//! The numbers of an array.

use core::fmt::Write;
use core::str::FromStr;

use super::coding::{Order, room};
use crate::error::Syntax;

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
        let size = match kind {
            "Int8" | "UInt8" => 1,
            "Int16" | "UInt16" => 2,
            "Float32" | "Int32" | "UInt32" => 4,
            "Float64" | "Int64" | "UInt64" => 8,
            "String" => return Ok(Self::texts(bytes)),
            other => return Err(unknown(other)),
        };
        let parts = bytes.chunks_exact(size);
        drop(room::<u64>(parts.len())?);
        // The bytes of each number, the least significant one first, and zeros.
        let numbers = parts.map(|part| {
            let mut number = [0; size_of::<u64>()];
            number[..size].copy_from_slice(part);
            if let Order::Big = order {
                number[..size].reverse();
            }
            number
        });
        let zeros = 8 * (size_of::<u64>() - size);
        Ok(match kind {
            "Float64" => Self::Floats(numbers.map(f64::from_le_bytes).collect()),
            "Float32" => {
                let single = |[a, b, c, d, ..]: [u8; 8]| f32::from_le_bytes([a, b, c, d]).into();
                Self::Floats(numbers.map(single).collect())
            }
            unsigned if unsigned.starts_with('U') => {
                let numbers = numbers.map(|number| u64::from_le_bytes(number).try_into().ok());
                let numbers: Option<_> = numbers.collect();
                Self::Integers(numbers.ok_or("a number beyond i64")?)
            }
            _ => {
                let signed = |number| i64::from_le_bytes(number) << zeros >> zeros;
                Self::Integers(numbers.map(signed).collect())
            }
        })
    }
}

/// Parses the numbers in a text. Fortran writes the exponent after `D`.
fn numbers<T: FromStr>(text: &str, expected: &'static str) -> Result<Vec<T>, String> {
    let words = text.split_ascii_whitespace();
    let number = |word: &str| {
        word.parse()
            .or_else(|_| word.replace(['d', 'D'], "e").parse())
    };
    let numbers = words.map(|word| number(word).map_err(|_| Syntax::new(word, expected)));
    numbers
        .collect::<Result<_, _>>()
        .map_err(|error| error.to_string())
}

fn unknown(kind: &str) -> String {
    Syntax::new(
        kind,
        "one of the types Float32, Float64, String and integers of 8 to 64 bits",
    )
    .to_string()
}
