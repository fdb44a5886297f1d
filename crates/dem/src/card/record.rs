//! The contents of a card as JSON. The Markdown page is filled in from the same facts.

use std::collections::BTreeMap;

use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, Zero};
use serde_json::{Value as Json, json};

use super::extremes::{Extreme, Extremes};
use super::lists::{
    FORCE, base, contact, contacts, derivatives_by_parameter, rational, spheres, value,
};
use super::title::{CardTitle, heading};
use crate::Error;
use crate::error::bug;
use crate::json::{integer, joined, placed};
use crate::numbered::{NumberedPile, nearest};
use crate::springs::Springs;
use crate::table::{Summary, Units, stacking};
use crate::template::{fill, fill_lines};
use crate::weights::newtons;
use cannonpile::scalar::Surd;
use cannonpile::{BaseExtremes, Load, Packing, Pile, Verdict};

/// The texts for a template, by name. A condition that holds has an empty text, and one that does not hold has no
/// entry.
pub(super) type Names = BTreeMap<String, String>;

/// The name of the layout. The version increases when a key is removed or changes its meaning.
const SCHEMA: &str = "cannonpile-card";
const SCHEMA_VERSION: u32 = 1;

/// Returns the card, with lists of at most `most` entries, and the texts for its templates.
pub(super) fn record(
    numbered: &NumberedPile<'_>,
    title: &CardTitle,
    scene: Option<&str>,
    most: u32,
) -> Result<(Json, Names), Error> {
    let (pile, packing) = (numbered.pile(), numbered.packing());
    let extremes = Extremes::of(pile)?;
    let newtons = |multiple: &BigRational| nearest(&packing.unit_force().scaled(multiple), FORCE);
    let greatest = extremes.greatest.as_ref();
    let greatest = greatest.map(|found| newtons(&found.force)).transpose()?;
    let weakest = extremes.weakest.as_ref().map(newtons).transpose()?;
    let springs = springs(numbered, greatest);
    let accept = accept(springs, greatest, weakest);
    let stands = stands(numbered)?;
    let of_pile = of_pile(numbered, title, most)?;
    let answers = answers(numbered, &extremes, &stands, most)?;
    let mut names = Names::new();
    name("pile", &of_pile, &mut names);
    name("answers", &answers, &mut names);
    let (attained, falls) = (extremes.pulling.is_zero(), stands == Ok(Some(Verdict::No)));
    let rests = attained && !falls;
    let flag = |holds: bool| holds.then(String::new);
    let option = scene_option(title);
    let verify = format!("cannonpile verify FORCES {option} --accept {accept}");
    let export = format!("cannonpile export DIR {option} --to");
    let files = format!("{export} csv");
    let compliance = springs.map(|(_, compliance)| format!("{compliance:.1e}"));
    let pull = extremes.least.as_ref().map(|least| -least.force.clone());
    let pull = pull.map(|pull| packing.unit_force().scaled(&pull).to_string());
    // If floats cannot express the springs, the card requires this compliance.
    let most_compliance = compliance.clone().unwrap_or_else(|| "1e-7".into());
    let texts = &mut [
        (kind(&stands, attained), flag(true)),
        ("pulls", flag(!attained && !falls)),
        ("rests", flag(rests)),
        ("bears", flag(rests && !extremes.bearing.is_zero())),
        ("idle", flag(!extremes.idle.is_zero())),
        ("greatest_pull", pull),
        (
            "stiffness",
            springs.map(|(stiffness, _)| format!("{stiffness:.3e}")),
        ),
        ("most_compliance", Some(most_compliance)),
        ("compliance", compliance),
        ("accept", Some(accept.clone())),
        ("verify", Some(verify.clone())),
        ("export", Some(export)),
    ];
    give(&mut names, texts);
    let outcome = fill_lines(include_str!("outcome.txt"), &names);
    let criteria = criteria(include_str!("criteria.txt"), &names)?;
    let accept: Json =
        serde_json::from_str(&accept).map_err(|_| bug("the digits of a tolerance are JSON"))?;
    let tolerance = json!({
        "accept": accept,
        "order": 1,
        "order_in": "1/k",
        "stiffness": springs.map(|(stiffness, _)| stiffness),
        "compliance": springs.map(|(_, compliance)| compliance),
        "law": include_str!("law.txt").lines().collect::<Json>(),
    });
    let own = json!({
        "pile": of_pile,
        "answers": answers,
        "tolerance": tolerance,
        "criteria": criteria,
        "verify": verify,
        "files": files,
    });
    Ok((framed(numbered, title, &outcome, scene, own), names))
}

/// Returns the option that names the scene of a card.
pub(super) fn scene_option(title: &CardTitle) -> String {
    match &*title.case {
        "" => "--scene scene.toml".to_owned(),
        case => format!("--case {case}"),
    }
}

/// Returns a card: what all cards have in common around its own entries.
pub(super) fn framed(
    numbered: &NumberedPile<'_>,
    title: &CardTitle,
    outcome: &str,
    scene: Option<&str>,
    own: Json,
) -> Json {
    let version = env!("CARGO_PKG_VERSION");
    let unless_empty = |text: &str| (!text.is_empty()).then(|| text.to_owned());
    let head = json!({
        "schema": SCHEMA,
        "schema_version": SCHEMA_VERSION,
        "cannonpile": version,
        "case": unless_empty(&title.case),
        "title": heading(numbered, title),
        "purpose": unless_empty(&title.purpose),
        "outcome": outcome.trim_end(),
        "scene": scene,
        "units": {"length": "m", "mass": "kg", "force": "N", "up": "z"},
    });
    let cite = fill(include_str!("cite.bib"), &[("version", version.into())]);
    joined([head, own, json!({"cite": cite.trim_end()})])
}

/// Returns the criteria of a template: each line has a name, a demand and a check.
pub(super) fn criteria(template: &str, names: &Names) -> Result<Json, Error> {
    let filled = fill_lines(template, names);
    let criteria = filled.lines().map(|criterion| {
        let parts: Vec<&str> = criterion.splitn(3, '|').collect();
        match parts[..] {
            [name, must, check] => Ok(json!({"name": name, "must": must, "check": check})),
            _ => Err(bug(CRITERION)),
        }
    });
    criteria.collect()
}

/// Returns the facts about the pile.
pub(super) fn of_pile(
    numbered: &NumberedPile<'_>,
    title: &CardTitle,
    most: u32,
) -> Result<Json, Error> {
    let (pile, packing) = (numbered.pile(), numbered.packing());
    let inclination = packing.inclination();
    let (sphere_count, base_count) = (pile.sphere_count(), pile.base_sphere_count());
    let loads = pile
        .loads()
        .map(|(site, load)| placed(pile.dimension(), json!({}), site, of_load(load)));
    let tilt = is_tilted(pile).then(|| tilt(packing));
    let list = (sphere_count <= most.into()).then(|| spheres(numbered));
    Ok(json!({
        "dimension": pile.dimension().number(),
        "layers": integer(&pile.layers()),
        "stacking": stacking(pile),
        "grown_from": if pile.shape().is_grown_from_base() { "base" } else { "top" },
        "spheres": integer(&sphere_count),
        "fixed": integer(&base_count),
        "contacts": integer(&pile.contact_count()),
        "spacing": value(&spacing(numbered)?, "the spacing")?,
        "sin_theta": value(&inclination.sin(), "sin θ")?,
        "cos_theta": value(&inclination.cos(), "cos θ")?,
        "radius": rational(packing.radius().clone(), "radius")?,
        "mass": rational(packing.mass().clone(), "mass")?,
        "gravity": rational(packing.gravity().clone(), "gravity")?,
        "tilt": tilt.transpose()?,
        "weightless": pile.is_weightless(),
        "loads": loads.collect::<Json>(),
        "state": title.state.name(),
        "stiffness_ratio": title.stiffness_ratio.as_ref().map(ToString::to_string),
        "neighbours_touch": packing.touching().iter().any(|apart| apart.layers == 0),
        "list_of_spheres": list.transpose()?,
    }))
}

/// Returns a load: its weight, and its horizontal components if it has any.
fn of_load(load: &Load) -> Json {
    let Load { down, x, y } = load.clone().map(|part| part.to_string());
    if load.is_vertical() {
        return json!({"weight": down});
    }
    json!({"weight": down, "x": x, "y": y})
}

pub(super) fn is_tilted(pile: &Pile) -> bool {
    !pile.tilt().iter().all(Zero::is_zero)
}

/// Returns the horizontal parts of gravity along x and y over its vertical part.
fn tilt(packing: &Packing<'_>) -> Result<Json, Error> {
    let weight = packing.sphere_weight().recip();
    let gravity = Load::leaning(weight, packing.pile().tilt());
    let [x, y, _] = newtons(packing, gravity);
    let part = |part| value(&part, "a tilt");
    Ok(json!({"x": part(x)?, "y": part(y)?}))
}

/// Returns the exact answers.
fn answers(
    numbered: &NumberedPile<'_>,
    extremes: &Extremes,
    stands: &Stands,
    most: u32,
) -> Result<Json, Error> {
    let (pile, packing) = (numbered.pile(), numbered.packing());
    let few = |count: &BigUint| *count <= BigUint::from(most);
    let found = |found: &Option<Extreme>| {
        let found = found.as_ref().map(|found| contact(numbered, found));
        found.transpose()
    };
    let [normal_min, normal_max, max_shear_ratio] = match pile.base_extremes() {
        Err(cannonpile::Error::TooLarge { .. }) => [Json::Null, Json::Null, Json::Null],
        extremes => on_floor(numbered, &extremes?)?,
    };
    let weight = pile.weight() * packing.sphere_weight();
    let verdict = stands.as_ref().ok().and_then(|stands| stands.as_ref());
    Ok(json!({
        "stands": verdict.map(|verdict| verdict.name()),
        "why_not_known": stands.as_ref().err(),
        "bearing": integer(&extremes.bearing),
        "bearing_horizontal": pile.horizontal_forces().len(),
        "idle": integer(&extremes.idle),
        "pulling": integer(&extremes.pulling),
        "unit_force": value(&packing.unit_force(), FORCE)?,
        "total_on_floor": rational(weight, "the weight of all spheres")?,
        "greatest": found(&extremes.greatest)?,
        "least": found(&extremes.least)?,
        "normal_min": normal_min,
        "normal_max": normal_max,
        "max_shear_ratio": max_shear_ratio,
        "contacts": few(&numbered.contact_count()).then(|| contacts(numbered)).transpose()?,
        "contacts_file": "contacts.csv",
        "derivatives": derivatives_by_parameter(numbered)?,
        "base": few(&pile.base_sphere_count()).then(|| base(numbered)).transpose()?,
        "base_file": "base.csv",
    }))
}

/// Adds the entries that have a text.
pub(super) fn give(names: &mut Names, texts: &mut [(&str, Option<String>)]) {
    for (name, text) in texts {
        if let Some(text) = text.take() {
            names.insert((*name).to_owned(), text);
        }
    }
}

/// Collects the texts and numbers of a record, each named by the path of keys to it.
pub(super) fn name(path: &str, value: &Json, names: &mut Names) {
    let text = match value {
        Json::Object(entries) => {
            for (key, value) in entries {
                let dot = if path.is_empty() { "" } else { "." };
                name(&format!("{path}{dot}{key}"), value, names);
            }
            return;
        }
        Json::Null | Json::Array(_) | Json::Bool(false) => return,
        Json::Bool(true) => String::new(),
        Json::String(text) => text.clone(),
        Json::Number(number) => match number.as_f64().filter(|_| number.is_f64()) {
            Some(float) => format!("{float:?}"),
            None => number.to_string(),
        },
    };
    names.insert(path.to_owned(), text);
}

/// The message of the internal error for a line of `criteria.txt` that does not have three parts.
pub(super) const CRITERION: &str = "a criterion of a card has a name, a demand and a check";

/// Returns a/R, from sin²θ = (a/R)²(d−1)/(2d).
fn spacing(numbered: &NumberedPile<'_>) -> Result<Surd, Error> {
    let d = BigRational::from_integer(numbered.pile().dimension().number().into());
    let square = numbered.packing().inclination().sin2() * (&d + &d) / (d - BigRational::one());
    Ok(Surd::sqrt(square).map_err(cannonpile::Error::from)?)
}

/// The verdict on stability (`None` for weightless spheres), or why the decision would take too long.
type Stands = Result<Option<Verdict>, String>;

fn stands(numbered: &NumberedPile<'_>) -> Result<Stands, Error> {
    let packing = numbered.packing();
    let units = Units::of_packing(packing.clone());
    match Summary::new(&units, Some(packing.touching().to_vec())) {
        Ok(summary) => Ok(Ok(summary.verdict())),
        Err(error @ Error::Core(cannonpile::Error::TooLarge { .. })) => Ok(Err(error.to_string())),
        Err(error) => Err(error),
    }
}

/// Returns the outcome as one word. `attained` says that no contact needs a tensile force.
fn kind(stands: &Stands, attained: bool) -> &'static str {
    match (stands, attained) {
        (Ok(Some(Verdict::Yes)), true) => "stands",
        (Ok(Some(Verdict::Yes)), false) => "held",
        (Ok(Some(Verdict::No)), _) => "falls",
        (Ok(Some(Verdict::Undetermined)), _) => "undetermined",
        (Ok(None), true) => "response",
        (Ok(None), false) => "difference",
        (Err(_), _) => "unknown",
    }
}

/// Returns the stiffness k of the springs in the scripts for LAMMPS and YADE, in N/m, and F/(kR) with the greatest
/// contact force F. Returns `None` where floats cannot express these springs.
fn springs(numbered: &NumberedPile<'_>, greatest: Option<f64>) -> Option<(f64, f64)> {
    let springs = Springs::of(numbered).ok()?;
    let compliance = greatest? / (springs.stiffness * springs.radius);
    let finite = compliance.is_finite();
    finite.then_some((springs.stiffness, compliance))
}

/// Returns the accepted relative error on these springs, a power of ten from 10⁻⁵ to 10⁻¹. It is ten times F/(kR),
/// divided by the ratio of the weakest to the greatest contact force.
fn accept(springs: Option<(f64, f64)>, greatest: Option<f64>, weakest: Option<f64>) -> String {
    let error = match (springs, greatest, weakest) {
        (Some((_, compliance)), Some(greatest), Some(weakest)) => {
            10.0 * compliance * greatest / weakest
        }
        _ => 1e-5,
    };
    // Clamping limits the tolerance only. No exact value of the card changes.
    let power = error.log10().ceil().clamp(-5.0, -1.0);
    format!("1e{power}")
}

/// Returns the least and the greatest normal force, in N, and the greatest ratio of shear to normal force.
fn on_floor(numbered: &NumberedPile<'_>, extremes: &BaseExtremes) -> Result<[Json; 3], Error> {
    let packing = numbered.packing();
    let normal = |multiple: &BigRational| {
        rational(multiple * packing.sphere_weight(), "a force on the floor")
    };
    let ratio = packing.inclination().tan() * &extremes.max_shear_ratio;
    let ratio = (!extremes.shear_without_normal).then(|| value(&ratio, "a ratio of forces"));
    Ok([
        normal(&extremes.normal_min)?,
        normal(&extremes.normal_max)?,
        ratio.transpose()?.unwrap_or(Json::Null),
    ])
}
