//! The largest normal force of a bottom sphere on an edge of a straight pile: horizontal forces that attain the bound,
//! and a field that proves it.

use std::collections::BTreeMap;

use cannonpile::lattice::{HorizontalContact, Site};
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::straight::Straight;

/// A bottom sphere (a, b, 0) with a ≥ b ≥ 1 of a straight pile of equal spheres under one sphere. Its coordinates
/// are sorted.
///
/// The field is zero except on the face of the pile that contains the edge: the spheres (x, y, 0). Each horizontal
/// force acts on a sphere of this face. Optimality is not a theorem, so every certificate is checked before it is
/// returned.
pub(crate) struct Edge {
    straight: Straight,
    /// The directions of x, y and z.
    directions: [usize; 3],
    a: i128,
    b: i128,
    /// min(b + 1, a). The lines in direction y with x ≥ c transmit their full load to the bottom sphere.
    c: i128,
}

impl Edge {
    /// Returns the edge sphere of a problem, or `None` for a corner or a sphere inside the base.
    pub(crate) fn of(straight: Straight) -> Option<Self> {
        let (sorted, directions) = straight.sorted();
        match sorted {
            [a, b, 0] if b >= 1 => Some(Self {
                straight,
                directions,
                a,
                b,
                c: a.min(b + 1),
            }),
            _ => None,
        }
    }

    /// Returns the largest normal force of the sphere, in mg.
    pub(crate) fn bound(&self) -> BigRational {
        self.straight.outer_bound()
    }

    /// Returns the coordinates [x, y] of all spheres of the face above the bottom layer: x + y < a + b.
    fn face(&self) -> impl Iterator<Item = [i128; 2]> {
        let layers = self.a + self.b;
        (0..layers).flat_map(move |x| (0..layers - x).map(move |y| [x, y]))
    }

    /// Returns horizontal forces X that attain the bound.
    ///
    /// Along the face, sphere (x, y, 0) presses on (x−1, y+1, 0). In rows y ≥ b these forces transfer the load of the
    /// lines in direction x to row b. In columns x > a they transfer the load of the lines in direction y to column a.
    /// Some spheres also press with X = 1 on a neighbour behind the face, in direction x or y. This force keeps the
    /// remaining load within the face.
    pub(crate) fn forces(&self) -> BTreeMap<HorizontalContact, BigRational> {
        let mut forces = BTreeMap::new();
        for [x, y] in self.face() {
            let along = self.along([x, y]);
            let all = [([x - 1, y + 1, 0], along), self.behind([x, y])];
            for (other, force) in all {
                let contact = self
                    .straight
                    .contact(self.coordinates([x, y, 0]), self.coordinates(other));
                if let Some(contact) = contact.filter(|_| force > 0) {
                    *forces.entry(contact).or_insert_with(BigRational::zero) +=
                        BigRational::from_integer(force.into());
                }
            }
        }
        forces
    }

    /// Returns the horizontal force X between (x, y, 0) and (x−1, y+1, 0).
    fn along(&self, [x, y]: [i128; 2]) -> i128 {
        let above = y - self.b;
        if x >= 1 && above >= 0 {
            (2 * x - 1).min(2 * (self.b - above) + 1)
        } else if x > self.a {
            2 * y + 1
        } else {
            0
        }
    }

    /// Returns the neighbour of (x, y, 0) behind the face, and the horizontal force between the two.
    fn behind(&self, [x, y]: [i128; 2]) -> ([i128; 3], i128) {
        let (along_x, along_y) = ([x - 1, y, 1], [x, y - 1, 1]);
        let above = y - self.b;
        let (other, is_pushed) = if above > 0 {
            (along_x, x >= 1 && above <= self.b)
        } else if x >= self.c || (above < 0 && y <= 2 * x - 2 - self.b) {
            (along_y, y >= 1)
        } else {
            (along_x, x >= 1 && y >= 1)
        };
        (other, i128::from(is_pushed))
    }

    /// Returns the field φ that proves the bound.
    ///
    /// φ_x = 1 where the load of the line in direction x reaches the bottom sphere, and likewise φ_y. φ_z = 1 where no
    /// load leaves the face. All other components are 0.
    pub(crate) fn field(&self) -> BTreeMap<Site, [BigRational; 3]> {
        let mut field = BTreeMap::new();
        for [x, y] in self.face() {
            let along_x = y == self.b || (y > self.b && x + y - self.b < self.c);
            let along_y = x >= self.c && y <= self.b;
            let out = (along_x && x >= 1) || (along_y && y >= 1);
            let mut here = [(); 3].map(|()| BigRational::zero());
            for (direction, is_one) in self.directions.into_iter().zip([along_x, along_y, out]) {
                if let Some(phi) = here.get_mut(direction).filter(|_| is_one) {
                    *phi = BigRational::one();
                }
            }
            if along_x || along_y {
                field.insert(self.straight.site(self.coordinates([x, y, 0])), here);
            }
        }
        field
    }

    /// Returns the coordinates of a sphere in the order α, β, γ, from its sorted coordinates (x, y, z).
    fn coordinates(&self, [x, y, z]: [i128; 3]) -> [i128; 3] {
        let mut n = [0; 3];
        for (direction, value) in self.directions.into_iter().zip([x, y, z]) {
            if let Some(place) = n.get_mut(direction) {
                *place = value;
            }
        }
        n
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::{Certificate, Claim, Extreme};
    use cannonpile::Pile;

    #[test]
    fn edge_bounds_are_attained() {
        for layers in 3..=18_i128 {
            let (pile, k) = (Pile::triangular(layers).unwrap(), layers - 1);
            for b in 1..=k / 2 {
                let site = Site { i: b, j: 0, k };
                let edge = Edge::of(Straight::of(&pile, site).unwrap()).unwrap();
                let certificate = Certificate {
                    pile: pile.clone(),
                    claim: Claim::Greatest(Extreme {
                        site,
                        normal: edge.bound(),
                        attained: true,
                    }),
                    horizontal: edge.forces(),
                    field: edge.field(),
                };
                assert_eq!(certificate.check(), Ok(()), "{layers} layers, {b}");
            }
        }
    }
}
