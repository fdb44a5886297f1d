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

use alloc::borrow::Cow;
use alloc::vec::Vec;
use core::array;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use super::meter::Meter;
use crate::Error;
use crate::each::Each;
use crate::formula::{self, force, half_turn, transmitted};
use crate::geometry::{Load, Vector};
use crate::lattice::{Direction, Row, Sign, Site};
use crate::pile::{Extra, Pile};
use crate::scalar::{Algebra, Numerators, Ring};
use crate::shape::{RunLayers, Shape};
use crate::sorted::Sorted;

/// The forces on a sphere, by direction, as numerators.
#[derive(Clone, Debug)]
pub(crate) struct SphereForces<T: Algebra> {
    pub(crate) forces: [T::Numerator; 3],
    /// The number of sign changes above. The denominator is [`LineForces::scale`] of this number.
    pub(crate) changes: usize,
}

/// A pile in the numerators of a scalar: the increments that its spheres add to their lines, and the directions of the
/// lines.
///
/// A force after d sign changes has the denominator [`scale`](Self::scale)(d).
#[derive(Clone, Debug)]
pub(crate) struct LineForces<'p, T: Algebra> {
    /// The data of the pile, with the rational loads of the forces.
    pub(crate) pile: Cow<'p, Pile>,
    pub(crate) shape: &'p Shape,
    /// Whether loads or a tilt in the scalar act on the pile as well.
    pub(crate) has_scalar_loads: bool,
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
    /// Whether a sign change triples the denominator. It does if the ring of numerators does not contain 1/3.
    triples: bool,
    /// W, over `sum_scale`.
    pub(crate) increment_sum: T::Numerator,
    pub(crate) sum_scale: T::Numerator,
    /// The directions under a + step, over `direction_scale`.
    pub(crate) directions: [Vector<T::Numerator>; 3],
    pub(crate) direction_scale: T::Numerator,
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

/// Returns values as numerators over one denominator. A scalar that is its own numerator stays as it is.
pub(crate) fn numerators<T: Algebra, const N: usize>(
    values: [T; N],
) -> ([T::Numerator; N], T::Numerator) {
    match T::Numerator::of_scalars(values) {
        Ok(own) => (own, T::Numerator::one()),
        Err(rationals) => T::Numerator::of(&rationals),
    }
}

/// Returns `n / d`, or an error if the scalar cannot hold it.
pub(crate) fn to_scalar<T: Algebra>(
    quantity: &'static str,
    n: T::Numerator,
    d: &T::Numerator,
) -> Result<T, Error> {
    match n.over(d) {
        Some(value) if value.is_defined() => Ok(value),
        _ => Err(Error::overflow(quantity, T::NAME)),
    }
}

/// Returns each of `n` over `d`, or an error if the scalar cannot hold one of them.
pub(crate) fn to_scalars<T: Algebra>(
    quantity: &'static str,
    n: [T::Numerator; 3],
    d: &T::Numerator,
) -> Result<[T; 3], Error> {
    let [x, y, z] = n;
    Ok([
        to_scalar(quantity, x, d)?,
        to_scalar(quantity, y, d)?,
        to_scalar(quantity, z, d)?,
    ])
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
    pub(crate) fn new(pile: &'p Pile) -> Self {
        Self::of(Cow::Borrowed(pile), pile.shape())
    }

    /// Returns the numerators of a pile of the given shape.
    pub(crate) fn of(pile: Cow<'p, Pile>, shape: &'p Shape) -> Self {
        let (increments, scale) =
            numerators(formula::increments(&T::from_rational(pile.sin_phi())));
        let ([increment_sum], sum_scale) = T::Numerator::of(&[pile.increment_sum()]);
        let directions = pile.directions::<T>().each(Vector::into_array);
        let components = array::from_fn::<_, 9, _>(|n| directions[n / 3][n % 3].clone());
        let (components, direction_scale) = numerators(components);
        let zero = T::Numerator::zero;
        let mut lines = Self {
            shape,
            has_scalar_loads: false,
            gravity: Vector {
                x: zero(),
                y: zero(),
                z: formula::weight(&increments),
            },
            ordinary: [increments.clone(), increments],
            extras: Sorted::new(),
            extra_loads: Sorted::new(),
            scale,
            triples: T::Numerator::ARE_INTEGERS,
            increment_sum,
            sum_scale,
            directions: [0, 3, 6].each(|line| {
                let [x, y, z] = [0, 1, 2].each(|n| components[line + n].clone());
                Vector { x, y, z }
            }),
            direction_scale,
            pile,
        };
        if !lines.pile.is_uniform() {
            lines.weigh();
        }
        lines
    }

    /// Takes the weights and loads of the pile. Each increment is rounded once, from a rational.
    fn weigh(&mut self) {
        let pile = &self.pile;
        // One denominator serves all increments and loads.
        let least = BigRational::new(BigInt::one(), pile.denominator());
        let numerator = |value: BigRational| {
            if value.is_zero() {
                return T::Numerator::zero();
            }
            let ([value, _], _) = T::Numerator::of(&[value, least.clone()]);
            value
        };
        let (_, scale) = T::Numerator::of(array::from_ref(&least));
        let (w, gravity) = (pile.increment_sum(), pile.loading.ordinary());
        let increments = |sign| pile.load_increments(&gravity, sign).each(numerator);
        let ordinary = signs(self.shape).each(increments);
        let extras = pile.extras().map(|Extra { site, load, lines }| Own {
            site,
            lines: lines.each(numerator),
            load: vector(load, &w).map(numerator),
        });
        let extras = extras.collect();
        self.gravity = Vector {
            // The increments of a load balance it, so their sum is its vertical part.
            z: formula::weight(&ordinary[0]),
            ..horizontal(gravity, &w).map(numerator)
        };
        (self.ordinary, self.scale) = (ordinary, scale);
        self.add(extras);
    }

    /// Adds to the loads on spheres.
    pub(crate) fn add_loads(&mut self, loads: Vec<(Site, Load<T>)>) {
        let (mut rational, mut own) = (false, Vec::new());
        for (site, Load { down, x, y }) in loads {
            match T::Numerator::of_scalars([down, x, y]) {
                Ok([down, x, y]) => own.push((site, Load { down, x, y })),
                Err([down, x, y]) => {
                    let loading = &mut self.pile.to_mut().loading;
                    loading.add_load(site, &Load { down, x, y });
                    rational = true;
                }
            }
        }
        if rational {
            *self = Self::of(self.pile.clone(), self.shape);
        }
        if !own.is_empty() {
            self.has_scalar_loads = true;
            self.add_own_loads(own);
        }
    }

    /// Adds to the loads on spheres, in a scalar that is its own numerator.
    fn add_own_loads(&mut self, loads: Vec<(Site, Load<T::Numerator>)>) {
        let s = self.sin_phi();
        let mut forces = Vec::new();
        for (site, load) in loads {
            let sign = self.shape.sign_below(site.k).unwrap_or(Sign::Plus);
            forces.push(Own {
                site,
                lines: self.pile.load_increments_of(&load, &s, sign),
                load: vector(load, &self.increment_sum),
            });
        }
        self.add(forces);
    }

    /// Adds to the tilt of gravity.
    pub(crate) fn add_tilt(&mut self, tilt: [T; 2]) {
        let [x, y] = match T::Numerator::of_scalars(tilt) {
            Ok(tilt) => tilt,
            Err(tilt) => {
                self.pile.to_mut().loading.add_tilt(tilt);
                *self = Self::of(self.pile.clone(), self.shape);
                return;
            }
        };
        self.has_scalar_loads = true;
        let leaning = |weight: BigRational| {
            let ([weight], _) = T::Numerator::of(&[weight]);
            let [x, y] = [&x, &y].each(|part| force(weight.clone(), part));
            let down = T::Numerator::zero();
            Load { down, x, y }
        };
        let s = self.sin_phi();
        let ordinary = leaning(self.pile.loading.ordinary_weight());
        for (sign, lines) in signs(self.shape).into_iter().zip(&mut self.ordinary) {
            let own = self.pile.load_increments_of(&ordinary, &s, sign);
            *lines = add(lines.clone(), &own);
        }
        self.gravity = self.gravity.clone() + &vector(ordinary, &self.increment_sum);
        let extras = self.pile.loading.extra_weights();
        let extras = extras.map(|(site, weight)| (site, leaning(weight)));
        self.add_own_loads(extras.collect());
    }

    /// Returns s = sin φ, in a scalar that is its own numerator.
    fn sin_phi(&self) -> T::Numerator {
        let ([s], _) = T::Numerator::of(core::array::from_ref(self.pile.sin_phi()));
        s
    }

    /// Adds to the forces of spheres.
    fn add(&mut self, forces: Vec<Own<T::Numerator>>) {
        let (mut extras, mut loads) = (Vec::new(), Vec::new());
        for Own { site, lines, load } in forces {
            if let Some(run) = self.shape.run_below(site.k) {
                for (direction, own) in Direction::ALL.into_iter().zip(lines) {
                    let place = (Line::through(site, direction, &run), site.k);
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
    pub(crate) fn scaled(&self, numerator: T::Numerator, changes: usize) -> T::Numerator {
        match self.power(changes) {
            Some(power) => numerator * &power,
            None => numerator,
        }
    }

    /// Returns the factor between the denominators before any sign change and after `changes` of them, unless they are
    /// equal.
    pub(super) fn power(&self, changes: usize) -> Option<T::Numerator> {
        let three = || T::Numerator::from_integer(3);
        (self.triples && changes > 0).then(|| pow(three(), changes))
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

    /// Returns the sum of the increments of `n` ordinary spheres in a run, over the denominator before any sign change.
    /// `line` is the index of the direction.
    pub(crate) fn ordinary(&self, run: usize, n: T::Numerator, line: usize) -> T::Numerator {
        force(n, &self.ordinary[run % 2][line])
    }

    /// Returns the force that a sphere of the first run, `run`, transmits along one line: the increments of this sphere
    /// and of the spheres above it on the line. The caller has checked the site.
    #[inline]
    pub(crate) fn closed(&self, run: &RunLayers, site: Site, direction: Direction) -> T::Numerator {
        let Site { i, j, k } = site;
        let above = self.shape.spheres_above(run, k, [i, j])[direction.index()];
        // The force below a sphere is that from above on its support, which has one sphere more on the line.
        let [i, j] = start_of([i, j], direction, run.sign, -1);
        let below = Site { i, j, k: k + 1 };
        self.counted(run, below, direction, above + 1)
    }

    /// Returns the sum of the increments of the `n` spheres above a site on a line of the run, loads included. It is a
    /// numerator over the denominator before any sign change.
    #[inline]
    pub(super) fn counted(
        &self,
        run: &RunLayers,
        site: Site,
        direction: Direction,
        n: i128,
    ) -> T::Numerator {
        let ordinary = self.ordinary(run.index, T::Numerator::from_integer(n), direction.index());
        if self.extras.is_empty() {
            return ordinary;
        }
        let line = Line::through(site, direction, run);
        let extras = self.extras.range(&((line, site.k - n)..(line, site.k)));
        let add = |sum, (_, extra): &(_, T::Numerator)| transmitted(sum, extra);
        extras.iter().fold(ordinary, add)
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
        let Some(run) = self.shape.run_to(site.k + 1) else {
            return Direction::ALL.each(|_| T::Numerator::zero());
        };
        Direction::ALL.each(|direction| {
            let extra = self
                .extras
                .get(&(Line::through(site, direction, &run), site.k));
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

    /// Returns [`to_below`](Self::to_below) with the [increments](Self::increments_below) of the layer, which are the
    /// same for all its spheres.
    pub(crate) fn below_layer(
        &self,
        increments: &[T::Numerator; 3],
        site: Site,
        above: SphereForces<T>,
        meter: Meter<'_>,
    ) -> SphereForces<T> {
        let Some(run) = self.shape.run_to(site.k + 1) else {
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
    pub(super) fn through(site: Site, direction: Direction, run: &RunLayers) -> Self {
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
