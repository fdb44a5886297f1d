//! The frame of a table: its origin and its axes relative to the scene.

use core::fmt;

use super::axes::Axes;

/// A rigid transformation from positions in a table to positions in the scene: a permutation of the axes, a rotation
/// about the vertical, and a translation.
///
/// With the axes A, the angle φ and the shift **s**, a position **x** of the table is **s** + R(φ)·A**x** in the scene.
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
    /// The axes of the table that are x, y and z of the scene, before the rotation.
    pub axes: Axes,
    /// The angle φ of the rotation about z, in radians from −π to π.
    pub angle: f64,
    /// The shift **s**, in m.
    pub shift: [f64; 3],
}

impl Frame {
    /// The identity: the frame of the scene.
    pub(super) const OWN: Self = Self {
        axes: Axes::OWN,
        angle: 0.0,
        shift: [0.0; 3],
    };

    /// Returns a vector of the table in the axes of the scene.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Axes, Frame};
    /// use cannonpile_dem::verify::Coordinate::{X, Y, Z};
    ///
    /// let axes = Axes::new([Z.into(), X.into(), Y.into()]).unwrap();
    /// let frame = Frame { axes, angle: 0.0, shift: [1.0, 0.0, 0.0] };
    /// assert_eq!(frame.turned([0.0, 2.0, 3.0]), [3.0, 0.0, 2.0]);
    /// ```
    #[must_use]
    pub fn turned(&self, vector: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.axes.turned(vector);
        // Without a rotation, no rounding error may occur.
        if self.angle == 0.0 {
            return [x, y, z];
        }
        let (sin, cos) = self.angle.sin_cos();
        [cos * x - sin * y, sin * x + cos * y, z]
    }

    /// Returns the position in the scene of a point of the table.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Axes, Frame};
    /// use cannonpile_dem::verify::Coordinate::{X, Y, Z};
    ///
    /// let axes = Axes::new([Z.into(), X.into(), Y.into()]).unwrap();
    /// let frame = Frame { axes, angle: 0.0, shift: [1.0, 0.0, 0.0] };
    /// assert_eq!(frame.place([0.0, 2.0, 3.0]), [4.0, 0.0, 2.0]);
    /// ```
    #[must_use]
    pub fn place(&self, point: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.turned(point);
        let [a, b, c] = self.shift;
        [x + a, y + b, z + c]
    }

    /// Returns whether the table is a mirror image of the scene.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Axes, Frame};
    /// use cannonpile_dem::verify::Coordinate::{X, Y, Z};
    ///
    /// let axes = Axes::new([Y.into(), X.into(), Z.into()]).unwrap();
    /// assert!(Frame { axes, angle: 0.0, shift: [0.0; 3] }.is_mirrored());
    /// ```
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        self.axes.is_mirrored()
    }
}

impl fmt::Display for Frame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        if self.axes != Axes::OWN {
            parts.push(self.axes.to_string());
        }
        if self.angle != 0.0 {
            parts.push(format!(
                "turned about z by {:.6} degrees",
                self.angle.to_degrees()
            ));
        }
        if self.shift.iter().any(|x| *x != 0.0) {
            let [x, y, z] = self.shift;
            parts.push(format!("moved by ({x:.6}, {y:.6}, {z:.6}) m"));
        }
        f.write_str(&parts.join("; "))
    }
}
