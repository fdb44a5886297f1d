//! Output: results on stdout or to a file, errors and notes on stderr.

use core::fmt::Display;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{self, Path};

use cannonpile_dem::table::{WriteError, write_aside};

use crate::{Culprit, Error};

/// The reason why a command has no result.
pub(crate) enum Failure {
    /// A library crate returned an error.
    Input(InputError),
    /// The command line found an error. The text names the option, the reason and the remedy.
    Message(String),
    /// The reader of stdout closed the pipe.
    Closed,
}

impl From<InputError> for Failure {
    fn from(refused: InputError) -> Self {
        Self::Input(refused)
    }
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Input(InputError::from(error))
    }
}

impl Failure {
    /// Converts an error of writing to stdout, or to the file that `option` names.
    pub(crate) fn of_writing(error: WriteError, option: &str, file: Option<&Path>) -> Self {
        let (target, remedy) = match file {
            Some(path) => (format!("--{option} {}", path.display()), WRITABLE_FOLDER),
            None => (
                "to stdout".into(),
                "redirect stdout to a place with free space",
            ),
        };
        let (target, reason) = match error {
            WriteError::Answer(error) => return error.into(),
            WriteError::Io(error) if error.kind() == io::ErrorKind::BrokenPipe => {
                return Self::Closed;
            }
            // The text of an I/O error may contain the name of the temporary file, so only its kind is printed.
            WriteError::Io(error) => (target, reason(&error)),
            WriteError::File { path, error } => (path.display().to_string(), reason(&error)),
            error => (target, error.to_string()),
        };
        Self::Message(format!("cannot write {target}: {reason}; {remedy}"))
    }
}

/// A library error, with the input that causes it and the options that are its remedy.
#[derive(Debug)]
pub(crate) struct InputError {
    pub(crate) error: Box<Error>,
    pub(crate) culprit: Option<Culprit>,
    /// The options that do what the message advises.
    pub(crate) remedy: Option<&'static str>,
}

impl InputError {
    /// Attributes an error to an input that the caller knows better than the error.
    pub(crate) fn of(culprit: impl Into<Culprit>, error: impl Into<Error>) -> Self {
        Self {
            culprit: Some(culprit.into()),
            ..Self::from(error)
        }
    }

    /// Adds the options that select fewer rows to an error about too many rows.
    pub(crate) fn of_rows(error: impl Into<Error>, remedy: &'static str) -> Self {
        let error = error.into();
        let too_many = matches!(error, Error::Core(cannonpile::Error::TooManyRows { .. }));
        Self {
            remedy: too_many.then_some(remedy),
            ..Self::from(error)
        }
    }
}

impl<E: Into<Error>> From<E> for InputError {
    fn from(error: E) -> Self {
        let error = error.into();
        Self {
            culprit: error.culprit(),
            error: Box::new(error),
            remedy: None,
        }
    }
}

/// The remedy for a file that cannot be written.
const WRITABLE_FOLDER: &str = "choose a file in an existing, writable folder with free space";
/// The remedy for a file that cannot be read.
pub(crate) const READABLE_FILE: &str = "give a readable file";
pub(crate) const READABLE_FILE_OR_STDIN: &str = "give a readable file, or - for stdin";

/// Returns the error that the file `name` cannot be read.
pub(crate) fn unreadable(name: impl Display, error: &io::Error, remedy: &str) -> Failure {
    let reason = reason(error);
    Failure::Message(format!("{name} cannot be read: {reason}; {remedy}"))
}

/// Returns the error of a file that is not what a command reads, or that cannot be read. It names what was
/// expected, and the command that writes or shows one.
pub(crate) fn unusable(
    name: impl Display,
    error: &io::Error,
    [what, example]: [&str; 2],
    remedy: &str,
) -> Failure {
    match error.kind() {
        io::ErrorKind::FileTooLarge => Failure::Message(format!("{name}: {error}")),
        io::ErrorKind::InvalidData | io::ErrorKind::UnexpectedEof => {
            Failure::Message(format!("{name} is not {what}: {error}; {example}"))
        }
        _ => unreadable(name, error, remedy),
    }
}

/// Opens a file. The name `-` is not special.
pub(crate) fn open(path: &Path) -> Result<File, Failure> {
    File::open(path).map_err(|error| unreadable(path.display(), &error, READABLE_FILE))
}

/// Returns the reason of an I/O error, without the error number of the system.
pub(crate) fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file or folder".into(),
        kind => kind.to_string(),
    }
}

/// Writes to stdout, or atomically to the file that `option` names. The name `-` is stdout.
pub(crate) fn write_to(
    option: &str,
    file: Option<&Path>,
    content: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<(), Failure> {
    let file = file.filter(|path| *path != Path::new("-"));
    let written = match file {
        Some(path) => write_aside(path, content),
        None => write_out(content),
    };
    written.map_err(|error| Failure::of_writing(error, option, file))
}

/// Writes like [`write_to`]. The content may write other files too: the file of `option` is created before them, and gets
/// its name after them.
pub(crate) fn write_around(
    option: &str,
    file: Option<&Path>,
    content: impl FnOnce(&mut dyn Write) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut failure = None;
    let written = write_to(option, file, |out| {
        content(out).map_err(|refused| {
            failure = Some(refused);
            io::Error::other("the content failed").into()
        })
    });
    failure.map_or(written, Err)
}

/// Returns whether writing to `folder` creates the missing folder of `file`.
pub(crate) fn creates_folder_of(folder: &Path, file: &Path) -> bool {
    let of_file = path::absolute(file).ok();
    let of_file = of_file.as_deref().and_then(Path::parent);
    of_file.is_some_and(|of_file| {
        !of_file.exists() && path::absolute(folder).is_ok_and(|folder| folder.starts_with(of_file))
    })
}

fn write_out(
    content: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<(), WriteError> {
    let mut out = BufWriter::new(io::stdout().lock());
    content(&mut out)?;
    Ok(out.flush()?)
}

/// Prints a message as one line on stderr. If stderr is closed, only the exit status reports the failure.
pub(crate) fn print_message(message: &str) {
    let line: String = message
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    let _ = writeln!(io::stderr(), "{line}");
}
