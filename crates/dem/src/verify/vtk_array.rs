//! The numbers of an array in VTK's XML: as text, in base64 or appended, possibly compressed.

use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;

use crate::Error;
use cannonpile::engine::refuse_beyond_memory;

/// The largest size of an array, in bytes.
const MOST: u64 = 1 << 33;

/// The numbers of an array.
pub(super) enum Values {
    Floats(Vec<f64>),
    Integers(Vec<i64>),
}

impl Values {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Floats(values) => values.len(),
            Self::Integers(values) => values.len(),
        }
    }

    /// Returns the n-th number as text that parses to the same number.
    pub(super) fn text(&self, n: usize) -> Option<String> {
        match self {
            Self::Floats(values) => values.get(n).map(|value| format!("{value:?}")),
            Self::Integers(values) => values.get(n).map(ToString::to_string),
        }
    }

    /// Returns the n-th number as an index.
    pub(super) fn index(&self, n: usize) -> Option<usize> {
        match self {
            Self::Floats(_) => None,
            Self::Integers(values) => usize::try_from(*values.get(n)?).ok(),
        }
    }
}

/// The encoding of the arrays of a file.
#[derive(Default)]
pub(super) struct Coding<'f> {
    order: Order,
    header: HeaderType,
    is_compressed: bool,
    appended: &'f [u8],
    is_appended_raw: bool,
}

/// The byte order of numbers.
#[derive(Clone, Copy, Default, PartialEq)]
enum Order {
    #[default]
    Little,
    Big,
}

/// The type of the header numbers before an array.
#[derive(Clone, Copy, Default, PartialEq)]
enum HeaderType {
    #[default]
    UInt32,
    UInt64,
}

impl<'f> Coding<'f> {
    /// Sets an attribute of the file.
    pub(super) fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
        match (key, value) {
            ("byte_order", "BigEndian") => self.order = Order::Big,
            ("header_type", "UInt64") => self.header = HeaderType::UInt64,
            ("compressor", "vtkZLibDataCompressor") => self.is_compressed = true,
            ("compressor", other) if !other.is_empty() => {
                return Err(format!(
                    "compressed by {other:?}: write it with zlib, or as text"
                ));
            }
            _ => {}
        }
        Ok(())
    }

    /// Sets the appended data, which begin with their tag.
    pub(super) fn append(&mut self, appended: &'f [u8]) {
        let tag = appended.iter().position(|byte| *byte == b'>');
        let (tag, rest) = appended.split_at(tag.map_or(appended.len(), |end| end + 1));
        self.is_appended_raw = tag.windows(5).any(|part| part == b"\"raw\"");
        let begin = rest.iter().position(|byte| *byte == b'_');
        self.appended = begin.map_or(&[], |begin| rest.get(begin + 1..).unwrap_or(&[]));
    }

    /// Reads an array of a given type and format, from the text of its tag or from an offset in the appended data.
    pub(super) fn read(
        &self,
        kind: Option<&str>,
        format: Option<&str>,
        offset: Option<&str>,
        text: &str,
    ) -> Result<Values, String> {
        let kind = kind.unwrap_or("Float32");
        match format.unwrap_or("ascii") {
            "ascii" => of_text(kind, text),
            "binary" => {
                let text: Vec<u8> = text
                    .bytes()
                    .filter(|byte| !byte.is_ascii_whitespace())
                    .collect();
                self.of_bytes(kind, &self.based(&text)?)
            }
            "appended" => {
                let offset = offset.and_then(|offset| offset.parse().ok());
                let rest = offset.and_then(|offset: usize| self.appended.get(offset..));
                let rest = rest.ok_or("it is not in the appended data")?;
                let bytes = if self.is_appended_raw {
                    self.raw(rest)?
                } else {
                    self.based(rest)?
                };
                self.of_bytes(kind, &bytes)
            }
            other => Err(format!("format {other:?} is not ascii, binary or appended")),
        }
    }

    /// Returns the size of a header number, in bytes.
    const fn size(&self) -> usize {
        match self.header {
            HeaderType::UInt32 => 4,
            HeaderType::UInt64 => 8,
        }
    }

    fn whole(&self, bytes: &[u8]) -> Option<usize> {
        let all = bytes.iter().copied();
        let digits: Vec<u8> = if self.order == Order::Big {
            all.collect()
        } else {
            all.rev().collect()
        };
        let number = digits
            .iter()
            .fold(0_u64, |sum, byte| sum << 8 | u64::from(*byte));
        // The comparison precedes the conversion, because `usize` may have 32 bits.
        let number = Some(number).filter(|number| *number <= MOST)?;
        usize::try_from(number).ok()
    }

    /// Returns the n-th number of a header.
    fn length(&self, bytes: &[u8], n: usize) -> Result<usize, String> {
        let begin = n.checked_mul(self.size());
        let part = begin.and_then(|begin| bytes.get(begin..begin.checked_add(self.size())?));
        let number = part.and_then(|part| self.whole(part));
        number.ok_or_else(|| "it is cut off, or too long".to_owned())
    }

    /// Decodes base64. In compressed data the header is encoded alone, otherwise together with the numbers.
    fn based(&self, text: &[u8]) -> Result<Vec<u8>, String> {
        let decoded = |length: usize| {
            let length = length.div_ceil(3).checked_mul(4);
            let part = length.and_then(|length| Some((text.get(..length)?, length)));
            let (part, length) = part.ok_or("it is cut off")?;
            let bytes = STANDARD.decode(part).map_err(|error| error.to_string())?;
            Ok::<_, String>((bytes, length))
        };
        if !self.is_compressed {
            let (head, _) = decoded(self.size())?;
            let length = self.length(&head, 0)?;
            let (bytes, _) = decoded(self.size().saturating_add(length))?;
            return Ok(bytes.get(self.size()..).unwrap_or(&[]).to_vec());
        }
        let (head, _) = decoded(self.size())?;
        let blocks = self.length(&head, 0)?;
        let head = blocks
            .checked_add(3)
            .and_then(|n| n.checked_mul(self.size()));
        let (head, after) = decoded(head.ok_or("too long")?)?;
        let mut total = 0_usize;
        for block in 0..blocks {
            total = total.saturating_add(self.length(&head, 3 + block)?);
        }
        let length = total.div_ceil(3).checked_mul(4);
        let part = length.and_then(|length| text.get(after..after.checked_add(length)?));
        let packed = STANDARD.decode(part.ok_or("it is cut off")?);
        self.unpacked(&head, &packed.map_err(|error| error.to_string())?)
    }

    /// Reads raw appended data.
    fn raw(&self, bytes: &[u8]) -> Result<Vec<u8>, String> {
        if !self.is_compressed {
            let length = self.length(bytes, 0)?;
            let part = bytes.get(self.size()..self.size().saturating_add(length));
            return Ok(part.ok_or("it is cut off")?.to_vec());
        }
        let blocks = self.length(bytes, 0)?;
        let head = blocks
            .checked_add(3)
            .and_then(|n| n.checked_mul(self.size()));
        let parts = head.and_then(|head| bytes.split_at_checked(head));
        let (head, packed) = parts.ok_or("it is cut off")?;
        self.unpacked(head, packed)
    }

    /// Decompresses the blocks after a header.
    fn unpacked(&self, head: &[u8], mut packed: &[u8]) -> Result<Vec<u8>, String> {
        let blocks = self.length(head, 0)?;
        let mut bytes = Vec::new();
        for block in 0..blocks {
            let length = self.length(head, 3 + block)?;
            let (part, rest) = packed.split_at_checked(length).ok_or("it is cut off")?;
            packed = rest;
            let room = MOST.saturating_sub(bytes.len() as u64);
            let unpacked = ZlibDecoder::new(part).take(room).read_to_end(&mut bytes);
            unpacked.map_err(|error| error.to_string())?;
        }
        Ok(bytes)
    }

    /// Converts the bytes of an array to its numbers, each of eight bytes in memory.
    fn of_bytes(&self, kind: &str, bytes: &[u8]) -> Result<Values, String> {
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
                    let number = if self.order == Order::Big {
                        <$kind>::from_be_bytes(part)
                    } else {
                        <$kind>::from_le_bytes(part)
                    };
                    <$to>::try_from(number).ok()
                });
                let numbers: Option<Vec<$to>> = numbers.collect();
                Values::$values(numbers.ok_or("a number beyond i64")?)
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
            other => return Err(unknown(other)),
        })
    }
}

fn unknown(kind: &str) -> String {
    Error::syntax(
        kind,
        "one of the types Float32, Float64 and integers of 8 to 64 bits",
    )
    .to_string()
}

fn of_text(kind: &str, text: &str) -> Result<Values, String> {
    let words = text.split_ascii_whitespace();
    if ["Float32", "Float64"].contains(&kind) {
        let numbers = words.map(|word| word.parse().map_err(|_| word));
        let numbers: Result<_, &str> = numbers.collect();
        return numbers
            .map(Values::Floats)
            .map_err(|word| Error::syntax(word, "a number").to_string());
    }
    let kinds = [
        "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64",
    ];
    if !kinds.contains(&kind) {
        return Err(unknown(kind));
    }
    let numbers = words.map(|word| word.parse().map_err(|_| word));
    let numbers: Result<_, &str> = numbers.collect();
    numbers
        .map(Values::Integers)
        .map_err(|word| Error::syntax(word, "a whole number").to_string())
}
