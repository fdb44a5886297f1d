//! Exact numbers c·√r, their correct rounding to `f32` and `f64`, and double-double arithmetic.
//!
//! A [`Surd`] is a rational number times the square root of a positive integer. Products, comparisons and
//! printed forms of surds are exact. [`Surd::nearest`] rounds a surd of any size correctly (to nearest,
//! ties to even).
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
//! | [`Surd`] | numbers c·√r: products, comparison, extraction of square factors |
//! | [`SurdSum`] | exact sums of two surds: products with a surd, sign, comparison with floats, correct rounding |
//! | [`CorrectlyRounded`] | correct rounding of a rational, by a double-double enclosure or by integer arithmetic |
//! | [`DoubleDouble`] | unevaluated sums of two floats, about 106 bits, after Joldes, Muller and Popescu (2017) |
//! | [`error_free`] | error-free transformations: sums and products of floats with their rounding errors |
//! | [`rational`] | sums, products and quotients of rationals whose denominators are mostly powers of three |
//! | [`parse`] | exact rationals and integers from text |
//!
//! # Guarantees
//! * Every operation on a surd is exact. [`Surd::nearest`] is correctly rounded, also among the subnormals.
//! * No operation panics, unless an operand is a `Ratio` with the denominator zero. Only `Ratio::new_raw` can create
//!   one.
//! * The crate contains no `unsafe`. Without the default feature `std` it is `no_std` with `alloc`. The
//!   feature `serde` writes numbers as strings.
//!
//! # Laws
//! These laws hold exactly, for all numbers; those of double-doubles, as long as operands and results are finite.
//! `tests/laws.rs` and `tests/properties.rs` test each on random numbers, among them ties, subnormals and hidden squares.
//!
//! | type | laws |
//! |---|---|
//! | [`Surd`] | a total order, which agrees with signed squares; a positive factor keeps it, a negative one reverses it |
//! | | equal numbers have equal hashes, also if their stored radicands differ |
//! | | products commute and associate, with 1 and 0; (x·y)² = x²·y², √(x²) = \|x\|, x·(1/y)·y = x for y ≠ 0 |
//! | | a printed number of up to 5000 digits is read as the same number, and prints as the same text |
//! | | `to_f64` is monotone and odd; a float converts to itself |
//! | [`SurdSum`] | x + y = y + x, (x + y)·z = x·z + y·z; equal sums have equal terms, up to their stored radicands, and equal hashes |
//! | | the sign of x + y is the order of x and −y; its float has this sign (or is zero, if the sum is tiny) |
//! | [`DoubleDouble`] | the order is that of the exact values |
//! | | x + y = y + x, x·y = y·x, −x − y = −(x + y), (−x)·y = −(x·y), x + (−x) = 0, x + 0 = x, x·1 = x, x/1 = x |
//!
//! Sums and products of double-doubles round, so they do not associate. Not-a-number is not equal to itself.

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
mod sum;
mod surd;
#[cfg(feature = "serde")]
#[doc(hidden)]
pub mod text;

pub use double_double::DoubleDouble;
pub use error::Error;
pub use nearest::CorrectlyRounded;
#[doc(hidden)]
pub use nearest::float_between;
pub use sum::SurdSum;
pub use surd::Surd;

#[cfg(feature = "half")]
#[cfg_attr(docsrs, doc(cfg(feature = "half")))]
pub use half;
pub use {num_bigint, num_rational};

/// The example of README.md, compiled as a doc test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
