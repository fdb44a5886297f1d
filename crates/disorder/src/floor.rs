//! What the floor feels of the forces on a sphere.

use core::num::NonZeroI64;

use cannonpile::formula;
use cannonpile::geometry::{Vector, directions};
use cannonpile::lattice::Sign;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

use super::number::{Number, add};
use crate::Error;
use crate::error::bug;

/// What the numerators of the floor are divided by: directions over 2, and three units of force to mg. Unwrapped by the
/// compiler: zero would not build.
pub(super) const FLOOR_UNIT: NonZeroI64 = NonZeroI64::new(6).unwrap();

/// Normal force and shears on the floor: six times those in the units of the base, in the unit of the numerators.
#[derive(Clone, Debug)]
pub(super) struct Floor<T> {
    pub(super) normal: T,
    pub(super) shear_x: T,
    pub(super) shear_y: T,
}

/// What a force from above, and a weight, make of the force on the floor: six times it in the units of the base.
pub(super) struct FloorFactors<T> {
    /// By sign and direction.
    lines: [[[T; 3]; 3]; 2],
    own: T,
}

impl<T: Number> FloorFactors<T> {
    pub(super) fn new() -> Result<Self, Error> {
        // Directions over 2, and mg is three units of force along the lines.
        let half = BigRational::new(1.into(), 2.into());
        let two = BigInt::from(2);
        let numerator = |x: BigRational| (x * &two).to_integer();
        let straight = directions(&half).map(|direction| direction.map(numerator));
        let turned = straight.clone().map(Vector::turned_about_z);
        let [zero, one] = [BigInt::zero(), BigInt::one()];
        let units = [0, 1, 2].map(|line| {
            let mut unit = [zero.clone(), zero.clone(), zero.clone()];
            unit[line].clone_from(&one);
            unit
        });
        let small = |n: &BigInt| {
            let n = n
                .to_i8()
                .ok_or_else(|| bug("factors of the floor are small"))?;
            let magnitude = (0..n.unsigned_abs()).fold(T::zero(), |sum, _| sum + &T::one());
            Ok::<_, Error>(if n < 0 {
                T::zero() - &magnitude
            } else {
                magnitude
            })
        };
        let line = |unit: &[BigInt; 3], directions: &[Vector<BigInt>; 3]| {
            let Vector { x, y, z } = formula::handed_on(unit, directions, &zero);
            Ok::<_, Error>([small(&z)?, small(&x)?, small(&y)?])
        };
        let lines = |directions: &[Vector<BigInt>; 3]| {
            let [a, b, c] = &units;
            Ok::<_, Error>([
                line(a, directions)?,
                line(b, directions)?,
                line(c, directions)?,
            ])
        };
        let weight = formula::weight(&formula::increments(&half));
        let own = formula::handed_on(
            &[zero.clone(), zero.clone(), zero.clone()],
            &straight,
            &numerator(weight),
        );
        Ok(Self {
            lines: [lines(&straight)?, lines(&turned)?],
            own: small(&own.z)?,
        })
    }

    /// A weight, in the unit of forces.
    pub(super) fn own(&self, weight: T) -> Floor<T> {
        Floor {
            normal: weight * &self.own,
            shear_x: T::zero(),
            shear_y: T::zero(),
        }
    }

    /// Adds three forces from above, by the sign of the step above.
    pub(super) fn add(&self, forces: [&T; 3], sign: Sign, floor: &mut Floor<T>) {
        let [plus, minus] = &self.lines;
        let lines = if sign == Sign::Plus { plus } else { minus };
        for (force, [normal, shear_x, shear_y]) in forces.into_iter().zip(lines) {
            add(&mut floor.normal, &(force.clone() * normal));
            add(&mut floor.shear_x, &(force.clone() * shear_x));
            add(&mut floor.shear_y, &(force.clone() * shear_y));
        }
    }
}
