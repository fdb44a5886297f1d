//! Comparison of measured contact forces with the exact forces of a pile, to verify a simulation.
//!
//! A measurement is a list of pairs of spheres with the force between them ([`Measured`]). It comes straight from a
//! simulation, or from a file ([`read`]): a csv table, or the `dump local` file of LAMMPS. A [`Comparison`] compares
//! the list with a [`Packing`](cannonpile::Packing), contact by contact.
//!
//! # Conventions
//! Spheres are numbered from 1, in row order from the top, as `cannonpile spheres` prints them. A force is in the units
//! of the packing: newtons if sizes are in SI. Compressive forces are positive. A vector is the force **on the first**
//! of the two spheres. LAMMPS follows the same conventions: `force` of `compute pair/local` is positive for repulsion.
//! `fx fy fz` act on `patom1` of `compute property/local`, whichever of the two has the greater id.
//!
//! # Comparison
//!
//! * The exact force is correctly rounded to `f64`, then compared with the measured `f64`. An error of 0 means that all
//!   bits agree; every other error is reported as positive. A relative error is itself accurate to a few units of 2⁻⁵³.
//! * The relative error of a contact is |f − f₀|/|f₀|, with f measured and f₀ exact. If vectors were measured, the
//!   error is the greater of this and |**F** − **F**₀|/|f₀|. So a rotated force has an error, and so has a magnitude
//!   that disagrees with its vector. A tensile force is negative; its error follows the same formula.
//! * A contact whose exact force is 0 may be absent from the list. If it was measured, its error is relative to the
//!   largest exact force of the pile.
//! * A contact is missing if its exact force is not 0, and the list lacks it. A force of 0 is a measurement, with an
//!   error of 1.
//! * A pair may be listed twice: in both orders, or with the same force. If the two forces differ, the worse one is
//!   judged. If they differ by more than the accepted error times the exact force, the comparison is not accepted.
//! * A pair without a contact in the pile is extra if its force exceeds the accepted error times the largest exact
//!   force. A smaller force is noise. The same holds for neighbours that touch without being contacts, as in a layer at
//!   a = R.
//! * The spheres of the bottom layer are fixed, unless the floor is rough: pairs of two of them are counted, but not judged.
//! * A sphere of the bottom layer may be paired with a number outside the pile, or touch a point below its centre. This
//!   is a contact with the floor or with a wall. The sum of the vertical forces on the sphere is compared with the exact
//!   normal force of the floor, relative to that force. If there are
//!   several such contacts, but only their magnitudes are known, they are counted as contacts with walls.
//! * On a rough floor, the normal and the tangential force of each contact are compared, and the friction of the floor. The
//!   error of a tangential force is |**T** − **T**₀|/|**T**₀|, or relative to the largest |**T**₀| where **T**₀ is 0. The
//!   moment on a sphere is Σ **r** × **T**, with **r** from its centre to the contact.
//! * If one bottom sphere has a force of the floor, all that press on the floor need one; on a rough floor always.
//! * Equal rows of one contact are repetitions, or shares of its force if their sums are nearer to the exact forces.
//! * If one factor takes away most of the error, the report names this factor. A factor of 9.81 means different gravity, and −1
//!   means the opposite sign convention.
//!
//! # Other codes' tables
//! A [`Reader`] compares a file while it reads it. [`Columns`] maps columns of any names, and a [`Preset`] holds the
//! columns of a known code. Contacts are matched by the numbers of the spheres, or by position in any [`Frame`].
//!
//! # Diagnosis
//! [`Comparison::findings`] explains the differences, mostly by the loads of the spheres. With exact forces, the sum of the forces
//! on each sphere is its weight and load. If all sums are off by one factor, gravity differs; by one vector, it leans; one of them,
//! a mass differs. If they balance, the directions of the forces show a wrong spacing or diameter, and errors that are in
//! proportion to the [compliance](crate::Compliance) show soft springs. If none balances, the pile moves, or friction bears a part.
//! [`Unbalanced`] is the residual force on each sphere. A
//! [`RefinementStudy`] yields the observed order of accuracy of several simulations.
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
//! A DEM code in Rust can test itself with `cannonpile-dem = "0.1"` among its `[dev-dependencies]`:
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
mod comparison;
mod difference;
mod digits;
mod finding;
mod floor;
mod frame;
mod friction;
mod gathering;
mod ledger;
mod loads;
mod measured;
mod placed;
mod places;
mod read;
mod refinement;
mod refusal;
mod registration;
mod report;
mod shown;
mod soft;
mod symptoms;
mod tally;
mod unbalanced;

pub use contact_tables::{
    Columns, Dialect, DialectOptions, FileKind, Force, Mark, Preset, RowCounts, Separator,
    TextEncoding,
};

pub use axes::{Axes, Coordinate, TableAxis};
pub use comparison::Comparison;
pub use difference::{Difference, Extra};
pub use finding::{Finding, FindingKind};
pub use frame::Frame;
pub use measured::{MAX_ENTRIES, Measured};
pub use placed::Placed;
pub use read::{Compared, Reader, read};
pub use refinement::{
    Fit, Level, LevelPlace, MAX_LEVELS, NoRefinement, Norm, Refinement, RefinementReport,
    RefinementStudy,
};
pub use refusal::{Fault, Refusal};
pub use report::{Report, Source};
pub use unbalanced::Unbalanced;
