//! The singular values of the equilibrium matrix, in closed form.
//!
//! Let f be the forces below all spheres that have supports, in f₀ and by lines, S the transfer to the layer below and w
//! the weights and loads. Equilibrium is f = S f + w. A contact has one lower end, and a sphere receives at most one
//! force on each line, so S maps each line of layer k to a line of layer k + 1 and no two to the same. At a sign change it
//! also applies G = (2/d)J − 1, which is orthogonal. So S is an isometry from each layer to the next. The last layer with
//! supports transmits to the floor, and S maps it to 0.
//!
//! Orthonormal vectors of layer k, carried down by S, are orthonormal in each layer below. Completing them layer by layer
//! divides the space into chains: d(N_k − N_(k−1)) chains begin in layer k, with N_k spheres, and each has
//! m = L − 1 − k vectors. On a chain I − S is a bidiagonal matrix, 1 on the diagonal and −1 below it, whose singular
//! values are 2 cos(jπ/(2m+1)), j = 1 … m, with the product 1. The theorems `isometry`, `inverse` and `singular-values` of
//! `cannonpile-proof` are about these steps.

use core::f64::consts::PI;
use core::fmt;
use core::num::NonZeroI64;

use cannonpile::Packing;
use cannonpile::lattice::Dimension;
use cannonpile::scalar::{Algebra, DoubleDouble, Ring};
use cannonpile::shape::Shape;
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// A singular value 2 cos(jπ/(2m+1)) of the equilibrium matrix, from the chains of length m.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct SingularValue {
    index: i128,
    chain_length: i128,
    multiplicity: BigUint,
}

impl SingularValue {
    /// Returns the index j, from 1 to m.
    #[must_use]
    pub const fn index(&self) -> i128 {
        self.index
    }

    /// Returns the length m of the chains: the number of layers with supports, from the layer in which the chains begin.
    #[must_use]
    pub const fn chain_length(&self) -> i128 {
        self.chain_length
    }

    /// Returns the number of chains of this length. It is the multiplicity, unless chains of another length have an equal
    /// value.
    #[must_use]
    pub const fn multiplicity(&self) -> &BigUint {
        &self.multiplicity
    }

    /// Returns the value 2 cos(jπ/(2m+1)), within 0.51 units in the last place.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_accuracy::singular_values;
    ///
    /// // 2 cos(π/5), the golden ratio.
    /// let pile = Pile::triangular(3)?;
    /// let largest = singular_values(pile.shape()).next().unwrap();
    /// assert_eq!(largest.value(), 1.618033988749895);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn value(&self) -> f64 {
        (DoubleDouble::new(2.0) * cosine(self.index, self.chain_length)).high()
    }
}

impl fmt::Display for SingularValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let multiple = if self.index == 1 {
            String::new()
        } else {
            self.index.to_string()
        };
        write!(
            f,
            "2 cos({multiple}π/{}), {} times",
            2 * self.chain_length + 1,
            self.multiplicity
        )
    }
}

/// Returns the singular values of the equilibrium matrix I − S, with their multiplicities: chain by chain, the longest
/// chains first, and in each the largest value first. There are L(L−1)/2 of them for L layers, computed one by one.
///
/// The unknowns are the forces below all spheres that have supports, d for each of them. The values hold for every
/// stacking, every top and base, and every load. Their product, with multiplicities, is the determinant: 1. Chains of
/// different lengths can have equal values, such as 2 cos(π/3) = 2 cos(3π/9), which are listed separately.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_accuracy::singular_values;
///
/// let pile = Pile::triangular(3)?;
/// let text: Vec<_> = singular_values(pile.shape()).map(|value| value.to_string()).collect();
/// assert_eq!(text, ["2 cos(π/5), 3 times", "2 cos(2π/5), 3 times", "2 cos(π/3), 6 times"]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn singular_values(shape: &Shape) -> impl Iterator<Item = SingularValue> + '_ {
    let lines = shape.dimension().number();
    let mut above = BigUint::zero();
    let with_supports = shape.layers() - 1;
    (0..with_supports).flat_map(move |k| {
        let Ok(region) = shape.layer(k) else {
            unreachable!("a shape has each of its layers")
        };
        // A layer has at least the spheres that support the layer above.
        let spheres = region.site_count();
        let multiplicity = (&spheres - &above) * lines;
        above = spheres;
        let chain_length = with_supports - k;
        (1..=chain_length).map(move |index| SingularValue {
            index,
            chain_length,
            multiplicity: multiplicity.clone(),
        })
    })
}

/// Returns the condition number κ₂ = cos(π/(2L−1))/sin(π/(4L−2)) of the equilibrium matrix I − S, about (4L−2)/π, within
/// 0.51 units in the last place. It depends on the number of layers L only. Returns `None` for one layer, which has no
/// contacts.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_accuracy::condition_number;
///
/// // The golden ratio squared.
/// let pile = Pile::triangular(3)?;
/// assert_eq!(condition_number(pile.shape()), Some(2.618033988749895));
/// assert_eq!(condition_number(Pile::triangular(10_i128.pow(36))?.shape()), Some(1.2732395447351626e36));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[must_use]
pub fn condition_number(shape: &Shape) -> Option<f64> {
    let chain_length = shape.layers() - 1;
    if chain_length == 0 {
        return None;
    }
    let [largest, smallest] = [1, chain_length].map(|index| cosine(index, chain_length));
    largest
        .checked_div(&smallest)
        .map(|quotient| quotient.high())
}

/// Returns an upper bound of the condition number κ₂ of the equilibrium matrix in newtons, or `None` for one layer.
///
/// The unknowns are the contact forces in newtons, and the equations the balance of the spheres along x, y and z. The
/// matrix is D (I − S), where the blocks of D are the directions below a sphere. So the bound is the product of their
/// condition number and [`condition_number`]: max(√2/tanθ, tanθ/√2) times, for φ = π/6, and max(tanθ, 1/tanθ) times, for
/// discs. It is attained at a = √2 R, where the directions of the equilateral base are orthogonal. Rounding raises it by
/// a factor of at most 1 + 10⁻¹⁴.
///
/// # Examples
/// ```
/// use cannonpile::{Packing, Pile};
/// use cannonpile_accuracy::{condition_bound, condition_number};
///
/// let pile = Pile::triangular(8)?;
/// let bound = condition_bound(&Packing::new(&pile, &"1".parse()?)?).unwrap();
/// assert!((bound - 18.7).abs() < 0.1);
/// let bound = condition_bound(&Packing::new(&pile, &"sqrt(2)".parse()?)?).unwrap();
/// assert!((bound / condition_number(pile.shape()).unwrap() - 1.0).abs() < 1e-14);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[must_use]
pub fn condition_bound(packing: &Packing<'_>) -> Option<f64> {
    let pile = packing.pile();
    let angle = packing.inclination();
    let (sin2, cos2) = (angle.sin2().clone(), angle.cos2());
    let twice = |r: &BigRational| r + r;
    // The squared singular values of the directions: the eigenvalues of their scalar products.
    let squares = match pile.dimension() {
        Dimension::Two => [&sin2, &cos2, &cos2].map(|r| f64::from_rational(&twice(r))),
        Dimension::Three => {
            // ê_a·ê_b = x, and ê_a·ê_c = ê_b·ê_c = y.
            let s = pile.sin_phi();
            let x = &cos2 + (twice(&(s * s)) - BigRational::one()) * &sin2;
            let y = &cos2 - s * &sin2;
            let y2 = twice(&(&y * &y));
            let root = f64::from_rational(&(&x * &x + twice(&twice(&y2)))).sqrt();
            let upper = f64::midpoint(f64::from_rational(&(twice(&BigRational::one()) + &x)), root);
            // The product of the two is 1 + x − 2y². A difference would cancel.
            let lower = f64::from_rational(&(BigRational::one() + &x - y2)) / upper;
            [f64::from_rational(&(BigRational::one() - x)), upper, lower]
        }
    };
    let largest = squares.into_iter().fold(0.0, f64::max);
    let smallest = squares.into_iter().fold(f64::INFINITY, f64::min);
    // A dozen roundings, each of half a unit in the last place, and one more.
    let above = 1.0 + 32.0 * f64::EPSILON;
    Some((largest / smallest).sqrt() * condition_number(pile.shape())? * above)
}

/// Returns cos(jπ/(2m+1)), with a relative error below 2^−80, for m below 2^125.
fn cosine(j: i128, m: i128) -> DoubleDouble {
    // As a sine, the smallest values keep all digits.
    let odd = 2 * m + 1;
    let [p, q] = [odd - 2 * j, 2 * odd].map(DoubleDouble::from_integer);
    // π to 107 bits.
    let pi = DoubleDouble::new(PI) + DoubleDouble::new(1.224_646_799_147_353_2e-16);
    let Some(x) = (pi * p).checked_div(&q) else {
        unreachable!("an odd number is not zero")
    };
    // sin x = x(1 − x²/(2·3) (1 − x²/(4·5) (1 − …))). For x up to π/2 the first term left out is below 10⁻²⁸.
    let one = DoubleDouble::one();
    let divisors = (1..=15)
        .rev()
        .filter_map(|n| NonZeroI64::new(2 * n * (2 * n + 1)));
    divisors.fold(one, |sum, divisor| one - (x * x * sum).div_int(divisor)) * x
}
