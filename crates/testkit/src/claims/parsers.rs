//! A parser never panics, reads printed values, and reads a number as its exact value.
//!
//! Three oracles: the value that the generator wrote; the standard library's float parser, which rounds
//! correctly; and a second round of printing and reading.

use core::fmt::{Debug, Display};
use core::str::FromStr;

use arbitrary::Unstructured;
use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Axis, Dimension, Direction, Region, Sign};
use cannonpile::scalar::{CorrectlyRounded, Surd, parse};
use cannonpile::stacking::Pattern;
use num_rational::BigRational;

use super::{Checked, Failure, demand, one_line, same};
use crate::generators::{number, text};

/// Runs every parser on any text.
pub fn any_text(u: &mut Unstructured<'_>) -> Checked {
    let text = text::any(u)?;
    match parse::rational(&text) {
        Ok(value) => {
            reads_back(parse::rational, &value, &value)?;
            as_the_standard_library(&text, &value)?;
        }
        Err(refusal) => one_line(&refusal)?,
    }
    match parse::integer(&text) {
        Ok(value) => reads_back(parse::integer, &value, &value)?,
        Err(refusal) => one_line(&refusal)?,
    }
    match text.parse::<Dimension>() {
        Ok(value) => same("a dimension", &value.number().to_string(), &text)?,
        Err(refusal) => one_line(&refusal)?,
    }
    match text.parse::<Direction>() {
        Ok(value) => same("a direction", &value.to_string(), &text),
        Err(refusal) => one_line(&refusal),
    }
}

/// The parser returns the value for which the number was written.
pub fn a_number(u: &mut Unstructured<'_>) -> Checked {
    let written = text::number(u)?;
    reads_back(parse::rational, &written.text, &written.value)?;
    as_the_standard_library(&written.text, &written.value)
}

/// Values printed by the library and by the standard library are read back.
pub fn a_value(u: &mut Unstructured<'_>) -> Checked {
    let r = number::rational(u)?;
    reads_back(parse::rational, &r, &r)?;
    let x = number::float(u)?;
    let exact = number::exactly(x);
    for printed in [x.to_string(), format!("{x:e}"), format!("{x:.17e}")] {
        let read = parse::rational(&printed)?;
        let back = f64::nearest_to_rational(&read);
        same(&printed, &back, &f64::nearest_to_rational(&exact))?;
    }
    let n = number::machine_integer(u)?;
    reads_back(parse::integer, &n, &n)?;
    let direction = *u.choose(&Direction::ALL)?;
    reads_back(str::parse::<Direction>, &direction, &direction)
}

/// Runs every parser of an option on any word. A parsed value is printed in a form that is read as the same value.
pub fn any_word(u: &mut Unstructured<'_>) -> Checked {
    let text = text::word(u)?;
    round_trips::<Region>(&text)?;
    round_trips::<Surd>(&text)?;
    round_trips::<Spacing>(&text)?;
    round_trips::<Pattern>(&text)?;
    round_trips::<Sign>(&text)?;
    round_trips::<Axis>(&text)
}

/// If `text` is valid, its value is printed in a form that is read as the same value.
pub fn round_trips<T>(text: &str) -> Checked
where
    T: FromStr<Err: Display> + PartialEq + Debug + Display,
{
    match text.parse::<T>() {
        Ok(value) => reads_back(str::parse::<T>, &value, &value),
        Err(refusal) => one_line(&refusal),
    }
}

/// The printed form of `shown` is read as `value`.
pub fn reads_back<T: PartialEq + Debug, E: Display>(
    parse: impl Fn(&str) -> Result<T, E>,
    shown: &impl Display,
    value: &T,
) -> Checked {
    let printed = shown.to_string();
    let read = parse(&printed).map_err(|error| Failure::refused(&error))?;
    demand(read == *value, || {
        format!("'{printed}' is read as {read:?}, not {value:?}")
    })
}

/// If the standard library accepts the text as a float, its result is the correctly rounded `value`.
fn as_the_standard_library(text: &str, value: &BigRational) -> Checked {
    let finite = |x: &f64| x.is_finite();
    if let Ok(x) = text.parse::<f64>() {
        let nearest = f64::nearest_to_rational(value);
        same("the f64", &nearest, &Some(x).filter(finite))?;
    }
    if let Ok(x) = text.parse::<f32>() {
        let nearest = f32::nearest_to_rational(value);
        same("the f32", &nearest, &Some(x).filter(|x| x.is_finite()))?;
    }
    Ok(())
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::ratio;

    /// A parser that converts through a float.
    fn rounded(text: &str) -> Result<BigRational, exact_surd::Error> {
        let value = parse::rational(text)?;
        let x = f64::nearest_to_rational(&value).unwrap_or_default();
        Ok(number::exactly(x))
    }

    #[test]
    fn a_parser_that_rounds_is_caught() {
        let half = ratio(1, 2);
        assert!(reads_back(rounded, &half, &half).is_ok());
        let tenth = ratio(1, 10);
        assert!(reads_back(parse::rational, &tenth, &tenth).is_ok());
        assert!(reads_back(rounded, &tenth, &tenth).is_err());
    }

    /// Prints another sign than it reads.
    #[derive(Debug, PartialEq)]
    struct Careless(i128);

    impl FromStr for Careless {
        type Err = exact_surd::Error;

        fn from_str(text: &str) -> Result<Self, Self::Err> {
            parse::integer(text).map(Self)
        }
    }

    impl Display for Careless {
        fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
            write!(f, "{}", self.0.abs())
        }
    }

    #[test]
    fn a_wrong_printed_value_is_caught() {
        assert!(round_trips::<Careless>("5").is_ok());
        assert!(round_trips::<Careless>("-5").is_err());
        assert!(round_trips::<Careless>("five").is_ok());
    }

    #[test]
    fn a_lost_digit_is_caught() {
        // The tie 2^53 + 1 rounds to even. One more digit decides otherwise.
        let text = "9007199254740993.00000000000000000001";
        let value = parse::rational(text).unwrap();
        assert!(as_the_standard_library(text, &value).is_ok());
        let cut = parse::rational("9007199254740993").unwrap();
        assert!(as_the_standard_library(text, &cut).is_err());
    }

    #[test]
    fn a_rejected_printed_value_is_caught() {
        let refuse = |text: &str| parse::integer(text.trim_start_matches('-'));
        let refuse_negative = |text: &str| match text.strip_prefix('-') {
            Some(_) => parse::integer("minus"),
            None => refuse(text),
        };
        assert!(reads_back(refuse_negative, &5, &5).is_ok());
        assert!(reads_back(refuse_negative, &-5, &-5).is_err());
    }
}
