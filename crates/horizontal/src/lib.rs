//! Sphere piles with horizontal contacts: bounds, elastic states, verdicts, and certificates with their checker.
//!
//! At a = R the spheres of a layer touch, and the contact forces are no longer unique. The paper leaves this case open:
//! "horizontal contacts should be considered in order to get more physical behavior like arching. But in this case, the
//! system is hyperstatic and more complicated techniques are to be used." Each horizontal contact above the floor adds one
//! unknown force and no equation ([`paper`](cannonpile::paper#horizontal-contacts)). This crate answers four questions
//! about such a [`Pile`](cannonpile::Pile), exactly and with proofs:
//!
//! | question | call |
//! |---|---|
//! | Is there a set of compressive contact forces that balances the pile? | [`equilibrium(&pile)`](equilibrium) |
//! | Which stackings have one? | [`census`] |
//! | What are the smallest and the largest normal force of a bottom sphere? | [`bounds(&pile, site)`](bounds()), [`base_bounds(&pile, part)`](base_bounds) |
//! | Which forces do linear springs carry that can only push? | [`elastic(&pile, &stiffness_ratio)`](elastic()) |
//!
//! # Example
//! Six layers of HCP are unstable without horizontal contacts and stable with them.
//! ```
//! use cannonpile::Pile;
//! use cannonpile::lattice::{Region, Site};
//! use cannonpile_horizontal::certificate::Claim;
//! use cannonpile_horizontal::{bounds, elastic, equilibrium};
//! use num_rational::BigRational;
//!
//! let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
//! assert_eq!(pile.first_failure()?, Some(4));
//!
//! // The certificate lists the horizontal forces that hold the pile. Its checker knows nothing but the balance of a sphere.
//! let certificate = equilibrium(&pile)?;
//! assert_eq!(certificate.claim, Claim::Stands);
//! assert_eq!(certificate.check(), Ok(()));
//!
//! // The normal force of a bottom sphere lies between these two, in mg, whatever the horizontal forces are.
//! let range = bounds(&pile, Site { i: 0, j: 0, k: 5 })?;
//! assert!(range.least.normal < range.greatest.normal);
//!
//! // Springs of equal stiffness choose one state. It is a pile again, and answers every question about forces.
//! let state = elastic(&pile, &BigRational::from_integer(1.into()))?;
//! assert!(state.pile().horizontal_forces().len() > 0);
//! assert_eq!(state.pile().first_failure()?, None);
//! # Ok::<(), cannonpile_horizontal::Error>(())
//! ```
//!
//! # Map
//! | module | contents |
//! |---|---|
//! | [`certificate`] | the claims, the checker, and certificates as JSON files |
//! | [`census`] | every stable stacking, each with its certificate |
//! | [`formula`] | closed forms and what a displacement field proves, generic over the scalar |
//! | [`theorem`] | what is proved for every pile, by running the formulas on polynomials |
//! | [`Error`] | why a request is refused |
//!
//! Inside, `stand` decides stability, `bounds` and `base` the bounds, `elastic` and `springs` the elastic state. They share
//! `network` (the equations of balance), `program` (the interior-point solver), `exact` (elimination in rationals), and,
//! where a pile is special, `straight`, `edge`, `run` and `symmetry`.
//!
//! # Method
//! A linear or quadratic program over the forces is solved in floats by an interior-point method (clarabel). Its result is
//! only a guess: which forces are zero, and which inequalities are equalities. These equations are then solved exactly, by
//! elimination in rationals. If they leave numbers free, the numbers are rounded from the guess to small denominators.
//!
//! # Guarantees
//! * Every number is exact. A solution that floats suggested is returned only if
//!   [`Certificate::check`](certificate::Certificate::check) accepts it. The other answers are exact forces without
//!   horizontal contacts, or formulas that [`theorem`] proves.
//! * If the exact solution cannot be certified, the answer is a certified outer bound that says so
//!   ([`attained`](NormalBound::attained)), or an error.
//! * No function panics on any input, and there is no `unsafe`.
//!
//! The feature `rayon` computes the bounds of several bottom spheres at once.

mod base;
mod beginning;
mod bounds;
pub mod census;
pub mod certificate;
mod edge;
mod elastic;
mod error;
mod exact;
pub mod formula;
mod network;
mod program;
mod run;
mod springs;
mod stand;
mod straight;
mod symmetry;
pub mod theorem;

use core::num::NonZeroI64;

pub use base::{BaseBounds, base_bounds};
pub use bounds::{NormalBound, NormalBounds, bounds};
pub use elastic::{ElasticState, elastic};
pub use error::Error;
pub use stand::equilibrium;

const ONE: NonZeroI64 = NonZeroI64::new(1).unwrap();
const TWO: NonZeroI64 = NonZeroI64::new(2).unwrap();
const THREE: NonZeroI64 = NonZeroI64::new(3).unwrap();

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
