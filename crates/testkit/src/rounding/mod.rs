//! Inputs that test whether every returned float is correctly rounded. The tests and the bench of roundings share them.
//!
//! | file | contents |
//! |---|---|
//! | `random` | random numbers, and values that are critical for rounding |
//! | `numbers` | roots and rationals at these values |
//! | `piles` | piles of every kind, with sizes and weights that move their quantities to these values |
//! | `quantities` | the physical quantities of a pile |
//! | `tally` | the counts of correct and wrong roundings |

pub mod numbers;
pub mod piles;
pub mod quantities;
pub mod random;
pub mod tally;
