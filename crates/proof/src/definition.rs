//! A formula as a definition: its parameters and its result, independent of a target language.

use cannonpile::geometry::Vector;
use cannonpile::lattice::{Direction, Sign};

use crate::Expression;

/// The type of a parameter or a result.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// A rational number, or an integer in definitions over integers.
    Number,
    /// Two numbers.
    Pair,
    /// Three numbers by direction α, β, γ, or bounds of i, j and i+j.
    Three,
    /// Four numbers for each direction.
    Fours,
    /// A vector by its components.
    Vector,
    /// The unit vectors ê_a, ê_b, ê_c.
    Directions,
    /// The integers Δi and Δj.
    Site,
    /// α, β or γ.
    Direction,
    /// + or −.
    Sign,
    /// A truth value.
    Truth,
}

/// The result of a definition.
pub(super) enum Value {
    Number(Expression),
    /// A tuple of numbers.
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

/// The value of a parameter in one case of a definition by cases.
#[derive(Clone, Copy)]
pub(super) enum CaseValue {
    Direction(Direction),
    Sign(Sign),
    Truth(bool),
}

/// The body of a definition.
pub(super) enum Body {
    Value(Value),
    /// A definition by cases of the parameters `of`, with all combinations of their values.
    Cases {
        of: Vec<&'static str>,
        cases: Vec<(Vec<CaseValue>, Value)>,
    },
}

impl Body {
    /// Returns the type of the result, which is the same in all cases.
    pub(super) fn kind(&self) -> Option<Kind> {
        match self {
            Self::Value(value) => Some(value.kind()),
            Self::Cases { cases, .. } => cases.first().map(|(_, value)| value.kind()),
        }
    }
}

/// A formula recorded on symbols.
pub(super) struct Definition {
    /// The name in the library, with the dimension appended if there are definitions for several dimensions.
    pub(super) name: String,
    /// A description of the result, for the comment in Coq.
    pub(super) about: &'static str,
    pub(super) parameters: Vec<(&'static str, Kind)>,
    pub(super) body: Body,
}
