//! The formulas of the library as definitions, recorded by running them on symbols.

use cannonpile::lattice::Sign;
use cannonpile::scalar::Symbol;

use crate::definition::{Body, CaseValue, Definition, Kind, Value};
use crate::{Expression, Formulas};

type E = Expression;

fn symbol(name: &'static str) -> E {
    Symbol(name).into()
}

/// Expands to the three numbers of a parameter, by direction.
macro_rules! three {
    ($name:literal) => {
        [
            concat!($name, ".alpha"),
            concat!($name, ".beta"),
            concat!($name, ".gamma"),
        ]
        .map(symbol)
    };
}

/// Expands to the components of a vector parameter.
macro_rules! vector {
    ($name:expr) => {
        Vector {
            x: symbol(concat!($name, ".along_x")),
            y: symbol(concat!($name, ".along_y")),
            z: symbol(concat!($name, ".along_z")),
        }
    };
}

/// Expands to the components of a parameter of three vectors.
macro_rules! vectors {
    ($name:literal) => {
        [
            vector!(concat!($name, ".alpha")),
            vector!(concat!($name, ".beta")),
            vector!(concat!($name, ".gamma")),
        ]
    };
}

mod disorder;
mod forces;
mod horizontal;
mod places;

use disorder::disorder;
use forces::{forces, loads, tripled_apart, tripled_half_turn, turns, weights};
use horizontal::{horizontal, with_horizontal_contacts};
use places::{above, bounds_above, counts, descent, places};

const SIGNS: [Sign; 2] = [Sign::Plus, Sign::Minus];

/// Returns the definition of a formula without cases.
fn plain(
    name: &str,
    about: &'static str,
    parameters: &[(&'static str, Kind)],
    value: Value,
) -> Definition {
    Definition {
        name: name.into(),
        about,
        parameters: parameters.into(),
        body: Body::Value(value),
    }
}

/// Returns the definition of a formula whose parameters are numbers.
fn of_numbers(
    name: &str,
    about: &'static str,
    parameters: &[&'static str],
    value: Value,
) -> Definition {
    let parameters: Vec<_> = parameters
        .iter()
        .map(|name| (*name, Kind::Number))
        .collect();
    plain(name, about, &parameters, value)
}

/// Returns the definition of a formula with cases.
fn by_cases(
    name: &str,
    about: &'static str,
    parameters: &[(&'static str, Kind)],
    cases: Vec<(Vec<CaseValue>, Value)>,
) -> Definition {
    let case_kinds = [Kind::Direction, Kind::Sign, Kind::Truth];
    let of = parameters
        .iter()
        .filter(|(_, kind)| case_kinds.contains(kind));
    Definition {
        name: name.into(),
        about,
        parameters: parameters.into(),
        body: Body::Cases {
            of: of.map(|(name, _)| *name).collect(),
            cases,
        },
    }
}

/// Returns the definitions over integers, for the formulas that the engines run without fractions.
pub(super) fn over_integers(f: &Formulas<E>) -> Vec<Definition> {
    let f = &f.horizontal.core;
    vec![
        above(f),
        bounds_above(f),
        tripled_half_turn(f),
        tripled_apart(f),
    ]
}

/// Returns all definitions over rationals.
pub(super) fn over_rationals(f: &Formulas<E>) -> Vec<Definition> {
    let Formulas {
        horizontal: f,
        disorder: of_disorder,
    } = f;
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
    all.extend(disorder(of_disorder));
    all
}
