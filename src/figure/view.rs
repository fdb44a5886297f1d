//! Space as a camera sees it.

/// A vector of space: x and y the paper's, z up.
pub(super) type Vector = [f64; 3];

/// The sum of `a` and `t` times `b`.
pub(super) fn moved(a: Vector, t: f64, b: Vector) -> Vector {
    let mut sum = a;
    for (part, step) in sum.iter_mut().zip(b) {
        *part += t * step;
    }
    sum
}

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

pub(super) fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

/// A camera that looks at a point.
///
/// Where z points down, as in the paper, a right-handed frame has y to the right of x. The camera therefore has y on its
/// right where it looks along x, with an azimuth of 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    target: Vector,
    right: Vector,
    up: Vector,
    /// From the target to the eye.
    back: Vector,
    /// From the target to the eye; endless for a parallel projection.
    distance: f64,
}

/// A point as it is seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    /// To the right and upwards, in units of length at the target.
    pub(super) at: [f64; 2],
    /// How much larger than at the target.
    pub(super) magnification: f64,
    /// From the eye, or along the view if the eye is endlessly far.
    pub(super) distance: f64,
}

impl View {
    /// From above by `elevation`, turned by `azimuth` about the vertical, in degrees.
    pub(super) fn new(target: Vector, azimuth: f64, elevation: f64, distance: f64) -> Self {
        let (sin, cos) = azimuth.to_radians().sin_cos();
        let (rise, level) = elevation.to_radians().sin_cos();
        Self {
            target,
            right: [sin, cos, 0.0],
            up: [cos * rise, -sin * rise, level],
            back: [-cos * level, sin * level, rise],
            distance,
        }
    }

    /// From the side, across the plane of discs, from endlessly far.
    pub(super) fn of_discs(target: Vector) -> Self {
        Self {
            target,
            right: [1.0, 0.0, 0.0],
            up: [0.0, 0.0, 1.0],
            back: [0.0, 1.0, 0.0],
            distance: f64::INFINITY,
        }
    }

    pub(super) fn see(&self, point: Vector) -> Seen {
        let apart = moved(point, -1.0, self.target);
        let [u, v] = [dot(apart, self.right), dot(apart, self.up)];
        let towards = dot(apart, self.back);
        if self.distance.is_infinite() {
            return Seen {
                at: [u, v],
                magnification: 1.0,
                distance: -towards,
            };
        }
        let magnification = self.distance / (self.distance - towards);
        let from_eye = moved(apart, -self.distance, self.back);
        Seen {
            at: [u * magnification, v * magnification],
            magnification,
            distance: norm(from_eye),
        }
    }

    /// How a short vector at the target is seen, from endlessly far.
    pub(super) fn across(&self, vector: Vector) -> [f64; 2] {
        [dot(vector, self.right), dot(vector, self.up)]
    }

    /// How much of a short vector points to the eye.
    pub(super) fn towards(&self, vector: Vector) -> f64 {
        dot(vector, self.back)
    }
}
