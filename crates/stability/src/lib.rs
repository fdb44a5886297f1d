//! What regular sphere piles bear: tilts of gravity, unequal spheres, and friction in two layers. And the list of all
//! stable stackings.
//!
//! The core, [`cannonpile`], says whether a [`Pile`](cannonpile::Pile) is stable:
//! [`Pile::stands`](cannonpile::Pile::stands). This crate says how far it is from the limit, in exact numbers.
//!
//! | question | call |
//! |---|---|
//! | Which tilts of gravity does a pile bear, and which contact opens first? | [`tilts(&pile)`](tilts), [`margin(&pile)`](margin) |
//! | Which stackings are stable? | [`census`] |
//! | How does each force change if one sphere is larger? | [`sensitivity(&packing, site)`](sensitivity()) |
//! | Which contact do unequal spheres open first? | [`spread(&packing)`](spread) |
//! | How does each force change if contacts are longer or shorter? | [`FirstOrder`] |
//! | What are the forces of two layers on a rough floor, without glue? | [`RoughFloor::new(&pile)`](RoughFloor::new), [`RoughPacking::new(&packing)`](RoughPacking::new) |
//!
//! # Map
//! | module | contents |
//! |---|---|
//! | [`Error`] | the errors of this crate |
//! | `tilt` | the tilts of gravity that a pile bears |
//! | [`census`] | the stable stackings |
//! | `first_order` | the change of all forces if contacts become longer or shorter |
//! | `sensitivity` | unequal spheres |
//! | `friction` | two layers on a rough floor |

pub mod census;
mod error;
mod first_order;
mod friction;
mod sensitivity;
mod tilt;

pub use error::Error;
pub use first_order::{FirstOrder, ForceChange};
pub use friction::{RoughContact, RoughFloor, RoughPacking};
pub use sensitivity::{Spread, sensitivity, spread};
#[doc(hidden)]
pub use tilt::above_last_run;
pub use tilt::{Affine, Margin, Tilt, Tilts, force_by_tilt, margin, tilts, tilts_by_oracle};

/// The example of README.md, compiled as a doc test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
