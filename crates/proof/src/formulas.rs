//! The formulas in the theorems: of the core, of horizontal contacts and of random stackings.

use cannonpile::lattice::{Direction, Sign};
use cannonpile::scalar::{Algebra, Polynomial};
use cannonpile::theorem::Library;

/// Values by direction: α, β, γ.
type Three<P> = [P; 3];

/// The formulas of the core, of horizontal contacts and of random stackings, as functions on a scalar `P` that is
/// its own ring of numerators.
///
/// With polynomials they prove the theorems. [`LIBRARY`](Self::LIBRARY) has the functions that the library calls for its
/// results. A test checks this in the source code.
///
/// # Examples
/// ```
/// use cannonpile_proof::{Expression, Formulas};
/// use num_traits::One;
///
/// let library = Formulas::<Expression>::LIBRARY;
/// assert_eq!((library.greatest_on_corner)(&Expression::one()), Expression::one());
/// ```
#[derive(Debug)]
pub struct Formulas<P = Polynomial> {
    /// The formulas of the core.
    pub core: cannonpile::theorem::Formulas<P>,
    /// [`contact_drop`](cannonpile_horizontal::formula::contact_drop).
    pub contact_drop: fn(P, &P) -> P,
    /// [`compression`](cannonpile_horizontal::formula::compression).
    pub compression: fn(&Three<P>, &Three<P>, [Direction; 2], Sign) -> P,
    /// [`elastic_field`](cannonpile_horizontal::formula::elastic_field).
    pub elastic_field: fn(&P, &P) -> P,
    /// [`corner_field`](cannonpile_horizontal::formula::corner_field).
    pub corner_field: fn(Direction, bool) -> Three<P>,
    /// [`least_on_corner`](cannonpile_horizontal::formula::least_on_corner).
    pub least_on_corner: fn(&P) -> P,
    /// [`greatest_on_corner`](cannonpile_horizontal::formula::greatest_on_corner).
    pub greatest_on_corner: fn(&P) -> P,
    /// [`greatest_inside`](cannonpile_horizontal::formula::greatest_inside).
    pub greatest_inside: fn(&Three<P>) -> P,
    /// [`greatest_on_edge`](cannonpile_horizontal::formula::greatest_on_edge).
    pub greatest_on_edge: fn(&P, &P, &P) -> P,
    /// [`arch`](cannonpile_horizontal::formula::arch).
    pub arch: fn(&Three<P>) -> Three<P>,
    /// [`third_moment`](cannonpile_disorder::formula::third_moment).
    pub third_moment: fn(&P, &P) -> P,
    /// [`fourth_moment`](cannonpile_disorder::formula::fourth_moment).
    pub fourth_moment: fn(&P) -> P,
    /// [`fourth_moment_of_pair`](cannonpile_disorder::formula::fourth_moment_of_pair).
    pub fourth_moment_of_pair: fn(&P, &P, &P) -> P,
    /// [`mean_third_moment`](cannonpile_disorder::formula::mean_third_moment).
    pub mean_third_moment: fn(&P, &P, &P) -> P,
    /// [`mean_fourth_moment_of_pairs`](cannonpile_disorder::formula::mean_fourth_moment_of_pairs).
    pub mean_fourth_moment_of_pairs: fn(&P, &P, &P) -> P,
    /// [`wave`](cannonpile_disorder::formula::wave).
    pub wave: fn(&P) -> [P; 2],
    /// [`registry_excess`](cannonpile_disorder::formula::registry_excess).
    pub registry_excess: fn(&P, &P, &P) -> P,
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
        core: cannonpile::theorem::Formulas::LIBRARY,
        contact_drop: cannonpile_horizontal::formula::contact_drop,
        compression: cannonpile_horizontal::formula::compression,
        elastic_field: cannonpile_horizontal::formula::elastic_field,
        corner_field: cannonpile_horizontal::formula::corner_field,
        least_on_corner: cannonpile_horizontal::formula::least_on_corner,
        greatest_on_corner: cannonpile_horizontal::formula::greatest_on_corner,
        greatest_inside: cannonpile_horizontal::formula::greatest_inside,
        greatest_on_edge: cannonpile_horizontal::formula::greatest_on_edge,
        arch: cannonpile_horizontal::formula::arch,
        third_moment: cannonpile_disorder::formula::third_moment,
        fourth_moment: cannonpile_disorder::formula::fourth_moment,
        fourth_moment_of_pair: cannonpile_disorder::formula::fourth_moment_of_pair,
        mean_third_moment: cannonpile_disorder::formula::mean_third_moment,
        mean_fourth_moment_of_pairs: cannonpile_disorder::formula::mean_fourth_moment_of_pairs,
        wave: cannonpile_disorder::formula::wave,
        registry_excess: cannonpile_disorder::formula::registry_excess,
    };
}

impl<P: Algebra<Numerator = P>> Library for Formulas<P> {
    const LIBRARY: Self = Self::LIBRARY;
}
