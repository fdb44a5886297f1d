//! Random stackings: every stacking with its probability, and what the piles of all of them bear in the mean.

mod faults;
mod frame;
mod grid;
mod mean;
mod number;
mod piles;
mod place;
mod stackings;
mod transfer;
mod walk;
mod width;

pub use faults::{ByFaults, FaultForce};
pub use mean::{Mean, MeanForce};
pub use piles::RandomPiles;
pub use place::Place;
pub use stackings::{FirstSign, RandomStackings};
