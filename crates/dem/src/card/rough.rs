//! The card of two layers on a rough floor.

use num_rational::BigRational;
use serde_json::{Value as Json, json};

use super::lists::{FORCE, rational};
use super::page::Layout;
use super::record::{Names, criteria, framed, give, name, of_pile, scene_option};
use super::title::CardTitle;
use crate::json::placed;
use crate::numbered::{NumberedPile, all_rounded};
use crate::template::fill_lines;
use crate::{Each, Error, Friction};
use cannonpile::scalar::SurdSum;
use cannonpile::shape::Selection;
use cannonpile_stability::RoughPacking;

/// The accepted relative error of the simulations.
const ACCEPT: &str = "1e-5";

/// Returns the card, with lists of at most `most` entries, and the texts for its page.
pub(super) fn record(
    numbered: &NumberedPile<'_>,
    title: &CardTitle,
    friction: &Friction,
    scene: Option<&str>,
    most: u32,
) -> Result<(Json, Names), Error> {
    let rough = RoughPacking::new(numbered.packing())?;
    let [contacts_hold, floor_holds] = friction.holds(&rough)?;
    let stands = contacts_hold && floor_holds;
    let option = scene_option(title);
    let verify = format!("cannonpile verify FORCES --floor-table FLOOR {option} --accept {ACCEPT}");
    let of_pile = of_pile(numbered, title, most)?;
    let answers = answers(numbered, &rough, friction, stands, most)?;
    let mut names = Names::new();
    name("pile", &of_pile, &mut names);
    name("answers", &answers, &mut names);
    let flag = |holds: bool| holds.then(String::new);
    let texts = &mut [
        ("stands", flag(stands)),
        ("falls", flag(!stands)),
        ("contacts_slide", flag(!contacts_hold)),
        ("floor_slides", flag(contacts_hold && !floor_holds)),
        ("accept", Some(ACCEPT.to_owned())),
        ("verify", Some(verify.clone())),
        (
            "export",
            Some(format!("cannonpile export DIR {option} --to lammps,yade")),
        ),
    ];
    give(&mut names, texts);
    let outcome = fill_lines(include_str!("rough_outcome.txt"), &names);
    let criteria = criteria(include_str!("rough_criteria.txt"), &names)?;
    let failures: Vec<&str> = include_str!("rough_failures.txt").lines().collect();
    let rows = failures
        .iter()
        .map(|line| format!("| {} |", line.replace('|', " | ")));
    names.insert("failures".into(), rows.collect::<Vec<_>>().join("\n"));
    let own = json!({
        "pile": of_pile,
        "answers": answers,
        "tolerance": {"accept": 1e-5},
        "criteria": criteria,
        "failures": failures,
        "verify": verify,
    });
    Ok((framed(numbered, title, &outcome, scene, own), names))
}

/// The page.
pub(super) const LAYOUT: Layout = Layout {
    page: include_str!("rough.md"),
    contact: "| {id1} | {id2} | {direction} | `{normal.float}` | `{tangential.float}` | {normal_vector.x}, {normal_vector.y}, {normal_vector.z} | {tangential_vector.x}, {tangential_vector.y}, {tangential_vector.z} |",
    on_floor: "| {id} | {site} | `{normal.float}` | `{friction_x.float}` | `{friction_y.float}` |",
};

/// Returns the exact answers.
fn answers(
    numbered: &NumberedPile<'_>,
    rough: &RoughPacking<'_>,
    friction: &Friction,
    stands: bool,
    most: u32,
) -> Result<Json, Error> {
    let (pile, packing) = (numbered.pile(), numbered.packing());
    let few = numbered.contact_count() <= most.into();
    let few_below = pile.base_sphere_count() <= most.into();
    let extremes = pile.base_extremes()?;
    let newtons = |multiple: BigRational| rational(multiple * packing.sphere_weight(), FORCE);
    Ok(json!({
        "stands": if stands { "yes" } else { "no" },
        "friction": friction.spheres(),
        "floor_friction": friction.floor(),
        "friction_needed": sum(&rough.contact_friction())?,
        "floor_friction_needed": sum(&rough.floor_friction()?)?,
        "total_on_floor": newtons(pile.weight())?,
        "normal_min": newtons(extremes.normal_min)?,
        "normal_max": newtons(extremes.normal_max)?,
        "contacts": few.then(|| contacts(numbered, rough)).transpose()?,
        "base": few_below.then(|| base(numbered, rough)).transpose()?,
    }))
}

/// Returns a sum of surds with its correctly rounded float.
fn sum(number: &SurdSum) -> Result<Json, Error> {
    let [float] = all_rounded(core::array::from_ref(number))?;
    Ok(json!({"exact": number.to_string(), "float": float}))
}

fn contacts(numbered: &NumberedPile<'_>, rough: &RoughPacking<'_>) -> Result<Json, Error> {
    let dimension = numbered.pile().dimension();
    let touches = numbered.touches()?;
    let all = touches.zip(rough.contacts(Selection::All)?);
    let all = all.map(|(touch, contact)| {
        let ((direction, ids), contact) = (touch?, contact?);
        let vector = |vector: &[SurdSum; 3]| {
            let [x, y, z] = all_rounded(vector)?;
            Ok::<_, Error>(json!({"x": x, "y": y, "z": z}))
        };
        let normal = contact.normal_vector.each(SurdSum::from);
        let force = json!({
            "direction": direction.name(),
            "normal": rational(contact.normal, FORCE)?,
            "tangential": sum(&contact.tangential)?,
            "normal_vector": vector(&normal)?,
            "tangential_vector": vector(&contact.tangential_vector)?,
        });
        let ids = json!({"id1": ids[0], "id2": ids[1]});
        Ok(placed(dimension, ids, contact.site, force))
    });
    all.collect()
}

fn base(numbered: &NumberedPile<'_>, rough: &RoughPacking<'_>) -> Result<Json, Error> {
    let dimension = numbered.pile().dimension();
    let forces = rough.base(Selection::Base)?;
    let all = (numbered.numbering().first_on_floor()..).zip(forces);
    let all = all.map(|(id, force)| {
        let force = force?;
        let parts = json!({
            "normal": sum(&force.normal)?,
            "friction_x": sum(&force.shear_x)?,
            "friction_y": sum(&force.shear_y)?,
        });
        let id = json!({"id": id});
        Ok(placed(dimension, id, force.site, parts))
    });
    all.collect()
}
