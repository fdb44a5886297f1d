//! The parts of a recorded definition.

use cannonpile::lattice::Sign;
use cannonpile::scalar::Symbol;

use crate::Expression;
use crate::definition::{Body, CaseValue, Definition, Kind, Value};

pub(super) type E = Expression;

pub(super) fn symbol(name: &'static str) -> E {
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

pub(super) const SIGNS: [Sign; 2] = [Sign::Plus, Sign::Minus];

/// Returns the definition of a formula without cases.
pub(super) fn plain(
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
pub(super) fn of_numbers(
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
pub(super) fn by_cases(
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
