//! Many answers in SI, one after the other.

use crate::lattice::{Direction, Site};
use crate::meter::Meter;
use crate::scalar::Surd;
use crate::shape::Rows;
use crate::{ContactForce, Error, FloorForce, Packing};

/// A contact between two spheres, in the units and the frame of a [`Packing`].
///
/// # Examples
/// ```
/// use cannonpile::geometry::Spacing;
/// use cannonpile::shape::Selection;
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
/// for contact in packing.contacts(pile.rows(Selection::All)?) {
///     let contact = contact?;
///     assert_eq!(contact.force.to_string(), "5/39*sqrt(13)");
///     // On the upper sphere, upwards.
///     assert_eq!(contact.vector[2].to_string(), "1/3");
/// }
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PackedContact {
    /// The upper sphere.
    pub site: Site,
    /// The direction in which the lower one lies.
    pub direction: Direction,
    /// The magnitude of the force; positive is push.
    pub force: Surd,
    /// The force on the upper sphere, z up.
    pub vector: [Surd; 3],
    /// Where they touch.
    pub point: [Surd; 3],
}

impl<'p, M: Meter> Packing<'p, M> {
    /// The contacts of the spheres in `rows`, each with the spheres below it, lazily.
    ///
    /// As [`Statics::contacts`](crate::Statics::contacts).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::scalar::Surd;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let contacts = packing.contacts(pile.rows(Selection::All)?).collect::<Result<Vec<_>, _>>()?;
    /// assert_eq!(contacts.len(), 12);
    /// for contact in contacts {
    ///     let squares = contact.vector.iter().map(Surd::square);
    ///     assert_eq!(squares.sum::<BigRational>(), contact.force.square());
    /// }
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contacts(
        &self,
        rows: Rows<'p>,
    ) -> impl Iterator<Item = Result<PackedContact, Error>> + use<'p, M> {
        // Before it is cloned, so that the next question finds the roots taken.
        let _ = (self.secant(), self.forces(), self.lengths());
        let packing = self.clone();
        self.statics.contacts(rows).map(move |contact| {
            let contact = contact?;
            let (site, direction) = (contact.site, contact.direction);
            Ok(PackedContact {
                site,
                direction,
                force: packing.magnitude(&contact.force),
                vector: packing.vector(site, direction, &contact.force)?,
                point: packing.contact_point(site, direction)?,
            })
        })
    }

    /// The magnitudes alone of the same forces, lazily: one root in all, where vectors and points take five.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let forces = packing.magnitudes(pile.rows(Selection::All)?);
    /// let forces: Result<Vec<_>, _> = forces.map(|contact| Ok(contact?.force)).collect();
    /// assert_eq!(forces.as_ref().map(Vec::len), Ok(12));
    /// assert_eq!(forces?.iter().max().unwrap().to_string(), "10/39*sqrt(13)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn magnitudes(
        &self,
        rows: Rows<'p>,
    ) -> impl Iterator<Item = Result<ContactForce<Surd>, Error>> + use<'p, M> {
        let _ = self.secant();
        let packing = self.clone();
        self.statics.contacts(rows).map(move |contact| {
            let ContactForce {
                site,
                direction,
                force,
            } = contact?;
            Ok(ContactForce {
                site,
                direction,
                force: packing.magnitude(&force),
            })
        })
    }

    /// The places of the spheres in `rows`, lazily.
    ///
    /// As [`position`](Self::position).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // The bottom layer is at height 0.
    /// for position in packing.positions(pile.rows(Selection::Base)?) {
    ///     assert!(position?[2] == 0.0);
    /// }
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn positions(
        &self,
        rows: Rows<'p>,
    ) -> impl Iterator<Item = Result<[Surd; 3], Error>> + use<'p, M> {
        let _ = self.lengths();
        let packing = self.clone();
        rows.flatten().map(move |site| {
            packing.statics.meter().answer(1);
            packing.position(site)
        })
    }

    /// The forces of the bottom spheres in `rows` on the floor, lazily.
    ///
    /// As [`Statics::base`](crate::Statics::base).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-".parse()?)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// for force in packing.base(pile.rows(Selection::Base)?) {
    ///     println!("{}", force?.normal);
    /// }
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn base(
        &self,
        rows: Rows<'p>,
    ) -> impl Iterator<Item = Result<FloorForce<Surd>, Error>> + use<'p, M> {
        let _ = self.forces();
        let packing = self.clone();
        let forces = self.statics.base(rows);
        forces.map(move |force| Ok(packing.floor_force(force?)))
    }
}
