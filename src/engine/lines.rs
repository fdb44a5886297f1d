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

use alloc::vec::Vec;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use super::meter::Meter;
use crate::each::Each;
use crate::formula::{self, force, half_turn, transmitted};
use crate::geometry::{Load, Vector};
use crate::lattice::{Direction, Row, Sign, Site};
use crate::pile::{Extra, System};
use crate::scalar::{Algebra, Ring};
use crate::shape::{RunLayers, Shape};
use crate::sorted::Sorted;

/// The forces on a sphere, by direction, as numerators.
#[derive(Clone, Debug)]
pub(crate) struct SphereForces<T: Algebra> {
    pub(crate) forces: [T::Numerator; 3],
    /// The number of sign changes above. The denominator is [`LineForces::scale`] of this number.
    pub(crate) changes: usize,
}

/// The increments that the spheres of a pile add to their lines, as numerators in the ring of the scalar.
///
/// A force after d sign changes has the denominator [`scale`](Self::scale)(d).
#[derive(Clone, Debug)]
pub(crate) struct LineForces<'p, T: Algebra> {
    pub(super) shape: &'p Shape,
    /// The increments of an ordinary sphere, under the sign of the runs with an even index and under the other one.
    /// They differ only under gravity that leans.
    ordinary: [[T::Numerator; 3]; 2],
    /// Gravity on an ordinary sphere, in mg/W, where W is the sum of the three increments of a weight.
    gravity: Vector<T::Numerator>,
    /// The further increments of some spheres, by line and layer, from extra weights, loads and horizontal contacts.
    pub(super) extras: Sorted<(Line, i128), T::Numerator>,
    /// The forces of gravity and loads on some spheres, less gravity on an ordinary one, in mg/W. The value is 0 for a
    /// sphere with horizontal contacts only.
    pub(super) extra_loads: Sorted<Site, Vector<T::Numerator>>,
    scale: T::Numerator,
    /// 1/[`System::denominator`], whose numerator over `scale` is 1 in integers.
    least: BigRational,
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

/// The forces of a sphere, all over the denominator before any sign change: those on its three lines, and the load in
/// mg/W that they balance.
struct Own<N> {
    site: Site,
    lines: [N; 3],
    load: Vector<N>,
}

/// Returns the numerator of a value over the denominator of `least`, which all numerators share.
fn numerator<T: Algebra>(value: BigRational, least: &BigRational) -> T::Numerator {
    if value.is_zero() {
        return T::Numerator::zero();
    }
    let ([value, _], _) = T::numerators(&[value, least.clone()]);
    value
}

/// Returns the signs of the runs with an even index and of those with an odd one.
fn signs(shape: &Shape) -> [Sign; 2] {
    let first = shape.sign_below(0).unwrap_or(Sign::Plus);
    [first, first.opposite()]
}

/// Returns a load in mg/W, as a vector whose z axis points down. Its x and y axes are those of the symbolic basis.
fn vector<N: Ring>(load: Load<N>, w: &N) -> Vector<N> {
    Vector {
        z: force(load.down.clone(), w),
        ..horizontal(load, w)
    }
}

/// Returns the horizontal part of a load in mg/W.
fn horizontal<N: Ring>(Load { x, y, .. }: Load<N>, w: &N) -> Vector<N> {
    let z = N::zero();
    if x.is_zero() && y.is_zero() {
        return Vector { x, y, z };
    }
    let [x, y] = [x, y].each(|part| force(part, w));
    Vector { x, y, z }
}

impl<'p, T: Algebra> LineForces<'p, T> {
    pub(crate) fn new(system: &System<'p>) -> Self {
        // One denominator serves all increments and loads.
        let least = BigRational::new(BigInt::one(), system.denominator());
        let (_, scale) = T::numerators(core::array::from_ref(&least));
        let numerator = |value| numerator::<T>(value, &least);
        let w = &system.increment_sum;
        let gravity = system.loading.ordinary();
        let [first, second] = signs(system.shape);
        let of_first = system.load_increments(&gravity, first).each(numerator);
        let of_second = if gravity.is_vertical() {
            of_first.clone()
        } else {
            system.load_increments(&gravity, second).each(numerator)
        };
        // The increments of a load balance it, so their sum is its vertical part.
        let gravity = Vector {
            z: formula::weight(&of_first),
            ..horizontal(gravity, w).map(numerator)
        };
        let mut lines = Self {
            shape: system.shape,
            ordinary: [of_first, of_second],
            gravity,
            extras: Sorted::new(),
            extra_loads: Sorted::new(),
            scale,
            least: least.clone(),
            triples: formula::triples::<T>(),
        };
        let extras = system.extras().map(|Extra { site, load, lines }| Own {
            site,
            lines: lines.each(numerator),
            load: vector(load, w).map(numerator),
        });
        lines.add(extras.collect());
        lines
    }

    /// Returns a given horizontal force as a numerator over the denominator after `changes` sign changes.
    pub(crate) fn numerator(&self, force: BigRational, changes: usize) -> T::Numerator {
        self.scaled(numerator::<T>(force, &self.least), changes)
    }

    /// Adds to the loads on spheres, in a scalar that is its own numerator.
    pub(crate) fn add_loads(
        &mut self,
        system: &System<'_>,
        loads: Vec<(Site, Load<T::Numerator>)>,
    ) {
        let (s, w) = Self::constants(system);
        let mut forces = Vec::new();
        for (site, load) in loads {
            let sign = self.shape.sign_below(site.k).unwrap_or(Sign::Plus);
            forces.push(Own {
                site,
                lines: system.load_increments_of(&load, &s, sign),
                load: vector(load, &w),
            });
        }
        self.add(forces);
    }

    /// Adds to the tilt of gravity, in a scalar that is its own numerator.
    pub(crate) fn add_tilt(&mut self, system: &System<'_>, [x, y]: [T::Numerator; 2]) {
        let (s, w) = Self::constants(system);
        let leaning = |weight: BigRational| {
            let ([weight], _) = T::numerators(&[weight]);
            let [x, y] = [&x, &y].each(|part| force(weight.clone(), part));
            Load {
                down: T::Numerator::zero(),
                x,
                y,
            }
        };
        let ordinary = leaning(system.loading.ordinary_weight());
        for (sign, lines) in signs(self.shape).into_iter().zip(&mut self.ordinary) {
            let own = system.load_increments_of(&ordinary, &s, sign);
            *lines = add(lines.clone(), &own);
        }
        self.gravity = self.gravity.clone() + &vector(ordinary, &w);
        let extras = system.loading.extra_weights();
        let extras = extras.map(|(site, weight)| (site, leaning(weight)));
        self.add_loads(system, extras.collect());
    }

    /// Returns s and W, in a scalar that is its own numerator.
    fn constants(system: &System<'_>) -> (T::Numerator, T::Numerator) {
        let constants = [system.sin_phi.clone(), system.increment_sum.clone()];
        let ([s, w], _) = T::numerators(&constants);
        (s, w)
    }

    /// Adds to the forces of spheres.
    fn add(&mut self, forces: Vec<Own<T::Numerator>>) {
        let (mut extras, mut loads) = (Vec::new(), Vec::new());
        for Own { site, lines, load } in forces {
            let run_below = self.shape.stretch_to(site.k + 1);
            if let Some(run) = run_below.filter(|run| site.k < run.to) {
                for (direction, own) in Direction::ALL.into_iter().zip(lines) {
                    let place = (Line::through(site, direction, run), site.k);
                    extras.push((place, own));
                }
            }
            loads.push((site, load));
        }
        let add = |sum: &mut T::Numerator, own: &T::Numerator| *sum = transmitted(sum.clone(), own);
        self.extras.merge(extras, add);
        self.extra_loads
            .merge(loads, |sum, load| *sum = sum.clone() + load);
    }

    /// Returns the denominator of forces after `changes` sign changes.
    pub(crate) fn scale(&self, changes: usize) -> T::Numerator {
        self.scaled(self.scale.clone(), changes)
    }

    /// Converts a numerator from the denominator before any sign change to the one after `changes` sign changes.
    pub(super) fn scaled(&self, numerator: T::Numerator, changes: usize) -> T::Numerator {
        match self.power(changes) {
            Some(power) => numerator * &power,
            None => numerator,
        }
    }

    /// Returns the factor between the denominators before any sign change and after `changes` of them, unless they are
    /// equal.
    fn power(&self, changes: usize) -> Option<T::Numerator> {
        let three = || T::Numerator::from_i128(3);
        (self.triples && changes > 0).then(|| pow(three(), changes))
    }

    /// Converts a numerator from the denominator after `from` sign changes to the one after `to`.
    pub(crate) fn rescaled(&self, numerator: T::Numerator, from: usize, to: usize) -> T::Numerator {
        self.scaled(numerator, to.saturating_sub(from))
    }

    /// Returns the force of gravity and of the load on a sphere, in mg/W, over the denominator after `changes` sign
    /// changes.
    pub(crate) fn load(&self, site: Site, changes: usize) -> Vector<T::Numerator> {
        let load = match self.extra_loads.get(&site) {
            Some(extra) => self.gravity.clone() + extra,
            None => self.gravity.clone(),
        };
        load.map(|part| self.scaled(part, changes))
    }

    /// Returns the force of gravity on an ordinary sphere, in mg/W, over the denominator after `changes` sign changes.
    pub(crate) fn ordinary_load(&self, changes: usize) -> Vector<T::Numerator> {
        self.gravity.clone().map(|part| self.scaled(part, changes))
    }

    /// Returns the sum of the increments of `n` ordinary spheres in the first run, over the denominator before any sign
    /// change. `line` is the index of the direction.
    pub(crate) fn ordinary(&self, n: T::Numerator, line: usize) -> T::Numerator {
        self.ordinary_in(0, n, line)
    }

    /// Returns the sum of the increments of `n` ordinary spheres in a run, over the denominator before any sign change.
    pub(super) fn ordinary_in(&self, run: usize, n: T::Numerator, line: usize) -> T::Numerator {
        force(n, &self.ordinary[run % 2][line])
    }

    /// Returns the increments of an ordinary sphere above which the sign changes `changes` times, over the denominator
    /// after these changes.
    pub(crate) fn increments_after(&self, changes: usize) -> [T::Numerator; 3] {
        let ordinary = self.ordinary[changes % 2].clone();
        match self.power(changes) {
            Some(power) => ordinary.each(|w| w * &power),
            None => ordinary,
        }
    }

    /// Returns the increments of a sphere in the run below it, less those of an ordinary weight.
    pub(crate) fn extra(&self, site: Site) -> [T::Numerator; 3] {
        let Some(run) = self.shape.stretch_to(site.k + 1) else {
            return Direction::ALL.each(|_| T::Numerator::zero());
        };
        Direction::ALL.each(|direction| {
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
        let [start, end] = [i.start, i.end].each(|i| Site { i, j, k });
        let sites = self.extra_loads.range(&(start..end.max(start)));
        sites.iter().map(|(site, _)| *site)
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
            .extra_loads
            .range(&(first(layers.start)..first(layers.end)));
        sites.iter().map(|(site, _)| *site)
    }

    /// Returns the increments of an ordinary sphere of layer `k`, over the denominator of the forces below it.
    pub(crate) fn increments_below(&self, k: i128) -> [T::Numerator; 3] {
        self.increments_after(self.shape.changes_above(k + 1))
    }

    /// Returns the forces that a sphere transmits, by direction, from the forces that it receives.
    pub(crate) fn to_below(
        &self,
        site: Site,
        above: SphereForces<T>,
        meter: Meter<'_>,
    ) -> SphereForces<T> {
        let increments = self.increments_below(site.k);
        self.below_layer(&increments, site, above, meter)
    }

    /// Returns [`to_below`](Self::to_below) with the [increments](Self::increments_below) of the layer, which are the same for
    /// all its spheres.
    pub(crate) fn below_layer(
        &self,
        increments: &[T::Numerator; 3],
        site: Site,
        above: SphereForces<T>,
        meter: Meter<'_>,
    ) -> SphereForces<T> {
        let Some(run) = self.shape.stretch_to(site.k + 1) else {
            return above;
        };
        let received = if run.index > above.changes {
            meter.turn(1);
            half_turn::<T>(&above.forces)
        } else {
            above.forces
        };
        self.with_own(increments, site, received, run.index)
    }

    /// Returns the forces that a sphere transmits, from the forces that it receives. At a sign change the caller has
    /// already applied the half-turn to these.
    pub(crate) fn with_own(
        &self,
        increments: &[T::Numerator; 3],
        site: Site,
        received: [T::Numerator; 3],
        changes: usize,
    ) -> SphereForces<T> {
        let mut forces = add(received, increments);
        if self.extra_loads.get(&site).is_some() {
            forces = add(forces, &self.extra(site));
        }
        SphereForces { forces, changes }
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
    pub(super) fn through(site: Site, direction: Direction, run: RunLayers) -> Self {
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
