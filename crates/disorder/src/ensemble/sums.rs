//! Sums of forces and of their squares, which depend on the weights only.

use num_bigint::BigInt;
use num_rational::BigRational;

use super::count::Level;

/// The sums of the forces below layers and of their squares, in f₀. They are the same for all stackings whose layers
/// have the same sizes.
///
/// Let n_k be the number of spheres of weight w in layer k, and S_k and Q_k the sums of the contact forces below it and
/// of their squares. Then S_k = S_(k−1) + 3w n_k and Q_k = Q_(k−1) + 2w S_(k−1) + 3w² n_k. *Proof.* Each force below
/// layer k−1 acts on one sphere of layer k, as one of its three forces g from above. So the sums of g and g² are those
/// of the layer above. The half-turn G preserves both, because it is orthogonal and G(1, 1, 1) = (1, 1, 1). The forces
/// below the sphere are g or Gg, plus w on each contact. ∎
#[derive(Clone, Debug)]
pub(super) struct Sums {
    /// S_0 and Q_0.
    top: [BigRational; 2],
    /// w, in mg: 0 or 1.
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

    /// Returns the sum of the forces, for the totals of some layers.
    pub(super) fn sum(&self, level: &Level) -> BigRational {
        let [top, _] = &self.top;
        let below = BigRational::from_integer(BigInt::from(level.under_top) * 3_u32);
        top * BigInt::from(level.layers) + below * &self.weight
    }

    /// Returns the sum of the squares of the forces, for the totals of some layers.
    pub(super) fn squares(&self, level: &Level) -> BigRational {
        let [sum, squares] = &self.top;
        let mixed = sum * BigInt::from(level.depth) * BigInt::from(2_u32);
        let below = mixed + BigRational::from_integer(level.squares.into());
        squares * BigInt::from(level.layers) + below * &self.weight
    }
}
