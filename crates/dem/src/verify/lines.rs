//! The numbered lines of a file, one at a time in memory.

use std::io::{BufRead, Read};

use super::refusal::{Fault, Refusal};

/// The maximum length of a line, in bytes.
const LONGEST: usize = 1 << 16;

/// U+FEFF, the first character of some text files.
const BYTE_ORDER_MARK: &str = "\u{feff}";

/// A reader of lines.
pub(super) struct Lines<R> {
    input: R,
    line: Vec<u8>,
    number: u64,
    /// True if the next call repeats the last line.
    again: bool,
}

/// A line without its end.
#[derive(Clone, Copy)]
pub(super) struct Line<'l> {
    /// The number of the line, counted from 1.
    pub(super) number: u64,
    pub(super) text: &'l str,
    /// True if the line has an end. The last line of a file may lack it.
    pub(super) ended: bool,
}

impl<R: BufRead> Lines<R> {
    pub(super) fn new(input: R) -> Self {
        Self {
            input,
            line: Vec::new(),
            number: 0,
            again: false,
        }
    }

    /// Returns the number of the last line, or 1 before the first.
    pub(super) fn number(&self) -> u64 {
        self.number.max(1)
    }

    /// Repeats the last line at the next call.
    pub(super) fn put_back(&mut self) {
        self.again = self.number > 0;
    }

    /// Returns the next line, or `None` at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<Line<'_>>, Refusal> {
        if !core::mem::take(&mut self.again) {
            self.line.clear();
            let most = u64::try_from(LONGEST + 2).unwrap_or(u64::MAX);
            let read = (&mut self.input)
                .take(most)
                .read_until(b'\n', &mut self.line)?;
            if read == 0 {
                return Ok(None);
            }
            self.number += 1;
        }
        let number = self.number;
        let (bytes, ended) = match self.line.strip_suffix(b"\n") {
            Some(bytes) => (bytes.strip_suffix(b"\r").unwrap_or(bytes), true),
            None => (&*self.line, false),
        };
        if bytes.len() > LONGEST {
            return Err(Fault::LongLine { limit: LONGEST }.at(number));
        }
        let text = core::str::from_utf8(bytes).map_err(|_| Fault::Encoding.at(number))?;
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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_line_ends_are_accepted_and_the_last_is_optional() {
        let mut lines = Lines::new(&b"\xef\xbb\xbfa\r\n\nb\xc3\xa9"[..]);
        let mut seen = Vec::new();
        while let Some(line) = lines.next().unwrap() {
            seen.push((line.number, line.text.to_owned(), line.ended));
        }
        let want = [(1, "a", true), (2, "", true), (3, "bé", false)];
        assert_eq!(
            seen,
            want.map(|(n, text, ended)| (n, text.to_owned(), ended))
        );
    }

    #[test]
    fn long_lines_are_rejected_without_more_memory() {
        let mut lines = Lines::new(std::io::BufReader::new(std::io::repeat(b'1')));
        assert!(matches!(
            lines.next(),
            Err(Refusal::Line {
                line: 1,
                fault: Fault::LongLine { .. }
            })
        ));
        assert!(lines.line.len() <= LONGEST + 2);
    }
}
