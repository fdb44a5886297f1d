//! The largest normal force of a bottom sphere on an edge of a straight pile: horizontal forces that attain it.

use std::collections::BTreeMap;

use cannonpile::lattice::HorizontalContact;
use num_rational::BigRational;
use num_traits::Zero;

use crate::straight::{Straight, by_direction};

/// A bottom sphere (a, b, 0) with a ≥ b ≥ 1 of a straight pile of equal spheres under one sphere. Its coordinates
/// are sorted.
///
/// Each horizontal force acts on a sphere of the face of the pile that contains the edge: the spheres (x, y, 0). It is
/// not a theorem that the forces attain the bound, so every certificate is checked.
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

    fn coordinates(&self, sphere: [i128; 3]) -> [i128; 3] {
        by_direction(self.directions, sphere)
    }
}
