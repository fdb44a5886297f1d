//! Tests of errors, of data that is written and read, and of the source code as a whole.

#![cfg(feature = "std")]

mod error;
mod house;
#[cfg(feature = "serde")]
mod serde;
