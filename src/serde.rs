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
//! assert_eq!(text, r#"{"site":{"i":"0","j":"-1","k":"1"},"direction":"alpha","force":"2/3"}"#);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Serde
//! | written as | |
//! |---|---|
//! | a string, as it prints | rationals, big integers and `i128` (`"7/3"`, `"12"`), [`Surd`] and [`Spacing`](crate::geometry::Spacing) (`"7/3*sqrt(2)"`), [`FixedRational`], [`Stacking`](crate::stacking::Stacking), [`Pattern`](crate::stacking::Pattern), [`Region`](crate::lattice::Region) (`"hexagon:3,2"`), and names: [`Sign`](crate::lattice::Sign) (`"+"`), [`Direction`](crate::lattice::Direction), [`Verdict`](crate::Verdict), [`Method`](crate::Method), [`Quantity`](crate::Quantity) |
//! | a number | [`Dimension`](crate::lattice::Dimension) (2 or 3), counts below 2⁶⁴, `f32` and `f64` in answers |
//! | a record of its fields | [`Site`](crate::lattice::Site), [`Run`](crate::stacking::Run), [`Row`](crate::lattice::Row), [`Apart`](crate::geometry::Apart), [`Vector`](crate::geometry::Vector), [`Enclosure`](crate::scalar::Enclosure), [`ContactForce`](crate::ContactForce), [`FloorForce`](crate::FloorForce), [`PackedContact`](crate::PackedContact), [`BaseExtremes`](crate::BaseExtremes), [`Standing`](crate::Standing), [`Plan`](crate::Plan), [`Question`](crate::Question), [`Counters`](crate::Counters), [`Entry`](crate::census::Entry), [`At`](crate::scene::parse::At), [`Scene`](crate::scene::Scene) |
//! | a record of strings | [`Interval`] (`lower`, `upper`) and [`DoubleDouble`] (`high`, `low`): many readers of JSON take the last digit of a float less seriously than a bound can bear |
//! | a name and what belongs to it | [`Selection`](crate::shape::Selection), [`Anchor`](crate::scene::Anchor): `"base"`, `{"layer":"3"}` |
//! | what it is made of | [`Pile`](crate::Pile): `dimension`, `sin_phi`, `stacking` (from the top), `anchor`, `weightless`, `weights`, `loads` |
//!
//! What is read goes through the parsers of [`scene::parse`](crate::scene::parse) and the checked constructors: there is
//! no way to a region without a site, a pile that overhangs its base, or 1/0. Keys that are not known are refused. Of a
//! [`Scene`](crate::scene::Scene) any key may be left out. Formats that are not self-describing (postcard, bincode) do as well
//! as JSON.
//!
//! What is written is read back, with two exceptions: exact numbers longer than those parsers read (5,000 digits, which a sum
//! of loads or the forces after thousands of changes of sign can have), and in JSON an `f32` or `f64` that is not finite,
//! for which it has no word. Both are errors, on the way in.
//!
//! Not data, and not here: what borrows a pile ([`Forces`](crate::Forces), [`Packing`](crate::Packing), sweeps),
//! theorems and their polynomials, errors.
//!
//! [`number`] serves fields of your own: `#[serde(with = "cannonpile::serde::number")]`.

mod parts;
mod records;
mod words;

pub use crate::scalar::serde::{Number, number};
