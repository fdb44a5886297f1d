//! What the library refuses, as Python's exceptions.

use cannonpile::table::WriteError;
use cannonpile::verify::Refusal;
use cannonpile::{Culprit, Error};
use pyo3::PyErr;
use pyo3::exceptions::{PyMemoryError, PyOSError, PyOverflowError, PyRuntimeError, PyValueError};

/// Why something was refused.
pub(crate) enum Raised {
    Error(Error),
    /// An argument, and why it was refused.
    Named(&'static str, Error),
    Refusal(Refusal),
    Write(WriteError),
    /// What was measured, by an argument.
    Argument(&'static str, Refusal),
}

impl From<Error> for Raised {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}

impl From<Refusal> for Raised {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::Scene(error) => Self::Error(error),
            other => Self::Refusal(other),
        }
    }
}

impl From<WriteError> for Raised {
    fn from(error: WriteError) -> Self {
        match error {
            WriteError::Answer(error) => Self::Error(error),
            other => Self::Write(other),
        }
    }
}

impl Raised {
    /// The exception, with the library's text.
    pub(crate) fn into_exception(self) -> PyErr {
        match self {
            Self::Error(error) => of(None, &error),
            Self::Named(name, error) => of(Some(name), &error),
            Self::Refusal(Refusal::OutOfRange) => {
                PyOverflowError::new_err(Refusal::OutOfRange.to_string())
            }
            Self::Refusal(refusal @ Refusal::Within(_)) => {
                PyValueError::new_err(format!("within: {refusal}"))
            }
            Self::Refusal(refusal) => PyValueError::new_err(refusal.to_string()),
            Self::Argument(name, refusal) => PyValueError::new_err(format!("{name}: {refusal}")),
            Self::Write(error) => PyOSError::new_err(error.to_string()),
        }
    }
}

/// The exception for what an argument was refused with.
pub(crate) fn of_argument(name: &str, error: &Error) -> PyErr {
    of(Some(name), error)
}

fn of(argument: Option<&str>, error: &Error) -> PyErr {
    let text = error.to_string();
    let text = match argument.or_else(|| argument_of(error)) {
        Some(name) if !text.starts_with(name) => format!("{name}: {text}"),
        _ => text,
    };
    match error {
        Error::TooLarge { .. } | Error::TooManyRows { .. } => PyMemoryError::new_err(text),
        Error::Overflow { .. } => PyOverflowError::new_err(text),
        Error::Bug { .. } => PyRuntimeError::new_err(text),
        _ => PyValueError::new_err(text),
    }
}

/// The argument that Python has for an input.
fn argument_of(error: &Error) -> Option<&'static str> {
    // Its line and key are in the text.
    if let Error::InFile { .. } = error {
        return None;
    }
    Some(match error.culprit()? {
        Culprit::Layers => "layers",
        Culprit::Stacking => "stacking",
        Culprit::Top => "top",
        Culprit::Base => "base",
        Culprit::Dimension => "dimension",
        Culprit::SinPhi => "sin_phi",
        Culprit::Load => "loads",
        Culprit::Weightless => "weightless",
        Culprit::Spacing => "spacing",
        Culprit::Radius => "radius",
        Culprit::Mass => "mass",
        Culprit::Gravity => "gravity",
        Culprit::Layer => "layer",
        Culprit::State => "state",
        Culprit::StiffnessRatio => "stiffness_ratio",
        Culprit::FaultProbability => "fault_probability",
        // The site is in the text; a number, a method and a file are not asked for by name.
        _ => return None,
    })
}
