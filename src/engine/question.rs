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

/// A quantity that a question requests for each sphere.
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
    /// The forces on the supports, in f₀: [`Forces::contacts`](crate::Forces::contacts).
    ContactMultiples,
    /// Contact forces in newtons, without vectors: [`Packing::contact_forces`](crate::Packing::contact_forces).
    ContactForces,
    /// The contact forces in SI units, with vectors and contact points:
    /// [`Packing::contacts`](crate::Packing::contacts).
    ContactVectors,
    /// The forces on the floor, in mg and mg·tanθ: [`Forces::base`](crate::Forces::base).
    FloorMultiples,
    /// The forces on the floor in newtons: [`Packing::base`](crate::Packing::base).
    FloorForces,
    /// The positions of the centres, in metres: [`Packing::position`](crate::Packing::position).
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

    /// Returns the maximum number of square roots that the quantity needs.
    ///
    /// The radicands are 1/cos²θ, tan²θ, sin²θ and cos²θ. Components along y add 4cos²φ.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Quantity;
    ///
    /// assert_eq!(Quantity::FloorMultiples.roots(), 0);
    /// // The radicands tan²θ and 4cos²φ.
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

    /// Returns whether the quantity describes contacts between spheres.
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

/// A question: the spheres, the quantity, and optionally the method.
///
/// A [`Selection`] alone converts to a question for forces in pile units: those on the floor for the base, and contact
/// forces for any other part.
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
            Selection::Base => Quantity::FloorMultiples,
            _ => Quantity::ContactMultiples,
        };
        Self::new(part, quantity)
    }
}
