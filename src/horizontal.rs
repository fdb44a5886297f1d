//! What a pile can bear with horizontal contacts, at a = R: exactly, and with [certificates](crate::certificate).
//!
//! The paper leaves it open: "horizontal contacts should be considered in order to get more physical behavior like
//! arching. But in this case, the system is hyperstatic and more complicated techniques are to be used." There is one
//! equation less than there are unknown forces for each horizontal contact above the floor
//! ([`paper`](crate::paper#horizontal-contacts)). Four questions have an answer nevertheless:
//!
//! | question | call |
//! |---|---|
//! | Are there forces that only push? | [`Pile::equilibrium`](crate::Pile::equilibrium) |
//! | Of which stackings are there? | [`census`] |
//! | What can a bottom sphere bear at least, and at most? | [`Pile::bounds`](crate::Pile::bounds) |
//! | What do springs bear that only push? | [`Pile::elastic`](crate::Pile::elastic) |
//!
//! # How
//! A linear or quadratic program over the forces, solved in floats by an interior point (clarabel), is a guess: it says
//! which forces are zero and which inequalities are equalities. These equations are then solved exactly, by elimination
//! in rationals; where they leave numbers free, these are rounded from the guess to small denominators. What comes of
//! it is checked as a [`Certificate`](crate::certificate::Certificate), and nothing else is answered: where it is
//! refused, the answer is an outer bound that is certified, or an error.

mod base;
mod bounds;
pub mod census;
mod edge;
mod elastic;
mod exact;
mod network;
mod program;
mod run;
mod springs;
mod stand;
mod straight;
mod symmetry;

pub use base::BaseBounds;
pub use bounds::{NormalBound, NormalBounds};
pub use elastic::ElasticState;
