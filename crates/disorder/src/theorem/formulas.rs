//! The formulas that the theorems of this crate take as arguments.

use cannonpile::scalar::{Algebra, Polynomial};
use cannonpile::theorem::Library;

use crate::formula;

/// The formulas in the theorems of this crate: those of the core, and those of this crate.
///
/// The proofs evaluate them with polynomials. [`LIBRARY`](Self::LIBRARY) contains the functions that the rest of this
/// crate calls.
#[derive(Debug)]
pub struct Formulas<P = Polynomial> {
    /// The formulas of the core.
    pub core: cannonpile::theorem::Formulas<P>,
    /// [`formula::third_moment`].
    pub third_moment: fn(&P, &P) -> P,
    /// [`formula::fourth_moment`].
    pub fourth_moment: fn(&P) -> P,
    /// [`formula::fourth_moment_of_pair`].
    pub fourth_moment_of_pair: fn(&P, &P, &P) -> P,
    /// [`formula::mean_third_moment`].
    pub mean_third_moment: fn(&P, &P, &P) -> P,
    /// [`formula::mean_fourth_moment_of_pairs`].
    pub mean_fourth_moment_of_pairs: fn(&P, &P, &P) -> P,
    /// [`formula::wave`].
    pub wave: fn(&P) -> [P; 2],
    /// [`formula::registry_excess`].
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
    /// The functions that the rest of this crate calls.
    pub const LIBRARY: Self = Self {
        core: cannonpile::theorem::Formulas::<P>::LIBRARY,
        third_moment: formula::third_moment,
        fourth_moment: formula::fourth_moment,
        fourth_moment_of_pair: formula::fourth_moment_of_pair,
        mean_third_moment: formula::mean_third_moment,
        mean_fourth_moment_of_pairs: formula::mean_fourth_moment_of_pairs,
        wave: formula::wave,
        registry_excess: formula::registry_excess,
    };
}

impl<P: Algebra<Numerator = P>> Library for Formulas<P> {
    const LIBRARY: Self = Self::LIBRARY;
}
