//! The least-squares fit of a frame: as for a rigid body, a torque over a moment of inertia is a turn.

use super::frame::Frame;
use crate::Each;
use crate::vector::{cross, dot, minus, plus, solved, transposed, turned};

/// The smallest moment of inertia that determines a turn, as a share of their sum.
const THIN: f64 = 1e-13;

/// The moments of pairs of points: one in a table, and its exact position.
pub(super) struct Moments {
    /// The centroid in the table.
    from: [f64; 3],
    /// The centroid in the scene.
    to: [f64; 3],
    inertia: [[f64; 3]; 3],
    torque: [f64; 3],
}

impl Moments {
    /// Returns the moments of points that a frame moves close to their exact positions. `None` without points.
    pub(super) fn new(pairs: &[([f64; 3], [f64; 3])], frame: &Frame, radius: f64) -> Option<Self> {
        if pairs.is_empty() {
            return None;
        }
        let [from, to] = {
            let sums = pairs
                .iter()
                .fold([[0.0; 3]; 2], |[a, b], (p, q)| [plus(a, *p), plus(b, *q)]);
            #[expect(clippy::cast_precision_loss, reason = "a count below 2^53")]
            let count = pairs.len() as f64;
            sums.each(|sum| sum.each(|x| x / count))
        };
        let (mut inertia, mut torque) = ([[0.0; 3]; 3], [0.0; 3]);
        for (p, q) in pairs {
            let p = frame.turned(minus(*p, from)).each(|x| x / radius);
            let q = minus(*q, to).each(|x| x / radius);
            let square = dot(p, p);
            for (n, row) in inertia.iter_mut().enumerate() {
                *row = minus(*row, p.each(|x| x * p[n]));
                row[n] += square;
            }
            torque = plus(torque, cross(p, q));
        }
        Some(Self {
            from,
            to,
            inertia,
            torque,
        })
    }

    /// Returns the frame, turned and shifted to reduce the squares of the distances. Repetition leads to the least ones.
    pub(super) fn fitted(&self, frame: &Frame) -> Frame {
        let [[x, ..], [_, y, _], [.., z]] = self.inertia;
        let mut inertia = self.inertia;
        for (n, row) in inertia.iter_mut().enumerate() {
            // Points in a line determine no turn about it.
            row[n] += THIN * (x + y + z);
        }
        let about = solved(inertia, self.torque);
        let rotation = if about.iter().all(|x| x.is_finite()) {
            transposed(transposed(frame.rotation).each(|column| turned(column, about)))
        } else {
            frame.rotation
        };
        let frame = Frame { rotation, ..*frame };
        let shift = self.shift(&frame);
        Frame { shift, ..frame }
    }

    /// Returns the shift that moves the centroid of the table to its exact position.
    pub(super) fn shift(&self, frame: &Frame) -> [f64; 3] {
        minus(self.to, frame.turned(self.from))
    }

    /// Returns the angle of the turn about z that reduces the squares of the distances most.
    pub(super) fn turn(&self) -> f64 {
        let [[x, ..], [_, y, _], [.., z]] = self.inertia;
        // Points on the axis determine no turn.
        if z <= THIN * (x + y + z) {
            return 0.0;
        }
        let [_, _, torque] = self.torque;
        torque / z
    }
}
