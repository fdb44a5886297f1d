//! Registration: finds the frame in which the positions of a table match a pile.
//!
//! Contacts with a force form a set of points, both in the table and in the pile. Each of the twelve choices of a vertical
//! axis, with its mirror image, leaves a turn about the vertical and a shift. Two anchors are points of the table that are
//! far apart. Two points of the pile with the same difference in height, the same horizontal distance, and similar
//! distances from the centroid yield a candidate. Missing contacts displace the centroid, so the accepted distance grows
//! until a frame is found.
//!
//! A least-squares fit to the matched positions refines each candidate. The best frame matches the most positions of a
//! sample. Among equals, it is the frame in which the measured forces are distributed most similarly to the exact ones,
//! then the one with the smallest change. Finally, a simpler frame replaces it if it matches as well: one with a multiple
//! of 30° as its angle, and one without a shift.

use core::f64::consts::PI;

use contact_tables::{Contact, Force, Place};

use super::axes::Axes;
use super::frame::Frame;
use super::ledger::Ledger;
use super::measured::{distance, magnitude, norm};
use super::placed::Placed;
use super::places::{Found, Places};
use super::refusal::Refusal;
use crate::Each;
use crate::vector::{minus, plus, unit};
use cannonpile::Interrupt;

/// The numbers of positions that reject a candidate, that fit one, that judge one, and that fit the best one.
const FEW: usize = 16;
const SOME: usize = 200;
const SAMPLE: usize = 1000;
const MANY: usize = 5000;

/// The number of times that a frame is fitted. Each time, more positions may be matched to their own contacts.
const FITS: usize = 6;

/// The largest number of points of the pile that one anchor may be, and of candidates.
const MAX_IMAGES: usize = 1000;
const MAX_CANDIDATES: usize = 4000;

/// How often the accepted distance from the centroid is doubled.
const ROUNDS: usize = 5;

/// The tolerance for rounding. Angles closer than this to a multiple of 30°, in radians, are rounded to it, and shifts
/// below it, in R, to 0.
const EXACT: f64 = 1e-3;

/// The smallest difference between mean distances that distinguishes two frames, in R.
const NOTABLE: f64 = 0.01;

/// The rounding error of mean distances, in R, and of the distribution of forces.
const ROUNDED: f64 = 1e-9;

/// The smallest length of points across the vertical that determines a turn, as a share of their squares.
const THIN: f64 = 1e-13;

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
    places: &'s Places,
    /// The pairs of spheres in contact, sorted, with the magnitudes of the exact forces.
    forces: Vec<([u64; 2], f64)>,
    radius: f64,
    within: f64,
    /// The largest distance of a position from its exact one in a candidate frame.
    near: f64,
    rows: &'s [Contact],
    greatest: f64,
    /// The number of rows that may be contacts between spheres.
    count: usize,
    /// True if all rows have both centres.
    by_centres: bool,
}

/// Finds the frame in which these positions match the pile.
pub(super) fn find(
    rows: &[Contact],
    ledger: &Ledger<'_>,
    places: &Places,
    [radius, within]: [f64; 2],
) -> Result<Fit, Refusal> {
    let search = Search::new(rows, ledger, places, [radius, within])?;
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
        let pile = search.pile(with_floor)?;
        let table = search.loaded().flat_map(|row| search.points(row.place));
        let table: Vec<[f64; 3]> = table.collect();
        let is_complete = table.len() >= pile.len();
        let reach = reach(&pile);
        let mut slack = search.near;
        let mut tried: Vec<Frame> = Vec::new();
        for _ in 0..ROUNDS {
            for axes in Axes::upright() {
                for frame in search.candidates(&table, &pile, axes, slack) {
                    Interrupt::check()?;
                    let is_known = |known: &Frame| {
                        let mut off = few.iter().map(|row| {
                            let point = row.place.point();
                            distance(frame.place(point), known.place(point))
                        });
                        known.axes == axes && off.all(|off| off < search.near / 2.0)
                    };
                    if tried.iter().any(is_known) || !search.may_fit(&few, frame) {
                        continue;
                    }
                    let frame = search.fitted(&some, frame);
                    tried.push(frame);
                    let fit = search.judge(&sample, frame, search.near);
                    if fit.is_better_than(&best) {
                        best = fit;
                    }
                }
            }
            slack *= 2.0;
            if best.is_convincing(is_complete) || slack > reach {
                break;
            }
        }
        if best.is_convincing(is_complete) {
            break;
        }
    }
    Ok(search.simplest(&many, best.frame))
}

impl<'s> Search<'s> {
    fn new(
        rows: &'s [Contact],
        ledger: &Ledger<'_>,
        places: &'s Places,
        [radius, within]: [f64; 2],
    ) -> Result<Self, Refusal> {
        let magnitudes = rows.iter().map(|row| magnitude(row.force));
        let contacts = ledger.numbered().contacts().map_err(Refusal::of_forces)?;
        let forces = contacts.map(|contact| {
            let contact = contact.map_err(Refusal::of_forces)?.in_order();
            Ok((contact.ids, contact.force.abs()))
        });
        let mut forces = forces.collect::<Result<Vec<_>, Refusal>>()?;
        forces.sort_unstable_by_key(|(ids, _)| *ids);
        let mut search = Self {
            places,
            forces,
            radius,
            within,
            near: (radius / 2.0).max(within),
            rows,
            greatest: magnitudes.fold(0.0, f64::max),
            count: 0,
            by_centres: Placed::all(rows).all(|row| matches!(row.place, Place::Centres(_))),
        };
        search.count = search.loaded().count();
        Ok(search)
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

    /// Returns the points of the contacts of the pile with a force. With the floor, these include the contacts of each
    /// bottom sphere with its mirror image in the floor.
    fn pile(&self, with_floor: bool) -> Result<Vec<[f64; 3]>, Refusal> {
        let greatest = self.forces.iter().map(|(_, force)| *force);
        let greatest = greatest.fold(0.0, f64::max);
        let mut points = Vec::new();
        for (ids, force) in &self.forces {
            if is_loaded(*force, greatest) {
                points.extend(self.points(Place::Centres(self.places.centres_of(*ids)?)));
            }
        }
        for id in self.places.on_floor().filter(|_| with_floor) {
            let centre = self.places.centre(id)?;
            let image = minus(centre, [0.0, 0.0, 2.0 * self.radius]);
            points.extend(self.points(Place::Centres([centre, image])));
        }
        Ok(points)
    }

    /// Returns whether a frame matches at least half of some positions.
    fn may_fit(&self, rows: &[Placed], frame: Frame) -> bool {
        let mut missed = 0;
        rows.iter().all(|row| {
            let place = row.place.map(|point| frame.place(point));
            let (contact, _) = self.places.nearest(&place, self.near);
            missed += usize::from(contact.is_none());
            2 * missed <= rows.len()
        })
    }

    fn judge(&self, sample: &[Placed], frame: Frame, within: f64) -> Fit {
        let (mut found, mut off, mut forces) = (0, 0.0, Vec::new());
        for row in sample {
            let place = row.place.map(|point| frame.place(point));
            let (contact, distance) = self.places.nearest(&place, within);
            let Some(contact) = contact else { continue };
            found += 1;
            off += distance;
            if let Found::Spheres(ids) = contact
                && let Ok([first, second]) = self.places.centres_of(ids)
            {
                let measured = row.force.map(|vector| frame.turned(vector));
                let normal = unit(minus(first, second));
                let [one, other] = ids;
                let ids = [one.min(other), one.max(other)];
                let place = self.forces.partition_point(|(pair, _)| *pair < ids);
                let force = self.forces.get(place).filter(|(pair, _)| *pair == ids);
                // Spheres without a contact have no force.
                let force = force.map_or(0.0, |(_, force)| *force);
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

    /// Fits the turn and the shift of a frame to the matched positions of some rows.
    fn fitted(&self, rows: &[Placed], mut frame: Frame) -> Frame {
        for _ in 0..FITS {
            let pairs = self.pairs(rows, &frame);
            let (from, to) = (
                mean(pairs.iter().map(|(p, _)| *p)),
                mean(pairs.iter().map(|(_, q)| *q)),
            );
            let (mut sin, mut cos, mut size) = (0.0, 0.0, 0.0);
            for (p, q) in &pairs {
                let ([x, y, z], [u, v, _]) = (frame.axes.turned(minus(*p, from)), minus(*q, to));
                sin += x * v - y * u;
                cos += x * u + y * v;
                size += x * x + y * y + z * z;
            }
            // Points on the axis determine no turn.
            if f64::hypot(sin, cos) > THIN * size {
                frame.angle = sin.atan2(cos);
            }
            frame = shifted(frame, &pairs);
        }
        frame
    }

    /// Returns the points of some rows with the exact ones that are near them.
    fn pairs(&self, rows: &[Placed], frame: &Frame) -> Vec<([f64; 3], [f64; 3])> {
        let mut pairs = Vec::new();
        for row in rows {
            let place = row.place.map(|point| frame.place(point));
            let (contact, _) = self.places.nearest(&place, self.near);
            if let Some(Found::Spheres(ids)) = contact
                && let Ok(centres) = self.places.centres_of(ids)
            {
                let exact = self.points(Place::Centres(centres));
                pairs.extend(self.points(row.place).zip(exact));
            }
        }
        pairs
    }

    /// Returns the candidate frames of one vertical axis, those with the smallest change first. The centroid of the table
    /// may be displaced by `slack`.
    fn candidates(
        &self,
        table: &[[f64; 3]],
        pile: &[[f64; 3]],
        axes: Axes,
        slack: f64,
    ) -> Vec<Frame> {
        let frame = Frame::along(axes);
        let (from, to) = (mean(table.iter().copied()), mean(pile.iter().copied()));
        let parts = |point: [f64; 3]| frame.turned(minus(point, from));
        // Points farther away than any contact are not in the pile.
        let missing = 1.0 - count(table.len()) / count(pile.len());
        let limit = reach(pile) + self.near.max(missing * reach(pile));
        let near = table
            .iter()
            .map(|point| parts(*point))
            .filter(|point| norm(*point) <= limit);
        let farthest = |from: [f64; 3]| {
            near.clone()
                .max_by(|one, other| across(*one, from).total_cmp(&across(*other, from)))
        };
        let Some(first) = farthest([0.0; 3]) else {
            return Vec::new();
        };
        let second = farthest(first).filter(|second| across(*second, first) > self.radius / 4.0);
        let images = |anchor: [f64; 3]| {
            let off = |point: [f64; 3]| {
                let [_, _, up] = minus(point, anchor);
                up.abs()
                    .max((across(point, [0.0; 3]) - across(anchor, [0.0; 3])).abs())
            };
            let images = pile.iter().map(|point| minus(*point, to));
            let mut images: Vec<_> = images.filter(|point| off(*point) <= slack).collect();
            images.sort_by(|a, b| {
                let order = off(*a).total_cmp(&off(*b));
                a.iter()
                    .zip(b)
                    .fold(order, |order, (x, y)| order.then(x.total_cmp(y)))
            });
            images.dedup();
            images.truncate(MAX_IMAGES);
            images
        };
        let mut frames = Vec::new();
        let ends = second.map(|second| (second, images(second)));
        for image in images(first) {
            let angles: Vec<f64> = match &ends {
                // A single point is not turned.
                None => vec![0.0],
                Some((second, ends)) => {
                    let fits = |end: &&[f64; 3]| {
                        let [_, _, apart] = minus(minus(**end, image), minus(*second, first));
                        let far = across(**end, image) - across(*second, first);
                        apart.abs().max(far.abs()) <= self.near
                    };
                    let angle = |from: [f64; 3], to: [f64; 3]| {
                        let [x, y, _] = minus(to, from);
                        y.atan2(x)
                    };
                    let turn =
                        |end: &[f64; 3]| (angle(image, *end) - angle(first, *second)) / (2.0 * PI);
                    let turns = ends.iter().filter(fits).map(turn);
                    turns.map(|turn| (turn - turn.round()) * 2.0 * PI).collect()
                }
            };
            frames.extend(angles.into_iter().map(|angle| {
                let turned = Frame { angle, ..frame };
                // The first anchor goes to its image.
                let first = Frame {
                    angle,
                    ..Frame::OWN
                }
                .turned(first);
                let shift = minus(minus(plus(image, to), first), turned.turned(from));
                Frame { shift, ..turned }
            }));
        }
        frames.truncate(MAX_CANDIDATES);
        frames.sort_by(|one, other| {
            let order = one.angle.abs().total_cmp(&other.angle.abs());
            order.then(norm(one.shift).total_cmp(&norm(other.shift)))
        });
        frames
    }

    /// Fits a frame, and returns the simplest one that matches as many positions, and about as well.
    fn simplest(&self, rows: &[Placed], frame: Frame) -> Fit {
        let mut best = self.judge(rows, self.fitted(rows, frame), self.within);
        let (found, off) = (best.found, 2.0 * best.off + ROUNDED);
        let replace = |best: &mut Fit, frame| {
            let fit = self.judge(rows, frame, self.within);
            if fit.found >= found && fit.off <= off {
                *best = fit;
            }
        };
        let step = PI / 6.0;
        let angle = (best.frame.angle / step).round() * step;
        if (best.frame.angle - angle).abs() < EXACT {
            let frame = Frame {
                angle,
                ..best.frame
            };
            replace(&mut best, shifted(frame, &self.pairs(rows, &frame)));
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
        // Turns by right angles permute the axes. They are said as turns if there is nothing else.
        let frame = best.frame;
        let units = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let permutes = |axes: &Axes| {
            let mut units = units.iter();
            units.all(|unit| distance(axes.turned(*unit), frame.turned(*unit)) == 0.0)
        };
        if frame.axes != Axes::OWN
            && let Some(axes) = Axes::all().find(permutes)
        {
            best.frame = Frame {
                axes,
                angle: 0.0,
                ..frame
            };
        }
        best
    }
}

/// Returns the frame with the shift that moves the centroid of its points to that of the exact ones.
fn shifted(frame: Frame, pairs: &[([f64; 3], [f64; 3])]) -> Frame {
    if pairs.is_empty() {
        return frame;
    }
    let from = mean(pairs.iter().map(|(p, _)| *p));
    let to = mean(pairs.iter().map(|(_, q)| *q));
    let shift = minus(to, frame.turned(from));
    Frame { shift, ..frame }
}

/// Returns whether a force is large enough to mark the position of a contact. If the greatest force is 0, every contact
/// counts.
fn is_loaded(force: f64, greatest: f64) -> bool {
    force >= greatest * 1e-9
}

/// Returns the horizontal distance of two points.
fn across(one: [f64; 3], other: [f64; 3]) -> f64 {
    let [x, y, _] = minus(one, other);
    x.hypot(y)
}

/// Returns the largest distance of a point from the centroid.
fn reach(points: &[[f64; 3]]) -> f64 {
    let middle = mean(points.iter().copied());
    let far = points.iter().map(|point| distance(*point, middle));
    far.fold(0.0, f64::max)
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
    // In a wrong frame, all positions may be those of spheres without a force.
    let share = |x: f64, all: f64| if all == 0.0 { 0.0 } else { x / all };
    let apart = forces.iter().map(|(force, exact)| {
        let exact = exact.each(|x| share(x, all));
        match force {
            Force::Along(force) => (share(force.abs(), sum) - norm(exact)).abs(),
            Force::Vector(vector) | Force::Both(_, vector) => {
                let share = vector.each(|x| share(x, sum));
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

fn mean(points: impl Iterator<Item = [f64; 3]>) -> [f64; 3] {
    let (number, sum) = points.fold((0, [0.0; 3]), |(n, sum), point| (n + 1, plus(sum, point)));
    sum.each(|x| x / count(number))
}
