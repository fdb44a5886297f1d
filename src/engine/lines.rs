//! The forces on the lines of contacts, run by run: the common part of the methods *closed* and *tree*.
//!
//! Within a run the force on a line grows linearly with a count of spheres, see [`paper`](crate::paper#lines). A sphere
//! m layers into a run receives on a line the increments of the N spheres above it on this line.
//! [`Region::spheres_above`](crate::lattice::Region::spheres_above) returns N ≤ m.
//!
//! * If N < m, the line begins at a surface, with zero force.
//! * If N = m, it begins at the sign change, with the force that the sphere there transmits. This force depends on the
//!   three forces on that sphere, and so on upwards: see the method *tree*.
//!
//! A straight pile has no sign change, so every force has a closed form.

use alloc::collections::BTreeMap;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use super::meter::Meter;
use crate::formula;
use crate::formula::{force, half_turn, transmitted};
use crate::lattice::Sign;
use crate::lattice::{Direction, Row, Site};
use crate::pile::System;
use crate::scalar::{Algebra, Ring};
use crate::shape::{Shape, Stretch};

/// The forces on a sphere, by direction, as numerators.
#[derive(Clone, Debug)]
pub(crate) struct Received<T: Algebra> {
    pub(crate) forces: [T::Numerator; 3],
    /// The number of sign changes above. The denominator is [`Lines::scale`] of this number.
    pub(crate) changes: usize,
}

/// The increments that the spheres of a pile add to their lines, as numerators in the ring of the scalar.
///
/// A force after d sign changes has the denominator [`scale`](Self::scale)(d).
#[derive(Clone, Debug)]
pub(crate) struct Lines<'p, T: Algebra> {
    pub(super) shape: &'p Shape,
    /// The increments of an ordinary sphere.
    pub(super) ordinary: [T::Numerator; 3],
    /// The further increments of some spheres, by line and layer, from extra weights, loads and horizontal contacts.
    pub(super) extras: BTreeMap<(Line, i128), T::Numerator>,
    /// The weight of some spheres and their loads, less an ordinary weight, in mg/W, where W is the sum of the three
    /// increments. The value is 0 for a sphere with horizontal contacts only.
    pub(super) extra_weights: BTreeMap<Site, T::Numerator>,
    scale: T::Numerator,
    /// Whether a sign change triples the denominator. It does if the ring of numerators does not contain 1/3.
    triples: bool,
}

/// A line of contacts within a run: its direction, and the position at which it would cross layer 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Line {
    run: usize,
    direction: Direction,
    place: [i128; 2],
}

/// Returns the numerator of a value over the denominator of `least`, which all numerators share.
fn numerator<T: Algebra>(value: BigRational, least: &BigRational) -> T::Numerator {
    let ([value, _], _) = T::numerators(&[value, least.clone()]);
    value
}

impl<'p, T: Algebra> Lines<'p, T> {
    pub(crate) fn new(system: &System<'p>) -> Self {
        let increments = &system.increments;
        let own = system.loading.ordinary();
        // One denominator serves the increments, and the products of increments with weights and loads.
        let least = BigRational::new(BigInt::one(), system.denominator());
        let (_, scale) = T::numerators(core::array::from_ref(&least));
        let ordinary = increments
            .each_ref()
            .map(|w| numerator::<T>(force(own.clone(), w), &least));
        let mut lines = Self {
            shape: system.shape,
            ordinary,
            extras: BTreeMap::new(),
            extra_weights: BTreeMap::new(),
            scale,
            triples: formula::triples::<T>(),
        };
        for extra in system.extras() {
            let site = extra.site;
            let run_below = lines
                .shape
                .stretch_to(site.k + 1)
                .filter(|run| site.k < run.to);
            if let Some(run) = run_below {
                for (direction, own) in Direction::ALL.into_iter().zip(extra.lines) {
                    let line = Line::through(site, direction, run);
                    let own = numerator::<T>(own, &least);
                    lines.extras.insert((line, site.k), own);
                }
            }
            let weight = force(extra.weight, &formula::weight(increments));
            let weight = numerator::<T>(weight, &least);
            lines.extra_weights.insert(site, weight);
        }
        lines
    }

    /// Returns the denominator of forces after `changes` sign changes.
    pub(crate) fn scale(&self, changes: usize) -> T::Numerator {
        self.scaled(self.scale.clone(), changes)
    }

    /// Converts a numerator from the denominator before any sign change to the one after `changes` sign changes.
    pub(super) fn scaled(&self, numerator: T::Numerator, changes: usize) -> T::Numerator {
        if self.triples && changes > 0 {
            numerator * &pow(T::Numerator::from_i128(3), changes)
        } else {
            numerator
        }
    }

    /// Converts a numerator from the denominator after `from` sign changes to the one after `to`.
    pub(crate) fn rescaled(&self, numerator: T::Numerator, from: usize, to: usize) -> T::Numerator {
        self.scaled(numerator, to.saturating_sub(from))
    }

    /// Returns the weight of a sphere and its load, in mg/W, over the denominator after `changes` sign changes.
    pub(crate) fn weight(&self, site: Site, changes: usize) -> T::Numerator {
        let ordinary = self.ordinary_weight(changes);
        match self.extra_weights.get(&site) {
            Some(extra) => self.scaled(extra.clone(), changes) + &ordinary,
            None => ordinary,
        }
    }

    /// Returns the weight of an ordinary sphere, in mg/W, over the denominator after `changes` sign changes.
    pub(crate) fn ordinary_weight(&self, changes: usize) -> T::Numerator {
        self.scaled(formula::weight(&self.ordinary), changes)
    }

    /// Returns the sum of the increments of `n` ordinary spheres, over the denominator before any sign change. `line`
    /// is the index of the direction.
    pub(crate) fn ordinary(&self, n: T::Numerator, line: usize) -> T::Numerator {
        force(n, &self.ordinary[line])
    }

    /// Returns the increments of an ordinary sphere, over the denominator after `changes` sign changes.
    pub(crate) fn increments_after(&self, changes: usize) -> [T::Numerator; 3] {
        let ordinary = self.ordinary.each_ref();
        ordinary.map(|w| self.scaled(w.clone(), changes))
    }

    /// Returns the increments of a sphere in the run below it, less those of an ordinary weight.
    pub(crate) fn extra(&self, site: Site) -> [T::Numerator; 3] {
        let Some(run) = self.shape.stretch_to(site.k + 1) else {
            return core::array::from_fn(|_| T::Numerator::zero());
        };
        Direction::ALL.map(|direction| {
            let extra = self
                .extras
                .get(&(Line::through(site, direction, run), site.k));
            // A sphere of ordinary weight has no entry.
            extra.map_or_else(T::Numerator::zero, |extra| {
                self.scaled(extra.clone(), run.index)
            })
        })
    }

    /// Returns the spheres of a row whose weight is not ordinary, or that carry loads.
    pub(crate) fn extras_in_row(&self, row: &Row) -> impl Iterator<Item = Site> + '_ {
        let Row { k, j, ref i } = *row;
        let [start, end] = [i.start, i.end].map(|i| Site { i, j, k });
        let sites = self.extra_weights.range(start..end.max(start));
        sites.map(|(site, _)| *site)
    }

    /// Returns the spheres of some layers whose weight is not ordinary, or that carry loads.
    pub(crate) fn extras_in(
        &self,
        layers: core::ops::Range<i128>,
    ) -> impl Iterator<Item = Site> + '_ {
        let first = |k| Site {
            i: i128::MIN,
            j: i128::MIN,
            k,
        };
        let sites = self
            .extra_weights
            .range(first(layers.start)..first(layers.end));
        sites.map(|(site, _)| *site)
    }

    /// Returns the forces that a sphere transmits, by direction, from the forces that it receives.
    pub(crate) fn to_below(&self, site: Site, above: Received<T>, meter: Meter<'_>) -> Received<T> {
        let Some(run) = self.shape.stretch_to(site.k + 1) else {
            return above;
        };
        let received = if run.index > above.changes {
            meter.turn(1);
            half_turn::<T>(&above.forces)
        } else {
            above.forces
        };
        self.with_own(site, received, run.index)
    }

    /// Returns the forces that a sphere transmits, from the forces that it receives. At a sign change the caller has
    /// already applied the half-turn to these.
    pub(crate) fn with_own(
        &self,
        site: Site,
        received: [T::Numerator; 3],
        changes: usize,
    ) -> Received<T> {
        let mut forces = add(received, &self.increments_after(changes));
        if !self.extra_weights.is_empty() && self.extra_weights.contains_key(&site) {
            forces = add(forces, &self.extra(site));
        }
        Received { forces, changes }
    }
}

/// Adds the increments of a sphere to the forces on its three lines.
fn add<N: Ring>([a, b, c]: [N; 3], [own_a, own_b, own_c]: &[N; 3]) -> [N; 3] {
    [
        transmitted(a, own_a),
        transmitted(b, own_b),
        transmitted(c, own_c),
    ]
}

impl Line {
    pub(super) fn through(site: Site, direction: Direction, run: Stretch) -> Self {
        let place = start_of([site.i, site.j], direction, run.sign, site.k);
        Self {
            run: run.index,
            direction,
            place,
        }
    }
}

/// Returns the site that is `steps` steps up a line.
pub(super) fn start_of(
    [i, j]: [i128; 2],
    direction: Direction,
    sign: Sign,
    steps: i128,
) -> [i128; 2] {
    let [di, dj] = sign.descent(direction);
    [i - di * steps, j - dj * steps]
}
