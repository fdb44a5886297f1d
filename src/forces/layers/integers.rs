//! Forces as exact integers over one denominator.

use core::any::type_name;
use core::marker::PhantomData;

use num_bigint::BigInt;
use num_rational::BigRational;

use super::{Layer, Layers, Quantities, Write};
use crate::Error;

/// The [`Output`](super::Output) of layers that write forces as integers `V` over one denominator for each layer.
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
///
/// // All layers at once have the denominator of the lowest one.
/// let layers = pile.forces::<BigRational>().layers(Selection::All)?.numerators::<i32>()?;
/// let mut forces = [(); 3].map(|()| vec![0; layers.slice_len().unwrap()]);
/// let [alpha, beta, gamma] = &mut forces;
/// assert_eq!((layers.fill([alpha, beta, gamma])?, forces[0][0]), (9.into(), 9));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Debug)]
pub struct Integers<V>(PhantomData<V>);

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
    pub fn numerators<V>(self) -> Result<Layers<'p, Integers<V>>, Error>
    where
        V: TryFrom<BigInt> + Clone + Send + Sync,
    {
        self.into_output(None)
    }
}

impl<V: TryFrom<BigInt> + Clone + Send + Sync> Layer<'_, '_, Integers<V>> {
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
        let changes = self.shape().changes_above(self.k + 1);
        self.layers.source.lines.scale(changes)
    }
}

impl<V: TryFrom<BigInt> + Clone + Send + Sync> Write for Integers<V> {
    type Scalar = BigRational;
    type Value = V;
    /// The denominator of all layers together.
    type Unit = Option<BigInt>;
    type Whole = BigInt;
    /// The factor from the denominator of the layer to that of all layers.
    type Conversion = BigInt;

    fn begin_whole(layers: &mut Layers<'_, Self>) -> BigInt {
        let lowest = layers.lowest_denominator();
        layers.unit = Some(lowest.clone());
        lowest
    }

    fn conversion(layers: &Layers<'_, Self>, _: Quantities, k: i128) -> Result<BigInt, Error> {
        let changes = layers.shape().changes_above(k + 1);
        Ok(match &layers.unit {
            Some(lowest) => lowest / layers.source.lines.scale(changes),
            None => 1.into(),
        })
    }

    fn value(factor: &BigInt, _: usize, numerator: BigInt) -> Result<V, Error> {
        let overflow = |_| Error::overflow("the numerator of a contact force", type_name::<V>());
        V::try_from(numerator * factor).map_err(overflow)
    }
}
