//! The data types with `Serialize` and `Deserialize` of [serde](https://serde.rs), without a digit lost.
//!
//! ```
//! use cannonpile::lattice::Region;
//! use cannonpile::shape::Selection;
//! use cannonpile::{ContactForce, Pile};
//! use num_rational::BigRational;
//!
//! let pile = Pile::under(Region::hexagon(2, 2)?, "+-".parse()?)?;
//! let text = serde_json::to_string(&pile)?;
//! assert_eq!(serde_json::from_str::<Pile>(&text)?, pile);
//!
//! let forces: Result<Vec<ContactForce<BigRational>>, _> =
//!     pile.forces().contacts(Selection::Layer(1))?.collect();
//! let text = serde_json::to_string(&forces?[0])?;
//! assert_eq!(text, r#"{"site":{"i":0,"j":-1,"k":1},"direction":"alpha","force":"2/3"}"#);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # How it is written
//! | written as | types |
//! |---|---|
//! | a string, as it prints | rationals and surds (`"7/3"`, `"12"`, `"7/3*sqrt(2)"`), spacings, stackings and patterns, regions (`"hexagon:3,2"`), signs (`"+"`), and names: directions, verdicts, methods, quantities |
//! | a number, beyond ±(2⁵³ − 1) a string | integers and counts: `3`, `"1000000000000000000000"`; many readers of JSON keep no greater number exactly |
//! | a number | dimensions (2 or 3), `f32` and `f64` in answers |
//! | a record of its fields | sites, rows, runs, vectors, enclosures; forces and verdicts; plans, questions and counters |
//! | a record of two strings | [`Interval`](crate::scalar::Interval) (`lower`, `upper`) and [`DoubleDouble`](crate::scalar::DoubleDouble) (`high`, `low`), since many readers of JSON change the last digit of a float |
//! | a name and what belongs to it | [`Selection`](crate::shape::Selection), [`Anchor`](crate::shape::Anchor): `"base"`, `{"layer":3}` |
//! | what it is made of | [`Pile`](crate::Pile): `dimension`, `sin_phi`, `stacking` (from the top), `anchor`, `weightless`, `weights`, `loads` |
//!
//! In a binary format, which is not human-readable to serde, integers are strings and counts are numbers of 64 bits.
//!
//! # What is read
//! An integer is read as a string, or as a number if the format has it exactly: in JSON one of 64 bits.
//!
//! Texts are read by the parsers of the types and everything else by checked constructors: a region without a site, a pile
//! that overhangs its base and 1/0 are refused. So are keys that are not known, and two weights of one sphere. Formats that do not describe themselves (postcard, bincode) serve as well as JSON.
//!
//! What is written is read back, with two exceptions: exact numbers of more than
//! [`MAX_DIGITS`](crate::scalar::parse::MAX_DIGITS), which a sum of loads or the forces after thousands of changes of sign
//! can have, and in JSON an `f32` or `f64` that is not finite, for which it has no word. Both are errors when they are read.
//!
//! Not data, and not here: what borrows a pile ([`Forces`](crate::Forces), [`Packing`](crate::Packing), sweeps),
//! theorems and their polynomials, errors.
//!
//! [`number`] serves fields of your own: `#[serde(with = "cannonpile::data::number")]`.

mod integers;
#[doc(hidden)]
pub mod listed;
mod numbers;
mod pile;
mod records;
mod words;

#[doc(hidden)]
pub use exact_surd::text::read_text;
#[doc(hidden)]
pub use numbers::as_text;
pub use numbers::{Number, number};
