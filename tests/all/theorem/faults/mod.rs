//! Wrong formulas, each with the theorems that do not hold of it: those and no others.

mod counts;
mod disorder;
mod floor;
mod forces;
mod horizontal;
mod places;

use core::num::NonZeroI64;

use cannonpile::scalar::{Algebra, Polynomial};
use cannonpile::theorem::Formulas;

type P = Polynomial;

/// The crate's formulas but for one.
pub(crate) struct Fault {
    /// What is wrong.
    pub(crate) what: &'static str,
    /// Which formula.
    pub(crate) field: &'static str,
    /// All of them, the wrong one included.
    pub(crate) formulas: Formulas,
    /// The theorems that fail, in the order of [`all`](cannonpile::theorem::all).
    pub(crate) refused_by: &'static [&'static str],
}

const RIGHT: Formulas = Formulas::LIBRARY;

/// Rows `"what is wrong": field = formula => ["theorem that fails", …];`.
macro_rules! faults {
    ($($what:literal: $field:ident = $wrong:expr => [$($theorem:literal),+];)*) => {
        vec![$(Fault {
            what: $what,
            field: stringify!($field),
            formulas: Formulas { $field: $wrong, ..RIGHT },
            refused_by: &[$($theorem),+],
        }),*]
    };
}
use faults;

/// Every fault, by the formula that is wrong.
pub(crate) fn all() -> Vec<Fault> {
    [
        counts::faults(),
        places::faults(),
        forces::faults(),
        floor::faults(),
        horizontal::faults(),
        disorder::faults(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// p/n.
fn over(p: P, n: i64) -> P {
    p.div_int(NonZeroI64::new(n).expect("not zero"))
}

fn twice(p: &P) -> P {
    p.clone() + p
}

/// The first two in each other's place.
fn swapped<T: Clone>([a, b, c]: &[T; 3]) -> [T; 3] {
    [b.clone(), a.clone(), c.clone()]
}

/// The sum of three.
fn sum([a, b, c]: &[P; 3]) -> P {
    a.clone() + b + c
}
