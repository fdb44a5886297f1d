//! Sums of forces, which depend on the weights only.

use num_bigint::BigInt;
use num_rational::BigRational;

use super::count::Level;

/// The sums of forces of layers, in f₀: the same whatever the stacking, for layers of given sizes.
///
/// With n_k spheres of the weight w in layer k and S_k, Q_k the sums of the contact forces below it and of their squares,
/// S_k = S_(k−1) + 3w n_k and Q_k = Q_(k−1) + 2w S_(k−1) + 3w² n_k. *Proof.* Each force f arrives at one sphere as one of
/// its three g, so the sums of g and g² are those of the layer above. The half-turn G keeps both, as it is orthogonal and
/// G(1, 1, 1) = (1, 1, 1). What is passed on is g or Gg, and w more on each line. ∎
#[derive(Clone, Debug)]
pub(super) struct Sums {
    /// S_0, Q_0.
    top: [BigRational; 2],
    /// w, which is 0 or 1.
    weight: BigRational,
}

impl Sums {
    pub(super) fn of(top_own: &[BigRational], weight: &BigRational) -> Self {
        let three = BigInt::from(3_u32);
        let squares = top_own.iter().map(|own| own * own);
        let sum = top_own.iter().sum::<BigRational>() * &three;
        Self {
            top: [sum, squares.sum::<BigRational>() * &three],
            weight: weight.clone(),
        }
    }

    /// The sum of the forces below some layers, by what lies above them in all.
    pub(super) fn sum(&self, level: &Level) -> BigRational {
        let [top, _] = &self.top;
        let below = BigRational::from_integer(BigInt::from(level.under_top) * 3_u32);
        top * BigInt::from(level.layers) + below * &self.weight
    }

    /// The sum of their squares.
    pub(super) fn squares(&self, level: &Level) -> BigRational {
        let [sum, squares] = &self.top;
        let mixed = sum * BigInt::from(level.depth) * BigInt::from(2_u32);
        let below = mixed + BigRational::from_integer(level.squares.into());
        squares * BigInt::from(level.layers) + below * &self.weight
    }
}
