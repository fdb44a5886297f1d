//! Functions that the generators share.

use arbitrary::{Error, Result, Unstructured};

/// Returns true once in `of` draws on average, and false if the bytes are exhausted.
///
/// # Errors
/// The errors of [`Unstructured`].
pub fn rarely(u: &mut Unstructured<'_>, of: u8) -> Result<bool> {
    let of = of.max(1);
    Ok(u.int_in_range(1..=of)? == of)
}

/// Converts an error of the library to one of the generator.
pub(super) fn valid<T>(made: core::result::Result<T, crate::Error>) -> Result<T> {
    made.map_err(|_| Error::IncorrectFormat)
}
