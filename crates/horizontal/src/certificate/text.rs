//! The text of a certificate file. The parsers of the library accept more notations than the other checkers, so the
//! reader refuses those that `docs/certificates.md` does not list.

use std::io::{self, Read};

use cannonpile::engine::quoted;

/// A reader that returns an error at the first byte that the grammar does not allow.
pub(super) struct Text<R> {
    pub(super) input: R,
    /// The string that is being read, from its opening quote on.
    word: Option<Vec<u8>>,
    /// The last token: a bracket, a comma or a colon, `"` for a string, `0` for a literal. Before the first token it is
    /// zero.
    last: u8,
    /// Whether a string that has ended is a key of a record.
    is_key: bool,
    line: usize,
}

impl<R> Text<R> {
    pub(super) fn new(input: R) -> Self {
        Self {
            input,
            word: None,
            last: 0,
            is_key: false,
            line: 1,
        }
    }

    fn error(&self, message: &str) -> io::Error {
        let message = format!("line {}: {message}", self.line);
        io::Error::new(io::ErrorKind::InvalidData, message)
    }

    fn next(&mut self, byte: u8) -> io::Result<()> {
        self.line += usize::from(byte == b'\n');
        if byte == b'\\' || !byte.is_ascii() {
            return Err(self.error("a certificate is ASCII, without backslashes"));
        }
        match &mut self.word {
            Some(word) if byte == b'"' => {
                let word = core::mem::take(word);
                self.word = None;
                let word = String::from_utf8_lossy(&word);
                return if is_word(&word) {
                    Ok(())
                } else {
                    Err(self.error(&format!(
                        "{} is not a number such as -7/3, a stacking such as ++-+ or (100,3,100), a region such as \
                         hexagon:3,2, or a name of the format",
                        quoted(&word)
                    )))
                };
            }
            Some(word) => {
                word.push(byte);
                return Ok(());
            }
            None => {}
        }
        let token = match byte {
            b' ' | b'\t' | b'\r' | b'\n' => return Ok(()),
            b'"' | b'[' | b']' | b'{' | b'}' | b',' | b':' => byte,
            _ if self.last == b'0' => return Ok(()),
            b'n' if self.last != 0 => {
                return Err(self.error("null has no meaning here; leave out the key"));
            }
            _ => b'0',
        };
        if self.last == 0 && token != b'{' && token != b'[' {
            return Err(self.error("a certificate begins with { or ["));
        }
        // A record is not a list of its values, and a list has records only.
        let fits = match (self.last, token) {
            (b'[', token) => token == b'{' || token == b']',
            (b',', token) => token == b'{' || token == b'"',
            (b'"', token) if self.is_key => token == b':',
            _ => true,
        };
        if !fits {
            return Err(self.error("a list has records in braces only, and a record has keys"));
        }
        if token == b'"' {
            self.is_key = self.last != b':';
            self.word = Some(Vec::new());
        }
        self.last = token;
        Ok(())
    }
}

impl<R: Read> Read for Text<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let read = self.input.read(bytes)?;
        for byte in &bytes[..read] {
            self.next(*byte)?;
        }
        Ok(read)
    }
}

/// Returns whether the grammar has the word: a number, a stacking, a region or a name.
fn is_word(word: &str) -> bool {
    let is_natural = |text: &str| {
        let is_digits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        is_digits && (text == "0" || !text.starts_with('0'))
    };
    let is_integer = |text: &str| {
        let negated = text.strip_prefix('-');
        is_natural(negated.unwrap_or(text)) && negated != Some("0")
    };
    let unsigned = word.strip_prefix('-').unwrap_or(word);
    let runs = unsigned.strip_prefix('(');
    if let Some(runs) = runs.and_then(|runs| runs.strip_suffix(')')) {
        return runs.split(',').all(|run| is_natural(run) && run != "0");
    }
    match word.split_once(':') {
        Some(("hexagon" | "triangle", sizes)) => sizes.split(',').all(is_natural),
        Some(("region", ranges)) => ranges.split(',').all(|range| {
            let range = range.split_once("..");
            range.is_some_and(|(from, to)| is_integer(from) && is_integer(to))
        }),
        Some(_) => false,
        None => {
            let (numer, denom) = word.split_once('/').unwrap_or((word, "1"));
            let is_sign = |byte| byte == b'+' || byte == b'-';
            let is_letter = |byte: u8| byte.is_ascii_lowercase() || byte == b'_' || byte == b'-';
            // The parser of stackings reads words of c and h.
            let is_name = word.bytes().all(is_letter)
                && word.bytes().any(|byte| byte != b'c' && byte != b'h');
            word == "A"
                || word.bytes().all(is_sign)
                || (is_integer(numer) && is_natural(denom))
                || is_name
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_the_grammar() {
        for word in [
            "0",
            "-7/3",
            "A",
            "+-+",
            "-",
            "(3)",
            "-(1,2)",
            "hexagon:3",
            "hexagon:3,2",
            "triangle:4",
            "region:-1..2,0..3,0..3",
            "alpha-beta",
            "sin_phi",
            "cannot-stand",
        ] {
            assert!(is_word(word), "{word}");
        }
        for word in [
            "+0",
            "-0",
            "007",
            "1/02",
            "1.0",
            "1e3",
            " 1",
            "1/-2",
            "1/2/3",
            "0x1",
            "AB",
            "chh",
            "()",
            "(3,)",
            "(0,3)",
            "+(3)",
            "hexagon:",
            "hexagon:1e1",
            "0..3,0..3,0..3",
            "region:0...3,0..3,0..3",
            "region:+1..2,0..3,0..3",
            "sqrt(2)",
            "top:3",
            "Top",
        ] {
            assert!(!is_word(word), "{word}");
        }
    }

    #[test]
    fn records_are_not_lists() {
        let read = |text: &str| io::copy(&mut Text::new(text.as_bytes()), &mut io::sink());
        for text in [
            r#"{"a":{"b":"1","g":true},"d":[{"e":0},{"e":-1}],"f":[]}"#,
            r#"[{"a":[]} , {"b":"1"}]"#,
        ] {
            assert!(read(text).is_ok(), "{text}");
        }
        for text in [
            r#"{"a":[1]}"#,
            r#"{"a":["1"]}"#,
            r"[[]]",
            r#"[{"a":1},"stands"]"#,
            r#"[{"a":1},false]"#,
            r#"{"a":null}"#,
            r#"{"\u0061":1}"#,
            "{\"ä\":1}",
        ] {
            assert!(read(text).is_err(), "{text}");
        }
    }
}
