//! A proptest strategy for piles (feature `proptest`).
//!
//! It draws a byte string and reads a value from it by [`Arbitrary`](crate::arbitrary::Arbitrary). Failing inputs shrink
//! to fewer and smaller bytes, which mostly give smaller piles. The strategy combines as usual, by `prop_map` and in tuples.
//!
//! # Examples
//! ```
//! use cannonpile::shape::Selection;
//! use cannonpile::testing::piles;
//! use proptest::prelude::*;
//!
//! proptest! {
//!     # #![proptest_config(ProptestConfig { failure_persistence: None, cases: 16, ..Default::default() })]
//!     // In a test module, with `#[test]` above the function.
//!     fn every_layer_has_a_site(pile in piles()) {
//!         for k in 0..pile.layers() {
//!             prop_assert!(pile.sites(Selection::Layer(k)).unwrap().next().is_some());
//!         }
//!     }
//! }
//! every_layer_has_a_site();
//! ```

use alloc::vec::Vec;

use arbitrary::Unstructured;
use proptest::arbitrary::any;
use proptest::collection::vec;
use proptest::strategy::Strategy;

use crate::Pile;

/// The greatest length of the byte string, enough for a small pile.
const BYTES: usize = 256;

/// Generates small piles, most of them with weights and loads, by the
/// [`Arbitrary`](crate::arbitrary::Arbitrary) implementation of `Pile`.
///
/// # Examples
/// In `f64`, the normal forces on the floor sum to the weight up to rounding. A weight or a load enters as a change of the
/// ordinary pile, so the error is relative to both:
/// ```
/// use cannonpile::scalar::CorrectlyRounded;
/// use cannonpile::shape::Selection;
/// use cannonpile::testing::piles;
/// use num_traits::ToPrimitive;
/// use proptest::prelude::*;
///
/// proptest!(|(pile in piles())| {
///     let mut normal = 0.0;
///     for force in pile.forces::<f64>().base(Selection::Base).unwrap() {
///         normal += force.unwrap().normal;
///     }
///     let weight = f64::nearest_to_rational(&pile.weight()).unwrap();
///     let ordinary = pile.sphere_count().to_f64().unwrap();
///     prop_assert!((normal - weight).abs() <= 1e-12 * (weight + ordinary));
/// });
/// ```
pub fn piles() -> impl Strategy<Value = Pile> + Clone {
    let bytes = vec(any::<u8>(), 0..=BYTES);
    bytes.prop_filter_map("bytes that give a pile", |bytes: Vec<u8>| {
        Unstructured::new(&bytes).arbitrary().ok()
    })
}
