//! Abbreviation of long texts and numbers for error messages of one line.

use alloc::format;
use alloc::string::String;

/// The longest text or number shown in full, in characters.
const LONGEST: usize = 60;

/// The numbers of characters shown from the beginning and from the end of a longer text.
const ENDS: [usize; 2] = [30, 12];

/// Returns the text escaped on one line. In a long text the middle is replaced by the length.
#[must_use]
pub fn quoted(text: &str) -> String {
    let escaped = |text: &str| text.chars().flat_map(char::escape_debug).collect();
    escaped(&shortened(text, "characters"))
}

/// Returns the message with the middle of every long number replaced by its length.
#[must_use]
pub fn numbers(message: &str) -> String {
    let digit = |c: char| c.is_ascii_digit();
    let mut rest = message;
    let mut short = String::new();
    while let Some(start) = rest.find(digit) {
        let (before, from) = rest.split_at(start);
        let (number, after) = from.split_at(from.find(|c| !digit(c)).unwrap_or(from.len()));
        short.extend([before, &shortened(number, "digits")]);
        rest = after;
    }
    short + rest
}

/// Returns `123…[5000 digits]…789` for a long text, and `text` itself otherwise.
fn shortened(text: &str, unit: &str) -> String {
    let length = text.chars().count();
    if length <= LONGEST {
        return text.into();
    }
    let [first, last] = ENDS;
    let beginning: String = text.chars().take(first).collect();
    let end: String = text.chars().skip(length - last).collect();
    format!("{beginning}…[{length} {unit}]…{end}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_show_ends_and_length() {
        let text = "9".repeat(LONGEST);
        assert_eq!(quoted(&text), text);
        let long = format!("a{}z", "'\n ".repeat(50_000));
        let short = quoted(&long);
        assert!(short.starts_with("a\\'") && short.ends_with('z'), "{short}");
        assert!(
            short.contains("…[150002 characters]…") && short.len() < 200,
            "{short}"
        );
    }

    #[test]
    fn only_long_numbers_are_shortened() {
        for message in ["", "not 7", "7/3 of 12", "{}"] {
            assert_eq!(numbers(message), message);
        }
        let message = format!("not {}/{}", "1".repeat(5_000), "2".repeat(LONGEST + 1));
        let [ones, twos] = ["1", "2"].map(|digit| [30, 12].map(|n| digit.repeat(n)));
        let want = format!(
            "not {}…[5000 digits]…{}/{}…[61 digits]…{}",
            ones[0], ones[1], twos[0], twos[1]
        );
        assert_eq!(numbers(&message), want);
    }
}
