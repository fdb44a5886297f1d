//! The frame of a table: its origin and its axes relative to the scene.

use crate::Each;
use core::fmt;

use super::axes::Axes;
use crate::vector::plus;

/// A transformation from positions in a table to positions in the scene: a permutation of the axes with signs, a turn
/// about the vertical, and a translation.
///
/// A position **x** of the table is R A **x** + **s** in the scene, with the permutation A, the turn R about z, and the
/// shift **s**.
///
/// # Examples
/// ```
/// use cannonpile::{Packing, Pile};
/// use cannonpile_dem::verify::Reader;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &"1".parse()?)?;
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
    /// The axes of the table that are x, y and z of the scene, up to the turn.
    pub axes: Axes,
    /// The angle of the turn about z of the scene, in radians.
    pub angle: f64,
    /// The shift **s**, in m.
    pub shift: [f64; 3],
}

impl Frame {
    /// The identity: the frame of the scene.
    pub(super) const OWN: Self = Self::along(Axes::OWN);

    /// Returns the frame that permutes the axes.
    pub(super) const fn along(axes: Axes) -> Self {
        Self {
            axes,
            angle: 0.0,
            shift: [0.0; 3],
        }
    }

    /// Returns a vector of the table in the axes of the scene.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::Coordinate::{X, Y, Z};
    /// use cannonpile_dem::verify::{Axes, Frame};
    ///
    /// let axes = Axes::new([Z.into(), X.into(), Y.into()]).unwrap();
    /// let frame = Frame { axes, angle: 0.0, shift: [1.0, 0.0, 0.0] };
    /// assert_eq!(frame.turned([0.0, 2.0, 3.0]), [3.0, 0.0, 2.0]);
    /// assert_eq!(frame.place([0.0, 2.0, 3.0]), [4.0, 0.0, 2.0]);
    /// ```
    #[must_use]
    pub fn turned(&self, vector: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.axes.turned(vector);
        let (sin, cos) = self.angle.sin_cos();
        // The floats nearest to multiples of 30° have sines and cosines that are not quite 0, 1/2 and 1.
        let [sin, cos] = [sin, cos].each(|x| {
            let halves = (2.0 * x).round() / 2.0;
            if (x - halves).abs() < 1e-15 {
                halves
            } else {
                x
            }
        });
        [cos * x - sin * y, sin * x + cos * y, z]
    }

    /// Returns the position in the scene of a point of the table.
    #[must_use]
    pub fn place(&self, point: [f64; 3]) -> [f64; 3] {
        plus(self.turned(point), self.shift)
    }
}

impl fmt::Display for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        if self.axes != Axes::OWN {
            parts.push(self.axes.to_string());
        }
        if self.angle != 0.0 {
            let degrees = self.angle.to_degrees();
            parts.push(format!("turned about z by {degrees:.6} degrees"));
        }
        if self.shift.iter().any(|x| *x != 0.0) {
            // Without negative zeros.
            let [x, y, z] = self.shift.each(|x| if x.abs() < 5e-7 { 0.0 } else { x });
            parts.push(format!("moved by ({x:.6}, {y:.6}, {z:.6}) m"));
        }
        f.write_str(&parts.join("; "))
    }
}
