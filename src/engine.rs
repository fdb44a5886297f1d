//! How a line gets its force: the plan, and the engines that it chooses among.
//!
//! | method | how | where |
//! |---|---|---|
//! | *closed* | by counting the spheres on a line, paper, (8) and (9) | `closed.rs` |
//! | *tree* | the lines above one sphere, which begin at the changes of sign | `tree.rs` |
//! | *sweep* | layer after layer, one in memory: plainly in the numbers of a scalar, or in limbs; of extremes a third of it | `sweep.rs`, `cells.rs`, `bands.rs`, `plane.rs`, `limbs.rs`, `thirds.rs` |
//! | *table* | the distinct forces of a straight pile, copied row by row | `table.rs` |
//!
//! Engines know a `System`, not a pile. They count and pass on by the functions of
//! [`formula`](crate::formula), and by nothing else.

mod bands;
mod cells;
mod closed;
mod ends;
mod grid;
mod interrupt;
mod limbs;
mod lines;
mod meter;
mod nearest;
mod parallel;
mod plan;
mod plane;
mod question;
mod rows;
mod single;
mod slices;
mod sweep;
mod table;
mod thirds;
mod tree;

pub(crate) use cells::Cells;
pub(crate) use closed::closed_contact;
pub(crate) use grid::{Grid, MAX_NUMBERS};
#[cfg(feature = "std")]
pub use interrupt::Interrupt;
pub use interrupt::check as check_interrupt;
#[cfg(feature = "rayon")]
pub(crate) use interrupt::{current as current_request, within};
pub(crate) use limbs::Planes;
pub(crate) use lines::{Lines, Received};
pub use meter::Counters;
pub(crate) use meter::Meter;
pub(crate) use nearest::{Readout, Unit};
pub use parallel::{map, threads, try_for_each};
pub use plan::Plan;
pub(crate) use plan::{Keeping, trees_are_cheaper, unless_too_large};
pub use question::{Method, Quantity, Question};
pub(crate) use rows::{Engine, shortest_exact_sweep};
pub(crate) use single::received;
pub(crate) use slices::{fill_rows, split_front};
pub(crate) use sweep::Descent;
pub(crate) use table::Table;
pub(crate) use tree::{Wanted, nodes};

// For the crates beside this one.
pub use crate::error::{bug, copies, refuse_beyond, refuse_beyond_memory};
pub use exact_surd::rational::{common_denominator, common_multiple, product, sum_of};
pub use exact_surd::short::{numbers as shortened, quoted};
