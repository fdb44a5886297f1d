//! The card for people.

mod answers;
mod pile;

use super::CardTitle;
use super::facts::Facts;
use super::words;
use cannonpile::Verdict;
use cannonpile::lattice::{Dimension, Site};

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

/// `(k, i, j)`, of a disc `(k, i)`.
fn place(site: Site, dimension: Dimension) -> String {
    let Site { i, j, k } = site;
    match dimension {
        Dimension::Two => format!("({k}, {i})"),
        Dimension::Three => format!("({k}, {i}, {j})"),
    }
}
