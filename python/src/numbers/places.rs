//! Writes columns by sphere and by direction into the entries of a slice.

use core::slice::IterMut;

use cannonpile::lattice::Row;
use cannonpile::shape::Rows;

/// The maximal number of spheres computed at once.
const PIECE: i128 = 1024;

/// Splits rows into pieces of at most [`PIECE`] spheres.
pub(super) fn pieces(rows: Rows<'_>) -> impl Iterator<Item = Row> {
    rows.flat_map(|row| row.pieces(PIECE))
}

/// Returns three columns with one entry per sphere.
pub(super) fn columns(spheres: usize) -> [Vec<f64>; 3] {
    [(); 3].map(|()| vec![0.0; spheres])
}

/// Returns the slices of three columns.
pub(super) fn slices<V>(columns: &mut [Vec<V>; 3]) -> [&mut [V]; 3] {
    columns.each_mut().map(Vec::as_mut_slice)
}

/// Writes to the next entry.
pub(super) fn put<V>(places: &mut IterMut<'_, V>, value: V) {
    if let Some(place) = places.next() {
        *place = value;
    }
}

/// Writes vectors sphere by sphere from the columns x, y, z: one vector per sphere, or one per contact direction.
pub(super) fn put_vectors(directions: &[[Vec<f64>; 3]], places: &mut IterMut<'_, [f64; 3]>) {
    let spheres = directions.first().map_or(0, |[x, ..]| x.len());
    for sphere in 0..spheres {
        for columns in directions {
            // All columns have the length of this row.
            put(places, columns.each_ref().map(|column| column[sphere]));
        }
    }
}

/// Writes one number per contact, sphere by sphere, from one column per direction.
pub(super) fn put_by_direction<V: Clone>(directions: &[Vec<V>], places: &mut IterMut<'_, V>) {
    let spheres = directions.first().map_or(0, Vec::len);
    for sphere in 0..spheres {
        for value in directions.iter().filter_map(|column| column.get(sphere)) {
            put(places, value.clone());
        }
    }
}
