//! The forces of whole layers, written into slices. This is the fastest way to compute many forces.

mod below;
mod layer;

pub use layer::Layer;

use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::Forces;
use super::terms::Terms;
use super::walk::RowEngine;
use crate::Error;
use crate::engine::{Engine, Meter, Method, Plan, Planes, Quantity, SphereForces, Sweep, Table};
use crate::error::bug;
use crate::formula::triples;
use crate::lattice::Row;
use crate::pile::System;
use crate::scalar::{Algebra, Exactness, Ring};
use crate::shape::{Selection, Shape};

/// The layers of a part of a pile, from the top, made by [`Forces::layers`].
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(10)?;
/// let mut layers = pile.forces::<f64>().layers(Selection::Layer(2))?;
/// let layer = layers.next_layer()?.expect("layer 2 is asked for");
/// let [mut alpha, mut beta, mut gamma] = [[0.0; 6]; 3];
/// layer.fill([&mut alpha, &mut beta, &mut gamma])?;
/// assert_eq!(alpha, [3.0, 2.0, 1.0, 2.0, 1.0, 1.0]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub struct Layers<'p, T: Algebra> {
    pub(super) terms: Terms<'p, T>,
    walk: RowEngine<'p, T>,
    /// The distinct forces of a straight pile, which are copied into the slices.
    pub(super) table: Option<Table<T>>,
    /// The remaining layers.
    ahead: Range<i128>,
    /// The current layer.
    at: Option<i128>,
    /// The number of layers at which the sweep has stopped.
    stops: usize,
    /// True if a value of the sweep may overflow the scalar.
    may_overflow: bool,
    meter: Meter<'p>,
}

impl<'p, T: Algebra> Forces<'p, T> {
    /// Iterates over the layers of `part`, from the top. Each layer writes its contact forces, in f₀, into
    /// caller-provided slices. This is the fastest way to compute many forces.
    ///
    /// # Errors
    /// As for [`contacts`](Self::contacts).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::under(Region::SITE, "++-".parse()?)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::All)?;
    /// let mut total = 0.0;
    /// while let Some(layer) = layers.next_layer()? {
    ///     if layer.is_floor() {
    ///         break;
    ///     }
    ///     let mut forces = [(); 3].map(|()| vec![0.0; layer.sphere_count()]);
    ///     let [alpha, beta, gamma] = &mut forces;
    ///     layer.fill([alpha, beta, gamma])?;
    ///     total += forces.concat().iter().sum::<f64>();
    /// }
    /// // The forces below a layer sum to 3 f₀ for each sphere in or above the layer: 1, 1 + 3 and 1 + 3 + 6 spheres.
    /// assert!((total - 45.0).abs() < 1e-12);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn layers(&self, part: Selection) -> Result<Layers<'p, T>, Error> {
        Layers::new(self, part)
    }
}

impl<'p, T: Algebra> Layers<'p, T> {
    fn new(forces: &Forces<'p, T>, part: Selection) -> Result<Self, Error> {
        let (pile, terms) = (forces.pile, forces.terms.clone());
        let part = match part {
            Selection::One(site) => Selection::Layer(pile.shape().check(site)?.k),
            part => part,
        };
        let rows = pile.rows(part)?;
        let ahead = rows.layers();
        // The bottom layer has no contacts below it. The layers above it need the same plan.
        let plan = forces.plan(&rows, Quantity::ContactMultiples)?;
        Ok(Self {
            walk: RowEngine::new(&plan, &rows, &terms)?,
            table: table(&plan, &terms, ahead.end - 1)?,
            may_overflow: may_overflow::<T>(&terms.system, ahead.end - 1),
            terms,
            ahead,
            at: None,
            stops: 0,
            meter: forces.meter,
        })
    }

    /// Advances to layer `k` of the part, unless it is the current layer.
    ///
    /// # Errors
    /// [`Error::OtherLayer`] for a layer above the current one or outside the part.
    pub(super) fn go_down_to(&mut self, k: i128) -> Result<(), Error> {
        if self.at == Some(k) {
            return Ok(());
        }
        if !self.ahead.contains(&k) {
            let at = match self.at {
                Some(reached) => reached,
                None => self.ahead.start,
            };
            return Err(Error::OtherLayer { layer: k, at });
        }
        self.walk.go_down_to(k, self.meter)?;
        self.stops += usize::from(self.walk.is_sweep());
        (self.at, self.ahead.start) = (Some(k), k + 1);
        Ok(())
    }

    /// Returns the length of each of the three slices of [`fill`](Self::fill): the number of spheres in the remaining
    /// layers above the floor.
    ///
    /// # Errors
    /// [`Error::TooLarge`] for more entries than any memory can hold.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// // 55 of the 220 spheres are on the floor.
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.forces::<f64>().layers(Selection::All)?.slice_len()?, 220 - 55);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn slice_len(&self) -> Result<usize, Error> {
        let spheres = self.shape().spheres_in(self.above_the_floor());
        spheres.to_usize().ok_or(Error::TooLarge {
            quantity: "all contact forces",
            needed: spheres,
            limit: usize::MAX as u64,
            remedy: "fill layer by layer",
        })
    }

    /// Writes the contact forces of all remaining layers into slices, one slice for each direction, layer after layer,
    /// in f₀.
    ///
    /// With the feature `rayon` the work runs on all cores. Exact numbers below sign changes are an exception: one
    /// thread writes them.
    ///
    /// # Errors
    /// [`Error::Length`] for a slice whose length is not [`slice_len`](Self::slice_len); otherwise as for
    /// [`Layer::fill`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(3)?;
    /// let [mut alpha, mut beta, mut gamma] = [[0.0; 4]; 3];
    /// pile.forces().layers(Selection::All)?.fill([&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!(alpha, [1.0, 2.0, 1.0, 1.0]);
    /// assert_eq!(beta, [1.0, 1.0, 2.0, 1.0]);
    /// assert_eq!(gamma, [1.0, 1.0, 1.0, 2.0]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill(mut self, slices: [&mut [T]; 3]) -> Result<(), Error> {
        if let Some(table) = &self.table {
            return self.fill_from_table(table, slices);
        }
        self.fill_each(slices, |layer, [a, b, c]| layer.fill([a, b, c]))
    }

    /// Writes the forces of all remaining layers into slices, from a table.
    pub(super) fn fill_from_table<V: Clone + Send + Sync>(
        &self,
        table: &Table<V>,
        slices: [&mut [V]; 3],
    ) -> Result<(), Error> {
        check_lengths(self.slice_len()?, &slices)?;
        table.fill(self.above_the_floor(), slices)
    }

    /// Returns the largest number of increments in a contact force of the part.
    pub(super) fn most_increments(&self) -> i128 {
        most_increments(self.shape(), self.ahead.end - 1)
    }

    pub(super) fn above_the_floor(&self) -> Range<i128> {
        let floor = self.shape().layers() - 1;
        self.ahead.start.min(floor)..self.ahead.end.min(floor)
    }

    pub(super) fn shape(&self) -> &'p Shape {
        self.terms.system.shape
    }
}

/// Returns whether a value in a sweep down to layer `last` may overflow the scalar.
///
/// A scalar that holds twice the bound on all values does not overflow. With 24 bits or more, rounding errors exceed
/// this margin only after half a million passes. A layer so far down does not fit in memory.
fn may_overflow<T: Algebra>(system: &System<'_>, last: i128) -> bool {
    let is_fine = matches!(T::EXACTNESS, Exactness::Rounded { bits: 24.. });
    if !is_fine || triples::<T>() || system.has_scalar_loads {
        return true;
    }
    let twice = BigRational::new(system.bound_of_sweep(last) * 2, system.denominator());
    !T::from_rational(&twice).is_defined()
}

/// Returns an error unless each slice has `needed` elements.
pub(crate) fn check_lengths<T>(needed: usize, slices: &[&mut [T]; 3]) -> Result<(), Error> {
    match slices.iter().find(|slice| slice.len() != needed) {
        Some(slice) => Err(Error::Length {
            needed,
            given: slice.len(),
        }),
        None => Ok(()),
    }
}

/// Returns the table of distinct forces of a straight pile down to layer `last`, if the table is small.
fn table<T: Algebra>(
    plan: &Plan,
    Terms { lines, system, .. }: &Terms<'_, T>,
    last: i128,
) -> Result<Option<Table<T>>, Error> {
    if plan.method != Method::Closed {
        return Ok(None);
    }
    let scale = lines.scale(0);
    Table::new(system, most_increments(system.shape, last), |n, line| {
        let force = lines.ordinary(T::Numerator::from_i128(n), line);
        super::to_scalar("a contact force", force, &scale)
    })
}

/// Returns the largest number of increments on a line of contacts down to layer `last`.
fn most_increments(shape: &Shape, last: i128) -> i128 {
    (last + 1).min(shape.layers() - 1)
}

impl<'p> Layers<'p, BigRational> {
    /// Returns the denominator of the forces below `changes` sign changes.
    pub(super) fn denominator(&self, changes: usize) -> BigInt {
        self.terms.lines.scale(changes)
    }

    /// Returns the denominator of the forces below the lowest remaining layer above the floor.
    pub(super) fn lowest_denominator(&self) -> BigInt {
        self.denominator(self.shape().changes_above(self.above_the_floor().end))
    }

    /// Returns the forces from above on consecutive spheres of a row of the current layer.
    pub(super) fn received_in(&self, row: &Row) -> Result<Vec<SphereForces<BigRational>>, Error> {
        let (terms, engine) = self.exact()?;
        let system = (&terms.lines, &terms.system);
        let received = engine.received_in(system, row, self.meter);
        received.into_iter().collect()
    }

    /// Returns the forces of consecutive spheres of a row of the current layer on the spheres below.
    pub(super) fn transmitted_in(
        &self,
        row: &Row,
    ) -> Result<Vec<SphereForces<BigRational>>, Error> {
        let (terms, engine) = self.exact()?;
        let system = (&terms.lines, &terms.system);
        let below = engine.transmitted_in(system, row, self.meter);
        below.into_iter().collect()
    }

    fn exact(&self) -> Result<(&Terms<'p, BigRational>, &Engine<'p, BigRational, Planes>), Error> {
        match &self.walk {
            RowEngine::Exact(terms, engine) => Ok((terms, engine)),
            RowEngine::Plain(..) => Err(bug("rationals are computed by the exact engine")),
        }
    }

    /// Returns the exact sweep, which works on limbs, if there is one.
    pub(super) fn exact_sweep(&self) -> Option<&Sweep<'p, BigRational, Planes>> {
        match &self.walk {
            RowEngine::Exact(_, Engine::Sweep(sweep)) => Some(sweep),
            _ => None,
        }
    }
}

impl<T: Algebra> fmt::Debug for Layers<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Layers")
            .field("ahead", &self.ahead)
            .finish_non_exhaustive()
    }
}
