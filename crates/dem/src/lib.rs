//! Sphere piles for DEM codes: scenes read, piles exported, and forces of simulations verified.
//!
//! The exact forces come from the crates [`cannonpile`] and [`cannonpile_horizontal`]. This crate exchanges them with
//! other programs. All exported files are in SI units: lengths in m, masses in kg, forces in N, z up. `columns.csv`
//! accompanies the csv files, and states the unit and the meaning of each column.
//!
//! # Map
//! The modules are roughly in the order in which they build on each other.
//!
//! | module | contents |
//! |---|---|
//! | [`Error`], [`Key`] | errors of this crate, and the keys of a scene |
//! | [`scene`] | a pile as a user describes it: options, TOML files, named benchmark cases |
//! | [`table`] | tables of forces and spheres as csv, JSON and text; files that are complete or absent |
//! | the crate root | whole piles: [`PileExport`] for files, [`NumberedPile`] for their contacts |
//! | | [`Compliance`]: the difference between forces on springs and exact forces |
//! | | [`derivatives()`]: those of all forces by radii, loads and tilt |
//! | [`verify`] | measured contact forces, compared with the exact ones |
//!
//! # Example
//! The example exports a pile of two layers, and then compares the forces of a simulation with the exact ones.
//! ```
//! use cannonpile_dem::scene::Scene;
//! use cannonpile_dem::verify::{Comparison, Measured};
//! use cannonpile_dem::{PileExport, PileFormat};
//!
//! let scene = Scene::from_toml("layers = 2\nspacing = 1.2")?;
//! let pile = scene.pile()?;
//! let packing = scene.packing(&pile)?;
//!
//! // Spheres, contacts and exact forces, for any program.
//! let folder = tempfile::tempdir()?;
//! let written = PileExport::new(&packing)?.write(&[PileFormat::Csv], folder.path(), &mut |_| {})?;
//! let names: Vec<_> = written.iter().map(|written| written.name()).collect();
//! assert_eq!(names, ["spheres.csv", "contacts.csv", "base.csv", "columns.csv"]);
//!
//! // The contacts that a simulation has found: two sphere numbers and a force in N.
//! let simulated = [(1, 2, 0.46225021), (1, 3, 0.46225018), (1, 4, 0.46225014)];
//! let measured = simulated.map(|(id1, id2, force)| Measured::new([id1, id2], force));
//! let comparison = Comparison::new(&packing, measured)?;
//! assert!(comparison.accepted(1e-6), "{comparison}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[doc(hidden)]
pub mod angle;
#[doc(hidden)]
pub mod card;
mod compliance;
mod csv;
mod derivatives;
mod error;
mod export;
mod file;
#[doc(hidden)]
pub mod grown;
mod json;
mod key;
mod lammps;
mod matrix;
#[doc(hidden)]
pub mod numbered;
mod polydata;
mod rough;
pub mod scene;
mod springs;
pub mod table;
#[doc(hidden)]
pub mod template;
mod vector;
pub mod verify;
mod vtp;
#[doc(hidden)]
pub mod weights;
mod yade;

use cannonpile::each::Each;

pub use card::CardTitle;
pub use compliance::{Compliance, NoCompliance, SoftContact};
pub use derivatives::{Component, Parameter, derivatives};
pub use error::Error;
pub use export::PileExport;
pub use file::{OtherFile, PileFile, PileFormat, Written, files};
#[doc(hidden)]
pub use grown::{anchor, brief, stacking};
pub use key::Key;
pub use numbered::{NumberedContact, NumberedPile};
pub use rough::Friction;

/// The examples of README.md, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
