//! Wrong formulas, each with the theorems that do not hold of it: those and no others.

mod counts;
mod floor;
mod forces;
mod places;
mod pushes;

use core::num::NonZeroI64;

use cannonpile::scalar::{Algebra, Polynomial};
use cannonpile::theorem::Formulas;

type P = Polynomial;

/// The formulas of a crate but for one.
#[derive(Clone, Copy)]
pub struct Fault<F: 'static = Formulas> {
    /// What is wrong.
    pub what: &'static str,
    /// Which formula.
    pub field: &'static str,
    /// All of them, the wrong one included.
    pub formulas: F,
    /// The theorems of all crates that fail, in the order of all theorems.
    pub refused_by: &'static [&'static str],
}

const RIGHT: Formulas = Formulas::LIBRARY;

/// Rows `"what is wrong": field = formula => ["theorem that fails", …];`.
///
/// The caller has a type `Formulas`, and `RIGHT`, a constant of it.
#[macro_export]
macro_rules! faults {
    ($($what:literal: $field:ident = $wrong:expr => [$($theorem:literal),+];)*) => {
        vec![$($crate::proofs::Fault {
            what: $what,
            field: stringify!($field),
            formulas: Formulas { $field: $wrong, ..RIGHT },
            refused_by: &[$($theorem),+],
        }),*]
    };
}
use faults;

/// The faults of the core's formulas, by the formula that is wrong.
///
/// Of those of `pushed` and `beside` the core has no theorem: the crate of horizontal contacts has.
pub fn of_the_core() -> Vec<Fault> {
    [
        counts::faults(),
        places::faults(),
        forces::faults(),
        floor::faults(),
        pushes::faults(),
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

/// The first two in each other's place.
pub fn swapped<T: Clone>([a, b, c]: &[T; 3]) -> [T; 3] {
    [b.clone(), a.clone(), c.clone()]
}

/// The sum of three.
pub fn sum([a, b, c]: &[P; 3]) -> P {
    a.clone() + b + c
}
