//! What can be asked of a pile, and by which method.

use crate::error::named;
use crate::shape::Selection;

/// How forces are found.
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
    /// By counting the spheres on three lines: O(1) a force. For stackings without a change of sign.
    Closed,
    /// From the lines above one sphere, which begin at the changes of sign: the cost follows the changes, not the
    /// layers.
    Tree,
    /// Layer after layer from the top, a run at a time, with one layer in memory.
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

/// What is wanted of the spheres asked about.
///
/// # Examples
/// ```
/// use cannonpile::{Pile, Quantity, Question};
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(10)?;
/// let roots = |quantity| {
///     pile.plan(Question::new(Selection::All, quantity)).map(|plan| plan.roots)
/// };
/// assert_eq!(roots(Quantity::ContactMultiples)?, 0);
/// assert_eq!(roots(Quantity::ContactForces)?, 1);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Quantity {
    /// The forces to the spheres below, in f₀: [`Forces::contacts`](crate::Forces::contacts).
    ContactMultiples,
    /// The same in SI, without vectors: [`Packing::contact_forces`](crate::Packing::contact_forces).
    ContactForces,
    /// The contact forces in SI, with vectors and contact points: [`Packing::contacts`](crate::Packing::contacts).
    ContactVectors,
    /// The forces on the floor, in mg and mg·tanθ: [`Forces::base`](crate::Forces::base).
    FloorMultiples,
    /// The forces on the floor in SI: [`Packing::base`](crate::Packing::base).
    FloorForces,
    /// Where the centres are, in SI: [`Packing::position`](crate::Packing::position).
    Positions,
}

impl Quantity {
    const ALL: [Self; 6] = [
        Self::ContactMultiples,
        Self::ContactForces,
        Self::ContactVectors,
        Self::FloorMultiples,
        Self::FloorForces,
        Self::Positions,
    ];

    const fn name(self) -> &'static str {
        match self {
            Self::ContactMultiples => "contact multiples",
            Self::ContactForces => "contact forces",
            Self::ContactVectors => "contact vectors",
            Self::FloorMultiples => "floor multiples",
            Self::FloorForces => "floor forces",
            Self::Positions => "positions",
        }
    }

    /// The square roots that it takes, at most: of 1/cos²θ; of tan²θ; of sin²θ and cos²θ; and of 4cos²φ, wherever there
    /// is a component along y.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Quantity;
    ///
    /// assert_eq!(Quantity::FloorMultiples.roots(), 0);
    /// // Of tan²θ and of 4cos²φ.
    /// assert_eq!(Quantity::FloorForces.roots(), 2);
    /// ```
    #[must_use]
    pub const fn roots(self) -> u64 {
        match self {
            Self::ContactMultiples | Self::FloorMultiples => 0,
            Self::ContactForces => 1,
            Self::FloorForces => 2,
            Self::Positions => 3,
            Self::ContactVectors => 5,
        }
    }

    /// Whether it is of contacts, between spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Quantity;
    ///
    /// assert!(Quantity::ContactVectors.is_of_contacts());
    /// assert!(!Quantity::FloorForces.is_of_contacts());
    /// ```
    #[must_use]
    pub const fn is_of_contacts(self) -> bool {
        matches!(
            self,
            Self::ContactMultiples | Self::ContactForces | Self::ContactVectors
        )
    }
}

named!(
    Quantity,
    Quantity::ALL,
    "a quantity: contact multiples, contact forces, contact vectors, floor multiples, floor forces or positions"
);

/// A question: which spheres, what of them, and by which method, if not the cheapest.
///
/// Of a [`Selection`] alone it is the multiples: on the floor for the base, of the contacts for any other.
///
/// # Examples
/// ```
/// use cannonpile::shape::Selection;
/// use cannonpile::{Quantity, Question};
///
/// let question = Question::from(Selection::Base);
/// assert_eq!((question.quantity, question.method), (Quantity::FloorMultiples, None));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(::serde::Serialize, ::serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct Question {
    /// Which spheres.
    pub part: Selection,
    /// What of them.
    pub quantity: Quantity,
    /// The method, or `None` for the cheapest.
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
    /// let question = Question::new(Selection::Base, Quantity::FloorMultiples);
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

    /// Returns the question with a method in place of the cheapest.
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
            Selection::Base => Quantity::FloorMultiples,
            _ => Quantity::ContactMultiples,
        };
        Self::new(part, quantity)
    }
}
