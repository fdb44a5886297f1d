//! Formulas of horizontal contacts at a = R: the drop and the compression of a contact under a virtual displacement,
//! and closed forms for straight piles.
//!
//! All functions are generic over the scalar. The crate `cannonpile-proof` evaluates them on polynomials, and so proves
//! statements about them. The crate `cannonpile` contains the balance of a sphere with horizontal contacts:
//! [`pushed`](cannonpile::formula::pushed) and [`beside`](cannonpile::formula::beside).

use cannonpile::formula::force;
use cannonpile::lattice::{Direction, Sign, count};
use cannonpile::scalar::{Algebra, Ring};

use crate::{Each, TWO};

/// Returns the drop D of a sloping contact: the approach of its two spheres to each other under the virtual
/// displacement φ.
///
/// D = φ_l(p) − (Tφ(q))_l for the contact of p with the sphere q below it, along the direction l. T is the
/// [half-turn](cannonpile::formula::half_turn) at a sign change, and the identity otherwise. `here` is φ_l(p), and
/// `below` is (Tφ(q))_l. For a sphere q on the floor `below` is zero.
///
/// # Examples
/// ```
/// assert_eq!(cannonpile_horizontal::formula::contact_drop(5.0, &3.0), 2.0);
/// ```
pub fn contact_drop<T: Ring>(here: T, below: &T) -> T {
    here - below
}

/// Returns the compression c of a horizontal contact: the approach of its two spheres to each other under the virtual
/// displacement φ.
///
/// c = σ((φ_b − φ_a)(p) − (φ_b − φ_a)(p′)) for the neighbours p and p′ = p + d_b − d_a. `here` is φ(p), `there` is
/// φ(p′), and `ends` are the directions a and b. σ is the sign of the step below the layer.
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
    let [a, b] = ends.each(Direction::index);
    let difference = |field: &[T; 3]| field[b].clone() - &field[a];
    signed(difference(here) - &difference(there), sign)
}

/// Returns the displacement of a sphere along a direction l in the elastic state of a straight pile of equal weights,
/// in f₀/κ with the contact stiffness κ.
///
/// φ_l = d·n + d(d+1)/2 for a sphere d layers above the floor with n spheres above it on its line l. The formula holds
/// for spheres and discs.
///
/// # Examples
/// ```
/// assert_eq!(cannonpile_horizontal::formula::elastic_field(&2.0, &3.0), 12.0);
/// ```
pub fn elastic_field<T: Algebra>(n: &T, d: &T) -> T {
    force(n.clone(), d) + &count::spheres_in_layer(&(d.clone() - &T::one()), 3)
}

/// Returns the field φ on the spheres of an edge (t, 0, 0), which proves a bound for the corner sphere below this edge.
///
/// φ_l = 1 along the edge. In the other two directions φ_l = 1 if `all`, and 0 otherwise.
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
    Direction::ALL.each(|line| {
        if all || line == edge {
            T::one()
        } else {
            T::zero()
        }
    })
}

/// Returns the smallest load that a corner sphere below K layers can receive from above, in f₀. This load is K.
///
/// The pile is straight, and its top layer is one sphere.
///
/// # Examples
/// ```
/// assert_eq!(cannonpile_horizontal::formula::least_on_corner(&9.0), 9.0);
/// ```
pub fn least_on_corner<T: Ring>(k: &T) -> T {
    k.clone()
}

/// Returns the largest load that a corner sphere below K ≥ 1 layers can receive from above, in f₀. This load is 3K − 2.
///
/// The pile is straight, and its top layer is one sphere.
///
/// # Examples
/// ```
/// assert_eq!(cannonpile_horizontal::formula::greatest_on_corner(&9.0), 25.0);
/// ```
pub fn greatest_on_corner<T: Ring>(k: &T) -> T {
    k.clone() + k + k - &T::from_integer(2)
}

/// Returns an upper bound of the load on a bottom sphere of a straight pile under one sphere, in f₀: Σ C(n_l+2, 3).
///
/// `n` is (n_α, n_β, n_γ), the numbers of spheres above it on its lines of contacts. The bound need not be attained.
///
/// # Examples
/// ```
/// assert_eq!(cannonpile_horizontal::formula::greatest_inside(&[2.0, 1.0, 1.0]), 6.0);
/// ```
pub fn greatest_inside<T: Algebra>(n: &[T; 3]) -> T {
    let counts = n.iter().map(|n| count::spheres(n, 3));
    counts.fold(T::zero(), |sum, count| sum + &count)
}

/// Returns an upper bound of the load on the bottom sphere (k, j, 0), on an edge of a pile under one sphere, in f₀.
///
/// It is 2k − 1 + (c−1)² + 2j(k−c) + j² for k ≥ j ≥ 1 and c = min(j+1, k). This equals 2(j+1)(k−1) + 1 for k > j, and
/// 2k² for k = j. The bound need not be attained.
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

/// Returns the horizontal forces between three spheres that completely unload the bottom sphere below them.
///
/// Without these forces, the three spheres would transmit ν_a, ν_b and ν_c to the bottom sphere. The result is
/// (X_bc, X_ca, X_ab), with X_ab = (ν_a + ν_b − ν_c)/2.
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
