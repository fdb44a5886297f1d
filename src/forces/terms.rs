//! Numerators converted into forces, each by one division.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::FloorForce;
use crate::Error;
use crate::each::Each;
use crate::engine::{LineForces, Readout, SphereForces, Unit, to_scalar, to_scalars};
use crate::formula;
use crate::geometry::Vector;
use crate::lattice::{Direction, Sign, Site};
use crate::scalar::{Algebra, Ring, Surd};

impl<T: Algebra> LineForces<'_, T> {
    pub(super) fn increment_sum(&self) -> Result<T, Error> {
        let sum = self.increment_sum.clone();
        to_scalar("the sum of increments", sum, &self.sum_scale)
    }

    /// Converts numerators into contact forces in f₀.
    pub(super) fn contacts(&self, numerators: SphereForces<T>) -> Result<[T; 3], Error> {
        let SphereForces { forces, changes } = numerators;
        to_scalars("a contact force", forces, &self.scale(changes))
    }

    /// Converts numerators of increments times directions into a vector in f₀.
    pub(super) fn vector(
        &self,
        quantity: &'static str,
        vector: Vector<T::Numerator>,
        changes: usize,
    ) -> Result<Vector<T>, Error> {
        let scale = self.scale(changes) * &self.direction_scale;
        let [x, y, z] = to_scalars(quantity, vector.into_array(), &scale)?;
        Ok(Vector { x, y, z })
    }

    /// Returns the force of a bottom sphere on the floor.
    pub(super) fn floor(
        &self,
        site: Site,
        above: &SphereForces<T>,
    ) -> Result<FloorForce<T>, Error> {
        let (force, unit) = self.floor_numerators(site, above);
        let force = to_scalars("a force on the floor", force.into_array(), &unit)?;
        let [shear_x, shear_y, normal] = force;
        Ok(FloorForce {
            site,
            normal,
            shear_x,
            shear_y,
        })
    }

    /// Returns the force of a bottom sphere on the floor as numerators of (shear_x, shear_y, normal), and their
    /// denominator.
    pub(super) fn floor_numerators(
        &self,
        site: Site,
        above: &SphereForces<T>,
    ) -> (Vector<T::Numerator>, T::Numerator) {
        let SphereForces { forces, changes } = above;
        let directions = self.directions_above(site.k);
        let load = self.load_vector(site, *changes);
        let force = formula::support_load(forces, &directions, &load.z) + &horizontal(&load);
        (force.scaled(&self.sum_scale), self.floor_unit(*changes))
    }

    /// Returns the coefficients of [`floor_numerators`](Self::floor_numerators) for an ordinary sphere: the factor of
    /// each force from above, and the contribution of gravity.
    fn floor_factors(
        &self,
        k: i128,
        changes: usize,
    ) -> ([Vector<T::Numerator>; 3], Vector<T::Numerator>) {
        let (zero, one) = (T::Numerator::from_integer(0), T::Numerator::from_integer(1));
        let directions = self.directions_above(k);
        let support_load = |forces: [&T::Numerator; 3], weight| {
            let force = formula::support_load(&forces.each(Clone::clone), &directions, weight);
            force.scaled(&self.sum_scale)
        };
        let factors = [
            support_load([&one, &zero, &zero], &zero),
            support_load([&zero, &one, &zero], &zero),
            support_load([&zero, &zero, &one], &zero),
        ];
        let gravity = self.ordinary_load(changes).scaled(&self.direction_scale);
        let own = support_load([&zero; 3], &gravity.z);
        (factors, own + &horizontal(&gravity).scaled(&self.sum_scale))
    }

    /// Returns the denominator of forces on the floor. One mg is W times the unit of forces along lines.
    pub(super) fn floor_unit(&self, changes: usize) -> T::Numerator {
        self.scale(changes) * &self.direction_scale * &self.increment_sum
    }

    /// Returns the sum of gravity and load on a sphere, over the common denominator of forces times directions.
    pub(super) fn load_vector(&self, site: Site, changes: usize) -> Vector<T::Numerator> {
        self.load(site, changes).scaled(&self.direction_scale)
    }

    /// Returns the unit vectors along the contacts above layer `k`. Above the top layer they are those of a + step.
    pub(super) fn directions_above(&self, k: i128) -> [Vector<T::Numerator>; 3] {
        self.directions_under(self.shape.sign_below(k - 1))
    }

    /// Returns the unit vectors along the contacts below layer `k`. Below the bottom layer they are those of a + step.
    pub(super) fn directions_below(&self, k: i128) -> [Vector<T::Numerator>; 3] {
        self.directions_under(self.shape.sign_below(k))
    }

    fn directions_under(&self, sign: Option<Sign>) -> [Vector<T::Numerator>; 3] {
        let directions = self.directions.clone();
        match sign {
            None | Some(Sign::Plus) => directions,
            Some(Sign::Minus) => directions.each(Vector::turned_about_z),
        }
    }
}

impl LineForces<'_, BigRational> {
    /// Returns the readout of normal force, shear along x and shear along y under an ordinary bottom sphere, or `None`
    /// if a factor is too long.
    pub(super) fn floor_readout(&self) -> Option<Readout> {
        let (floor, changes) = self.floor_and_changes();
        readout(&self.floor_factors(floor, changes))
    }

    /// Returns the readout of the same forces from the numbers of increments on the lines of a straight pile. Each
    /// number includes the increment of the sphere itself.
    pub(super) fn floor_readout_of_counts(&self) -> Option<Readout> {
        let (floor, changes) = self.floor_and_changes();
        let (lines, mut own) = self.floor_factors(floor, changes);
        let increments = self.increments_after(changes);
        let [a, b, c] = [0, 1, 2].each(|line| lines[line].clone().scaled(&increments[line]));
        for line in [&a, &b, &c] {
            own = own - line;
        }
        // The numbers must fit in one limb.
        let is_short = |x: &BigInt| x.bits() < 62;
        let short = is_short(&own.x) && is_short(&own.y) && is_short(&own.z);
        readout(&([a, b, c], own)).filter(|_| short)
    }

    /// Returns the units of normal force, shear along x and shear along y. The argument has the units of shear along x,
    /// shear along y and normal force.
    pub(super) fn floor_units(&self, [x, y, normal]: &[Surd; 3]) -> [Unit; 3] {
        let (_, changes) = self.floor_and_changes();
        let denominator = self.floor_unit(changes);
        [normal, x, y].each(|unit| Unit::new(unit.clone(), denominator.clone()))
    }

    /// Returns the bottom layer, and the number of sign changes above it.
    fn floor_and_changes(&self) -> (i128, usize) {
        let shape = self.shape;
        let floor = shape.layers() - 1;
        (floor, shape.changes_above(floor))
    }
}

/// Returns the horizontal part of a load.
pub(super) fn horizontal<N: Ring>(load: &Vector<N>) -> Vector<N> {
    Vector {
        z: N::zero(),
        ..load.clone()
    }
}

/// Returns the readout of normal force, shear along x and shear along y, from the factor of each line and the constant
/// term.
fn readout((lines, own): &([Vector<BigInt>; 3], Vector<BigInt>)) -> Option<Readout> {
    let factors = |part: fn(&Vector<BigInt>) -> &BigInt| {
        let [a, b, c] = lines.each_ref().each(|line| part(line).to_i16());
        Some([a?.into(), b?.into(), c?.into()])
    };
    Some(Readout {
        combination: [factors(|v| &v.z)?, factors(|v| &v.x)?, factors(|v| &v.y)?],
        own: [&own.z, &own.x, &own.y].each(Clone::clone),
    })
}

/// Returns the value that belongs to a direction.
pub(super) fn of_direction<V>([alpha, beta, gamma]: [V; 3], direction: Direction) -> V {
    match direction {
        Direction::Alpha => alpha,
        Direction::Beta => beta,
        Direction::Gamma => gamma,
    }
}
