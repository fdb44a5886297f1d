//! What is printed: answers on stdout or into a file, refusals and notes on stderr.

use core::fmt::Display;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use cannonpile_dem::table::{WriteError, write_aside};

use crate::{Culprit, Error};

/// Why there is no answer.
pub(crate) enum Failure {
    /// The library refused what was given.
    Refused(Refused),
    /// The command line did: the option, what is wrong with it, and the remedy.
    Message(String),
    /// The reader has seen enough.
    Closed,
}

impl From<Refused> for Failure {
    fn from(refused: Refused) -> Self {
        Self::Refused(refused)
    }
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Refused(Refused::from(error))
    }
}

impl Failure {
    /// Returns why nothing was written to the file that this option names, or to stdout.
    pub(crate) fn of_writing(error: WriteError, option: &str, file: Option<&Path>) -> Self {
        let file = file.map(|path| format!("--{option} {}", path.display()));
        let target = file.unwrap_or_else(|| "to stdout".into());
        let (target, reason) = match error {
            WriteError::Answer(error) => return error.into(),
            WriteError::Io(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                return Self::Closed;
            }
            // The text of an error may name the file written aside; its kind does not.
            WriteError::Io(error) => (target, reason(&error)),
            WriteError::File { path, error } => (path.display().to_string(), reason(&error)),
            error => (target, error.to_string()),
        };
        Self::Message(format!(
            "cannot write {target}: {reason}; choose a place that exists, can be written and has room"
        ))
    }
}

/// A refusal, with the input to blame and the options that are its remedy.
#[derive(Debug)]
pub(crate) struct Refused {
    pub(crate) error: Box<Error>,
    pub(crate) culprit: Option<Culprit>,
    /// Options that ask what the message advises.
    pub(crate) remedy: Option<&'static str>,
}

impl Refused {
    /// Puts the blame on another input than the error does, where it is known better.
    pub(crate) fn of(culprit: impl Into<Culprit>, error: impl Into<Error>) -> Self {
        Self {
            culprit: Some(culprit.into()),
            ..Self::from(error)
        }
    }

    /// Adds to a refusal of too many rows the options that ask for fewer.
    pub(crate) fn of_rows(error: impl Into<Error>, remedy: &'static str) -> Self {
        let error = error.into();
        let too_many = matches!(error, Error::Core(cannonpile::Error::TooManyRows { .. }));
        Self {
            remedy: too_many.then_some(remedy),
            ..Self::from(error)
        }
    }
}

impl<E: Into<Error>> From<E> for Refused {
    fn from(error: E) -> Self {
        let error = error.into();
        Self {
            culprit: error.culprit(),
            error: Box::new(error),
            remedy: None,
        }
    }
}

/// What may be named instead of a file that cannot be read.
pub(crate) const A_FILE: &str = "name a file that is there";
pub(crate) const A_FILE_OR_STDIN: &str = "name a file that is there, or - for stdin";

/// Returns why FILE is not read.
pub(crate) fn unreadable(name: impl Display, error: &io::Error, remedy: &str) -> Failure {
    let reason = reason(error);
    Failure::Message(format!("FILE: {name} cannot be read: {reason}; {remedy}"))
}

/// Opens FILE, which is not stdin.
pub(crate) fn open(path: &Path) -> Result<File, Failure> {
    File::open(path).map_err(|error| unreadable(path.display(), &error, A_FILE))
}

/// Returns why a file could not be read or written, without the number that the system gives it.
pub(crate) fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file or folder".into(),
        kind => kind.to_string(),
    }
}

/// Writes to the file that this option names, whole or not at all, or to stdout.
pub(crate) fn write_to(
    option: &str,
    file: Option<&Path>,
    content: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<(), Failure> {
    let written = match file {
        Some(path) => write_aside(path, content),
        None => write_out(content),
    };
    written.map_err(|error| Failure::of_writing(error, option, file))
}

fn write_out(
    content: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    let mut out = BufWriter::new(io::stdout().lock());
    content(&mut out)?;
    Ok(out.flush()?)
}

/// Prints one line on stderr, whatever the text; if even that is closed, the exit status has to say it.
pub(crate) fn complain(message: &str) {
    let line: String = message
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    let _ = writeln!(io::stderr(), "{line}");
}
