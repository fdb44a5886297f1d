//! Serialisation of the data types with [serde](https://serde.rs), without loss of digits.
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
//! # Format
//! | form | types |
//! |---|---|
//! | a string, as `Display` prints it | rationals and surds (`"7/3"`, `"12"`, `"7/3*sqrt(2)"`), spacings, stackings and patterns, regions (`"hexagon:3,2"`), signs (`"+"`), and names: directions, verdicts, methods, quantities |
//! | a number; beyond ±(2⁵³ − 1) a string | integers and counts: `3`, `"1000000000000000000000"`; many JSON parsers round greater numbers |
//! | a number | dimensions (2 or 3), `f32` and `f64` in answers |
//! | a record of its fields | sites, rows, runs, vectors, enclosures; forces and verdicts; plans, questions and counters |
//! | a record of two strings | [`Interval`](crate::scalar::Interval) (`lower`, `upper`) and [`DoubleDouble`](crate::scalar::DoubleDouble) (`high`, `low`), since many JSON parsers change the last digit of a float |
//! | a name and its content | [`Selection`](crate::shape::Selection), [`Anchor`](crate::shape::Anchor): `"base"`, `{"layer":3}` |
//! | a record of its parts | [`Pile`](crate::Pile): `dimension`, `sin_phi`, `stacking` (from the top), `anchor`, `weightless`, `weights`, `loads` |
//!
//! A binary format is one that serde does not consider human-readable. In such a format integers are strings, and
//! counts are numbers of 64 bits.
//!
//! # Accepted input
//! An integer is read from a string, or from a number that the format represents exactly. In JSON this is a number of
//! 64 bits.
//!
//! The parsers of the types read strings, and checked constructors check everything else. Errors are, for example, an
//! empty region, a pile that overhangs its base, 1/0, an unknown key, and two weights for one sphere. Formats that are
//! not self-describing (postcard, bincode) are supported as well as JSON.
//!
//! A value that is written can be read back, with two exceptions. The first are exact numbers with more than
//! [`MAX_DIGITS`](crate::scalar::parse::MAX_DIGITS) digits, which occur in sums of loads or in forces below thousands
//! of sign changes. The second is an `f32` or `f64` in JSON that is not finite, since JSON cannot represent it. Reading
//! either of them gives an error.
//!
//! Types that borrow a pile ([`Forces`](crate::Forces), [`Packing`](crate::Packing), sweeps), theorems with their
//! polynomials, and errors cannot be serialised.
//!
//! Use [`number`] for your own fields: `#[serde(with = "cannonpile::data::number")]`.

mod integers;
#[doc(hidden)]
pub mod listed;
mod numbers;
mod pile;

#[doc(hidden)]
pub use exact_surd::text::read_text;
#[doc(hidden)]
pub use numbers::as_text;
pub use numbers::{Number, number};
