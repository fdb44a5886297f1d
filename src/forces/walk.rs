//! The forces of sphere after sphere, from the engine that a plan has chosen.

use alloc::boxed::Box;

use num_rational::BigRational;

use super::FloorForce;
use super::terms::Terms;
use crate::Error;
use crate::engine::{Cells, Engine, Meter, Plan, Planes};
use crate::lattice::Site;
use crate::scalar::{Algebra, Exactness};
use crate::shape::Rows;

/// A way down through some rows of a pile.
#[derive(Clone, Debug)]
pub(super) enum Walk<'p, T: Algebra> {
    /// In the numerators of the scalar.
    Plain(Box<Terms<'p, T>>, Engine<'p, T, Cells<T::Numerator>>),
    /// In the integers of the exact engine, for a scalar that is exact itself.
    Exact(Box<Terms<'p, BigRational>>, Engine<'p, BigRational, Planes>),
}

impl<'p, T: Algebra> Walk<'p, T> {
    pub(super) fn new(plan: &Plan, rows: &Rows<'_>, terms: &Terms<'p, T>) -> Result<Self, Error> {
        if T::EXACTNESS == Exactness::Exact {
            let terms = Terms::<BigRational>::new(terms.system.clone());
            let engine = Engine::exact(plan, rows, (&terms.lines, &terms.system))?;
            return Ok(Self::Exact(Box::new(terms), engine));
        }
        let engine = Engine::plain(plan, rows, (&terms.lines, &terms.system))?;
        Ok(Self::Plain(Box::new(terms.clone()), engine))
    }

    /// Returns the forces to the spheres below one that is not on the floor.
    pub(super) fn passed_on(&mut self, site: Site, meter: impl Meter) -> Result<[T; 3], Error> {
        match self {
            Self::Plain(terms, engine) => {
                let Terms { lines, system, .. } = &**terms;
                terms.contacts(engine.passed_on((lines, system), site, meter)?)
            }
            Self::Exact(terms, engine) => {
                let Terms { lines, system, .. } = &**terms;
                let forces = terms.contacts(engine.passed_on((lines, system), site, meter)?)?;
                Ok(forces.map(|force| T::from_rational(&force)))
            }
        }
    }

    /// Returns the force of a bottom sphere on the floor.
    pub(super) fn on_floor(
        &mut self,
        site: Site,
        meter: impl Meter,
    ) -> Result<FloorForce<T>, Error> {
        match self {
            Self::Plain(terms, engine) => {
                let Terms { lines, system, .. } = &**terms;
                terms.floor(site, &engine.received((lines, system), site, meter)?)
            }
            Self::Exact(terms, engine) => {
                let Terms { lines, system, .. } = &**terms;
                let force = terms.floor(site, &engine.received((lines, system), site, meter)?)?;
                Ok(force.map(|component| T::from_rational(&component)))
            }
        }
    }
}
