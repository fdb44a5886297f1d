//! Fixed and exhaustive tests of the scalars.
//!
//! Without the feature `std` only the roots use another algorithm. So a build without `std` contains only the tests of
//! rounding.

mod double_double;
#[cfg(feature = "std")]
mod fixed_width;
#[cfg(feature = "std")]
mod flaws;
#[cfg(feature = "std")]
mod half;
#[cfg(feature = "std")]
mod interval;
#[cfg(feature = "std")]
mod laws;
#[cfg(feature = "std")]
mod pair;
#[cfg(feature = "std")]
mod plain;
#[cfg(feature = "std")]
mod polynomial;
#[cfg(feature = "std")]
mod sums;
