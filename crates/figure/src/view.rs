//! The camera: projections of three-dimensional vectors.

use super::colour::BLACK;
use super::glyph::{Glyph, Point, arrow, text};

/// A vector x, y, z, in the axes of the exported files, z up.
pub(super) type Vector = [f64; 3];

/// Returns a + t·b.
pub(super) fn add_scaled(a: Vector, t: f64, b: Vector) -> Vector {
    [0, 1, 2].map(|n| a[n] + t * b[n])
}

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(super) fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// A camera that looks at a target. The axes right, up and back are right-handed.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    target: Vector,
    right: Vector,
    up: Vector,
    /// The unit vector from the target to the eye.
    back: Vector,
    /// The distance from the target to the eye; infinite for a parallel projection.
    distance: f64,
}

/// The projection of a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// The position to the right and upwards, in units of length at the target.
    pub(super) at: Point,
    /// The magnification relative to the target.
    pub(super) magnification: f64,
    /// The distance from the eye. In a parallel projection, the depth behind the target.
    pub(super) distance: f64,
}

impl View {
    /// Returns a camera in the direction `azimuth`, from x towards y, and `elevation` above the horizontal, in degrees.
    fn new(target: Vector, azimuth: f64, elevation: f64, distance: f64) -> Self {
        let (sin, cos) = azimuth.to_radians().sin_cos();
        let (rise, level) = elevation.to_radians().sin_cos();
        Self {
            target,
            right: [-sin, cos, 0.0],
            up: [-cos * rise, -sin * rise, level],
            back: [cos * level, sin * level, rise],
            distance,
        }
    }

    /// Returns the camera for spheres, at this azimuth and elevation in degrees. Discs are seen from −y, at infinity.
    pub(super) fn of(discs: bool, target: Vector, angles: [f64; 2], distance: f64) -> Self {
        let ([azimuth, elevation], distance) = if discs {
            ([-90.0, 0.0], f64::INFINITY)
        } else {
            (angles, distance)
        };
        Self::new(target, azimuth, elevation, distance)
    }

    pub(super) fn see(&self, point: Vector) -> Seen {
        let apart = add_scaled(point, -1.0, self.target);
        let [u, v] = self.across(apart);
        let towards = self.towards(apart);
        if self.distance.is_infinite() {
            return Seen {
                at: [u, v],
                magnification: 1.0,
                distance: -towards,
            };
        }
        let magnification = self.distance / (self.distance - towards);
        Seen {
            at: [u * magnification, v * magnification],
            magnification,
            distance: norm(add_scaled(apart, -self.distance, self.back)),
        }
    }

    /// Returns the components of a vector to the right and upwards.
    pub(super) fn across(&self, vector: Vector) -> Point {
        [dot(vector, self.right), dot(vector, self.up)]
    }

    /// Returns the component of a vector towards the eye.
    pub(super) fn towards(&self, vector: Vector) -> f64 {
        dot(vector, self.back)
    }

    /// Returns the axes x, y and z as arrows from a point of the page. Discs have no axis y.
    pub(super) fn axes(&self, [x, y]: Point, discs: bool) -> Vec<Glyph> {
        const LENGTH: f64 = 46.0;
        let basis = [
            ("x", [1.0, 0.0, 0.0]),
            ("y", [0.0, 1.0, 0.0]),
            ("z", [0.0, 0.0, 1.0]),
        ];
        let shown = basis
            .into_iter()
            .filter(|(name, _)| !(discs && *name == "y"));
        let axis = |(name, vector)| {
            let [right, up] = self.across(vector);
            let end = |length: f64| [x + right * length, y - up * length];
            // The letter of a short arrow is farther from its tip, so that letters do not overlap.
            let letter = end(LENGTH + 13.0 / right.hypot(up).max(0.1));
            let [rim, letter] = text(letter, 16.0, name).italic().with_rim();
            [
                arrow([x, y], end(LENGTH), 2.0, BLACK).class("axis"),
                rim,
                letter,
            ]
        };
        shown.flat_map(axis).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_right_handed() {
        let views = [(195.0, 17.0), (10.0, 80.0), (-90.0, 0.0)];
        for (azimuth, elevation) in views {
            let view = View::new([0.0; 3], azimuth, elevation, f64::INFINITY);
            let ([a, b, c], [d, e, f]) = (view.right, view.up);
            let cross = [b * f - c * e, c * d - a * f, a * e - b * d];
            assert!(norm(add_scaled(cross, -1.0, view.back)) < 1e-15);
            assert!((dot(view.right, view.up)).abs() < 1e-15);
        }
        // From above, with azimuth 0, x points down and y to the right.
        let view = View::new([0.0; 3], 0.0, 90.0, f64::INFINITY);
        let [x, y] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|axis| view.across(axis));
        assert!((x[1] + 1.0).abs() < 1e-15 && (y[0] - 1.0).abs() < 1e-15);
    }
}
