//! Enumeration and sampling of stackings, for quantities that are not linear in the stackings.
//!
//! Mean forces obey one recursion over all stackings. Stability, the least force and the distribution of forces do not,
//! so the forces of each stacking are computed. An [`Ensemble`] is a top layer with every stacking below it, or a base
//! with every stacking above it. A [`Choice`] selects all stackings or random samples, and a [`Shard`] selects a part of
//! them. The result is a [`Tally`] of exact integers and rationals, sorted by the number of faults. So the fault
//! probability can be chosen afterwards. The tallies of all shards [merge](Tally::merge) into the tally of the whole, bit
//! for bit, in any order.
//!
//! # Stackings in the counts
//! The distribution `all` includes unstable stackings, in which some contact is in tension. Their forces are those of a
//! prestressed pile. The distribution `standing` covers the stackings without tension. Loose spheres can form these
//! piles.
//!
//! # On a base
//! A layer above a base has all sites whose three supports exist. It depends on the numbers of + and − steps between the
//! base and the layer, but not on their order. So all stackings with equally many + steps have the same top layer. Once
//! this number is given, each layer follows from the steps above it. If the top layer is empty, the base does not support
//! these stackings. Only [`WithFaults::left_out`] counts them. Means and probabilities are over the other stackings.
//!
//! # Why it is exact
//! A force below a layer is an integer over 3^d times the common denominator of the loads, with d sign changes above
//! it. The sum of the squares of all forces below a layer depends on the weights only. The reason is that each force
//! acts on one sphere of the next layer, and that the half-turn is orthogonal. So no force exceeds the root of this
//! sum. The bound is computed beforehand, and decides between 64-bit, 128-bit and big integers.
//!
//! # Why it is fast
//! Stackings that begin with the same signs have the same forces in the layers of this beginning. So all stackings of n
//! steps are computed as a tree, which has at most 2ⁿ⁺¹ layers instead of n 2ⁿ. On a base there is a tree for each number
//! of + steps. If the top layer with its loads, or the base, is its own mirror image, one stacking of each mirror pair is
//! computed.
//!
//! # With horizontal contacts
//! At a = R a stacking with contacts in tension can be stable too. All beginnings of a stable stacking are stable, and
//! it stays stable if its last step is repeated. So a proof is needed only for a sign change below a stable beginning.
//! A function of the caller, the judge, decides these cases ([`Ensemble::run_judged`]). `equilibrium` of the crate
//! `cannonpile-horizontal` decides them with a proof.

mod choice;
mod continuations;
mod count;
mod distribution;
mod draw;
mod force_kind;
mod layer;
mod merge;
mod order;
mod piles;
mod record;
mod run;
mod setup;
mod sums;
mod tally;
mod verdicts;
mod walk;
mod wilson;
mod written;

pub use choice::{Choice, Samples, Shard};
pub use distribution::{Distribution, Extreme, Histogram};
pub use force_kind::ForceKind;
pub use merge::Unmergeable;
pub use piles::Ensemble;
pub use record::TallyRecord;
pub use tally::{ContactSet, Tally, WithFaults};
