//! Forces between spheres.

use core::iter::{Flatten, Zip};

use super::Forces;
use super::walk::Walk;
use crate::Error;
use crate::engine::{Meter, Plan, Quantity};
use crate::lattice::{Direction, Site};
use crate::scalar::Algebra;
use crate::shape::{Rows, Selection};

/// The force of contact between a sphere and the one below it.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Direction, Site};
/// use cannonpile::shape::Selection;
/// use cannonpile::{ContactForce, Pile};
///
/// let pile = Pile::triangular(10)?;
/// let first = pile.forces::<f64>().contacts(Selection::All)?.next();
/// let (site, direction) = (Site::APEX, Direction::Alpha);
/// assert_eq!(first, Some(Ok(ContactForce { site, direction, force: 1.0 })));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ContactForce<T> {
    /// The upper sphere.
    pub site: Site,
    /// The direction in which the lower one lies.
    pub direction: Direction,
    /// The magnitude, in f₀; positive is push.
    pub force: T,
}

/// The contact forces of a part of a pile, one by one in row order: of each sphere those with the spheres below it.
///
/// Made by [`Forces::contacts`]. An item is an error if the scalar overflows.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(10)?;
/// let contacts = pile.forces::<f64>().contacts(Selection::All)?;
/// assert_eq!(contacts.plan().rows, 495_u32.into());
/// assert_eq!(contacts.count(), 495);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Contacts<'p, T: Algebra, M = ()> {
    plan: Plan,
    sites: Flatten<Rows<'p>>,
    walk: Walk<'p, T>,
    directions: &'static [Direction],
    /// The sphere that was reached, and its forces that were not given yet.
    reached: Option<(Site, Below<T>)>,
    meter: M,
}

/// The forces below a sphere, with their directions.
type Below<T> =
    Zip<core::array::IntoIter<Result<T, Error>, 3>, core::slice::Iter<'static, Direction>>;

impl<'p, T: Algebra, M: Meter> Contacts<'p, T, M> {
    pub(super) fn new(forces: &Forces<'p, T, M>, part: Selection) -> Result<Self, Error> {
        let rows = forces.pile.rows(part)?.off_the_floor();
        let plan = forces.plan(&rows, Quantity::ContactMultiples)?;
        Ok(Self {
            walk: Walk::new(&plan, &rows, &forces.terms)?,
            plan,
            sites: rows.flatten(),
            directions: forces.pile.dimension().directions(),
            reached: None,
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
    /// let contacts = Pile::triangular(10)?;
    /// let contacts = contacts.forces::<f64>().contacts(Selection::Layer(3))?;
    /// assert_eq!(contacts.plan().method, Method::Closed);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn plan(&self) -> &Plan {
        &self.plan
    }
}

impl<T: Algebra, M: Meter> Iterator for Contacts<'_, T, M> {
    type Item = Result<ContactForce<T>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some((site, below)) = &mut self.reached
                && let Some((force, &direction)) = below.next()
            {
                let site = *site;
                return Some(force.map(|force| ContactForce {
                    site,
                    direction,
                    force,
                }));
            }
            let site = self.sites.next()?;
            self.meter.answer(self.directions.len());
            let forces = match self.walk.passed_on(site, self.meter) {
                Ok(forces) => forces.map(Ok),
                Err(error) => [(); 3].map(|()| Err(error.clone())),
            };
            self.reached = Some((site, forces.into_iter().zip(self.directions)));
        }
    }
}
