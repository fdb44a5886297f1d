//! Random piles and their parts, drawn from plain bytes (feature `arbitrary`).
//!
//! The functions here are the generators that the property tests and the fuzz targets of this workspace use. They read
//! an [`Unstructured`], the byte source of the crate `arbitrary`, so one description of the inputs serves proptest and
//! libFuzzer alike. The values are biased towards cases that break code: single spheres, flat regions, alternating
//! signs, weights that fill many machine words, bounds next to [`MAX_LAYERS`](crate::lattice::MAX_LAYERS).
//!
//! | I want | call |
//! |---|---|
//! | a small pile, region or stacking; a site, sign or direction | `u.arbitrary()?`, by their [`Arbitrary`] |
//! | signs of a stacking | [`signs`], [`signs_of`] |
//! | a region | [`small_region`], [`region`] of any size, [`bounds`] that may be invalid |
//! | a position at the edge of a region, inside or outside | [`position_near`] |
//! | a small pile and the data it is built from | [`description`], [`light_description`], [`tiny_description`] |
//! | a small pile with moderate weights and loads, for tests with floats | [`moderate_pile`] |
//! | a pile of one straight stacking under one sphere, with any sin φ | [`regular_pile`] |
//! | a site of a pile of any size | [`site`] |
//! | a weight or load | [`weight`], [`light_weight`] |
//! | other numbers | [`number`] |
//!
//! A generator never fails for want of bytes: missing bytes are read as zeros. Its error is that of the crate
//! `arbitrary`, and `?` passes it on. The strategies for proptest are in `cannonpile::testing` (feature `proptest`).
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
