//! Iterators over results in SI units.

use super::on_basis;
use crate::each::Each;
use crate::forces::{Layers, Nearest, Units};
use crate::lattice::{ContactKind, Direction, HorizontalContact, Site};
use crate::scalar::{CorrectlyRounded, Surd, product};
use crate::shape::Selection;
use crate::{ContactForce, Error, FloorForce, Packing};
use num_rational::BigRational;

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
/// for contact in packing.contacts(Selection::All)? {
///     let contact = contact?;
///     assert_eq!(contact.force.to_string(), "5/39*sqrt(13)");
///     // The force on the upper sphere points upwards.
///     assert_eq!(contact.vector[2].to_string(), "1/3");
/// }
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(::serde::Serialize, ::serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct PackedContact {
    /// The upper sphere. For two neighbours in a layer, it is the sphere that names the contact.
    pub site: Site,
    /// The direction from `site` to the other sphere.
    pub direction: ContactKind,
    /// The force is positive in compression. It is negative if the contact would be tensile.
    pub force: Surd,
    /// The force on the sphere `site`, with z up.
    pub vector: [Surd; 3],
    /// The point of contact.
    pub point: [Surd; 3],
}

impl<'p> Packing<'p> {
    /// Iterates over the layers of `part`, from the top. Each layer writes its contact forces, in newtons and correctly
    /// rounded, into caller-provided slices. This is the fastest way to compute many forces.
    ///
    /// # Errors
    /// As for [`Forces::layers`](crate::Forces::layers); [`Error::Overflow`] for a force beyond the range of the
    /// floats.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let layers = packing.layers::<f64>(Selection::All)?;
    /// let mut forces = [(); 3].map(|()| vec![0.0; 165]);
    /// let [alpha, beta, gamma] = &mut forces;
    /// layers.fill([alpha, beta, gamma])?;
    /// assert_eq!(forces[0][0], 0.46225016352102425);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn layers<F: CorrectlyRounded>(
        &self,
        part: Selection,
    ) -> Result<Layers<'p, Nearest<F>>, Error> {
        let [x, y, z] = self.roots.forces();
        let basis = |unit: &BigRational| [x, y, z].each(|root| root.scaled(unit));
        let [along_x, along_y, downwards] = basis(&self.weight_per_sum);
        let units = Units {
            contact: self.unit_force(),
            vector: [along_x, along_y, -downwards],
            floor: basis(&self.sphere_weight()),
        };
        self.forces.layers(part)?.into_output(units)
    }

    /// Iterates over the contacts of a part of the pile. The contacts of a sphere are those with its supports.
    ///
    /// # Errors
    /// As for [`Forces::contacts`](crate::Forces::contacts).
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
    /// let contacts = packing.contacts(Selection::All)?.collect::<Result<Vec<_>, _>>()?;
    /// assert_eq!(contacts.len(), 12);
    /// for contact in contacts {
    ///     let squares = contact.vector.iter().map(Surd::square);
    ///     assert_eq!(squares.sum::<BigRational>(), contact.force.square());
    /// }
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contacts(
        &self,
        part: Selection,
    ) -> Result<impl Iterator<Item = Result<PackedContact, Error>> + use<'p>, Error> {
        let packing = self.clone();
        let contacts = self.forces.contacts(part)?;
        Ok(contacts.map(move |contact| packing.contact_in_si(contact?)))
    }

    /// Returns a contact in SI units, from its force in f₀.
    ///
    /// # Errors
    /// As for [`contact_point`](Self::contact_point).
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
    /// let multiples = packing.forces().contacts(Selection::All)?;
    /// for (multiple, contact) in multiples.zip(packing.contacts(Selection::All)?) {
    ///     assert_eq!(packing.contact_in_si(multiple?)?, contact?);
    /// }
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact_in_si(
        &self,
        contact: ContactForce<BigRational>,
    ) -> Result<PackedContact, Error> {
        let ContactForce {
            site,
            direction,
            force,
        } = contact;
        Ok(PackedContact {
            site,
            direction: direction.into(),
            force: self.magnitude(&force),
            vector: self.vector(site, direction, &force)?,
            point: self.contact_point(site, direction)?,
        })
    }

    /// Returns a horizontal contact in SI units, from its force in f₀.
    ///
    /// # Errors
    /// [`Error::SiteOutside`] for either sphere.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::{Axis, HorizontalContact, Site};
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let one = BigRational::from_integer(1.into());
    /// let contact = HorizontalContact { site: Site { i: 0, j: 0, k: 1 }, axis: Axis::AlphaBeta };
    /// let pile = Pile::triangular(3)?.with_horizontal_force(contact, one.clone())?;
    /// let packing = Packing::new(&pile, &Spacing::new(one.clone())?)?;
    /// let packed = packing.horizontal_contact_in_si(contact, &one)?;
    /// // The neighbour lies along +y, so the force on the sphere points along −y.
    /// assert_eq!(packed.vector[1], -packed.force);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn horizontal_contact_in_si(
        &self,
        contact: HorizontalContact,
        force: &BigRational,
    ) -> Result<PackedContact, Error> {
        let HorizontalContact { site, axis } = contact;
        let neighbour = self.pile().shape().neighbour(contact)?;
        let [a, b] = axis.ends().each(Direction::index);
        let directions = self.pile().directions::<BigRational>();
        let along = directions[b].clone() - &directions[a];
        let halfway = self.centre(site)? + &self.centre(neighbour)?;
        let half_a_diameter = self.radius();
        Ok(PackedContact {
            site,
            direction: axis.into(),
            force: self.magnitude(force),
            vector: on_basis(
                self.roots.forces(),
                &along,
                &product(force, &self.weight_per_sum),
            ),
            point: on_basis(self.roots.lengths(), &halfway, half_a_diameter),
        })
    }

    /// Iterates over the contact forces of a part of the pile, without vectors and points. A force is positive in
    /// compression, and negative if the contact would be tensile.
    ///
    /// # Errors
    /// As for [`Forces::contacts`](crate::Forces::contacts).
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
    /// let forces = packing.contact_forces(Selection::All)?;
    /// let forces = forces.map(|contact| contact.map(|contact| contact.force));
    /// let forces: Result<Vec<_>, _> = forces.collect();
    /// assert_eq!(forces.as_ref().map(Vec::len), Ok(12));
    /// assert_eq!(forces?.iter().max().unwrap().to_string(), "10/39*sqrt(13)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contact_forces(
        &self,
        part: Selection,
    ) -> Result<impl Iterator<Item = Result<ContactForce<Surd>, Error>> + use<'p>, Error> {
        let packing = self.clone();
        let contacts = self.forces.contacts(part)?;
        Ok(contacts.map(move |contact| {
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
        }))
    }

    /// Iterates over the positions of the spheres of a part of the pile.
    ///
    /// # Errors
    /// As for [`Forces::contacts`](crate::Forces::contacts). An item has the errors of [`position`](Self::position).
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
    /// for position in packing.positions(Selection::Base)? {
    ///     assert!(position?[2] == 0.0);
    /// }
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn positions(
        &self,
        part: Selection,
    ) -> Result<impl Iterator<Item = Result<[Surd; 3], Error>> + use<'p>, Error> {
        let packing = self.clone();
        let sites = self.pile().rows(part)?.flatten();
        Ok(sites.map(move |site| {
            packing.forces.meter().answer(1);
            packing.position(site)
        }))
    }

    /// Iterates over the forces of bottom spheres on the floor.
    ///
    /// # Errors
    /// As for [`Forces::base`](crate::Forces::base).
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
    /// for force in packing.base(Selection::Base)? {
    ///     println!("{}", force?.normal);
    /// }
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn base(
        &self,
        part: Selection,
    ) -> Result<impl Iterator<Item = Result<FloorForce<Surd>, Error>> + use<'p>, Error> {
        let packing = self.clone();
        let forces = self.forces.base(part)?;
        Ok(forces.map(move |force| Ok(packing.floor_force_in_si(force?))))
    }
}
