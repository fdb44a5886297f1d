//! Conversion of errors to Python exceptions.

use cannonpile_dem::table::WriteError;
use cannonpile_dem::verify::Refusal;
use pyo3::PyErr;
use pyo3::exceptions::{PyMemoryError, PyOSError, PyOverflowError, PyRuntimeError, PyValueError};

use crate::error::Error;

/// The reason for an exception. Large variants are boxed to keep `Result` small.
pub(crate) enum Raised {
    Error(Box<Error>),
    /// The name of an invalid argument, and the error.
    Named(&'static str, Box<Error>),
    Refusal(Box<Refusal>),
    Write(WriteError),
    /// The name of the argument with an invalid measurement, and the error.
    Argument(&'static str, Box<Refusal>),
}

/// Implements `From` for each of these error types.
macro_rules! raise {
    ($($error:ty),*) => {$(
        impl From<$error> for Raised {
            fn from(error: $error) -> Self {
                Self::Error(Box::new(error.into()))
            }
        }
    )*};
}

raise!(
    Error,
    cannonpile::Error,
    cannonpile_dem::Error,
    cannonpile_disorder::Error,
    cannonpile_figure::Error,
    cannonpile_horizontal::Error,
    cannonpile_stability::Error
);

impl From<Refusal> for Raised {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::Scene(error) => error.into(),
            other => Self::Refusal(Box::new(other)),
        }
    }
}

impl From<WriteError> for Raised {
    fn from(error: WriteError) -> Self {
        match error {
            WriteError::Answer(error) => error.into(),
            other => Self::Write(other),
        }
    }
}

impl Raised {
    /// Returns the Python exception. Its message is that of the error, after the name of the argument if there is one.
    pub(crate) fn into_exception(self) -> PyErr {
        match self {
            Self::Error(error) => of(None, &error),
            Self::Named(name, error) => of(Some(name), &error),
            Self::Refusal(refusal) => match *refusal {
                Refusal::OutOfRange => PyOverflowError::new_err(refusal.to_string()),
                Refusal::Within(_) => PyValueError::new_err(format!("within: {refusal}")),
                _ => PyValueError::new_err(of_refusal(&refusal)),
            },
            Self::Argument(name, refusal) => {
                PyValueError::new_err(format!("{name}: {}", of_refusal(&refusal)))
            }
            Self::Write(error) => PyOSError::new_err(error.to_string()),
        }
    }
}

/// Returns the message of a refusal, with arguments of this package in place of options of the command line.
fn of_refusal(refusal: &Refusal) -> String {
    let arguments = [
        ("use --first-id 0", "give ids + 1"),
        (
            "--first-id 0 counts from 0, and --match place finds",
            "if they count from 0, give ids + 1; points and centres find",
        ),
    ];
    let text = refusal.to_string();
    arguments.iter().fold(text, |text, (option, argument)| {
        text.replace(option, argument)
    })
}

/// Returns the exception for an invalid argument.
pub(crate) fn of_argument(name: &str, error: &Error) -> PyErr {
    of(Some(name), error)
}

fn of(argument: Option<&str>, error: &Error) -> PyErr {
    use cannonpile::Error as Core;

    let text = error.to_string();
    let text = match argument.or_else(|| error.argument()) {
        Some(name) if !text.starts_with(name) => format!("{name}: {text}"),
        _ => text,
    };
    match error {
        Error::Core(Core::TooLarge { .. } | Core::TooManyRows { .. }) => {
            PyMemoryError::new_err(text)
        }
        Error::Core(Core::Overflow { .. }) => PyOverflowError::new_err(text),
        Error::Core(Core::Bug { .. }) => PyRuntimeError::new_err(text),
        _ => PyValueError::new_err(text),
    }
}
