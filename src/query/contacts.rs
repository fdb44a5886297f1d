//! Forces between spheres.

use super::source::Source;
use super::{Statics, edge, edge_all};
use crate::Error;
use crate::geometry::Vector;
use crate::lattice::Sign;
use crate::lattice::{Direction, Site};
use crate::lines::Wanted;
use crate::meter::Meter;
use crate::scalar::Algebra;
use crate::shape::Rows;

/// The force of contact between a sphere and the one below it.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Direction, Site};
/// use cannonpile::shape::Selection;
/// use cannonpile::{ContactForce, Pile};
///
/// let pile = Pile::triangular(10)?;
/// let first = pile.statics::<f64>().contacts(pile.rows(Selection::All)?).next();
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

impl<'p, T: Algebra, M: Meter> Statics<'p, T, M> {
    /// The magnitude of the contact force between `site` and the sphere below it, in f₀.
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::OnFloor`] for a sphere of the bottom layer;
    /// [`Error::NoSuchDirection`] for γ in a pile of discs; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::{Direction, Site};
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(pile.statics::<f64>().contact(Site::APEX, Direction::Gamma)?, 1.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact(&self, site: Site, direction: Direction) -> Result<T, Error> {
        let (force, changes) = self.contact_numerator(site, direction)?;
        edge("a contact force", force, &self.lines.scale(changes))
    }

    /// The force as a numerator, and the changes of sign down to it.
    fn contact_numerator(
        &self,
        site: Site,
        direction: Direction,
    ) -> Result<(T::Numerator, usize), Error> {
        self.check_contact(site, direction)?;
        if self.is_closed()
            && let Some(force) = self.lines.closed_contact(site, direction)
        {
            self.meter.visit(1);
            return Ok((force, 0));
        }
        let wanted = Wanted::for_contact(self.pile.shape(), site, direction);
        let (above, changes) = self.received(site, wanted)?;
        let (forces, changes) = self.lines.to_below(site, above, changes, self.meter);
        let [alpha, beta, gamma] = forces;
        let force = match direction {
            Direction::Alpha => alpha,
            Direction::Beta => beta,
            Direction::Gamma => gamma,
        };
        Ok((force, changes))
    }

    /// The same force as a vector, on the upper sphere, in f₀ and the symbolic basis: f·ê.
    ///
    /// The lower sphere feels the opposite.
    ///
    /// # Errors
    /// As for [`contact`](Self::contact).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::geometry::Vector;
    /// use cannonpile::lattice::{Direction, Site};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let force = pile.statics::<f64>().contact_vector(Site { i: 1, j: 0, k: 1 }, Direction::Beta)?;
    /// assert_eq!(force, Vector { x: 1.0, y: -1.0, z: -2.0 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact_vector(&self, site: Site, direction: Direction) -> Result<Vector<T>, Error> {
        let (force, changes) = self.contact_numerator(site, direction)?;
        let along = self.along(site, direction);
        self.edge_vector("a contact force", along.scaled(&force), changes)
    }

    /// The direction of the contact between `site` and the sphere below it, ê or ê turned about the vertical under a −
    /// step, in the symbolic basis.
    ///
    /// # Errors
    /// As for [`contact`](Self::contact).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::geometry::Vector;
    /// use cannonpile::lattice::{Direction, Region, Site};
    ///
    /// let pile = Pile::under(Region::SITE, "-".parse()?)?;
    /// let a = pile.statics::<f64>().contact_direction(Site::APEX, Direction::Alpha)?;
    /// assert_eq!(a, Vector { x: -0.5, y: -0.5, z: -1.0 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact_direction(&self, site: Site, direction: Direction) -> Result<Vector<T>, Error> {
        self.check_contact(site, direction)?;
        let along = self.along(site, direction).into_array();
        let [x, y, z] = edge_all("a direction", along, &self.direction_scale)?;
        Ok(Vector { x, y, z })
    }

    /// The numerators of a contact's direction.
    fn along(&self, site: Site, direction: Direction) -> Vector<T::Numerator> {
        let sign = self.pile.shape().sign_below(site.k).unwrap_or(Sign::Plus);
        let [alpha, beta, gamma] = self.directions_under(sign);
        match direction {
            Direction::Alpha => alpha,
            Direction::Beta => beta,
            Direction::Gamma => gamma,
        }
    }

    /// That there is a sphere below `site` in a direction.
    fn check_contact(&self, site: Site, direction: Direction) -> Result<(), Error> {
        self.off_the_floor(site)?;
        if self.pile.dimension().directions().contains(&direction) {
            Ok(())
        } else {
            Err(Error::NoSuchDirection { direction })
        }
    }

    /// The contact forces of the spheres in `rows`, each with the spheres below it, lazily.
    ///
    /// Spheres on the floor have none. An item is an error if the scalar overflows, or if the rows are
    /// another pile's and name a site that this one lacks.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let statics = pile.statics::<f64>();
    /// let mut total = 0.0;
    /// for contact in statics.contacts(pile.rows(Selection::All)?) {
    ///     total += contact?.force;
    /// }
    /// assert_eq!(total, 1485.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contacts(
        &self,
        rows: Rows<'p>,
    ) -> impl Iterator<Item = Result<ContactForce<T>, Error>> + use<'p, T, M> {
        let directions = self.pile.dimension().directions();
        let rows = rows.off_the_floor();
        let mut source = Source::new(self, &rows);
        let statics = self.clone();
        rows.flatten().flat_map(move |site| {
            statics.meter.answer(directions.len());
            let forces = match source.passed_on(&statics, site) {
                Ok(forces) => forces.map(Ok),
                Err(error) => [(); 3].map(|()| Err(error.clone())),
            };
            let contacts = forces.into_iter().zip(directions);
            contacts.map(move |(force, &direction)| {
                let force = force?;
                Ok(ContactForce {
                    site,
                    direction,
                    force,
                })
            })
        })
    }
}
