//! Closed forms for the bottom spheres of straight piles.

use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::lattice::{Axis, Dimension, Direction, HorizontalContact, Site, count};
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::{Each, formula};

/// The lower or the upper bound.
#[derive(Clone, Copy)]
pub(crate) enum End {
    Least,
    Greatest,
}

/// A bottom sphere of a straight pile of equal spheres under one sphere.
///
/// A site has coordinates n = (k−i−j, i, j) for + steps and (k+i+j, −i, −j) for − steps. K = L−1 is the layer of
/// the floor.
#[derive(Clone, Copy)]
pub(crate) struct Straight {
    /// σ of all steps.
    sigma: i128,
    /// The coordinates of the bottom sphere.
    n: [i128; 3],
    k: i128,
}

impl Straight {
    pub(crate) fn of(pile: &Pile, Site { i, j, k }: Site) -> Option<Self> {
        let is_special = pile.is_paper_pile() && pile.dimension() == Dimension::Three;
        let sigma = factor_of(pile);
        is_special.then_some(Self {
            sigma,
            n: count::above(&(sigma * i), &(sigma * j), &k),
            k,
        })
    }

    /// Returns the direction of the edge that leads to this corner, or `None` if the sphere is not at a corner.
    fn corner(self) -> Option<usize> {
        self.n.iter().position(|n| *n == self.k)
    }

    /// Returns the coordinates n_A ≥ n_B ≥ n_C and their directions A, B and C.
    pub(crate) fn sorted(self) -> ([i128; 3], [usize; 3]) {
        let mut directions = [0, 1, 2];
        directions.sort_by_key(|l| core::cmp::Reverse(self.n[*l]));
        (directions.each(|l| self.n[l]), directions)
    }

    /// Returns the bound in mg if a formula gives it and it is attained for every K.
    pub(crate) fn bound(self, end: End) -> Option<BigRational> {
        let k = BigRational::from_integer(self.k.into());
        let onto = match (self.corner(), end) {
            (Some(_), End::Least) => formula::least_on_corner(&k),
            (Some(_), End::Greatest) if self.k > 0 => formula::greatest_on_corner(&k),
            (Some(_), End::Greatest) | (None, End::Least) => BigRational::zero(),
            (None, End::Greatest) => return None,
        };
        Some(normal_below(onto))
    }

    /// Returns an upper bound on an edge or inside the base, in mg, for every K. It may not be attained.
    pub(crate) fn outer_bound(self) -> BigRational {
        let (sorted, _) = self.sorted();
        let n = sorted.each(|n| BigRational::from_integer(n.into()));
        let onto = match (sorted, &n) {
            ([a, b, 0], [k, j, _]) => {
                let c = BigRational::from_integer(a.min(b + 1).into());
                formula::greatest_on_edge(k, j, &c)
            }
            _ => formula::greatest_inside(&n),
        };
        normal_below(onto)
    }

    /// Returns horizontal forces X that attain the bound.
    pub(crate) fn forces(self, end: End) -> BTreeMap<HorizontalContact, BigRational> {
        match (self.corner(), end) {
            (Some(l), End::Greatest) => self.press(l),
            (Some(_), End::Least) => BTreeMap::new(),
            (None, _) => self.arch(),
        }
    }

    /// Returns X = 1 between each sphere of the edge to a corner and its neighbours.
    fn press(self, l: usize) -> BTreeMap<HorizontalContact, BigRational> {
        let mut forces = BTreeMap::new();
        for t in 1..self.k {
            for other in [(l + 1) % 3, (l + 2) % 3] {
                let on_edge = along(l, t);
                let mut beside = on_edge;
                beside[l] -= 1;
                beside[other] += 1;
                let contact = self.contact(on_edge, beside);
                forces.extend(contact.map(|contact| (contact, BigRational::one())));
            }
        }
        forces
    }

    /// Returns the arch that completely unloads a sphere inside the base or on an edge.
    ///
    /// For n_A ≥ n_B ≥ n_C and r = min(n_A, n_B + n_C), the spheres (t, n_B, n_C) with t < n_A − r press on (t+1,
    /// n_B−1, n_C) with X = 1. The three spheres that touch n from above press on each other.
    fn arch(self) -> BTreeMap<HorizontalContact, BigRational> {
        let ([n_a, n_b, n_c], [a, b, c]) = self.sorted();
        let r = n_a.min(n_b + n_c);
        let mut forces = BTreeMap::new();
        let mut add = |one: [i128; 3], other: [i128; 3], force: BigRational| {
            if let Some(contact) = self.contact(one, other) {
                *forces.entry(contact).or_insert_with(BigRational::zero) += force;
            }
        };
        for t in 0..n_a - r {
            let mut one = self.n;
            one[a] = t;
            let mut other = one;
            other[a] += 1;
            other[b] -= 1;
            add(one, other, BigRational::one());
        }
        let nu = [r, n_b, n_c].each(|n| BigRational::from_integer(n.into()));
        for ([l, m], force) in [[b, c], [c, a], [a, b]].into_iter().zip(formula::arch(&nu)) {
            let (mut one, mut other) = (self.n, self.n);
            one[l] -= 1;
            other[m] -= 1;
            if !force.is_zero() {
                add(one, other, force);
            }
        }
        forces
    }

    /// Returns the field φ that proves the bound.
    pub(crate) fn field(self, end: End) -> BTreeMap<Site, [BigRational; 3]> {
        let Some(l) = self.corner() else {
            return BTreeMap::new();
        };
        let mut field = BTreeMap::new();
        for t in 0..self.k {
            let all = matches!(end, End::Greatest) && t > 0;
            let of_sphere = formula::corner_field(Direction::ALL[l], all);
            field.insert(self.site(along(l, t)), of_sphere);
        }
        field
    }

    pub(crate) fn site(self, [a, i, j]: [i128; 3]) -> Site {
        let [i, j, k] = [self.sigma * i, self.sigma * j, a + i + j];
        Site { i, j, k }
    }

    /// Returns the horizontal contact of two neighbours.
    pub(crate) fn contact(self, one: [i128; 3], other: [i128; 3]) -> Option<HorizontalContact> {
        let (one, other) = (self.site(one), self.site(other));
        for (site, to) in [(one, other), (other, one)] {
            for axis in Axis::ALL {
                let contact = HorizontalContact { site, axis };
                if contact.neighbour() == Some(to) {
                    return Some(contact);
                }
            }
        }
        None
    }
}

/// Returns σ of the steps of a straight pile, or 1 without steps. The sites of a pile of − steps, times σ, are
/// those of + steps.
pub(crate) fn factor_of(pile: &Pile) -> i128 {
    let sign = pile.shape().sign_below(0);
    // A single sphere has no step, so either sign is correct.
    sign.map_or(1, |sign| sign.factor().into())
}

/// Returns the normal force 1 + G/3 in mg, from the load G on a bottom sphere in f₀.
pub(crate) fn normal_below(onto: BigRational) -> BigRational {
    BigRational::one() + onto / BigRational::from_integer(3.into())
}

/// Returns values in the order of the directions α, β, γ. They are given in the order of `directions`.
pub(crate) fn by_direction<V: Copy + Default>(directions: [usize; 3], values: [V; 3]) -> [V; 3] {
    let mut by_direction = [V::default(); 3];
    for (direction, value) in directions.into_iter().zip(values) {
        by_direction[direction] = value;
    }
    by_direction
}

/// Returns t times the unit vector of a direction.
fn along(l: usize, t: i128) -> [i128; 3] {
    let mut sphere = [0; 3];
    sphere[l] = t;
    sphere
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `onto` converts a load in f₀ to the normal force in mg. The corner of a single layer is its only sphere, without
    /// a load.
    #[test]
    fn bounds_at_corners_on_edges_and_inside() {
        let bound = |n: [i128; 3], end| {
            let k = n.iter().sum();
            let of = Straight { sigma: 1, n, k };
            of.bound(end)
        };
        let onto = |f: i64| Some(BigRational::new((f + 3).into(), 3.into()));
        for (n, least, greatest) in [
            ([0, 0, 0], onto(0), onto(0)),
            ([0, 1, 0], onto(1), onto(1)),
            ([9, 0, 0], onto(9), onto(25)),
            ([4, 5, 0], onto(0), None),
            ([3, 3, 3], onto(0), None),
        ] {
            assert_eq!(bound(n, End::Least), least, "{n:?}");
            assert_eq!(bound(n, End::Greatest), greatest, "{n:?}");
        }
    }
}
