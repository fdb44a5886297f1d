//! Random inputs from plain bytes, biased to trouble.
//!
//! Every generator reads an `Unstructured`. The property tests feed it the bytes that proptest makes,
//! the fuzz targets those that libFuzzer makes: one description of the inputs serves both, and a byte
//! string that one of them finds can be given to the other. A generator never fails for want of bytes: an
//! empty input is read as zeros, which is the first of the choices throughout. So the first choice is the ordinary
//! case, and a rare one is drawn by [`rarely`]: `ratio` is true where no bytes are left.
//!
//! Users need some of them too: those are in `cannonpile::arbitrary`, and the modules here re-export them.
//!
//! | file | what it makes |
//! |---|---|
//! | `disorder` | piles of random stackings (feature `disorder`) |
//! | `ensemble` | stackings under a top layer, all or samples (feature `disorder`) |
//! | `number` | integers, rationals, floats, sin φ, radii and masses, roots |
//! | `pile` | layers, piles, sites, directions, spacings, packings |
//! | `region` | regions and their bounds, sites about them, small piles with weights and loads |
//! | `scene` | scenes that can be written down; files of them, valid and damaged (feature `dem`) |
//! | `stacking` | signs, runs, stackings as text |
//! | `text` | numbers and sites as text: valid, with their values, and damaged |

#[cfg(feature = "disorder")]
pub mod disorder;
#[cfg(feature = "disorder")]
pub mod ensemble;
pub mod number;
pub mod pile;
pub mod region;
#[cfg(feature = "dem")]
pub mod scene;
pub mod stacking;
pub mod text;

pub use cannonpile::arbitrary::draw::rarely;
