//! Reasons to reject a certificate.

use core::fmt;

use cannonpile::Error;
use cannonpile::engine::shortened;
use cannonpile::lattice::{Direction, HorizontalContact, Site};
use num_rational::BigRational;

/// A required relation between a number and a bound.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::certificate::Relation;
///
/// assert!(Relation::AtMost.holds(&1, &2) && !Relation::Equal.holds(&1, &2));
/// assert_eq!(Relation::AtLeast.to_string(), "at least");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// ≤.
    AtMost,
    /// =.
    Equal,
    /// ≥.
    AtLeast,
}

impl Relation {
    /// Returns whether `number` satisfies the relation to `needed`.
    ///
    /// # Examples
    /// See [`Relation`].
    #[must_use]
    pub fn holds<T: Ord>(self, number: &T, needed: &T) -> bool {
        match self {
            Self::AtMost => number <= needed,
            Self::Equal => number == needed,
            Self::AtLeast => number >= needed,
        }
    }
}

impl fmt::Display for Relation {
    /// Writes `at most`, `equal to` or `at least`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::AtMost => "at most",
            Self::Equal => "equal to",
            Self::AtLeast => "at least",
        })
    }
}

/// The reason why a certificate is rejected: the first condition that is violated.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::certificate::Refusal;
/// use cannonpile::lattice::{Direction, Site};
/// use num_rational::BigRational;
///
/// let force = BigRational::from_integer((-2).into());
/// let refusal = Refusal::Tension { site: Site::APEX, direction: Direction::Beta, force };
/// assert_eq!(refusal.to_string(), "the contact (0,0,0) beta is tensile: its force is -2");
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Refusal {
    /// The pile has no horizontal contacts: sin φ is neither 1/2 nor that of discs.
    NoTouchingNeighbours {
        /// sin φ.
        sin_phi: BigRational,
    },
    /// The pile itself has horizontal forces. They belong in the certificate.
    ForcesInPile {
        /// The first such contact.
        contact: HorizontalContact,
    },
    /// The stiffness ratio is not positive.
    Stiffness {
        /// The ratio given.
        given: BigRational,
    },
    /// A horizontal contact is not in the pile, or lies on the floor, where the spheres are fixed.
    NoContact {
        /// The contact.
        contact: HorizontalContact,
    },
    /// The field has a value on a sphere that is not in the pile, or lies on the floor.
    NoSphere {
        /// The site.
        site: Site,
    },
    /// The claim is about a sphere that is not on the floor.
    NotOnFloor {
        /// The site.
        site: Site,
    },
    /// The force of a horizontal contact is tensile.
    HorizontalTension {
        /// The contact.
        contact: HorizontalContact,
        /// Its force.
        force: BigRational,
    },
    /// The force of a sloping contact is tensile.
    Tension {
        /// The upper sphere.
        site: Site,
        /// The direction of the contact.
        direction: Direction,
        /// Its force.
        force: BigRational,
    },
    /// A drop D violates the condition of the claim.
    Drop {
        /// The upper sphere.
        site: Site,
        /// The direction of the contact.
        direction: Direction,
        /// The value of D.
        drop: BigRational,
        /// The required relation to `needed`.
        relation: Relation,
        /// The required value.
        needed: BigRational,
    },
    /// A compression c violates the condition of the claim.
    Compression {
        /// The contact.
        contact: HorizontalContact,
        /// The value of c times the stiffness ratio.
        compression: BigRational,
        /// The required relation to `needed`.
        relation: Relation,
        /// The required value.
        needed: BigRational,
    },
    /// The virtual work of the weights, Σ w φ, is not positive.
    Work {
        /// The virtual work.
        work: BigRational,
    },
    /// The field proves a different bound.
    Bound {
        /// The bound claimed.
        claimed: BigRational,
        /// The bound that the field proves.
        proved: BigRational,
    },
    /// The forces attain a different normal force.
    Attained {
        /// The normal force claimed.
        claimed: BigRational,
        /// The normal force that the forces attain.
        attained: BigRational,
    },
    /// The forces of a sphere are not given.
    NotGiven {
        /// The site.
        site: Site,
    },
    /// A given force is not close enough to the exact one.
    Force {
        /// The site.
        site: Site,
        /// `alpha`, `beta`, `gamma`, `normal`, `shear_x` or `shear_y`.
        what: &'static str,
        /// The force given.
        given: BigRational,
        /// The exact force.
        exact: BigRational,
        /// The largest difference allowed.
        within: BigRational,
    },
    /// The certificate is wrong about whether a contact is tensile.
    Sign {
        /// `true` if no exact force is tensile.
        compressive: bool,
    },
    /// An operation on the pile failed.
    Pile(Error),
}

cannonpile::engine::equality!(Refusal);

impl From<Error> for Box<Refusal> {
    fn from(error: Error) -> Self {
        Self::new(Refusal::Pile(error))
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = match self {
            Self::NoTouchingNeighbours { sin_phi } => shortened(&format!(
                "the neighbours of a layer touch at a = R only if sin phi is 1/2, not {sin_phi}"
            )),
            Self::ForcesInPile { contact } => format!(
                "the pile itself has a force in the horizontal contact {contact}; move it to the certificate"
            ),
            Self::Stiffness { given } => {
                format!("the stiffness ratio must be positive, not {given}")
            }
            Self::NoContact { contact } => {
                format!("there is no horizontal contact {contact} above the floor")
            }
            Self::NoSphere { site } => format!("there is no sphere {site} above the floor"),
            Self::NotOnFloor { site } => format!("there is no sphere {site} on the floor"),
            Self::HorizontalTension { contact, force } => {
                format!("the horizontal contact {contact} is tensile: its force is {force}")
            }
            Self::Tension {
                site,
                direction,
                force,
            } => format!("the contact {site} {direction} is tensile: its force is {force}"),
            Self::Drop {
                site,
                direction,
                drop,
                relation,
                needed,
            } => format!(
                "the drop along the contact {site} {direction} is {drop}, but must be {relation} {needed}"
            ),
            Self::Compression {
                contact,
                compression,
                relation,
                needed,
            } => format!(
                "the compression of the horizontal contact {contact} is {compression}, but must be {relation} {needed}"
            ),
            Self::Work { work } => {
                format!("the virtual work of the weights must be positive, not {work}")
            }
            Self::Bound { claimed, proved } => {
                format!("the field proves the bound {proved}, not {claimed}")
            }
            Self::Attained { claimed, attained } => {
                format!("the forces attain the normal force {attained}, not {claimed}")
            }
            Self::NotGiven { site } => format!("the forces of the sphere {site} are missing"),
            Self::Force {
                site,
                what,
                given,
                exact,
                within,
            } => format!(
                "the force {what} of the sphere {site} is {exact}, not {given} within {within}"
            ),
            Self::Sign { compressive: true } => "no contact is tensile".to_owned(),
            Self::Sign { compressive: false } => "a contact is tensile".to_owned(),
            Self::Pile(error) => error.to_string(),
        };
        f.write_str(&text)
    }
}

impl core::error::Error for Refusal {}
