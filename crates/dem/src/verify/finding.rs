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
            Self::Tangential(share) => write!(
                f,
                "forces have a tangential part, of up to {share:.1e} of the exact force: is there friction, or is \
                 the pile not at rest?"
            ),
        }
    }
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
