//! Questions about a pile: the spheres, the quantity and the method.

use crate::error::named;
use crate::shape::Selection;

/// A method to compute forces.
///
/// # Examples
/// ```
/// use cannonpile::shape::Selection;
/// use cannonpile::{Method, Pile};
///
/// assert_eq!(Pile::triangular(10)?.plan(Selection::All)?.method, Method::Closed);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Method {
    /// Counts the spheres on three lines: O(1) for each force. Applies to stackings without a sign change.
    Closed,
    /// Follows the lines above one sphere to the sign changes. The cost depends on the number of sign changes, not on
    /// the number of layers.
    Tree,
    /// Advances from the top, layer by layer or a run at a time, with one layer in memory.
    Sweep,
}

impl Method {
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Closed => "closed",
            Self::Tree => "tree",
            Self::Sweep => "sweep",
        }
    }
}

named!(
    Method,
    [Method::Closed, Method::Tree, Method::Sweep],
    "a method: closed, tree or sweep"
);

/// A quantity that a question requests for each sphere. Its units do not matter to a plan.
///
/// # Examples
/// ```
/// use cannonpile::{Pile, Quantity, Question};
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(10)?;
/// let rows = |quantity| pile.plan(Question::new(Selection::Base, quantity)).map(|plan| plan.rows);
/// assert_eq!(rows(Quantity::Floor)?, 55_u32.into());
/// assert_eq!(rows(Quantity::Contacts)?, 0_u32.into());
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Quantity {
    /// The forces on the supports: [`Forces::contacts`](crate::Forces::contacts).
    Contacts,
    /// The forces on the floor: [`Forces::base`](crate::Forces::base).
    Floor,
}

impl Quantity {
    const fn name(self) -> &'static str {
        match self {
            Self::Contacts => "contacts",
            Self::Floor => "floor",
        }
    }
}

named!(
    Quantity,
    [Quantity::Contacts, Quantity::Floor],
    "a quantity: contacts or floor"
);

/// A question: the spheres, the quantity, and optionally the method.
///
/// A [`Selection`] alone converts to a question for forces: those on the floor for the base, and contact forces for any
/// other part.
///
/// # Examples
/// ```
/// use cannonpile::shape::Selection;
/// use cannonpile::{Quantity, Question};
///
/// let question = Question::from(Selection::Base);
/// assert_eq!((question.quantity, question.method), (Quantity::Floor, None));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(::serde::Serialize, ::serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct Question {
    /// The spheres.
    pub part: Selection,
    /// The quantity requested for each sphere.
    pub quantity: Quantity,
    /// The method, or `None` for the cheapest one.
    pub method: Option<Method>,
}

impl Question {
    /// Returns the question for a quantity of a part of a pile, by the cheapest method.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Quantity, Question};
    ///
    /// let question = Question::new(Selection::Base, Quantity::Floor);
    /// assert_eq!(question, Selection::Base.into());
    /// ```
    #[must_use]
    pub const fn new(part: Selection, quantity: Quantity) -> Self {
        Self {
            part,
            quantity,
            method: None,
        }
    }

    /// Returns the question with a given method instead of the cheapest one.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Method, Question};
    ///
    /// let question = Question::from(Selection::Base).with_method(Method::Tree);
    /// assert_eq!(question.method, Some(Method::Tree));
    /// ```
    #[must_use]
    pub const fn with_method(self, method: Method) -> Self {
        Self {
            method: Some(method),
            ..self
        }
    }
}

impl From<Selection> for Question {
    fn from(part: Selection) -> Self {
        let quantity = match part {
            Selection::Base => Quantity::Floor,
            _ => Quantity::Contacts,
        };
        Self::new(part, quantity)
    }
}
