//! Is every float that the library returns the nearest one? The cases, for the tests and for the bench of roundings.
//!
//! | file | what it has |
//! |---|---|
//! | `random` | random numbers, and places that are critical for rounding |
//! | `numbers` | roots and rationals at these places |
//! | `piles` | piles of every kind, with sizes and weights that put their quantities there |
//! | `quantities` | the physical quantities of a pile |
//! | `tally` | what is counted |

pub mod numbers;
pub mod piles;
pub mod quantities;
pub mod random;
pub mod tally;
