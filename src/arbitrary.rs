//! Generators of random piles and their parts from plain bytes (feature `arbitrary`).
//!
//! The property tests and the fuzz targets of this workspace use these generators. They read an [`Unstructured`], the
//! byte source of the crate `arbitrary`, so proptest and libFuzzer share one description of the inputs. The values are
//! biased towards difficult cases: single spheres, flat regions, alternating signs, weights of many machine words, and
//! bounds close to [`MAX_LAYERS`](crate::lattice::MAX_LAYERS).
//!
//! | value | function |
//! |---|---|
//! | a small pile, region or stacking; a site, sign or direction | `u.arbitrary()?`, by their implementation of [`Arbitrary`] |
//! | signs of a stacking | [`signs`], [`signs_of`] |
//! | a region | [`small_region`], [`region`] of any size, [`bounds`] that may be invalid |
//! | a position near the boundary of a region, inside or outside | [`position_near`] |
//! | a small pile and the data it is built from | [`description`], [`light_description`], [`tiny_description`] |
//! | a small pile with moderate weights and loads, for tests with floats | [`moderate_pile`] |
//! | a pile of one straight stacking under one sphere, with any sin φ | [`regular_pile`] |
//! | a site of a pile of any size | [`site`] |
//! | a weight or load | [`weight`], [`light_weight`] |
//! | other numbers | [`number`] |
//!
//! Missing bytes are read as zeros, so too few bytes are not an error. The errors are those of the crate `arbitrary`.
//! The strategies for proptest are in `cannonpile::testing` (feature `proptest`).
//!
//! # Examples
//! ```
//! use cannonpile::Pile;
//! use cannonpile::arbitrary::{Unstructured, site};
//!
//! /// The body of a fuzz target: no sphere has a negative weight.
//! fn target(bytes: &[u8]) -> Result<(), Box<dyn std::error::Error>> {
//!     let mut u = Unstructured::new(bytes);
//!     let pile: Pile = u.arbitrary()?;
//!     let site = site(&mut u, &pile)?;
//!     assert!(pile.sphere_weight(site)? >= Default::default());
//!     Ok(())
//! }
//! target(b"any bytes at all")?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[doc(hidden)]
pub mod draw;
pub mod number;
mod pile;
mod region;
mod stacking;

pub use ::arbitrary::{Arbitrary, Unstructured};
pub use pile::{
    Description, description, light_description, light_weight, moderate_pile, regular_pile, site,
    tiny_description, weight,
};
pub use region::{bounds, position_near, region, small_region};
pub use stacking::{signs, signs_of};
