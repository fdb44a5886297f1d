//! Wrong formulas, each with the exact list of theorems that it refutes.

mod counts;
mod floor;
mod forces;
mod horizontal;
mod loads;
mod parts;
mod places;

pub use parts::{Fault, over, sum, swapped, twice};

/// The faults of the core's formulas, ordered by the wrong formula.
///
/// The core itself has no theorem about some of them. `cannonpile-proof` has the theorems about horizontal contacts, loads,
/// sign changes and bounds of layers.
pub fn of_the_core() -> Vec<Fault> {
    [
        counts::faults(),
        places::faults(),
        forces::faults(),
        floor::faults(),
        loads::faults(),
        horizontal::faults(),
    ]
    .into_iter()
    .flatten()
    .collect()
}
