//! Registration: finds the frame in which the positions of a table match a pile.
//!
//! Contacts with a force form a set of points, both in the table and in the pile. Each of six axes can be the vertical,
//! and the table may be a mirror image. In each of these cases the centroids of the two sets give the shift. The point
//! farthest from the vertical through the centroid gives candidate angles: each rotates it onto a point of the pile
//! with a similar distance and height.
//!
//! The best frame matches the most positions of a sample. Among equals, it is the frame in which the measured forces
//! are distributed most similarly to the exact ones, then the one with the smallest change. A least-squares fit to the
//! matched positions refines it.

use core::f64::consts::PI;

use super::axes::Axes;
use super::entry::Place;
use super::frame::Frame;
use super::places::{Places, is_loaded, middle, minus};

/// The number of positions in the sample that judges a frame, and in the fit of a frame.
const SAMPLE: usize = 200;
const FITTED: usize = 5000;

/// The largest number of angles tried for one vertical axis.
const MAX_TURNS: usize = 200;

/// The tolerance for rounding. Angles closer than this to a multiple of 30°, in radians, are rounded to it, and shifts
/// below it, in R, to 0. Compliant spheres are displaced by more.
const EXACT: f64 = 1e-3;

/// The rounding of angles and shifts.
#[derive(Clone, Copy)]
struct Rounding {
    radius: f64,
    /// The largest displacement of a position by rounding.
    most: f64,
}

impl Rounding {
    /// Rounds an angle to the nearest multiple of 30°, if it is close enough. All positions of the frame are at most
    /// `far` from its axis.
    fn angle(self, angle: f64, far: f64) -> f64 {
        let step = PI / 6.0;
        let multiple = (angle / step).round();
        let round = multiple * step;
        // The quotient is infinite if all positions are on the axis.
        if (angle - round).abs() < EXACT.min(self.most / far) {
            round
        } else {
            angle
        }
    }

    /// Rounds a component of a shift to 0, if it is small enough.
    fn shift(self, x: f64) -> f64 {
        if x.abs() < self.most.min(EXACT * self.radius) {
            0.0
        } else {
            x
        }
    }
}

/// A frame, with the share of a sample that it matches.
pub(super) struct Fit {
    pub(super) frame: Frame,
    pub(super) found: usize,
    pub(super) sample: usize,
    /// The mean distance of the matched positions from the exact ones, in R.
    off: f64,
    /// The total difference between the distributions of measured and exact forces.
    unlike: f64,
}

impl Fit {
    /// Returns whether this frame is better by enough to justify a greater change.
    fn is_better_than(&self, other: &Self) -> bool {
        if self.found != other.found {
            return self.found > other.found;
        }
        let nearer = other.off - self.off;
        nearer > NOTABLE || (nearer > -NOTABLE && self.unlike + ROUNDED < other.unlike / 2.0)
    }
}

/// The smallest difference between mean distances that distinguishes two frames, in R.
const NOTABLE: f64 = 0.01;

/// The rounding error in the distribution of forces.
const ROUNDED: f64 = 1e-9;

/// A position in a table, and the magnitude of the force there.
pub(super) type Loaded = (Place, f64);

/// The exact data of a pile: the points of contacts with a force, and the force between two spheres.
pub(super) struct Exact<'e> {
    pub(super) points: &'e [[f64; 3]],
    pub(super) places: &'e Places,
    pub(super) force: &'e dyn Fn([u64; 2]) -> f64,
}

/// Finds the frame in which these positions match the pile.
pub(super) fn find(table: &[Loaded], pile: &Exact<'_>, radius: f64, within: f64) -> Fit {
    let places = pile.places;
    let sample = spread(table, SAMPLE);
    let judge = |frame: Frame, within: f64| {
        let (mut found, mut off, mut forces) = (0, 0.0, Vec::new());
        for (place, force) in &sample {
            let (ids, distance) = places.nearest(&moved(place, &frame));
            if let Some(ids) = ids.filter(|_| distance <= within) {
                found += 1;
                off += distance;
                forces.push((*force, (pile.force)(ids)));
            }
        }
        Fit {
            frame,
            found,
            sample: sample.len(),
            off: off / radius / count(found),
            unlike: unlike(&forces),
        }
    };
    let own = judge(Frame::OWN, within);
    if own.found == own.sample {
        return own;
    }
    let greatest = table
        .iter()
        .fold(0.0_f64, |most, (_, force)| most.max(*force));
    let loaded = table
        .iter()
        .filter(|(_, force)| is_loaded(*force, greatest));
    let points: Vec<[f64; 3]> = loaded.map(|(place, _)| point(place)).collect();
    // Missing contacts displace the centroid by less than this.
    let near = (radius / 2.0).max(within);
    let rounding = Rounding {
        radius,
        most: within / 10.0,
    };
    let mut best = judge(Frame::OWN, near);
    for frame in candidates(&points, pile.points, rounding) {
        let fit = judge(frame, near);
        if fit.is_better_than(&best) {
            best = fit;
        }
    }
    let mut frame = best.frame;
    for _ in 0..3 {
        frame = fitted(frame, table, |place| places.point_of(place, near), rounding);
    }
    judge(frame, within)
}

/// Returns the candidate frames, those with the smallest change first.
fn candidates(points: &[[f64; 3]], pile: &[[f64; 3]], rounding: Rounding) -> Vec<Frame> {
    let mut frames = Vec::new();
    let own = Axes::all().filter(|axes| {
        // One permutation for each vertical axis, and one for its mirror image. Rotations give the others.
        let [x, _, z] = axes.get();
        !x.is_reversed && x.coordinate == z.coordinate.next()
    });
    let mut all: Vec<Axes> = own.collect();
    all.sort_by_key(|axes| (axes.is_mirrored(), *axes != Axes::OWN));
    for axes in all {
        let named: Vec<[f64; 3]> = points.iter().map(|p| axes.turned(*p)).collect();
        let [from, to] = [&named[..], pile].map(mean);
        // If contacts are missing, the lowest point may still be present.
        let sunk = lowest(pile) - lowest(&named);
        for angle in angles(&named, pile, rounding) {
            let turn = Frame {
                axes: Axes::OWN,
                angle,
                shift: [0.0; 3],
            };
            let [x, y, z] = minus(to, turn.turned(from));
            for z in [z, sunk] {
                let shift = [x, y, z];
                frames.push(Frame { axes, angle, shift });
            }
        }
    }
    frames
}

/// Returns the candidate angles, by increasing magnitude. The first is 0.
fn angles(points: &[[f64; 3]], pile: &[[f64; 3]], rounding: Rounding) -> Vec<f64> {
    let [from, to] = [points, pile].map(mean);
    let around = |point: &[f64; 3], middle: [f64; 3]| {
        let [x, y, z] = minus(*point, middle);
        (x.hypot(y), z, y.atan2(x))
    };
    let all = points.iter().map(|point| around(point, from));
    let Some((far, high, at)) = all.max_by(|(one, ..), (other, ..)| one.total_cmp(other)) else {
        return Vec::new();
    };
    let near = rounding.radius / 2.0;
    let mut angles: Vec<f64> = vec![0.0];
    for point in pile {
        let (distance, height, angle) = around(point, to);
        if (distance - far).abs() > near || (height - high).abs() > near {
            continue;
        }
        let turn = rounding.angle(wrapped(angle - at), far);
        if angles
            .iter()
            .all(|known| wrapped(known - turn).abs() > EXACT)
        {
            angles.push(turn);
        }
        if angles.len() > MAX_TURNS {
            break;
        }
    }
    angles.sort_by(|one, other| one.abs().total_cmp(&other.abs()));
    angles
}

/// Fits the rotation and the shift of a frame to the matched positions.
fn fitted(
    frame: Frame,
    table: &[Loaded],
    found: impl Fn(&Place) -> Option<[f64; 3]>,
    rounding: Rounding,
) -> Frame {
    let upright = Frame {
        angle: 0.0,
        shift: [0.0; 3],
        ..frame
    };
    let pairs = spread(table, FITTED).into_iter().filter_map(|(place, _)| {
        let to = found(&moved(place, &frame))?;
        Some((upright.turned(point(place)), to))
    });
    let (from, to): (Vec<_>, Vec<_>) = pairs.unzip();
    if from.is_empty() {
        return frame;
    }
    let [a, b] = [&from, &to].map(|points| mean(points));
    let (mut across, mut along, mut far) = (0.0, 0.0, 0.0_f64);
    for (p, q) in from.iter().zip(&to) {
        let ([x, y, _], [u, v, _]) = (minus(*p, a), minus(*q, b));
        across += x * v - y * u;
        along += x * u + y * v;
        far = far.max(x.hypot(y));
    }
    let angle = rounding.angle(across.atan2(along), far);
    let turned = Frame { angle, ..upright };
    // The axes are already permuted in these points.
    let spun = Frame {
        axes: Axes::OWN,
        ..turned
    };
    let shift = minus(b, spun.turned(a)).map(|x| rounding.shift(x));
    Frame { shift, ..turned }
}

/// Returns the total difference between the shares of the measured forces in their sum and those of the exact forces.
fn unlike(forces: &[(f64, f64)]) -> f64 {
    let (sums, exact) = forces
        .iter()
        .fold((0.0, 0.0), |(a, b), (x, y)| (a + x, b + y));
    let apart = forces.iter().map(|(x, y)| (x / sums - y / exact).abs());
    apart.sum()
}

/// Returns a position of the table, transformed by a frame.
pub(super) fn moved(place: &Place, frame: &Frame) -> Place {
    match place {
        Place::Centres(centres) => Place::Centres(centres.map(|centre| frame.place(centre))),
        Place::Point(point) => Place::Point(frame.place(*point)),
    }
}

fn point(place: &Place) -> [f64; 3] {
    match place {
        Place::Centres(centres) => middle(centres),
        Place::Point(point) => *point,
    }
}

/// Returns an evenly spaced selection of positions.
fn spread(places: &[Loaded], most: usize) -> Vec<&Loaded> {
    let step = places.len().div_ceil(most).max(1);
    places.iter().step_by(step).collect()
}

fn wrapped(angle: f64) -> f64 {
    angle - (angle / (2.0 * PI)).round() * 2.0 * PI
}

#[expect(clippy::cast_precision_loss, reason = "a count below 2^53")]
fn count(number: usize) -> f64 {
    number.max(1) as f64
}

fn mean(points: &[[f64; 3]]) -> [f64; 3] {
    let count = count(points.len());
    let sum = points
        .iter()
        .fold([0.0; 3], |[x, y, z], [u, v, w]| [x + u, y + v, z + w]);
    sum.map(|x: f64| x / count)
}

fn lowest(points: &[[f64; 3]]) -> f64 {
    points
        .iter()
        .fold(f64::INFINITY, |least, [_, _, z]| least.min(*z))
}
