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
//! # Map
//! Each room may use those above it, and [`Error`], which has a word for all of them. [`Pile`] names [`Forces`]
//! to hand it out.
//!
//! | room | what lives there |
//! |---|---|
//! | [`scalar`] | the number traits, one implementation a file, the law suite; the surd c·√n |
//! | [`lattice`], [`stacking`] | sites, six-sided regions, neighbours, symmetries, rows, counts; stackings in four notations |
//! | [`geometry`] | a/R, θ, φ, the symbolic basis, overlap, positions |
//! | [`formula`] | the paper's equations, each once, under its printed number, and the step across a sign change |
//! | [`Pile`], [`Forces`] | a validated pile, of any stacking, on any region, under loads; its forces in pile units, in any scalar |
//! | [`Question`], [`Plan`], [`Counters`] | what is asked; how it is answered and what that takes at most; what it took |
//! | [`Standing`], [`BaseExtremes`] | whether a pile stands; what its base feels at most |
//! | [`Packing`] | the same in SI, exactly |
//! | [`Strengths`] | all contact forces of a straight pile, written into slices |
//! | [`Sweep`], [`ExactSweep`] | those of any pile, layer after layer: plainly in any scalar, and in the exact engine |
//! | [`theorem`], [`census`] | what is proved for every pile, and how; which stackings stand |
//! | [`scene`] | a pile as a user describes it, and the parsers; as a TOML file (feature `toml`) |
//! | `serde` | the data types with `Serialize` and `Deserialize` (feature `serde`) |
//! | `table` | tables as csv, json and text (feature `export`) |
//! | `dem` | piles as files for LAMMPS, ParaView, YADE (feature `export`) |
//! | `verify` | measured forces against the exact ones (feature `export`) |
//! | `figure` | the paper's figures and more, as SVG (feature `plot`) |
//!
//! # Guarantees
//! * Exact scalars and [`scalar::Surd`] are exact: nothing wraps, nothing loses a digit silently, for up to
//!   [`MAX_LAYERS`](lattice::MAX_LAYERS) = 10³⁶ layers.
//! * [`scalar::Surd::nearest`] is the float nearest to the exact value: enclosed in double-doubles where that tells it,
//!   else decided in integers.
//! * What [`theorem`] states is proved for every pile, by running the formulas on polynomials.
//! * `f32` and `f64` as scalars round each operation; an answer takes a handful. What is a difference (shear,
//!   positions) is as exact as its greatest term, and no more where the terms cancel. [`Sweep::error_bound`] bounds
//!   what a way down through changes of sign can cost.
//! * Nothing is computed that a question does not need: [`Pile::plan`] says what it takes at most, and [`Counters`]
//!   count what it took.
//! * Nothing panics on any input, malformed rationals (made by `Ratio::new_raw`) aside. Errors are one enum,
//!   [`Error`], with the value and the remedy. The generic formulas on machine integers of one's own are as safe
//!   as those integers.
//! * No `unsafe`; `no_std` with `alloc` (switch off the default feature `std`).
//!
//! # Notation
//! θ is the angle of a contact with the vertical, φ the azimuth of the paper's eq. (1), s = sin φ, a half the
//! distance of horizontal neighbours, R the radius, q = (a/R)², L the number of layers, k the layer counted
//! from the top. f₀ = mg/(3 cosθ) is the unit of contact force, mg/(2(1+s) cosθ) in general. "THEORY §n" in
//! these pages are the notes on the paper's mathematics that the crate is written after; the statements used
//! are repeated where they are used.

#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;

pub mod census;
#[cfg(feature = "export")]
#[cfg_attr(docsrs, doc(cfg(feature = "export")))]
pub mod dem;
mod engine;
mod error;
#[cfg(feature = "plot")]
#[cfg_attr(docsrs, doc(cfg(feature = "plot")))]
pub mod figure;
mod forces;
pub mod formula;
pub mod geometry;
pub mod lattice;
mod packing;
mod pile;
pub mod scalar;
pub mod scene;
#[cfg(feature = "serde")]
#[cfg_attr(docsrs, doc(cfg(feature = "serde")))]
pub mod serde;
pub mod shape;
pub mod stacking;
mod standing;
#[cfg(feature = "export")]
#[cfg_attr(docsrs, doc(cfg(feature = "export")))]
pub mod table;
pub mod theorem;
#[cfg(feature = "export")]
#[cfg_attr(docsrs, doc(cfg(feature = "export")))]
pub mod verify;

pub use engine::{Counters, Meter, Method, Plan, Quantity, Question};
pub use error::{Culprit, Error};
pub use forces::{
    Base, ContactForce, Contacts, FloorForce, Forces, Layer, Layers, NearestLayer, NearestLayers,
    NumeratorLayer, NumeratorLayers,
};
pub use packing::{PackedContact, Packing};
pub use pile::Pile;
pub use standing::{BaseExtremes, Standing, Verdict};

/// The examples of README.md, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
