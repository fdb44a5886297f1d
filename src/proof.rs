//! What is proved, for another program to check: the formulas as they run, the laws, and proofs that Coq's kernel accepts.
//!
//! [`theorem`](crate::theorem) proves with the polynomials of this crate. Here the same formulas ([`Formulas::LIBRARY`]) are run
//! on [`Expression`]s, which record what is done to them, and each is written as a definition of its own. About these definitions,
//! not about a copy of them, are the theorems in `proofs/coq`: balance of a sphere, action and reaction, the pile by
//! recursion on its layers, sums by induction. They are proved without axioms.
//!
//! # What that proves, and what not
//! * The recorded expression is what the library computes, in every exact scalar: the one body is generic. That rustc
//!   compiles it as it is written is not proved.
//! * Which spheres an engine finds on which line, and where it keeps a number, is not proved: tests compare engines.
//! * Floats round; nothing is proved of them.
//!
//! # Examples
//! ```
//! use cannonpile::proof::{self, Assistant};
//!
//! let files = proof::files(Assistant::Coq)?;
//! let formulas = files.iter().find(|file| file.name() == "Formulas.v").unwrap();
//! assert!(formulas.text().contains(
//!     "Definition force (n : Q) (increment : Q) : Q :=\n  n * increment.\n"
//! ));
//! # Ok::<(), cannonpile::Error>(())
//! ```

mod coq;
mod definition;
mod language;
mod lean;
mod listed;
mod recorded;

pub use listed::{Checked, checked, listed};

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use crate::Error;
use crate::scalar::Expression;
use crate::table::{WriteError, write_all};
use crate::theorem::Formulas;

/// A program that checks proofs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Assistant {
    /// Coq 8.16 and later: formulas, laws, and all proofs.
    Coq,
    /// Lean 4: formulas, and proofs of identities, which were not checked.
    Lean,
}

impl Assistant {
    /// Returns its name: `Coq`, `Lean`.
    ///
    /// # Examples
    /// ```
    /// assert_eq!(cannonpile::proof::Assistant::Coq.name(), "Coq");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Coq => "Coq",
            Self::Lean => "Lean",
        }
    }
}

/// A file for a proof assistant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProofFile {
    name: &'static str,
    text: Cow<'static, str>,
}

impl ProofFile {
    fn new(name: &'static str, text: impl Into<Cow<'static, str>>) -> Self {
        let text = text.into();
        Self { name, text }
    }

    /// Returns its name.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::proof::{self, Assistant};
    ///
    /// let files = proof::files(Assistant::Coq)?;
    /// assert_eq!(files.last().map(|file| file.name()), Some("_CoqProject"));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Returns what is in it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::proof::{self, Assistant};
    ///
    /// for file in proof::files(Assistant::Coq)? {
    ///     assert!(!file.text().contains("Admitted"));
    /// }
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// Returns the files for a proof assistant, in the order in which it is to check them.
///
/// # Errors
/// [`Error::Bug`] only.
///
/// # Examples
/// ```
/// use cannonpile::proof::{self, Assistant};
///
/// let files = proof::files(Assistant::Coq)?;
/// assert_eq!(files[0].name(), "Directions.v");
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn files(assistant: Assistant) -> Result<Vec<ProofFile>, Error> {
    files_of(assistant, &Formulas::LIBRARY)
}

/// Returns the files for formulas of any kind: about wrong ones the proofs fail.
///
/// # Errors
/// [`Error::Bug`] only.
///
/// # Examples
/// ```
/// use cannonpile::proof::{self, Assistant};
/// use cannonpile::theorem::Formulas;
///
/// let wrong = Formulas { force: |n, increment| n + increment, ..Formulas::LIBRARY };
/// let files = proof::files_of(Assistant::Coq, &wrong)?;
/// assert!(files[1].text().contains("Q :=\n  n + increment.\n"));
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn files_of(
    assistant: Assistant,
    formulas: &Formulas<Expression>,
) -> Result<Vec<ProofFile>, Error> {
    match assistant {
        Assistant::Coq => coq::files(formulas),
        Assistant::Lean => lean::files(formulas),
    }
}

/// Writes the files for a proof assistant into a folder, which is made if it is not there: all, or none; returns where they are.
///
/// # Errors
/// [`WriteError::File`] for what could not be written.
///
/// # Examples
/// ```
/// use cannonpile::proof::{self, Assistant};
///
/// let folder = tempfile::tempdir()?;
/// let written = proof::write(Assistant::Coq, folder.path())?;
/// assert!(folder.path().join("Formulas.v").exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write(assistant: Assistant, folder: &Path) -> Result<Vec<PathBuf>, WriteError> {
    let files = files(assistant)?;
    let files = files
        .iter()
        .map(|file| (folder.join(file.name), &file.text));
    let written = write_all(folder, files, |text, out| {
        Ok(out.write_all(text.as_bytes())?)
    })?;
    Ok(written.into_iter().map(|(path, _)| path).collect())
}

/// Returns how the files in a folder are checked: commands for a shell, or that they were not.
///
/// # Errors
/// [`Error::Bug`] only.
///
/// # Examples
/// ```
/// use std::path::Path;
///
/// use cannonpile::proof::{self, Assistant};
///
/// let commands = proof::commands(Assistant::Coq, Path::new("p"))?;
/// assert!(commands.contains("cd p\nfor file in Directions Formulas "));
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn commands(assistant: Assistant, folder: &Path) -> Result<String, Error> {
    let folder = folder.display();
    let names: Vec<_> = files(assistant)?.iter().map(ProofFile::name).collect();
    Ok(match assistant {
        Assistant::Coq => {
            let modules = names.iter().filter_map(|name| name.strip_suffix(".v"));
            let modules = modules.collect::<Vec<_>>().join(" ");
            format!(
                "to check, with Coq 8.16 or later; coqchk is to say \"* Axioms: <none>\":\ncd {folder}\n\
                 for file in {modules}; do coqc -Q . Cannonpile $file.v || break; done\n\
                 coqchk -o -silent -Q . Cannonpile Cannonpile.Listed"
            )
        }
        Assistant::Lean => {
            let names = names.join(" ");
            format!("not checked; with Lean 4.22 or later:\ncd {folder}\nlean {names}")
        }
    })
}
