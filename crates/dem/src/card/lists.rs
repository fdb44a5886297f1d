//! Records of a card: numbers, contacts, spheres and forces on the floor.

use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::One;
use serde_json::{Value as Json, json};

use super::extremes::Extreme;
use crate::Error;
use crate::derivatives::derivatives;
use crate::json::placed;
use crate::numbered::{NumberedPile, nearest};
use cannonpile::lattice::{ContactKind, HorizontalContact};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;

/// The maximal number of derivatives that `card.json` lists.
const MOST_DERIVATIVES: u32 = 10_000;

pub(super) const FORCE: &str = "a contact force";

/// Returns an exact number with its correctly rounded float.
pub(super) fn value(number: &Surd, quantity: &'static str) -> Result<Json, Error> {
    // Adding 0 turns −0 into 0.
    let float = nearest(number, quantity)? + 0.0;
    Ok(json!({"exact": number.to_string(), "float": float}))
}

pub(super) fn rational(number: BigRational, quantity: &'static str) -> Result<Json, Error> {
    value(&number.into(), quantity)
}

pub(super) fn contact(numbered: &NumberedPile<'_>, found: &Extreme) -> Result<Json, Error> {
    let (site, link, force) = (found.site, found.link, &found.force);
    let (pile, numbering) = (numbered.pile(), numbered.numbering());
    let other = match link {
        ContactKind::Sloping(direction) => {
            let below = pile.shape().below(site, direction);
            below.ok_or_else(|| Error::on_floor(site))?
        }
        ContactKind::Horizontal(axis) => {
            pile.shape().neighbour(HorizontalContact { site, axis })?
        }
    };
    let newtons = numbered.packing().unit_force().scaled(force);
    let ids = json!({"id1": numbering.id(site)?, "id2": numbering.id(other)?});
    let force = json!({
        "direction": link.name(),
        "multiple": force.to_string(),
        "force": value(&newtons, FORCE)?,
    });
    Ok(placed(pile.dimension(), ids, site, force))
}

/// Returns all contacts, in the order of `contacts.csv`.
pub(super) fn contacts(numbered: &NumberedPile<'_>) -> Result<Json, Error> {
    let pile = numbered.pile();
    let sloping = pile.forces::<BigRational>().contacts(Selection::All)?;
    let sloping = sloping.map(|found| {
        let found = found?;
        Ok::<_, Error>((found.site, found.direction.into(), found.force))
    });
    let horizontal = pile.horizontal_forces();
    let horizontal =
        horizontal.map(|(contact, force)| Ok((contact.site, contact.axis.into(), force.clone())));
    let all = sloping.chain(horizontal).map(|found| {
        let (site, link, force) = found?;
        contact(numbered, &Extreme { site, link, force })
    });
    all.collect()
}

pub(super) fn spheres(numbered: &NumberedPile<'_>) -> Result<Json, Error> {
    let dimension = numbered.pile().dimension();
    let all = (1_u64..).zip(numbered.sites()?).map(|(id, site)| {
        let [x, y, z] = numbered.packing().position(site)?;
        let value = |x| value(x, "a position");
        let centre = json!({"x": value(&x)?, "y": value(&y)?, "z": value(&z)?});
        Ok(placed(dimension, json!({"id": id}), site, centre))
    });
    all.collect()
}

/// Returns the derivatives of all contact forces, a record for each parameter. There are none if spheres touch whose contacts
/// are not part of the isostatic state, and none if the list would be too long or empty.
pub(super) fn derivatives_by_parameter(numbered: &NumberedPile<'_>) -> Result<Option<Json>, Error> {
    let (pile, packing) = (numbered.pile(), numbered.packing());
    let axes = pile.dimension().number();
    let parameters = pile.sphere_count() * (1 + axes) + (axes - 1);
    let length = pile.contact_count() * parameters;
    let is_listed = (BigUint::one()..=MOST_DERIVATIVES.into()).contains(&length);
    if !is_listed || !packing.touching().is_empty() {
        return Ok(None);
    }
    let records = derivatives(packing)?.map(|record| {
        let (parameter, all) = record?;
        let all: Vec<String> = all.iter().map(ToString::to_string).collect();
        Ok(json!({"parameter": parameter.to_string(), "of_contacts": all}))
    });
    records.collect::<Result<_, Error>>().map(Some)
}

pub(super) fn base(numbered: &NumberedPile<'_>) -> Result<Json, Error> {
    let dimension = numbered.pile().dimension();
    let forces = numbered.packing().base(Selection::Base)?;
    let all = (numbered.numbering().first_on_floor()..).zip(forces);
    let all = all.map(|(id, force)| {
        let force = force?;
        let value = |x| value(x, "a force on the floor");
        let (normal, x, y) = (&force.normal, &force.shear_x, &force.shear_y);
        let on_floor =
            json!({"normal": value(normal)?, "shear_x": value(x)?, "shear_y": value(y)?});
        let id = json!({"id": id});
        Ok(placed(dimension, id, force.site, on_floor))
    });
    all.collect()
}
