//! The numbered lines of a text, one at a time in memory.

use std::io::{BufRead, ErrorKind};

use memchr::memchr2;

use crate::encoding::windows_1252;
use crate::error::{Error, Fault};

/// The maximum length of a line, in bytes.
const LONGEST: usize = 1 << 16;

/// U+FEFF, the first character of some text files.
const BYTE_ORDER_MARK: &str = "\u{feff}";

/// A reader of lines, which end with LF, CR LF or CR.
///
/// A line that is not UTF-8 is read as Windows-1252, whose ASCII part is the same. So a unit such as µm in another
/// encoding does not hide the numbers beside it.
pub(crate) struct Lines<R> {
    input: R,
    bytes: Vec<u8>,
    /// The text of a line that is not UTF-8.
    decoded: String,
    number: u64,
    /// True if the last line ended with CR, so that LF may follow.
    after_cr: bool,
}

/// A line without its end.
#[derive(Clone, Copy)]
pub(crate) struct Line<'l> {
    /// The number of the line, counted from 1.
    pub(crate) number: u64,
    pub(crate) text: &'l str,
    /// True if the line has an end. The last line of a file may lack it.
    pub(crate) ended: bool,
}

impl<R: BufRead> Lines<R> {
    pub(crate) fn new(input: R) -> Self {
        Self {
            input,
            bytes: Vec::new(),
            decoded: String::new(),
            number: 0,
            after_cr: false,
        }
    }

    /// Returns the number of the last line, or 1 before the first.
    pub(crate) fn number(&self) -> u64 {
        self.number.max(1)
    }

    /// Returns the next line, or `None` at the end of the file.
    pub(crate) fn next(&mut self) -> Result<Option<Line<'_>>, Error> {
        let Some(ended) = self.fill()? else {
            return Ok(None);
        };
        self.number += 1;
        let number = self.number;
        if self.bytes.len() > LONGEST {
            return Err(Fault::new(format!(
                "longer than {LONGEST} bytes: is this a table with one contact per line?"
            ))
            .at(number));
        }
        let text = if let Ok(text) = core::str::from_utf8(&self.bytes) {
            text
        } else {
            self.decoded = windows_1252(&self.bytes);
            &self.decoded
        };
        let text = match text.strip_prefix(BYTE_ORDER_MARK) {
            Some(rest) if number == 1 => rest,
            _ => text,
        };
        Ok(Some(Line {
            number,
            text,
            ended,
        }))
    }

    /// Reads the bytes of the next line, at most one more than are allowed. Returns whether the line has an end.
    fn fill(&mut self) -> Result<Option<bool>, Error> {
        self.bytes.clear();
        let mut begun = false;
        loop {
            if let Err(error) = self.input.fill_buf()
                && error.kind() == ErrorKind::Interrupted
            {
                continue;
            }
            let available = self.input.fill_buf()?;
            let Some(first) = available.first() else {
                return Ok(begun.then_some(false));
            };
            if core::mem::take(&mut self.after_cr) && *first == b'\n' {
                self.input.consume(1);
                continue;
            }
            begun = true;
            let end = memchr2(b'\n', b'\r', available);
            let part = available.get(..end.unwrap_or(available.len()));
            // One byte more than fits shows that the line is too long.
            let part = part.unwrap_or(available);
            let taken = part.get(..LONGEST + 1).unwrap_or(part);
            self.bytes.extend_from_slice(taken);
            let length = part.len();
            if let Some(end) = end {
                self.after_cr = available.get(end) == Some(&b'\r');
                self.input.consume(end + 1);
                return Ok(Some(true));
            }
            self.input.consume(length);
            if self.bytes.len() > LONGEST {
                return Ok(Some(false));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(input: impl BufRead) -> Vec<(u64, String, bool)> {
        let mut lines = Lines::new(input);
        let mut seen = Vec::new();
        while let Some(line) = lines.next().unwrap() {
            seen.push((line.number, line.text.to_owned(), line.ended));
        }
        seen
    }

    #[test]
    fn all_line_ends_are_accepted_and_the_last_is_optional() {
        let want = [
            (1, "a", true),
            (2, "", true),
            (3, "bé", true),
            (4, "c", false),
        ];
        let want = want.map(|(n, text, ended)| (n, text.to_owned(), ended));
        for text in [
            "a\n\nbé\nc",
            "a\r\n\r\nbé\r\nc",
            "a\r\rbé\rc",
            "a\r\n\rbé\nc",
        ] {
            assert_eq!(lines(text.as_bytes()), want, "{text:?}");
            // CR and LF may be in different buffers.
            let slow = std::io::BufReader::with_capacity(1, text.as_bytes());
            assert_eq!(lines(slow), want, "{text:?}");
        }
    }

    #[test]
    fn a_line_in_another_encoding_keeps_its_numbers() {
        let read = lines(&b"\xef\xbb\xbf1\n1,2,\xb5m\n"[..]);
        assert_eq!(
            read,
            [(1, "1".to_owned(), true), (2, "1,2,µm".to_owned(), true)]
        );
    }

    #[test]
    fn long_lines_are_rejected_without_more_memory() {
        let mut lines = Lines::new(std::io::BufReader::new(std::io::repeat(b'1')));
        assert!(matches!(lines.next(), Err(Error::Line { line: 1, .. })));
        assert!(lines.bytes.len() <= 2 * LONGEST + 1);
    }
}
