//! The contacts of a pile with the numbers of their spheres.

use num_bigint::BigUint;
use num_traits::Zero;

use crate::table::{columns, in_pieces, refuse_beyond, slices};
use crate::{Each, Error};
use cannonpile::lattice::{ContactKind, Direction, Row, Site};
use cannonpile::scalar::{Surd, SurdSum};
use cannonpile::shape::{Numbering, Rows, Selection};
use cannonpile::{FloorForce, Layers, Nearest, Packing, Pile};
use cannonpile_stability::RoughPacking;

/// A packing with numbered spheres.
///
/// # Examples
/// ```
/// use cannonpile_dem::NumberedPile;
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
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct NumberedPile<'p> {
    packing: Packing<'p>,
    numbering: Numbering<'p>,
}

/// A contact of a pile with its correctly rounded force.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct NumberedContact {
    /// The numbers of the upper and the lower sphere. For two neighbours, the sphere that names the contact is first.
    pub ids: [u64; 2],
    /// The upper sphere; for two neighbours, the sphere that names the contact.
    pub site: Site,
    /// The direction from this sphere to the other one.
    pub direction: ContactKind,
    /// The force in N, correctly rounded; a positive force is a push. The float is 0 if and only if the exact force is
    /// 0.
    pub force: f64,
    /// The force on the first sphere of `ids` as x, y and z (up), in N and correctly rounded.
    pub vector: [f64; 3],
}

/// The spheres and the direction of a sloping contact.
#[derive(Clone, Copy)]
pub(super) struct Touch {
    pub(super) ids: [u64; 2],
    pub(super) site: Site,
    pub(super) direction: Direction,
}

/// A row of spheres above the floor.
#[derive(Clone, Debug)]
pub struct LinkedRow {
    pub(super) first: Site,
    /// The number of the first sphere.
    pub upper: u64,
    /// The number of spheres in the row; their numbers are consecutive.
    pub spheres: u64,
    /// The contact directions, and for each the number of the sphere below the first sphere.
    pub below: Vec<(Direction, u64)>,
}

impl<'p> NumberedPile<'p> {
    /// Numbers the spheres of a packing.
    ///
    /// # Errors
    /// [`Error::TooManyRows`](cannonpile::Error::TooManyRows) for more than [`MAX_ROWS`](crate::table::MAX_ROWS)
    /// spheres or contacts.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::NumberedPile;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(100_000)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// assert!(NumberedPile::new(&packing).is_err());
    /// # Ok::<(), cannonpile_dem::Error>(())
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

    /// Returns the packing.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::NumberedPile;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let numbered = NumberedPile::new(&packing.with_radius(BigRational::new(1.into(), 100.into()))?)?;
    /// assert_eq!(numbered.packing().radius().to_string(), "1/100");
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn packing(&self) -> &Packing<'p> {
        &self.packing
    }

    /// Returns the numbers of the spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::NumberedPile;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// assert_eq!(NumberedPile::new(&packing)?.numbering().first_on_floor(), 166);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn numbering(&self) -> &Numbering<'p> {
        &self.numbering
    }

    #[doc(hidden)]
    #[must_use]
    pub fn pile(&self) -> &'p Pile {
        self.packing.pile()
    }

    /// Returns the sites of the spheres, in the order of their numbers.
    pub(super) fn sites(&self) -> Result<impl Iterator<Item = Site> + use<'p>, Error> {
        Ok(self.pile().rows(Selection::All)?.flatten())
    }

    /// Returns the sites and the correctly rounded centres of the spheres, in the order of their numbers.
    pub(crate) fn centres(
        &self,
    ) -> Result<impl Iterator<Item = Result<(Site, [f64; 3]), Error>> + use<'p>, Error> {
        let places = self.packing.places::<f64>();
        Ok(in_pieces(self.pile().rows(Selection::All)?, move |piece| {
            let mut centres = columns(piece)?;
            places.fill_row(piece, slices(&mut centres))?;
            let [x, y, z] = centres;
            let centres = x.into_iter().zip(y).zip(z).map(|((x, y), z)| [x, y, z]);
            Ok(piece.clone().into_iter().zip(centres).collect())
        }))
    }

    /// Returns the number of contacts: all sloping contacts, and the horizontal contacts with a force.
    #[doc(hidden)]
    #[must_use]
    pub fn contact_count(&self) -> BigUint {
        self.pile().contact_count() + self.pile().horizontal_forces().len()
    }

    /// Returns the directions and sphere numbers of all contacts, in the order of [`contacts`](Self::contacts).
    pub(super) fn touches(
        &self,
    ) -> Result<impl Iterator<Item = Result<(ContactKind, [u64; 2]), Error>> + '_, Error> {
        let sloping = in_pieces(self.rows_above_the_floor()?, |piece| {
            let touches = self.touches_of(piece)?;
            let touches = touches.map(|touch| (touch.direction.into(), touch.ids));
            Ok(touches.collect())
        });
        let horizontal = self.horizontal();
        Ok(sloping.chain(horizontal.map(|contact| contact.map(|c| (c.direction, c.ids)))))
    }

    /// Returns the centres of both spheres of all contacts, in the order of [`contacts`](Self::contacts).
    pub(crate) fn links(
        &self,
    ) -> Result<impl Iterator<Item = Result<[[f64; 3]; 2], Error>> + '_, Error> {
        let places = self.packing.places::<f64>();
        let shape = self.pile().shape();
        let horizontal = self.pile().horizontal_forces();
        let horizontal = horizontal.map(move |(contact, _)| {
            let neighbour = shape.neighbour(contact)?;
            Ok([self.centre(contact.site)?, self.centre(neighbour)?])
        });
        let sloping = in_pieces(self.rows_above_the_floor()?, move |piece| {
            let centres = |row: &Row| {
                let mut centres = columns(row)?;
                places.fill_row(row, slices(&mut centres))?;
                Ok(centres)
            };
            let upper = centres(piece)?;
            let first = Site {
                i: piece.i.start,
                j: piece.j,
                k: piece.k,
            };
            let below = shape.dimension().directions().iter().map(|direction| {
                let site = shape.below(first, *direction);
                let Site { i, j, k } = site.ok_or_else(|| Error::on_floor(first))?;
                let end = i + (piece.i.end - piece.i.start);
                centres(&Row { k, j, i: i..end })
            });
            let below = below.collect::<Result<Vec<_>, Error>>()?;
            let at = |columns: &[Vec<f64>; 3], n: usize| columns.each_ref().each(|x| x[n]);
            let spheres = 0..upper[0].len();
            let links = spheres.flat_map(|n| below.iter().map(move |lower| (n, lower)));
            Ok(links
                .map(|(n, lower)| [at(&upper, n), at(lower, n)])
                .collect())
        });
        Ok(sloping.chain(horizontal))
    }

    fn centre(&self, site: Site) -> Result<[f64; 3], Error> {
        rounded(&self.packing.position(site)?, "a position")
    }

    /// Returns all contacts with correctly rounded forces, in the order of [`contacts`](Self::contacts).
    pub(super) fn forces(
        &self,
    ) -> Result<impl Iterator<Item = Result<NumberedContact, Error>> + '_, Error> {
        let sloping = self.forces_of(self.packing.layers(Selection::All)?)?;
        Ok(sloping.chain(self.horizontal()))
    }

    fn forces_of(
        &self,
        mut layers: Layers<'p, Nearest<f64>>,
    ) -> Result<impl Iterator<Item = Result<NumberedContact, Error>> + '_, Error> {
        Ok(in_pieces(self.rows_above_the_floor()?, move |piece| {
            let mut forces = columns(piece)?;
            layers.fill_row(piece, slices(&mut forces))?;
            let mut vectors = [columns(piece)?, columns(piece)?, columns(piece)?];
            layers.fill_row_of_vectors(piece, vectors.each_mut().each(slices))?;
            let directions = self.pile().dimension().directions().len();
            let contacts = self.touches_of(piece)?.enumerate().map(|(n, touch)| {
                let (place, line) = (n / directions, touch.direction.index());
                NumberedContact {
                    ids: touch.ids,
                    site: touch.site,
                    direction: touch.direction.into(),
                    force: forces[line][place],
                    vector: vectors.each_ref().each(|component| component[line][place]),
                }
            });
            Ok(contacts.collect())
        }))
    }

    /// Returns the numbers of the bottom spheres, and their correctly rounded forces on the floor.
    pub(super) fn on_floor(
        &self,
    ) -> Result<impl Iterator<Item = Result<(u64, FloorForce<f64>), Error>> + use<'p>, Error> {
        let mut ids = self.numbering.first_on_floor()..;
        let mut layers = self.packing.layers::<f64>(Selection::Base)?;
        let rows = self.pile().rows(Selection::Base)?;
        Ok(in_pieces(rows, move |piece| {
            let mut forces = columns(piece)?;
            layers.fill_row_of_base(piece, slices(&mut forces))?;
            let [normal, x, y] = forces;
            let forces = normal.into_iter().zip(x).zip(y);
            // Sites come first in the zip, so that the end of a piece does not consume a sphere number.
            let spheres = piece.clone().into_iter().zip(ids.by_ref()).zip(forces);
            let forces = spheres.map(|((site, id), ((normal, shear_x), shear_y))| {
                let force = FloorForce {
                    site,
                    normal,
                    shear_x,
                    shear_y,
                };
                (id, force)
            });
            Ok(forces.collect())
        }))
    }

    /// Returns all contacts of a pile on a rough floor with their normal forces, and the tangential force on the upper
    /// sphere, in N. Each component is correctly rounded.
    pub(super) fn rough_contacts(
        &self,
    ) -> Result<impl Iterator<Item = Result<(NumberedContact, [f64; 3]), Error>> + '_, Error> {
        let contacts = RoughPacking::new(&self.packing)?.contacts(Selection::All)?;
        Ok(self.touches()?.zip(contacts).map(|(touch, contact)| {
            let ((direction, ids), contact) = (touch?, contact?);
            let normal = NumberedContact {
                ids,
                site: contact.site,
                direction,
                force: nearest(&contact.normal.into(), FORCE)?,
                vector: rounded(&contact.normal_vector, FORCE)?,
            };
            Ok((normal, all_rounded(&contact.tangential_vector)?))
        }))
    }

    /// Returns the numbers of the bottom spheres on a rough floor, and the forces of the floor on them, in N and correctly
    /// rounded.
    pub(super) fn of_rough_floor(
        &self,
    ) -> Result<impl Iterator<Item = Result<(u64, [f64; 3]), Error>> + use<'p>, Error> {
        let forces = RoughPacking::new(&self.packing)?.base(Selection::Base)?;
        let ids = self.numbering.first_on_floor()..;
        Ok(ids.zip(forces).map(|(id, force)| {
            let force = force?;
            let [x, y, normal] = all_rounded(&[force.shear_x, force.shear_y, force.normal])?;
            // The subtraction yields 0, never −0.
            Ok((id, [0.0 - x, 0.0 - y, normal]))
        }))
    }

    /// Returns the horizontal contacts with a force, in the order of the tables.
    pub(crate) fn horizontal(
        &self,
    ) -> impl Iterator<Item = Result<NumberedContact, Error>> + use<'_, 'p> {
        let pile = self.pile();
        pile.horizontal_forces().map(move |(contact, force)| {
            let neighbour = pile.shape().neighbour(contact)?;
            let packed = self.packing.horizontal_contact_in_si(contact, force)?;
            let contact = NumberedContact {
                ids: [
                    self.numbering.id(contact.site)?,
                    self.numbering.id(neighbour)?,
                ],
                site: contact.site,
                direction: contact.axis.into(),
                force: nearest(&packed.force, FORCE)?,
                vector: rounded(&packed.vector, FORCE)?,
            };
            contact.checked()
        })
    }

    pub(super) fn rows_above_the_floor(&self) -> Result<Rows<'p>, Error> {
        Ok(self.pile().rows(Selection::All)?.off_the_floor())
    }

    /// Returns the rows above the floor, with the numbers of their spheres and of the spheres below.
    ///
    /// # Errors
    /// The errors of [`Pile::rows`].
    #[doc(hidden)]
    pub fn linked_rows(
        &self,
    ) -> Result<impl Iterator<Item = Result<LinkedRow, Error>> + '_, Error> {
        let rows = self.rows_above_the_floor()?;
        Ok(rows.map(|row| self.linked(&row)))
    }

    /// Returns the numbers of a row of spheres, and of the spheres below.
    fn linked(&self, row: &Row) -> Result<LinkedRow, Error> {
        LinkedRow::of(&self.numbering, row)
    }

    /// Returns the contacts of a row of spheres with the spheres below.
    fn touches_of(&self, row: &Row) -> Result<impl Iterator<Item = Touch> + use<>, Error> {
        let LinkedRow {
            first,
            upper,
            spheres,
            below,
        } = self.linked(row)?;
        let contacts = 0..spheres * below.len() as u64;
        Ok(contacts.filter_map(move |n| {
            let (done, direction) = (n / below.len() as u64, n % below.len() as u64);
            // The remainder is a valid index, so the conversion succeeds.
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

    /// Iterates over all contacts in the order of their upper spheres, and then over the horizontal contacts with a
    /// force.
    ///
    /// # Errors
    /// [`Error::TooLarge`](cannonpile::Error::TooLarge) if the forces need a sweep and a layer does not fit in memory.
    /// For a single contact, [`Error::Overflow`](cannonpile::Error::Overflow) if its force is not 0 and exceeds the
    /// normal range of `f64`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::NumberedPile;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let contacts = NumberedPile::new(&packing)?.contacts()?.collect::<Result<Vec<_>, _>>()?;
    /// assert_eq!(contacts[2].ids, [1, 4]);
    /// assert_eq!(contacts[2].force, 0.46225016352102427);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn contacts(&self) -> Result<impl Iterator<Item = Result<NumberedContact, Error>>, Error> {
        let layers = self.packing.layers::<f64>(Selection::All)?;
        let keeps_digits = layers.keeps_digits();
        let sloping = self.forces_of(layers)?.map(move |contact| {
            let contact = contact?;
            let Some(direction) = contact.direction.direction().filter(|_| !keeps_digits) else {
                return Ok(contact);
            };
            let exact = || self.packing.contact(contact.site, direction);
            if contact.force.is_normal() || exact()?.coefficient().is_zero() {
                return Ok(contact);
            }
            contact.checked()
        });
        Ok(sloping.chain(self.horizontal()))
    }
}

impl LinkedRow {
    /// Returns the numbers of a row of spheres, and of the spheres below. Along a row both are consecutive.
    ///
    /// # Errors
    /// Those of [`Numbering::id`], for a row that is not of the pile or is on the floor.
    pub fn of(numbering: &Numbering<'_>, row: &Row) -> Result<Self, Error> {
        let shape = numbering.shape();
        let at = |i| Site {
            i,
            j: row.j,
            k: row.k,
        };
        let first = at(row.i.start);
        let upper = numbering.id(first)?;
        let below = shape.dimension().directions().iter().map(|direction| {
            let below = shape.below(first, *direction);
            let below = below.ok_or_else(|| Error::on_floor(first))?;
            Ok((*direction, numbering.id(below)?))
        });
        Ok(Self {
            first,
            upper,
            spheres: numbering.id(at(row.i.end - 1))? - upper + 1,
            below: below.collect::<Result<_, Error>>()?,
        })
    }
}

impl NumberedContact {
    /// Returns the contact as seen from the sphere with the smaller number.
    pub(crate) fn in_order(self) -> Self {
        let [first, second] = self.ids;
        if first < second {
            return self;
        }
        Self {
            ids: [second, first],
            // The subtraction yields 0, never −0.
            vector: self.vector.each(|component| 0.0 - component),
            ..self
        }
    }

    /// Returns the contact if its force is a normal float.
    fn checked(self) -> Result<Self, Error> {
        if self.force.is_normal() {
            return Ok(self);
        }
        let (quantity, scalar) = (FORCE, "f64");
        Err(Error::overflow(quantity, scalar))
    }
}

const FORCE: &str = "a contact force";

/// Returns the correctly rounded components of a vector.
///
/// # Errors
/// As for [`nearest`].
pub fn rounded<const N: usize>(
    vector: &[Surd; N],
    quantity: &'static str,
) -> Result<[f64; N], Error> {
    let mut floats = [0.0; N];
    for (float, exact) in floats.iter_mut().zip(vector) {
        *float = nearest(exact, quantity)?;
    }
    Ok(floats)
}

/// Iterates over the stress of all spheres times the volume of a sphere, in N·m and correctly rounded.
///
/// # Errors
/// The errors of [`Forces::stresses`](cannonpile::Forces::stresses).
pub fn stresses<'p>(
    packing: &Packing<'p>,
) -> Result<impl Iterator<Item = Result<[f64; 6], Error>> + use<'p>, Error> {
    let (packing, stresses) = (packing.clone(), packing.forces().stresses(Selection::All)?);
    Ok(stresses.map(move |stress| rounded(&packing.stress_in_si(&stress?), "a stress")))
}

/// Returns the correctly rounded components of a sum of vectors, with 0 instead of −0.
pub(super) fn all_rounded<const N: usize>(vector: &[SurdSum; N]) -> Result<[f64; N], Error> {
    let mut rounded = [0.0; N];
    for (rounded, exact) in rounded.iter_mut().zip(vector) {
        let nearest = exact.nearest::<f64>();
        *rounded = 0.0 + nearest.ok_or_else(|| Error::overflow(FORCE, "f64"))?;
    }
    Ok(rounded)
}

/// Returns a number correctly rounded. The error of an overflow contains `quantity`.
///
/// # Errors
/// [`Error::Overflow`](cannonpile::Error::Overflow) if the number is outside the range of `f64`.
pub fn nearest(number: &Surd, quantity: &'static str) -> Result<f64, Error> {
    let scalar = "f64";
    number
        .nearest()
        .ok_or_else(|| Error::overflow(quantity, scalar))
}
