//! The forces of whole layers, written into slices. This is the fastest way to compute many forces.

mod below;
mod integers;
mod layer;
mod nearest;
mod scalars;

pub use integers::Integers;
pub use layer::Layer;
pub use nearest::Nearest;
pub(crate) use nearest::Units;

use alloc::vec::Vec;
use core::fmt;
use core::ops::Range;

use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::Forces;
use super::walk::Source;
use crate::Error;
use crate::engine::{LineForces, Method, Quantity, Table, check_interrupt, split_front};
use crate::error::bug;
use crate::lattice::{Row, Site};
use crate::scalar::{Algebra, Exactness, Numerators, Ring};
use crate::shape::{Selection, Shape};

/// The layers of a part of a pile, from the top, made by [`Forces::layers`].
///
/// They write the [`Output`] `O`: values of a scalar, [correctly rounded floats](Nearest) or [integers](Integers).
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
pub struct Layers<'p, O: Output> {
    source: Source<'p, O::Scalar>,
    unit: O::Unit,
    /// Whether the plan has chosen closed forms.
    is_closed: bool,
    /// The distinct forces of a straight pile, which are copied into the slices.
    table: Option<Table<O::Value>>,
    /// The remaining layers.
    ahead: Range<i128>,
    /// The current layer.
    at: Option<i128>,
    /// The number of layers at which the sweep has stopped.
    stops: usize,
    /// True if a value of the sweep may overflow the scalar.
    may_overflow: bool,
    /// The conversions of the last rows, each with its quantity and layer.
    conversions: Vec<(Quantities, i128, O::Conversion)>,
}

/// What [`Layers`] write: every scalar, [`Nearest`] floats and [`Integers`]. It cannot
/// be implemented outside this crate.
pub trait Output: Write {}

impl<O: Write> Output for O {}

/// The conversion of numerators into the values of an output.
pub trait Write: Sized {
    /// The scalar of the computation.
    type Scalar: Algebra;
    /// A value in a slice.
    type Value: Clone + Send + Sync;
    /// What the values of all layers have in common.
    type Unit: Send + Sync;
    /// What [`Layers::fill`] returns.
    type Whole;
    /// The conversion of a quantity in one layer.
    type Conversion: Send + Sync;

    /// Prepares to fill all layers at once.
    fn begin_whole(layers: &mut Layers<'_, Self>) -> Self::Whole;

    /// Returns the conversion of a quantity in layer `k`.
    fn conversion(
        layers: &Layers<'_, Self>,
        asked: Quantities,
        k: i128,
    ) -> Result<Self::Conversion, Error>;

    /// Returns whether a conversion is the same in all layers.
    fn is_of_all_layers(_: &Self::Conversion) -> bool {
        false
    }

    /// Converts one of the three numerators of a sphere.
    fn value(
        conversion: &Self::Conversion,
        line: usize,
        numerator: <Self::Scalar as Algebra>::Numerator,
    ) -> Result<Self::Value, Error>;

    /// Writes a row straight from the numbers of the engine, as if every sphere were ordinary. Returns `false` if the
    /// output cannot do so, or if a value overflows.
    fn write_ordinary(
        _: &Layers<'_, Self>,
        _: &Self::Conversion,
        _: &Row,
        _: [&mut [Self::Value]; 3],
    ) -> Result<bool, Error> {
        Ok(false)
    }
}

/// The quantity that is written for each sphere, as three numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantities {
    /// The contact forces, by direction.
    Contacts,
    /// The components of the contact forces along one axis, by direction.
    Along(usize),
    /// The force on the floor: normal, shear along x, shear along y.
    Floor,
}

impl Quantities {
    const fn name(self) -> &'static str {
        match self {
            Self::Contacts | Self::Along(_) => "a contact force",
            Self::Floor => "a force on the floor",
        }
    }
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
        let (pile, lines) = (forces.pile, &forces.lines);
        let part = match part {
            Selection::One(site) => Selection::Layer(pile.shape().check(site)?.k),
            part => part,
        };
        let rows = pile.rows(part)?;
        let ahead = rows.layers();
        // The bottom layer has no contacts below it. The layers above it need the same plan.
        let plan = lines.plan(&rows, Quantity::Contacts, forces.method)?;
        let layers = Self {
            source: Source::new(forces, &rows, &plan)?,
            unit: (),
            is_closed: plan.method == Method::Closed,
            table: None,
            may_overflow: may_overflow(lines, ahead.end - 1),
            ahead,
            at: None,
            stops: 0,
            conversions: Vec::new(),
        };
        layers.with_table()
    }
}

impl<'p, O: Output> Layers<'p, O> {
    /// Returns the layers with another output.
    pub(crate) fn into_output<U: Output<Scalar = O::Scalar>>(
        self,
        unit: U::Unit,
    ) -> Result<Layers<'p, U>, Error> {
        let layers = Layers {
            source: self.source,
            unit,
            is_closed: self.is_closed,
            table: None,
            ahead: self.ahead,
            at: self.at,
            stops: self.stops,
            may_overflow: self.may_overflow,
            conversions: Vec::new(),
        };
        layers.with_table()
    }

    /// Returns the layers with the distinct forces of a straight pile, if they are few.
    fn with_table(self) -> Result<Self, Error> {
        if !self.is_closed || self.above_the_floor().is_empty() {
            return Ok(self);
        }
        let table = self.table_of(&O::conversion(&self, Quantities::Contacts, 0)?)?;
        Ok(Self { table, ..self })
    }

    /// Returns the table of the distinct contact forces of a straight pile, if they are few.
    fn table_of(&self, conversion: &O::Conversion) -> Result<Option<Table<O::Value>>, Error> {
        let lines = &self.source.lines;
        // The largest number of increments in a contact force of the part.
        let most = self.ahead.end.min(self.shape().layers() - 1);
        Table::new(lines, most, |n, line| {
            let number = <O::Scalar as Algebra>::Numerator::from_integer(n);
            O::value(conversion, line, lines.ordinary(0, number, line))
        })
    }

    /// Advances to layer `k` of the part, unless it is the current layer.
    ///
    /// # Errors
    /// [`Error::OtherLayer`] for a layer above the current one or outside the part.
    fn go_down_to(&mut self, k: i128) -> Result<(), Error> {
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
        let Source { engine, meter, .. } = &mut self.source;
        engine.go_down_to(k, *meter)?;
        self.stops += usize::from(engine.is_sweep());
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
    /// With the feature `rayon` the work runs on all cores. Integers are over the denominator of the lowest layer, which is
    /// returned.
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
    /// pile.forces::<f64>().layers(Selection::All)?.fill([&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!(alpha, [1.0, 2.0, 1.0, 1.0]);
    /// assert_eq!(beta, [1.0, 1.0, 2.0, 1.0]);
    /// assert_eq!(gamma, [1.0, 1.0, 1.0, 2.0]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill(mut self, slices: [&mut [O::Value]; 3]) -> Result<O::Whole, Error> {
        check_lengths(self.slice_len()?, &slices)?;
        let whole = O::begin_whole(&mut self);
        self.ahead = self.above_the_floor();
        if let Some(table) = &self.table {
            table.fill(self.ahead, slices)?;
            return Ok(whole);
        }
        let mut rest = slices;
        while let Some(layer) = self.next_layer()? {
            layer.fill(split_front(&mut rest, layer.sphere_count())?)?;
        }
        Ok(whole)
    }

    /// Writes the forces below consecutive spheres of a row into slices, one slice for each direction. Use it for
    /// results that are larger than memory.
    ///
    /// The rows must come from the top down. Layers may be skipped.
    ///
    /// # Errors
    /// [`Error::SiteOutside`], [`Error::OnFloor`]; [`Error::OtherLayer`] for a row above the last one written, or
    /// outside the part; [`Error::Length`], [`Error::Overflow`]; [`Error::TooLarge`] for a row that does not fit in
    /// memory.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::Row;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::Pile;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10_000)?;
    /// let forces = pile.forces::<BigRational>();
    /// let mut layers = forces.layers(Selection::Layer(9998))?.nearest::<f64>()?;
    /// let [mut alpha, mut beta, mut gamma] = [[0.0; 3]; 3];
    /// let row = Row { k: 9998, j: 7, i: 100..103 };
    /// layers.fill_row(&row, [&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!((alpha, beta), ([9892.0, 9891.0, 9890.0], [101.0, 102.0, 103.0]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_row(&mut self, row: &Row, slices: [&mut [O::Value]; 3]) -> Result<(), Error> {
        self.fill_row_of(Quantities::Contacts, row, slices)
    }

    fn fill_row_of(
        &mut self,
        asked: Quantities,
        row: &Row,
        slices: [&mut [O::Value]; 3],
    ) -> Result<(), Error> {
        self.fill_row_with(asked, row, slices, |layers| layers.numbers(asked, row))
    }

    /// Writes a quantity for consecutive spheres. `numbers` returns their numerators, if they are needed.
    fn fill_row_with(
        &mut self,
        asked: Quantities,
        row: &Row,
        slices: [&mut [O::Value]; 3],
        numbers: impl FnOnce(&Self) -> RowNumbers<O>,
    ) -> Result<(), Error> {
        let Row { k, j, i } = row.clone();
        check_lengths(row.length()?, &slices)?;
        if i.is_empty() {
            return Ok(());
        }
        for i in [i.start, i.end - 1] {
            self.check_part(asked, self.shape().check(Site { i, j, k })?)?;
        }
        self.go_down_to(k)?;
        check_interrupt()?;
        if let (Quantities::Contacts, Some(table)) = (asked, &self.table) {
            return table.fill_row(row, slices);
        }
        let known = |(what, at, conversion): &(_, i128, _)| {
            *what == asked && (*at == k || O::is_of_all_layers(conversion))
        };
        if !self.conversions.iter().any(known) {
            self.conversions.retain(|(what, ..)| *what != asked);
            let conversion = O::conversion(self, asked, k)?;
            self.conversions.push((asked, k, conversion));
        }
        let conversion = self.conversions.iter().find(|entry| known(entry));
        let (.., conversion) = conversion.ok_or_else(|| bug("a conversion is in the list"))?;
        self.write_row((asked, conversion), row, slices, || numbers(self))
    }

    /// Writes a quantity for consecutive spheres of a row of the current layer. `numbers` returns their numerators.
    fn write_row(
        &self,
        (asked, conversion): (Quantities, &O::Conversion),
        row: &Row,
        [a, b, c]: [&mut [O::Value]; 3],
        numbers: impl FnOnce() -> RowNumbers<O>,
    ) -> Result<(), Error> {
        let lines = &self.source.lines;
        let out = [&mut *a, &mut *b, &mut *c];
        // Each sphere counts as ordinary. Where that overflows, the force of an unordinary sphere may still not.
        if O::write_ordinary(self, conversion, row, out)? {
            for site in lines.extras_in_row(row) {
                let place = (site.i - row.i.start).to_usize();
                let place = place.filter(|place| *place < a.len());
                let place = place.ok_or_else(|| bug("a slice is as long as its row"))?;
                [a[place], b[place], c[place]] = self.at((asked, conversion), site)?;
            }
            return Ok(());
        }
        let out = a.iter_mut().zip(b).zip(c);
        for (numbers, ((a, b), c)) in numbers().into_iter().zip(out) {
            [*a, *b, *c] = values::<O>(conversion, numbers?)?;
        }
        Ok(())
    }

    /// Returns a quantity of one sphere of the current layer.
    fn at(
        &self,
        (asked, conversion): (Quantities, &O::Conversion),
        Site { i, j, k }: Site,
    ) -> Result<[O::Value; 3], Error> {
        let numbers = self.numbers(asked, &Row { k, j, i: i..i + 1 }).pop();
        values::<O>(
            conversion,
            numbers.ok_or_else(|| bug("a row of one sphere has its numbers"))??,
        )
    }

    /// Returns a quantity of consecutive spheres of a row of the current layer, as numerators.
    fn numbers(&self, asked: Quantities, row: &Row) -> RowNumbers<O> {
        let Source {
            lines,
            engine,
            meter,
        } = &self.source;
        if asked != Quantities::Floor {
            let below = engine.transmitted_in(lines, row, *meter).into_iter();
            return below.map(|below| Ok(below?.forces)).collect();
        }
        let above = engine.received_in(lines, row, *meter);
        let floor = |(site, above): (_, Result<_, _>)| {
            let (force, _) = lines.floor_numerators(site, &above?);
            Ok([force.z, force.x, force.y])
        };
        row.clone().into_iter().zip(above).map(floor).collect()
    }

    /// Returns an error for a sphere without the quantity.
    fn check_part(&self, asked: Quantities, site: Site) -> Result<(), Error> {
        let floor = self.shape().layers() - 1;
        match (asked, site.k == floor) {
            (Quantities::Floor, false) => Err(Error::NotOnFloor { site, floor }),
            (Quantities::Contacts | Quantities::Along(_), true) => Err(Error::OnFloor { site }),
            _ => Ok(()),
        }
    }

    /// Returns the denominator of the forces below the lowest remaining layer above the floor.
    fn lowest_denominator(&self) -> <O::Scalar as Algebra>::Numerator {
        let changes = self.shape().changes_above(self.above_the_floor().end);
        self.source.lines.scale(changes)
    }

    fn above_the_floor(&self) -> Range<i128> {
        let floor = self.shape().layers() - 1;
        self.ahead.start.min(floor)..self.ahead.end.min(floor)
    }

    fn shape(&self) -> &'p Shape {
        self.source.lines.shape
    }
}

/// Three numerators of a sphere.
type Numbers<O> = [<<O as Write>::Scalar as Algebra>::Numerator; 3];

/// The numerators of each sphere of a row.
type RowNumbers<O> = Vec<Result<Numbers<O>, Error>>;

/// Converts the numerators of one sphere.
fn values<O: Output>(
    conversion: &O::Conversion,
    [a, b, c]: Numbers<O>,
) -> Result<[O::Value; 3], Error> {
    Ok([
        O::value(conversion, 0, a)?,
        O::value(conversion, 1, b)?,
        O::value(conversion, 2, c)?,
    ])
}

/// Returns whether a value in a sweep down to layer `last` may overflow the scalar.
///
/// A scalar that holds twice the bound on all values does not overflow. With 24 bits or more, rounding errors exceed
/// this margin only after half a million passes. A layer so far down does not fit in memory.
fn may_overflow<T: Algebra>(lines: &LineForces<'_, T>, last: i128) -> bool {
    let is_fine = matches!(T::EXACTNESS, Exactness::Rounded { bits: 24.. });
    if !is_fine || T::Numerator::ARE_INTEGERS || lines.has_scalar_loads {
        return true;
    }
    let pile = &lines.pile;
    let twice = BigRational::new(pile.bound_of_sweep(last) * 2, pile.denominator());
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

impl<O: Output> fmt::Debug for Layers<'_, O> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Layers")
            .field("ahead", &self.ahead)
            .finish_non_exhaustive()
    }
}
