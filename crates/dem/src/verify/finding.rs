//! Explanations of many differences at once.

use core::fmt;

use super::axes::Axes;

/// An explanation of the differences between measured and exact forces.
///
/// It is a guess at the cause, and is reported only if all data agree with it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// Contacts with a force were measured as 0.
    Zero {
        /// The number of these contacts.
        contacts: u64,
        /// True if all measured contacts with a force are among them.
        are_all: bool,
    },
    /// Forces differ from the lengths of their vectors.
    Disagreement {
        /// The number of these contacts.
        contacts: u64,
        /// True if all forces are exact.
        forces_are_exact: bool,
        /// True if all vectors are exact.
        vectors_are_exact: bool,
    },
    /// Two rows of one pair have different forces.
    Contradiction {
        /// The number of these pairs.
        pairs: u64,
    },
    /// The measured normal forces of the floor differ from the exact ones.
    Floor {
        /// The number of bottom spheres with a wrong force.
        spheres: u64,
        /// The largest relative error.
        error: f64,
    },
    /// All measured forces equal the exact ones times one factor. Forces of 0 are left out.
    Factor(f64),
    /// All vectors are the forces on the second sphere of the pair instead of the first.
    SecondSphere,
    /// All vectors agree with the exact ones after a permutation of the axes, possibly with reversed axes.
    Axes(Axes),
    /// All contacts between a layer and the next one below are missing.
    Layer {
        /// The upper layer, counted from 0 at the top.
        k: i128,
        /// The number of missing contacts.
        contacts: u64,
        /// True if the next layer is the bottom layer, whose spheres are fixed.
        is_lowest: bool,
    },
    /// Forces have a tangential part, of up to this fraction of the exact force.
    Tangential(f64),
    /// Tangential forces on a rough floor are wrong.
    Friction {
        /// The contacts.
        of: FrictionOf,
        /// The kind of the fault.
        fault: FrictionFault,
        /// The number of wrong forces.
        count: u64,
        /// The largest relative error.
        error: f64,
        /// True if all measured normal forces are right.
        normals_are_right: bool,
    },
    /// The horizontal forces on a sphere balance, but the moments about its centre do not.
    Moment {
        /// The number of the sphere.
        sphere: u64,
        /// The net moment over R times the largest exact tangential force.
        moment: f64,
    },
    /// Rows lack the tangential force, so they are not judged.
    Unknown {
        /// The number of contacts between spheres.
        contacts: u64,
        /// The number of spheres on the floor.
        spheres: u64,
    },
    /// Bottom spheres have no row in the table of the floor.
    OffFloor {
        /// The number of these spheres.
        spheres: u64,
        /// The number of the first of them.
        first: u64,
    },
    /// Spheres above the bottom layer touch the floor.
    Fallen {
        /// The number of these spheres.
        spheres: u64,
        /// The number of the first of them.
        first: u64,
    },
}

/// The contacts whose tangential forces are wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrictionOf {
    /// Contacts between spheres. The two spheres with the largest error.
    Spheres([u64; 2]),
    /// Contacts with the floor. The sphere with the largest error.
    Floor(u64),
}

/// The kind of fault of tangential forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrictionFault {
    /// All of them are 0.
    Absent,
    /// All of them have the opposite sign.
    Reversed,
    /// All of them are the exact ones times one factor.
    Factor(f64),
    /// Some of them differ in another way.
    Other,
}

impl Finding {
    /// Returns whether the tangential forces of contacts between spheres are wrong.
    pub(super) const fn is_of_contacts(&self) -> bool {
        matches!(
            self,
            Self::Friction {
                of: FrictionOf::Spheres(_),
                ..
            }
        )
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Zero {
                contacts,
                are_all: true,
            } => write!(
                f,
                "all measured forces are 0, at {contacts} of the contacts with a force: does the simulation store its forces?"
            ),
            Self::Zero {
                contacts,
                are_all: false,
            } => write!(f, "a force of 0 was measured at {contacts} of the contacts with a force"),
            Self::Disagreement {
                contacts,
                forces_are_exact,
                vectors_are_exact,
            } => {
                write!(f, "force and vector disagree at {contacts} of the contacts: ")?;
                f.write_str(match (forces_are_exact, vectors_are_exact) {
                    (true, _) => "all forces are the exact ones",
                    (_, true) => "all vectors are the exact ones",
                    _ => "neither are the exact ones at all contacts",
                })
            }
            Self::Contradiction { pairs } => write!(
                f,
                "two rows disagree on the force of {pairs} of the pairs: does the table hold several steps?"
            ),
            Self::Floor { spheres, error } => write!(
                f,
                "the normal force of the floor is wrong at {spheres} of the bottom spheres, by up to {error:.1e} of the exact \
                 force: are they held in place by other means?"
            ),
            Self::Factor(factor) => write!(
                f,
                "all forces are {factor:?} times the exact ones: {}",
                cause(*factor)
            ),
            Self::SecondSphere => f.write_str(
                "all vectors are the forces on the second sphere of each pair: reverse the vectors, or swap the two spheres",
            ),
            Self::Axes(axes) => axes.fmt(f),
            Self::Layer {
                k,
                contacts,
                is_lowest,
            } => {
                write!(
                    f,
                    "all {contacts} contacts of layer {k} with layer {} are missing",
                    k + 1
                )?;
                if *is_lowest {
                    f.write_str(": are forces on fixed spheres left out?")?;
                }
                Ok(())
            }
            Self::Friction {
                of,
                fault,
                count,
                error,
                normals_are_right,
            } => match of {
                FrictionOf::Spheres(ids) => {
                    f.write_str(if *normals_are_right {
                        "normal forces are right, but "
                    } else {
                        "normal forces are wrong, and "
                    })?;
                    fault.fmt_of_spheres(*ids, *count, *error, f)
                }
                FrictionOf::Floor(sphere) => fault.fmt_of_floor(*sphere, *count, *error, f),
            },
            Self::Moment { sphere, moment } => write!(
                f,
                "the horizontal forces on sphere {sphere} balance, but the moments do not: their sum is {moment:.1e} R times the \
                 largest tangential force; do spheres turn?"
            ),
            Self::Unknown { contacts, spheres } => write!(
                f,
                "the tangential force is not known at {contacts} contacts between spheres and {spheres} with the floor: add \
                 columns tx, ty, tz, or the whole force as fx, fy, fz"
            ),
            Self::OffFloor { spheres, first } => write!(
                f,
                "the table of the floor lacks {}, first sphere {first}: do they touch the floor?",
                counted(*spheres, "bottom sphere")
            ),
            Self::Fallen { spheres, first } => f.write_str(&fallen(*spheres, *first)),
            Self::Tangential(share) => write!(
                f,
                "forces have a tangential part, of up to {share:.1e} of the exact force: is there friction, or is \
                 the pile not at rest?"
            ),
        }
    }
}

impl FrictionFault {
    fn fmt_of_spheres(
        self,
        [one, other]: [u64; 2],
        count: u64,
        error: f64,
        f: &mut fmt::Formatter<'_>,
    ) -> fmt::Result {
        let contacts = counted(count, "contact");
        match self {
            Self::Absent => write!(
                f,
                "all tangential forces are 0, at {contacts}: does the table hold normal forces only?"
            ),
            Self::Reversed => write!(
                f,
                "all tangential forces have the wrong sign, at {contacts}: are they the forces on the second sphere?"
            ),
            Self::Factor(factor) => write!(
                f,
                "all tangential forces are {factor:?} times the exact ones, at {contacts}"
            ),
            Self::Other => write!(
                f,
                "tangential forces are wrong at {contacts}, most between spheres {one} and {other}, with an error of {error:.1e}"
            ),
        }
    }

    fn fmt_of_floor(
        self,
        sphere: u64,
        count: u64,
        error: f64,
        f: &mut fmt::Formatter<'_>,
    ) -> fmt::Result {
        let spheres = counted(count, "sphere");
        match self {
            Self::Absent => write!(
                f,
                "the floor has no friction, below {spheres}: does the plane have a coefficient of friction?"
            ),
            Self::Reversed => write!(
                f,
                "the friction of the floor has the wrong sign, below {spheres}: is it the force of the spheres on the floor?"
            ),
            Self::Factor(factor) => write!(
                f,
                "the friction of the floor is {factor:?} times the exact one, below {spheres}"
            ),
            Self::Other => write!(
                f,
                "the friction of the floor is wrong below {spheres}, most below sphere {sphere}, with an error of {error:.1e}"
            ),
        }
    }
}

fn fallen(spheres: u64, first: u64) -> String {
    let (others, are) = match spheres {
        1 => ("touches".to_owned(), "is"),
        2 => ("and another touch".to_owned(), "are"),
        more => (format!("and {} others touch", more - 1), "are"),
    };
    format!(
        "sphere {first} {others} the floor, but {are} above the bottom layer: has the pile fallen?"
    )
}

/// Returns a count with its noun.
fn counted(count: u64, noun: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

/// Returns the likely cause of a factor.
fn cause(factor: f64) -> &'static str {
    let near = |value: f64| (factor / value - 1.0).abs() < 2e-3;
    let power = factor.abs().log10();
    if near(-1.0) {
        "are tensile forces positive in the table?"
    } else if near(9.81) || near(1.0 / 9.81) {
        "is gravity 9.81 m/s² in one and 1 m/s² in the other?"
    } else if near(2.0) || near(0.5) {
        "are radius and diameter confused, or one sphere and a pair of spheres?"
    } else if (power - power.round()).abs() < 1e-6 {
        "are the units those of the scene (N, kg, m)?"
    } else {
        "does mass, gravity or stiffness differ from the scene?"
    }
}
