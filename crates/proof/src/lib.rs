//! The theorems of cannonpile with their proofs, and their export to the proof assistant Coq.
//!
//! [`cannonpile::theorem`] proves the paper's results with polynomials. This crate proves all other theorems: on discs and
//! other dimensions, stackings, loads and leaning gravity, the stress of a sphere, conditioning, a rough floor, horizontal
//! contacts, and random stackings. [`all`] lists them together.
//!
//! This crate also exports the formulas to Coq. It runs [`Formulas::LIBRARY`] on [`Expression`]s, which record each
//! operation, and turns every record into a definition. The theorems in the folder `coq` are about these definitions,
//! not about a copy of the formulas. They cover the balance of a sphere, action and reaction, the pile by recursion on
//! its layers, and sums by induction. Coq's kernel accepts them without axioms.
//!
//! # Examples
//! ```
//! let tilt = cannonpile_proof::find("tilt").unwrap();
//! assert!(tilt.prove().holds());
//! assert!(tilt.coq.contains(&"Loads.nearest_tilt"));
//! ```
//! The files for Coq contain the formulas:
//! ```
//! let files = cannonpile_proof::files()?;
//! let formulas = files.iter().find(|file| file.name() == "Formulas.v").unwrap();
//! assert!(formulas.text().contains(
//!     "Definition force (n : Q) (increment : Q) : Q :=\n  n * increment.\n"
//! ));
//! # Ok::<(), cannonpile_proof::Error>(())
//! ```
//!
//! # Map
//! | item | contents |
//! |---|---|
//! | [`Expression`], [`Operation`] | a scalar that records the operations on it |
//! | [`Formulas`] | the formulas in the theorems |
//! | [`Theorem`], [`all`], [`find`] | all theorems, each with its names in Coq |
//! | [`Listing`] | a theorem and its proof as text |
//! | [`files`], [`files_of`], [`ProofFile`] | the files for Coq |
//! | [`commands`] | the shell commands that check them |
//! | [`Error`] | the errors of this crate |
//!
//! # Limits
//! * The recorded expression is the computation of the library in every exact scalar, because each formula has one
//!   generic body. It is not proved that rustc compiles this body as written.
//! * The proofs do not cover how an engine finds the spheres on a line, or where it stores a number. Tests compare
//!   the engines.
//! * Floats are rounded, and nothing is proved about them.

mod coq;
mod definition;
mod error;
mod expression;
mod formulas;
mod language;
mod names;
mod recorded;
mod theorem;

pub use coq::{ProofFile, commands, files, files_of};
pub use error::Error;
pub use expression::{Expression, Operation};
pub use formulas::Formulas;
pub use theorem::{Listing, Theorem, all, find, own};

/// The examples of README.md, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
