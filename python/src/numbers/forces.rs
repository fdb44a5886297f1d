//! The forces of all contacts, and the forces on the floor.

use num_bigint::BigInt;
use num_rational::BigRational;

use cannonpile::engine::{common_multiple, copies};
use cannonpile::shape::Selection;
use cannonpile::{Layers, Nearest, Packing};
use cannonpile_dem::numbered::{nearest, rounded};

use super::Numbers;
use super::places::{columns, pieces, put_by_direction, put_vectors, slices};
use crate::error::Error;

impl<'p> Numbers<'p> {
    /// Writes the forces of all contacts, in N for a packing and in f₀ for a pile. A positive force is a push.
    pub(crate) fn fill_forces(&self, forces: &mut [f64]) -> Result<(), Error> {
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
    pub(crate) fn fill_multiples<V>(&self, numerators: &mut [V]) -> Result<BigInt, Error>
    where
        V: TryFrom<BigInt> + Clone + Default + Send + Sync,
    {
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
    pub(crate) fn fill_vectors(&self, vectors: &mut [[f64; 3]]) -> Result<(), Error> {
        let mut layers = self.in_si()?.layers::<f64>(Selection::All)?;
        let lines = self.directions().len();
        let mut left = vectors.iter_mut();
        for piece in pieces(self.pile.rows(Selection::All)?.off_the_floor()) {
            let spheres = piece.length()?;
            let mut found = [(); 3].map(|()| columns(spheres));
            layers.fill_row_of_vectors(&piece, found.each_mut().map(slices))?;
            // `found` is indexed by axis and then by direction, `by_line` by direction and then by axis.
            let [x, y, z] = found;
            let by_line = x.into_iter().zip(y).zip(z).map(|((x, y), z)| [x, y, z]);
            put_vectors(&by_line.take(lines).collect::<Vec<_>>(), &mut left);
        }
        self.put_horizontal(left, |contact| {
            Ok(rounded(&contact.vector, "a contact force")?)
        })
    }

    /// Writes the forces of all bottom spheres on the floor: normal, shear along x, shear along y. The unit is N for a
    /// packing. For a pile the units are mg, mg·tanθ and 2cosφ·mg·tanθ.
    pub(crate) fn fill_base(&self, base: &mut [[f64; 3]]) -> Result<(), Error> {
        let mut layers = self.layers(Selection::Base)?;
        let mut left = base.iter_mut();
        while let Some(layer) = layers.next_layer()? {
            let mut found = columns(layer.sphere_count());
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
    let fitted = V::try_from(numerator);
    fitted.map_err(|_| {
        let scalar = core::any::type_name::<V>();
        cannonpile::Error::overflow("the numerator of a contact force", scalar).into()
    })
}
