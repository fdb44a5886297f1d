//! Width, fill, alignment and sign for types that print more than one number.

use alloc::format;
use alloc::string::{String, ToString};
use core::fmt::{self, Alignment, Display, Write};

/// Writes `text` with the width, fill and alignment of `f`; the default alignment is left.
///
/// A precision does not truncate the text, unlike in `f.pad`: a truncated number would read as another
/// number.
///
/// # Errors
/// Returns the errors of the formatter.
pub fn padded(f: &mut fmt::Formatter<'_>, text: fmt::Arguments<'_>) -> fmt::Result {
    let Some(width) = f.width() else {
        // Without a width a long text is written without a copy.
        return f.write_fmt(text);
    };
    let text = text.to_string();
    let missing = width.saturating_sub(text.chars().count());
    let before = match f.align() {
        None | Some(Alignment::Left) => 0,
        Some(Alignment::Center) => missing / 2,
        Some(Alignment::Right) => missing,
    };
    let fill = f.fill();
    (0..before).try_for_each(|_| f.write_char(fill))?;
    f.write_str(&text)?;
    (before..missing).try_for_each(|_| f.write_char(fill))
}

/// Returns a number as `f` prints it inside a larger text: with the sign and precision of `f`, without its
/// width.
#[must_use]
pub fn part(f: &fmt::Formatter<'_>, number: &impl Display) -> String {
    match (f.sign_plus(), f.precision()) {
        (false, None) => format!("{number}"),
        (true, None) => format!("{number:+}"),
        (false, Some(digits)) => format!("{number:.digits$}"),
        (true, Some(digits)) => format!("{number:+.digits$}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two numbers separated by a dash.
    struct Pair(f64, f64);

    impl Display for Pair {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            let [one, other] = [part(f, &self.0), part(f, &self.1)];
            padded(f, format_args!("{one}–{other}"))
        }
    }

    #[test]
    fn padded_text_keeps_signs_and_precision() {
        let pair = Pair(0.5, -2.25);
        for (printed, expected) in [
            (format!("{pair}"), "0.5–-2.25"),
            (format!("{pair:3}"), "0.5–-2.25"),
            (format!("{pair:12}|"), "0.5–-2.25   |"),
            (format!("{pair:>12}"), "   0.5–-2.25"),
            (format!("{pair:*^12}"), "*0.5–-2.25**"),
            (format!("{pair:+}"), "+0.5–-2.25"),
            (format!("{pair:.1}"), "0.5–-2.2"),
            (format!("{pair:+.1}"), "+0.5–-2.2"),
        ] {
            assert_eq!(printed, expected);
        }
    }
}
