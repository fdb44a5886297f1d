//! Numbers of many spheres in columns, generated for one piece of a row at a time.

use crate::Error;
use cannonpile::Interrupt;
use cannonpile::lattice::Row;

/// The maximal number of spheres computed at once.
const PIECE: i128 = 1024;

/// Returns the concatenated results of `make` for all pieces of the rows.
pub(crate) fn in_pieces<T>(
    rows: impl Iterator<Item = Row>,
    mut make: impl FnMut(&Row) -> Result<Vec<T>, Error>,
) -> impl Iterator<Item = Result<T, Error>> {
    let pieces = rows.flat_map(|row| row.pieces(PIECE));
    pieces.flat_map(move |piece| {
        match Interrupt::check()
            .map_err(Error::from)
            .and_then(|()| make(&piece))
        {
            Ok(made) => made.into_iter().map(Ok).collect(),
            Err(error) => vec![Err(error)],
        }
    })
}

/// Returns three columns with one entry per sphere of a piece.
///
/// # Errors
/// [`Error::TooLarge`](cannonpile::Error::TooLarge) for a row that is longer than any piece.
pub(crate) fn columns<F: Clone + Default>(piece: &Row) -> Result<[Vec<F>; 3], Error> {
    let spheres = piece.length()?;
    Ok([(); 3].map(|()| vec![F::default(); spheres]))
}

/// Returns the slices of three columns.
pub(crate) fn slices<F>(columns: &mut [Vec<F>; 3]) -> [&mut [F]; 3] {
    columns.each_mut().map(Vec::as_mut_slice)
}
