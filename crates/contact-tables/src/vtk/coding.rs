//! The binary forms of arrays in VTK's XML: base64 or appended, possibly compressed.

use std::io::Read;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;

use crate::error::{Error, Syntax, quoted};

/// The largest size of an array, in bytes.
const MOST: u64 = 1 << 33;

/// The encoding of the arrays of a file.
#[derive(Clone, Default)]
pub(super) struct Coding<'f> {
    pub(super) order: Order,
    /// True if the header numbers before an array have eight bytes, not four.
    has_long_header: bool,
    compressor: String,
    appended: &'f [u8],
    is_appended_raw: bool,
}

/// The byte order of numbers.
#[derive(Clone, Copy, Default, PartialEq)]
pub(super) enum Order {
    #[default]
    Little,
    Big,
}

impl<'f> Coding<'f> {
    /// Returns the encoding of legacy files.
    pub(super) fn legacy() -> Self {
        Self {
            order: Order::Big,
            ..Self::default()
        }
    }

    /// Sets an attribute of the file.
    pub(super) fn set(&mut self, key: &str, value: &str) -> Result<(), Error> {
        match (key, value) {
            ("byte_order", "LittleEndian") => self.order = Order::Little,
            ("byte_order", "BigEndian") => self.order = Order::Big,
            ("byte_order", _) => return Err(unknown(key, value, "LittleEndian or BigEndian")),
            ("header_type", "UInt32") => self.has_long_header = false,
            ("header_type", "UInt64") => self.has_long_header = true,
            ("header_type", _) => return Err(unknown(key, value, "UInt32 or UInt64")),
            ("compressor", name) => name.clone_into(&mut self.compressor),
            _ => {}
        }
        Ok(())
    }

    /// Sets the appended data: what follows the start tag.
    pub(super) fn append(&mut self, data: &'f [u8], is_raw: bool) {
        self.is_appended_raw = is_raw;
        let begin = data.iter().position(|byte| *byte == b'_');
        let data = begin.and_then(|begin| data.get(begin + 1..));
        // Without an underscore there are no data.
        self.appended = data.unwrap_or_default();
    }

    /// Returns the bytes of an array in base64, in the text of its element.
    pub(super) fn inline(&self, text: &[u8]) -> Result<Vec<u8>, String> {
        let mut text = text.to_vec();
        text.retain(|byte| !byte.is_ascii_whitespace());
        self.based(&text)
    }

    /// Returns the bytes of an array at an offset in the appended data.
    pub(super) fn at(&self, offset: Option<usize>) -> Result<Vec<u8>, String> {
        let rest = offset.and_then(|offset| self.appended.get(offset..));
        let rest = rest.ok_or("it is not in the appended data")?;
        if self.is_appended_raw {
            self.raw(rest)
        } else {
            self.based(rest)
        }
    }

    /// Returns whether arrays are compressed.
    fn is_compressed(&self) -> Result<bool, String> {
        match &*self.compressor {
            "" => Ok(false),
            "vtkZLibDataCompressor" => Ok(true),
            name => Err(format!(
                "it is compressed by {}: write the file with zlib (vtkZLibDataCompressor), without compression or as \
                 text",
                quoted(name)
            )),
        }
    }

    /// Returns the size of a header number, in bytes.
    const fn size(&self) -> usize {
        if self.has_long_header { 8 } else { 4 }
    }

    /// Returns the n-th number of a header.
    fn length(&self, bytes: &[u8], n: usize) -> Result<usize, String> {
        let begin = n.checked_mul(self.size());
        let part = begin.and_then(|begin| bytes.get(begin..begin.checked_add(self.size())?));
        let mut digits = part.ok_or("it is cut off")?.to_vec();
        if self.order == Order::Little {
            digits.reverse();
        }
        let digits = digits.iter();
        let number = digits.fold(0_u64, |sum, byte| sum << 8 | u64::from(*byte));
        // The comparison precedes the conversion, because `usize` may have 32 bits.
        let number = Some(number).filter(|number| *number <= MOST);
        let number = number.and_then(|number| usize::try_from(number).ok());
        number.ok_or_else(|| "it is too long".to_owned())
    }

    /// Decodes base64. In compressed data the header is encoded alone, otherwise together with the numbers.
    fn based(&self, text: &[u8]) -> Result<Vec<u8>, String> {
        let decoded = |text: &[u8], length: usize| {
            let length = length.div_ceil(3).checked_mul(4);
            let part = length.and_then(|length| Some((text.get(..length)?, length)));
            let (part, length) = part.ok_or("it is cut off")?;
            let bytes = STANDARD.decode(part).map_err(|error| error.to_string())?;
            Ok::<_, String>((bytes, length))
        };
        let (head, _) = decoded(text, self.size())?;
        let count = self.length(&head, 0)?;
        if !self.is_compressed()? {
            let end = self.size().saturating_add(count);
            let (bytes, _) = decoded(text, end)?;
            return Ok(bytes.get(self.size()..end).ok_or("it is cut off")?.to_vec());
        }
        let (head, after) = decoded(text, self.head(count)?)?;
        let mut total = 0_usize;
        for block in 0..count {
            total = total.saturating_add(self.length(&head, 3 + block)?);
        }
        let text = text.get(after..).ok_or("it is cut off")?;
        let (packed, _) = decoded(text, total)?;
        self.unpacked(&head, &packed)
    }

    /// Reads raw appended data.
    fn raw(&self, bytes: &[u8]) -> Result<Vec<u8>, String> {
        let count = self.length(bytes, 0)?;
        if !self.is_compressed()? {
            let part = bytes.get(self.size()..self.size().saturating_add(count));
            return Ok(part.ok_or("it is cut off")?.to_vec());
        }
        let parts = bytes.split_at_checked(self.head(count)?);
        let (head, packed) = parts.ok_or("it is cut off")?;
        self.unpacked(head, packed)
    }

    /// Returns the length of the header of compressed data: the number of blocks, the length of a block, that of the last
    /// block, and the compressed length of each block.
    fn head(&self, blocks: usize) -> Result<usize, String> {
        let numbers = blocks.checked_add(3);
        let length = numbers.and_then(|numbers| numbers.checked_mul(self.size()));
        length.ok_or_else(|| "it is too long".to_owned())
    }

    /// Decompresses the blocks after a header.
    fn unpacked(&self, head: &[u8], mut packed: &[u8]) -> Result<Vec<u8>, String> {
        let [blocks, full, last] = [0, 1, 2].map(|n| self.length(head, n));
        let (blocks, full, last) = (blocks?, full?, last?);
        // A last block of length 0 is a full one.
        let missing = if last == 0 {
            0
        } else {
            full.saturating_sub(last)
        };
        let total = blocks.saturating_mul(full).saturating_sub(missing);
        let mut bytes = room(total)?;
        for block in 0..blocks {
            let length = self.length(head, 3 + block)?;
            let (part, rest) = packed.split_at_checked(length).ok_or("it is cut off")?;
            packed = rest;
            let room = u64::try_from(total.saturating_sub(bytes.len())).unwrap_or(MOST);
            let unpacked = ZlibDecoder::new(part).take(room).read_to_end(&mut bytes);
            unpacked.map_err(|error| error.to_string())?;
        }
        if bytes.len() == total {
            Ok(bytes)
        } else {
            Err(format!(
                "{} bytes after decompression, but its header announces {total}",
                bytes.len()
            ))
        }
    }
}

/// Returns the error of an attribute with a value that is not read.
pub(super) fn unknown(attribute: &str, value: &str, expected: &'static str) -> Error {
    Error::Vtk(format!("{attribute} {}", Syntax::new(value, expected)))
}

/// Returns memory for an array of so many numbers.
pub(super) fn room<T>(numbers: usize) -> Result<Vec<T>, String> {
    let mut room = Vec::new();
    if numbers as u64 <= MOST && room.try_reserve_exact(numbers).is_ok() {
        return Ok(room);
    }
    Err(format!(
        "an array would take {numbers} numbers, more than the memory has room for: write only the numbers of the spheres \
         and contacts"
    ))
}
