//! The words, lines and bytes of a legacy file.

use crate::error::Error;
use crate::error::quoted;

/// The part of a file that is not yet read.
pub(super) struct Words<'f> {
    pub(super) rest: &'f [u8],
}

impl<'f> Words<'f> {
    pub(super) fn take(&mut self, length: usize) -> Result<&'f [u8], Error> {
        let (part, rest) = self.rest.split_at_checked(length).ok_or_else(cut)?;
        self.rest = rest;
        Ok(part)
    }

    /// Returns the rest of the line.
    pub(super) fn line(&mut self) -> &'f [u8] {
        let end = self.rest.iter().position(|byte| *byte == b'\n');
        let (line, rest) = self
            .rest
            .split_at(end.map_or(self.rest.len(), |end| end + 1));
        self.rest = rest;
        line
    }

    pub(super) fn word(&mut self) -> Result<&'f [u8], Error> {
        let rest = self.rest.trim_ascii_start();
        let end = rest.iter().position(u8::is_ascii_whitespace);
        let (word, rest) = rest.split_at(end.unwrap_or(rest.len()));
        if word.is_empty() {
            return Err(cut());
        }
        self.rest = rest;
        Ok(word)
    }

    pub(super) fn keyword(&mut self) -> Result<String, Error> {
        Ok(String::from_utf8_lossy(self.word()?).to_ascii_uppercase())
    }

    pub(super) fn count(&mut self) -> Result<usize, Error> {
        number(self.word()?)
    }

    /// Returns a name. Blanks and percent signs in names are written as `%20` and `%25`.
    pub(super) fn name(&mut self) -> Result<String, Error> {
        let word = self.word()?;
        let mut name = Vec::new();
        let mut rest = word;
        while let Some((byte, after)) = rest.split_first() {
            let coded = after.split_at_checked(2).filter(|_| *byte == b'%');
            let coded = coded.and_then(|(code, behind)| {
                let code = core::str::from_utf8(code).ok()?;
                Some((u8::from_str_radix(code, 16).ok()?, behind))
            });
            // A percent sign without a code is one.
            let (byte, behind) = coded.unwrap_or((*byte, after));
            name.push(byte);
            rest = behind;
        }
        Ok(String::from_utf8_lossy(&name).into_owned())
    }

    /// Returns the length of a binary string: the first two bits tell how many bytes the length has.
    pub(super) fn string_length(&mut self) -> Result<usize, Error> {
        let first = *self.rest.first().ok_or_else(cut)?;
        let bytes = match first >> 6 {
            3 => 1,
            2 => 2,
            1 => 4,
            _ => 8,
        };
        let digits = self.take(bytes)?.iter().enumerate();
        let length = digits.fold(0_u64, |sum, (n, byte)| {
            let byte = if n == 0 { byte & 0x3f } else { *byte };
            sum << 8 | u64::from(byte)
        });
        usize::try_from(length).map_err(|_| cut())
    }
}

/// Parses a number of things.
pub(super) fn number(word: &[u8]) -> Result<usize, Error> {
    let text = String::from_utf8_lossy(word);
    let number = text.parse().ok();
    number.ok_or_else(|| {
        Error::Vtk(format!(
            "{} is not a number of points, cells or values",
            quoted(&text)
        ))
    })
}

/// Returns the error of a file that is not complete.
pub(super) fn cut() -> Error {
    Error::Vtk("the file ends within an array or a keyword: it is not complete".into())
}
