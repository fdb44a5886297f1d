//! The exact answers.

use super::{Card, place};
use crate::card::facts::Facts;
use crate::card::lists::Contact;
use crate::card::value::Value;
use crate::card::{CardTitle, words};
use cannonpile::lattice::Dimension;

impl Card {
    /// Writes the answers, and lists of them where they are not too long.
    pub(super) fn answers(&mut self, facts: &Facts<'_, '_>, title: &CardTitle) {
        self.head("Answers");
        let verdict = words::verdict(facts);
        let mut rows = vec![
            answer("stands", verdict.to_owned(), String::new()),
            answer(
                "contacts with a force",
                facts.bearing.to_string(),
                String::new(),
            ),
            answer("contacts without", facts.idle.to_string(), String::new()),
            answer(
                "contacts that would pull",
                facts.pulling.to_string(),
                String::new(),
            ),
            valued(
                &format!("f₀ = {}, the unit of forces", unit_force(facts)),
                &facts.unit_force,
            ),
            valued("weight and loads, on the floor together", &facts.weight),
        ];
        if facts.horizontal > 0 {
            rows.insert(
                2,
                answer(
                    "of these between neighbours of a layer",
                    facts.horizontal.to_string(),
                    String::new(),
                ),
            );
        }
        let extreme = |what: &str, contact: &Option<Contact>| {
            contact.as_ref().map(|contact| {
                let [first, second] = contact.ids;
                valued(
                    &format!(
                        "{what} contact force: spheres {first} and {second}, {} f₀",
                        contact.multiple
                    ),
                    &contact.force,
                )
            })
        };
        rows.extend(extreme("greatest", &facts.greatest));
        rows.extend(extreme("least", &facts.least));
        match &facts.floor {
            Ok(floor) => rows.extend([
                valued("least normal force on the floor", &floor.normal_min),
                valued("greatest normal force on the floor", &floor.normal_max),
                answer(
                    "greatest ratio of shear to normal force",
                    format!("`{}`", floor.shear_ratio.exact),
                    format!("`{:?}`", floor.shear_ratio.float),
                ),
            ]),
            Err(reason) => rows.push(answer(
                "extremes on the floor",
                reason.clone(),
                String::new(),
            )),
        }
        self.table(["quantity", "exact", "nearest double"], rows.into_iter());
        if facts.neighbours_touch {
            self.paragraph("Neighbours of a layer touch at this spacing (a = R); those that are not listed bear nothing.");
        }
        self.paragraph(
            "Exact values are closed forms c·√n with c rational, from the formulas of the library, and hold without any error. \
             Doubles are the floats nearest to them, ties to even.",
        );
        self.lists(facts, title);
    }

    fn lists(&mut self, facts: &Facts<'_, '_>, title: &CardTitle) {
        let dimension = facts.pile.pile().dimension();
        let file = |name: &str| {
            format!(
                "`{name}`, which `{}` writes, has them as doubles.",
                words::export(title, "csv")
            )
        };
        match &facts.contacts {
            Some(contacts) if !contacts.is_empty() => {
                self.paragraph("All contact forces; a positive one pushes id1 and id2 apart. direction says where id2 lies, seen from id1:");
                let rows = contacts.iter().map(|contact| {
                    let [first, second] = contact.ids;
                    [
                        first.to_string(),
                        second.to_string(),
                        contact.link.name().to_owned(),
                        format!("`{}`", contact.multiple),
                        format!("`{}`", contact.force.exact),
                        format!("`{:?}`", contact.force.float),
                    ]
                });
                self.table(
                    [
                        "id1",
                        "id2",
                        "direction",
                        "f/f₀",
                        "force (N)",
                        "nearest double (N)",
                    ],
                    rows,
                );
            }
            Some(_) => self.paragraph("There are no contacts: the only layer rests on the floor."),
            None => self.paragraph(&format!(
                "The {} contact forces are too many for this page: {}",
                facts.contact_count,
                file("contacts.csv")
            )),
        }
        let Some(base) = &facts.base else {
            return self.paragraph(&format!(
                "The {} forces on the floor are too many for this page: {}",
                facts.base_count,
                file("base.csv")
            ));
        };
        self.paragraph("All forces of bottom spheres on the floor:");
        let exact = |value: &Value| format!("`{}`", value.exact);
        let rows = base.iter().map(|sphere| {
            let [x, y] = sphere.shear.each_ref().map(exact);
            [
                sphere.id.to_string(),
                place(sphere.site, dimension),
                exact(&sphere.normal),
                format!("`{:?}`", sphere.normal.float),
                x,
                y,
            ]
        });
        self.table(
            [
                "id",
                "sphere",
                "normal (N)",
                "nearest double (N)",
                "shear_x (N)",
                "shear_y (N)",
            ],
            rows,
        );
    }
}

/// f₀ in mg.
fn unit_force(facts: &Facts<'_, '_>) -> &'static str {
    let pile = facts.pile.pile();
    match pile.dimension() {
        Dimension::Two => "mg/(2 cos θ)",
        Dimension::Three if pile.is_regular() => "mg/(3 cos θ)",
        Dimension::Three => "mg/(2 (1 + sin φ) cos θ)",
    }
}

fn answer(what: &str, exact: String, float: String) -> [String; 3] {
    [what.to_owned(), exact, float]
}

fn valued(what: &str, value: &Value) -> [String; 3] {
    answer(
        what,
        format!("`{}` N", value.exact),
        format!("`{:?}` N", value.float),
    )
}
