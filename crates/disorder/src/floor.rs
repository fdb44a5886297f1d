//! The force on the floor below a bottom sphere, as a linear function of the forces on the sphere.

use core::num::NonZeroI64;

use cannonpile::formula;
use cannonpile::geometry::{Vector, directions};
use cannonpile::lattice::Sign;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use super::number::{Number, add};
use crate::error::bug;
use crate::{Each, Error};

/// The denominator of forces on the floor. Directions have the denominator 2, and mg is three units of contact force.
/// The compiler evaluates the `unwrap`, and rejects zero.
pub(super) const FLOOR_UNIT: NonZeroI64 = NonZeroI64::new(6).unwrap();

/// The normal force and both shears on the floor, times [`FLOOR_UNIT`].
type Floor<T> = [T; 3];

/// The force on the floor for each unit of contact force and of weight.
pub(super) struct FloorFactors<T> {
    /// By the sign of the last step and the direction of the contact.
    contacts: [[Floor<T>; 3]; 2],
    /// The normal force for a unit of weight.
    weight: T,
}

impl<T: Number> FloorFactors<T> {
    pub(super) fn new() -> Result<Self, Error> {
        let half = BigRational::new(1.into(), 2.into());
        let doubled = |x: BigRational| (x * BigInt::from(2)).to_integer();
        let plus = directions(&half).each(|direction| direction.map(doubled));
        let minus = plus.clone().each(Vector::turned_about_z);
        let zeros = || [(); 3].each(|()| BigInt::zero());
        let mut factors = Self {
            contacts: [(); 2].each(|()| [(); 3].each(|()| [(); 3].each(|()| T::zero()))),
            weight: T::zero(),
        };
        for (contacts, directions) in factors.contacts.iter_mut().zip([&plus, &minus]) {
            for (line, contact) in contacts.iter_mut().enumerate() {
                let mut unit = zeros();
                unit[line] = BigInt::one();
                let force = formula::support_load(&unit, directions, &BigInt::zero());
                *contact = [small(&force.z)?, small(&force.x)?, small(&force.y)?];
            }
        }
        let weight = doubled(formula::weight(&formula::increments(&half)));
        factors.weight = small(&formula::support_load(&zeros(), &plus, &weight).z)?;
        Ok(factors)
    }

    /// Returns the normal force of a weight.
    pub(super) fn weight(&self, weight: T) -> T {
        weight * &self.weight
    }

    /// Adds the force on the floor of three contact forces, for the sign of the last step.
    pub(super) fn add(&self, forces: [&T; 3], sign: Sign, floor: &mut [T; 3]) {
        let [plus, minus] = &self.contacts;
        let contacts = if sign == Sign::Plus { plus } else { minus };
        for (force, contact) in forces.into_iter().zip(contacts) {
            for (floor, factor) in floor.iter_mut().zip(contact) {
                add(floor, &(force.clone() * factor));
            }
        }
    }
}

/// Converts a small integer to the scalar by additions, because [`Number`] has no such conversion.
fn small<T: Number>(n: &BigInt) -> Result<T, Error> {
    let n = n
        .to_i8()
        .ok_or_else(|| bug("factors of the floor are small"))?;
    let magnitude = (0..n.unsigned_abs()).fold(T::zero(), |sum, _| sum + &T::one());
    Ok(if n < 0 {
        T::zero() - &magnitude
    } else {
        magnitude
    })
}
