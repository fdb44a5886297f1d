//! Forces between spheres.

use core::fmt;
use core::iter::{FusedIterator, Zip};

use exact_surd::layout::{padded, part};

use super::Forces;
use super::walk::Walk;
use crate::Error;
use crate::engine::{Meter, Plan, Quantity};
use crate::lattice::{Direction, Site};
use crate::scalar::Algebra;
use crate::shape::{Selection, Sites, exact_hint};

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
    /// The force, in f₀. Positive: they push. Negative: they would have to pull.
    pub force: T,
}

impl<T: fmt::Display> fmt::Display for ContactForce<T> {
    /// Prints `(0,0,0) alpha: 1`; a sign and a precision are those of the force.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::ContactForce;
    /// use cannonpile::lattice::{Direction, Site};
    ///
    /// let contact = ContactForce { site: Site::APEX, direction: Direction::Gamma, force: 0.5 };
    /// assert_eq!(contact.to_string(), "(0,0,0) gamma: 0.5");
    /// assert_eq!(format!("{contact:+.2}"), "(0,0,0) gamma: +0.50");
    /// ```
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (
            Self {
                site, direction, ..
            },
            force,
        ) = (self, part(f, &self.force));
        padded(f, format_args!("{site} {direction}: {force}"))
    }
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
#[must_use = "iterators are lazy and do nothing unless consumed"]
pub struct Contacts<'p, T: Algebra> {
    plan: Plan,
    sites: Sites<'p>,
    walk: Walk<'p, T>,
    directions: &'static [Direction],
    /// The sphere that was reached, and its forces that were not given yet.
    reached: Option<(Site, Below<T>)>,
    meter: Meter<'p>,
}

/// The forces below a sphere, with their directions.
type Below<T> =
    Zip<core::array::IntoIter<Result<T, Error>, 3>, core::slice::Iter<'static, Direction>>;

impl<'p, T: Algebra> Contacts<'p, T> {
    pub(super) fn new(forces: &Forces<'p, T>, part: Selection) -> Result<Self, Error> {
        let rows = forces.pile.rows(part)?.off_the_floor();
        let plan = forces.plan(&rows, Quantity::ContactMultiples)?;
        Ok(Self {
            walk: Walk::new(&plan, &rows, &forces.terms)?,
            plan,
            sites: rows.sites(),
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

impl<T: Algebra> Iterator for Contacts<'_, T> {
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

    fn size_hint(&self) -> (usize, Option<usize>) {
        let reached = self.reached.iter().map(|(_, below)| below.len());
        let further = self.sites.remaining() * self.directions.len();
        exact_hint(&reached.fold(further, |further, reached| further + reached))
    }
}

impl<T: Algebra> FusedIterator for Contacts<'_, T> {}

#[cfg(test)]
mod tests {
    use crate::Pile;
    use crate::shape::Selection;

    #[test]
    fn hints_are_exact() {
        let piles = [
            Pile::triangular(4).unwrap(),
            Pile::discs(4).unwrap(),
            Pile::under("hexagon:2".parse().unwrap(), "+-+".parse().unwrap()).unwrap(),
        ];
        for pile in &piles {
            for part in [Selection::All, Selection::Layer(1), Selection::Base] {
                let mut items = pile.forces::<f64>().contacts(part).unwrap();
                let mut left = items.clone().count();
                loop {
                    assert_eq!(items.size_hint(), (left, Some(left)));
                    if items.next().is_none() {
                        break;
                    }
                    left -= 1;
                }
                assert!(left == 0 && items.next().is_none());
            }
        }
    }

    #[test]
    fn more_than_a_usize_has_no_upper_bound() {
        let pile = Pile::triangular(10_i128.pow(30)).unwrap();
        let items = pile.forces::<f64>().contacts(Selection::All).unwrap();
        assert_eq!(items.size_hint(), (usize::MAX, None));
    }
}
