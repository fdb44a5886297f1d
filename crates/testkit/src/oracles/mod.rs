//! Reference computations for the library: slower, and simple enough to check by eye.
//!
//! | file | contents |
//! |---|---|
//! | `admissible` | all compressive states, with horizontal forces, and exact linear programs over them |
//! | `balance` | the forces of any stacking on any region: the three equations of one sphere after the other |
//! | `brute` | the forces of a pile grown from its top, in integers, layer by layer |
//! | `elimination` | the forces of a straight pile for any φ: the linear system of one sphere after the other |
//! | `samples` | the random stackings of a seed (feature `disorder`) |
//! | `sets` | regions and layers as plain sets of sites |

pub mod admissible;
pub mod balance;
pub mod brute;
pub mod elimination;
#[cfg(feature = "disorder")]
pub mod samples;
pub mod sets;
