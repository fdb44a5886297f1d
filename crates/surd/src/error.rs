//! Errors of parsing and of constructing numbers.

use alloc::string::{String, ToString};
use core::fmt;

use num_rational::BigRational;

use crate::short::{numbers, quoted};

/// An invalid number. The message states the value that was given and the remedy.
///
/// # Examples
/// ```
/// use exact_surd::Surd;
///
/// let error = "sqrt(-2)".parse::<Surd>().unwrap_err();
/// assert_eq!(error.to_string(), "the root of -2 is not real: the radicand must not be negative");
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Error {
    /// The radicand of a square root is negative.
    NegativeRadicand {
        /// The radicand that was given.
        given: BigRational,
    },
    /// A text does not have the expected form.
    Syntax {
        /// The text, shortened if it is long.
        text: String,
        /// The expected form of the text.
        expected: &'static str,
    },
}

crate::equality!(Error);

impl Error {
    /// Returns the error for a text that does not have the form `expected`.
    #[doc(hidden)]
    #[must_use]
    pub fn syntax(text: &str, expected: &'static str) -> Self {
        Self::Syntax {
            text: quoted(text),
            expected,
        }
    }
}

/// Prints the message of an error with all digits of its numbers.
struct Whole<'a>(&'a Error);

impl fmt::Display for Whole<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Error::NegativeRadicand { given } => write!(
                f,
                "the root of {given} is not real: the radicand must not be negative"
            ),
            Error::Syntax { text, expected } => write!(f, "'{text}' is not {expected}"),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&numbers(&Whole(self).to_string()))
    }
}

impl core::error::Error for Error {}
