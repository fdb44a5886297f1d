//! Random piles and their parts from plain bytes (feature `arbitrary`): implementations of [`Arbitrary`].
//!
//! proptest (`cannonpile::testing`) and libFuzzer draw values by them. Missing bytes are read as zeros, which give the
//! simplest values, so too few bytes are not an error.
//!
//! | type | values |
//! |---|---|
//! | `Sign`, `Direction` | any |
//! | `Stacking` | up to six layers |
//! | `Region` | up to five sites a side, close to the origin |
//! | `Site` | coordinates up to 9; it can lie outside a pile |
//! | `Pile` | up to six layers under or on a region, of discs, or isosceles; up to three loads and three weights of at most 300 mg |
//!
//! # Examples
//! ```
//! use cannonpile::Pile;
//! use cannonpile::arbitrary::Unstructured;
//!
//! /// The body of a fuzz target: no pile weighs less than nothing.
//! fn target(bytes: &[u8]) -> Result<(), Box<dyn std::error::Error>> {
//!     let pile: Pile = Unstructured::new(bytes).arbitrary()?;
//!     assert!(pile.weight() >= Default::default());
//!     Ok(())
//! }
//! target(b"any bytes at all")?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use alloc::vec::Vec;

use num_rational::BigRational;

pub use ::arbitrary::{Arbitrary, Unstructured};
use ::arbitrary::{Error, Result};

use crate::Pile;
use crate::lattice::{Direction, Region, Sign, Site};
use crate::stacking::Stacking;

/// Converts an error of the library to one of the generator.
fn valid<T>(made: core::result::Result<T, crate::Error>) -> Result<T> {
    made.map_err(|_| Error::IncorrectFormat)
}

/// Either sign.
impl<'a> Arbitrary<'a> for Sign {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        u.choose(&[Self::Plus, Self::Minus]).copied()
    }
}

/// One of α, β, γ.
impl<'a> Arbitrary<'a> for Direction {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        u.choose(&Self::ALL).copied()
    }
}

/// A stacking of up to six layers.
impl<'a> Arbitrary<'a> for Stacking {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let steps = u.int_in_range(0..=5)?;
        let signs: Vec<Sign> = (0..steps).map(|_| u.arbitrary()).collect::<Result<_>>()?;
        valid(Self::from_signs(signs))
    }
}

/// A region of up to five sites a side.
impl<'a> Arbitrary<'a> for Region {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let [x, y] = [u.int_in_range(-2..=2)?, u.int_in_range(-2..=2)?];
        let [along_x, along_y] = [u.int_in_range(0..=4)?, u.int_in_range(0..=4)?];
        // The bounds on i+j remove corners. Each sum from `low` to `high` belongs to a site, so the region is not empty.
        let low = u.int_in_range(0..=along_x + along_y)?;
        let high = u.int_in_range(low..=along_x + along_y)?;
        let from = x + y;
        valid(Self::new(
            x..=x + along_x,
            y..=y + along_y,
            from + low..=from + high,
        ))
    }
}

/// A site with coordinates up to 9. It can lie outside a pile.
impl<'a> Arbitrary<'a> for Site {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let [i, j] = [u.int_in_range(-9..=9)?, u.int_in_range(-9..=9)?];
        let k = u.int_in_range(0..=9)?;
        Ok(Self { i, j, k })
    }
}

/// A pile of up to six layers, with up to three weights and three loads. All contact forces are below 10⁶ in units of f₀,
/// so even `f32` does not overflow.
impl<'a> Arbitrary<'a> for Pile {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let (region, stacking) = (u.arbitrary::<Region>()?, u.arbitrary::<Stacking>()?);
        let layers = stacking.layers();
        let pile = valid(Self::under(region, stacking.clone()))?;
        let mut pile = valid(match u.int_in_range(0..=7)? {
            6 => Self::discs(layers),
            7 => Self::isosceles(layers, ratio(u.int_in_range(1..=11)?, 12)),
            4 | 5 => Self::on(valid(pile.shape().layer(layers - 1))?, stacking),
            _ => Ok(pile),
        })?;
        let sites: Vec<Site> = pile.shape().sites().collect();
        for with in [Self::with_weight, Self::with_load] {
            for _ in 0..u.int_in_range(0..=3)? {
                let value = ratio(u.int_in_range(0..=300)?, *u.choose(&[1, 2, 3, 7])?);
                pile = valid(with(pile, *u.choose(&sites)?, value))?;
            }
        }
        Ok(pile)
    }
}

fn ratio(n: i32, d: i32) -> BigRational {
    BigRational::new(n.into(), d.into())
}
