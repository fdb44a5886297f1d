//! The forces of whole layers as exact integers over one denominator.

use core::any::type_name;
use core::fmt;
use core::ops::Deref;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::layers::{Layer, Layers};
use crate::Error;
use crate::engine::Table;

/// The layers of a part of a pile, from the top, with forces as integers `V` over one denominator for each layer.
///
/// Made by [`Layers::numerators`]. The denominator below d sign changes is D·3^d, where D is the common denominator of
/// increments, weights and loads. D is 1 for an equilateral base without loads.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Region;
/// use cannonpile::shape::Selection;
/// use num_rational::BigRational;
///
/// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
/// let layers = pile.forces::<BigRational>().layers(Selection::Layer(1))?;
/// let mut layers = layers.numerators::<i64>()?;
/// let layer = layers.next_layer()?.expect("layer 1 is asked for");
/// let [mut alpha, mut beta, mut gamma] = [[0; 3]; 3];
/// layer.fill([&mut alpha, &mut beta, &mut gamma])?;
/// assert_eq!((alpha[0], layer.denominator()), (2, 3.into()));
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub struct NumeratorLayers<'p, V> {
    layers: Layers<'p, BigRational>,
    /// The distinct numerators of a straight pile.
    table: Option<Table<V>>,
}

/// One layer of a pile and the numerators of its forces.
pub struct NumeratorLayer<'l, 'p, V> {
    layer: Layer<'l, 'p, BigRational>,
    table: Option<&'l Table<V>>,
}

impl<'p> Layers<'p, BigRational> {
    /// Returns the layers with forces as exact integers over one denominator for each layer.
    ///
    /// # Errors
    /// [`Error::Overflow`] for a numerator beyond the range of `V`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Error, Pile};
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let small = Pile::triangular(128)?;
    /// assert!(small.forces::<BigRational>().layers(Selection::All)?.numerators::<i8>().is_ok());
    /// // A contact of 128 f₀ does not fit in an i8.
    /// let large = Pile::triangular(129)?;
    /// let refused = large.forces::<BigRational>().layers(Selection::All)?.numerators::<i8>();
    /// assert!(matches!(refused, Err(Error::Overflow { .. })));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn numerators<V: TryFrom<BigInt>>(self) -> Result<NumeratorLayers<'p, V>, Error> {
        let scale = self.denominator(0);
        // The product is an integer, because the scale is a multiple of all denominators.
        let whole = |multiple: &BigRational| numerator((multiple * &scale).to_integer());
        Ok(NumeratorLayers {
            table: self
                .table
                .as_ref()
                .map(|table| table.map(whole))
                .transpose()?,
            layers: self,
        })
    }
}

impl<'p, V: TryFrom<BigInt> + Clone + Send + Sync> NumeratorLayers<'p, V> {
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
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::All)?.numerators::<i64>()?;
    /// let mut layer_count = 0;
    /// while let Some(_) = layers.next_layer()? {
    ///     layer_count += 1;
    /// }
    /// assert_eq!(layer_count, 4);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn next_layer(&mut self) -> Result<Option<NumeratorLayer<'_, 'p, V>>, Error> {
        let layer = self.layers.next_layer()?;
        Ok(layer.map(|layer| NumeratorLayer {
            layer,
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
    /// let layers = pile.forces::<BigRational>().layers(Selection::All)?.numerators::<i64>()?;
    /// assert_eq!(layers.slice_len()?, 220 - 55);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn slice_len(&self) -> Result<usize, Error> {
        self.layers.slice_len()
    }

    /// Writes the numerators of the contact forces of all remaining layers into slices, one slice for each direction,
    /// layer after layer. Returns their common denominator, which is that of the lowest layer.
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
    /// let layers = pile.forces::<BigRational>().layers(Selection::All)?.numerators::<i32>()?;
    /// let [mut alpha, mut beta, mut gamma] = [[0; 4]; 3];
    /// assert_eq!(layers.fill([&mut alpha, &mut beta, &mut gamma])?, 1.into());
    /// assert_eq!((alpha, beta, gamma), ([1, 2, 1, 1], [1, 1, 2, 1], [1, 1, 1, 2]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill(mut self, slices: [&mut [V]; 3]) -> Result<BigInt, Error> {
        let lowest = self.layers.lowest_denominator();
        match &self.table {
            Some(table) => self.layers.fill_from_table(table, slices)?,
            None => self
                .layers
                .fill_each(slices, |layer, slices| fill_over(layer, &lowest, slices))?,
        }
        Ok(lowest)
    }
}

impl<V: TryFrom<BigInt> + Clone + Send + Sync> NumeratorLayer<'_, '_, V> {
    /// Returns the denominator of the forces below the layer, in f₀.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    /// let layers = pile.forces::<BigRational>().layers(Selection::Layer(2))?;
    /// let mut layers = layers.numerators::<i64>()?;
    /// assert_eq!(layers.next_layer()?.map(|layer| layer.denominator()), Some(9.into()));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn denominator(&self) -> BigInt {
        self.layer.denominator()
    }

    /// Writes the numerators of the forces below the layer into slices, one slice for each direction, row after row.
    /// The numerators along γ are zero for discs.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::OnFloor`]; [`Error::Overflow`] for a numerator beyond the range of `V`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::Layer(2))?.numerators::<i32>()?;
    /// let layer = layers.next_layer()?.expect("layer 2 is asked for");
    /// let [mut alpha, mut beta, mut gamma] = [[0; 6]; 3];
    /// layer.fill([&mut alpha, &mut beta, &mut gamma])?;
    /// assert_eq!(alpha, [3, 2, 1, 2, 1, 1]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill(&self, slices: [&mut [V]; 3]) -> Result<(), Error> {
        if let Some(table) = self.table {
            return self.layer.fill_from_table(table, slices);
        }
        fill_over(&self.layer, &self.denominator(), slices)
    }
}

impl<'l, 'p, V> Deref for NumeratorLayer<'l, 'p, V> {
    type Target = Layer<'l, 'p, BigRational>;

    fn deref(&self) -> &Self::Target {
        &self.layer
    }
}

/// Writes the numerators over `denominator`, a multiple of the denominator of the layer.
fn fill_over<V: TryFrom<BigInt>>(
    layer: &Layer<'_, '_, BigRational>,
    denominator: &BigInt,
    slices: [&mut [V]; 3],
) -> Result<(), Error> {
    let factor = denominator / layer.denominator();
    layer.fill_numerators(slices, |[a, b, c]| {
        Ok([
            numerator(a * &factor)?,
            numerator(b * &factor)?,
            numerator(c * &factor)?,
        ])
    })
}

fn numerator<V: TryFrom<BigInt>>(numerator: BigInt) -> Result<V, Error> {
    V::try_from(numerator)
        .map_err(|_| Error::overflow("the numerator of a contact force", type_name::<V>()))
}

impl<V> fmt::Debug for NumeratorLayers<'_, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.layers.fmt(f)
    }
}

impl<V> fmt::Debug for NumeratorLayer<'_, '_, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.layer.fmt(f)
    }
}
