//! What differences have in common, in words.

use core::fmt;

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
    Axes([Axis; 3]),
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

/// An axis of a table, and whether it is reversed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Axis {
    /// 0 for x, 1 for y, 2 for z.
    pub index: usize,
    /// Whether it points the other way.
    pub is_reversed: bool,
}

impl Axis {
    /// x, y and z as they are.
    pub(super) const OWN: [Self; 3] = [Self::along(0), Self::along(1), Self::along(2)];

    const fn along(index: usize) -> Self {
        Self {
            index,
            is_reversed: false,
        }
    }

    /// Returns the component of a vector along it.
    pub(super) fn of(self, vector: [f64; 3]) -> f64 {
        let component = vector.get(self.index).copied().unwrap_or(f64::NAN);
        if self.is_reversed {
            0.0 - component
        } else {
            component
        }
    }

    /// Returns a vector in these axes.
    pub(super) fn turn(axes: [Self; 3], vector: [f64; 3]) -> [f64; 3] {
        axes.map(|axis| axis.of(vector))
    }

    /// Returns whether these axes are a mirror image of x, y and z.
    pub(super) fn is_mirrored(axes: [Self; 3]) -> bool {
        let [x, y, z] = axes.map(|axis| axis.index);
        let is_odd = matches!((x, y, z), (0, 2, 1) | (2, 1, 0) | (1, 0, 2));
        let reversed = axes.iter().filter(|axis| axis.is_reversed).count();
        is_odd != (reversed % 2 == 1)
    }

    /// All 48 ways in which axes can be named and pointed.
    pub(super) fn all() -> impl Iterator<Item = [Self; 3]> {
        let orders = [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ];
        orders.into_iter().flat_map(|order| {
            (0..8_u8).map(move |signs| {
                let mut bit = 0;
                order.map(|index| {
                    bit += 1;
                    Self {
                        index,
                        is_reversed: signs >> (bit - 1) & 1 == 1,
                    }
                })
            })
        })
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.is_reversed { "-" } else { "" };
        let name = ["x", "y", "z"].get(self.index).copied().unwrap_or("?");
        write!(f, "{sign}{name}")
    }
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
            Self::Axes(axes) => {
                let [x, y, z] = axes;
                write!(f, "x, y, z of the scene are {x}, {y}, {z} of the table")?;
                if Axis::is_mirrored(*axes) {
                    f.write_str(": a mirror image")?;
                }
                Ok(())
            }
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
