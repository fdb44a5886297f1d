//! Regular sphere piles with horizontal contacts: bounds, elastic states, stability, and certificates with their
//! checker.
//!
//! At a = R neighbouring spheres of a layer touch, and the pile is statically indeterminate (hyperstatic). The
//! paper leaves this case open: "horizontal contacts should be considered in order to get more physical behavior
//! like arching. But in this case, the system is hyperstatic and more complicated techniques are to be used." Each
//! horizontal contact above the floor adds one unknown force and no equation
//! ([`paper`](cannonpile::paper#horizontal-contacts)). This crate answers four questions about such a
//! [`Pile`](cannonpile::Pile), exactly and with proofs:
//!
//! | question | call |
//! |---|---|
//! | Is there a set of compressive contact forces that balances the pile? | [`equilibrium(&pile)`](equilibrium) |
//! | Which stackings are stable? | [`census`] |
//! | What are the smallest and the largest normal force of a bottom sphere? | [`bounds(&pile, site)`](bounds()), [`base_bounds(&pile, part)`](base_bounds) |
//! | What are the forces of elastic unilateral contacts? | [`elastic(&pile, &stiffness_ratio)`](elastic()) |
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
//! // The certificate lists the horizontal forces. Its checker uses nothing but the balance of each sphere.
//! let certificate = equilibrium(&pile)?;
//! assert_eq!(certificate.claim, Claim::Stands);
//! assert_eq!(certificate.check(), Ok(()));
//!
//! // The normal force of this bottom sphere lies between these bounds, in mg, for all admissible forces.
//! let range = bounds(&pile, Site { i: 0, j: 0, k: 5 })?;
//! assert!(range.least.normal < range.greatest.normal);
//!
//! // Springs of equal stiffness have a unique state. It is again a pile, and its forces are computed as usual.
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
//! | [`formula`] | closed forms, and the terms of the virtual-work identity, generic over the scalar |
//! | [`Error`] | the errors of this crate |
//!
//! Private modules: `stand` decides stability, `bounds` and `base` compute the bounds, `elastic` and `springs` the
//! elastic state. They share `network` (the balance equations), `program` (the interior-point solver), `exact`
//! (rational elimination) and `exact_simplex`. The modules `straight`, `edge`, `upper`, `run` and `symmetry` cover
//! special piles. `simplex` looks for the forces that attain an upper bound.
//!
//! # Method
//! A simplex method in rationals solves the linear programs of stability and of the bounds. An interior-point method
//! (clarabel) first solves the program in floats. Its result only suggests the basis: the forces that are positive. Exact
//! elimination factors this basis, and exact steps follow until it is optimal ([`exact_pivots`] counts them). For
//! stability the program minimises the sum of tensile forces. If it is not zero, the dual solution is a Farkas
//! certificate. The elastic state is a quadratic program: clarabel suggests which contacts are open, and an active-set
//! method in rationals finds the exact ones.
//!
//! For straight piles of equal spheres a formula gives the upper bound first. A simplex method in floats looks for forces
//! that attain it. If it finds none, the linear program is solved (up to 31 layers).
//!
//! # Guarantees
//! * Every number is exact. A solution that a float solver suggested, or a bound that no theorem covers, is returned only
//!   if [`Certificate::check`](certificate::Certificate::check) accepts it. The other results are exact forces without
//!   horizontal contacts, or formulas that the crate `cannonpile-proof` proves for piles of every size.
//! * A program that is too large is an error, which names its size. For a straight pile the result is an outer bound,
//!   marked as such ([`attained`](NormalBound::attained)).
//! * No function panics on any input. The crate contains no `unsafe`.
//!
//! The feature `rayon` computes the bounds of several bottom spheres in parallel.

mod base;
mod beginning;
mod bounds;
pub mod census;
pub mod certificate;
mod edge;
mod elastic;
mod error;
mod exact;
mod exact_simplex;
pub mod formula;
mod network;
mod program;
mod run;
mod simplex;
mod springs;
mod stand;
mod straight;
mod symmetry;
mod tilt;
mod upper;

use core::num::NonZeroI64;

use cannonpile::each::Each;

pub use base::{BaseBounds, base_bounds};
pub use bounds::{NormalBound, NormalBounds, bounds};
pub use elastic::{ElasticState, elastic};
pub use error::Error;
pub use exact_simplex::exact_pivots;
pub use stand::equilibrium;
pub use tilt::{margin, tilts};

// The compiler evaluates the `unwrap`, and rejects zero.
const TWO: NonZeroI64 = NonZeroI64::new(2).unwrap();

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
