//! One entry of a table, and its formats.

use std::borrow::Cow;
use std::cmp::Ordering;
use std::fmt;

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::Signed;

use super::line::Line;
use crate::{Each, Error};
use cannonpile::scalar::{CorrectlyRounded, Surd, SurdSum};

/// One entry of a table.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Cell {
    /// A count, the same in all number formats.
    Integer(BigInt),
    /// An index, the same in all number formats.
    Index(i128),
    /// An exact quantity, shown in the requested number format.
    Number(Box<Surd>),
    /// An exact sum of two surds, shown in the requested number format.
    Sum(Box<SurdSum>),
    /// A quantity already rounded to `f64`.
    F64(f64),
    /// A quantity already rounded to `f32`.
    F32(f32),
    /// A word.
    Word(Cow<'static, str>),
    /// A boolean: 1 and 0, in json `true` and `false`.
    Flag(bool),
    /// No value: empty, in json `null`.
    Missing,
}

impl From<i128> for Cell {
    fn from(value: i128) -> Self {
        Self::Index(value)
    }
}

impl From<BigRational> for Cell {
    fn from(value: BigRational) -> Self {
        Surd::from(value).into()
    }
}

impl From<Surd> for Cell {
    fn from(value: Surd) -> Self {
        Self::Number(value.into())
    }
}

impl From<SurdSum> for Cell {
    fn from(value: SurdSum) -> Self {
        match value.to_surd() {
            Some(surd) => surd.clone().into(),
            None => Self::Sum(value.into()),
        }
    }
}

impl From<f64> for Cell {
    fn from(value: f64) -> Self {
        Self::F64(value)
    }
}

impl From<f32> for Cell {
    fn from(value: f32) -> Self {
        Self::F32(value)
    }
}

impl From<&'static str> for Cell {
    fn from(value: &'static str) -> Self {
        Self::Word(value.into())
    }
}

impl Cell {
    /// Returns whether the cell is a number below zero.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table::Cell;
    ///
    /// assert!(Cell::F64(-0.5).is_negative());
    /// assert!(!Cell::from("-1").is_negative());
    /// ```
    #[must_use]
    pub fn is_negative(&self) -> bool {
        match self {
            Self::Integer(n) => n.is_negative(),
            Self::Index(n) => n.is_negative(),
            Self::Number(x) => x.coefficient().is_negative(),
            Self::Sum(x) => x.sign() == Sign::Minus,
            Self::F64(x) => *x < 0.0,
            Self::F32(x) => *x < 0.0,
            Self::Word(_) | Self::Flag(_) | Self::Missing => false,
        }
    }

    /// Adds the text of the cell to a line: one text for each header of the column, or the two bounds of an interval.
    /// The error of an overflow contains `column`.
    pub(super) fn show(
        &self,
        numbers: NumberFormat,
        column: &'static str,
        heads: usize,
        line: &mut Line,
    ) -> Result<(), Error> {
        let interval = match (self, numbers) {
            (Self::Number(x), NumberFormat::Interval) => Some(ends(&**x, column)?),
            (Self::Sum(x), NumberFormat::Interval) => Some(ends(&**x, column)?),
            _ => None,
        };
        if let Some(interval) = interval {
            for end in interval {
                line.push_str(&end);
            }
            return Ok(());
        }
        for _ in 0..heads {
            match self {
                Self::Integer(n) => line.push(n),
                Self::Index(n) => match i64::try_from(*n) {
                    // This is faster than formatting.
                    Ok(n) => line.push(n),
                    Err(_) => line.push(n),
                },
                Self::Number(x) => line.push_str(&numbers.show(x, column)?),
                Self::Sum(x) => line.push_str(&numbers.shown(&**x, column)?),
                Self::F64(x) => line.push(format_args!("{x:?}")),
                Self::F32(x) => line.push(format_args!("{x:?}")),
                Self::Word(word) => line.push_str(word),
                Self::Flag(flag) => line.push_str(if *flag { "1" } else { "0" }),
                Self::Missing => line.push_str(""),
            }
        }
        Ok(())
    }
}

/// An exact number that a [`NumberFormat`] shows: [`Surd`] and [`SurdSum`].
trait Exact: fmt::Display + PartialOrd<f64> {
    /// Returns the correctly rounded float; `None` if it overflows.
    #[must_use]
    fn rounded<F: CorrectlyRounded + PartialEq>(&self) -> Option<F>;
}

impl Exact for Surd {
    fn rounded<F: CorrectlyRounded + PartialEq>(&self) -> Option<F> {
        self.nearest()
    }
}

impl Exact for SurdSum {
    fn rounded<F: CorrectlyRounded + PartialEq>(&self) -> Option<F> {
        self.nearest()
    }
}

/// The format of exact quantities.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum NumberFormat {
    /// `4`, `7/3`, `7/3*sqrt(2)`.
    Exact,
    /// The correctly rounded `f64`, with the fewest digits that read back the same (at most 17).
    F64,
    /// The correctly rounded `f32`, with the fewest digits that read back the same (at most 9).
    F32,
    /// The tightest enclosure by two `f64` in two columns, `…_lo` and `…_hi`.
    Interval,
}

impl NumberFormat {
    /// Returns a number as text. The error of an overflow contains `quantity`.
    ///
    /// # Errors
    /// [`Error::Overflow`](cannonpile::Error::Overflow) if the number is outside the range of the float type.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table::NumberFormat;
    /// use cannonpile::scalar::Surd;
    /// use num_rational::BigRational;
    ///
    /// let root = Surd::sqrt(BigRational::from_integer(2.into()))?;
    /// assert_eq!(NumberFormat::Exact.show(&root, "root")?, "sqrt(2)");
    /// assert_eq!(NumberFormat::F64.show(&root, "root")?, "1.4142135623730951");
    /// assert_eq!(NumberFormat::F32.show(&root, "root")?, "1.4142135");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn show(self, number: &Surd, quantity: &'static str) -> Result<String, Error> {
        self.shown(number, quantity)
    }

    fn shown(self, number: &impl Exact, quantity: &'static str) -> Result<String, Error> {
        match self {
            Self::Exact => Ok(number.to_string()),
            Self::F64 => shortest::<f64>(number, quantity, "f64"),
            Self::F32 => shortest::<f32>(number, quantity, "f32"),
            Self::Interval => {
                let [lower, upper] = ends(number, quantity)?;
                Ok(format!("[{lower}, {upper}]"))
            }
        }
    }
}

/// Returns the `f64` below and above a number, as the shortest texts that read back the same. Both are equal if the
/// number is a float.
fn ends(number: &impl Exact, quantity: &'static str) -> Result<[String; 2], Error> {
    let overflow = || Error::overflow(quantity, "an interval of f64");
    let float: f64 = number.rounded().ok_or_else(overflow)?;
    let [lower, upper] = match number.partial_cmp(&float) {
        Some(Ordering::Less) => [float.next_down(), float],
        Some(Ordering::Greater) => [float, float.next_up()],
        _ => [float, float],
    };
    if lower.is_finite() && upper.is_finite() {
        Ok([lower, upper].each(|end| format!("{end:?}")))
    } else {
        Err(overflow())
    }
}

/// Returns the correctly rounded float as the shortest text that reads back the same, as `Debug` prints it.
fn shortest<F: CorrectlyRounded + PartialEq + fmt::Debug>(
    number: &impl Exact,
    quantity: &'static str,
    scalar: &'static str,
) -> Result<String, Error> {
    let float: Option<F> = number.rounded();
    float
        .map(|x| format!("{x:?}"))
        .ok_or_else(|| Error::overflow(quantity, scalar))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn detects_negative_numbers() {
        let exact = |n: i32| Cell::from(BigRational::from_integer(n.into()));
        for negative in [
            exact(-1),
            Cell::Integer((-1).into()),
            Cell::Index(-1),
            Cell::F64(-f64::from_bits(1)),
            Cell::F32(-f32::from_bits(1)),
        ] {
            assert!(negative.is_negative(), "{negative:?}");
        }
        for other in [
            exact(0),
            exact(1),
            Cell::Integer(0.into()),
            Cell::Index(0),
            // A zero force may be −0 as a float.
            Cell::F64(-0.0),
            Cell::F32(-0.0),
            Cell::F64(1.0),
            Cell::F32(1.0),
            Cell::from("-1"),
            Cell::Flag(true),
            Cell::Missing,
        ] {
            assert!(!other.is_negative(), "{other:?}");
        }
    }
}
