//! A whole pile as files: for spreadsheets, LAMMPS, ParaView, YADE; as a benchmark card, as a test for the suites of LAMMPS and
//! YADE, and as a page for a browser.
//!
//! A [`PileExport`] writes them, a [`Page`] the last alone; a [`NumberedPile`] is what they have in common: the numbers of the spheres, and the
//! contacts between them with their forces as floats. A [`Compliance`] says how far the forces of a code with springs are
//! from these.
//!
//! # Units
//! All files are in SI: lengths in m, masses in kg, forces in N, z up. `columns.csv`, written with the csv files, says
//! so of each of their columns.
//!
//! # Examples
//! ```
//! use cannonpile::dem::{PileExport, PileFormat};
//! use cannonpile::geometry::Spacing;
//! use cannonpile::{Packing, Pile};
//! use num_rational::BigRational;
//!
//! let pile = Pile::triangular(10)?;
//! let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
//! let folder = tempfile::tempdir()?;
//! let written = PileExport::new(&packing)?.write(&[PileFormat::Csv], folder.path(), &mut |_| {})?;
//! let names: Vec<_> = written.iter().map(|written| written.file.name()).collect();
//! assert_eq!(names, ["spheres.csv", "contacts.csv", "base.csv", "columns.csv"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod arrays;
mod card;
mod compliance;
mod csv;
mod export;
mod file;
mod grown;
mod lammps;
mod lammps_test;
mod numbered;
mod page;
mod polydata;
mod springs;
mod suite;
mod sunk;
mod template;
mod vtp;
mod weights;
mod yade;
mod yade_check;

pub use arrays::PileArrays;
pub use card::CardTitle;
pub use compliance::{Compliance, NoCompliance, SoftContact};
pub use export::PileExport;
pub use file::{PileFile, PileFormat, Written, files};
#[cfg(feature = "plot")]
pub(crate) use grown::{anchor, brief, stacking};
pub use numbered::{NumberedContact, NumberedPile};
pub use page::Page;
