//! Certificates of all forces of a pile.

use std::collections::BTreeMap;

use cannonpile::engine::refuse_beyond;
use cannonpile::scalar::{Algebra, ByValue};
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::{AllForces, Certificate, Claim};

/// The largest number of forces in a certificate: three for each of a million spheres.
const MAX_FORCES: u64 = 3_000_000;

impl Certificate {
    /// Returns the certificate of all exact forces of a pile without horizontal forces, also if it is unstable.
    ///
    /// # Errors
    /// [`TooLarge`](Error::TooLarge) for a pile of more than a million spheres, and the errors of
    /// [`Forces::contacts`](cannonpile::Forces::contacts).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile_horizontal::certificate::Certificate;
    ///
    /// let pile = Pile::on(Region::hexagon(4, 3)?, "+-+".parse()?)?;
    /// let certificate = Certificate::of_forces(&pile)?;
    /// assert_eq!(certificate.check(), Ok(()));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn of_forces(pile: &Pile) -> Result<Self, Error> {
        refuse_beyond(
            "the certificate of all forces",
            pile.sphere_count() * 3_u8,
            MAX_FORCES,
            "certify a smaller pile",
        )?;
        let forces = pile.forces::<BigRational>();
        let mut contacts = BTreeMap::new();
        for contact in forces.contacts(Selection::All)? {
            let contact = contact?;
            let below: &mut [BigRational; 3] = contacts.entry(contact.site).or_default();
            below[contact.direction.index()] = contact.force;
        }
        let floor: Result<Vec<_>, Error> =
            forces.base(Selection::Layer(pile.layers() - 1))?.collect();
        let compressive = !contacts.values().flatten().any(Signed::is_negative);
        let all = AllForces {
            within: BigRational::zero(),
            compressive,
            contacts,
            floor: floor?,
        };
        Ok(Self {
            pile: pile.clone(),
            claim: Claim::Forces(Box::new(all)),
            horizontal: BTreeMap::new(),
            field: BTreeMap::new(),
        })
    }

    /// Replaces all forces of [`Claim::Forces`] by correctly rounded floats, and `within` by the largest difference that
    /// this makes. Other claims stay as they are.
    ///
    /// # Errors
    /// [`Overflow`](Error::Overflow) if a force is beyond the largest float.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_horizontal::certificate::{Certificate, Claim};
    /// use num_rational::BigRational;
    ///
    /// let rounded = Certificate::of_forces(&Pile::triangular(3)?)?.rounded()?;
    /// let Claim::Forces(forces) = &rounded.claim else { unreachable!() };
    /// // The normal force 5/3 is not a float.
    /// let [least, most] = [1_u64 << 56, 1 << 52].map(|n| BigRational::new(1.into(), n.into()));
    /// assert!(forces.within > least && forces.within < most);
    /// assert_eq!(rounded.check(), Ok(()));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn rounded(mut self) -> Result<Self, Error> {
        if let Claim::Forces(forces) = &mut self.claim {
            let (mut within, mut are_finite) = (forces.within.clone(), true);
            forces.each(
                |force| match BigRational::from_float(f64::from_rational(force)) {
                    Some(float) => {
                        let error = (&float - &*force).abs();
                        if ByValue(&error) > ByValue(&within) {
                            within = error;
                        }
                        *force = float;
                    }
                    None => are_finite = false,
                },
            );
            if !are_finite {
                return Err(Error::overflow("a force of the certificate", "f64"));
            }
            forces.within = within;
        }
        Ok(self)
    }
}
