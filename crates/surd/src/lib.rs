//! Exact numbers c·√r, the float nearest to each, and double-double arithmetic.
//!
//! A [`Surd`] is a rational times the root of a positive integer. Surds multiply, compare and print exactly, and
//! [`Surd::nearest`] rounds one correctly (to nearest, ties to even) to an `f32` or `f64`, whatever its size.
//! ```
//! use exact_surd::Surd;
//!
//! let diagonal: Surd = "1/3*sqrt(8)".parse()?;
//! assert_eq!(diagonal.to_string(), "2/3*sqrt(2)");
//! assert_eq!(diagonal.square().to_string(), "8/9");
//! assert_eq!(diagonal.to_f64(), 0.9428090415820634);
//! # Ok::<(), exact_surd::Error>(())
//! ```
//!
//! # Map
//! | module or type | contents |
//! |---|---|
//! | [`Surd`] | c·√r: products, order, roots taken out |
//! | [`NearestFloat`] | correct rounding of a rational, decided by a double-double enclosure or else in integers |
//! | [`DoubleDouble`] | the sum of two floats, with about 106 bits, after Joldes, Muller and Popescu (2017) |
//! | [`error_free`] | sums and products of floats with their rounding errors, which are floats too |
//! | [`rational`] | sums, products and quotients of rationals over denominators that are mostly powers of three |
//! | [`parse`] | rationals and integers from text, exactly |
//!
//! # Guarantees
//! * Every operation on a surd is exact; [`Surd::nearest`] is correctly rounded, subnormals included.
//! * No operation panics, except with a `Ratio` whose denominator is zero (made by `Ratio::new_raw`).
//! * No `unsafe`; `no_std` with `alloc` without the default feature `std`. The feature `serde` writes numbers as strings.

#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

mod double_double;
mod error;
pub mod error_free;
#[doc(hidden)]
pub mod layout;
mod nearest;
pub mod parse;
pub mod rational;
mod screen;
#[doc(hidden)]
pub mod short;
mod surd;
#[cfg(feature = "serde")]
#[doc(hidden)]
pub mod text;

pub use double_double::DoubleDouble;
pub use error::Error;
pub use nearest::NearestFloat;
#[doc(hidden)]
pub use nearest::float_between;
pub use surd::Surd;

pub use {num_bigint, num_rational};
