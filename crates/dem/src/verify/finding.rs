//! What differences have in common, in words.

use core::fmt;

use super::axes::Axes;

/// What the differences between measured and exact forces have in common.
///
/// Each is a guess at the cause, told only where all data agree with it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Finding {
    /// All measured forces are the exact ones times one factor.
    Factor(f64),
    /// All vectors are the forces on the second of the two spheres, not on the first.
    SecondSphere,
    /// All vectors are right in other axes: each axis of the scene is one of the table, reversed or not.
    Axes(Axes),
    /// All contacts of a layer with the one below are missing.
    Layer {
        /// The layer, counted from 0 at the top.
        k: i128,
        /// How many contacts it has.
        contacts: u64,
        /// Whether the layer below is the bottom layer, which is fixed.
        is_lowest: bool,
    },
    /// Forces have a part along the surfaces, of up to this share of the exact force.
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
                "all vectors are the forces on the second of the two spheres: they must be those on the first, or the two be \
                 swapped",
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
                "forces have a part along the surfaces, of up to {share:.1e} of the exact force: is there friction, or is \
                 the pile not at rest?"
            ),
        }
    }
}

/// What may have made a factor.
fn cause(factor: f64) -> &'static str {
    let near = |value: f64| (factor / value - 1.0).abs() < 2e-3;
    let power = factor.abs().log10();
    if near(-1.0) {
        "is pull positive in the table?"
    } else if near(9.81) || near(1.0 / 9.81) {
        "is gravity 9.81 m/s² in one and 1 m/s² in the other?"
    } else if near(2.0) || near(0.5) {
        "are radius and diameter, or one and two spheres, mistaken?"
    } else if (power - power.round()).abs() < 1e-6 {
        "are the units those of the scene (N, kg, m)?"
    } else {
        "have mass, gravity or stiffness other values than in the scene?"
    }
}
