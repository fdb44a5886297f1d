//! Exact contact forces in regular piles of spheres.
//!
//! G. Oron and H. J. Herrmann ("Contact forces in regular 3D granular pile", 1998) solved the stack of
//! cannonballs: identical, stiff, frictionless spheres piled on a triangle. Every contact force is an
//! integer multiple of mg/(3 cosθ), and the pressure on the base is uniform. This crate gives their
//! result as numbers of any precision, for whoever needs a many-contact static case with a known answer, and goes on
//! to any stacking, on any six-sided layer, under loads, and to which of these piles stand.
//!
//! # One pile in four scalars
//! The formulas are written once, over [`scalar::Algebra`]; the scalar decides how exact they are.
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
//! // In units of mg/(3 cosθ): two spheres above on the line, and itself.
//! assert_eq!(pile.forces::<f64>().contact(site, Direction::Alpha)?, 3.0);
//! assert_eq!(pile.forces::<f32>().contact(site, Direction::Alpha)?, 3.0);
//! let exact = pile.forces::<BigRational>().contact(site, Direction::Alpha)?;
//! assert_eq!(exact.to_string(), "3");
//! let fixed = pile.forces::<FixedRational<i64>>().contact(site, Direction::Alpha)?;
//! assert_eq!(fixed.parts(), Some((3, 1)));
//!
//! // What the scalar cannot hold is an error, never a wrong number.
//! let pile = Pile::triangular(10_i128.pow(30))?;
//! let refused = pile.forces::<FixedRational<i64>>().on_floor(Site { k: pile.layers() - 1, ..site });
//! assert!(matches!(refused, Err(Error::Overflow { .. })));
//! # Ok::<(), Error>(())
//! ```
//! Any other pile is asked in the same words:
//! ```
//! use cannonpile::lattice::Region;
//! use cannonpile::stacking::Stacking;
//! use cannonpile::{Pile, Verdict};
//!
//! let pile = Pile::under(Region::hexagon(3, 3)?, Stacking::hcp(4)?)?;
//! let standing = pile.standing()?;
//! assert_eq!(standing.verdict(&[]), Verdict::Yes);
//! assert_eq!(standing.least.unwrap().force.to_string(), "2/9");
//! # Ok::<(), cannonpile::Error>(())
//! ```
//! Forces in newtons and positions in metres carry roots. They are exact too: a [`Packing`] answers in
//! numbers c·√n ([`scalar::Surd`]), which round to the nearest float.
//!
//! # What to call
//!
//! | I want | call |
//! |---|---|
//! | one contact force, in any scalar, in multiples of f₀ | [`pile.forces::<T>()`](Pile::forces)[`.contact(site, direction)`](Forces::contact) |
//! | the force of one sphere on the floor | [`.on_floor(site)`](Forces::on_floor) |
//! | all of them, one by one | [`.contacts(part)`](Forces::contacts), [`.base(part)`](Forces::base); `part` is a [`Selection`](shape::Selection) |
//! | the same on all cores (feature `rayon`) | `parallel::contacts(&forces, part)`, `parallel::base(&forces, part)` |
//! | the sites of a part | [`pile.sites(part)`](Pile::sites), or row by row [`pile.rows(part)`](Pile::rows) |
//! | many, fast, into slices | [`.layers(part)`](Forces::layers), and of these the [nearest floats](Layers::nearest) or [exact integers](Layers::numerators) |
//! | the same in newtons and metres | a [`Packing`], with [`.layers::<f64>(part)`](Packing::layers) for nearest floats in slices |
//! | rows of them, for what is larger than memory | [`fill_row`](NearestLayers::fill_row) and its like; [`packing.places()`](Packing::places) for centres and points of contact |
//! | totals | [`.sum_of_contacts(part)`](Forces::sum_of_contacts), [`.sum_on_floor(part)`](Forces::sum_on_floor) |
//! | the verdict on a pile, and the extremes of its base | [`Pile::standing`], [`Pile::base_extremes`] |
//! | the stable stackings | [`census`] |
//! | what is proved for every pile | [`theorem`] |
//! | an end to a long computation | `Interrupt` |
//! | the cost of a query, before and after | [`Pile::plan`], [`Counters`] |
//! | random piles for my own tests | `testing::piles` (feature `proptest`), `arbitrary` for fuzz targets |
//! | a scalar of my own | [`scalar::Ring`], [`scalar::Algebra`], [`scalar::OwnNumerators`], checked by [`scalar::laws`] |
//!
//! Crates beside this one answer further questions:
//!
//! | I want | crate |
//! |---|---|
//! | horizontal contacts at a = R: bounds, elastic states, verdicts, certificates | `cannonpile-horizontal` |
//! | means and ensembles over random stackings | `cannonpile-disorder` |
//! | scenes, benchmark cases, files for LAMMPS, YADE and ParaView, a comparison with measured forces | `cannonpile-dem` |
//! | figures, and a page for a browser | `cannonpile-figure` |
//! | the theorems for Coq to check | `cannonpile-proof` |
//!
//! # Features
//! | feature | what it adds |
//! |---|---|
//! | `std` (default) | faster big integers; double-doubles decide most roundings of roots |
//! | `rayon` | sweeps and slices on all cores, and `parallel` |
//! | `serde` | `Serialize` and `Deserialize` for the data types, and `data` |
//! | `arbitrary` | `arbitrary`: random piles, regions, stackings and sites from plain bytes, for fuzz targets |
//! | `proptest` | `testing`: the same as strategies of proptest |
//!
//! Rust 1.88 or later. The types of `num-bigint` 0.4 and `num-rational` 0.4 are part of the interface; they are re-exported as
//! [`num_bigint`] and [`num_rational`].
//!
//! No one has to choose a method: the plan does. A pile equal to another is the same pile.
//!
//! # Map
//! A module may use those above it, never one below; a test reads the `use` lines and this table.
//!
//! | layer | module | contents |
//! |---|---|---|
//! | numbers | [`scalar`] | the number traits, the scalars, the law suite; the surd c·√n |
//! | places | [`lattice`] | sites, directions, the Hägg sign, six-sided regions, counts along lines |
//! | | [`stacking`] | runs of signs, in four notations |
//! | | [`shape`] | a stacking on a region: layers, neighbours, rows, the numbers of spheres |
//! | | [`geometry`] | a/R, θ, φ, the symbolic basis, positions, overlap |
//! | physics | [`formula`] | the paper's equations, each once, under its printed number, and the step across a change of sign |
//! | | [`Pile`] | a validated pile, of any stacking, on any region, under loads |
//! | answers | `engine` | the [`Plan`], and the engines it chooses among; no promise to users |
//! | | [`Forces`], [`Packing`] | the one thing to ask, in pile units and in SI |
//! | | [`Standing`], [`census`] | which piles stand |
//! | | [`theorem`] | what is proved for every pile: of [`formula`], and of nothing else |
//! | tools | `data` | the types as serde writes and reads them (feature `serde`) |
//! | | `arbitrary` | random piles and their parts from plain bytes (feature `arbitrary`) |
//! | | `testing` | strategies of proptest for the same (feature `proptest`) |
//! | errors | [`Error`] | what can be wrong with a question |
//!
//! From the paper to the code: [`paper`] lists its equations by their printed numbers, and the mathematics that goes beyond.
//!
//! # Guarantees
//! * Exact scalars and [`scalar::Surd`] are exact: nothing wraps, nothing loses a digit silently, for up to
//!   [`MAX_LAYERS`](lattice::MAX_LAYERS) = 10³⁶ layers.
//! * [`scalar::Surd::nearest`] is the float nearest to the exact value: enclosed in double-doubles where that tells it,
//!   else decided in integers.
//! * What [`theorem`] states is proved for every pile, by running the formulas on polynomials.
//! * `f32` and `f64` as scalars round each operation; an answer takes a handful. What is a difference (shear,
//!   positions) is as exact as its greatest term, and no more where the terms cancel. [`Layer::error_bound`] bounds
//!   what a way down through changes of sign can cost.
//! * Nothing is computed that a question does not need: [`Pile::plan`] says what it takes at most, and [`Counters`]
//!   count what it took.
//! * Nothing panics on any input, malformed rationals (made by `Ratio::new_raw`) aside. Errors are one enum,
//!   [`Error`], with the value and the remedy. The generic formulas on machine integers of one's own are as safe
//!   as those integers.
//! * No `unsafe`; `no_std` with `alloc` (switch off the default feature `std`).
//!
//! # Notation
//! θ is the angle of a contact with the vertical, φ the azimuth in (1) of the paper, s = sin φ, a half the
//! distance of horizontal neighbours, R the radius, q = (a/R)², L the number of layers, k the layer counted
//! from the top. f₀ = mg/(3 cosθ) is the unit of contact force, mg/(2(1+s) cosθ) in general.
//! "Paper, (8)" names a printed equation: [`paper`] lists them all, and the mathematics behind the rest.

#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

#[cfg(feature = "arbitrary")]
#[cfg_attr(docsrs, doc(cfg(feature = "arbitrary")))]
pub mod arbitrary;
pub mod census;
#[cfg(feature = "serde")]
#[cfg_attr(docsrs, doc(cfg(feature = "serde")))]
pub mod data;
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
pub mod stacking;
mod standing;
#[cfg(feature = "proptest")]
#[cfg_attr(docsrs, doc(cfg(feature = "proptest")))]
pub mod testing;
pub mod theorem;

#[cfg(feature = "std")]
#[cfg_attr(docsrs, doc(cfg(feature = "std")))]
pub use engine::Interrupt;
pub use engine::{Counters, Method, Plan, Quantity, Question};
pub use error::Error;
#[cfg(feature = "rayon")]
#[cfg_attr(docsrs, doc(cfg(feature = "rayon")))]
pub use forces::parallel;
pub use forces::{
    ContactForce, Contacts, FloorForce, FloorForces, Forces, Layer, Layers, NearestLayer,
    NearestLayers, NumeratorLayer, NumeratorLayers,
};
pub use packing::{PackedContact, Packing, Places};
pub use pile::Pile;
pub use standing::{BaseExtremes, Standing, Verdict};

pub use {num_bigint, num_rational, num_traits};

/// The examples of README.md, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
