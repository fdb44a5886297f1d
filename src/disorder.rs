#![doc = include_str!("disorder.md")]

mod correlation;
#[cfg(feature = "ensemble")]
mod ensemble;
mod faults;
mod floor;
mod frame;
mod grid;
mod mean;
mod moments;
mod number;
mod pairs;
mod piles;
mod place;
mod stackings;
mod transfer;
mod walk;
mod width;

#[cfg(feature = "ensemble")]
#[cfg_attr(docsrs, doc(cfg(feature = "ensemble")))]
pub use ensemble::{
    By, Choice, Distribution, Ensemble, Extreme, Histogram, Samples, Shard, Tally, Unmergeable,
    WithFaults,
};
pub use faults::{ByFaults, FaultForce};
pub use mean::{Mean, MeanForce};
pub use moments::{Moments, Wave};
pub use pairs::PairMoments;
pub use piles::RandomPiles;
pub use place::Place;
pub use stackings::{FirstSign, RandomStackings, check_fault_probability};
