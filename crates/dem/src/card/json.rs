//! The card for machines.

use serde_json::{Map, Value as Json, json};

use super::CardTitle;
use super::facts::{Facts, Stands};
use super::lists::{Contact, OnFloor, Sphere};
use super::value::Value;
use super::words;
use crate::Error;
use crate::error::bug;
use crate::table::stacking;
use cannonpile::Pile;
use cannonpile::lattice::{Dimension, Site};

/// The name of the layout, and its version, which grows when a key gets another meaning or goes.
const SCHEMA: &str = "cannonpile-card";
const SCHEMA_VERSION: u32 = 1;

/// The card, whole.
pub(super) fn text(
    facts: &Facts<'_, '_>,
    title: &CardTitle,
    scene: Option<&str>,
) -> Result<String, Error> {
    let case = (!title.case.is_empty()).then_some(&title.case);
    let purpose = (!title.purpose.is_empty()).then_some(&title.purpose);
    let pile = facts.pile.pile();
    let accept: Json = serde_json::from_str(&facts.accept)
        .map_err(|_| bug("the digits of a tolerance are JSON"))?;
    let card = json!({
        "schema": SCHEMA,
        "schema_version": SCHEMA_VERSION,
        "cannonpile": env!("CARGO_PKG_VERSION"),
        "case": case,
        "title": super::heading(facts.pile, title),
        "purpose": purpose,
        "outcome": words::outcome(facts),
        "scene": scene,
        "units": {"length": "m", "mass": "kg", "force": "N", "up": "z"},
        "pile": {
            "dimension": pile.dimension().number(),
            "layers": number(&pile.layers()),
            "stacking": stacking(pile),
            "grown_from": if pile.shape().is_grown_from_base() { "base" } else { "top" },
            "spheres": number(&facts.sphere_count),
            "fixed": number(&facts.base_count),
            "contacts": number(&pile.contact_count()),
            "spacing": value(&facts.spacing),
            "sin_theta": value(&facts.sin_theta),
            "cos_theta": value(&facts.cos_theta),
            "radius": value(&facts.radius),
            "mass": value(&facts.mass),
            "gravity": value(&facts.gravity),
            "weightless": pile.is_weightless(),
            "loads": loads(pile),
            "state": title.state.name(),
            "stiffness_ratio": title.stiffness_ratio.as_ref().map(ToString::to_string),
            "neighbours_touch": facts.neighbours_touch,
            "list_of_spheres": facts.spheres.as_ref().map(|all| list(all, |one| sphere(one, pile))),
        },
        "answers": answers(facts),
        "tolerance": {
            "accept": accept,
            "order": 1,
            "order_in": "1/k",
            "stiffness": facts.stiffness.as_ref().map(|stiffness| stiffness.spring),
            "compliance": facts.stiffness.as_ref().map(|stiffness| stiffness.compliance),
            "law": words::tolerance(),
        },
        "criteria": words::criteria(facts, title).iter().map(|criterion| json!({
            "name": criterion.name,
            "must": criterion.must,
            "check": criterion.check,
        })).collect::<Vec<_>>(),
        "verify": words::verify(facts, title),
        "files": words::export(title, "csv"),
        "cite": words::bibtex(),
    });
    let mut text = serde_json::to_string_pretty(&card)
        .map_err(|_| bug("a value of JSON can be written as text"))?;
    text.push('\n');
    Ok(text)
}

fn answers(facts: &Facts<'_, '_>) -> Json {
    let pile = facts.pile.pile();
    let unknown = match &facts.stands {
        Stands::TooLarge(reason) => Some(reason),
        Stands::Known(_) | Stands::NotAsked => None,
    };
    let floor = facts.floor.as_ref().ok();
    json!({
        "stands": words::stands(facts),
        "why_not_known": unknown,
        "bearing": number(&facts.bearing),
        "bearing_horizontal": facts.horizontal,
        "idle": number(&facts.idle),
        "pulling": number(&facts.pulling),
        "unit_force": value(&facts.unit_force),
        "total_on_floor": value(&facts.weight),
        "greatest": facts.greatest.as_ref().map(|found| contact(found, pile)),
        "least": facts.least.as_ref().map(|found| contact(found, pile)),
        "normal_min": floor.map(|floor| value(&floor.normal_min)),
        "normal_max": floor.map(|floor| value(&floor.normal_max)),
        "max_shear_ratio": floor.map(|floor| value(&floor.shear_ratio)),
        "contacts": facts.contacts.as_ref().map(|all| list(all, |one| contact(one, pile))),
        "contacts_file": "contacts.csv",
        "base": facts.base.as_ref().map(|all| list(all, |one| on_floor(one, pile))),
        "base_file": "base.csv",
    })
}

/// An integer within 2^53 as a number, a greater one as a string: many readers keep a number as a float.
fn number(number: &impl ToString) -> Json {
    let text = number.to_string();
    match text.parse::<i64>() {
        Ok(small) if small.unsigned_abs() >> 53 == 0 => small.into(),
        _ => text.into(),
    }
}

fn value(value: &Value) -> Json {
    json!({"exact": value.exact, "float": value.float})
}

fn list<T>(all: &[T], one: impl Fn(&T) -> Json) -> Json {
    Json::Array(all.iter().map(one).collect())
}

fn loads(pile: &Pile) -> Json {
    let load = |(site, load): (Site, &num_rational::BigRational)| {
        let mut record = place(site, pile);
        record.insert("weight".into(), load.to_string().into());
        Json::Object(record)
    };
    Json::Array(pile.loads().map(load).collect())
}

fn contact(contact: &Contact, pile: &Pile) -> Json {
    let [first, second] = contact.ids;
    let mut record = Map::new();
    record.insert("id1".into(), first.into());
    record.insert("id2".into(), second.into());
    record.extend(place(contact.site, pile));
    record.insert("direction".into(), contact.link.name().into());
    record.insert("multiple".into(), contact.multiple.clone().into());
    record.insert("force".into(), value(&contact.force));
    Json::Object(record)
}

fn sphere(sphere: &Sphere, pile: &Pile) -> Json {
    let mut record = Map::new();
    record.insert("id".into(), sphere.id.into());
    record.extend(place(sphere.site, pile));
    for (name, x) in ["x", "y", "z"].into_iter().zip(&sphere.centre) {
        record.insert(name.into(), value(x));
    }
    Json::Object(record)
}

fn on_floor(sphere: &OnFloor, pile: &Pile) -> Json {
    let mut record = Map::new();
    record.insert("id".into(), sphere.id.into());
    record.extend(place(sphere.site, pile));
    record.insert("normal".into(), value(&sphere.normal));
    for (name, x) in ["shear_x", "shear_y"].into_iter().zip(&sphere.shear) {
        record.insert(name.into(), value(x));
    }
    Json::Object(record)
}

/// `k, i, j`, of a disc `k, i`; sites of piles that are exported are small.
fn place(site: Site, pile: &Pile) -> Map<String, Json> {
    let coordinates: &[_] = match pile.dimension() {
        Dimension::Two => &[("k", site.k), ("i", site.i)],
        Dimension::Three => &[("k", site.k), ("i", site.i), ("j", site.j)],
    };
    let entries = coordinates
        .iter()
        .map(|(name, x)| ((*name).into(), json!(x)));
    entries.collect()
}
