//! A formula as a definition: its parameters, and what it returns, in no particular language.

use cannonpile::geometry::Vector;
use cannonpile::lattice::{Direction, Sign};

use crate::Expression;

/// Of which kind a parameter or a result is.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// A rational; among integers, an integer.
    Number,
    /// Two numbers.
    Pair,
    /// Numbers by direction α, β, γ; of bounds, those of i, j and i+j.
    Three,
    /// Four numbers by direction.
    Fours,
    /// A vector by its components.
    Vector,
    /// ê_a, ê_b, ê_c.
    Directions,
    /// Δi and Δj, integers.
    Site,
    /// α, β or γ.
    Direction,
    /// + or −.
    Sign,
    /// Yes or no.
    Truth,
}

/// What a definition returns.
pub(super) enum Value {
    Number(Expression),
    /// Several in brackets, numbers all.
    Several(Vec<Expression>),
    Three([Expression; 3]),
    Fours(Box<[[Expression; 4]; 3]>),
    Vector(Vector<Expression>),
    Directions(Box<[Vector<Expression>; 3]>),
    Site([i128; 2]),
}

impl Value {
    pub(super) const fn kind(&self) -> Kind {
        match self {
            Self::Number(_) => Kind::Number,
            Self::Several(_) => Kind::Pair,
            Self::Three(_) => Kind::Three,
            Self::Fours(_) => Kind::Fours,
            Self::Vector(_) => Kind::Vector,
            Self::Directions(_) => Kind::Directions,
            Self::Site(_) => Kind::Site,
        }
    }
}

/// What a parameter is asked for in a case: a direction, a sign, or yes or no.
#[derive(Clone, Copy)]
pub(super) enum Asked {
    Direction(Direction),
    Sign(Sign),
    Truth(bool),
}

/// The body of a definition.
pub(super) enum Body {
    Value(Value),
    /// By cases of these parameters, all of them.
    Cases {
        of: Vec<&'static str>,
        cases: Vec<(Vec<Asked>, Value)>,
    },
}

impl Body {
    /// What it returns is of one kind in all cases.
    pub(super) fn kind(&self) -> Option<Kind> {
        match self {
            Self::Value(value) => Some(value.kind()),
            Self::Cases { cases, .. } => cases.first().map(|(_, value)| value.kind()),
        }
    }
}

/// A formula as it ran on symbols.
pub(super) struct Definition {
    /// As in the library; with the dimension, if it is one of several.
    pub(super) name: String,
    /// What it returns.
    pub(super) about: &'static str,
    pub(super) parameters: Vec<(&'static str, Kind)>,
    pub(super) body: Body,
}
