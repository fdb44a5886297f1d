//! The card in Markdown.

use serde_json::Value as Json;

use super::record::{CRITERION, Names, give, is_tilted, name};
use super::title::{CardTitle, layers};
use crate::Error;
use crate::error::bug;
use crate::numbered::NumberedPile;
use crate::scene::State;
use crate::template::fill_lines;
use cannonpile::Pile;
use cannonpile::lattice::Dimension;

/// Fills in the page of a card.
pub(super) fn page(
    pile: &NumberedPile<'_>,
    title: &CardTitle,
    (card, mut names): (Json, Names),
    layout: &Layout,
) -> Result<String, Error> {
    name("", &card, &mut names);
    name_pile(pile, title, &mut names);
    let flat = pile.pile().dimension() == Dimension::Two;
    for (list, row) in [
        ("spheres", SPHERE),
        ("contacts", layout.contact),
        ("base", layout.on_floor),
    ] {
        let records = match list {
            "spheres" => &card["pile"]["list_of_spheres"],
            list => &card["answers"][list],
        };
        let flag = match records.as_array() {
            Some(records) if records.is_empty() => format!("no_{list}"),
            Some(_) => list.to_owned(),
            None => format!("many_{list}"),
        };
        names.insert(flag, String::new());
        names.insert(format!("{list}_rows"), rows(records, row, flat).join("\n"));
    }
    let criteria = card["criteria"].as_array().into_iter().flatten();
    let criteria = (1..).zip(criteria).map(|(n, criterion)| {
        let part = |part: &str| criterion[part].as_str().ok_or_else(|| bug(CRITERION));
        let (name, must, check) = (part("name")?, part("must")?, part("check")?);
        Ok(format!("{n}. **{name}.** {must} *Check:* {check}."))
    });
    let criteria = criteria.collect::<Result<Vec<_>, Error>>()?.join("\n\n");
    let law = card["tolerance"]["law"].as_array().into_iter().flatten();
    let law: Vec<&str> = law.filter_map(Json::as_str).collect();
    let scene = card["scene"].as_str();
    let answers = &card["answers"];
    let verdict = match (
        answers["stands"].as_str(),
        answers["why_not_known"].is_null(),
    ) {
        (Some(verdict), _) => verdict,
        (None, true) => "not defined for spheres without weight",
        (None, false) => "not known",
    };
    let loads = loads(&card["pile"]["loads"], pile.pile());
    let at_rest = names.contains_key("rests") || names.contains_key("falls");
    let texts = &mut [
        ("with_scene", scene.map(|_| String::new())),
        ("scene", scene.map(|scene| scene.trim_end().to_owned())),
        (
            "derivatives",
            answers["derivatives"].is_array().then(String::new),
        ),
        ("springs", at_rest.then(String::new)),
        ("criteria", Some(criteria)),
        ("law", Some(law.join("\n\n"))),
        ("verdict", Some(verdict.to_owned())),
        ("loads", Some(shortened(&loads))),
    ];
    give(&mut names, texts);
    Ok(fill_lines(layout.page, &names))
}

/// The templates of a page and of its rows.
pub(super) struct Layout {
    pub(super) page: &'static str,
    pub(super) contact: &'static str,
    pub(super) on_floor: &'static str,
}

impl Layout {
    /// The page of a pile on a floor with glue.
    pub(super) const GLUED: Self = Self {
        page: include_str!("page.md"),
        contact: "| {id1} | {id2} | {direction} | `{multiple}` | `{force.exact}` | `{force.float}` |",
        on_floor: "| {id} | {site} | `{normal.exact}` | `{normal.float}` | `{shear_x.exact}` | `{shear_y.exact}` |",
    };
}

/// Adds the facts about a pile that only the page shows.
fn name_pile(numbered: &NumberedPile<'_>, title: &CardTitle, names: &mut Names) {
    let pile = numbered.pile();
    let (regular, weighs) = (pile.is_regular(), !pile.is_weightless());
    let [kind, supports, site] = match pile.dimension() {
        Dimension::Two => ["discs", "two discs", "(k, i)"],
        Dimension::Three => ["spheres", "three spheres", "(k, i, j)"],
    };
    let [along, unit] = match pile.dimension() {
        Dimension::Two => ["disc i + 1 lies 2a further along x", "mg/(2 cos θ)"],
        Dimension::Three if regular => [
            "a step of i is 2a along y, and a step of j leads to the next row",
            "mg/(3 cos θ)",
        ],
        Dimension::Three => [
            "a step of i leads along y, and a step of j to the next row",
            "mg/(2 (1 + sin φ) cos θ)",
        ],
    };
    let order = if pile.shape().is_grown_from_base() {
        "from the base up"
    } else {
        "from the top"
    };
    let cited = match &*title.case {
        "" => "this card, with its scene,".to_owned(),
        case => format!("\"{case} of the cases of cannonpile\""),
    };
    let positive = |count: usize| (count > 0).then(|| count.to_string());
    let own_weights = positive(pile.weights().count()).filter(|_| weighs);
    let no_extremes = match pile.base_extremes() {
        Err(error @ cannonpile::Error::TooLarge { .. }) => Some(error.to_string()),
        _ => None,
    };
    let flag = |holds: bool| holds.then(String::new);
    let (tilted, vertical) = (
        is_tilted(pile),
        pile.loads().all(|(_, load)| load.is_vertical()),
    );
    let texts = &mut [
        ("upright", flag(!tilted)),
        ("tilted", flag(tilted)),
        ("vertical", flag(vertical)),
        ("directed", flag(!vertical)),
        ("downward", flag(!tilted && vertical)),
        ("leaning", flag(tilted || !vertical)),
        ("regular", flag(regular)),
        ("isosceles", flag(!regular)),
        ("weighs", flag(weighs)),
        ("isostatic", flag(title.state == State::Isostatic)),
        ("elastic", flag(title.state == State::Elastic)),
        ("kind", Some(kind.into())),
        ("supports", Some(supports.into())),
        ("site", Some(site.into())),
        ("layers", Some(layers(pile))),
        ("order", Some(order.into())),
        ("sin_phi", (!regular).then(|| pile.sin_phi().to_string())),
        ("own_weights", own_weights),
        ("state", Some(state(title))),
        ("along", Some(along.into())),
        (
            "weight",
            Some(if weighs { "W_p = mg" } else { "W_p = 0" }.into()),
        ),
        ("unit", Some(unit.into())),
        ("horizontal", positive(pile.horizontal_forces().len())),
        ("no_extremes", no_extremes),
        ("contact_count", Some(numbered.contact_count().to_string())),
        ("name", Some(cited)),
    ];
    give(names, texts);
}

const SPHERE: &str = "| {id} | {site} | `{x.exact}` | `{y.exact}` | `{z.exact}` |";
/// Returns one table row for each record of a list.
fn rows(list: &Json, row: &str, flat: bool) -> Vec<String> {
    let records = list.as_array().into_iter().flatten();
    records.map(|record| filled(record, row, flat)).collect()
}

/// Fills in a row with a record.
fn filled(record: &Json, row: &str, flat: bool) -> String {
    let site = if flat {
        "({k}, {i})"
    } else {
        "({k}, {i}, {j})"
    };
    let mut names = Names::new();
    name("", record, &mut names);
    let row = row.replace("{site}", site);
    fill_lines(&row, &names).trim_end().to_owned()
}

/// Returns a text for each load.
fn loads(list: &Json, pile: &Pile) -> Vec<String> {
    let directed = match (pile.dimension(), pile.is_regular()) {
        (Dimension::Two, _) => "{weight} mg down and {x} mg·tanθ along x on {site}",
        (Dimension::Three, true) => {
            "{weight} mg down, {x} mg·tanθ along x and {y} √3·mg·tanθ along y on {site}"
        }
        (Dimension::Three, false) => {
            "{weight} mg down, {x} mg·tanθ along x and {y} 2cosφ·mg·tanθ along y on {site}"
        }
    };
    let flat = pile.dimension() == Dimension::Two;
    let loads = list.as_array().into_iter().flatten().map(|load| {
        let row = if load["x"].is_null() {
            "{weight} mg on {site}"
        } else {
            directed
        };
        filled(load, row, flat)
    });
    loads.collect()
}

/// Returns the first loads as text, and the number of the others.
fn shortened(loads: &[String]) -> String {
    match loads.split_at_checked(10) {
        Some((shown, more)) if !more.is_empty() => {
            format!(
                "{}, and {} more in `spheres.csv`",
                shown.join(", "),
                more.len()
            )
        }
        _ if loads.is_empty() => "none".into(),
        _ => loads.join(", "),
    }
}

/// Returns a description of the state of the forces.
fn state(title: &CardTitle) -> String {
    if title.state == State::Isostatic {
        return "isostatic: contacts between layers only".to_owned();
    }
    let ratio = title.stiffness_ratio.as_ref();
    let ratio = ratio.map_or_else(|| "1".to_owned(), ToString::to_string);
    format!(
        "elastic: springs that only push, horizontal ones {ratio} times as stiff as those between layers, in the limit of \
         great stiffness"
    )
}
