//! A whole pile in slices provided by the caller.

mod forces;
mod places;

use num_traits::ToPrimitive;

use super::numbered::{LinkedRow, rounded, stresses};
use crate::table::{columns, slices};
use crate::{Each, Error};
use cannonpile::lattice::{Direction, Site};
use cannonpile::shape::{Numbering, Selection};
use cannonpile::{Interrupt, PackedContact, Packing, Pile};
use places::{check_length, pieces, put, put_vectors};

/// The spheres and contacts of a pile as numbers in slices, in the order of the exported files.
///
/// Spheres are in the order of their numbers: from 1, row by row from the top. Contacts are ordered by their upper
/// sphere and then by direction α, β, γ. Horizontal contacts with a force follow at the end. Floats are correctly
/// rounded.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_dem::PileArrays;
///
/// let pile = Pile::triangular(10)?;
/// let arrays = PileArrays::of_pile(&pile)?;
/// let mut ids = vec![[0_u32; 2]; arrays.contacts()];
/// let mut forces = vec![0.0; arrays.contacts()];
/// arrays.fill_ids(&mut ids)?;
/// arrays.fill_forces(&mut forces)?;
/// // Sphere 1 is the apex; its contacts bear f₀.
/// assert_eq!((ids[2], forces[2]), ([1, 4], 1.0));
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PileArrays<'p> {
    pile: &'p Pile,
    packing: Option<Packing<'p>>,
    numbering: Numbering<'p>,
    spheres: usize,
    contacts: usize,
}

impl<'p> PileArrays<'p> {
    /// Returns the arrays of a pile. Forces are multiples of f₀ and mg.
    ///
    /// # Errors
    /// [`Error::TooLarge`](cannonpile::Error::TooLarge) if the pile has too many spheres to number them.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::PileArrays;
    ///
    /// let pile = Pile::discs(4)?;
    /// let arrays = PileArrays::of_pile(&pile)?;
    /// assert_eq!((arrays.spheres(), arrays.contacts()), (10, 12));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn of_pile(pile: &'p Pile) -> Result<Self, Error> {
        let numbering = pile.numbering()?;
        let contacts = pile.contact_count() + pile.horizontal_forces().len();
        let in_memory = |count: Option<usize>| {
            count.ok_or_else(|| {
                Error::beyond_addresses("all spheres and contacts of a pile", contacts.clone())
            })
        };
        Ok(Self {
            spheres: in_memory(numbering.sphere_count().to_usize())?,
            contacts: in_memory(contacts.to_usize())?,
            pile,
            packing: None,
            numbering,
        })
    }

    /// Returns the arrays of a packing. Forces are in N.
    ///
    /// # Errors
    /// As for [`of_pile`](Self::of_pile).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::PileArrays;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(2)?;
    /// let arrays = PileArrays::of_packing(&Packing::new(&pile, &"1.2".parse()?)?)?;
    /// let mut forces = [0.0; 3];
    /// arrays.fill_forces(&mut forces)?;
    /// assert_eq!(forces, [0.46225016352102427; 3]);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn of_packing(packing: &Packing<'p>) -> Result<Self, Error> {
        Ok(Self {
            packing: Some(packing.clone()),
            ..Self::of_pile(packing.pile())?
        })
    }

    /// Returns the number of spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::PileArrays;
    ///
    /// assert_eq!(PileArrays::of_pile(&Pile::triangular(10)?)?.spheres(), 220);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn spheres(&self) -> usize {
        self.spheres
    }

    /// Returns the number of contacts: all sloping contacts, and the horizontal contacts with a force.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::PileArrays;
    /// use cannonpile::lattice::{Axis, HorizontalContact, Region, Site};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
    /// assert_eq!(PileArrays::of_pile(&pile)?.contacts(), 126);
    /// let contact = HorizontalContact { site: Site { i: 0, j: 0, k: 1 }, axis: Axis::AlphaBeta };
    /// let pressed = pile.with_horizontal_force(contact, BigRational::from_integer(1.into()))?;
    /// assert_eq!(PileArrays::of_pile(&pressed)?.contacts(), 127);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn contacts(&self) -> usize {
        self.contacts
    }

    /// Writes the sites of all spheres as k, i, j.
    ///
    /// # Errors
    /// [`Error::Length`](cannonpile::Error::Length) for a slice of another length;
    /// [`Error::Overflow`](cannonpile::Error::Overflow) for a coordinate that does not fit in `V`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::PileArrays;
    ///
    /// let mut sites = [[0_i64; 3]; 4];
    /// PileArrays::of_pile(&Pile::triangular(2)?)?.fill_sites(&mut sites)?;
    /// assert_eq!(sites, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 0, 1]]);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn fill_sites<V: TryFrom<i128>>(&self, sites: &mut [[V; 3]]) -> Result<(), Error> {
        check_length(self.spheres, sites)?;
        let mut left = sites.iter_mut();
        for row in self.pile.rows(Selection::All)? {
            Interrupt::check()?;
            for Site { i, j, k } in row {
                put(&mut left, [whole(k)?, whole(i)?, whole(j)?]);
            }
        }
        Ok(())
    }

    /// Writes the centres of all spheres, in m, z up.
    ///
    /// # Errors
    /// [`Error::Length`](cannonpile::Error::Length) for a slice of another length; [`Error::NeedsUnits`] for the arrays
    /// of a pile; [`Error::Overflow`](cannonpile::Error::Overflow) for a position outside the range of `f64`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::PileArrays;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let mut centres = [[0.0; 3]; 3];
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// PileArrays::of_packing(&packing)?.fill_centres(&mut centres)?;
    /// assert_eq!(centres, [[0.0, 0.0, 1.6], [-1.2, 0.0, 0.0], [1.2, 0.0, 0.0]]);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn fill_centres(&self, centres: &mut [[f64; 3]]) -> Result<(), Error> {
        check_length(self.spheres, centres)?;
        let places = self.packing("positions")?.places::<f64>();
        let mut left = centres.iter_mut();
        for piece in pieces(self.pile.rows(Selection::All)?) {
            let mut found = columns(&piece)?;
            places.fill_row(&piece, slices(&mut found))?;
            put_vectors(&[found], &mut left);
        }
        Ok(())
    }

    /// Writes the numbers of the two spheres of each contact, the upper sphere first.
    ///
    /// # Errors
    /// [`Error::Length`](cannonpile::Error::Length) for a slice of another length;
    /// [`Error::Overflow`](cannonpile::Error::Overflow) for a sphere number that does not fit in `V`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_dem::PileArrays;
    ///
    /// let mut ids = [[0_i64; 2]; 3];
    /// PileArrays::of_pile(&Pile::triangular(2)?)?.fill_ids(&mut ids)?;
    /// assert_eq!(ids, [[1, 2], [1, 3], [1, 4]]);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn fill_ids<V: TryFrom<u64>>(&self, ids: &mut [[V; 2]]) -> Result<(), Error> {
        check_length(self.contacts, ids)?;
        let mut left = ids.iter_mut();
        for row in self.pile.rows(Selection::All)?.off_the_floor() {
            Interrupt::check()?;
            let row = LinkedRow::of(&self.numbering, &row)?;
            for n in 0..row.spheres {
                for (_, below) in &row.below {
                    put(&mut left, [number(row.upper + n)?, number(below + n)?]);
                }
            }
        }
        for (contact, _) in self.pile.horizontal_forces() {
            let neighbour = self.pile.shape().neighbour(contact)?;
            let [one, other] = [contact.site, neighbour].each(|site| self.numbering.id(site));
            put(&mut left, [number(one?)?, number(other?)?]);
        }
        Ok(())
    }

    /// Writes the contact points of all contacts, in m.
    ///
    /// # Errors
    /// As for [`fill_centres`](Self::fill_centres).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::PileArrays;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let mut points = [[0.0; 3]; 2];
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// PileArrays::of_packing(&packing)?.fill_points(&mut points)?;
    /// assert_eq!(points, [[-0.6, 0.0, 0.8], [0.6, 0.0, 0.8]]);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn fill_points(&self, points: &mut [[f64; 3]]) -> Result<(), Error> {
        check_length(self.contacts, points)?;
        let packing = self.packing("positions")?;
        let places = packing.places::<f64>();
        let directions = self.directions();
        let mut left = points.iter_mut();
        for piece in pieces(self.pile.rows(Selection::All)?.off_the_floor()) {
            let found = directions.iter().map(|direction| {
                let mut found = columns(&piece)?;
                places.fill_row_of_contacts(&piece, *direction, slices(&mut found))?;
                Ok(found)
            });
            put_vectors(&found.collect::<Result<Vec<_>, Error>>()?, &mut left);
        }
        self.put_horizontal(left, |contact| rounded(&contact.point, "a position"))
    }

    /// Writes the stress of all spheres times the volume of a sphere, in N·m: xx, yy, zz, xy, xz, yz, as
    /// [`Packing::stress`] defines them.
    ///
    /// # Errors
    /// As for [`fill_centres`](Self::fill_centres).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::PileArrays;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let mut stresses = [[0.0; 6]; 3];
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// PileArrays::of_packing(&packing)?.fill_stresses(&mut stresses)?;
    /// assert_eq!(stresses[0], [0.45, 0.0, 0.8, 0.0, 0.0, 0.0]);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn fill_stresses(&self, places: &mut [[f64; 6]]) -> Result<(), Error> {
        check_length(self.spheres, places)?;
        let packing = self.packing("contact vectors")?;
        for (place, stress) in places.iter_mut().zip(stresses(packing)?) {
            Interrupt::check()?;
            *place = stress?;
        }
        Ok(())
    }

    fn packing(&self, quantity: &'static str) -> Result<&Packing<'p>, Error> {
        let packing = self.packing.as_ref();
        packing.ok_or(Error::NeedsUnits { quantity })
    }

    fn directions(&self) -> &'static [Direction] {
        self.pile.dimension().directions()
    }

    fn put_horizontal(
        &self,
        left: core::slice::IterMut<'_, [f64; 3]>,
        of: impl Fn(&PackedContact) -> Result<[f64; 3], Error>,
    ) -> Result<(), Error> {
        let packing = self.packing("contact vectors")?;
        let contacts = self.pile.horizontal_forces();
        for (place, (contact, force)) in left.zip(contacts) {
            *place = of(&packing.horizontal_contact_in_si(contact, force)?)?;
        }
        Ok(())
    }
}

fn whole<V: TryFrom<i128>>(coordinate: i128) -> Result<V, Error> {
    V::try_from(coordinate).map_err(|_| overflow::<V>("a coordinate of a sphere"))
}

fn number<V: TryFrom<u64>>(id: u64) -> Result<V, Error> {
    V::try_from(id).map_err(|_| overflow::<V>("the number of a sphere"))
}

fn overflow<V>(quantity: &'static str) -> Error {
    let scalar = core::any::type_name::<V>();
    Error::overflow(quantity, scalar)
}
