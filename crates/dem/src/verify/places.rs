//! The spheres of a pile, found by position.

use core::num::NonZero;

use kiddo::{ImmutableKdTree, SquaredEuclidean};

use super::entry::{Force, Place};
use super::measured::{MAX_ENTRIES, Measured, norm};
use super::refusal::{Fault, Refusal};
use crate::Error;
use crate::NumberedPile;
use crate::error::bug;
use crate::vector::{dot, minus};
use cannonpile::engine::refuse_beyond_memory;

/// The centres of all spheres of a pile, in a k-d tree.
pub(super) struct Places {
    tree: ImmutableKdTree<f64, 3>,
    centres: Vec<[f64; 3]>,
    first_on_floor: u64,
    radius: f64,
}

/// A contact that was found by its position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Found {
    /// The contact of two spheres with these numbers.
    Spheres([u64; 2]),
    /// The contact of a bottom sphere with the floor.
    Floor {
        sphere: u64,
        /// True if the row names the floor first, and the sphere second.
        is_second: bool,
    },
}

/// The memory of a centre, its copy in the tree, and its index there.
const BYTES_A_SPHERE: usize = size_of::<[f64; 6]>() + size_of::<u64>();

const TWO: NonZero<usize> = NonZero::<usize>::MIN.saturating_add(1);

impl Places {
    pub(super) fn new(pile: &NumberedPile<'_>, radius: f64) -> Result<Self, Refusal> {
        refuse_beyond_memory(
            "the centres of all spheres",
            &pile.numbering().sphere_count().into(),
            (MAX_ENTRIES, BYTES_A_SPHERE),
            "use fewer layers, or a smaller top or base",
        )?;
        let mut centres = Vec::new();
        for centre in pile.centres()? {
            let (_, centre) = centre?;
            centres.push(centre);
        }
        let tree = ImmutableKdTree::new_from_slice(&centres);
        Ok(Self {
            tree,
            centres,
            first_on_floor: pile.numbering().first_on_floor(),
            radius,
        })
    }

    /// Returns the contact at a position. Each sphere must be within this distance of its exact position.
    pub(super) fn find(&self, place: &Place, within: f64) -> Result<Found, Fault> {
        let (found, off) = self.nearest(place, within);
        found.ok_or_else(|| Fault::NoSphereAt {
            point: place.point(),
            within: within / self.radius,
            nearest: off / self.radius,
        })
    }

    /// Returns the contact at a position, if its spheres are within a distance of their exact positions, and the
    /// distance of the one that is farther off.
    pub(super) fn nearest(&self, place: &Place, within: f64) -> (Option<Found>, f64) {
        match place {
            Place::Centres([first, second]) => {
                let [one, other] = [first, second].map(|centre| self.sphere(*centre));
                let off = one.1.max(other.1);
                if off <= within {
                    return (Some(Found::Spheres([one.0, other.0])), off);
                }
                let floor = |is_second, (sphere, off): (u64, f64), below| {
                    let depths = [self.radius, 2.0 * self.radius];
                    let off = off.max(self.off_floor(sphere, below, depths)?);
                    (off <= within).then_some((Some(Found::Floor { sphere, is_second }), off))
                };
                let found = floor(false, one, *second).or_else(|| floor(true, other, *first));
                // Without a contact, the distance is that from the nearest spheres.
                found.unwrap_or((None, off))
            }
            Place::Point(point) => {
                let two = self.tree.nearest_n::<SquaredEuclidean>(point, TWO);
                // The centres are one radius from the contact point.
                let off = |distance: f64| (distance.sqrt() - self.radius).abs();
                let [one, other] = two[..] else {
                    return (None, f64::INFINITY);
                };
                let [sphere, second] = [one.item + 1, other.item + 1];
                let off = off(one.distance).max(off(other.distance));
                if off <= within {
                    let ids = [sphere.min(second), sphere.max(second)];
                    return (Some(Found::Spheres(ids)), off);
                }
                match self.off_floor(sphere, *point, [self.radius; 2]) {
                    Some(off) if off <= within => {
                        let is_second = false;
                        (Some(Found::Floor { sphere, is_second }), off)
                    }
                    _ => (None, off),
                }
            }
        }
    }

    /// Returns the number of the sphere nearest to a point, and the distance of its centre.
    fn sphere(&self, point: [f64; 3]) -> (u64, f64) {
        let nearest = self.tree.nearest_one::<SquaredEuclidean>(&point);
        (nearest.item + 1, nearest.distance.sqrt())
    }

    /// Returns the distance of a point from the vertical line between two depths below the centre of a bottom sphere.
    fn off_floor(&self, sphere: u64, point: [f64; 3], [least, most]: [f64; 2]) -> Option<f64> {
        if sphere < self.first_on_floor {
            return None;
        }
        let [x, y, depth] = minus(self.centre(sphere).ok()?, point);
        Some(norm([x, y, depth - depth.max(least).min(most)]))
    }
}

impl Places {
    /// Returns the force between two spheres that were found by position, with its vector on the first sphere.
    ///
    /// The force is compressive if its vector points from the second sphere to the first.
    pub(super) fn on_first(&self, force: Force, ids: [u64; 2]) -> Result<Measured, Error> {
        Ok(match force {
            Force::Vector(vector) => {
                let along = self.along(vector, ids)?;
                Measured {
                    force: norm(vector).copysign(along),
                    ..Measured::of_vector(ids, vector)
                }
            }
            Force::Along(_) | Force::Both(..) => force.between(ids),
        })
    }

    /// Returns the force between two spheres that were found by their contact point. A compressive vector acts on the
    /// sphere that it pushes away from the contact. A tensile vector acts on the sphere that it pulls towards the
    /// contact.
    pub(super) fn on_either(&self, force: Force, ids: [u64; 2]) -> Result<Measured, Error> {
        let (force, vector, is_length) = match force {
            Force::Along(_) => return Ok(force.between(ids)),
            Force::Vector(vector) => (norm(vector), vector, true),
            Force::Both(force, vector) => (force, vector, false),
        };
        let [first, second] = ids;
        let is_turned = (self.along(vector, ids)? < 0.0) != (force < 0.0);
        let ids = if is_turned { [second, first] } else { ids };
        let measured = Measured::new(ids, force).with_vector(vector);
        Ok(Measured {
            is_length,
            ..measured
        })
    }

    /// Returns the component of a vector from the second of two spheres towards the first, times their distance.
    fn along(&self, vector: [f64; 3], ids: [u64; 2]) -> Result<f64, Error> {
        let [first, second] = self.centres_of(ids)?;
        Ok(dot(vector, minus(first, second)))
    }

    /// Returns the exact centres of two spheres.
    pub(super) fn centres_of(&self, ids: [u64; 2]) -> Result<[[f64; 3]; 2], Error> {
        let [one, other] = ids;
        Ok([self.centre(one)?, self.centre(other)?])
    }

    pub(super) fn centre(&self, id: u64) -> Result<[f64; 3], Error> {
        let place = id.checked_sub(1).and_then(|id| usize::try_from(id).ok());
        let centre = place.and_then(|place| self.centres.get(place)).copied();
        centre.ok_or_else(|| bug("a sphere that was found is one of the pile"))
    }

    /// Returns the numbers of the bottom spheres.
    pub(super) fn on_floor(&self) -> impl Iterator<Item = u64> {
        (self.first_on_floor..).take_while(|id| *id <= self.centres.len() as u64)
    }
}
