//! Records of a card: numbers, contacts, spheres and forces on the floor.

use num_rational::BigRational;
use serde_json::{Value as Json, json};

use super::extremes::Extreme;
use crate::Error;
use crate::numbered::{NumberedPile, nearest};
use cannonpile::Pile;
use cannonpile::lattice::{ContactKind, Dimension, HorizontalContact, Site};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;

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

/// Returns an integer within 2^53 as a number, and a larger one as a string. Many JSON readers store numbers as floats.
pub(super) fn integer(number: &impl ToString) -> Json {
    let text = number.to_string();
    match text.parse::<i64>() {
        Ok(small) if small.unsigned_abs() >> 53 == 0 => small.into(),
        _ => text.into(),
    }
}

/// Returns the entries of `before`, of a site (`k, i, j`, or `k, i` for a disc) and of `after` as one record. The
/// indices of exported piles are small enough for JSON numbers.
pub(super) fn placed(pile: &Pile, before: Json, Site { i, j, k }: Site, after: Json) -> Json {
    let place = match pile.dimension() {
        Dimension::Two => json!({"k": k, "i": i}),
        Dimension::Three => json!({"k": k, "i": i, "j": j}),
    };
    joined([before, place, after])
}

/// Returns the entries of all records as one record.
pub(super) fn joined(records: [Json; 3]) -> Json {
    let entries = |record| match record {
        Json::Object(entries) => entries,
        _ => serde_json::Map::new(),
    };
    Json::Object(records.into_iter().flat_map(entries).collect())
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
    Ok(placed(pile, ids, site, force))
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
    let all = (1_u64..).zip(numbered.sites()?).map(|(id, site)| {
        let [x, y, z] = numbered.packing().position(site)?;
        let value = |x| value(x, "a position");
        let centre = json!({"x": value(&x)?, "y": value(&y)?, "z": value(&z)?});
        Ok(placed(numbered.pile(), json!({"id": id}), site, centre))
    });
    all.collect()
}

pub(super) fn base(numbered: &NumberedPile<'_>) -> Result<Json, Error> {
    let forces = numbered.packing().base(Selection::Base)?;
    let all = (numbered.numbering().first_on_floor()..).zip(forces);
    let all = all.map(|(id, force)| {
        let force = force?;
        let value = |x| value(x, "a force on the floor");
        let (normal, x, y) = (&force.normal, &force.shear_x, &force.shear_y);
        let on_floor =
            json!({"normal": value(normal)?, "shear_x": value(x)?, "shear_y": value(y)?});
        Ok(placed(
            numbered.pile(),
            json!({"id": id}),
            force.site,
            on_floor,
        ))
    });
    all.collect()
}
