//! The forces of sphere after sphere, from the engine that a plan has chosen.

use alloc::boxed::Box;
#[cfg(feature = "rayon")]
use alloc::vec::Vec;

use num_rational::BigRational;

use super::FloorForce;
use super::terms::Terms;
use crate::Error;
use crate::engine::{Cells, Engine, Meter, Plan, Planes};
#[cfg(feature = "rayon")]
use crate::lattice::Row;
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
    pub(super) fn passed_on(&mut self, site: Site, meter: Meter<'_>) -> Result<[T; 3], Error> {
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
        meter: Meter<'_>,
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

/// For the threads that share a layer.
#[cfg(feature = "rayon")]
impl<T: Algebra> Walk<'_, T> {
    pub(super) const fn is_sweep(&self) -> bool {
        match self {
            Self::Plain(_, engine) => engine.is_sweep(),
            Self::Exact(_, engine) => engine.is_sweep(),
        }
    }

    /// Returns how many spheres of a row are best asked for at once.
    pub(super) const fn sites_at_once(&self) -> i128 {
        match self {
            Self::Plain(_, engine) => engine.sites_at_once(),
            Self::Exact(_, engine) => engine.sites_at_once(),
        }
    }

    /// Goes down to layer `k`, if this is a sweep and the layer is further down.
    pub(super) fn go_down_to(&mut self, k: i128, meter: Meter<'_>) -> Result<(), Error> {
        match self {
            Self::Plain(_, engine) => engine.go_down_to(k, meter),
            Self::Exact(_, engine) => engine.go_down_to(k, meter),
        }
    }

    /// Does as [`passed_on`](Self::passed_on) for each sphere of a piece of a row; a sweep has gone down to its layer.
    pub(super) fn passed_on_in(&self, piece: &Row, meter: Meter<'_>) -> Vec<Result<[T; 3], Error>> {
        match self {
            Self::Plain(terms, engine) => {
                let Terms { lines, system, .. } = &**terms;
                let below = engine.passed_on_in((lines, system), piece, meter);
                below
                    .into_iter()
                    .map(|below| terms.contacts(below?))
                    .collect()
            }
            Self::Exact(terms, engine) => {
                let Terms { lines, system, .. } = &**terms;
                let below = engine.passed_on_in((lines, system), piece, meter);
                let inexact = |force: BigRational| T::from_rational(&force);
                let forces = |below: Result<_, _>| Ok(terms.contacts(below?)?.map(inexact));
                below.into_iter().map(forces).collect()
            }
        }
    }

    /// Does as [`on_floor`](Self::on_floor) for each sphere of a piece of a row; a sweep has gone down to its layer.
    pub(super) fn on_floor_in(
        &self,
        piece: &Row,
        meter: Meter<'_>,
    ) -> Vec<Result<FloorForce<T>, Error>> {
        let sites = piece.clone().into_iter();
        match self {
            Self::Plain(terms, engine) => {
                let Terms { lines, system, .. } = &**terms;
                let above = engine.received_in((lines, system), piece, meter);
                let floor = |(site, above): (_, Result<_, _>)| terms.floor(site, &above?);
                sites.zip(above).map(floor).collect()
            }
            Self::Exact(terms, engine) => {
                let Terms { lines, system, .. } = &**terms;
                let above = engine.received_in((lines, system), piece, meter);
                let inexact = |force: BigRational| T::from_rational(&force);
                let floor =
                    |(site, above): (_, Result<_, _>)| Ok(terms.floor(site, &above?)?.map(inexact));
                sites.zip(above).map(floor).collect()
            }
        }
    }
}
