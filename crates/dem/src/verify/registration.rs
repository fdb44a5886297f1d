//! Registration: finds the frame in which the positions of a table match a pile.
//!
//! Contacts with a force form a set of points, both in the table and in the pile. Up to three anchors are points of the
//! table that are far apart. Three points of the pile with similar distances from each other, and from the centroid of
//! the pile, yield two candidate frames: a rotation and a mirror image. Missing contacts displace the centroid, so the
//! accepted distance grows until a frame is found.
//!
//! A least-squares fit to the matched positions refines each candidate. The best frame matches the most positions of a
//! sample. Among equals, it is the frame in which the measured forces are distributed most similarly to the exact ones,
//! then the one with the smallest change. Finally, a simpler frame replaces it if it matches as well: an upright one,
//! one with a multiple of 30° as its angle, and one without a shift.

use core::f64::consts::PI;

use contact_tables::{Force, Place, Rows};

use super::axes::Coordinate;
use super::frame::Frame;
use super::loaded::{LoadedContacts, is_loaded};
use super::measured::{distance, magnitude, norm};
use super::moments::Moments;
use super::placed::Placed;
use super::places::Found;
use crate::vector::{cross, dot, minus, plus, unit};
use crate::{Each, Error};
use cannonpile::Interrupt;

/// The numbers of positions that reject a candidate, that fit one, that judge one, and that fit the best one.
const FEW: usize = 16;
const SOME: usize = 200;
const SAMPLE: usize = 1000;
const MANY: usize = 5000;

/// The number of times that a frame is fitted. Each time, more positions may be matched to their own contacts.
const FITS: usize = 6;

/// The largest number of points of the pile that one anchor may be, and of sets of such points.
const MAX_IMAGES: usize = 1000;
const MAX_SETS: usize = 4000;

/// How often the accepted distance from the centroid is doubled.
const ROUNDS: usize = 5;

/// The tolerance for rounding. Angles closer than this to a multiple of 30°, in radians, are rounded to it, and shifts
/// below it, in R, to 0.
const EXACT: f64 = 1e-3;

/// The smallest difference between mean distances that distinguishes two frames, in R.
const NOTABLE: f64 = 0.01;

/// The rounding error of mean distances, in R, and of the distribution of forces.
const ROUNDED: f64 = 1e-9;

/// The largest difference between the distributions of forces in a frame that needs no alternatives. Forces on other
/// contacts than their own differ by about 1.
const ALIKE: f64 = 0.1;

/// A frame, with the share of a sample that it matches.
#[derive(Clone, Copy)]
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

    /// Returns whether no other frame can be much better.
    fn is_convincing(&self, is_complete: bool) -> bool {
        10 * self.found >= 9 * self.sample && (is_complete || self.unlike < ALIKE)
    }
}

/// A table, and the pile that it is matched to.
struct Search<'s> {
    rows: &'s Rows,
    pile: &'s LoadedContacts<'s, 's>,
    radius: f64,
    within: f64,
    /// The largest distance of a position from its exact one in a candidate frame.
    near: f64,
    greatest: f64,
    /// The number of rows that may be contacts between spheres.
    count: usize,
    /// True if all rows have both centres.
    by_centres: bool,
}

/// Points of the table that are far apart, and the points of the pile around their image.
struct Anchors {
    points: Vec<[f64; 3]>,
    /// The distances of the anchors from the centroid of the table.
    distances: Vec<f64>,
    /// The centroid of the pile, and the largest distance of a point from it.
    middle: [f64; 3],
    reach: f64,
    with_floor: bool,
    /// True if the table has at least as many contacts as the pile.
    is_complete: bool,
}

impl Anchors {
    /// Returns whether a frame is a mirror image, and the images of the anchors.
    fn images(&self, frame: &Frame) -> (bool, Vec<[f64; 3]>) {
        let images = self.points.iter().map(|point| frame.place(*point));
        (frame.is_mirrored(), images.collect())
    }
}

/// Finds the frame in which these positions match the pile.
pub(super) fn find(
    rows: &Rows,
    pile: &LoadedContacts<'_, '_>,
    radius: f64,
    within: f64,
) -> Result<Fit, Error> {
    let search = Search::new(rows, pile, radius, within);
    let [few, some, sample, many] = [FEW, SOME, SAMPLE, MANY].map(|most| search.spread(most));
    let own = search.judge(&sample, Frame::OWN, within);
    if sample.is_empty() {
        let sample = rows.len();
        return Ok(Fit { sample, ..own });
    }
    if own.found == own.sample {
        return Ok(own);
    }
    let mut best = search.judge(&sample, Frame::OWN, search.near);
    for with_floor in [false, true] {
        let anchors = search.anchors(with_floor)?;
        let mut slack = search.near;
        let mut tried: Vec<(bool, Vec<[f64; 3]>)> = Vec::new();
        for _ in 0..ROUNDS {
            for frame in search.candidates(&anchors, slack)? {
                Interrupt::check()?;
                let (is_mirrored, images) = anchors.images(&frame);
                let is_known = tried.iter().any(|(is_reflection, known)| {
                    let mut off = images.iter().zip(known).map(|(a, b)| distance(*a, *b));
                    *is_reflection == is_mirrored && off.all(|off| off < search.near / 2.0)
                });
                if is_known || 2 * search.judge(&few, frame, search.near).found < few.len() {
                    continue;
                }
                let frame = search.fitted(&some, frame);
                tried.push(anchors.images(&frame));
                let fit = search.judge(&sample, frame, search.near);
                if fit.is_better_than(&best) {
                    best = fit;
                }
            }
            slack *= 2.0;
            if best.is_convincing(anchors.is_complete) || slack > anchors.reach {
                break;
            }
        }
        if best.is_convincing(anchors.is_complete) {
            break;
        }
    }
    Ok(search.simplest(&many, best.frame))
}

impl<'s> Search<'s> {
    fn new(rows: &'s Rows, pile: &'s LoadedContacts<'s, 's>, radius: f64, within: f64) -> Self {
        let magnitudes = rows.iter().map(|row| magnitude(row.force));
        let mut search = Self {
            rows,
            pile,
            radius,
            within,
            near: (radius / 2.0).max(within),
            greatest: magnitudes.fold(0.0, f64::max),
            count: 0,
            by_centres: Placed::all(rows).all(|row| matches!(row.place, Place::Centres(_))),
        };
        search.count = search.loaded().count();
        search
    }

    /// Returns the rows with a force that may be contacts between spheres.
    fn loaded(&self) -> impl Iterator<Item = Placed> {
        Placed::all(self.rows).filter(|row| {
            let touches = match row.place {
                Place::Centres([one, other]) => {
                    (distance(one, other) - 2.0 * self.radius).abs() <= 2.0 * self.within
                }
                Place::Point(_) => true,
            };
            touches && is_loaded(magnitude(row.force), self.greatest)
        })
    }

    /// Returns an evenly spaced selection of rows.
    fn spread(&self, most: usize) -> Vec<Placed> {
        let step = self.count.div_ceil(most).max(1);
        self.loaded().step_by(step).collect()
    }

    /// Returns the points of a position that are matched.
    fn points(&self, place: Place) -> impl Iterator<Item = [f64; 3]> + use<> {
        let points = match place {
            Place::Centres([one, other]) if self.by_centres => [Some(one), Some(other)],
            _ => [Some(place.point()), None],
        };
        points.into_iter().flatten()
    }

    fn judge(&self, sample: &[Placed], frame: Frame, within: f64) -> Fit {
        let places = self.pile.places();
        let (mut found, mut off, mut forces) = (0, 0.0, Vec::new());
        for row in sample {
            let place = row.place.map(|point| frame.place(point));
            let (contact, distance) = places.nearest(&place, within);
            let Some(contact) = contact else { continue };
            found += 1;
            off += distance;
            if let Found::Spheres(ids) = contact
                && let Ok([first, second]) = places.centres_of(ids)
            {
                let measured = row.force.map(|vector| frame.turned(vector));
                let normal = unit(minus(first, second));
                let force = self.pile.force(ids);
                forces.push((measured, normal.each(|n| n * force)));
            }
        }
        Fit {
            frame,
            found,
            sample: sample.len(),
            off: off / self.radius / count(found),
            unlike: unlike(&forces),
        }
    }

    /// Fits the rotation and the shift of a frame to the matched positions of some rows.
    fn fitted(&self, rows: &[Placed], mut frame: Frame) -> Frame {
        for _ in 0..FITS {
            if let Some(moments) = self.moments(rows, &frame) {
                frame = moments.fitted(&frame);
            }
        }
        frame
    }

    fn moments(&self, rows: &[Placed], frame: &Frame) -> Option<Moments> {
        let mut pairs = Vec::new();
        for row in rows {
            let place = row.place.map(|point| frame.place(point));
            let (contact, _) = self.pile.places().nearest(&place, self.near);
            if let Some(Found::Spheres(ids)) = contact
                && let Ok(centres) = self.pile.places().centres_of(ids)
            {
                let exact = self.points(Place::Centres(centres));
                pairs.extend(self.points(row.place).zip(exact));
            }
        }
        Moments::new(&pairs, frame, self.radius)
    }

    /// Chooses the anchors.
    fn anchors(&self, with_floor: bool) -> Result<Anchors, Error> {
        let (mut number, mut sum, mut reach) = (0, [0.0; 3], 0.0_f64);
        self.pile.each(with_floor, |place| {
            for point in self.points(place) {
                number += 1;
                sum = plus(sum, point);
            }
        })?;
        let middle = sum.each(|x| x / count(number));
        self.pile.each(with_floor, |place| {
            for point in self.points(place) {
                reach = reach.max(distance(point, middle));
            }
        })?;
        let table = || self.loaded().flat_map(|row| self.points(row.place));
        let (mut listed, mut sum) = (0, [0.0; 3]);
        for point in table() {
            listed += 1;
            sum = plus(sum, point);
        }
        let from = sum.each(|x| x / count(listed));
        // Points farther away than any contact are not in the pile.
        let missing = 1.0 - count(listed) / count(number);
        let limit = reach + self.near.max(missing * reach);
        let farthest = |far: &dyn Fn([f64; 3]) -> f64| {
            let points = table().filter(|point| distance(*point, from) <= limit);
            let all = points.map(|point| (far(point), point));
            all.max_by(|(one, _), (other, _)| one.total_cmp(other))
        };
        let mut points = Vec::new();
        if let Some((_, first)) = farthest(&|point| distance(point, from)) {
            points.push(first);
            let apart = self.radius / 4.0;
            let second = farthest(&|point| distance(point, first));
            if let Some((_, second)) = second.filter(|(far, _)| *far > apart) {
                points.push(second);
                let along = unit(minus(second, first));
                let third = farthest(&|point| norm(cross(minus(point, first), along)));
                points.extend(
                    third
                        .filter(|(far, _)| *far > apart)
                        .map(|(_, third)| third),
                );
            }
        }
        Ok(Anchors {
            distances: points.iter().map(|point| distance(*point, from)).collect(),
            points,
            middle,
            reach,
            with_floor,
            is_complete: listed >= number,
        })
    }

    /// Returns the candidate frames, those with the smallest change first. The centroid of the table may be displaced
    /// by `slack`.
    fn candidates(&self, anchors: &Anchors, slack: f64) -> Result<Vec<Frame>, Error> {
        let mut images: Vec<Vec<(f64, [f64; 3])>> = vec![Vec::new(); anchors.points.len()];
        self.pile.each(anchors.with_floor, |place| {
            for point in self.points(place) {
                let far = distance(point, anchors.middle);
                for (images, distance) in images.iter_mut().zip(&anchors.distances) {
                    let off = (far - distance).abs();
                    if off <= slack {
                        images.push((off, point));
                    }
                }
            }
        })?;
        for images in &mut images {
            images.sort_by(|(one, a), (other, b)| {
                let order = one.total_cmp(other);
                a.iter()
                    .zip(b)
                    .fold(order, |order, (x, y)| order.then(x.total_cmp(y)))
            });
            images.dedup();
            images.truncate(MAX_IMAGES);
        }
        let mut sets: Vec<Vec<[f64; 3]>> = vec![Vec::new()];
        for (n, (images, anchor)) in images.iter().zip(&anchors.points).enumerate() {
            let known = &anchors.points[..n];
            let longer = sets.iter().flat_map(|set| {
                let fits = |image: &[f64; 3]| {
                    let mut pairs = set.iter().zip(known);
                    pairs.all(|(a, b)| {
                        (distance(*a, *image) - distance(*b, *anchor)).abs() <= self.near
                    })
                };
                let images = images.iter().map(|(_, image)| *image);
                images
                    .filter(fits)
                    .map(|image| [&set[..], &[image]].concat())
            });
            sets = longer.take(MAX_SETS).collect();
        }
        let motions = sets.iter().flat_map(|set| {
            // Fewer than three points have no mirror images.
            let mirrored = (set.len() == 3).then_some(true);
            let all = [false].into_iter().chain(mirrored);
            all.filter_map(|is_mirrored| motion(&anchors.points, set, is_mirrored))
        });
        let mut frames: Vec<_> = motions
            .map(|frame| (self.change(&frame, anchors.reach), frame))
            .collect();
        frames.sort_by(|((kind, angle, shift), _), ((other, more, far), _)| {
            let order = kind.cmp(other).then(angle.total_cmp(more));
            order.then(shift.total_cmp(far))
        });
        Ok(frames.into_iter().map(|(_, frame)| frame).collect())
    }

    /// Returns the change of a frame: its kind, its turn about the nearest axes, and its shift. Rotations come before
    /// mirror images. Among them z is the vertical first, then another axis, then no axis.
    fn change(&self, frame: &Frame, reach: f64) -> ((bool, u8), f64, f64) {
        let axes = frame.axes();
        let matrix = axes.matrix();
        let [x, y, tilt] = [0, 1, 2].each(|n| distance(frame.rotation[n], matrix[n]));
        let [_, _, vertical] = axes.get();
        let kind = if tilt * reach > self.near {
            2
        } else {
            u8::from(vertical != Coordinate::Z.into())
        };
        (
            (frame.is_mirrored(), kind),
            norm([x, y, tilt]),
            norm(frame.shift),
        )
    }

    /// Fits a frame, and returns the simplest one that matches as many positions, and about as well.
    fn simplest(&self, rows: &[Placed], frame: Frame) -> Fit {
        let mut best = self.judge(rows, self.fitted(rows, frame), self.within);
        let (found, off) = (best.found, 2.0 * best.off + ROUNDED);
        let replace = |best: &mut Fit, frame| {
            let fit = self.judge(rows, frame, self.within);
            let is_as_good = fit.found >= found && fit.off <= off;
            if is_as_good {
                *best = fit;
            }
            is_as_good
        };
        let (axes, mut angle) = (best.frame.axes(), best.frame.angle());
        let upright = |angle: f64, moments: &Moments| {
            let frame = Frame::upright(axes, angle, [0.0; 3]);
            let shift = moments.shift(&frame);
            Frame { shift, ..frame }
        };
        if let Some(mut moments) = self.moments(rows, &best.frame) {
            for _ in 0..3 {
                let frame = upright(angle, &moments);
                let Some(fitted) = self.moments(rows, &frame) else {
                    break;
                };
                angle += fitted.turn();
                moments = fitted;
            }
            let step = PI / 6.0;
            let rounded = (angle / step).round() * step;
            if replace(&mut best, upright(angle, &moments)) && (angle - rounded).abs() < EXACT {
                replace(&mut best, upright(rounded, &moments));
            }
        }
        let small = EXACT * self.radius;
        let shift = best
            .frame
            .shift
            .each(|x| if x.abs() < small { 0.0 } else { x });
        let frame = Frame {
            shift,
            ..best.frame
        };
        replace(&mut best, frame);
        best
    }
}

/// Returns the frame that moves some points onto others. For fewer than three points, the rotation is as small as
/// possible.
fn motion(from: &[[f64; 3]], to: &[[f64; 3]], is_mirrored: bool) -> Option<Frame> {
    let apart = |points: &[[f64; 3]], n: usize| Some(minus(*points.get(n)?, *points.first()?));
    let both = |n| apart(from, n).zip(apart(to, n));
    // The image of a single point is not turned.
    let (p, q) = both(1).unwrap_or(([1.0, 0.0, 0.0], [1.0, 0.0, 0.0]));
    // Without a third point, the plane of both directions is kept.
    let (r, s) = both(2).unwrap_or([perpendicular(p, q); 2].into());
    let [old, mut new] = [[p, r], [q, s]].each(|[first, second]| {
        let x = unit(first);
        let along = dot(second, x);
        let y = unit(minus(second, x.each(|component| component * along)));
        [x, y, cross(x, y)]
    });
    if is_mirrored {
        new[2] = new[2].each(|component| -component);
    }
    let entry = |row: usize, column: usize| (0..3).map(|n| new[n][row] * old[n][column]).sum();
    let rotation = [0, 1, 2].each(|row| [0, 1, 2].each(|column| entry(row, column)));
    let turned = Frame {
        rotation,
        shift: [0.0; 3],
    };
    let shift = minus(mean(to), turned.turned(mean(from)));
    let is_finite = rotation.iter().flatten().all(|x: &f64| x.is_finite());
    is_finite.then_some(Frame { rotation, shift })
}

/// Returns a vector perpendicular to two others.
fn perpendicular(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let both = cross(unit(a), unit(b));
    if norm(both) > ROUNDED {
        return both;
    }
    let [x, y, z] = a.each(f64::abs);
    let axis = if x <= y && x <= z {
        [1.0, 0.0, 0.0]
    } else if y <= z {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    cross(a, axis)
}

/// Returns the total difference between the measured forces, as shares of their sum, and the exact ones. At a contact
/// point, a vector may be the force on either sphere.
fn unlike(forces: &[(Force, [f64; 3])]) -> f64 {
    let size = |force: &Force| match force {
        Force::Along(force) => force.abs(),
        Force::Vector(vector) | Force::Both(_, vector) => norm(*vector),
    };
    let sum: f64 = forces.iter().map(|(force, _)| size(force)).sum();
    let all: f64 = forces.iter().map(|(_, exact)| norm(*exact)).sum();
    let apart = forces.iter().map(|(force, exact)| {
        let exact = exact.each(|x| x / all);
        match force {
            Force::Along(force) => (force.abs() / sum - norm(exact)).abs(),
            Force::Vector(vector) | Force::Both(_, vector) => {
                let share = vector.each(|x| x / sum);
                let [one, other] = [minus(share, exact), plus(share, exact)].each(norm);
                one.min(other)
            }
        }
    });
    apart.sum()
}

#[expect(clippy::cast_precision_loss, reason = "a count below 2^53")]
fn count(number: usize) -> f64 {
    number.max(1) as f64
}

fn mean(points: &[[f64; 3]]) -> [f64; 3] {
    let sum = points.iter().fold([0.0; 3], |sum, point| plus(sum, *point));
    sum.each(|x| x / count(points.len()))
}
