//! The files for Coq.

use std::borrow::Cow;
use std::path::Path;

use crate::language::Carrier;
use crate::recorded::{over_integers, over_rationals};
use crate::{Error, Expression, Formulas};

/// The hand-written files. Coq checks them in this order, and the generated `Formulas.v` after the first of them.
const BY_HAND: &[(&str, &str)] = &[
    ("Directions.v", include_str!("../coq/Directions.v")),
    ("Sums.v", include_str!("../coq/Sums.v")),
    ("Balance.v", include_str!("../coq/Balance.v")),
    ("Straight.v", include_str!("../coq/Straight.v")),
    ("Floor.v", include_str!("../coq/Floor.v")),
    ("Counts.v", include_str!("../coq/Counts.v")),
    ("Stackings.v", include_str!("../coq/Stackings.v")),
    ("Census.v", include_str!("../coq/Census.v")),
    ("Regions.v", include_str!("../coq/Regions.v")),
    ("Loads.v", include_str!("../coq/Loads.v")),
    ("Friction.v", include_str!("../coq/Friction.v")),
    ("Horizontal.v", include_str!("../coq/Horizontal.v")),
    ("Virtual.v", include_str!("../coq/Virtual.v")),
    ("Pile.v", include_str!("../coq/Pile.v")),
    ("Checker.v", include_str!("../coq/Checker.v")),
    ("Placement.v", include_str!("../coq/Placement.v")),
    ("Bounds.v", include_str!("../coq/Bounds.v")),
    ("Response.v", include_str!("../coq/Response.v")),
    ("Mean.v", include_str!("../coq/Mean.v")),
    ("Spectrum.v", include_str!("../coq/Spectrum.v")),
    ("Closures.v", include_str!("../coq/Closures.v")),
    ("Conditioning.v", include_str!("../coq/Conditioning.v")),
];

/// A file for Coq.
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

    /// Returns the file name.
    ///
    /// # Examples
    /// ```
    /// let files = cannonpile_proof::files()?;
    /// assert_eq!(files.last().map(|file| file.name()), Some("_CoqProject"));
    /// # Ok::<(), cannonpile_proof::Error>(())
    /// ```
    #[must_use]
    pub const fn name(&self) -> &'static str {
        self.name
    }

    /// Returns the content of the file.
    ///
    /// # Examples
    /// ```
    /// for file in cannonpile_proof::files()? {
    ///     assert!(!file.text().contains("Admitted"));
    /// }
    /// # Ok::<(), cannonpile_proof::Error>(())
    /// ```
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }
}

/// Returns the files for Coq. Coq checks them in this order, except the last one, `_CoqProject`.
///
/// # Errors
/// Returns only [`Bug`](cannonpile::Error::Bug), for a violated internal invariant.
///
/// # Examples
/// ```
/// let files = cannonpile_proof::files()?;
/// assert_eq!(files[0].name(), "Directions.v");
/// # Ok::<(), cannonpile_proof::Error>(())
/// ```
pub fn files() -> Result<Vec<ProofFile>, Error> {
    files_of(&Formulas::LIBRARY)
}

/// Returns the files for the given formulas. Coq rejects the proofs if a formula is wrong.
///
/// # Errors
/// Returns only [`Bug`](cannonpile::Error::Bug), for a violated internal invariant.
///
/// # Examples
/// ```
/// use cannonpile_proof::Formulas;
///
/// let mut wrong = Formulas::LIBRARY;
/// wrong.core.force = |n, increment| n + increment;
/// let files = cannonpile_proof::files_of(&wrong)?;
/// assert!(files[1].text().contains("Q :=\n  n + increment.\n"));
/// # Ok::<(), cannonpile_proof::Error>(())
/// ```
pub fn files_of(formulas: &Formulas<Expression>) -> Result<Vec<ProofFile>, Error> {
    let mut files: Vec<ProofFile> = BY_HAND
        .iter()
        .map(|(name, text)| ProofFile::new(name, *text))
        .collect();
    files.insert(1, ProofFile::new("Formulas.v", definitions(formulas)?));
    files.push(ProofFile::new("Listed.v", by_name(&files)));
    let mut project = String::from("-Q . Cannonpile\n");
    for file in &files {
        project += file.name();
        project.push('\n');
    }
    files.push(ProofFile::new("_CoqProject", project));
    Ok(files)
}

/// Returns the shell commands that check the files in a folder.
///
/// # Errors
/// Returns only [`Bug`](cannonpile::Error::Bug), for a violated internal invariant.
///
/// # Examples
/// ```
/// use std::path::Path;
///
/// let commands = cannonpile_proof::commands(Path::new("p"))?;
/// assert!(commands.contains("cd p\nfor file in Directions Formulas "));
/// # Ok::<(), cannonpile_proof::Error>(())
/// ```
pub fn commands(folder: &Path) -> Result<String, Error> {
    let (folder, files) = (folder.display(), files()?);
    let modules = modules(&files).collect::<Vec<_>>().join(" ");
    Ok(format!(
        "to check, with Coq 8.16 or later; coqchk must print \"* Axioms: <none>\":\ncd {folder}\n\
         for file in {modules}; do coqc -Q . Cannonpile $file.v || break; done\n\
         coqchk -o -silent -Q . Cannonpile Cannonpile.Listed"
    ))
}

/// Returns the names of the files with definitions and proofs, without extension.
fn modules(files: &[ProofFile]) -> impl Iterator<Item = &'static str> {
    files.iter().filter_map(|file| file.name.strip_suffix(".v"))
}

fn definitions(formulas: &Formulas<Expression>) -> Result<String, Error> {
    let mut text = String::from(
        "(** The recorded formulas of cannonpile.

    Each function of the library was called with symbols. Its definition is the expression that it computed, with all
    operations in their order, not simplified. x / n is x * (1 # n). Generated by `cannonpile prove --to coq`; do not
    edit. *)

From Coq Require Import ZArith QArith.
From Cannonpile Require Import Directions.

Open Scope Q_scope.
",
    );
    for definition in over_rationals(formulas) {
        text.push('\n');
        text += &Carrier::Rationals.definition(&definition)?;
    }
    text += "\n(** The same formulas over integers. The engines use them where no fractions occur. *)\n";
    text += "Module Integers.\nOpen Scope Z_scope.\n";
    for definition in over_integers(formulas) {
        text.push('\n');
        text += &Carrier::Integers.definition(&definition)?;
    }
    text += "\nEnd Integers.\n";
    Ok(text)
}

/// Returns the text of the file that lists the theorems by name. Coq's command `Check` prints each statement.
fn by_name(files: &[ProofFile]) -> String {
    let mut text = String::from(
        "(** The theorems that `cannonpile prove` lists, with the names of their proofs in Coq. Generated by\n    \
         `cannonpile prove --to coq`. *)\n\n",
    );
    text += "From Coq Require Import ZArith QArith.\nFrom Cannonpile Require";
    for module in modules(files) {
        text.extend([" ", module]);
    }
    text += ".\n\nOpen Scope Q_scope.\n";
    for theorem in crate::all() {
        text.extend(["\n(** ", theorem.name, " *)\n"]);
        if theorem.coq.is_empty() {
            text += "(* no proof in Coq yet *)\n";
        }
        for name in theorem.coq {
            text.extend(["Check ", name, ".\n"]);
        }
    }
    text
}
