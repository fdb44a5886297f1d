//! Tables of the forces and spheres of a pile, as csv, json and aligned text.
//!
//! A [`Table`] has columns, and rows generated on request. Writing needs memory for one page of rows. Cells are exact,
//! and a [`NumberFormat`] determines how they are shown. Before the first byte is written, a bound of all numbers is
//! checked, so that each number fits in the format.
//!
//! # Units
//!
//! csv and json contain no units: [`Column::unit`] states them, and the text table shows them. In pile units
//! ([`Units::of_pile`])
//!
//! | column | unit |
//! |---|---|
//! | `force` of a contact | f₀ = mg/(3cosθ); mg/(2(1+sinφ)cosθ) in general, mg/(2cosθ) for discs |
//! | `normal` | mg |
//! | `shear_x` | mg·tanθ |
//! | `shear_y` | √3·mg·tanθ; 2cosφ·mg·tanθ in general |
//! | `stress_xx` and others | as for [`Forces::stress`](cannonpile::Forces::stress) |
//!
//! so that all values are rational. In SI units ([`Units::of_packing`]) forces are in N, lengths in m, masses in kg.
//!
//! # Examples
//! ```
//! use cannonpile::Pile;
//! use cannonpile_dem::table;
//! use cannonpile_dem::table::{FileFormat, NumberFormat, Units};
//! use cannonpile::shape::Selection;
//!
//! let pile = Pile::triangular(2)?;
//! let table = table::base(&Units::of_pile(&pile), Selection::Base)?;
//! let mut csv = Vec::new();
//! table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
//! assert_eq!(
//!     String::from_utf8(csv)?,
//!     "i,j,normal,shear_x,shear_y\n0,0,4/3,-1/6,-1/6\n1,0,4/3,-1/6,1/6\n0,1,4/3,1/3,0\n",
//! );
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cell;
mod error;
mod file;
mod folder;
mod json;
mod line;
mod pieces;
mod progress;
mod rows;
mod summary;
mod tables;
mod text;
mod unfinished;
mod units;
mod write;

pub use cell::{Cell, NumberFormat};
pub use error::WriteError;
pub(crate) use file::Aside;
pub use file::write_aside;
pub use folder::write_all;
pub(crate) use pieces::{PIECE, columns, in_pieces, slices};
pub(crate) use progress::Progress;
#[doc(hidden)]
pub use rows::Row;
pub use rows::{Column, Table};
pub use summary::Summary;
#[doc(hidden)]
pub use summary::{stacking, steps};
pub(crate) use tables::in_dimension;
pub use tables::{MAX_ROWS, base, contacts, spheres, spheres_with_stress, touching_contacts};
#[doc(hidden)]
pub use tables::{indices, places, refuse_beyond};
pub use tables::{rough_base, rough_contacts, rough_summary};
pub(crate) use unfinished::Pending;
pub use unfinished::remove_unfinished;
pub use units::Units;
pub use write::FileFormat;
