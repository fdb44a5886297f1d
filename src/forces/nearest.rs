//! The forces of whole layers, correctly rounded, in the units of a packing or of the pile.

mod source;

pub(crate) use source::Units;

use alloc::vec::Vec;
use core::fmt;
use core::ops::Deref;

use num_rational::BigRational;
use num_traits::One;

use source::{RowQuantity, RowValues};

use super::layers::{Layer, Layers, check_lengths};
use crate::Error;
use crate::engine::{Table, Unit};
use crate::error::bug;
use crate::lattice::{Row, Site};
use crate::scalar::{CorrectlyRounded, Surd};

/// The layers of a part of a pile, from the top, with forces correctly rounded to the floats `F`.
///
/// Made by [`Layers::nearest`], in pile units, and by [`Packing::layers`](crate::Packing::layers), in SI units.
///
/// # Examples
/// ```
/// use cannonpile::shape::Selection;
/// use cannonpile::{Packing, Pile};
///
/// let pile = Pile::triangular(10)?;
/// let spacing = cannonpile::geometry::Spacing::new(num_rational::BigRational::new(6.into(), 5.into()))?;
/// let packing = Packing::new(&pile, &spacing)?;
/// let mut layers = packing.layers::<f64>(Selection::Layer(0))?;
/// let apex = layers.next_layer()?.expect("layer 0 is asked for");
/// let [mut alpha, mut beta, mut gamma] = [[0.0; 1]; 3];
/// apex.fill([&mut alpha, &mut beta, &mut gamma])?;
/// assert_eq!(alpha, [0.46225016352102425]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub struct NearestLayers<'p, F> {
    layers: Layers<'p, BigRational>,
    units: Units,
    /// The distinct forces of a straight pile.
    table: Option<Table<F>>,
    /// The sources of the last requests, each with its quantity and layer.
    prepared: Vec<(RowQuantity, i128, RowValues<F>)>,
}

/// One layer of a pile and its forces, correctly rounded.
pub struct NearestLayer<'l, 'p, F> {
    layer: Layer<'l, 'p, BigRational>,
    units: &'l Units,
    table: Option<&'l Table<F>>,
}

impl<'p> Layers<'p, BigRational> {
    /// Returns the layers with correctly rounded forces, in pile units.
    ///
    /// # Errors
    /// [`Error::Overflow`] for a force beyond the range of the floats.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-".parse()?)?;
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::Base)?.nearest::<f64>()?;
    /// let floor = layers.next_layer()?.expect("every pile has a floor");
    /// let [mut normal, mut shear_x, mut shear_y] = [[0.0; 7]; 3];
    /// floor.fill_base([&mut normal, &mut shear_x, &mut shear_y])?;
    /// assert_eq!(normal[0], 14.0 / 9.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn nearest<F: CorrectlyRounded>(self) -> Result<NearestLayers<'p, F>, Error> {
        let one = || Surd::from(BigRational::one());
        let units = Units {
            contact: one(),
            vector: [one(), one(), one()],
            floor: [one(), one(), one()],
        };
        self.nearest_in(units)
    }

    /// Returns the layers with the forces times `units`, correctly rounded.
    pub(crate) fn nearest_in<F: CorrectlyRounded>(
        self,
        units: Units,
    ) -> Result<NearestLayers<'p, F>, Error> {
        // The floor has no contacts below it.
        let table = if self.above_the_floor().is_empty() {
            None
        } else {
            match self.source(&units, RowQuantity::Contacts, 0)? {
                RowValues::Table(table) => Some(table),
                RowValues::Lines { .. } | RowValues::Counts { .. } => None,
            }
        };
        Ok(NearestLayers {
            layers: self,
            units,
            table,
            prepared: Vec::new(),
        })
    }
}

impl<'p, F: CorrectlyRounded> NearestLayers<'p, F> {
    /// Advances to the next layer of the part and returns it, or `None` after the last layer.
    ///
    /// # Errors
    /// As for [`Layers::next_layer`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::All)?.nearest::<f32>()?;
    /// let mut spheres = 0;
    /// while let Some(layer) = layers.next_layer()? {
    ///     spheres += layer.sphere_count();
    /// }
    /// assert_eq!(spheres, 20);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn next_layer(&mut self) -> Result<Option<NearestLayer<'_, 'p, F>>, Error> {
        let layer = self.layers.next_layer()?;
        Ok(layer.map(|layer| NearestLayer {
            layer,
            units: &self.units,
            table: self.table.as_ref(),
        }))
    }

    /// Returns the number of spheres in the remaining layers above the floor, which is the length of each slice of
    /// [`fill`](Self::fill).
    ///
    /// # Errors
    /// As for [`Layers::slice_len`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let layers = pile.forces::<BigRational>().layers(Selection::All)?.nearest::<f32>()?;
    /// assert_eq!(layers.slice_len()?, 220 - 55);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn slice_len(&self) -> Result<usize, Error> {
        self.layers.slice_len()
    }

    /// Writes the contact forces of all remaining layers into slices, one slice for each direction, layer after layer.
    /// With the feature `rayon` the work runs on all cores.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(3)?;
    /// let layers = pile.forces::<BigRational>().layers(Selection::All)?.nearest::<f32>()?;
    /// let [mut alpha, mut beta, mut gamma] = [[0.0; 4]; 3];
    /// layers.fill([&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!(alpha, [1.0, 2.0, 1.0, 1.0]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill(mut self, slices: [&mut [F]; 3]) -> Result<(), Error> {
        if let Some(table) = &self.table {
            return self.layers.fill_from_table(table, slices);
        }
        let units = &self.units;
        self.layers.fill_each(slices, |layer, slices| {
            layer.fill_nearest(units, RowQuantity::Contacts, slices)
        })
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
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Row;
    /// use cannonpile::shape::Selection;
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
    pub fn fill_row(&mut self, row: &Row, slices: [&mut [F]; 3]) -> Result<(), Error> {
        self.write(RowQuantity::Contacts, row, slices)
    }

    /// Returns whether every nonzero contact force is certain to be rounded to a normal float, with full precision.
    ///
    /// Each force is an integer multiple of the unit over a denominator. The function checks one such multiple, the
    /// smallest possible force. So the result may be `false` although every actual force is larger.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// assert!(packing.layers::<f64>(Selection::All)?.keeps_digits());
    /// let light = packing.with_mass("1e-310".parse::<cannonpile::scalar::Surd>()?.coefficient().clone())?;
    /// assert!(!light.layers::<f64>(Selection::All)?.keeps_digits());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn keeps_digits(&self) -> bool {
        let denominator = self.layers.lowest_denominator();
        let least = Unit::new(self.units.contact.clone(), denominator);
        let normal = F::MIN_EXPONENT + i64::from(F::PRECISION) - 1;
        least.exceeds_power_of_two(normal)
    }

    /// Writes the contact forces on consecutive spheres from their supports, as vectors, into slices: one for each
    /// component x, y, z and each direction. Pile units are those of [`contact_vector`](crate::Forces::contact_vector).
    ///
    /// # Errors
    /// As for [`fill_row`](Self::fill_row).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Row;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let layers = pile.forces::<BigRational>().layers(Selection::All)?;
    /// let mut vectors = [[[0.0]; 3]; 3];
    /// let slices = vectors.each_mut().map(|of| of.each_mut().map(|slice| slice.as_mut_slice()));
    /// layers.nearest::<f64>()?.fill_row_of_vectors(&Row { k: 1, j: 0, i: 1..2 }, slices)?;
    /// // The force f·ê of the contact along β.
    /// assert_eq!(vectors.map(|component| component[1][0]), [1.0, -1.0, -2.0]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_row_of_vectors(
        &mut self,
        row: &Row,
        slices: [[&mut [F]; 3]; 3],
    ) -> Result<(), Error> {
        for (axis, slices) in slices.into_iter().enumerate() {
            self.write(RowQuantity::Along(axis), row, slices)?;
        }
        Ok(())
    }

    /// Writes the forces of consecutive bottom spheres on the floor into slices: normal, shear along x, shear along y.
    ///
    /// # Errors
    /// [`Error::NotOnFloor`]; otherwise as for [`fill_row`](Self::fill_row).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Row;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let layers = pile.forces::<BigRational>().layers(Selection::Base)?;
    /// let [mut normal, mut shear_x, mut shear_y] = [[0.0; 2]; 3];
    /// let slices = [normal.as_mut_slice(), &mut shear_x, &mut shear_y];
    /// layers.nearest::<f64>()?.fill_row_of_base(&Row { k: 9, j: 3, i: 2..4 }, slices)?;
    /// assert_eq!((normal, shear_x, shear_y), ([4.0; 2], [0.0; 2], [-1.0 / 3.0, 0.0]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_row_of_base(&mut self, row: &Row, slices: [&mut [F]; 3]) -> Result<(), Error> {
        self.write(RowQuantity::Floor, row, slices)
    }

    fn write(&mut self, asked: RowQuantity, row: &Row, slices: [&mut [F]; 3]) -> Result<(), Error> {
        let (shape, Row { k, j, i }) = (self.layers.shape(), row.clone());
        check_lengths(row.length()?, &slices)?;
        if i.is_empty() {
            return Ok(());
        }
        for i in [i.start, i.end - 1] {
            let site = shape.check(Site { i, j, k })?;
            let floor = shape.layers() - 1;
            match asked {
                RowQuantity::Floor if k < floor => return Err(Error::NotOnFloor { site, floor }),
                RowQuantity::Contacts | RowQuantity::Along(_) if k == floor => {
                    return Err(Error::OnFloor { site });
                }
                _ => {}
            }
        }
        self.layers.go_down_to(k)?;
        if let (RowQuantity::Contacts, Some(table)) = (asked, &self.table) {
            return table.fill_row(row, slices);
        }
        let known = |(what, at, source): &(RowQuantity, i128, RowValues<F>)| {
            *what == asked && (*at == k || !matches!(source, RowValues::Lines { .. }))
        };
        if !self.prepared.iter().any(known) {
            self.prepared.retain(|(what, ..)| *what != asked);
            let source = self.layers.source(&self.units, asked, k)?;
            self.prepared.push((asked, k, source));
        }
        let source = self.prepared.iter().find(|prepared| known(prepared));
        let (.., source) = source.ok_or_else(|| bug("a prepared source is in the list"))?;
        self.layers.write_row((asked, source), row, slices)
    }
}

impl<F: CorrectlyRounded> NearestLayer<'_, '_, F> {
    /// Writes the forces below the layer into slices, one slice for each direction, row after row. Each value is
    /// correctly rounded. The forces along γ are zero for discs.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::OnFloor`]; [`Error::Overflow`] for a force beyond the range of the floats.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::Layer(1))?.nearest::<f64>()?;
    /// let layer = layers.next_layer()?.expect("layer 1 is asked for");
    /// let [mut alpha, mut beta, mut gamma] = [[0.0; 3]; 3];
    /// layer.fill([&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!(alpha[0], 2.0 / 3.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill(&self, slices: [&mut [F]; 3]) -> Result<(), Error> {
        if let Some(table) = self.table {
            return self.layer.fill_from_table(table, slices);
        }
        self.layer.check_above_the_floor()?;
        self.layer
            .fill_nearest(self.units, RowQuantity::Contacts, slices)
    }

    /// Writes the forces of the bottom layer on the floor into slices, row after row: normal, shear along x and shear
    /// along y. Each value is correctly rounded.
    ///
    /// # Errors
    /// [`Error::Length`]; [`Error::NotOnFloor`] for another layer; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::Base)?.nearest::<f64>()?;
    /// let floor = layers.next_layer()?.expect("every pile has a floor");
    /// let [mut normal, mut shear_x, mut shear_y] = [[0.0; 55]; 3];
    /// floor.fill_base([&mut normal, &mut shear_x, &mut shear_y])?;
    /// assert_eq!((normal, shear_x[0], shear_y[0]), ([4.0; 55], -1.5, -1.5));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_base(&self, slices: [&mut [F]; 3]) -> Result<(), Error> {
        self.layer.check_on_the_floor()?;
        self.layer
            .fill_nearest(self.units, RowQuantity::Floor, slices)
    }
}

impl<'l, 'p, F> Deref for NearestLayer<'l, 'p, F> {
    type Target = Layer<'l, 'p, BigRational>;

    fn deref(&self) -> &Self::Target {
        &self.layer
    }
}

impl<F> fmt::Debug for NearestLayers<'_, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.layers.fmt(f)
    }
}

impl<F> fmt::Debug for NearestLayer<'_, '_, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.layer.fmt(f)
    }
}
