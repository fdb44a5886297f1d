//! The frame of a table: its origin and its axes relative to the scene.

use crate::Each;
use core::fmt;

use super::axes::Axes;
use crate::vector::{cross, dot, plus};

/// A rigid transformation from positions in a table to positions in the scene: a rotation about any axis or a mirror
/// image, and a translation.
///
/// With the orthogonal matrix M and the shift **s**, a position **x** of the table is M**x** + **s** in the scene.
///
/// # Examples
/// ```
/// use cannonpile::geometry::Spacing;
/// use cannonpile_dem::verify::Reader;
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(1.into(), 1.into()))?)?;
/// // In other codes the vertical may be y.
/// let table = "x1,y1,z1,x2,y2,z2,force\n0,9.633,0,-1.1547,8,0,0.408\n\
///              0,9.633,0,0.57735,8,-1,0.408\n0,9.633,0,0.57735,8,1,0.408\n";
/// let read = Reader::new().by_place(0.1)?.compare(&packing, table.as_bytes())?;
/// let frame = read.frame.unwrap();
/// assert!(frame.to_string().starts_with("x, y, z of the scene are "), "{frame}");
/// assert_eq!(read.comparison.matched(), 3);
/// # Ok::<(), cannonpile_dem::verify::Refusal>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The orthogonal matrix M. Its rows are x, y and z of the scene in the axes of the table.
    pub rotation: [[f64; 3]; 3],
    /// The shift **s**, in m.
    pub shift: [f64; 3],
}

impl Frame {
    /// The identity: the frame of the scene.
    pub(super) const OWN: Self = Self {
        rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        shift: [0.0; 3],
    };

    /// Returns the frame that permutes the axes, turns about z by an angle in radians, and then shifts.
    pub(super) fn upright(axes: Axes, angle: f64, shift: [f64; 3]) -> Self {
        let (sin, cos) = angle.sin_cos();
        // The floats nearest to multiples of 30° have sines and cosines that are not quite 0, 1/2 and 1.
        let [sin, cos] = [sin, cos].each(|x| {
            let halves = (2.0 * x).round() / 2.0;
            if (x - halves).abs() < 1e-15 {
                halves
            } else {
                x
            }
        });
        let [x, y, z] = axes.matrix();
        let mix = |a: f64, b: f64| [0, 1, 2].each(|n| a * x[n] + b * y[n]);
        Self {
            rotation: [mix(cos, -sin), mix(sin, cos), z],
            shift,
        }
    }

    /// Returns the nearest axes of the table, up to a turn about z.
    pub(super) fn axes(&self) -> Axes {
        let [_, _, up] = self.rotation;
        Axes::upright(up, self.is_mirrored())
    }

    /// Returns the angle of the turn about z that follows the permutation of the axes, in radians from −π to π.
    pub(super) fn angle(&self) -> f64 {
        let [x, _, _] = self.axes().matrix();
        let [cos, sin, _] = self.turned(x);
        sin.atan2(cos)
    }

    /// Returns a vector of the table in the axes of the scene.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Frame;
    ///
    /// let rotation = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    /// let frame = Frame { rotation, shift: [1.0, 0.0, 0.0] };
    /// assert_eq!(frame.turned([0.0, 2.0, 3.0]), [3.0, 0.0, 2.0]);
    /// ```
    #[must_use]
    pub fn turned(&self, vector: [f64; 3]) -> [f64; 3] {
        self.rotation.each(|row| dot(row, vector))
    }

    /// Returns the position in the scene of a point of the table.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Frame;
    ///
    /// let rotation = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    /// let frame = Frame { rotation, shift: [1.0, 0.0, 0.0] };
    /// assert_eq!(frame.place([0.0, 2.0, 3.0]), [4.0, 0.0, 2.0]);
    /// ```
    #[must_use]
    pub fn place(&self, point: [f64; 3]) -> [f64; 3] {
        plus(self.turned(point), self.shift)
    }

    /// Returns whether the table is a mirror image of the scene.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Frame;
    ///
    /// let rotation = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    /// assert!(Frame { rotation, shift: [0.0; 3] }.is_mirrored());
    /// ```
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        let [x, y, z] = self.rotation;
        dot(x, cross(y, z)) < 0.0
    }
}

impl fmt::Display for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, _, up] = self.rotation;
        let mut parts = Vec::new();
        if up.iter().filter(|component| **component == 0.0).count() == 2 {
            let permuted = Axes::all().find(|axes| axes.matrix() == self.rotation);
            let (axes, angle) = match permuted {
                // Turns about z by right angles are said as turns, although they permute the axes.
                Some(axes) if self.axes() != Axes::OWN => (axes, 0.0),
                _ => (self.axes(), self.angle()),
            };
            if axes != Axes::OWN {
                parts.push(axes.to_string());
            }
            if angle != 0.0 {
                parts.push(format!(
                    "turned about z by {:.6} degrees",
                    angle.to_degrees()
                ));
            }
        } else {
            let mirrored = if self.is_mirrored() {
                ", a mirror image"
            } else {
                ""
            };
            parts.push(format!(
                "gravity is along {} of the table, and x of the scene along {}{mirrored}",
                text(up.each(|component| -component)),
                text(x)
            ));
        }
        if self.shift.iter().any(|x| *x != 0.0) {
            parts.push(format!("moved by {} m", text(self.shift)));
        }
        f.write_str(&parts.join("; "))
    }
}

/// Returns a vector with six decimals, without negative zeros.
fn text(vector: [f64; 3]) -> String {
    let [x, y, z] = vector.each(|x| if x.abs() < 5e-7 { 0.0 } else { x });
    format!("({x:.6}, {y:.6}, {z:.6})")
}
