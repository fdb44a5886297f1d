//! A wrong formula, and arithmetic to write one.

use core::num::NonZeroI64;

use cannonpile::scalar::{Algebra, Polynomial};
use cannonpile::theorem::Formulas;

pub(super) type P = Polynomial;

/// The formulas of a crate with one wrong formula.
#[derive(Clone, Copy)]
pub struct Fault<F: 'static = Formulas> {
    /// The description of the fault.
    pub what: &'static str,
    /// The name of the wrong formula.
    pub field: &'static str,
    /// All formulas, the wrong one included.
    pub formulas: F,
    /// The theorems of all crates that fail, in the order of the list of theorems.
    pub refuted_by: &'static [&'static str],
}

pub(super) const RIGHT: Formulas = Formulas::LIBRARY;

/// Builds a list from rows `"description": field = formula => ["theorem that fails", …];`.
///
/// The caller must define a type `Formulas` and a constant `RIGHT` of it.
#[macro_export]
macro_rules! faults {
    ($($what:literal: $field:ident = $wrong:expr => [$($theorem:literal),+];)*) => {
        vec![$($crate::proofs::Fault {
            what: $what,
            field: stringify!($field),
            formulas: Formulas { $field: $wrong, ..RIGHT },
            refuted_by: &[$($theorem),+],
        }),*]
    };
}
pub(super) use faults;

/// p/n.
pub fn over(p: P, n: i64) -> P {
    p.div_int(NonZeroI64::new(n).expect("not zero"))
}

/// 2p.
pub fn twice(p: &P) -> P {
    p.clone() + p
}

/// Swaps the first two.
pub fn swapped<T: Clone>([a, b, c]: &[T; 3]) -> [T; 3] {
    [b.clone(), a.clone(), c.clone()]
}

/// The sum of the three.
pub fn sum([a, b, c]: &[P; 3]) -> P {
    a.clone() + b + c
}
