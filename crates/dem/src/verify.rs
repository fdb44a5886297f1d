//! Measured contact forces, compared with the exact ones of a pile: whether a simulation got it right.
//!
//! What is measured is a list of pairs of spheres with the force between them, [`Measured`]: from a file ([`read`]: a
//! csv table, or what LAMMPS writes as `dump local`), or straight from a simulation. A [`Comparison`] holds it against a
//! [`Packing`](cannonpile::Packing), contact by contact.
//!
//! # What is compared
//! Spheres are numbered from 1, in row order from the top, as `cannonpile spheres` prints them. A force is in the units of
//! the packing, N for sizes in SI; positive is push. A vector is the force **on the first** of the two spheres. So it is
//! in LAMMPS: `force` of `compute pair/local` is positive for repulsion, and `fx fy fz` act on `patom1` of
//! `compute property/local`, whichever of the two has the greater id.
//!
//! * The exact force is rounded once, to the nearest `f64`, and compared with the `f64` measured: an error of 0 means that
//!   all bits agree, and no other is reported as 0. A relative error is itself right to a few units of 2⁻⁵³.
//! * The error of a contact is |f − f₀|/|f₀|, f measured, f₀ exact; with a vector the greater of that and
//!   |**F** − **F**₀|/|f₀|. So a force that is turned has an error, and so has a magnitude that is not that of its vector.
//!   Pull (a negative force) is a difference like any other.
//! * A contact whose exact force is 0 may be measured or not. The error of what is measured there is relative to the
//!   largest exact force of the pile.
//! * A contact whose exact force is not 0 and that is not in the list, or is there with a force of 0, is missing.
//! * A pair that is no contact of the pile is extra if it has a force over the accepted error times the largest exact
//!   force; below that it is noise. This goes for neighbours that touch besides the contacts too, as in a layer at a = R.
//! * Two spheres of the bottom layer are fixed: such pairs are counted, and not judged.
//! * Where all measured forces are the exact ones times one factor, that factor is named: 9.81 for a simulation with
//!   another gravity, −1 for forces with the other sign.
//!
//! # Other codes' tables
//! A [`Reader`] compares a file while it reads it: columns of any names ([`Columns`]), of known codes ([`Preset`]), contacts by
//! the numbers of the spheres or by where they are, in whatever [`Frame`]. [`Comparison::findings`] says what differences have
//! in common, [`Unbalanced`] what is left on each sphere, a [`RefinementStudy`] the observed order of accuracy of several runs.
//!
//! # Examples
//! A test of a simulation in three lines:
//! ```
//! use cannonpile::geometry::Spacing;
//! use cannonpile_dem::verify::{Comparison, Measured};
//! use cannonpile::{Packing, Pile};
//! use num_rational::BigRational;
//!
//! let pile = Pile::triangular(2)?;
//! let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
//!
//! let simulated = [(2, 1, 0.46225021), (3, 1, 0.46225018), (4, 1, 0.46225014)];
//! let measured = simulated.map(|(id1, id2, force)| Measured::new([id1, id2], force));
//! let comparison = Comparison::new(&packing, measured)?;
//! assert!(comparison.accepted(1e-6), "{comparison}");
//! # Ok::<(), cannonpile_dem::verify::Refusal>(())
//! ```
//! A DEM in Rust tests itself with `cannonpile-dem = "0.1"` among its `[dev-dependencies]`:
//! ```
//! use cannonpile_dem::verify::{Comparison, Measured};
//! use cannonpile::{Packing, Pile};
//! # /// One sphere on three that are fixed.
//! # fn relax(centres: &[[f64; 3]]) -> Vec<(u64, u64, f64)> {
//! #     let rise = (centres[0][2] - centres[1][2]) / 2.0;
//! #     (2..=4).map(|below| (1, below, 1.0 / (3.0 * rise))).collect()
//! # }
//!
//! # fn piles_bear_what_they_must() -> Result<(), Box<dyn std::error::Error>> {
//! let pile = Pile::triangular(2)?;
//! // R = 1 m, m = 1 kg, g = 1 m/s²; the bottom layer is fixed.
//! let packing = Packing::new(&pile, &"1.2".parse()?)?;
//! let exact = pile.shape().sites().map(|site| packing.position(site));
//! let centres = exact.map(|centre| Ok(centre?.map(|x| x.nearest().unwrap_or(f64::NAN))));
//! let centres = centres.collect::<Result<Vec<[f64; 3]>, cannonpile_dem::Error>>()?;
//!
//! let contacts = relax(&centres); // your code
//!
//! let measured = contacts.into_iter().map(|(id1, id2, force)| Measured::new([id1, id2], force));
//! let comparison = Comparison::new(&packing, measured)?;
//! assert!(comparison.accepted(1e-6), "{comparison}");
//! # Ok(())
//! # }
//! # piles_bear_what_they_must().unwrap();
//! ```

mod axes;
mod columns;
mod comparison;
mod csv_file;
mod difference;
mod dump;
mod entry;
mod finding;
mod frame;
mod gathering;
mod header;
mod ledger;
mod lines;
mod measured;
mod placed;
mod places;
mod preset;
mod read;
mod reading;
mod refinement;
mod refusal;
mod registration;
mod report;
mod slots;
mod symptoms;
mod tally;
mod unbalanced;
mod vtk_array;
mod vtk_file;

pub use axes::{Axes, Coordinate, TableAxis};
pub use columns::Columns;
pub use comparison::Comparison;
pub use csv_file::read_csv;
pub use difference::{Difference, Extra};
pub use dump::read_dump;
pub use entry::Force;
pub use finding::Finding;
pub use frame::Frame;
pub use measured::{MAX_ENTRIES, Measured};
pub use placed::Placed;
pub use preset::Preset;
pub use read::{Compared, Reader, read};
pub use reading::Reading;
pub use refinement::{
    Fit, Level, LevelPlace, Limit, MAX_LEVELS, NoOrder, NoRefinement, NoRefinementFiles, Norm,
    Refinement, RefinementFile, RefinementFiles, RefinementReport, RefinementStudy,
};
pub use refusal::{Fault, Refusal};
pub use report::{Report, Source};
pub use unbalanced::Unbalanced;
