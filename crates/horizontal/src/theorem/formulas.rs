//! The formulas that the theorems use. A test can replace each of them by a mutant.

use cannonpile::lattice::{Direction, Sign};
use cannonpile::scalar::{Algebra, Polynomial};
use cannonpile::theorem::Library;

use crate::formula;

/// Values by direction: α, β, γ.
type Three<P> = [P; 3];

/// The formulas of horizontal contacts and those of the core, as functions on a scalar `P`.
///
/// With polynomials they prove the theorems. Any other scalar that is its own ring of numerators works as well.
/// [`LIBRARY`](Self::LIBRARY) contains exactly the functions that this crate calls for its results.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::theorem;
/// use cannonpile_horizontal::theorem::Formulas;
///
/// // A wrong bound for the corner.
/// let wrong: Formulas = Formulas {
///     least_on_corner: |k| k.clone() + k,
///     ..Formulas::LIBRARY
/// };
/// let corner = theorem::all().find(|theorem| theorem.name == "corner-least").unwrap();
/// assert!(corner.prove().holds() && !corner.prove_for(&wrong).holds());
/// ```
#[derive(Debug)]
pub struct Formulas<P = Polynomial> {
    /// The formulas of the core.
    pub core: cannonpile::theorem::Formulas<P>,
    /// [`formula::contact_drop`].
    pub contact_drop: fn(P, &P) -> P,
    /// [`formula::compression`].
    pub compression: fn(&Three<P>, &Three<P>, [Direction; 2], Sign) -> P,
    /// [`formula::elastic_field`].
    pub elastic_field: fn(&P, &P) -> P,
    /// [`formula::corner_field`].
    pub corner_field: fn(Direction, bool) -> Three<P>,
    /// [`formula::least_on_corner`].
    pub least_on_corner: fn(&P) -> P,
    /// [`formula::greatest_on_corner`].
    pub greatest_on_corner: fn(&P) -> P,
    /// [`formula::greatest_inside`].
    pub greatest_inside: fn(&Three<P>) -> P,
    /// [`formula::greatest_on_edge`].
    pub greatest_on_edge: fn(&P, &P, &P) -> P,
    /// [`formula::arch`].
    pub arch: fn(&Three<P>) -> Three<P>,
}

// Derived implementations would require `P: Copy`.
impl<P> Clone for Formulas<P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P> Copy for Formulas<P> {}

impl<P: Algebra<Numerator = P>> Formulas<P> {
    /// The functions that this crate calls for its results.
    pub const LIBRARY: Self = Self {
        core: cannonpile::theorem::Formulas::LIBRARY,
        contact_drop: formula::contact_drop,
        compression: formula::compression,
        elastic_field: formula::elastic_field,
        corner_field: formula::corner_field,
        least_on_corner: formula::least_on_corner,
        greatest_on_corner: formula::greatest_on_corner,
        greatest_inside: formula::greatest_inside,
        greatest_on_edge: formula::greatest_on_edge,
        arch: formula::arch,
    };
}

impl<P: Algebra<Numerator = P>> Library for Formulas<P> {
    const LIBRARY: Self = Self::LIBRARY;
}
