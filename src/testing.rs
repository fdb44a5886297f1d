//! Proptest strategies for piles and their parts (feature `proptest`).
//!
//! Each strategy draws a byte string and calls a generator of [`cannonpile::arbitrary`](crate::arbitrary) with it.
//! Failing inputs shrink to fewer and smaller bytes, which mostly give smaller piles. The strategies have opaque types
//! and combine as usual, by `prop_map`, `prop_flat_map` or in tuples.
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
use core::fmt;

use arbitrary::{Result, Unstructured};
use proptest::arbitrary::any;
use proptest::collection::vec;
use proptest::strategy::Strategy;

use crate::Pile;
use crate::arbitrary::{moderate_pile, site};
use crate::lattice::{Region, Site};
use crate::stacking::Stacking;

/// The greatest length of the byte string, enough for a small pile. A generator reads missing bytes as zeros.
const BYTES: usize = 256;

/// Generates small piles of any kind, most of them with weights and loads, by the
/// [`Arbitrary`](crate::arbitrary::Arbitrary) implementation of `Pile`.
///
/// # Examples
/// ```
/// use cannonpile::testing::piles;
/// use proptest::prelude::*;
///
/// proptest!(|(pile in piles())| prop_assert!(pile.layers() <= 10));
/// ```
pub fn piles() -> impl Strategy<Value = Pile> + Clone {
    drawn(|u: &mut Unstructured<'_>| u.arbitrary())
}

/// Generates small piles with weights and loads between 0 and 1000 mg and denominators of at most 42, by
/// [`moderate_pile`].
///
/// [`piles`] also draws loads of up to about 10⁴⁰⁰ mg, which overflow `f64`. Use this strategy for properties of floats.
///
/// # Examples
/// In `f64`, the normal forces on the floor sum to the weight up to rounding:
/// ```
/// use cannonpile::scalar::CorrectlyRounded;
/// use cannonpile::shape::Selection;
/// use cannonpile::testing::moderate_piles;
/// use proptest::prelude::*;
///
/// proptest!(|(pile in moderate_piles())| {
///     let mut normal = 0.0;
///     for force in pile.forces::<f64>().base(Selection::Base).unwrap() {
///         normal += force.unwrap().normal;
///     }
///     let weight = f64::nearest_to_rational(&pile.weight()).unwrap();
///     prop_assert!((normal - weight).abs() <= 1e-12 * weight);
/// });
/// ```
pub fn moderate_piles() -> impl Strategy<Value = Pile> + Clone {
    drawn(moderate_pile)
}

/// Generates regions of up to five sites a side, close to the origin.
///
/// # Examples
/// ```
/// use cannonpile::testing::regions;
/// use proptest::prelude::*;
///
/// proptest!(|(region in regions())| {
///     prop_assert_eq!(region.mirrored().mirrored(), region);
/// });
/// ```
pub fn regions() -> impl Strategy<Value = Region> + Clone {
    drawn(|u: &mut Unstructured<'_>| u.arbitrary())
}

/// Generates stackings of up to ten layers.
///
/// # Examples
/// ```
/// use cannonpile::testing::stackings;
/// use proptest::prelude::*;
///
/// proptest!(|(stacking in stackings())| {
///     prop_assert_eq!(stacking.reversed().reversed(), stacking);
/// });
/// ```
pub fn stackings() -> impl Strategy<Value = Stacking> + Clone {
    drawn(|u: &mut Unstructured<'_>| u.arbitrary())
}

/// Generates sites of a pile of any size. Corners, edges and the bottom layer are more frequent than other sites.
///
/// # Examples
/// ```
/// use cannonpile::testing::{piles, sites_of};
/// use proptest::prelude::*;
///
/// let pairs = piles().prop_flat_map(|pile| (sites_of(&pile), Just(pile)));
/// proptest!(|((site, pile) in pairs)| prop_assert!(pile.shape().contains(site)));
/// ```
pub fn sites_of(pile: &Pile) -> impl Strategy<Value = Site> + Clone + use<> {
    let pile = pile.clone();
    drawn(move |u: &mut Unstructured<'_>| site(u, &pile))
}

/// Generates the values that `generator` computes from random bytes.
fn drawn<T, G>(generator: G) -> impl Strategy<Value = T> + Clone
where
    T: fmt::Debug,
    G: Fn(&mut Unstructured<'_>) -> Result<T> + Clone,
{
    let bytes = vec(any::<u8>(), 0..=BYTES);
    bytes.prop_filter_map("bytes that give a value", move |bytes: Vec<u8>| {
        generator(&mut Unstructured::new(&bytes)).ok()
    })
}
