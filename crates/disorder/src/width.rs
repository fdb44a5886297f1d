//! The width of the integers in the recursion.
//!
//! A step of a stacking is orthogonal: it moves each force to another place, and a
//! [half-turn](cannonpile::formula::half_turn) preserves the sum of squares. So the forces below one layer of one
//! stacking have a norm of at most B = Σ_j ‖w_j‖, with w_j the forces that loads and weights add to layer j. The norm
//! is √(3 n_j) for n_j spheres, and √3·W for a load of W mg on one sphere.
//!
//! By faults the numerators over 3^d are sums over at most C(k,d) beginnings, so they are at most 3^d C(k,d) B. By
//! probability the numerators over N^k are means, so they are at most N^k B. In 3G g no intermediate result exceeds 2√3
//! ‖g‖. A force on the floor is at most twice the sum of three forces, for each of two signs, plus six times the weight
//! of the sphere. All of this is less than 16 times the bounds above.

use num_bigint::{BigInt, BigUint};
use num_integer::binomial;
use num_traits::{One, Signed};

use super::domain::Domain;
use crate::{Each, Error};

/// The width of the integers in the recursion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Width {
    /// `i64`.
    Narrow,
    /// `i128`.
    Wide,
    /// Big integers.
    Big,
}

/// Returns the number of words of a list entry that is a big integer of so many bits, with the list of its digits. A list may
/// have twice the length that it needs.
pub(super) const fn words_of_big(bits: u64) -> u64 {
    10 + 2 * (bits / 64)
}

impl Width {
    /// Returns the width for magnitudes of this many bits.
    pub(super) const fn of(bits: u64) -> Self {
        match bits {
            0..=62 => Self::Narrow,
            63..=126 => Self::Wide,
            _ => Self::Big,
        }
    }

    /// Returns the number of 64-bit words of an integer.
    pub(super) const fn words(self, bits: u64) -> u64 {
        match self {
            Self::Narrow => 1,
            Self::Wide => 2,
            // A big integer also stores the address and the size of its list of digits, and its sign.
            Self::Big => 6 + bits / 64,
        }
    }
}

/// Returns the bit length of the greatest 3^d C(n−1, d), or an upper bound of it for n > 1001.
pub(super) fn bits_of_counts(steps: i128) -> u64 {
    let Ok(of) = u32::try_from((steps - 1).max(0)) else {
        return u64::MAX / 4;
    };
    if of > 1000 {
        // The numbers 3^d C(n−1, d) sum to 4^(n−1). So each is below it, and has at most 2(n−1) bits.
        return 2 * u64::from(of);
    }
    // The terms grow as long as 3(n−1−d) > d+1. So the greatest is at d = ⌊3n/4⌋, which is one of the two values below.
    let greatest =
        |d: u32| binomial(BigUint::from(of), BigUint::from(d)) * BigUint::from(3_u32).pow(d);
    let around = (3 * of) / 4;
    let bits = [around, (around + 1).min(of)].each(|d| greatest(d).bits());
    bits[0].max(bits[1])
}

/// Returns the bit length of 16 B times the denominator.
///
/// # Errors
/// [`Bug`](cannonpile::Error::Bug).
pub(super) fn bits_of_sources(domain: &Domain<'_>, denominator: &BigInt) -> Result<u64, Error> {
    let mut sum = BigUint::one();
    if !domain.piles.is_weightless() {
        for layer in 0..=domain.steps {
            // No layer has more spheres than cells. ⌊√x⌋ + 1 exceeds √x.
            sum += BigUint::from(3 * domain.grid.reached(layer)?).sqrt() + 1_u32;
        }
    }
    for (_, load) in domain.piles.loads() {
        // √3 < 2.
        sum += load.abs().ceil().to_integer().magnitude() * 2_u32;
    }
    Ok((sum * denominator.magnitude()).bits() + 4)
}

#[cfg(test)]
mod tests {
    use num_rational::BigRational;

    use super::*;
    use crate::{FirstSign, RandomPiles, RandomStackings};
    use cannonpile::lattice::{Region, Site};

    #[test]
    fn bits_of_counts_are_those_of_the_greatest() {
        for steps in 0..=60_u32 {
            let of = steps.saturating_sub(1);
            let count = |d: u32| {
                let ways = binomial(BigUint::from(of), BigUint::from(d));
                (ways * BigUint::from(3_u32).pow(d)).bits()
            };
            let greatest = (0..=of).map(count).max();
            assert_eq!(Some(bits_of_counts(steps.into())), greatest, "{steps}");
        }
        assert_eq!(bits_of_counts(1001), 1995);
        // For more steps the result is the upper bound of 2(n−1) bits.
        for steps in [1002, 5000, 1 << 32] {
            assert_eq!(i128::from(bits_of_counts(steps)), 2 * (steps - 1));
        }
        assert!(i128::from(bits_of_counts(1 << 40)) >= 2 * ((1 << 40) - 1));
    }

    /// The bound is 1, plus the roots of three times the cells of each layer, rounded up, plus twice each load. It is
    /// multiplied by the denominator and by 16.
    #[test]
    fn bits_of_sources_are_those_of_the_bound() {
        let load = |piles: RandomPiles| {
            let load = BigRational::new(199.into(), 2.into());
            piles.with_load(Site::APEX, load).unwrap()
        };
        for steps in 0..=40_u64 {
            let stackings = RandomStackings::new(i128::from(steps) + 1, FirstSign::Plus).unwrap();
            let under = RandomPiles::under(Region::SITE, stackings);
            let roots = (0..=steps).map(|k| (3 * (3 * k * k + 3 * k + 1)).isqrt() + 1);
            let roots: u64 = roots.sum();
            for (piles, denominator, bound) in [
                (under.clone(), 1_u64, 1 + roots),
                (load(under.clone()), 2, 1 + roots + 200),
                (load(under.weightless()), 6, 1 + 200),
            ] {
                let domain = Domain::new(&piles, 1, 1).unwrap();
                let found = bits_of_sources(&domain, &denominator.into()).unwrap();
                let bits = u64::from(64 - (bound * denominator).leading_zeros()) + 4;
                assert_eq!(found, bits, "{steps} {denominator}");
            }
        }
    }

    /// A 64-bit integer has 63 bits for the magnitude. One of them stays free.
    #[test]
    fn words_cover_the_bits() {
        for (bits, words) in [
            (0, 1),
            (62, 1),
            (63, 2),
            (126, 2),
            (127, 7),
            (128, 8),
            (640, 16),
        ] {
            assert_eq!(Width::of(bits).words(bits), words, "{bits}");
        }
    }
}
