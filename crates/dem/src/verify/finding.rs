//! Explanations of many differences at once.

use core::fmt;

use super::axes::Axes;

/// An explanation of the differences between measured and exact forces.
///
/// It is a guess at the cause, and is reported only if all data agree with it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// All measured forces equal the exact ones times one factor.
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
