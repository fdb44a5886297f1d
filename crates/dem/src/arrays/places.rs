//! Columns by sphere and by direction, into the places of an array.

use core::slice::IterMut;

use crate::Error;
use cannonpile::lattice::Row;
use cannonpile::shape::Rows;

/// The most spheres whose numbers are made at once.
const PIECE: i128 = 1024;

/// Pieces of rows.
pub(super) fn pieces(rows: Rows<'_>) -> impl Iterator<Item = Row> {
    rows.flat_map(|row| row.pieces(PIECE))
}

/// Errors unless there is a place for each number.
pub(super) fn check_length<V>(needed: usize, places: &[V]) -> Result<(), Error> {
    if places.len() == needed {
        return Ok(());
    }
    Err(cannonpile::Error::length(needed, places.len()).into())
}

/// Writes to the next place.
pub(super) fn put<V>(places: &mut IterMut<'_, V>, value: V) {
    if let Some(place) = places.next() {
        *place = value;
    }
}

/// Writes vectors, sphere by sphere, from columns x, y, z: one of each sphere, or one for each direction of its contacts.
pub(super) fn put_vectors(directions: &[[Vec<f64>; 3]], places: &mut IterMut<'_, [f64; 3]>) {
    let spheres = directions.first().map_or(0, |[x, ..]| x.len());
    for sphere in 0..spheres {
        for columns in directions {
            // All columns are of one row.
            put(places, columns.each_ref().map(|column| column[sphere]));
        }
    }
}

/// Writes the numbers of contacts, sphere by sphere, from a column for each direction.
pub(super) fn put_by_direction<V: Clone>(directions: &[Vec<V>], places: &mut IterMut<'_, V>) {
    let spheres = directions.first().map_or(0, Vec::len);
    for sphere in 0..spheres {
        for value in directions.iter().filter_map(|column| column.get(sphere)) {
            put(places, value.clone());
        }
    }
}
