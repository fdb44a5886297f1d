//! Forces on the floor.

use core::iter::Flatten;

use super::Forces;
use super::walk::Walk;
use crate::Error;
use crate::engine::{Meter, Plan, Quantity};
use crate::lattice::Site;
use crate::scalar::Algebra;
use crate::shape::{Rows, Selection};

/// The force of one bottom sphere on the floor.
///
/// Paper, (13) and (14). In the units below from [`Forces`]; from a [`Packing`](crate::Packing) all three in units of
/// force.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Site;
/// use cannonpile::{FloorForce, Pile};
///
/// let pile = Pile::triangular(10)?;
/// // In the middle of the base there is no shear.
/// let site = Site { i: 3, j: 3, k: 9 };
/// let force = pile.forces::<f64>().on_floor(site)?;
/// assert_eq!(force, FloorForce { site, normal: 4.0, shear_x: 0.0, shear_y: 0.0 });
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FloorForce<T> {
    /// The bottom sphere.
    pub site: Site,
    /// The normal force, in mg, downwards.
    pub normal: T,
    /// The shear along x, in mg·tanθ.
    pub shear_x: T,
    /// The shear along y, in 2cosφ·mg·tanθ (√3·mg·tanθ on an equilateral base); zero for discs.
    pub shear_y: T,
}

impl<T> FloorForce<T> {
    /// Returns the force with `f` applied to each component.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::FloorForce;
    /// use cannonpile::lattice::Site;
    ///
    /// let force = FloorForce { site: Site::APEX, normal: 4, shear_x: -1, shear_y: 0 };
    /// assert_eq!(force.map(f64::from).normal, 4.0);
    /// ```
    #[must_use]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> FloorForce<U> {
        FloorForce {
            site: self.site,
            normal: f(self.normal),
            shear_x: f(self.shear_x),
            shear_y: f(self.shear_y),
        }
    }
}

/// The forces of bottom spheres on the floor, one by one in row order.
///
/// Made by [`Forces::base`]. An item is an error if the scalar overflows.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(10)?;
/// let base: Vec<_> = pile.forces::<f64>().base(Selection::Base)?.collect::<Result<_, _>>()?;
/// assert!(base.iter().all(|force| force.normal == 4.0));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Base<'p, T: Algebra, M = ()> {
    plan: Plan,
    sites: Flatten<Rows<'p>>,
    walk: Walk<'p, T>,
    meter: M,
}

impl<'p, T: Algebra, M: Meter> Base<'p, T, M> {
    pub(super) fn new(forces: &Forces<'p, T, M>, part: Selection) -> Result<Self, Error> {
        let rows = forces.pile.rows(part)?;
        let plan = forces.plan(&rows, Quantity::FloorMultiples)?;
        Ok(Self {
            walk: Walk::new(&plan, &rows, &forces.terms)?,
            plan,
            sites: rows.flatten(),
            meter: forces.meter,
        })
    }

    /// Returns how the forces are found, and what that takes at most.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::{Method, Pile};
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let base = pile.forces::<f64>().base(Selection::Base)?;
    /// assert_eq!(base.plan().method, Method::Closed);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }
}

impl<T: Algebra, M: Meter> Iterator for Base<'_, T, M> {
    type Item = Result<FloorForce<T>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        let site = self.sites.next()?;
        self.meter.answer(1);
        Some(self.walk.on_floor(site, self.meter))
    }
}
