//! The formulas of the theorems of all crates.

use cannonpile::scalar::{Algebra, Polynomial};
use cannonpile::theorem::Library;

/// The formulas of the core, of horizontal contacts and of random stackings, as functions on a scalar `P` that is
/// its own ring of numerators.
///
/// The formulas of the core occur twice. [`Theorem::prove_for`](crate::Theorem::prove_for) and
/// [`files_of`](crate::files_of) use those in `horizontal` for the theorems of the core.
///
/// # Examples
/// ```
/// use cannonpile_proof::{Expression, Formulas};
/// use num_traits::One;
///
/// let library = Formulas::<Expression>::LIBRARY;
/// let greatest = (library.horizontal.greatest_on_corner)(&Expression::one());
/// assert_eq!(greatest, Expression::one());
/// ```
#[derive(Debug)]
pub struct Formulas<P = Polynomial> {
    /// The formulas of horizontal contacts, and those of the core.
    pub horizontal: cannonpile_horizontal::theorem::Formulas<P>,
    /// The formulas of random stackings, and those of the core.
    pub disorder: cannonpile_disorder::theorem::Formulas<P>,
}

// A derived implementation would require `P: Clone`.
impl<P> Clone for Formulas<P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P> Copy for Formulas<P> {}

impl<P: Algebra<Numerator = P>> Formulas<P> {
    /// The functions that the library calls for its results.
    pub const LIBRARY: Self = Self {
        horizontal: Library::LIBRARY,
        disorder: Library::LIBRARY,
    };
}

impl<P: Algebra<Numerator = P>> Library for Formulas<P> {
    const LIBRARY: Self = Self::LIBRARY;
}
