//! The forces of all contacts, and the forces on the floor.

use num_bigint::BigInt;
use num_rational::BigRational;

use super::places::{check_length, pieces, put_by_direction, put_vectors};
use super::{PileArrays, overflow};
use crate::numbered::{nearest, rounded};
use crate::table::{columns, slices};
use crate::{Each, Error};
use cannonpile::engine::common_multiple;
use cannonpile::engine::copies;
use cannonpile::shape::Selection;
use cannonpile::{Layers, Nearest, Packing};

impl<'p> PileArrays<'p> {
    /// Writes the forces of all contacts, in N for a packing and in f₀ for a pile. A positive force is a push.
    ///
    /// # Errors
    /// [`Error::Length`](cannonpile::Error::Length) for a slice of another length;
    /// [`Error::Overflow`](cannonpile::Error::Overflow) for a force outside the range of `f64`; the errors of
    /// [`Forces::layers`](cannonpile::Forces::layers).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::PileArrays;
    ///
    /// let mut forces = [0.0; 12];
    /// PileArrays::of_pile(&Pile::triangular(3)?)?.fill_forces(&mut forces)?;
    /// assert_eq!(forces[..6], [1.0, 1.0, 1.0, 2.0, 1.0, 1.0]);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn fill_forces(&self, forces: &mut [f64]) -> Result<(), Error> {
        check_length(self.contacts, forces)?;
        let lines = self.directions().len();
        let mut layers = self.layers(Selection::All)?;
        let mut left = forces.iter_mut();
        let mut found: [Vec<f64>; 3] = Default::default();
        while let Some(layer) = layers.next_layer()? {
            if layer.is_floor() {
                break;
            }
            for column in &mut found {
                column.resize(layer.sphere_count(), 0.0);
            }
            layer.fill(slices(&mut found))?;
            put_by_direction(&found[..lines], &mut left);
        }
        let unit = self.packing.as_ref().map(Packing::unit_force);
        for (place, (_, force)) in left.zip(self.pile.horizontal_forces()) {
            let force = unit
                .as_ref()
                .map_or_else(|| force.clone().into(), |unit| unit.scaled(force));
            *place = nearest(&force, "a contact force")?;
        }
        Ok(())
    }

    /// Writes the exact numerators of all contact forces in f₀, and returns their common denominator.
    ///
    /// # Errors
    /// [`Error::Length`](cannonpile::Error::Length) for a slice of another length;
    /// [`Error::Overflow`](cannonpile::Error::Overflow) for a numerator that does not fit in `V`; the errors of
    /// [`Forces::layers`](cannonpile::Forces::layers).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::PileArrays;
    /// use cannonpile::lattice::Region;
    ///
    /// let pile = Pile::under(Region::SITE, "+-".parse()?)?;
    /// let mut numerators = [0_i64; 12];
    /// let denominator = PileArrays::of_pile(&pile)?.fill_multiples(&mut numerators)?;
    /// assert_eq!((numerators[..6].to_vec(), denominator), (vec![3, 3, 3, 2, 5, 5], 3.into()));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn fill_multiples<V>(&self, numerators: &mut [V]) -> Result<BigInt, Error>
    where
        V: TryFrom<BigInt> + Clone + Default + Send + Sync,
    {
        check_length(self.contacts, numerators)?;
        let layers = self.pile.forces::<BigRational>().layers(Selection::All)?;
        let lines = self.directions().len();
        let mut left = numerators.iter_mut();
        if self.pile.horizontal_forces().len() == 0 {
            let layers = layers.numerators::<V>()?;
            let spheres = layers.slice_len()?;
            let mut found = [zeros::<V>(spheres)?, zeros(spheres)?, zeros(spheres)?];
            let denominator = layers.fill(slices(&mut found))?;
            put_by_direction(&found[..lines], &mut left);
            return Ok(denominator);
        }
        let layers = layers.numerators::<BigInt>()?;
        let spheres = layers.slice_len()?;
        let mut found = [zeros(spheres)?, zeros(spheres)?, zeros(spheres)?];
        let sloping = layers.fill(slices(&mut found))?;
        let horizontal = || self.pile.horizontal_forces().map(|(_, force)| force);
        let denominator = horizontal().fold(sloping.clone(), |common, force| {
            common_multiple(common, force.denom())
        });
        let factor = &denominator / sloping;
        let columns = found[..lines].iter().map(|column| {
            let numerators = column.iter().map(|n| fitted(n * &factor));
            numerators.collect::<Result<Vec<V>, Error>>()
        });
        put_by_direction(&columns.collect::<Result<Vec<_>, Error>>()?, &mut left);
        for (place, force) in left.zip(horizontal()) {
            *place = fitted(force.numer() * (&denominator / force.denom()))?;
        }
        Ok(denominator)
    }

    /// Writes the force on the first sphere of each contact, in N, z up.
    ///
    /// # Errors
    /// [`Error::NeedsUnits`] for the arrays of a pile; otherwise as for [`fill_forces`](Self::fill_forces).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::PileArrays;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let mut vectors = [[0.0; 3]; 2];
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// PileArrays::of_packing(&packing)?.fill_vectors(&mut vectors)?;
    /// // Half the weight, and 3/8 to the side.
    /// assert_eq!(vectors, [[0.375, 0.0, 0.5], [-0.375, 0.0, 0.5]]);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn fill_vectors(&self, vectors: &mut [[f64; 3]]) -> Result<(), Error> {
        check_length(self.contacts, vectors)?;
        let mut layers = self
            .packing("contact vectors")?
            .layers::<f64>(Selection::All)?;
        let lines = self.directions().len();
        let mut left = vectors.iter_mut();
        for piece in pieces(self.pile.rows(Selection::All)?.off_the_floor()) {
            let mut found = [columns(&piece)?, columns(&piece)?, columns(&piece)?];
            layers.fill_row_of_vectors(&piece, found.each_mut().each(slices))?;
            // `found` is indexed by axis and then by direction, `by_line` by direction and then by axis.
            let [x, y, z] = found;
            let by_line = x.into_iter().zip(y).zip(z).map(|((x, y), z)| [x, y, z]);
            put_vectors(&by_line.take(lines).collect::<Vec<_>>(), &mut left);
        }
        self.put_horizontal(left, |contact| rounded(&contact.vector, "a contact force"))
    }

    /// Writes the forces of all bottom spheres on the floor: normal, shear along x, shear along y. The unit is N for a
    /// packing. For a pile the units are mg, mg·tanθ and 2cosφ·mg·tanθ.
    ///
    /// # Errors
    /// [`Error::Length`](cannonpile::Error::Length) unless the slice has one entry per bottom sphere; otherwise as for
    /// [`fill_forces`](Self::fill_forces).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::PileArrays;
    ///
    /// let mut base = [[0.0; 3]; 3];
    /// PileArrays::of_pile(&Pile::triangular(2)?)?.fill_base(&mut base)?;
    /// assert_eq!(base.map(|[normal, ..]| normal), [4.0 / 3.0; 3]);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn fill_base(&self, base: &mut [[f64; 3]]) -> Result<(), Error> {
        let mut layers = self.layers(Selection::Base)?;
        let mut left = base.iter_mut();
        while let Some(layer) = layers.next_layer()? {
            check_length(layer.sphere_count(), left.as_slice())?;
            let mut found = [(); 3].each(|()| vec![0.0; layer.sphere_count()]);
            layer.fill_base(slices(&mut found))?;
            put_vectors(&[found], &mut left);
        }
        Ok(())
    }

    fn layers(&self, part: Selection) -> Result<Layers<'p, Nearest<f64>>, Error> {
        match &self.packing {
            Some(packing) => Ok(packing.layers(part)?),
            None => Ok(self.pile.forces::<BigRational>().layers(part)?.nearest()?),
        }
    }
}

/// Returns `count` zeros, or an error if memory is short.
fn zeros<V: Clone + Default>(count: usize) -> Result<Vec<V>, Error> {
    Ok(copies(
        V::default(),
        count,
        "the numerators of all contact forces",
    )?)
}

fn fitted<V: TryFrom<BigInt>>(numerator: BigInt) -> Result<V, Error> {
    V::try_from(numerator).map_err(|_| overflow::<V>("the numerator of a contact force"))
}
