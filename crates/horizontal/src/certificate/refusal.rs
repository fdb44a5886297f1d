//! Why a certificate is refused.

use core::fmt;

use cannonpile::Error;
use cannonpile::engine::shortened;
use cannonpile::lattice::{Direction, HorizontalContact, Site};
use num_rational::BigRational;

/// How a number is to lie to another one.
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
    /// Whether `number` lies so to `needed`.
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
    /// Prints `at most`, `equal to`, `at least`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::AtMost => "at most",
            Self::Equal => "equal to",
            Self::AtLeast => "at least",
        })
    }
}

/// Why a certificate is refused: the first equation that does not hold.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::certificate::Refusal;
/// use cannonpile::lattice::{Direction, Site};
/// use num_rational::BigRational;
///
/// let force = BigRational::from_integer((-2).into());
/// let refusal = Refusal::Pulls { site: Site::APEX, direction: Direction::Beta, force };
/// assert_eq!(refusal.to_string(), "the contact (0,0,0) beta would have to pull: its force is -2");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Refusal {
    /// The pile has no horizontal contacts of this kind: sin φ is neither 1/2 nor that of discs.
    NoSuchPile {
        /// sin φ.
        sin_phi: BigRational,
    },
    /// Horizontal contacts of the pile itself were given forces; a certificate has its own.
    GivenForces {
        /// The first of them.
        contact: HorizontalContact,
    },
    /// The stiffness ratio is not positive.
    Stiffness {
        /// What it is.
        given: BigRational,
    },
    /// A horizontal contact that the pile lacks, or one between spheres on the floor, which are held.
    NoContact {
        /// The contact.
        contact: HorizontalContact,
    },
    /// A field on a sphere that the pile lacks, or that is on the floor.
    NoSphere {
        /// The site.
        site: Site,
    },
    /// The normal force is asked of a sphere that is not on the floor.
    NotOnFloor {
        /// The site.
        site: Site,
    },
    /// A horizontal contact that pulls.
    HorizontalPulls {
        /// The contact.
        contact: HorizontalContact,
        /// Its force.
        force: BigRational,
    },
    /// A sloping contact that pulls.
    Pulls {
        /// The upper sphere.
        site: Site,
        /// The direction of the contact.
        direction: Direction,
        /// Its force.
        force: BigRational,
    },
    /// A drop D that is not as the claim needs it.
    Drop {
        /// The upper sphere.
        site: Site,
        /// The direction of the contact.
        direction: Direction,
        /// D.
        drop: BigRational,
        /// How it was to lie to `needed`.
        relation: Relation,
        /// What it was to be.
        needed: BigRational,
    },
    /// A compression c that is not as the claim needs it.
    Compression {
        /// The contact.
        contact: HorizontalContact,
        /// c, times the stiffness ratio.
        compression: BigRational,
        /// How it was to lie to `needed`.
        relation: Relation,
        /// What it was to be.
        needed: BigRational,
    },
    /// The work of the weights, Σ w φ, is not positive.
    Work {
        /// The sum.
        work: BigRational,
    },
    /// The field proves another bound.
    Bound {
        /// What is claimed.
        claimed: BigRational,
        /// What the field proves.
        proved: BigRational,
    },
    /// The forces attain another normal force.
    Attained {
        /// What is claimed.
        claimed: BigRational,
        /// What they attain.
        attained: BigRational,
    },
    /// The pile does not answer.
    Pile(Error),
}

impl From<Error> for Box<Refusal> {
    fn from(error: Error) -> Self {
        Self::new(Refusal::Pile(error))
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchPile { sin_phi } => f.write_str(&shortened(&format!(
                "neighbours of a layer touch at a = R only if sin phi is 1/2, not {sin_phi}"
            ))),
            Self::GivenForces { contact } => write!(
                f,
                "the pile itself has a force in the horizontal contact {contact}: leave it out there"
            ),
            Self::Stiffness { given } => {
                write!(f, "the stiffness ratio must be positive, not {given}")
            }
            Self::NoContact { contact } => {
                write!(
                    f,
                    "there is no horizontal contact {contact} above the floor"
                )
            }
            Self::NoSphere { site } => write!(f, "there is no sphere {site} above the floor"),
            Self::NotOnFloor { site } => write!(f, "there is no sphere {site} on the floor"),
            Self::HorizontalPulls { contact, force } => write!(
                f,
                "the horizontal contact {contact} would have to pull: its force is {force}"
            ),
            Self::Pulls {
                site,
                direction,
                force,
            } => write!(
                f,
                "the contact {site} {direction} would have to pull: its force is {force}"
            ),
            Self::Drop {
                site,
                direction,
                drop,
                relation,
                needed,
            } => write!(
                f,
                "the drop along the contact {site} {direction} is {drop} and was to be {relation} {needed}"
            ),
            Self::Compression {
                contact,
                compression,
                relation,
                needed,
            } => write!(
                f,
                "the compression of the horizontal contact {contact} is {compression} and was to be {relation} {needed}"
            ),
            Self::Work { work } => {
                write!(f, "the work of the weights must be positive, and is {work}")
            }
            Self::Bound { claimed, proved } => {
                write!(f, "the field proves the bound {proved}, not {claimed}")
            }
            Self::Attained { claimed, attained } => write!(
                f,
                "the forces attain the normal force {attained}, not {claimed}"
            ),
            Self::Pile(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for Refusal {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Pile(error) => error.source(),
            _ => None,
        }
    }
}
