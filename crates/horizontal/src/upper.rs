//! The largest normal force of a bottom sphere of a straight pile: a field that proves a bound, and horizontal forces
//! that attain it.

use std::collections::{BTreeMap, HashMap};

use cannonpile::lattice::{HorizontalContact, Site};
use num_rational::BigRational;
use num_traits::Zero;

use crate::network::MAX_EQUATIONS;
use crate::simplex::{Sloping, least_horizontal};
use crate::straight::{Straight, by_direction, normal_below};
use crate::{Each, edge::Edge};

/// The field that proves an upper bound of the load on the bottom sphere (a, b, c), a ≥ b ≥ c.
///
/// The pile is straight, of equal spheres under one sphere, and the sphere is not at a corner. Other spheres have
/// coordinates (x, y, z) in the same order of directions. The components of the field are 0 or 1. Let u = y − b and
/// v = z − c. With the cuts p ≤ a, s ≤ p and q ≤ b the component is 1
/// * along x where u, v ≥ 0, x + u + v < p and, if v > 0, x + v < s;
/// * along x on the line u = v = 0;
/// * along y where x ≥ p, u ≤ 0, v ≥ 0 and, if v > 0, y + v < q;
/// * along z where v ≤ 0, s ≤ x < p, u ≥ 0 and x + u + v < p;
/// * along z where v ≤ 0, x ≥ p, y ≥ q and, if u > 0, z + u < c.
///
/// With p = s = a and q = b it is the field of [`greatest_inside`](crate::formula::greatest_inside). The sum of the
/// field is the bound of the load, in f₀, and the cuts minimise it. No theorem says that every such field proves its
/// bound, or that the bound is attained. So each certificate is checked.
pub(crate) struct Upper {
    straight: Straight,
    sphere: [i128; 3],
    /// The directions of x, y and z.
    directions: [usize; 3],
    p: i128,
    s: i128,
    q: i128,
    /// The sum of the field.
    sum: i128,
}

/// The greatest denominator of the forces. A larger one would fit the errors of the floats.
const MAX_DENOMINATOR: i32 = 60;

impl Upper {
    /// Returns the field with the smallest sum.
    pub(crate) fn of(straight: Straight) -> Self {
        let (sphere, directions) = straight.sorted();
        let [a, b, c] = sphere;
        let with_cut = |p| {
            let mut upper = Self {
                straight,
                sphere,
                directions,
                p,
                s: best_cut(c, p, p),
                q: best_cut(c, b, a + b - p),
                sum: 0,
            };
            let ones = upper.spheres().flat_map(|sphere| upper.at(sphere));
            upper.sum = ones.map(i128::from).sum();
            upper
        };
        let better = |best: Self, other: Self| if other.sum < best.sum { other } else { best };
        (1..=a).map(with_cut).fold(with_cut(0), better)
    }

    /// Returns the bound of the normal force, in mg.
    pub(crate) fn bound(&self) -> BigRational {
        normal_below(BigRational::from_integer(self.sum.into()))
    }

    /// Returns whether the pile is too large for a search of forces.
    pub(crate) fn is_large(&self) -> bool {
        3 * self.spheres().count() as u64 > MAX_EQUATIONS
    }

    /// Returns the spheres above the floor. Each sphere comes after those above it on its lines.
    fn spheres(&self) -> impl Iterator<Item = [i128; 3]> {
        let k: i128 = self.sphere.iter().sum();
        (0..k)
            .flat_map(move |x| (0..k - x).flat_map(move |y| (0..k - x - y).map(move |z| [x, y, z])))
    }

    /// Returns whether the components of the field are 1.
    fn at(&self, [x, y, z]: [i128; 3]) -> [bool; 3] {
        let ([_, b, c], &Self { p, s, q, .. }) = (self.sphere, self);
        let (u, v) = (y - b, z - c);
        let near = u >= 0 && x + u + v < p;
        [
            (near && v >= 0 && (v == 0 || x + v < s)) || (u == 0 && v == 0),
            x >= p && u <= 0 && v >= 0 && (v == 0 || y + v < q),
            v <= 0 && ((s <= x && x < p && near) || (x >= p && y >= q && (u <= 0 || z + u < c))),
        ]
    }

    /// Returns the field φ.
    pub(crate) fn field(&self) -> BTreeMap<Site, [BigRational; 3]> {
        let mut field = BTreeMap::new();
        for sphere in self.spheres() {
            let ones = self.at(sphere);
            if ones.contains(&true) {
                let ones = by_direction(self.directions, ones);
                let ones = ones.each(|one| BigRational::from_integer(i32::from(one).into()));
                field.insert(self.site(sphere), ones);
            }
        }
        field
    }

    /// Returns horizontal forces that attain the bound, or `None` if they are not found or the pile is too large.
    ///
    /// Compressive forces attain the bound if they are zero where an inequality of the field is strict: where D > 0 at a
    /// sloping contact that does not lead to the sphere, and where c > 0.
    ///
    /// If the search ends without forces, the bound may not be attained, or too many digits were lost.
    pub(crate) fn forces(&self) -> Option<BTreeMap<HorizontalContact, BigRational>> {
        if let Some(edge) = Edge::of(self.straight) {
            return Some(edge.forces());
        }
        if self.is_large() {
            return None;
        }
        let spheres: Vec<_> = self.spheres().collect();
        let numbers: HashMap<_, _> = spheres.iter().copied().zip(0_usize..).collect();
        let field = |sphere: [i128; 3]| self.at(sphere).each(i32::from);
        let mut sloping = Vec::with_capacity(3 * spheres.len());
        for sphere in &spheres {
            for l in 0..3 {
                let below = moved(*sphere, l, 1);
                let limit = match numbers.get(&below) {
                    Some(_) => field(below)[l],
                    None => i32::from(below == self.sphere),
                };
                let above = numbers.get(&moved(*sphere, l, -1));
                sloping.push(Sloping {
                    above: above.map(|above| 3 * above + l),
                    vanishes: field(*sphere)[l] > limit,
                    pushes: Vec::new(),
                });
            }
        }
        let mut contacts = Vec::new();
        for (number, sphere) in spheres.iter().enumerate() {
            for [l, m] in [[0, 1], [0, 2], [1, 2]] {
                let other = moved(moved(*sphere, m, 1), l, -1);
                let along = |sphere| field(sphere)[m] - field(sphere)[l];
                let Some(neighbour) = numbers.get(&other) else {
                    continue;
                };
                if along(*sphere) == along(other) {
                    let pushes = [
                        (number, m, -1.0),
                        (number, l, 1.0),
                        (*neighbour, m, 1.0),
                        (*neighbour, l, -1.0),
                    ];
                    for (number, l, push) in pushes {
                        sloping[3 * number + l].pushes.push((contacts.len(), push));
                    }
                    contacts.push((*sphere, other));
                }
            }
        }
        let found = least_horizontal(contacts.len(), &sloping)?;
        let mut forces = BTreeMap::new();
        for ((sphere, other), force) in contacts.into_iter().zip(found) {
            let force = (1..=MAX_DENOMINATOR).find_map(|denominator| with(denominator, force))?;
            if !force.is_zero() {
                let [sphere, other] =
                    [sphere, other].each(|sphere| by_direction(self.directions, sphere));
                forces.insert(self.straight.contact(sphere, other)?, force);
            }
        }
        Some(forces)
    }

    fn site(&self, sphere: [i128; 3]) -> Site {
        self.straight.site(by_direction(self.directions, sphere))
    }
}

fn moved(mut sphere: [i128; 3], l: usize, by: i128) -> [i128; 3] {
    sphere[l] += by;
    sphere
}

/// Returns the cut t ≤ `most` with the smallest sum of the field: s for `length` = p, and q for `length` = a + b − p.
///
/// With t + 1 in place of t, the field gains t (length − t) ones along x (for s) or along y (for q). It loses
/// length − t + w ones along z on each plane z = c − w, w = 0 … c.
fn best_cut(c: i128, most: i128, length: i128) -> i128 {
    let (mut sum, mut least, mut best) = (0, 0, 0);
    for t in 0..most {
        let rest = length - t;
        sum += t * rest - (c + 1) * rest - c * (c + 1) / 2;
        if sum < least {
            (least, best) = (sum, t + 1);
        }
    }
    best
}

/// Returns a float as a fraction with the given denominator, if it is close to one.
fn with(denominator: i32, number: f64) -> Option<BigRational> {
    const CLOSE: f64 = 1e-4;
    let product = number * f64::from(denominator);
    let numerator = product.round();
    let is_close = (product - numerator).abs() < CLOSE;
    let numerator = BigRational::from_float(numerator).filter(|_| is_close)?;
    Some(numerator / BigRational::from_integer(denominator.into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::{Certificate, Claim, Extreme};
    use cannonpile::Pile;
    use cannonpile::lattice::Region;

    /// Returns the field of the bottom sphere n of a straight pile of + or − steps.
    fn upper(sign: &str, n: [i128; 3]) -> (Pile, Site, Upper) {
        let (sigma, k) = (if sign == "+" { 1 } else { -1 }, n.iter().sum());
        let stacking = sign.repeat(usize::try_from(k).unwrap()).parse().unwrap();
        let pile = Pile::under(Region::SITE, stacking).unwrap();
        let [i, j] = [sigma * n[1], sigma * n[2]];
        let site = Site { i, j, k };
        let upper = Upper::of(Straight::of(&pile, site).unwrap());
        (pile, site, upper)
    }

    fn is_attained(sign: &str, n: [i128; 3]) {
        let (pile, site, upper) = upper(sign, n);
        let certificate = Certificate {
            pile,
            claim: Claim::Greatest(Extreme {
                site,
                normal: upper.bound(),
                attained: true,
            }),
            horizontal: upper.forces().unwrap(),
            field: upper.field(),
        };
        assert_eq!(certificate.check(), Ok(()), "{sign} {n:?}");
    }

    #[test]
    fn bounds_on_edges_are_attained() {
        for k in 2..=17 {
            for b in 1..=k / 2 {
                is_attained("+", [k - b, b, 0]);
            }
        }
    }

    #[test]
    fn bounds_inside_are_attained() {
        for k in 3..=12 {
            for c in 1..=k / 3 {
                for b in c..=(k - c) / 2 {
                    is_attained("+", [k - b - c, b, c]);
                }
            }
        }
    }

    #[test]
    fn coordinates_may_have_any_order() {
        let orders = [
            [4, 2, 1],
            [4, 1, 2],
            [2, 4, 1],
            [1, 4, 2],
            [2, 1, 4],
            [1, 2, 4],
        ];
        for n in orders {
            is_attained("+", n);
            is_attained("-", n);
        }
    }

    /// In the last two cases the bound is not attained.
    #[test]
    fn bounds_have_known_values() {
        for (n, greatest) in [
            ([8, 1, 0], 29),
            ([5, 4, 0], 41),
            ([6, 2, 1], 36),
            ([7, 4, 1], 80),
            ([8, 5, 2], 136),
            ([5, 5, 5], 105),
            ([10, 9, 3], 387),
            ([11, 10, 3], 488),
        ] {
            let (_, _, upper) = upper("+", n);
            assert_eq!(upper.sum, greatest, "{n:?}");
            assert!(upper.bound() <= upper.straight.outer_bound(), "{n:?}");
        }
    }

    #[test]
    fn best_cut_has_the_smallest_sum() {
        for (a, b, c) in [(7, 4, 1), (6, 3, 2), (5, 5, 2), (4, 3, 3)] {
            for p in 0..=a {
                let (_, _, best) = upper("+", [a, b, c]);
                let sum = |s, q| {
                    let cut = Upper { p, s, q, ..best };
                    let ones = cut.spheres().flat_map(|sphere| cut.at(sphere));
                    ones.filter(|one| *one).count()
                };
                let all = (0..=p).flat_map(|s| (0..=b).map(move |q| (s, q)));
                let least = all.map(|(s, q)| sum(s, q)).min();
                let [s, q] = [best_cut(c, p, p), best_cut(c, b, a + b - p)];
                assert_eq!(Some(sum(s, q)), least, "{a} {b} {c} {p}");
            }
        }
    }

    /// The linear program gives 169½.
    #[test]
    fn bounds_that_are_not_attained_have_no_forces() {
        let (_, _, upper) = upper("+", [7, 7, 2]);
        assert_eq!((upper.sum, upper.is_large()), (170, false));
        assert_eq!(upper.forces(), None);
    }

    #[test]
    fn search_is_limited_to_31_layers() {
        for (a, is_large) in [(27, false), (28, true)] {
            let (_, _, upper) = upper("+", [a, 2, 1]);
            assert_eq!(upper.is_large(), is_large);
            assert!(!is_large || upper.forces().is_none());
        }
    }

    #[test]
    fn floats_near_fractions_are_rounded() {
        let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
        assert_eq!(with(3, 0.333_333_3), Some(ratio(1, 3)));
        assert_eq!(with(2, 0.333_333_3), None);
        assert_eq!(with(4, -0.25), Some(ratio(-1, 4)));
        assert_eq!(with(1, 1e-20), Some(ratio(0, 1)));
        assert_eq!(with(1, f64::NAN), None);
        assert_eq!(with(60, f64::INFINITY), None);
    }
}
