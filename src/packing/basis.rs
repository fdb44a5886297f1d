//! SI units in a scalar of the caller, for geometry that carries a derivative or a symbol.

use crate::forces::FloorForce;
use crate::geometry::Vector;
use crate::lattice::{Direction, Site};
use crate::scalar::{Field, Ring};
use crate::{Error, Forces};

/// The geometry and the weight of a packing in a scalar. It converts [`Forces`] and positions to SI units.
///
/// A [`Packing`](crate::Packing) is exact for a rational (a/R)². A `SiBasis` takes sinθ and cosθ as they are, so these
/// may be dual numbers, whose derivatives then pass through every result.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Direction, Site};
/// use cannonpile::{Packing, Pile, SiBasis, ratio};
///
/// let pile = Pile::triangular(10)?;
/// let packing = Packing::new(&pile, &"6/5".parse()?)?;
/// // sin²θ = (a/R)²/3 on an equilateral base.
/// let sin2: f64 = 1.2 * 1.2 / 3.0;
/// let basis = SiBasis {
///     sin: sin2.sqrt(),
///     cos: (1.0 - sin2).sqrt(),
///     twice_cos_phi: 3.0_f64.sqrt(),
///     weight: 1.0,
///     radius: 1.0,
/// };
/// let force = basis.contact(&pile.forces(), Site::APEX, Direction::Alpha)?;
/// let exact = packing.contact(Site::APEX, Direction::Alpha)?;
/// assert!((force - exact.nearest::<f64>().unwrap()).abs() < 1e-15);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct SiBasis<T> {
    /// sinθ.
    pub sin: T,
    /// cosθ.
    pub cos: T,
    /// 2cosφ, which is √3 on an equilateral base.
    pub twice_cos_phi: T,
    /// The weight mg of a sphere, in newtons.
    pub weight: T,
    /// The radius R of a sphere, in metres.
    pub radius: T,
}

exact_surd::equality!(SiBasis<T>, T: Ring; |Self { sin, cos, twice_cos_phi, weight, radius }|
    [sin, cos, twice_cos_phi, weight, radius].map(Ring::comparison_key));

impl<T: Field> SiBasis<T> {
    /// Returns the force of a contact, f·mg/(W cosθ), in newtons.
    ///
    /// # Errors
    /// As for [`Forces::contact`]; [`Error::Overflow`] also for cosθ = 0.
    pub fn contact(
        &self,
        forces: &Forces<'_, T>,
        site: Site,
        direction: Direction,
    ) -> Result<T, Error> {
        let force = forces.contact(site, direction)? * &self.weight;
        over(&force, &(forces.increment_sum()? * &self.cos))
    }

    /// Returns the force of a contact on the upper sphere, (x, y, z) in newtons. The z axis points up.
    ///
    /// # Errors
    /// As for [`contact`](Self::contact).
    pub fn contact_vector(
        &self,
        forces: &Forces<'_, T>,
        site: Site,
        direction: Direction,
    ) -> Result<[T; 3], Error> {
        let along = forces.contact_direction(site, direction)?;
        let force = forces.contact(site, direction)? * &self.weight;
        let unit = over(&force, &forces.increment_sum()?)?;
        self.on_forces(along, &unit)
    }

    /// Returns the force of a bottom sphere on the floor, in newtons.
    ///
    /// # Errors
    /// As for [`Forces::on_floor`]; [`Error::Overflow`] also for cosθ = 0.
    pub fn on_floor(&self, forces: &Forces<'_, T>, site: Site) -> Result<FloorForce<T>, Error> {
        let FloorForce {
            site,
            normal,
            shear_x,
            shear_y,
        } = forces.on_floor(site)?;
        let force = Vector {
            x: shear_x,
            y: shear_y,
            z: -normal,
        };
        let [shear_x, shear_y, normal] = self.on_forces(force, &self.weight)?;
        Ok(FloorForce {
            site,
            normal,
            shear_x,
            shear_y,
        })
    }

    /// Returns the position of the centre of a sphere, (x, y, z) in metres, in the frame of
    /// [`Packing::position`](crate::Packing::position).
    ///
    /// # Errors
    /// As for [`Forces::position`].
    pub fn position(&self, forces: &Forces<'_, T>, site: Site) -> Result<[T; 3], Error> {
        let Vector { x, y, z } = forces.position(site)?;
        let height = T::from_integer(forces.pile().layers() - 1) - &z;
        let diameter = self.radius.clone() + &self.radius;
        let along = diameter.clone() * &self.sin;
        Ok([
            x * &along,
            y * &along * &self.twice_cos_phi,
            height * &(diameter * &self.cos),
        ])
    }

    /// Returns a force with its components along (tanθ, 2cosφ·tanθ, 1) and upwards, times `unit`. The z axis of the
    /// symbolic basis points down.
    fn on_forces(&self, force: Vector<T>, unit: &T) -> Result<[T; 3], Error> {
        let along = over(&self.sin, &self.cos)? * unit;
        let Vector { x, y, z } = force;
        Ok([x * &along, y * &along * &self.twice_cos_phi, -(z * unit)])
    }
}

/// Returns n/d.
fn over<T: Field>(n: &T, d: &T) -> Result<T, Error> {
    let quotient = n.checked_div(d).filter(T::is_defined);
    quotient.ok_or(Error::overflow("a quotient by cos θ", T::NAME))
}
