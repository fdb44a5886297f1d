//! The largest normal force of a bottom sphere of a straight pile: a field that proves a bound, and horizontal forces
//! that attain it.

use std::collections::{BTreeMap, HashMap};

use cannonpile::lattice::{HorizontalContact, Site};
use num_rational::BigRational;
use num_traits::Zero;

use crate::edge::Edge;
use crate::exact::simple_fraction;
use crate::network::MAX_EQUATIONS;
use crate::simplex::{Sloping, least_horizontal};
use crate::straight::{Straight, by_direction};

/// The field that bounds the normal force of a bottom sphere (a, b, c) with a ≥ b ≥ c from above.
///
/// The pile is straight, of equal spheres under one sphere, and the sphere is not at a corner. All coordinates
/// (x, y, z) are sorted like those of the sphere. The components of the field are 0 or 1. Let u = y − b and v = z − c.
/// With the cuts p ≤ a, s ≤ p and q ≤ b the component is 1
/// * along x where u ≥ 0, v ≥ 0, x + u + v < p and, unless v = 0, x + v < s; and on the line u = v = 0;
/// * along y where x ≥ p, u ≤ 0, v ≥ 0 and, unless v = 0, y + v < q;
/// * along z where v ≤ 0 and either s ≤ x < p, u ≥ 0 and x + u + v < p, or x ≥ p, y ≥ q and, unless u ≤ 0, z + u < c.
///
/// With p = s = a and q = b it is the field of [`greatest_inside`](crate::formula::greatest_inside). The sum of the
/// field is the bound, and the cuts minimise it. It is not a theorem that every such field proves its bound, and that
/// the bound is attained. So the certificates are checked.
pub(crate) struct Upper {
    straight: Straight,
    sphere: [i128; 3],
    /// The directions of x, y and z.
    directions: [usize; 3],
    p: i128,
    s: i128,
    q: i128,
}

impl Upper {
    pub(crate) fn of(straight: Straight) -> Option<Self> {
        let (sphere, directions) = straight.sorted();
        let [a, b, c] = sphere;
        let with_cut = |p| Self {
            straight,
            sphere,
            directions,
            p,
            s: best_cut(c, p, p),
            q: best_cut(c, b, a + b - p),
        };
        (0..=a).map(with_cut).min_by_key(Self::sum)
    }

    /// Returns the sum of the field: the bound of the load from above, in f₀.
    pub(crate) fn sum(&self) -> i128 {
        let ones = self.spheres().flat_map(|sphere| self.at(sphere));
        ones.map(i128::from).sum()
    }

    /// Returns whether the pile is too large for a search of forces.
    pub(crate) fn is_large(&self) -> bool {
        3 * self.spheres().count() as u64 > MAX_EQUATIONS
    }

    /// Returns the spheres above the floor. Spheres above on a line precede those below.
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
        let ones = self.spheres().map(|sphere| (sphere, self.at(sphere)));
        let ones = ones.filter(|(_, ones)| ones.contains(&true));
        let field = ones.map(|(sphere, ones)| {
            let ones = by_direction(self.directions, ones.map(i32::from));
            let ones = ones.map(|one| BigRational::from_integer(one.into()));
            (self.site(sphere), ones)
        });
        field.collect()
    }

    /// Returns horizontal forces that attain the bound, or `None` if they are not found or the pile is too large.
    ///
    /// Forces attain the bound if they vanish wherever an inequality of the field is strict: D > 0 at a sloping contact
    /// that does not lead to the sphere, and c > 0 at a horizontal contact.
    pub(crate) fn forces(&self) -> Option<BTreeMap<HorizontalContact, BigRational>> {
        if let Some(edge) = Edge::of(self.straight) {
            return Some(edge.forces());
        }
        if self.is_large() {
            return None;
        }
        let spheres: Vec<_> = self.spheres().collect();
        let numbers: HashMap<_, _> = spheres.iter().copied().zip(0_usize..).collect();
        let field = |sphere: [i128; 3]| self.at(sphere).map(i32::from);
        let mut sloping = Vec::with_capacity(3 * spheres.len());
        for sphere in &spheres {
            for l in 0..3 {
                let below = moved(*sphere, l, 1);
                let is_above = |below| numbers.contains_key(below);
                let limit = if is_above(&below) {
                    field(below)[l]
                } else {
                    i32::from(below == self.sphere)
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
            let (numerator, denominator) = simple_fraction(force, 1000)?;
            let force = BigRational::new(numerator.into(), denominator.get().into());
            if !force.is_zero() {
                let [sphere, other] =
                    [sphere, other].map(|sphere| by_direction(self.directions, sphere));
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

/// Returns the cut t ≤ `most` for which the sum of the field is smallest.
///
/// The cut t + 1 in place of t adds t (length − t) ones along x or y. It removes Σ (length − t + w) ones along z, over
/// the planes w = 0 … c.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::{Certificate, Claim, Extreme};
    use crate::straight::normal_below;
    use cannonpile::Pile;

    fn upper(layers: i128, i: i128, j: i128) -> (Pile, Site, Upper) {
        let (pile, site) = (
            Pile::triangular(layers).unwrap(),
            Site {
                i,
                j,
                k: layers - 1,
            },
        );
        let upper = Upper::of(Straight::of(&pile, site).unwrap()).unwrap();
        (pile, site, upper)
    }

    fn is_attained(layers: i128, i: i128, j: i128) {
        let (pile, site, upper) = upper(layers, i, j);
        let normal = normal_below(BigRational::from_integer(upper.sum().into()));
        let certificate = Certificate {
            pile,
            claim: Claim::Greatest(Extreme {
                site,
                normal,
                attained: true,
            }),
            horizontal: upper.forces().unwrap(),
            field: upper.field(),
        };
        assert_eq!(certificate.check(), Ok(()), "{site}");
    }

    #[test]
    fn bounds_on_edges_are_attained() {
        for layers in 3..=18 {
            for i in 1..=(layers - 1) / 2 {
                is_attained(layers, i, 0);
            }
        }
    }

    #[test]
    fn bounds_inside_are_attained() {
        for layers in 4..=13 {
            for i in 1..layers / 2 {
                for j in 1..=i.min(layers - 1 - 2 * i) {
                    is_attained(layers, i, j);
                }
            }
        }
    }

    /// In a larger pile the search can end without forces, and a field of another form proves a smaller bound.
    #[test]
    fn bounds_are_at_most_those_of_formulas() {
        for (n, greatest) in [
            ([8, 1, 0], 29),
            ([5, 4, 0], 41),
            ([6, 2, 1], 36),
            ([7, 4, 1], 80),
            ([8, 5, 2], 136),
            ([5, 5, 5], 105),
            ([11, 10, 3], 488),
        ] {
            let layers = n.iter().sum::<i128>() + 1;
            let (_, _, upper) = upper(layers, n[1], n[2]);
            assert_eq!(upper.sum(), greatest, "{n:?}");
        }
    }
}
