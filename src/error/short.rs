//! Long texts and numbers, short enough for a message of one line.

use alloc::format;
use alloc::string::String;

/// The longest text or number shown whole, in characters.
const LONGEST: usize = 60;

/// How many characters are shown of the beginning of a longer one, and of its end.
const ENDS: [usize; 2] = [30, 12];

/// Returns the text on one line, with its length in place of its middle if it is long.
pub(super) fn quoted(text: &str) -> String {
    let escaped = |text: &str| text.chars().flat_map(char::escape_debug).collect();
    escaped(&shortened(text, "characters"))
}

/// Returns the message with the middle of every long number left out.
pub(super) fn numbers(message: &str) -> String {
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

/// `123…[5000 digits]…789`.
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
