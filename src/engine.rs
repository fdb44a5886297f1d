//! The computation of contact forces: a plan chooses one of several engines.
//!
//! | method | algorithm | files |
//! |---|---|---|
//! | *closed* | by lines: count the spheres on a line: paper, (8) and (9) | `lines.rs`, `tree.rs` |
//! | *tree* | by lines: memoised recursion on the dependency cone of a sphere; its nodes lie at sign changes | `tree.rs` |
//! | *sweep* | by layers: layer by layer from the top, one layer in memory: a transfer matrix applied matrix-free | `sweep.rs`, and the files below |
//! | *table* | tabulated closed form: the distinct forces of a straight pile, copied row by row | `table.rs` |
//!
//! A sweep consists of these parts:
//!
//! | part | file |
//! |---|---|
//! | storage of the lines of contacts: one cell for a line, in every layer | `grid.rs`, `plane.rs` |
//! | numerators of a scalar, as they are | `cells.rs` |
//! | exact numerators in limbs of 64 bits, with deferred carries | `limbs.rs` |
//! | deferred passes, made together as a wavefront over bands of rows, in parallel | `bands.rs` |
//! | a third of each layer, where the pile has threefold symmetry | `thirds.rs` |
//! | correctly rounded floats, straight from the limbs | `nearest.rs` |
//!
//! `ends.rs` lists the few sites of a layer at which the forces can be extreme.
//!
//! An engine receives the pile as `LineForces`, in the numerators of a scalar. It counts and transmits only by the
//! functions of [`formula`](crate::formula).

mod bands;
mod cells;
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
mod slices;
mod sweep;
mod table;
mod thirds;
mod tree;

#[cfg(test)]
pub(crate) use cells::Cells;
pub(crate) use grid::{Grid, MAX_NUMBERS};
#[cfg(feature = "std")]
pub use interrupt::Interrupt;
pub use interrupt::check as check_interrupt;
pub(crate) use limbs::Planes;
pub(crate) use lines::{LineForces, SphereForces, numerators, to_scalar, to_scalars};
pub use meter::Counters;
pub(crate) use meter::Meter;
pub(crate) use nearest::{Readout, Unit};
pub use parallel::{map, threads, try_for_each};
pub use plan::Plan;
pub(crate) use plan::{trees_are_cheaper, unless_too_large};
pub use question::{Method, Quantity, Question};
pub(crate) use rows::{Engine, shortest_exact_sweep};
pub(crate) use slices::{fill_rows, split_front};
pub(crate) use sweep::Sweep;
pub(crate) use table::Table;
pub(crate) use tree::{LineSelection, MAX_NODES, size_of_tree};

// Re-exports for the other crates of the workspace.
pub use crate::error::{bug, copies, not_negative, positive, refuse_beyond, refuse_beyond_memory};
pub use exact_surd::equality;
pub use exact_surd::rational::{common_denominator, common_multiple, product, quotient, sum_of};
pub use exact_surd::short::{numbers as shortened, quoted};
