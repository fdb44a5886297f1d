//! Lists of a card: contacts, spheres, forces on the floor.

use num_rational::BigRational;

use super::extremes::Extreme;
use super::value::{FORCE, Value};
use crate::Error;
use crate::numbered::NumberedPile;
use cannonpile::lattice::{Axis, ContactKind, HorizontalContact, Site};
use cannonpile::shape::Selection;

/// The longest lists of a card.
#[derive(Clone, Copy)]
pub(super) struct Listed {
    /// The most contacts, and the most spheres.
    pub(super) most: u32,
}

impl Listed {
    pub(super) const FOR_PEOPLE: Self = Self { most: 130 };
    pub(super) const FOR_MACHINES: Self = Self { most: 10_000 };
}

/// A contact and its force.
#[derive(Clone)]
pub(super) struct Contact {
    pub(super) ids: [u64; 2],
    pub(super) site: Site,
    pub(super) link: ContactKind,
    /// In f₀.
    pub(super) multiple: String,
    /// In N.
    pub(super) force: Value,
}

/// A sphere and its centre.
pub(super) struct Sphere {
    pub(super) id: u64,
    pub(super) site: Site,
    pub(super) centre: [Value; 3],
}

/// A bottom sphere and its force on the floor.
pub(super) struct OnFloor {
    pub(super) id: u64,
    pub(super) site: Site,
    pub(super) normal: Value,
    pub(super) shear: [Value; 2],
}

pub(super) fn contact(numbered: &NumberedPile<'_>, found: Extreme) -> Result<Contact, Error> {
    let Extreme { site, link, force } = found;
    let (shape, numbering) = (numbered.pile().shape(), numbered.numbering());
    let other = match link {
        ContactKind::Sloping(direction) => shape
            .below(site, direction)
            .ok_or_else(|| Error::on_floor(site))?,
        ContactKind::Horizontal(axis) => shape.neighbour(HorizontalContact { site, axis })?,
    };
    let newtons = numbered.packing().unit_force().scaled(&force);
    Ok(Contact {
        ids: [numbering.id(site)?, numbering.id(other)?],
        site,
        link,
        multiple: force.to_string(),
        force: Value::new(&newtons, FORCE)?,
    })
}

/// All contacts, in the order of `contacts.csv`.
pub(super) fn contacts(numbered: &NumberedPile<'_>) -> Result<Vec<Contact>, Error> {
    let pile = numbered.pile();
    let sloping = pile.forces::<BigRational>().contacts(Selection::All)?;
    let sloping = sloping.map(|found| {
        let found = found?;
        Ok::<_, Error>(Extreme {
            site: found.site,
            link: found.direction.into(),
            force: found.force,
        })
    });
    let horizontal = pile.horizontal_forces().map(|(contact, force)| {
        let axis: Axis = contact.axis;
        Ok(Extreme {
            site: contact.site,
            link: axis.into(),
            force: force.clone(),
        })
    });
    let all = sloping.chain(horizontal);
    all.map(|found| contact(numbered, found?)).collect()
}

pub(super) fn spheres(numbered: &NumberedPile<'_>) -> Result<Vec<Sphere>, Error> {
    let all = (1_u64..).zip(numbered.sites()?);
    let all = all.map(|(id, site)| {
        let [x, y, z] = numbered.packing().position(site)?;
        let value = |x| Value::new(x, "a position");
        Ok(Sphere {
            id,
            site,
            centre: [value(&x)?, value(&y)?, value(&z)?],
        })
    });
    all.collect()
}

pub(super) fn base(numbered: &NumberedPile<'_>) -> Result<Vec<OnFloor>, Error> {
    let forces = numbered.packing().base(Selection::Base)?;
    let all = (numbered.numbering().first_on_floor()..).zip(forces);
    let all = all.map(|(id, force)| {
        let force = force?;
        let value = |x| Value::new(x, "a force on the floor");
        Ok(OnFloor {
            id,
            site: force.site,
            normal: value(&force.normal)?,
            shear: [value(&force.shear_x)?, value(&force.shear_y)?],
        })
    });
    all.collect()
}
