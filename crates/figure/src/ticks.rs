//! Ticks of an axis, and short texts of numbers.

use cannonpile::scalar::Surd;
use num_rational::BigRational;

/// Returns whether two numbers differ by more than rounding.
pub(super) fn is_range(least: f64, most: f64) -> bool {
    let span = most / 2.0 - least / 2.0;
    span.is_normal() && span > 1e-12 * least.abs().max(most.abs())
}

/// Returns about `count` ticks between `least` and `most`: multiples of 1, 2 or 5 times a power of ten.
pub(super) fn ticks(least: f64, most: f64, count: u32) -> Vec<f64> {
    if !is_range(least, most) {
        return Vec::new();
    }
    let rough = (most / f64::from(count) - least / f64::from(count)).max(f64::MIN_POSITIVE);
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .map(|round| round * power)
        .into_iter()
        .find(|step| *step >= rough)
        .unwrap_or(rough);
    let first = (least / step).ceil();
    (0..=2 * count)
        .map(|n| (first + f64::from(n)) * step)
        .filter(|tick| tick.is_finite() && *tick <= most + step * 1e-9)
        // This turns −0 into 0.
        .map(|tick| tick + 0.0)
        .collect()
}

/// Rounds a positive number down to 1, 2 or 5 times a power of ten. Zero gives `None`.
pub(super) fn round_below(value: f64) -> Option<f64> {
    let power = 10_f64.powf(value.log10().floor());
    let rounds = [5.0, 2.0, 1.0, 0.5].map(|round| round * power);
    let round = rounds.into_iter().find(|round| *round <= value)?;
    round.is_normal().then_some(round)
}

/// Returns a number with four significant digits: `0.4622`, `12`, `1.2·10⁻⁷`.
pub(super) fn short(value: f64) -> String {
    digits(value, 4)
}

/// Returns a number with `count` significant digits. Digits before the point are never cut.
pub(super) fn digits(value: f64, count: i32) -> String {
    const MOST: u8 = 8;
    if value == 0.0 {
        return "0".into();
    }
    if !(1e-3..1e5).contains(&value.abs()) {
        let decimals = match count {
            1 => 0,
            2 => 1,
            _ => 2,
        };
        let text = format!("{value:.decimals$e}");
        let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}·10{}", trimmed(digits), raised(power)).replace('-', "−");
    }
    // Whether this number of decimals gives `count` significant digits.
    let enough =
        |places: &u8| value.abs() * 10_f64.powi((*places).into()) >= 10_f64.powi(count - 1);
    // No text has more than `MOST` decimals.
    let places = (0..MOST).find(enough).unwrap_or(MOST);
    trimmed(&format!("{value:.*}", usize::from(places))).replace('-', "−")
}

/// Removes trailing zeros of the decimals.
fn trimmed(text: &str) -> &str {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        text
    }
}

/// Returns an integer in superscript digits.
pub(super) fn raised(integer: &str) -> String {
    let raised = |c: char| match c {
        '-' => '⁻',
        '0' => '⁰',
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        digit => match digit.to_digit(10) {
            Some(n) => char::from_u32(0x2070 + n).unwrap_or(digit),
            None => digit,
        },
    };
    integer.chars().map(raised).collect()
}

/// Returns the exact number if its text is short, otherwise four significant digits.
pub(super) fn exact_or_short(exact: &BigRational) -> String {
    const LONGEST: usize = 7;
    let text = exact.to_string();
    match Surd::from(exact.clone()).nearest() {
        Some(value) if text.len() > LONGEST => short(value),
        _ => text.replace('-', "−"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (-0.5, "−0.5"),
            (12.0, "12"),
            (1.0 / 3.0, "0.3333"),
            (123.456, "123.5"),
            (12345.6, "12346"),
            (1.25e-7, "1.25·10⁻⁷"),
            (-3e300, "−3·10³⁰⁰"),
        ] {
            assert_eq!(short(value), text);
        }
    }

    #[test]
    fn ticks_are_round() {
        assert_eq!(ticks(0.0, 10.0, 5), [0.0, 2.0, 4.0, 6.0, 8.0, 10.0]);
        assert_eq!(ticks(-0.2, 0.3, 5).len(), 6);
        assert!(ticks(1.0, 1.0, 5).is_empty());
        for (least, most) in [(-f64::MAX, f64::MAX), (0.0, 5e-324), (1e16, 1e16 + 2.0)] {
            assert!(ticks(least, most, 5).iter().all(|tick| tick.is_finite()));
        }
    }
}
