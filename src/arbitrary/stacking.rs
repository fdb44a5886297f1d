//! Generators of Hägg signs and stackings: straight, periodic, with one sign change, or random.

use alloc::vec;
use alloc::vec::Vec;

use arbitrary::{Arbitrary, Result, Unstructured};

use super::draw::valid;
use crate::lattice::{Direction, Sign};
use crate::stacking::Stacking;

/// Draws up to `most` Hägg signs.
///
/// # Errors
/// The errors of [`Unstructured`].
///
/// # Examples
/// ```
/// use cannonpile::arbitrary::{Unstructured, signs};
///
/// let signs = signs(&mut Unstructured::new(b"some bytes"), 5)?;
/// assert!(signs.len() <= 5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn signs(u: &mut Unstructured<'_>, most: usize) -> Result<Vec<Sign>> {
    let steps = u.int_in_range(0..=most)?;
    signs_of(u, steps)
}

/// Draws exactly `steps` Hägg signs: all equal, of period 2 or 4, with at most one sign change, or independent.
///
/// # Errors
/// The errors of [`Unstructured`].
///
/// # Examples
/// ```
/// use cannonpile::arbitrary::{Unstructured, signs_of};
///
/// assert_eq!(signs_of(&mut Unstructured::new(b"some bytes"), 5)?.len(), 5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn signs_of(u: &mut Unstructured<'_>, steps: usize) -> Result<Vec<Sign>> {
    let first: Sign = u.arbitrary()?;
    let signed = |plus: bool| if plus { first } else { -first };
    Ok(match u.int_in_range(0..=4)? {
        0 => vec![first; steps],
        1 => (0..steps).map(|n| signed(n % 2 == 0)).collect(),
        2 => (0..steps).map(|n| signed(n / 2 % 2 == 0)).collect(),
        3 => {
            let change = u.int_in_range(0..=steps)?;
            (0..steps).map(|n| signed(n < change)).collect()
        }
        _ => (0..steps).map(|_| u.arbitrary()).collect::<Result<_>>()?,
    })
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

/// A stacking of up to ten layers.
impl<'a> Arbitrary<'a> for Stacking {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        valid(Self::from_signs(signs(u, 9)?))
    }
}
