//! The spheres of a pile, found by position.

use core::num::NonZero;

use kiddo::{ImmutableKdTree, SquaredEuclidean};

use super::entry::{Force, Place};
use super::measured::{MAX_ENTRIES, Measured, norm};
use super::refusal::{Fault, Refusal};
use crate::Error;
use crate::NumberedPile;
use crate::error::bug;
use cannonpile::engine::refuse_beyond_memory;

/// The centres of all spheres of a pile, in a k-d tree.
pub(super) struct Places {
    tree: ImmutableKdTree<f64, 3>,
    centres: Vec<[f64; 3]>,
    radius: f64,
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
            radius,
        })
    }

    /// Returns the numbers of the two spheres that touch at a position. Each must be within this distance of its exact
    /// position.
    pub(super) fn find(&self, place: &Place, within: f64) -> Result<[u64; 2], Fault> {
        let (ids, off) = self.nearest(place);
        match ids {
            Some(ids) if off <= within => Ok(ids),
            _ => Err(Fault::NoSphereAt {
                point: match place {
                    Place::Centres(centres) => middle(centres),
                    Place::Point(point) => *point,
                },
                within: within / self.radius,
                nearest: off / self.radius,
            }),
        }
    }

    /// Returns the two spheres nearest to a position, and their greatest distance from their exact positions.
    pub(super) fn nearest(&self, place: &Place) -> (Option<[u64; 2]>, f64) {
        match place {
            Place::Centres(centres) => {
                let nearest = centres.map(|centre| {
                    let nearest = self.tree.nearest_one::<SquaredEuclidean>(&centre);
                    (nearest.item + 1, nearest.distance.sqrt())
                });
                let [(one, off), (other, more)] = nearest;
                (Some([one, other]), off.max(more))
            }
            Place::Point(point) => {
                let two = self.tree.nearest_n::<SquaredEuclidean>(point, TWO);
                // The centres are one radius from the contact point.
                let off = |distance: f64| (distance.sqrt() - self.radius).abs();
                match two[..] {
                    [one, other] => {
                        let [a, b] = [one.item + 1, other.item + 1];
                        let off = off(one.distance).max(off(other.distance));
                        (Some([a.min(b), a.max(b)]), off)
                    }
                    _ => (None, f64::INFINITY),
                }
            }
        }
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
                Measured::new(ids, norm(vector).copysign(along)).with_vector(vector)
            }
            Force::Along(_) | Force::Both(..) => force.between(ids),
        })
    }

    /// Returns the force between two spheres that were found by their contact point. A compressive vector acts on the
    /// sphere that it pushes away from the contact. A tensile vector acts on the sphere that it pulls towards the
    /// contact.
    pub(super) fn on_either(&self, force: Force, ids: [u64; 2]) -> Result<Measured, Error> {
        let (force, vector) = match force {
            Force::Along(_) => return Ok(force.between(ids)),
            Force::Vector(vector) => (norm(vector), vector),
            Force::Both(force, vector) => (force, vector),
        };
        let [first, second] = ids;
        let is_turned = (self.along(vector, ids)? < 0.0) != (force < 0.0);
        let ids = if is_turned { [second, first] } else { ids };
        Ok(Measured::new(ids, force).with_vector(vector))
    }

    /// Returns the component of a vector from the second of two spheres towards the first, times their distance.
    fn along(&self, vector: [f64; 3], ids: [u64; 2]) -> Result<f64, Error> {
        let [first, second] = self.centres_of(ids)?;
        let apart = minus(first, second);
        Ok(vector.iter().zip(apart).map(|(f, n)| f * n).sum())
    }

    fn centres_of(&self, ids: [u64; 2]) -> Result<[[f64; 3]; 2], Error> {
        let centre = |id: u64| {
            let place = id.checked_sub(1).and_then(|id| usize::try_from(id).ok());
            let centre = place.and_then(|place| self.centres.get(place)).copied();
            centre.ok_or_else(|| bug("a sphere that was found is one of the pile"))
        };
        let [one, other] = ids;
        Ok([centre(one)?, centre(other)?])
    }

    /// Returns the exact point halfway between the two spheres that touch at a position.
    pub(super) fn point_of(&self, place: &Place, within: f64) -> Option<[f64; 3]> {
        let ids = self.find(place, within).ok()?;
        self.centres_of(ids).as_ref().map(middle).ok()
    }
}

/// Returns the points of all contacts with a force, halfway between their centres, and the magnitudes of all forces.
pub(super) fn loaded_points(pile: &NumberedPile<'_>) -> Result<(Vec<[f64; 3]>, Vec<f64>), Refusal> {
    let (mut points, mut forces) = (Vec::new(), Vec::new());
    for contact in pile.contacts().map_err(Refusal::of_forces)? {
        forces.push(contact.map_err(Refusal::of_forces)?.force.abs());
    }
    let greatest = forces.iter().copied().fold(0.0, f64::max);
    for (centres, force) in pile.links()?.zip(&forces) {
        if is_loaded(*force, greatest) {
            points.push(middle(&centres?));
        }
    }
    Ok((points, forces))
}

/// Returns whether a force is large enough to mark the position of a contact. If the greatest force is 0, every contact
/// counts.
pub(super) fn is_loaded(force: f64, greatest: f64) -> bool {
    force >= greatest * 1e-9
}

/// Returns the point halfway between two points.
pub(super) fn middle([[x, y, z], [u, v, w]]: &[[f64; 3]; 2]) -> [f64; 3] {
    [x.midpoint(*u), y.midpoint(*v), z.midpoint(*w)]
}

/// Returns a − b.
pub(super) fn minus([x, y, z]: [f64; 3], [u, v, w]: [f64; 3]) -> [f64; 3] {
    [x - u, y - v, z - w]
}
