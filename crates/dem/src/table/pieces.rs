//! Numbers of many spheres in columns, generated for one piece of a row at a time.

use std::vec;

use crate::{Each, Error};
use cannonpile::Interrupt;
use cannonpile::lattice::Row;
use cannonpile::shape::Rows;

/// The maximal number of spheres computed at once.
pub(crate) const PIECE: i128 = 1024;

/// Computes the results for a piece of a row.
type Make<'p, T> = Box<dyn FnMut(&Row) -> Result<Vec<T>, Error> + 'p>;

/// The concatenated results of a function for all pieces of some rows.
///
/// The function is boxed, so that the code is compiled once for each type of result. It is called once for each piece.
pub(crate) struct Pieces<'p, T> {
    next_piece: Box<dyn FnMut() -> Option<Row> + 'p>,
    make: Make<'p, T>,
    made: vec::IntoIter<T>,
}

/// Returns the concatenated results of `make` for all pieces of the rows.
pub(crate) fn in_pieces<'p, T>(
    rows: Rows<'p>,
    make: impl FnMut(&Row) -> Result<Vec<T>, Error> + 'p,
) -> Pieces<'p, T> {
    let mut pieces = rows.flat_map(|row| row.pieces(PIECE));
    Pieces {
        next_piece: Box::new(move || pieces.next()),
        make: Box::new(make),
        made: Vec::new().into_iter(),
    }
}

impl<T> Iterator for Pieces<'_, T> {
    type Item = Result<T, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(made) = self.made.next() {
                return Some(Ok(made));
            }
            let piece = (self.next_piece)()?;
            let interrupt = Interrupt::check().map_err(Error::from);
            match interrupt.and_then(|()| (self.make)(&piece)) {
                Ok(made) => self.made = made.into_iter(),
                Err(error) => return Some(Err(error)),
            }
        }
    }
}

/// Returns three columns with one entry per sphere of a piece.
///
/// # Errors
/// [`Error::TooLarge`](cannonpile::Error::TooLarge) for a row that is longer than any piece.
pub(crate) fn columns<F: Clone + Default>(piece: &Row) -> Result<[Vec<F>; 3], Error> {
    let spheres = piece.length()?;
    Ok([(); 3].each(|()| vec![F::default(); spheres]))
}

/// Returns the slices of three columns.
pub(crate) fn slices<F>(columns: &mut [Vec<F>; 3]) -> [&mut [F]; 3] {
    columns.each_mut().each(Vec::as_mut_slice)
}
