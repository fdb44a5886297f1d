//! What the pile is.

use core::fmt::Display;

use super::{Card, place};
use crate::card::facts::Facts;
use crate::card::value::Value;
use crate::card::{CardTitle, words};
use crate::table::stacking;
use cannonpile::lattice::Dimension;

impl Card {
    /// Writes the sizes, the places and the scene.
    pub(super) fn pile(&mut self, facts: &Facts<'_, '_>, title: &CardTitle, scene: Option<&str>) {
        let pile = facts.pile.pile();
        self.head("The pile");
        let (kind, rests) = kind(pile.dimension());
        let own = pile.weights().count();
        let mut rows = vec![
            row(
                kind,
                format!(
                    "{} in {} {}",
                    facts.sphere_count,
                    pile.layers(),
                    words::plural(pile.layers(), "layer")
                ),
            ),
            row(
                "fixed",
                format!("the {} of the bottom layer", facts.base_count),
            ),
            row(
                "contacts",
                format!("{}: each rests on {rests} below", pile.contact_count()),
            ),
            row("stacking", format!("{}, {}", stacking(pile), order(facts))),
            row(
                if pile.is_regular() {
                    "a/R, half the distance of neighbours in a layer"
                } else {
                    "a/R = √3 sin θ"
                },
                shown(&facts.spacing, ""),
            ),
            row(
                "θ of a contact with the vertical",
                format!(
                    "sin θ = `{}`, cos θ = `{}`",
                    facts.sin_theta.exact, facts.cos_theta.exact
                ),
            ),
            row("radius R", shown(&facts.radius, "m")),
            row("mass m", shown(&facts.mass, "kg")),
            row("gravity g, along −z", shown(&facts.gravity, "m/s²")),
            row(
                "weight",
                if pile.is_weightless() {
                    "none: only the loads act".to_owned()
                } else {
                    "mg each".to_owned()
                },
            ),
        ];
        if !pile.is_regular() {
            let what = "sin φ of the triangle of the base";
            rows.insert(4, row(what, format!("`{}`", pile.sin_phi())));
        }
        if own > 0 && !pile.is_weightless() {
            rows.push(row(
                "weights of their own",
                format!("{own}, in `spheres.csv`"),
            ));
        }
        let loads: Vec<String> = pile
            .loads()
            .take(10)
            .map(|(site, load)| format!("{load} mg on {}", place(site, pile.dimension())))
            .collect();
        let more = pile.loads().len().saturating_sub(loads.len());
        let more = if more > 0 {
            format!(", and {more} more in `spheres.csv`")
        } else {
            String::new()
        };
        rows.push(row(
            "loads, downwards",
            if loads.is_empty() {
                "none".to_owned()
            } else {
                loads.join(", ") + &more
            },
        ));
        rows.push(row("friction, cohesion", "none".to_owned()));
        rows.push(row("state", words::state(title)));
        self.table(["what", "value"], rows.into_iter());
        self.geometry(facts, title);
        if let Some(scene) = scene {
            self.paragraph("The scene as `cannonpile` reads it, `scene.toml`:");
            self.block("toml", scene);
        }
    }

    fn geometry(&mut self, facts: &Facts<'_, '_>, title: &CardTitle) {
        let flat = facts.pile.pile().dimension() == Dimension::Two;
        let names = if flat { "(k, i)" } else { "(k, i, j)" };
        let along = if flat {
            "disc i + 1 lies 2a further along x"
        } else if facts.pile.pile().is_regular() {
            "a step of i is 2a along y, and a step of j leads to the next row"
        } else {
            "a step of i leads along y, and a step of j to the next row"
        };
        self.paragraph(&format!(
            "Lengths are in m, forces in N, z points up and is 0 at the centres of the bottom layer. A sphere is named {names}: \
             layer k from 0 at the top, and its place in the layer; {along}. All touch with |x_p − x_q| = 2R. Numbers of spheres \
             (id) count from 1, layer after layer from the top."
        ));
        match &facts.spheres {
            Some(spheres) => {
                let dimension = facts.pile.pile().dimension();
                let rows = spheres.iter().map(|sphere| {
                    let [x, y, z] = sphere.centre.each_ref().map(|x| format!("`{}`", x.exact));
                    [
                        sphere.id.to_string(),
                        place(sphere.site, dimension),
                        x,
                        y,
                        z,
                    ]
                });
                self.table(["id", names, "x", "y", "z"], rows);
            }
            None => self.paragraph(&format!(
                "Centres of all spheres: `spheres.csv`, which `{}` writes.",
                words::export(title, "csv")
            )),
        }
    }
}

fn row(what: &str, value: String) -> [String; 2] {
    [what.to_owned(), value]
}

/// The exact number, and the float where it is written otherwise.
fn shown(value: &Value, unit: &str) -> String {
    let unit = if unit.is_empty() {
        String::new()
    } else {
        format!(" {unit}")
    };
    format!("`{}`{unit}", value.exact)
}

fn kind(dimension: Dimension) -> (&'static str, impl Display) {
    match dimension {
        Dimension::Two => ("discs", "two discs"),
        Dimension::Three => ("spheres", "three spheres"),
    }
}

fn order(facts: &Facts<'_, '_>) -> &'static str {
    if facts.pile.pile().shape().is_grown_from_base() {
        "from the base up"
    } else {
        "from the top"
    }
}
