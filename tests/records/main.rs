//! Tests of errors, of serialised data, and of the source code as a whole.

#![cfg(feature = "std")]

mod error;
#[cfg(feature = "serde")]
mod serde;
mod sources;
