//! The forces of whole layers as the nearest floats, in the units of a packing or of the pile.

use core::fmt;

use num_rational::BigRational;
use num_traits::{One, ToPrimitive};

use super::FloorForce;
use super::layers::{Layer, Layers, check_lengths, split_front};
use super::terms::Terms;
use crate::Error;
use crate::engine::{Descent, Meter, Planes, Readout, Table, Unit};
use crate::error::bug;
use crate::formula::tripled_half_turn;
use crate::lattice::Site;
use crate::scalar::{NearestFloat, Surd};

/// The units of forces in layers: what an exact multiple is multiplied by before it is rounded, once.
#[derive(Clone, Debug)]
pub(crate) struct Units {
    pub(crate) contact: Surd,
    /// Of shear along x, shear along y, and the normal force.
    pub(crate) floor: [Surd; 3],
}

/// A way down through the layers of a part of a pile, in the floats `F` nearest to the exact forces.
///
/// Made by [`Layers::nearest`], in pile units, and by [`Packing::layers`](crate::Packing::layers), in SI.
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
pub struct NearestLayers<'p, F, M = ()> {
    layers: Layers<'p, BigRational, M>,
    units: Units,
    /// The distinct forces of a straight pile.
    table: Option<Table<F>>,
}

/// One layer of a pile, with its forces at hand as nearest floats.
pub struct NearestLayer<'l, 'p, F, M = ()> {
    layer: Layer<'l, 'p, BigRational, M>,
    units: &'l Units,
    table: Option<&'l Table<F>>,
}

impl<'p, M: Meter> Layers<'p, BigRational, M> {
    /// Returns the layers in the floats nearest to the exact forces, in pile units.
    ///
    /// # Errors
    /// [`Error::Overflow`] for a force beyond the floats.
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
    pub fn nearest<F: NearestFloat>(self) -> Result<NearestLayers<'p, F, M>, Error> {
        let one = || Surd::from(BigRational::one());
        let units = Units {
            contact: one(),
            floor: [one(), one(), one()],
        };
        self.nearest_in(units)
    }

    /// Returns the layers in the floats nearest to the exact forces times units.
    pub(crate) fn nearest_in<F: NearestFloat>(
        self,
        units: Units,
    ) -> Result<NearestLayers<'p, F, M>, Error> {
        let round = |multiple: &BigRational| nearest("a contact force", &units.contact, multiple);
        Ok(NearestLayers {
            table: self.table().map(|table| table.map(round)).transpose()?,
            layers: self,
            units,
        })
    }
}

impl<'p, F: NearestFloat, M: Meter> NearestLayers<'p, F, M> {
    /// Goes down to the next layer of the part and returns it, or `None` below the last one.
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
    ///     spheres += layer.spheres();
    /// }
    /// assert_eq!(spheres, 20);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn next_layer(&mut self) -> Result<Option<NearestLayer<'_, 'p, F, M>>, Error> {
        let layer = self.layers.next_layer()?;
        Ok(layer.map(|layer| NearestLayer {
            layer,
            units: &self.units,
            table: self.table.as_ref(),
        }))
    }

    /// Returns how many spheres of the layers still to come rest on others: the length of each slice of
    /// [`fill`](Self::fill).
    ///
    /// # Errors
    /// As for [`Layers::spheres`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let layers = pile.forces::<BigRational>().layers(Selection::All)?.nearest::<f32>()?;
    /// assert_eq!(layers.spheres()?, 220 - 55);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn spheres(&self) -> Result<usize, Error> {
        self.layers.spheres()
    }

    /// Writes the contact forces of all layers still to come into slices, one for each direction, layer after layer; on
    /// all cores with the feature `rayon`.
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
        check_lengths(self.spheres()?, &slices)?;
        let mut rest = slices;
        while let Some(layer) = self.next_layer()? {
            if layer.is_floor() {
                break;
            }
            let front = split_front(&mut rest, layer.spheres())?;
            layer.fill(front)?;
        }
        Ok(())
    }
}

impl<F: NearestFloat, M: Meter> NearestLayer<'_, '_, F, M> {
    /// Returns the number of the layer, counted from 0 at the top.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::Base)?.nearest::<f64>()?;
    /// assert_eq!(layers.next_layer()?.map(|layer| layer.k()), Some(3));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn k(&self) -> i128 {
        self.layer.k()
    }

    /// Returns the number of spheres of the layer: the length of each slice to fill.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::Base)?.nearest::<f64>()?;
    /// assert_eq!(layers.next_layer()?.map(|layer| layer.spheres()), Some(10));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn spheres(&self) -> usize {
        self.layer.spheres()
    }

    /// Whether the layer is the one on the floor, which has no contacts below it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::Base)?.nearest::<f64>()?;
    /// assert_eq!(layers.next_layer()?.map(|layer| layer.is_floor()), Some(true));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn is_floor(&self) -> bool {
        self.layer.is_floor()
    }

    /// Writes the forces below the layer into slices, one for each direction, row after row, each the float nearest to the
    /// exact force; zero along γ for discs.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::OnFloor`]; [`Error::Overflow`] for a force beyond the floats.
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
        if let Some((terms, sweep)) = self.layer.exact_sweep() {
            let readout = self.contacts_from_limbs(terms, sweep.turned_already());
            return self.fill_from_limbs((terms, sweep), &readout, slices, |site| {
                let forces = self.layer.to_below(site)?;
                self.contacts(&forces)
            });
        }
        self.layer
            .fill_with(slices, |forces| self.contacts(&forces))
    }

    fn contacts(&self, forces: &[BigRational; 3]) -> Result<[F; 3], Error> {
        let round = |force| nearest("a contact force", &self.units.contact, force);
        let [a, b, c] = forces;
        Ok([round(a)?, round(b)?, round(c)?])
    }

    /// Writes the forces of the bottom layer on the floor into slices, row after row: normal, shear along x and shear
    /// along y, each the float nearest to the exact one.
    ///
    /// # Errors
    /// [`Error::Length`]; [`Error::NotOnFloor`] for a layer above it; [`Error::Overflow`].
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
        if self.is_floor()
            && let Some((terms, sweep)) = self.layer.exact_sweep()
            && let Some(readout) = terms.floor_from_limbs(&self.units.floor)
        {
            return self.fill_from_limbs((terms, sweep), &readout, slices, |site| {
                let force = self.layer.on_floor(site)?;
                self.on_floor(&force)
            });
        }
        self.layer
            .fill_base_with(slices, |force| self.on_floor(&force))
    }

    fn on_floor(&self, force: &FloorForce<BigRational>) -> Result<[F; 3], Error> {
        let [unit_x, unit_y, unit_normal] = &self.units.floor;
        let round = |unit, multiple| nearest("a force on the floor", unit, multiple);
        Ok([
            round(unit_normal, &force.normal)?,
            round(unit_x, &force.shear_x)?,
            round(unit_y, &force.shear_y)?,
        ])
    }

    /// Returns what the forces below an ordinary sphere are made of, where the lines are turned across so many changes of
    /// sign already.
    fn contacts_from_limbs(&self, terms: &Terms<'_, BigRational>, turned: usize) -> Readout {
        let changes = terms.system.shape.changes_above(self.k() + 1);
        let lines = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
        let unit = Unit::new(self.units.contact.clone(), terms.lines.scale(changes));
        Readout {
            // 3G is symmetric: its columns are its rows.
            combination: if turned < changes {
                lines.each_ref().map(tripled_half_turn)
            } else {
                lines
            },
            own: terms.lines.increments_after(changes),
            units: [unit.clone(), unit.clone(), unit],
        }
    }

    /// Writes what a readout makes of the limbs of a sweep, and what spheres with extra weights and loads have instead.
    fn fill_from_limbs(
        &self,
        (terms, sweep): (&Terms<'_, BigRational>, &Descent<'_, BigRational, Planes>),
        readout: &Readout,
        slices: [&mut [F]; 3],
        extra: impl Fn(Site) -> Result<[F; 3], Error>,
    ) -> Result<(), Error> {
        check_lengths(self.spheres(), &slices)?;
        let [a, b, c] = slices;
        let mut rest = [&mut *a, &mut *b, &mut *c];
        let mut defined = true;
        for row in self.layer.region.rows(self.k()) {
            let spheres = (row.i.end - row.i.start).to_usize();
            let spheres = spheres.ok_or_else(|| bug("a row of a sweep fits in memory"))?;
            let front = split_front(&mut rest, spheres)?;
            defined &= sweep.nearest_row(&row, readout, front)?;
        }
        if !defined {
            return Err(Error::Overflow {
                quantity: "a force",
                scalar: core::any::type_name::<F>(),
            });
        }
        for site in terms.lines.extras_in(self.k()..self.k() + 1) {
            let values = extra(site)?;
            self.layer
                .put_at(site, values, [&mut *a, &mut *b, &mut *c])?;
        }
        Ok(())
    }
}

/// Returns the float nearest to a multiple of a unit.
fn nearest<F: NearestFloat>(
    quantity: &'static str,
    unit: &Surd,
    multiple: &BigRational,
) -> Result<F, Error> {
    unit.scaled(multiple).nearest().ok_or(Error::Overflow {
        quantity,
        scalar: core::any::type_name::<F>(),
    })
}

impl<F, M> fmt::Debug for NearestLayers<'_, F, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.layers.fmt(f)
    }
}

impl<F, M> fmt::Debug for NearestLayer<'_, '_, F, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.layer.fmt(f)
    }
}
