//! The spheres of a pile, found by position.

use contact_tables::{Force, Place};

use super::measured::{MAX_ENTRIES, Measured, norm};
use super::refusal::{Fault, Refusal};
use crate::NumberedPile;
use crate::error::bug;
use crate::vector::{dot, minus};
use crate::{Each, Error};
use cannonpile::engine::refuse_beyond_memory;

/// The centres of all spheres of a pile, in a k-d tree.
pub(super) struct Places {
    tree: Vec<Numbered>,
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

/// The centre of a sphere, and the number of the sphere.
type Numbered = ([f64; 3], u64);

impl Places {
    pub(super) fn new(pile: &NumberedPile<'_>, radius: f64) -> Result<Self, Refusal> {
        refuse_beyond_memory(
            "the centres of all spheres",
            &pile.numbering().sphere_count().into(),
            (MAX_ENTRIES, BYTES_A_SPHERE),
            "use fewer layers, or a smaller top or base",
        )?;
        let centres = pile.centres()?.map(|centre| Ok(centre?.1));
        let centres: Vec<[f64; 3]> = centres.collect::<Result<_, Error>>()?;
        let mut tree: Vec<Numbered> = centres.iter().copied().zip(1..).collect();
        sort_into_tree(&mut tree, 0);
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
                let [one, other] = [first, second].each(|centre| self.spheres::<1>(*centre)[0]);
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
                // The centres are one radius from the contact point.
                let off = |distance: f64| (distance - self.radius).abs();
                let [(sphere, one), (second, other)] = self.spheres(*point);
                if other == f64::INFINITY {
                    return (None, other);
                }
                let off = off(one).max(off(other));
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

    /// Returns the numbers of the `N` spheres nearest to a point, and the distances of their centres. Missing spheres
    /// have the number 0 and an infinite distance.
    fn spheres<const N: usize>(&self, point: [f64; 3]) -> [(u64, f64); N] {
        let mut nearest = [(0, f64::INFINITY); N];
        search(&self.tree, 0, point, &mut nearest);
        nearest.map(|(sphere, square)| (sphere, square.sqrt()))
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

/// Sorts centres into a k-d tree: the median along `axis` is in the middle, and each half is a tree along the next axis.
fn sort_into_tree(centres: &mut [Numbered], axis: usize) {
    let middle = centres.len() / 2;
    if middle == 0 {
        return;
    }
    let (below, _, above) =
        centres.select_nth_unstable_by(middle, |(a, _), (b, _)| a[axis].total_cmp(&b[axis]));
    sort_into_tree(below, (axis + 1) % 3);
    sort_into_tree(above, (axis + 1) % 3);
}

/// Inserts the spheres of a k-d tree into a list of the nearest ones, with the squares of their distances.
fn search(tree: &[Numbered], axis: usize, point: [f64; 3], nearest: &mut [(u64, f64)]) {
    let (below, rest) = tree.split_at(tree.len() / 2);
    let Some(((centre, sphere), above)) = rest.split_first() else {
        return;
    };
    let off = minus(point, *centre);
    let square = dot(off, off);
    if let Some(place) = nearest.iter().position(|(_, best)| square < *best) {
        nearest[place..].rotate_right(1);
        nearest[place] = (*sphere, square);
    }
    let (near, far) = if off[axis] < 0.0 {
        (below, above)
    } else {
        (above, below)
    };
    search(near, (axis + 1) % 3, point, nearest);
    // A sphere beyond the dividing plane is at least as far as the plane.
    if nearest
        .last()
        .is_some_and(|(_, worst)| off[axis] * off[axis] < *worst)
    {
        search(far, (axis + 1) % 3, point, nearest);
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
            Force::Along(_) | Force::Both(..) => Measured::between(ids, force),
        })
    }

    /// Returns the force between two spheres that were found by their contact point. A compressive vector acts on the
    /// sphere that it pushes away from the contact. A tensile vector acts on the sphere that it pulls towards the
    /// contact.
    pub(super) fn on_either(&self, force: Force, ids: [u64; 2]) -> Result<Measured, Error> {
        let (force, vector, is_length) = match force {
            Force::Along(_) => return Ok(Measured::between(ids, force)),
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
