//! Conversion of texts in other encodings to UTF-8.

use core::str::FromStr;

use crate::error::Syntax;

/// The readable encodings, and the remedy for all others.
const READABLE: &str = "utf-8, utf-16le, utf-16be or windows-1252 (iconv converts a file to utf-8)";

/// The encoding of a text: UTF-8, UTF-16 or Windows-1252, which contains Latin-1.
///
/// # Examples
/// ```
/// use contact_tables::TextEncoding;
///
/// assert_eq!("latin1".parse(), Ok(TextEncoding::Windows1252));
/// assert!("utf-12".parse::<TextEncoding>().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TextEncoding {
    /// UTF-8.
    Utf8,
    /// UTF-16, the less significant byte first.
    Utf16Le,
    /// UTF-16, the more significant byte first.
    Utf16Be,
    /// Windows-1252.
    Windows1252,
}

impl FromStr for TextEncoding {
    type Err = Syntax;

    fn from_str(text: &str) -> Result<Self, Syntax> {
        Ok(match text.to_ascii_lowercase().as_str() {
            "utf-8" | "utf8" => Self::Utf8,
            "utf-16" | "utf-16le" => Self::Utf16Le,
            "utf-16be" => Self::Utf16Be,
            "windows-1252" | "cp1252" | "iso-8859-1" | "latin1" | "ascii" => Self::Windows1252,
            _ => return Err(Syntax::new(text, READABLE)),
        })
    }
}

/// The characters of the bytes 0x80 to 0x9f in Windows-1252. Every other byte is the code point of its character.
const FROM_0X80: &str = "€\u{81}‚ƒ„…†‡ˆ‰Š‹Œ\u{8d}Ž\u{8f}\u{90}‘’“”•–—˜™š›œ\u{9d}žŸ";

/// Returns the text of bytes in Windows-1252.
pub(crate) fn windows_1252(bytes: &[u8]) -> String {
    let character = |byte: &u8| match byte {
        0x80..0xa0 => FROM_0X80.chars().nth(usize::from(byte - 0x80)),
        _ => Some(char::from(*byte)),
    };
    bytes.iter().filter_map(character).collect()
}

impl TextEncoding {
    /// Returns the text of bytes in this encoding. A malformed character becomes U+FFFD. A byte order mark of
    /// UTF-16 is left out.
    pub(crate) fn decode(self, bytes: &[u8]) -> String {
        let unit = match self {
            Self::Utf8 => return String::from_utf8_lossy(bytes).into_owned(),
            Self::Windows1252 => return windows_1252(bytes),
            Self::Utf16Le => u16::from_le_bytes,
            Self::Utf16Be => u16::from_be_bytes,
        };
        // A single byte at the end is malformed, as this half of a surrogate pair is in both orders of bytes.
        let unit = |pair: &[u8]| unit(pair.try_into().unwrap_or([0xd8; 2]));
        let units = bytes.chunks(2).map(unit).skip_while(|u| *u == 0xfeff);
        let text = char::decode_utf16(units).map(|c| c.unwrap_or('\u{fffd}'));
        text.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn malformed_characters_are_replaced() {
        let bytes: Vec<u8> = "µ𝟙".encode_utf16().flat_map(u16::to_be_bytes).collect();
        for (length, want) in [
            (6, "µ𝟙"),
            (5, "µ\u{fffd}\u{fffd}"),
            (4, "µ\u{fffd}"),
            (3, "µ\u{fffd}"),
            (2, "µ"),
        ] {
            assert_eq!(
                TextEncoding::Utf16Be.decode(&bytes[..length]),
                want,
                "{length}"
            );
        }
        let halves = b"\x34\xd8a\0\x34\xdcb\0";
        assert_eq!(TextEncoding::Utf16Le.decode(halves), "\u{fffd}a\u{fffd}b");
        assert_eq!(TextEncoding::Utf8.decode(b"\xc2\xb5\xb5"), "µ\u{fffd}");
    }

    #[test]
    fn windows_1252_differs_from_latin_1_in_27_bytes() {
        let bytes: Vec<u8> = (0..=255).collect();
        let text = TextEncoding::Windows1252.decode(&bytes);
        assert_eq!(text.chars().count(), 256);
        let differ = text
            .chars()
            .zip(0_u32..)
            .filter(|(c, byte)| u32::from(*c) != *byte);
        assert_eq!(
            differ.map(|(c, _)| c).collect::<String>(),
            "€‚ƒ„…†‡ˆ‰Š‹ŒŽ‘’“”•–—˜™š›œžŸ"
        );
    }
}
