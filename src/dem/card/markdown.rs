//! The card for people.

use core::fmt::Display;

use super::CardTitle;
use super::facts::{Contact, Facts, Value};
use super::words;
use crate::Verdict;
use crate::lattice::{Dimension, Site};
use crate::table::stacking;

/// The card, whole.
pub(super) fn text(facts: &Facts<'_, '_>, title: &CardTitle, scene: Option<&str>) -> String {
    let mut card = Card(String::new());
    card.line(&format!("# {}", super::heading(facts.pile, title)));
    let version = env!("CARGO_PKG_VERSION");
    card.paragraph(&format!(
        "A static benchmark with an exact answer, for codes that compute the contact forces of frictionless spheres: DEM, \
         contact dynamics. Written by cannonpile {version}; `card.json` says the same to machines."
    ));
    if !title.purpose.is_empty() {
        card.paragraph(&format!("**What it tests.** {}", title.purpose));
    }
    card.paragraph(&format!(
        "**What must come out.** {}",
        words::outcome(facts)
    ));
    card.pile(facts, title, scene);
    card.equations(facts, title);
    card.answers(facts, title);
    card.tolerance(facts, title);
    card.criteria(facts, title);
    card.head("How to cite");
    let name = if title.case.is_empty() {
        "this card, with its scene,".to_owned()
    } else {
        format!("\"{} of the cases of cannonpile\"", title.case)
    };
    card.paragraph(&format!("The paper whose solution this is, and the library with its version; name {name} beside them."));
    card.block("bibtex", &words::bibtex());
    card.0
}

/// The text so far.
struct Card(String);

impl Card {
    fn line(&mut self, line: &str) {
        self.0.extend([line, "\n"]);
    }

    fn paragraph(&mut self, text: &str) {
        self.0.extend(["\n", text, "\n"]);
    }

    fn head(&mut self, head: &str) {
        self.paragraph(&format!("## {head}"));
    }

    fn block(&mut self, kind: &str, text: &str) {
        self.paragraph(&format!("```{kind}\n{}\n```", text.trim_end()));
    }

    /// A table: `heads` and all rows have the same length.
    fn table<const N: usize>(&mut self, heads: [&str; N], rows: impl Iterator<Item = [String; N]>) {
        self.line("");
        self.line(&format!("| {} |", heads.join(" | ")));
        self.line(&format!("|{}", "---|".repeat(N)));
        for row in rows {
            self.line(&format!("| {} |", row.join(" | ")));
        }
    }

    fn pile(&mut self, facts: &Facts<'_, '_>, title: &CardTitle, scene: Option<&str>) {
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

    fn equations(&mut self, facts: &Facts<'_, '_>, title: &CardTitle) {
        self.head("Equations");
        self.paragraph(
            "For each sphere p above the bottom layer, with the unit vector n_pq that points from the centre of q to that of p, and \
             a sum over all q that touch p:",
        );
        self.block(
            "text",
            "Σ_q f_pq n_pq = (W_p + P_p) e_z,    f_pq = f_qp,    n_pq = (x_p − x_q)/(2R)",
        );
        let weight = if facts.pile.pile().is_weightless() {
            "W_p = 0"
        } else {
            "W_p = mg"
        };
        self.paragraph(&format!(
            "{weight} is the weight and P_p the load, downwards; f is positive for a push. The floor feels the sum of what rests on a \
             bottom sphere and of its own weight and load, and holds it in its place: `normal` downwards, `shear_x` and `shear_y`."
        ));
        let unknowns = match title.state {
            crate::scene::State::Isostatic => {
                "Each sphere brings as many contacts as equations, so the forces are unique; all are a rational multiple of \
                 f₀, below."
            }
            crate::scene::State::Elastic => {
                "Neighbours of a layer touch, and there are more contacts than equations. Among all forces f ≥ 0 in balance \
                 the elastic state is the one with the least energy Σ f²/(2k) of springs; it is unique."
            }
        };
        self.paragraph(unknowns);
    }

    fn answers(&mut self, facts: &Facts<'_, '_>, title: &CardTitle) {
        self.head("Answers");
        let verdict = words::stands(facts).unwrap_or("not asked");
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

    fn tolerance(&mut self, facts: &Facts<'_, '_>, title: &CardTitle) {
        self.head("Tolerance");
        for paragraph in words::tolerance() {
            self.paragraph(paragraph);
        }
        let Some(stiffness) = &facts.stiffness else {
            return;
        };
        if words::is_attained(facts)
            || matches!(facts.stands, super::facts::Stands::Known(Verdict::No))
        {
            self.paragraph(&format!(
                "The scripts for LAMMPS and YADE (`{}`) have springs of k = {:.3e} N/m, so that F/(kR) is {:.1e}.",
                words::export(title, "lammps,yade"),
                stiffness.spring,
                stiffness.compliance,
            ));
        }
    }

    fn criteria(&mut self, facts: &Facts<'_, '_>, title: &CardTitle) {
        self.head("What a code must satisfy");
        for (number, criterion) in (1..).zip(words::criteria(facts, title)) {
            let name = criterion.name;
            self.paragraph(&format!(
                "{number}. **{name}.** {} *Check:* {}.",
                criterion.must, criterion.check
            ));
        }
        self.paragraph(
            "FORCES is a table `id1,id2,force` (with `fx,fy,fz`, the force on id1, directions are compared too), ids as above, \
             or a `dump local` of LAMMPS with these columns.",
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

fn row(what: &str, value: String) -> [String; 2] {
    [what.to_owned(), value]
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

/// `(k, i, j)`, of a disc `(k, i)`.
fn place(site: Site, dimension: Dimension) -> String {
    let Site { i, j, k } = site;
    match dimension {
        Dimension::Two => format!("({k}, {i})"),
        Dimension::Three => format!("({k}, {i}, {j})"),
    }
}
