//! All spheres and contacts of a pile as numbers in slices, in the order of the exported files.
//!
//! Spheres are in the order of their numbers: from 1, row by row from the top. Contacts are ordered by their upper
//! sphere and then by direction α, β, γ. Horizontal contacts with a force follow at the end. Floats are correctly
//! rounded.

mod forces;
mod places;

use cannonpile::engine::bug;
use cannonpile::lattice::{Direction, Site};
use cannonpile::shape::{Numbering, Selection};
use cannonpile::{Interrupt, PackedContact, Packing, Pile};
use cannonpile_dem::numbered::{LinkedRow, rounded, stresses};
use num_traits::ToPrimitive;

use crate::error::Error;
use places::{columns, pieces, put, put_vectors, slices};

/// A pile whose numbers are written into slices with one entry per sphere, per contact or per bottom sphere.
pub(crate) struct Numbers<'p> {
    pile: &'p Pile,
    /// The sizes, for numbers in SI units.
    packing: Option<Packing<'p>>,
    numbering: Numbering<'p>,
    /// The number of spheres.
    pub(crate) spheres: usize,
    /// The number of contacts: all sloping contacts, and the horizontal contacts with a force.
    pub(crate) contacts: usize,
}

impl<'p> Numbers<'p> {
    /// Returns the numbers of a pile. Forces are multiples of f₀ and mg.
    pub(crate) fn of_pile(pile: &'p Pile) -> Result<Self, Error> {
        let numbering = pile.numbering()?;
        let contacts = pile.contact_count() + pile.horizontal_forces().len();
        let in_memory = |count: Option<usize>| {
            count.ok_or_else(|| cannonpile::Error::TooLarge {
                quantity: "all spheres and contacts of a pile",
                needed: contacts.clone(),
                limit: usize::MAX as u64,
                remedy: "use fewer layers, or a smaller top or base",
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

    /// Returns the numbers of a packing. Forces are in N.
    pub(crate) fn of_packing(packing: Packing<'p>) -> Result<Self, Error> {
        let numbers = Self::of_pile(packing.pile())?;
        Ok(Self {
            packing: Some(packing),
            ..numbers
        })
    }

    /// Writes the sites of all spheres as k, i, j.
    pub(crate) fn fill_sites(&self, sites: &mut [[i64; 3]]) -> Result<(), Error> {
        let mut left = sites.iter_mut();
        for row in self.pile.rows(Selection::All)? {
            Interrupt::check()?;
            for Site { i, j, k } in row {
                let whole = |coordinate| integer(coordinate, "a coordinate of a sphere");
                put(&mut left, [whole(k)?, whole(i)?, whole(j)?]);
            }
        }
        Ok(())
    }

    /// Writes the centres of all spheres, in m, z up.
    pub(crate) fn fill_centres(&self, centres: &mut [[f64; 3]]) -> Result<(), Error> {
        let places = self.in_si()?.places::<f64>();
        let mut left = centres.iter_mut();
        for piece in pieces(self.pile.rows(Selection::All)?) {
            let mut found = columns(piece.length()?);
            places.fill_row(&piece, slices(&mut found))?;
            put_vectors(&[found], &mut left);
        }
        Ok(())
    }

    /// Writes the numbers of the two spheres of each contact, the upper sphere first.
    pub(crate) fn fill_ids(&self, ids: &mut [[i64; 2]]) -> Result<(), Error> {
        let number = |id: u64| integer(id, "the number of a sphere");
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
            let [one, other] = [contact.site, neighbour].map(|site| self.numbering.id(site));
            put(&mut left, [number(one?)?, number(other?)?]);
        }
        Ok(())
    }

    /// Writes the contact points of all contacts, in m.
    pub(crate) fn fill_points(&self, points: &mut [[f64; 3]]) -> Result<(), Error> {
        let places = self.in_si()?.places::<f64>();
        let directions = self.directions();
        let mut left = points.iter_mut();
        for piece in pieces(self.pile.rows(Selection::All)?.off_the_floor()) {
            let found = directions.iter().map(|direction| {
                let mut found = columns(piece.length()?);
                places.fill_row_of_contacts(&piece, *direction, slices(&mut found))?;
                Ok(found)
            });
            put_vectors(&found.collect::<Result<Vec<_>, Error>>()?, &mut left);
        }
        self.put_horizontal(left, |contact| Ok(rounded(&contact.point, "a position")?))
    }

    /// Writes the stress of all spheres times the volume of a sphere, in N·m: xx, yy, zz, xy, xz, yz, as
    /// [`Packing::stress`] defines them.
    pub(crate) fn fill_stresses(&self, places: &mut [[f64; 6]]) -> Result<(), Error> {
        for (place, stress) in places.iter_mut().zip(stresses(self.in_si()?)?) {
            Interrupt::check()?;
            *place = stress?;
        }
        Ok(())
    }

    fn in_si(&self) -> Result<&Packing<'p>, Error> {
        let packing = self.packing.as_ref();
        Ok(packing.ok_or_else(|| bug("numbers in metres and newtons are those of a packing"))?)
    }

    fn directions(&self) -> &'static [Direction] {
        self.pile.dimension().directions()
    }

    fn put_horizontal(
        &self,
        left: core::slice::IterMut<'_, [f64; 3]>,
        of: impl Fn(&PackedContact) -> Result<[f64; 3], Error>,
    ) -> Result<(), Error> {
        let packing = self.in_si()?;
        let contacts = self.pile.horizontal_forces();
        for (place, (contact, force)) in left.zip(contacts) {
            *place = of(&packing.horizontal_contact_in_si(contact, force)?)?;
        }
        Ok(())
    }
}

fn integer(number: impl TryInto<i64>, quantity: &'static str) -> Result<i64, Error> {
    let fitted = number.try_into();
    fitted.map_err(|_| cannonpile::Error::overflow(quantity, "i64").into())
}
