//! The forces of whole layers, written into slices: the fast way to many of them.

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use super::terms::Terms;
use super::{FloorForce, Forces};
use crate::Error;
use crate::engine::{
    Cells, Descent, Meter, Method, Plan, Planes, Quantity, Received, Table, exact_sweep,
    plain_sweep, received_in,
};
use crate::error::bug;
use crate::formula::{half_turn, passed_on, triples};
use crate::lattice::{Region, Row, Site};
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
pub struct Layers<'p, T: Algebra, M = ()> {
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
    meter: M,
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

/// One layer of a pile, with its forces at hand.
pub struct Layer<'l, 'p, T: Algebra, M = ()> {
    pub(super) layers: &'l Layers<'p, T, M>,
    k: i128,
    pub(super) region: Region,
    pub(super) spheres: usize,
}

impl<'p, T: Algebra, M: Meter> Layers<'p, T, M> {
    pub(super) fn new(forces: &Forces<'p, T, M>, part: Selection) -> Result<Self, Error> {
        let (pile, terms) = (forces.pile, forces.terms.clone());
        let floor = pile.layers() - 1;
        let ahead = match part {
            Selection::All => 0..floor + 1,
            Selection::Base => floor..floor + 1,
            Selection::Layer(k) => k..k + 1,
            Selection::One(site) => site.k..site.k + 1,
        };
        let rows = match part {
            Selection::One(site) => pile.rows(Selection::Layer(pile.shape().check(site)?.k))?,
            part => pile.rows(part)?,
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
    ///     spheres += layer.spheres();
    /// }
    /// assert_eq!(spheres, 20);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn next_layer(&mut self) -> Result<Option<Layer<'_, 'p, T, M>>, Error> {
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

    /// Returns how many spheres of the layers still to come rest on others: the length of each slice of
    /// [`fill`](Self::fill).
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
    /// assert_eq!(pile.forces::<f64>().layers(Selection::All)?.spheres()?, 220 - 55);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn spheres(&self) -> Result<usize, Error> {
        let spheres = self.shape().spheres_in(self.above_the_floor());
        spheres.to_usize().ok_or(Error::TooLarge {
            quantity: "all contact forces",
            needed: spheres,
            limit: usize::MAX as u64,
            remedy: "fill layer by layer",
        })
    }

    /// Writes the contact forces of all layers still to come into slices, one for each direction, layer after layer, in f₀;
    /// on all cores with the feature `rayon`.
    ///
    /// # Errors
    /// [`Error::Length`] for a slice that is not as long as there are [`spheres`](Self::spheres); else as for
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
        check_lengths(self.spheres()?, &slices)?;
        let mut rest = slices;
        self.ahead = self.above_the_floor();
        while let Some(layer) = self.next_layer()? {
            let front = split_front(&mut rest, layer.spheres())?;
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
        check_lengths(self.spheres()?, &slices)?;
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

/// Splits the first `n` elements off each slice.
pub(super) fn split_front<'a, V>(
    rest: &mut [&'a mut [V]; 3],
    n: usize,
) -> Result<[&'a mut [V]; 3], Error> {
    match rest.each_mut().map(|rest| rest.split_off_mut(..n)) {
        [Some(a), Some(b), Some(c)] => Ok([a, b, c]),
        _ => Err(bug("slices are as long as was checked")),
    }
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

impl<'p, M: Meter> Layers<'p, BigRational, M> {
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

impl<M: Meter> Layer<'_, '_, BigRational, M> {
    /// Returns the denominator of the forces below the layer.
    pub(super) fn denominator(&self) -> BigInt {
        self.layers
            .denominator(self.shape().changes_above(self.k + 1))
    }

    /// Writes what becomes of the numerators of the forces below each sphere.
    pub(super) fn fill_numerators<V>(
        &self,
        slices: [&mut [V]; 3],
        value: impl Fn([BigInt; 3]) -> Result<[V; 3], Error>,
    ) -> Result<(), Error> {
        check_lengths(self.spheres, &slices)?;
        self.check_above_the_floor()?;
        let mut rest = slices;
        for row in self.region.rows(self.k) {
            let below = self.layers.passed_on_in(&row)?;
            let [a, b, c] = split_front(&mut rest, below.len())?;
            for (forces, ((a, b), c)) in below.into_iter().zip(a.iter_mut().zip(b).zip(c)) {
                [*a, *b, *c] = value(forces.forces)?;
            }
        }
        Ok(())
    }
}

impl<T: Algebra, M: Meter> Layer<'_, '_, T, M> {
    /// Returns the number of the layer, counted from 0 at the top.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::Base)?;
    /// assert_eq!(layers.next_layer()?.map(|layer| layer.k()), Some(3));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn k(&self) -> i128 {
        self.k
    }

    /// Returns the number of spheres of the layer: the length of each slice to fill.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::Base)?;
    /// assert_eq!(layers.next_layer()?.map(|layer| layer.spheres()), Some(10));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn spheres(&self) -> usize {
        self.spheres
    }

    /// Whether the layer is the one on the floor, which has no contacts below it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::All)?;
    /// assert_eq!(layers.next_layer()?.map(|layer| layer.is_floor()), Some(false));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn is_floor(&self) -> bool {
        self.k == self.shape().layers() - 1
    }

    /// Returns the forces of a sphere of this layer to the spheres below, by direction, in f₀; zero along γ for discs.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::OtherLayer`] for a sphere of another layer; [`Error::OnFloor`];
    /// [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Region, Site};
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::Layer(2))?;
    /// let layer = layers.next_layer()?.expect("layer 2 is asked for");
    /// let forces = layer.to_below(Site { i: 0, j: 0, k: 2 })?;
    /// assert_eq!(forces.map(|force| force.to_string()), ["5/3"; 3]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn to_below(&self, site: Site) -> Result<[T; 3], Error> {
        self.check(site)?;
        if self.is_floor() {
            return Err(Error::OnFloor { site });
        }
        self.passed_on(site)
    }

    /// Returns the force of a sphere of this layer, the one on the floor, on the floor.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::NotOnFloor`]; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::Base)?;
    /// let floor = layers.next_layer()?.expect("every pile has a floor");
    /// assert_eq!(floor.on_floor(Site { i: 0, j: 0, k: 9 })?.normal, 4.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn on_floor(&self, site: Site) -> Result<FloorForce<T>, Error> {
        self.check(site)?;
        if !self.is_floor() {
            let floor = self.shape().layers() - 1;
            return Err(Error::NotOnFloor { site, floor });
        }
        let Layers {
            terms, meter, way, ..
        } = self.layers;
        match way {
            Way::Plain(sweep) => terms.floor(site, &sweep.received(site)?),
            Way::Exact(terms, sweep) => {
                let force = terms.floor(site, &sweep.received(site)?)?;
                Ok(force.map(|component| T::from_rational(&component)))
            }
            Way::Table(_) => terms.floor(site, &terms.received(site, None, *meter)?),
            Way::Single { method, .. } => {
                terms.floor(site, &terms.received(site, *method, *meter)?)
            }
        }
    }

    /// Writes the forces below the layer into slices, one for each direction, row after row, in f₀; zero along γ for
    /// discs.
    ///
    /// # Errors
    /// [`Error::Length`] for a slice that is not as long as the layer has [`spheres`](Self::spheres); [`Error::OnFloor`];
    /// [`Error::Overflow`] if the scalar cannot hold a force, after the slices were written to.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::Layer(1))?;
    /// let layer = layers.next_layer()?.expect("layer 1 is asked for");
    /// let [mut alpha, mut beta, mut gamma] = [[0.0; 3]; 3];
    /// layer.fill([&mut alpha, &mut beta, &mut gamma])?;
    /// // Each of the three passes the weight of the apex on: 2/3, 2/3 and −1/3, and its own.
    /// assert!((alpha[0] - 2.0 / 3.0).abs() < 1e-15);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill(&self, slices: [&mut [T]; 3]) -> Result<(), Error> {
        check_lengths(self.spheres, &slices)?;
        self.check_above_the_floor()?;
        match &self.layers.way {
            Way::Table(table) => table.fill(self.k..self.k + 1, slices),
            Way::Plain(sweep) => self.fill_from(sweep, slices),
            Way::Single { .. } | Way::Exact(..) => {
                let [alpha, beta, gamma] = slices;
                let out = alpha.iter_mut().zip(beta).zip(gamma);
                for (site, ((a, b), c)) in self.region.rows(self.k).flatten().zip(out) {
                    [*a, *b, *c] = self.passed_on(site)?;
                }
                Ok(())
            }
        }
    }

    /// Writes the values of a sphere into slices that go over the layer.
    pub(super) fn put_at<V>(
        &self,
        site: Site,
        values: [V; 3],
        slices: [&mut [V]; 3],
    ) -> Result<(), Error> {
        let place = self.region.sites_before(site.i, site.j).to_usize();
        let place = place.filter(|place| *place < self.spheres);
        let place = place.ok_or_else(|| bug("a loaded sphere has a place in its layer"))?;
        for (slice, value) in slices.into_iter().zip(values) {
            // As long as the layer.
            slice[place] = value;
        }
        Ok(())
    }

    /// Writes what a table says of the layer into slices.
    pub(super) fn fill_from_table<V: Clone + Send + Sync>(
        &self,
        table: &Table<V>,
        slices: [&mut [V]; 3],
    ) -> Result<(), Error> {
        check_lengths(self.spheres, &slices)?;
        self.check_above_the_floor()?;
        table.fill(self.k..self.k + 1, slices)
    }

    /// Writes the forces of the bottom layer on the floor into slices, row after row: normal in mg, shear_x in mg·tanθ and
    /// shear_y in 2cosφ·mg·tanθ.
    ///
    /// # Errors
    /// [`Error::Length`]; [`Error::NotOnFloor`] for a layer above it; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::Base)?;
    /// let floor = layers.next_layer()?.expect("every pile has a floor");
    /// let [mut normal, mut shear_x, mut shear_y] = [[0.0; 55]; 3];
    /// floor.fill_base([&mut normal, &mut shear_x, &mut shear_y])?;
    /// assert_eq!((normal, shear_x[0], shear_y[0]), ([4.0; 55], -1.5, -1.5));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_base(&self, slices: [&mut [T]; 3]) -> Result<(), Error> {
        check_lengths(self.spheres, &slices)?;
        let [normal, shear_x, shear_y] = slices;
        let out = normal.iter_mut().zip(shear_x).zip(shear_y);
        for (site, ((normal, shear_x), shear_y)) in self.region.rows(self.k).flatten().zip(out) {
            let force = self.on_floor(site)?;
            (*normal, *shear_x, *shear_y) = (force.normal, force.shear_x, force.shear_y);
        }
        Ok(())
    }

    /// Returns a bound on how far a contact force below the layer can be from the exact one, in f₀: 0 in an exact scalar,
    /// `None` where the scalar promises no precision or the bound would be useless.
    ///
    /// Every operation of a sweep is off by at most one unit in the last place, no sum on the way to 3G g is greater than
    /// 2√3·‖g‖, and the transfer amplifies nothing: with n passes and sums on the way, 13·n units in the last place of the
    /// bound on all forces.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use num_traits::ToPrimitive;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+-+-".parse()?)?;
    /// let mut layers = pile.forces::<f64>().layers(Selection::Layer(5))?;
    /// let layer = layers.next_layer()?.expect("layer 5 is asked for");
    /// let bound = layer.error_bound().and_then(|bound| bound.to_f64());
    /// assert!(bound < Some(1e-12));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn error_bound(&self) -> Option<BigRational> {
        let bits = match T::EXACTNESS {
            Exactness::Exact => return Some(BigRational::zero()),
            Exactness::Rounded { bits } => bits,
            _ => return None,
        };
        let system = &self.layers.terms.system;
        let changes = self.shape().changes_above(self.k + 1) + 1;
        let extras = self.layers.terms.lines.extras_in(0..self.k + 1).count();
        // As many passes as runs, and as layers stopped at; one more for what a sphere adds itself.
        let steps = BigInt::from(self.layers.stops + changes + extras + 1);
        let unit = BigRational::new(steps * 13, BigInt::one() << bits);
        // 2√3·B·D is at least 3·B·D.
        let greatest = BigRational::new(system.bound_of_sweep(self.k), system.denominator() * 3);
        let little = unit < BigRational::new(1.into(), 100.into());
        little.then(|| unit * greatest)
    }

    fn shape(&self) -> &Shape {
        self.layers.shape()
    }

    /// Errors if the layer is the one on the floor.
    pub(super) fn check_above_the_floor(&self) -> Result<(), Error> {
        if self.is_floor() {
            return Err(Error::OnFloor { site: self.first() });
        }
        Ok(())
    }

    /// Errors if the layer is not the one on the floor.
    pub(super) fn check_on_the_floor(&self) -> Result<(), Error> {
        if self.is_floor() {
            return Ok(());
        }
        let floor = self.shape().layers() - 1;
        Err(Error::NotOnFloor {
            site: self.first(),
            floor,
        })
    }

    fn first(&self) -> Site {
        let [[i, j], ..] = self.region.corners();
        Site { i, j, k: self.k }
    }

    fn check(&self, site: Site) -> Result<(), Error> {
        self.shape().check(site)?;
        if site.k == self.k {
            Ok(())
        } else {
            Err(Error::OtherLayer {
                layer: site.k,
                at: self.k,
            })
        }
    }

    /// Returns what a sphere of this layer, above the floor, passes on.
    fn passed_on(&self, site: Site) -> Result<[T; 3], Error> {
        let Layers {
            terms, meter, way, ..
        } = self.layers;
        let passed_on = match way {
            Way::Plain(sweep) => sweep.passed_on(site, *meter)?,
            Way::Exact(terms, sweep) => {
                let forces = terms.contacts(sweep.passed_on(site, *meter)?)?;
                return Ok(forces.map(|force| T::from_rational(&force)));
            }
            Way::Table(_) => terms.passed_on(site, None, *meter)?,
            Way::Single { method, .. } => terms.passed_on(site, *method, *meter)?,
        };
        terms.contacts(passed_on)
    }

    /// Fills slices from the cells of a sweep, row by row.
    fn fill_from(
        &self,
        sweep: &Descent<'_, T, Cells<T::Numerator>>,
        slices: [&mut [T]; 3],
    ) -> Result<(), Error> {
        let lines = &self.layers.terms.lines;
        let changes = self.shape().changes_above(self.k + 1);
        let below = Below::<T> {
            own: lines.increments_after(changes),
            scale: lines.scale(changes),
            turns: sweep.turned_already() < changes,
            may_overflow: self.layers.may_overflow,
        };
        let [alpha, beta, gamma] = slices;
        let mut rest = [&mut *alpha, &mut *beta, &mut *gamma];
        let mut defined = true;
        let carried = sweep.carried_by_rows();
        for row in self.region.rows(self.k) {
            let row = carried(&row)?;
            let out = split_front(&mut rest, row[0].len())?;
            defined &= below.write(row, out);
        }
        // Spheres that weigh more or less than the others, or carry loads.
        for site in lines.extras_in(self.k..self.k + 1) {
            let forces = self.layers.terms.contacts(sweep.passed_on(site, ())?)?;
            self.put_at(site, forces, [&mut *alpha, &mut *beta, &mut *gamma])?;
        }
        if defined {
            Ok(())
        } else {
            Err(Error::Overflow {
                quantity: "a contact force",
                scalar: T::NAME,
            })
        }
    }
}

/// What turns the numbers that lines carry into forces below a layer.
struct Below<T: Algebra> {
    /// What an ordinary sphere of the layer adds.
    own: [T::Numerator; 3],
    /// The denominator.
    scale: T::Numerator,
    /// Whether the sign changes at the layer, and what is carried is not turned yet.
    turns: bool,
    /// Whether a force may be too great for the scalar.
    may_overflow: bool,
}

impl<T: Algebra> Below<T> {
    /// Writes the forces below a row, and returns whether all are numbers.
    fn write(&self, carried: [&[T::Numerator]; 3], out: [&mut [T]; 3]) -> bool {
        // In loops of their own: looking at each number takes half as long again.
        match (self.turns, self.may_overflow) {
            (false, false) => self.write_checked(carried, out, |_| true),
            (false, true) => self.write_checked(carried, out, T::is_defined),
            (true, _) => self.write_turned(carried, out),
        }
    }

    #[inline]
    fn write_checked(
        &self,
        carried: [&[T::Numerator]; 3],
        out: [&mut [T]; 3],
        is_defined: impl Fn(&T) -> bool,
    ) -> bool {
        let mut defined = true;
        for ((carried, out), own) in carried.into_iter().zip(out).zip(&self.own) {
            for (force, out) in carried.iter().zip(out) {
                defined &= self.put(passed_on(force.clone(), own), out, &is_defined);
            }
        }
        defined
    }

    fn write_turned(&self, [a, b, c]: [&[T::Numerator]; 3], out: [&mut [T]; 3]) -> bool {
        let mut defined = true;
        let carried = a.iter().zip(b).zip(c);
        let [to_a, to_b, to_c] = out;
        for (((a, b), c), ((to_a, to_b), to_c)) in carried.zip(to_a.iter_mut().zip(to_b).zip(to_c))
        {
            let turned = half_turn::<T>(&[a.clone(), b.clone(), c.clone()]);
            for ((force, out), own) in turned.into_iter().zip([to_a, to_b, to_c]).zip(&self.own) {
                defined &= self.put(passed_on(force, own), out, &T::is_defined);
            }
        }
        defined
    }

    #[inline]
    fn put(&self, force: T::Numerator, out: &mut T, is_defined: &impl Fn(&T) -> bool) -> bool {
        match T::from_ratio(force, &self.scale) {
            Some(value) => {
                let defined = is_defined(&value);
                *out = value;
                defined
            }
            None => false,
        }
    }
}

impl<T: Algebra, M> fmt::Debug for Layers<'_, T, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Layers")
            .field("ahead", &self.ahead)
            .finish_non_exhaustive()
    }
}

impl<T: Algebra, M> fmt::Debug for Layer<'_, '_, T, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Layer")
            .field("k", &self.k)
            .finish_non_exhaustive()
    }
}
