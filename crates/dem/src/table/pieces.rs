//! Numbers of many spheres, a piece of a row at a time, in columns.

use crate::Error;
use cannonpile::Interrupt;
use cannonpile::lattice::Row;

/// The most spheres whose numbers are made at once.
const PIECE: i128 = 1024;

/// All that `make` makes of pieces of rows of spheres.
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

/// Returns three columns with a place for each sphere of a piece.
///
/// # Errors
/// [`Error::TooLarge`](cannonpile::Error::TooLarge) for what is longer than any piece.
pub(crate) fn columns<F: Clone + Default>(piece: &Row) -> Result<[Vec<F>; 3], Error> {
    let spheres = piece.length()?;
    Ok([(); 3].map(|()| vec![F::default(); spheres]))
}

/// The slices of three columns.
pub(crate) fn slices<F>(columns: &mut [Vec<F>; 3]) -> [&mut [F]; 3] {
    columns.each_mut().map(Vec::as_mut_slice)
}
