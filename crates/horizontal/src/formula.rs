//! Formulas of horizontal contacts, at a = R: drops and compressions of a field, and closed forms of straight piles.
//!
//! All are generic over the scalar, and [`theorem`](crate::theorem) is about them. The balance of a sphere with horizontal
//! contacts is in the core: [`pushed`](cannonpile::formula::pushed) and [`beside`](cannonpile::formula::beside).

use cannonpile::formula::force;
use cannonpile::lattice::{Direction, Sign, count};
use cannonpile::scalar::{Algebra, Ring};

use crate::TWO;

/// Returns D = φ_l(p) − (Tφ(q))_l of the contact of p with its support q: `here` is φ_l(p), `below` what is taken off, 0 on
/// the floor, with T the [half-turn](cannonpile::formula::half_turn) where the sign changes at q.
///
/// # Examples
/// ```
/// assert_eq!(cannonpile_horizontal::formula::lowered(5.0, &3.0), 2.0);
/// ```
pub fn lowered<T: Ring>(here: T, below: &T) -> T {
    here - below
}

/// Returns c = σ((φ_b − φ_a)(p) − (φ_b − φ_a)(p′)) of the contact of p and p′ = p + d_b − d_a; `ends` are a and b, σ the
/// sign of the step below.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Axis, Sign};
/// use cannonpile_horizontal::formula::compression;
///
/// let (here, there) = ([1.0, 4.0, 0.0], [2.0, 3.0, 0.0]);
/// assert_eq!(compression(&here, &there, Axis::AlphaBeta.ends(), Sign::Plus), 2.0);
/// ```
pub fn compression<T: Ring>(here: &[T; 3], there: &[T; 3], ends: [Direction; 2], sign: Sign) -> T {
    let [a, b] = ends.map(Direction::index);
    let difference = |field: &[T; 3]| field[b].clone() - &field[a];
    signed(difference(here) - &difference(there), sign)
}

/// Returns φ_l = d·n_l + d(d+1)/2 of the elastic state of a straight pile of equal weights, in f₀/κ: d layers above the floor,
/// on a sphere with n_l spheres above it on its line l; of discs too.
///
/// # Examples
/// ```
/// assert_eq!(cannonpile_horizontal::formula::elastic_field(&2.0, &3.0), 12.0);
/// ```
pub fn elastic_field<T: Algebra>(n: &T, d: &T) -> T {
    force(n.clone(), d) + &count::spheres_in_layer(&(d.clone() - &T::one()), 3)
}

/// Returns the field on the edge of spheres (t, 0, 0) that proves what can rest on the corner below it: 1 along the
/// edge, and 0 or, of `all` lines, 1 along the other two.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Direction;
/// use cannonpile_horizontal::formula::corner_field;
///
/// assert_eq!(corner_field::<f64>(Direction::Beta, false), [0.0, 1.0, 0.0]);
/// ```
#[must_use]
pub fn corner_field<T: Ring>(edge: Direction, all: bool) -> [T; 3] {
    Direction::ALL.map(|line| {
        if all || line == edge {
            T::one()
        } else {
            T::zero()
        }
    })
}

/// Returns the least that can rest on a corner below K layers under one sphere, in f₀: K.
///
/// # Examples
/// ```
/// assert_eq!(cannonpile_horizontal::formula::least_on_corner(&9.0), 9.0);
/// ```
pub fn least_on_corner<T: Ring>(k: &T) -> T {
    k.clone()
}

/// Returns the greatest that can rest on a corner below K ≥ 1 layers under one sphere, in f₀: 3K − 2.
///
/// # Examples
/// ```
/// assert_eq!(cannonpile_horizontal::formula::greatest_on_corner(&9.0), 25.0);
/// ```
pub fn greatest_on_corner<T: Ring>(k: &T) -> T {
    k.clone() + k + k - &T::from_i128(2)
}

/// Returns a bound of what can rest on a bottom sphere n of a pile under one sphere, in f₀: Σ C(n_l+2, 3). It may not be
/// attained.
///
/// # Examples
/// ```
/// assert_eq!(cannonpile_horizontal::formula::greatest_inside(&[2.0, 1.0, 1.0]), 6.0);
/// ```
pub fn greatest_inside<T: Algebra>(n: &[T; 3]) -> T {
    let counts = n.iter().map(|n| count::spheres(n, 3));
    counts.fold(T::zero(), |sum, count| sum + &count)
}

/// Returns a bound of what can rest on the bottom sphere (k, j, 0) on an edge of a pile under one sphere, in f₀, for
/// k ≥ j ≥ 1 and c = min(j+1, k): 2k − 1 + (c−1)² + 2j(k−c) + j². It may not be attained.
///
/// That is 2(j+1)(k−1) + 1 if k > j, and 2k² if k = j.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::formula::greatest_on_edge;
///
/// assert_eq!(greatest_on_edge(&5.0, &2.0, &3.0), 25.0);
/// assert_eq!(greatest_on_edge(&4.0, &4.0, &4.0), 32.0);
/// ```
pub fn greatest_on_edge<T: Ring>(k: &T, j: &T, c: &T) -> T {
    let one = T::one();
    let square = |x: T| x.clone() * &x;
    let across = (k.clone() - c) * j;
    k.clone() + k - &one + &square(c.clone() - &one) + &across + &across + &square(j.clone())
}

/// Returns the forces with which the three spheres that rest on a bottom sphere must press each other so that nothing does,
/// where they would pass on ν to it: X_bc, X_ca, X_ab, with X_ab = (ν_a + ν_b − ν_c)/2.
///
/// # Examples
/// ```
/// assert_eq!(cannonpile_horizontal::formula::arch(&[3.0, 2.0, 1.0]), [0.0, 1.0, 2.0]);
/// ```
pub fn arch<T: Algebra>(nu: &[T; 3]) -> [T; 3] {
    let [a, b, c] = nu;
    let half = |x: &T, y: &T, less: &T| (x.clone() + y - less).div_int(TWO);
    [half(b, c, a), half(c, a, b), half(a, b, c)]
}

fn signed<T: Ring>(x: T, sign: Sign) -> T {
    match sign {
        Sign::Plus => x,
        Sign::Minus => -x,
    }
}
