//! The formulas of the library as definitions, recorded by running them on symbols.

#[macro_use]
mod parts;
mod disorder;
mod forces;
mod horizontal;
mod places;

use disorder::disorder;
use forces::{forces, loads, tripled_apart, tripled_half_turn, turns, weights};
use horizontal::{horizontal, with_horizontal_contacts};
use parts::E;
use places::{above, bounds_above, counts, descent, places};

use crate::Formulas;
use crate::definition::Definition;

/// Returns the definitions over integers, for the formulas that the engines run without fractions.
pub(super) fn over_integers(f: &Formulas<E>) -> Vec<Definition> {
    let f = &f.core;
    vec![
        above(f),
        bounds_above(f),
        tripled_half_turn(f),
        tripled_apart(f),
    ]
}

/// Returns all definitions over rationals.
pub(super) fn over_rationals(f: &Formulas<E>) -> Vec<Definition> {
    let core = &f.core;
    let mut all = vec![above(core), bounds_above(core), descent(core)];
    all.extend(counts(core));
    all.extend(places(core));
    all.extend(forces(core));
    all.extend(loads(core));
    all.extend(weights(core));
    all.extend(turns(core));
    all.extend(horizontal(f));
    all.extend(with_horizontal_contacts(f));
    all.extend(disorder(f));
    all
}
