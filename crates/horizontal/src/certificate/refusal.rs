//! Reasons to reject a certificate.

use core::fmt;

use cannonpile::Error;
use cannonpile::engine::shortened;

/// A required relation between a number and a bound.
#[derive(Clone, Copy)]
pub(super) enum Relation {
    AtMost,
    Equal,
    AtLeast,
}

impl Relation {
    /// Returns whether `number` satisfies the relation to `needed`.
    pub(super) fn holds<T: Ord>(self, number: &T, needed: &T) -> bool {
        match self {
            Self::AtMost => number <= needed,
            Self::Equal => number == needed,
            Self::AtLeast => number >= needed,
        }
    }
}

impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::AtMost => "at most",
            Self::Equal => "equal to",
            Self::AtLeast => "at least",
        })
    }
}

/// A condition on a certificate.
///
/// # Examples
/// See [`Refusal`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Condition {
    /// The pile has horizontal contacts, and no forces in them: these belong in the certificate.
    Pile,
    /// The stiffness ratio is positive.
    Stiffness,
    /// The contacts and spheres of the certificate are in the pile, and above the floor or on it as the claim needs.
    Place,
    /// The forces of all spheres are given.
    Complete,
    /// The forces of horizontal contacts are not tensile.
    HorizontalTension,
    /// The forces of sloping contacts are not tensile.
    Tension,
    /// The drops D have the signs, or the values, that the claim needs.
    Drop,
    /// The compressions c have the signs, or the values, that the claim needs.
    Compression,
    /// The virtual work of the weights, Σ w φ, is positive.
    Work,
    /// The field proves the claimed bound.
    Bound,
    /// The forces attain the claimed bound.
    Attained,
    /// The given forces are close to the exact ones.
    Force,
    /// The certificate is right about whether a contact is tensile.
    Sign,
}

/// The reason why a certificate is rejected.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_horizontal::certificate::{Certificate, Claim, Condition, Refusal};
///
/// let pile = Pile::triangular(4)?;
/// let claim = Claim::CannotStand;
/// let certificate = Certificate { pile, claim, horizontal: [].into(), field: [].into() };
/// let refusal = certificate.check().unwrap_err();
/// assert!(matches!(refusal, Refusal::Violated(Condition::Work, _)));
/// assert_eq!(refusal.to_string(), "the virtual work of the weights must be positive, not 0");
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The first condition that is violated, and a line that states its numbers.
    Violated(Condition, String),
    /// An operation on the pile failed.
    Pile(Error),
}

impl Refusal {
    /// Returns the refusal for a violated condition. Long numbers in the text are shortened.
    pub(super) fn of(condition: Condition, text: &str) -> Self {
        Self::Violated(condition, shortened(text))
    }
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        Self::Pile(error)
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Violated(_, text) => f.write_str(text),
            Self::Pile(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for Refusal {}
