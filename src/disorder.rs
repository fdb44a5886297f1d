//! Random stackings: every stacking with its probability, and what the piles of all of them bear in the mean.

mod correlation;
mod faults;
mod frame;
mod grid;
mod mean;
mod number;
mod pairs;
mod piles;
mod place;
mod stackings;
mod transfer;
mod walk;
mod width;

pub use faults::{ByFaults, FaultForce};
pub use mean::{Mean, MeanForce};
pub use pairs::PairMoments;
pub use piles::RandomPiles;
pub use place::Place;
pub use stackings::{FirstSign, RandomStackings};
