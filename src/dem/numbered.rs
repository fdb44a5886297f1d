//! The contacts of a pile with the numbers of their spheres.

use num_traits::Zero;

use crate::lattice::{Direction, Row, Site};
use crate::scalar::Surd;
use crate::shape::{Numbering, Selection};
use crate::table::{Forces, Places, refuse_beyond};
use crate::{Error, Packing, Pile};

/// A packing, and the numbers of its spheres.
///
/// # Examples
/// ```
/// use cannonpile::dem::NumberedPile;
/// use cannonpile::geometry::Spacing;
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
/// let numbered = NumberedPile::new(&packing)?;
/// for contact in numbered.contacts()? {
///     let contact = contact?;
///     println!("{:?}: {} N", contact.ids, contact.force);
/// }
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct NumberedPile<'p> {
    packing: Packing<'p>,
    numbering: Numbering<'p>,
}

/// A contact of a pile, its force rounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NumberedContact {
    /// The numbers of the upper sphere and of the lower one, which is the greater.
    pub ids: [u64; 2],
    /// The upper sphere.
    pub site: Site,
    /// The direction in which the lower one lies.
    pub direction: Direction,
    /// The float nearest to the force in N; positive is push. It is 0 if and only if the force is.
    pub force: f64,
    /// The floats nearest to x, y and z (up) of the force on the upper sphere, in N.
    pub vector: [f64; 3],
}

/// Where a contact is.
#[derive(Clone, Copy)]
pub(super) struct Touch {
    pub(super) ids: [u64; 2],
    pub(super) site: Site,
    pub(super) direction: Direction,
}

/// What makes a float of a length.
type Rounding = fn(&Surd) -> Result<f64, Error>;

impl<'p> NumberedPile<'p> {
    /// Numbers the spheres of a packing.
    ///
    /// # Errors
    /// [`Error::TooManyRows`] for more than [`MAX_ROWS`](crate::table::MAX_ROWS) spheres or contacts.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::NumberedPile;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(100_000)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// assert!(NumberedPile::new(&packing).is_err());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(packing: &Packing<'p>) -> Result<Self, Error> {
        let pile = packing.pile();
        let remedy = "use fewer layers, or a smaller top or base";
        refuse_beyond(&pile.sphere_count().max(pile.contact_count()), remedy)?;
        Ok(Self {
            numbering: pile.numbering()?,
            packing: packing.clone(),
        })
    }

    /// The packing.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::NumberedPile;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let numbered = NumberedPile::new(&packing.with_radius(BigRational::new(1.into(), 100.into()))?)?;
    /// assert_eq!(numbered.packing().radius().to_string(), "1/100");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn packing(&self) -> &Packing<'p> {
        &self.packing
    }

    /// The numbers of the spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::NumberedPile;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// assert_eq!(NumberedPile::new(&packing)?.numbering().first_on_floor(), 166);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn numbering(&self) -> &Numbering<'p> {
        &self.numbering
    }

    pub(super) fn pile(&self) -> &'p Pile {
        self.packing.pile()
    }

    /// The spheres, in the order of their numbers.
    pub(super) fn sites(&self) -> Result<impl Iterator<Item = Site> + use<'p>, Error> {
        Ok(self.pile().rows(Selection::All)?.flatten())
    }

    /// The centres of spheres as the nearest floats.
    pub(super) fn centres(&self) -> Places<'p, f64, Rounding> {
        Places::new(&self.packing, |length| nearest(length, "a position"))
    }

    /// All contacts in the order of the upper spheres, without their forces.
    pub(super) fn touches(&self) -> Result<impl Iterator<Item = Result<Touch, Error>> + '_, Error> {
        let rows = self.pile().rows(Selection::All)?.off_the_floor();
        Ok(
            rows.flat_map(|row| -> Box<dyn Iterator<Item = Result<Touch, Error>>> {
                match self.touches_of(&row) {
                    Ok(touches) => Box::new(touches.map(Ok)),
                    Err(error) => Box::new(core::iter::once(Err(error))),
                }
            }),
        )
    }

    /// The contacts of a row of spheres with those below: along it their numbers follow each other.
    fn touches_of(&self, row: &Row) -> Result<impl Iterator<Item = Touch> + use<>, Error> {
        let (shape, numbering) = (self.pile().shape(), &self.numbering);
        let at = |i| Site {
            i,
            j: row.j,
            k: row.k,
        };
        let first = at(row.i.start);
        let upper = numbering.id(first)?;
        let spheres = numbering.id(at(row.i.end - 1))? - upper + 1;
        let below = shape.dimension().directions().iter().map(|direction| {
            let below = shape.below(first, *direction);
            let below = below.ok_or(Error::OnFloor { site: first })?;
            Ok((*direction, numbering.id(below)?))
        });
        let below = below.collect::<Result<Vec<_>, Error>>()?;
        let contacts = 0..spheres * below.len() as u64;
        Ok(contacts.filter_map(move |n| {
            let (done, direction) = (n / below.len() as u64, n % below.len() as u64);
            // One of so many.
            let (direction, lower) = below.get(usize::try_from(direction).ok()?)?;
            Some(Touch {
                ids: [upper + done, lower + done],
                site: Site {
                    i: first.i + i128::from(done),
                    ..first
                },
                direction: *direction,
            })
        }))
    }

    /// All contacts, with what `make` makes of the magnitude of a force and its vector on the upper sphere: once of each
    /// distinct force.
    pub(super) fn contacts_as<V: Clone>(
        &self,
        make: impl Fn(&Surd, &[Surd; 3]) -> Result<V, Error>,
    ) -> Result<impl Iterator<Item = Result<(Touch, V), Error>>, Error> {
        let multiples = self.packing.forces().contacts(Selection::All)?;
        let mut forces = Forces::new(&self.packing, make);
        Ok(self
            .touches()?
            .zip(multiples)
            .map(move |(touch, multiple)| {
                let (touch, multiple) = (touch?, multiple?);
                let force = forces.of(touch.site, touch.direction, multiple.force)?;
                Ok((touch, force.clone()))
            }))
    }

    /// All contacts in the order of the upper spheres, made one by one.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if a layer does not fit in memory where forces have to be swept. Of a contact
    /// [`Error::Overflow`] if its force is not 0 and no normal `f64` is near to it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::dem::NumberedPile;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let contacts = NumberedPile::new(&packing)?.contacts()?.collect::<Result<Vec<_>, _>>()?;
    /// assert_eq!(contacts[2].ids, [1, 4]);
    /// assert_eq!(contacts[2].force, 0.46225016352102427);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn contacts(&self) -> Result<impl Iterator<Item = Result<NumberedContact, Error>>, Error> {
        let quantity = "a contact force";
        let contacts = self.contacts_as(move |force, vector| {
            let rounded = nearest(force, quantity)?;
            if !rounded.is_normal() && !force.coefficient().is_zero() {
                let scalar = "f64";
                return Err(Error::Overflow { quantity, scalar });
            }
            let [x, y, z] = vector.each_ref().map(|x| nearest(x, quantity));
            Ok((rounded, [x?, y?, z?]))
        })?;
        Ok(contacts.map(|contact| {
            let (touch, (force, vector)) = contact?;
            Ok(NumberedContact {
                ids: touch.ids,
                site: touch.site,
                direction: touch.direction,
                force,
                vector,
            })
        }))
    }
}

/// The nearest float; `quantity` is named if there is none.
pub(super) fn nearest(number: &Surd, quantity: &'static str) -> Result<f64, Error> {
    let scalar = "f64";
    number.nearest().ok_or(Error::Overflow { quantity, scalar })
}
