//! All theorems in one list: the paper's, which the core proves, and those of this crate.

mod bounds;
mod closures;
mod conditioning;
mod dimensions;
mod disorder;
mod friction;
mod horizontal;
mod loads;
mod stackings;
mod steps;
mod terms;

use core::fmt;

use cannonpile::theorem;
use cannonpile::theorem::{Proof, ProofKind};

use crate::{Formulas, names};

/// A theorem about the formulas of the core, of horizontal contacts or of random stackings.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Theorem {
    /// A short name.
    pub name: &'static str,
    /// The statement, in words and formulas.
    pub statement: &'static str,
    /// The values of the symbols for which the theorem holds.
    pub hypotheses: &'static str,
    /// The method of proof.
    pub method: ProofKind,
    /// The symbols of the statement.
    pub symbols: &'static str,
    /// The names of its proofs in Coq, each with its file; empty without a proof in Coq.
    pub coq: &'static [&'static str],
    source: Source,
}

/// A theorem, by the crate that proves it.
#[derive(Clone, Copy, Debug)]
enum Source {
    Core(&'static theorem::Theorem),
    Own(&'static theorem::Theorem<Formulas>),
}

impl Theorem {
    fn new<F>(theorem: &theorem::Theorem<F>, source: Source) -> Self {
        Self {
            name: theorem.name,
            statement: theorem.statement,
            hypotheses: theorem.hypotheses,
            method: theorem.method,
            symbols: theorem.symbols,
            coq: names::in_coq(theorem.name),
            source,
        }
    }

    /// Returns the proof for the formulas of the library.
    ///
    /// # Examples
    /// ```
    /// let theorem = cannonpile_proof::find("corner-least").unwrap();
    /// assert!(theorem.prove().holds());
    /// ```
    #[must_use]
    pub fn prove(&self) -> Proof {
        self.prove_for(&Formulas::LIBRARY)
    }

    /// Returns the proof, or the refutation, for any formulas.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_proof::Formulas;
    ///
    /// let mut wrong: Formulas = Formulas::LIBRARY;
    /// wrong.least_on_corner = |k| k.clone() + k;
    /// assert!(!cannonpile_proof::find("corner-least").unwrap().prove_for(&wrong).holds());
    /// ```
    #[must_use]
    pub fn prove_for(&self, formulas: &Formulas) -> Proof {
        match self.source {
            Source::Core(theorem) => theorem.prove_for(&formulas.core),
            Source::Own(theorem) => theorem.prove_for(formulas),
        }
    }
}

/// Returns the theorems of this crate.
///
/// Only tests call this function. Other callers use [`all`], which includes these theorems.
#[doc(hidden)]
pub fn own() -> impl Iterator<Item = &'static theorem::Theorem<Formulas>> {
    [
        dimensions::THEOREMS,
        stackings::THEOREMS,
        loads::THEOREMS,
        closures::THEOREMS,
        conditioning::THEOREMS,
        friction::THEOREMS,
        horizontal::THEOREMS,
        bounds::THEOREMS,
        disorder::THEOREMS,
    ]
    .into_iter()
    .flatten()
}

/// Returns all theorems in reading order: those of the core, then those of this crate.
///
/// # Examples
/// ```
/// let in_coq = cannonpile_proof::all().filter(|theorem| !theorem.coq.is_empty());
/// assert_eq!(in_coq.count(), cannonpile_proof::all().count());
/// let weight = cannonpile_proof::find("weight").unwrap();
/// assert!(weight.coq.contains(&"Floor.the_weight_arrives"));
/// ```
pub fn all() -> impl Iterator<Item = Theorem> {
    let core = theorem::all().map(|found| Theorem::new(found, Source::Core(found)));
    core.chain(own().map(|found| Theorem::new(found, Source::Own(found))))
}

/// Returns the theorem with a given name.
///
/// # Examples
/// ```
/// assert!(cannonpile_proof::find("equilibrium").is_some());
/// assert!(cannonpile_proof::find("fermat").is_none());
/// ```
#[must_use]
pub fn find(name: &str) -> Option<Theorem> {
    all().find(|theorem| theorem.name == name)
}

/// A theorem with its proof, as [`cannonpile::theorem::Listing`] writes it.
///
/// # Examples
/// ```
/// use cannonpile_proof::Listing;
///
/// let theorem = cannonpile_proof::find("settlement").unwrap();
/// let text = Listing { theorem: &theorem, proof: &theorem.prove(), whole: false }.to_string();
/// assert!(text.starts_with("settlement: holds (identity)\n"));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Listing<'a> {
    /// The theorem.
    pub theorem: &'a Theorem,
    /// Its proof.
    pub proof: &'a Proof,
    /// `true` writes the whole derivation: hypotheses, symbols, and the two sides of each equation on separate
    /// lines.
    pub whole: bool,
}

impl fmt::Display for Listing<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { proof, whole, .. } = *self;
        match self.theorem.source {
            Source::Core(theorem) => (theorem::Listing {
                theorem,
                proof,
                whole,
            })
            .fmt(f),
            Source::Own(theorem) => (theorem::Listing {
                theorem,
                proof,
                whole,
            })
            .fmt(f),
        }
    }
}
