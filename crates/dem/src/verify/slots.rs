//! The contacts of a pile by the numbers of their spheres.

use crate::Error;
use crate::NumberedPile;
use crate::error::bug;

/// Where the contacts of a pile stand in the order of [`NumberedPile::contacts`].
///
/// Spheres above the floor are numbered one after another, and each touches as many below; along a row the numbers of both
/// follow each other. So a contact is found from the row of its upper sphere, without a table of contacts.
pub(super) struct Slots {
    rows: Vec<Row>,
    /// How many spheres below a sphere touches.
    below: usize,
    sloping: usize,
    /// The pairs of the horizontal contacts with a force, sorted, and where they stand.
    horizontal: Vec<([u64; 2], usize)>,
}

/// The number of the first sphere of a row, how many there are, and the numbers of those below the first.
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

    /// Returns how many contacts there are.
    pub(super) fn len(&self) -> usize {
        self.sloping + self.horizontal.len()
    }

    /// Returns where the contact of two spheres stands, the one with the lesser number first.
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

/// The lesser number first.
fn sorted([one, other]: [u64; 2]) -> [u64; 2] {
    [one.min(other), one.max(other)]
}
