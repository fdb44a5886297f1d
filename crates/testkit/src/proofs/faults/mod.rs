//! Wrong formulas, each with the exact list of theorems that it refutes.

mod counts;
mod floor;
mod forces;
mod horizontal;
mod loads;
mod places;

use core::num::NonZeroI64;

use cannonpile::scalar::{Algebra, Polynomial};
use cannonpile::theorem::Formulas;

type P = Polynomial;

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

const RIGHT: Formulas = Formulas::LIBRARY;

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
use faults;

/// The faults of the core's formulas, ordered by the wrong formula.
///
/// The core itself has no theorem about some of them. The theorems about `pushed` and `beside` are in the crate of
/// horizontal contacts, and those about loads, sign changes and bounds of layers are in `cannonpile-proof`.
pub fn of_the_core() -> Vec<Fault> {
    [
        counts::faults(),
        places::faults(),
        forces::faults(),
        floor::faults(),
        loads::faults(),
        horizontal::faults(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

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
