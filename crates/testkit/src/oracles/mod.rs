//! What the library is compared with: slower, and too simple to be wrong.
//!
//! | file | what it has |
//! |---|---|
//! | `admissible` | all forces that only push, horizontal ones included, and exact linear programs over them |
//! | `balance` | the forces of any stacking on any region: the three equations of one sphere after the other |
//! | `brute` | the forces of a pile grown from its top, in integers, layer by layer |
//! | `elimination` | the forces of a straight pile for any φ: the linear system of one sphere after the other |
//! | `one_by_one` | the forces in all stackings, one by one, at places of the plane |
//! | `overlap` | the distance of every two spheres |
//! | `samples` | the stackings that are drawn at random for a seed (feature `disorder`) |
//! | `sets` | regions and layers as plain sets of sites |

pub mod admissible;
pub mod balance;
pub mod brute;
pub mod elimination;
pub mod one_by_one;
pub mod overlap;
#[cfg(feature = "disorder")]
pub mod samples;
pub mod sets;
