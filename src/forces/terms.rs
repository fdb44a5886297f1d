//! The constants of the forces, as numerators over known denominators.

use alloc::vec::Vec;
use core::array;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::FloorForce;
use crate::Error;
use crate::each::Each;
use crate::engine::{LineForces, Readout, SphereForces, Unit};
use crate::formula;
use crate::geometry::{Load, Vector};
use crate::lattice::{Direction, Sign, Site};
use crate::pile::System;
use crate::scalar::{Algebra, Ring, Surd};

/// A system of equations in the numerators of a scalar: the increments of spheres and the directions of lines.
#[derive(Clone, Debug)]
pub(super) struct Terms<'p, T: Algebra> {
    pub(super) system: System<'p>,
    pub(super) lines: LineForces<'p, T>,
    /// W, over `sum_scale`.
    increment_sum: T::Numerator,
    pub(super) sum_scale: T::Numerator,
    /// The directions under a + step, as numerators over `direction_scale`.
    pub(super) directions: [Vector<T::Numerator>; 3],
    pub(super) direction_scale: T::Numerator,
}

impl<'p, T: Algebra> Terms<'p, T> {
    pub(super) fn new(system: System<'p>) -> Self {
        let ([increment_sum], sum_scale) =
            T::numerators(core::array::from_ref(&system.increment_sum));
        let directions = system.directions.clone().each(Vector::into_array);
        let components = array::from_fn::<_, 9, _>(|n| directions[n / 3][n % 3].clone());
        let (components, direction_scale) = T::numerators(&components);
        Self {
            lines: LineForces::new(&system),
            system,
            increment_sum,
            sum_scale,
            directions: [0, 3, 6].each(|line| {
                let [x, y, z] = [0, 1, 2].each(|n| components[line + n].clone());
                Vector { x, y, z }
            }),
            direction_scale,
        }
    }

    /// Adds to the loads on spheres.
    pub(super) fn add_loads(&mut self, loads: Vec<(Site, Load<T>)>) {
        let (mut rational, mut own) = (false, Vec::new());
        for (site, Load { down, x, y }) in loads {
            match T::into_numerators([down, x, y]) {
                Ok([down, x, y]) => own.push((site, Load { down, x, y })),
                Err([down, x, y]) => {
                    let loading = self.system.loading.to_mut();
                    loading.add_load(site, &Load { down, x, y });
                    rational = true;
                }
            }
        }
        if rational {
            *self = Self::new(self.system.clone());
        }
        if !own.is_empty() {
            self.lines.add_loads(&self.system, own);
            self.system.has_scalar_loads = true;
        }
    }

    /// Adds to the tilt of gravity.
    pub(super) fn add_tilt(&mut self, tilt: [T; 2]) {
        match T::into_numerators(tilt) {
            Ok(tilt) => {
                self.lines.add_tilt(&self.system, tilt);
                self.system.has_scalar_loads = true;
            }
            Err(tilt) => {
                self.system.loading.to_mut().add_tilt(tilt);
                *self = Self::new(self.system.clone());
            }
        }
    }

    pub(super) fn increment_sum(&self) -> Result<T, Error> {
        let sum = self.increment_sum.clone();
        to_scalar("the sum of increments", sum, &self.sum_scale)
    }

    /// Converts numerators into contact forces in f₀.
    pub(super) fn contacts(&self, numerators: SphereForces<T>) -> Result<[T; 3], Error> {
        let SphereForces { forces, changes } = numerators;
        to_scalars("a contact force", forces, &self.lines.scale(changes))
    }

    /// Converts numerators of increments times directions into a vector in f₀.
    pub(super) fn vector(
        &self,
        quantity: &'static str,
        vector: Vector<T::Numerator>,
        changes: usize,
    ) -> Result<Vector<T>, Error> {
        let scale = self.lines.scale(changes) * &self.direction_scale;
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
        let load = self.load(site, *changes);
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
        let (zero, one) = (T::Numerator::from_i128(0), T::Numerator::from_i128(1));
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
        let gravity = self
            .lines
            .ordinary_load(changes)
            .scaled(&self.direction_scale);
        let own = support_load([&zero; 3], &gravity.z);
        (factors, own + &horizontal(&gravity).scaled(&self.sum_scale))
    }

    /// Returns the denominator of forces on the floor. One mg is W times the unit of forces along lines.
    pub(super) fn floor_unit(&self, changes: usize) -> T::Numerator {
        self.lines.scale(changes) * &self.direction_scale * &self.increment_sum
    }

    /// Returns the sum of gravity and load on a sphere, over the common denominator of forces times directions.
    pub(super) fn load(&self, site: Site, changes: usize) -> Vector<T::Numerator> {
        self.lines.load(site, changes).scaled(&self.direction_scale)
    }

    /// Returns the unit vectors along the contacts above layer `k`. Above the top layer they are those of a + step.
    pub(super) fn directions_above(&self, k: i128) -> [Vector<T::Numerator>; 3] {
        self.directions_under(self.system.shape.sign_below(k - 1))
    }

    /// Returns the unit vectors along the contacts below layer `k`. Below the bottom layer they are those of a + step.
    pub(super) fn directions_below(&self, k: i128) -> [Vector<T::Numerator>; 3] {
        self.directions_under(self.system.shape.sign_below(k))
    }

    fn directions_under(&self, sign: Option<Sign>) -> [Vector<T::Numerator>; 3] {
        let directions = self.directions.clone();
        match sign {
            None | Some(Sign::Plus) => directions,
            Some(Sign::Minus) => directions.each(Vector::turned_about_z),
        }
    }
}

impl Terms<'_, BigRational> {
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
        let increments = self.lines.increments_after(changes);
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
        let shape = self.system.shape;
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

/// Returns `n / d`, or an error if the scalar cannot hold it.
pub(super) fn to_scalar<T: Algebra>(
    quantity: &'static str,
    n: T::Numerator,
    d: &T::Numerator,
) -> Result<T, Error> {
    let value = T::from_ratio(n, d).filter(T::is_defined);
    value.ok_or(Error::overflow(quantity, T::NAME))
}

/// Returns each of `n` over `d`, or an error if the scalar cannot hold one of them.
pub(super) fn to_scalars<T: Algebra>(
    quantity: &'static str,
    n: [T::Numerator; 3],
    d: &T::Numerator,
) -> Result<[T; 3], Error> {
    let [x, y, z] = n;
    Ok([
        to_scalar(quantity, x, d)?,
        to_scalar(quantity, y, d)?,
        to_scalar(quantity, z, d)?,
    ])
}
