//! Numbers as tables write them.

/// Returns the value of a number, correctly rounded to `f64`. The value may be infinite or NaN.
///
/// The decimal sign is `.` or `,`. Fortran writes exponents as `1.5D-3`, and with three digits as `1.5-103`.
pub(crate) fn number(text: &str, decimal_comma: bool) -> Option<f64> {
    if decimal_comma && text.contains(',') {
        // A point beside the comma would be a thousands separator, which is not read.
        let is_plain = !text.contains('.');
        return is_plain.then(|| number(&text.replacen(',', ".", 1), false))?;
    }
    text.parse().ok().or_else(|| fortran(text)?.parse().ok())
}

/// Returns a number of Fortran with the exponent after `e`.
fn fortran(text: &str) -> Option<String> {
    if let Some((digits, exponent)) = text.split_once(['d', 'D']) {
        let is_decimal = |c: char| c.is_ascii_digit() || "+-.".contains(c);
        return digits
            .chars()
            .all(is_decimal)
            .then(|| format!("{digits}e{exponent}"));
    }
    let sign = text.rfind(['+', '-']).filter(|place| *place > 0)?;
    let (digits, exponent) = text.split_at_checked(sign)?;
    let is_cut = digits.contains('.') && exponent.len() == 4;
    is_cut.then(|| format!("{digits}e{exponent}"))
}

/// Returns whether a text is a number in digits, with either decimal sign.
pub(crate) fn is_number(text: &str) -> bool {
    let is_digit = |byte: &u8| byte.is_ascii_digit();
    let begins = text.as_bytes().iter().find(|byte| !b"+-.,".contains(byte));
    // A comma at the end is a separator.
    begins.is_some_and(is_digit)
        && !text.ends_with(',')
        && [false, true]
            .into_iter()
            .any(|comma| number(text, comma).is_some())
}

/// Returns whether the comma of a number may separate thousands, as in `1,234`.
pub(crate) fn may_have_thousands(text: &str) -> bool {
    let parts = text.trim_start_matches(['+', '-']).split_once(',');
    parts.is_some_and(|(whole, rest)| {
        let is_group = rest.len() == 3 && rest.bytes().all(|byte| byte.is_ascii_digit());
        is_group && (1..=3).contains(&whole.len()) && !whole.starts_with('0')
    })
}

/// Returns the number of a sphere, if all its digits are there. A fraction may consist of zeros only.
///
/// An exponent, as `numpy.savetxt` writes it, is accepted only if all digits of the number are present. Otherwise
/// digits may have been rounded off: by default LAMMPS writes sphere 1234567 as 1.23457e+06. A comma is rejected: it may
/// separate thousands.
pub(crate) fn whole_number(text: &str) -> Option<i64> {
    if let Ok(id) = text.parse() {
        return Some(id);
    }
    let (negative, text) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let (digits, exponent) = text.split_once(['e', 'E', 'd', 'D']).unwrap_or((text, "0"));
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    let (moved, zeros) = fraction.split_at_checked(exponent.parse().ok()?)?;
    let is_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let fits = !whole.is_empty() && is_digits(whole) && is_digits(moved);
    let id: i64 = [whole, moved].concat().parse().ok()?;
    let exact = fits && zeros.bytes().all(|byte| byte == b'0');
    exact.then_some(if negative { -id } else { id })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_other_programs() {
        for (text, value) in [
            ("0.5", 0.5),
            ("-1.5D-3", -1.5e-3),
            ("1.5d+02", 150.0),
            ("0.25-103", 0.25e-103),
            ("+1.+100", 1e100),
        ] {
            assert_eq!(number(text, false), Some(value), "{text}");
        }
        assert_eq!(number("-0,25", true), Some(-0.25));
        assert_eq!(number("0,5E-3", true), Some(0.5e-3));
        assert_eq!(number("0.5", true), Some(0.5));
        for text in [
            "",
            "half",
            "1-2-3",
            "1-200",
            "2026-11-25",
            "d",
            "1,5",
            "0x10",
            "1.5 N",
            "- 1",
        ] {
            assert_eq!(number(text, false), None, "{text}");
        }
        for text in ["1.234,5", "1,234,5"] {
            assert_eq!(number(text, true), None, "{text}");
        }
    }

    #[test]
    fn a_comma_at_the_end_is_a_separator() {
        assert!(is_number("1,5") && is_number("-1.5") && is_number("1."));
        assert!(!is_number("1,") && !is_number("1.5,"));
    }

    #[test]
    fn a_comma_before_three_digits_may_separate_thousands() {
        for text in ["1,234", "-12,345", "+123,456"] {
            assert!(may_have_thousands(text), "{text}");
        }
        for text in [
            "0,123", ",123", "1,23", "1,2345", "1234,567", "1,2e3", "1.234",
        ] {
            assert!(!may_have_thousands(text), "{text}");
        }
    }

    #[test]
    fn ids_have_all_their_digits() {
        for (text, id) in [
            ("17", 17),
            ("-1", -1),
            ("17.000", 17),
            ("1.7e1", 17),
            ("1.700000D+01", 17),
            ("-0.0", 0),
        ] {
            assert_eq!(whole_number(text), Some(id), "{text}");
        }
        for text in ["1.5", "1.23457e+06", "", "-", "1e400", "A1", "1,000"] {
            assert_eq!(whole_number(text), None, "{text}");
        }
    }
}
