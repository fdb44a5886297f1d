//! Exact contact forces in regular piles of spheres.
//!
//! G. Oron and H. J. Herrmann ("Contact forces in regular 3D granular pile", 1998) solved the stack of cannonballs:
//! identical, stiff, frictionless spheres piled on a triangle. Every contact force is an integer multiple of mg/(3
//! cosθ), and the pressure on the base is uniform. This crate computes these forces in number types of any precision.
//! The forces serve as a static test case with many contacts and a known answer. The crate also covers any stacking,
//! layers with up to six sides, loads on any sphere, and the stability of all these piles.
//!
//! # One pile in four scalars
//! The formulas are generic over [`scalar::Algebra`]. The scalar type decides how exact the results are.
//! ```
//! use cannonpile::lattice::{Direction, Site};
//! use cannonpile::scalar::FixedRational;
//! use cannonpile::{Error, Pile};
//! use num_rational::BigRational;
//!
//! let pile = Pile::triangular(10)?;
//! // Sphere (i, j) = (1, 2) of layer k = 5, and its contact with the sphere below it along α.
//! let site = Site { i: 1, j: 2, k: 5 };
//!
//! // The force is 3 mg/(3 cosθ): one unit from the sphere itself, and one from each of two spheres above it on the
//! // line.
//! assert_eq!(pile.forces::<f64>().contact(site, Direction::Alpha)?, 3.0);
//! assert_eq!(pile.forces::<f32>().contact(site, Direction::Alpha)?, 3.0);
//! let exact = pile.forces::<BigRational>().contact(site, Direction::Alpha)?;
//! assert_eq!(exact.to_string(), "3");
//! let fixed = pile.forces::<FixedRational<i64>>().contact(site, Direction::Alpha)?;
//! assert_eq!(fixed.parts(), Some((3, 1)));
//!
//! // A value that does not fit in the scalar is an error, never a wrong number.
//! let pile = Pile::triangular(10_i128.pow(30))?;
//! let refused = pile.forces::<FixedRational<i64>>().on_floor(Site { k: pile.layers() - 1, ..site });
//! assert!(matches!(refused, Err(Error::Overflow { .. })));
//! # Ok::<(), Error>(())
//! ```
//! Other piles have the same methods:
//! ```
//! use cannonpile::lattice::Region;
//! use cannonpile::stacking::Stacking;
//! use cannonpile::{Pile, Verdict};
//!
//! let pile = Pile::under(Region::hexagon(3, 3)?, Stacking::hcp(4)?)?;
//! assert_eq!(pile.stands()?, Verdict::Yes);
//! assert_eq!(pile.standing()?.least.unwrap().force.to_string(), "2/9");
//! # Ok::<(), cannonpile::Error>(())
//! ```
//! Forces in newtons and positions in metres are exact too: a [`Packing`] returns numbers c·√n ([`scalar::Surd`]).
//!
//! # What to call
//! | I want | call |
//! |---|---|
//! | one contact force, in any scalar, in multiples of f₀ | [`pile.forces::<T>()`](Pile::forces)[`.contact(site, direction)`](Forces::contact) |
//! | the force of one bottom sphere on the floor; the stress of one sphere | [`.on_floor(site)`](Forces::on_floor), [`.stress(site)`](Forces::stress) |
//! | all forces of a part, one by one | [`.contacts(part)`](Forces::contacts), [`.base(part)`](Forces::base); `part` is a [`Selection`](shape::Selection) |
//! | the sites of a part | [`pile.sites(part)`](Pile::sites); by rows: [`pile.rows(part)`](Pile::rows) |
//! | many forces, fast, in slices | [`.layers(part)`](Forces::layers), also as [correctly rounded floats](Layers::nearest) or [exact integers](Layers::numerators) |
//! | the same in newtons and metres | a [`Packing`], with [`.layers::<f64>(part)`](Packing::layers) for correctly rounded floats in slices |
//! | forces row by row, for piles larger than memory | [`fill_row`](Layers::fill_row) and similar methods; [`packing.places()`](Packing::places) for centres and contact points |
//! | sums of forces | [`.sum_of_contacts(part)`](Forces::sum_of_contacts), [`.sum_on_floor(part)`](Forces::sum_on_floor) |
//! | the stability of a pile; the extreme forces on its base | [`Pile::stands`], [`Pile::standing`]; [`Pile::base_extremes`] |
//! | the paper's theorems | [`theorem`] |
//! | a force as a function of a load or tilt | [`Forces::with_load`], [`Forces::with_tilt`] |
//! | to cancel a long computation | `Interrupt` |
//! | the work of a query, estimated and counted | [`Pile::plan`], [`Counters`] |
//! | random piles for my own tests | `testing::piles` (feature `proptest`), `arbitrary` for fuzz targets |
//! | a scalar of my own | [`ring!`], [`scalar::Ring`], [`scalar::Algebra`], checked by [`scalar::laws`] |
//!
//! Further crates of the same project build on this one:
//!
//! | I want | crate |
//! |---|---|
//! | the tilts of gravity that a pile bears, unequal spheres, the stable stackings, two layers with friction | `cannonpile-stability` |
//! | horizontal contacts at a = R: bounds, elastic states, verdicts, certificates | `cannonpile-horizontal` |
//! | means and ensembles over random stackings | `cannonpile-disorder` |
//! | singular values and condition numbers, a verdict on number types | `cannonpile-accuracy` |
//! | scenes, benchmark cases, files for LAMMPS, YADE and ParaView, a comparison with measured forces | `cannonpile-dem` |
//! | figures, and an HTML viewer | `cannonpile-figure` |
//! | all theorems with their proofs, also in Coq | `cannonpile-proof` |
//!
//! # Features
//! | feature | adds |
//! |---|---|
//! | `std` (default) | faster big integers; faster rounding of roots by double-doubles |
//! | `rayon` | sweeps and slices on all cores |
//! | `serde` | `Serialize` and `Deserialize` for the data types; the module `data` |
//! | `arbitrary` | random piles, regions, stackings and sites from plain bytes, for fuzz targets |
//! | `proptest` | `testing::piles`: random piles for proptest |
//!
//! The crate needs Rust 1.88 or later. The types of `num-bigint` 0.4 and `num-rational` 0.4 are part of its public API,
//! which re-exports the crates as [`num_bigint`] and [`num_rational`].
//!
//! # Map
//! The table lists the modules roughly in the order in which they build on each other. No files use each other in a
//! circle, which CI checks. `Error` is excepted: its variants name types of all modules.
//!
//! | layer | module | contents |
//! |---|---|---|
//! | arrays | `each`, `sorted` | arrays of two and three; a map in one sorted vector |
//! | numbers | [`scalar`] | the number traits, the scalars, the law suite; surds c·√n |
//! | positions | [`lattice`] | sites, directions, the Hägg sign, six-sided regions, counts along lines |
//! | | [`stacking`] | sequences of Hägg signs as runs, in four notations |
//! | | [`shape`] | a stacking on a region: layers, neighbours, rows, the numbers of spheres |
//! | | [`geometry`] | a/R, θ, φ, the symbolic basis, positions, overlap |
//! | physics | [`formula`] | the paper's equations with their printed numbers, and the transfer across a sign change |
//! | | [`Pile`] | a validated pile: any stacking, any region, loads |
//! | queries | `engine` | the [`Plan`], and the methods to compute forces; not part of the public API |
//! | | [`Forces`], [`Packing`] | the forces, in pile units and in SI units |
//! | | [`Verdict`] | whether a pile stands; the extreme forces on its base |
//! | | [`theorem`] | the paper's theorems about [`formula`], for every pile |
//! | tools | `data` | the serialised form of the types (feature `serde`) |
//! | | `arbitrary` | random piles and their parts from plain bytes (feature `arbitrary`) |
//! | | `testing` | random piles for proptest (feature `proptest`) |
//! | errors | [`Error`] | the reasons why a query fails |
//!
//! # Guarantees
//! * Exact scalars and [`scalar::Surd`] are exact: no operation wraps or loses a digit silently, for up to
//!   [`MAX_LAYERS`](lattice::MAX_LAYERS) = 10³⁶ layers.
//! * [`scalar::Surd::nearest`] returns the correctly rounded float. It encloses the exact value in double-doubles, and
//!   decides close cases in integers.
//! * The theorems in [`theorem`] are proved for every pile, by evaluating the formulas on polynomials.
//! * `f32` and `f64` as scalars round each operation. A closed form takes only a few operations. A difference (a shear,
//!   a position) is as accurate as its greatest term, and loses relative accuracy where the terms cancel.
//!   [`Layer::error_bound`] bounds the error of a sweep through sign changes.
//! * Each query computes only what it needs. [`Pile::plan`] returns upper bounds on its work, and [`Counters`] count
//!   the work done.
//! * No input causes a panic, except a malformed rational made by `Ratio::new_raw`. All errors are variants of one
//!   enum, [`Error`], and name the value given and the remedy. Generic formulas that you call with machine integers
//!   overflow like these integers.
//! * The crate contains no `unsafe` code. It is `no_std` with `alloc` if you disable the default feature `std`.
//!
//! # Notation
//! θ is the angle of a contact with the vertical, φ the azimuth in (1) of the paper, and s = sin φ. R is the radius of
//! a sphere, a is half the distance between horizontal neighbours, and q = (a/R)². L is the number of layers, and k the
//! layer, counted from 0 at the top. f₀ = mg/(3 cosθ) is the unit of contact force. On an isosceles base f₀ =
//! mg/(2(1+s) cosθ). "Paper, (8)" cites a printed equation.

#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

#[cfg(feature = "arbitrary")]
#[cfg_attr(docsrs, doc(cfg(feature = "arbitrary")))]
pub mod arbitrary;
#[cfg(feature = "serde")]
#[cfg_attr(docsrs, doc(cfg(feature = "serde")))]
pub mod data;
#[doc(hidden)]
pub mod each;
#[doc(hidden)]
pub mod engine;
mod error;
mod forces;
pub mod formula;
pub mod geometry;
pub mod lattice;
mod packing;
#[doc = include_str!("paper.md")]
pub mod paper {}
mod pile;
pub mod scalar;
pub mod shape;
mod sorted;
pub mod stacking;
#[cfg(feature = "proptest")]
#[cfg_attr(docsrs, doc(cfg(feature = "proptest")))]
pub mod testing;
pub mod theorem;
mod verdict;

#[cfg(feature = "std")]
#[cfg_attr(docsrs, doc(cfg(feature = "std")))]
pub use engine::Interrupt;
pub use engine::{Counters, Method, Plan, Quantity, Question};
pub use error::Error;
pub use forces::{
    Answers, ContactForce, Contacts, FloorForce, FloorForces, Forces, Integers, Layer, Layers,
    Nearest, Output,
};
pub use geometry::Load;
pub use packing::{PackedContact, Packing, Places, SiBasis};
pub use pile::Pile;
pub use verdict::{BaseExtremes, Standing, Verdict};

pub use {num_bigint, num_rational, num_traits};

/// The examples of README.md, compiled as doc tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
