//! The index of each contact of a pile, found by the numbers of its two spheres.

use crate::Error;
use crate::NumberedPile;
use crate::error::bug;

/// The index of each contact in the order of [`NumberedPile::contacts`].
///
/// Spheres above the floor have consecutive numbers, and each touches the same number of spheres below. Along a row,
/// the numbers of both spheres of a contact increase together. So the row of the upper sphere determines the index,
/// without a table of contacts.
pub(super) struct Slots {
    rows: Vec<Row>,
    /// The number of contacts of a sphere with the layer below.
    below: usize,
    sloping: usize,
    /// The pairs of the horizontal contacts with a force, sorted, with their indices.
    horizontal: Vec<([u64; 2], usize)>,
}

/// A row: the number of its first sphere, its length, and the numbers of the spheres below the first one.
struct Row {
    upper: u64,
    spheres: u64,
    below: [u64; 3],
}

impl Slots {
    pub(super) fn new(pile: &NumberedPile<'_>) -> Result<Self, Error> {
        let (mut rows, mut sloping, mut directions) = (Vec::new(), 0_u64, 0);
        for row in pile.linked_rows()? {
            let row = row?;
            directions = row.below.len();
            sloping += row.spheres * directions as u64;
            let mut below = [0; 3];
            for (place, (_, id)) in below.iter_mut().zip(&row.below) {
                *place = *id;
            }
            rows.push(Row {
                upper: row.upper,
                spheres: row.spheres,
                below,
            });
        }
        let sloping = usize::try_from(sloping)
            .map_err(|_| bug("contacts that are compared fit in memory"))?;
        let mut horizontal = Vec::new();
        for (contact, place) in pile.horizontal().zip(sloping..) {
            horizontal.push((sorted(contact?.ids), place));
        }
        horizontal.sort_unstable();
        Ok(Self {
            rows,
            below: directions,
            sloping,
            horizontal,
        })
    }

    /// Returns the number of contacts.
    pub(super) fn len(&self) -> usize {
        self.sloping + self.horizontal.len()
    }

    /// Returns the index of the contact between two spheres. The smaller number comes first.
    pub(super) fn find(&self, ids: [u64; 2]) -> Option<usize> {
        let [upper, lower] = ids;
        let after = self.rows.partition_point(|row| row.upper <= upper);
        let row = after.checked_sub(1).and_then(|row| self.rows.get(row));
        let sloping = row.and_then(|row| {
            let along = upper - row.upper;
            let first = lower.checked_sub(along)?;
            let mut below = row.below.iter().take(self.below);
            let direction = below.position(|id| *id == first)?;
            let place = usize::try_from(upper - 1).ok()? * self.below + direction;
            (along < row.spheres).then_some(place)
        });
        sloping.or_else(|| {
            let place = self.horizontal.binary_search_by_key(&ids, |(ids, _)| *ids);
            let (_, place) = self.horizontal.get(place.ok()?)?;
            Some(*place)
        })
    }
}

/// Returns the two numbers, the smaller first.
fn sorted([one, other]: [u64; 2]) -> [u64; 2] {
    [one.min(other), one.max(other)]
}
