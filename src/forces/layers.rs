//! The forces of whole layers, written into slices: the fast way to many of them.

mod below;
mod layer;

pub use layer::Layer;

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::Forces;
use super::terms::Terms;
use crate::Error;
use crate::engine::{
    Cells, Descent, Meter, Method, Plan, Planes, Quantity, Received, Table, exact_sweep,
    plain_sweep, received_in, split_front,
};
use crate::formula::triples;
use crate::lattice::Row;
use crate::pile::System;
use crate::scalar::{Algebra, Exactness, Ring};
use crate::shape::{Selection, Shape};

/// A way down through the layers of a part of a pile, made by [`Forces::layers`].
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
    way: Way<'p, T>,
    /// The layers still to come.
    ahead: Range<i128>,
    /// The layer that was reached.
    at: Option<i128>,
    /// How many layers were stopped at.
    stops: usize,
    /// Whether a number of a sweep may be too great for the scalar.
    may_overflow: bool,
    meter: Meter<'p>,
}

/// How the layers are gone through.
enum Way<'p, T: Algebra> {
    /// By copying the distinct forces of a straight pile.
    Table(Box<Table<T>>),
    /// Sphere by sphere, or by the lines that lead to pieces of a row.
    Single {
        method: Option<Method>,
        in_pieces: bool,
    },
    /// By a sweep in the numerators of the scalar.
    Plain(Box<Descent<'p, T, Cells<T::Numerator>>>),
    /// By a sweep in the limbs of the exact engine.
    Exact(
        Box<Terms<'p, BigRational>>,
        Box<Descent<'p, BigRational, Planes>>,
    ),
}

impl<'p, T: Algebra> Layers<'p, T> {
    pub(super) fn new(forces: &Forces<'p, T>, part: Selection) -> Result<Self, Error> {
        let (pile, terms) = (forces.pile, forces.terms.clone());
        let floor = pile.layers() - 1;
        let part = match part {
            Selection::One(site) => Selection::Layer(pile.shape().check(site)?.k),
            part => part,
        };
        let rows = pile.rows(part)?;
        let ahead = match part {
            Selection::All => 0..floor + 1,
            Selection::Base => floor..floor + 1,
            // The pile has rows of it, so one more is no overflow.
            Selection::Layer(k) => k..k + 1,
            Selection::One(site) => site.k..site.k + 1,
        };
        // Of the contacts there is nothing on the floor; what leads to it is the same.
        let quantity = Quantity::ContactMultiples;
        let plan = terms.system.plan(
            &rows,
            quantity,
            forces.method,
            crate::engine::Keeping::of::<T>(),
        )?;
        Ok(Self {
            way: Way::of(&plan, &terms, forces.method, ahead.end - 1)?,
            may_overflow: may_overflow::<T>(&terms.system, ahead.end - 1),
            terms,
            ahead,
            at: None,
            stops: 0,
            meter: forces.meter,
        })
    }

    /// Goes down to the next layer of the part and returns it, or `None` below the last one.
    ///
    /// # Errors
    /// [`Error::TooLarge`] for a layer that no memory holds.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::All)?;
    /// let mut spheres = 0;
    /// while let Some(layer) = layers.next_layer()? {
    ///     spheres += layer.sphere_count();
    /// }
    /// assert_eq!(spheres, 20);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn next_layer(&mut self) -> Result<Option<Layer<'_, 'p, T>>, Error> {
        let Some(k) = self.ahead.clone().next() else {
            return Ok(None);
        };
        self.go_down_to(k)?;
        let region = self.shape().layer(k)?;
        let sites = region.site_count();
        let Some(spheres) = sites.to_usize() else {
            return Err(Error::TooLarge {
                quantity: "a layer",
                needed: sites,
                limit: usize::MAX as u64,
                remedy: "ask for one sphere",
            });
        };
        Ok(Some(Layer {
            layers: self,
            k,
            region,
            spheres,
        }))
    }

    /// Goes down to layer `k` of the part, if it is not the one that was reached.
    ///
    /// # Errors
    /// [`Error::OtherLayer`] for a layer above the one that was reached, or of which nothing is asked.
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
        match &mut self.way {
            Way::Table(_) | Way::Single { .. } => {}
            Way::Plain(sweep) => {
                sweep.advance(k, self.meter)?;
                self.stops += 1;
            }
            Way::Exact(_, sweep) => sweep.advance(k, self.meter)?,
        }
        (self.at, self.ahead.start) = (Some(k), k + 1);
        Ok(())
    }

    /// Returns the length that each of the three slices of [`fill`](Self::fill) must have: one entry for each sphere still
    /// to come that is not on the floor.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if no memory could hold as many.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// // Of the 220 spheres 55 are on the floor.
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

    /// Writes the contact forces of all layers still to come into slices, one for each direction, layer after layer, in f₀;
    /// with the feature `rayon` on all cores, but for exact numbers after changes of sign, which one thread writes.
    ///
    /// # Errors
    /// [`Error::Length`] for a slice that is not as long as there are [`slice_len`](Self::slice_len); else as for
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
        if let Way::Table(table) = &self.way {
            return self.fill_from_table(table, slices);
        }
        check_lengths(self.slice_len()?, &slices)?;
        let mut rest = slices;
        self.ahead = self.above_the_floor();
        while let Some(layer) = self.next_layer()? {
            let front = split_front(&mut rest, layer.sphere_count())?;
            layer.fill(front)?;
        }
        Ok(())
    }

    /// Writes what a table says of all layers still to come into slices.
    pub(super) fn fill_from_table<V: Clone + Send + Sync>(
        &self,
        table: &Table<V>,
        slices: [&mut [V]; 3],
    ) -> Result<(), Error> {
        check_lengths(self.slice_len()?, &slices)?;
        table.fill(self.above_the_floor(), slices)
    }

    /// The most increments that a contact force of the part is.
    pub(super) fn most_increments(&self) -> i128 {
        most_increments(self.shape(), self.ahead.end - 1)
    }

    /// Whether the layers are filled from the distinct forces of a straight pile.
    pub(super) fn is_from_table(&self) -> bool {
        self.table().is_some()
    }

    /// Returns the distinct forces, if the layers are filled from them.
    pub(super) fn table(&self) -> Option<&Table<T>> {
        match &self.way {
            Way::Table(table) => Some(table),
            _ => None,
        }
    }

    pub(super) fn above_the_floor(&self) -> Range<i128> {
        let floor = self.shape().layers() - 1;
        self.ahead.start.min(floor)..self.ahead.end.min(floor)
    }

    pub(super) fn shape(&self) -> &'p Shape {
        self.terms.system.shape
    }
}

/// Whether a number of a sweep down to layer `last` may be too great for the scalar: not if it holds twice the bound on all of
/// them. With 24 bits or more roundings would reach as far after half a million passes, of which no layer fits in memory.
fn may_overflow<T: Algebra>(system: &System<'_>, last: i128) -> bool {
    let is_fine = matches!(T::EXACTNESS, Exactness::Rounded { bits: 24.. });
    if !is_fine || triples::<T>() {
        return true;
    }
    let twice = BigRational::new(system.bound_of_sweep(last) * 2, system.denominator());
    !T::from_rational(&twice).is_defined()
}

/// Errors unless each slice has as many elements as are needed.
pub(crate) fn check_lengths<T>(needed: usize, slices: &[&mut [T]; 3]) -> Result<(), Error> {
    match slices.iter().find(|slice| slice.len() != needed) {
        Some(slice) => Err(Error::Length {
            needed,
            given: slice.len(),
        }),
        None => Ok(()),
    }
}

impl<'p, T: Algebra> Way<'p, T> {
    fn of(
        plan: &Plan,
        terms: &Terms<'p, T>,
        method: Option<Method>,
        last: i128,
    ) -> Result<Self, Error> {
        let Terms { lines, system, .. } = terms;
        if plan.method == Method::Sweep {
            if T::EXACTNESS == Exactness::Exact {
                let terms = Terms::<BigRational>::new(system.clone());
                let sweep = exact_sweep(&terms.lines, &terms.system, last)?;
                return Ok(Self::Exact(Box::new(terms), Box::new(sweep)));
            }
            let sweep = plain_sweep(lines, system, last)?;
            return Ok(Self::Plain(Box::new(sweep)));
        }
        let scale = lines.scale(0);
        let multiple = |n: i128, line: usize| {
            let force = lines.ordinary(T::Numerator::from_i128(n), line);
            super::edge("a contact force", force, &scale)
        };
        let table = match plan.method {
            Method::Closed => Table::new(system, most_increments(system.shape, last), multiple)?,
            Method::Tree | Method::Sweep => None,
        };
        Ok(match table {
            Some(table) => Self::Table(Box::new(table)),
            None => Self::Single {
                method,
                in_pieces: plan.method == Method::Tree,
            },
        })
    }
}

/// The most increments on a line of contacts down to layer `last`.
fn most_increments(shape: &Shape, last: i128) -> i128 {
    (last + 1).min(shape.layers() - 1)
}

impl<'p> Layers<'p, BigRational> {
    /// Returns the denominator of forces below so many changes of sign.
    pub(super) fn denominator(&self, changes: usize) -> BigInt {
        self.terms.lines.scale(changes)
    }

    /// Returns the denominator of the forces below the lowest layer that is still to come and not on the floor.
    pub(super) fn lowest_denominator(&self) -> BigInt {
        self.denominator(self.shape().changes_above(self.above_the_floor().end))
    }

    /// Returns the forces from above on consecutive spheres of a row of the layer that was reached.
    pub(super) fn received_in(&self, row: &Row) -> Result<Vec<Received<BigRational>>, Error> {
        let (terms, meter) = (&self.terms, self.meter);
        let sites = row.clone().into_iter();
        match &self.way {
            Way::Exact(_, sweep) => sites.map(|site| sweep.received(site)).collect(),
            Way::Plain(sweep) => sites.map(|site| sweep.received(site)).collect(),
            Way::Single {
                in_pieces: true, ..
            } => received_in(&terms.lines, row, meter),
            Way::Single { method, .. } => sites
                .map(|site| terms.received(site, *method, meter))
                .collect(),
            Way::Table(_) => sites
                .map(|site| terms.received(site, None, meter))
                .collect(),
        }
    }

    /// Returns the forces to the spheres below consecutive ones of a row of the layer that was reached.
    pub(super) fn passed_on_in(&self, row: &Row) -> Result<Vec<Received<BigRational>>, Error> {
        let meter = self.meter;
        let sites = row.clone().into_iter();
        match &self.way {
            // Where the sign changes the cells are turned already.
            Way::Exact(_, sweep) => sites.map(|site| sweep.passed_on(site, meter)).collect(),
            Way::Plain(sweep) => sites.map(|site| sweep.passed_on(site, meter)).collect(),
            Way::Table(_) | Way::Single { .. } => {
                let above = self.received_in(row)?.into_iter();
                let below = |(site, above)| self.terms.lines.to_below(site, above, meter);
                Ok(sites.zip(above).map(below).collect())
            }
        }
    }

    /// Returns the sweep in limbs, if there is one, and what its numbers are made of.
    pub(super) fn exact_sweep(
        &self,
    ) -> Option<(&Terms<'p, BigRational>, &Descent<'p, BigRational, Planes>)> {
        match &self.way {
            Way::Exact(terms, sweep) => Some((terms, sweep)),
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
