//! What both cards say in words.

use super::CardTitle;
use super::facts::{Facts, Stands};
use super::lists::Contact;
use crate::numbered::NumberedPile;
use crate::scene::State;
use cannonpile::Verdict;
use cannonpile::lattice::Dimension;

/// What a code must satisfy.
pub(super) struct Criterion {
    pub(super) name: &'static str,
    pub(super) must: String,
    pub(super) check: String,
}

/// What the pile is, in a few words.
pub(super) fn title(pile: &NumberedPile<'_>, title: &CardTitle) -> String {
    let own = if title.title.is_empty() {
        let kind = match pile.pile().dimension() {
            Dimension::Two => "discs",
            Dimension::Three => "spheres",
        };
        let (count, layers) = (pile.numbering().sphere_count(), pile.pile().layers());
        format!(
            "A pile of {count} {kind} in {layers} {}",
            plural(layers, "layer")
        )
    } else {
        title.title.clone()
    };
    if title.case.is_empty() {
        own
    } else {
        format!("{}: {own}", title.case)
    }
}

pub(super) fn plural(count: i128, noun: &str) -> String {
    if count == 1 {
        noun.to_owned()
    } else {
        format!("{noun}s")
    }
}

/// `yes`, `no`, `undetermined`; none where it is not asked or not known.
pub(super) fn stands(facts: &Facts<'_, '_>) -> Option<&'static str> {
    match &facts.stands {
        Stands::Known(verdict) => Some(verdict.name()),
        Stands::NotAsked | Stands::TooLarge(_) => None,
    }
}

/// The verdict in words for people, with the reason where there is none.
pub(super) fn verdict(facts: &Facts<'_, '_>) -> &'static str {
    match &facts.stands {
        Stands::Known(verdict) => verdict.name(),
        Stands::NotAsked => "not asked of spheres without weight",
        Stands::TooLarge(_) => "not known",
    }
}

/// Whether the forces are those of a state that a code without cohesion can come to.
pub(super) fn is_attained(facts: &Facts<'_, '_>) -> bool {
    facts.pulling == 0_u32.into()
}

/// What must come out.
pub(super) fn outcome(facts: &Facts<'_, '_>) -> String {
    let attained = is_attained(facts);
    match &facts.stands {
        Stands::Known(Verdict::Yes) if attained => {
            "The pile stands: it comes to rest with the forces of this card.".to_owned()
        }
        Stands::Known(Verdict::Yes) => "The pile stands with horizontal contacts, which are not counted in here: the forces of \
             this card pull at some contacts, and a code comes to others (the elastic state has them)."
            .to_owned(),
        Stands::Known(Verdict::No) => {
            let least = facts.least.as_ref();
            let least = least.map_or_else(|| "contacts would have to pull".to_owned(), pull);
            format!(
                "The pile falls: {least}, and no forces that only push are in balance. A code without cohesion must lose \
                 contacts; the forces of this card are those that contacts would need."
            )
        }
        Stands::Known(Verdict::Undetermined) => "Whether the pile stands is not decided: some contacts would have to pull, and \
             further spheres touch that may take their part."
            .to_owned(),
        Stands::NotAsked if attained => "The spheres weigh nothing, and only the loads act: the forces of this card are the \
             response to them, and every contact without a force stays without."
            .to_owned(),
        Stands::NotAsked => "The spheres weigh nothing, and only the loads act: the forces of this card are the response to \
             them, a difference of two states. Some pull, so that a code of contacts that only push shows it only beside a \
             weight."
            .to_owned(),
        Stands::TooLarge(reason) => format!("Whether the pile stands was not found out: {reason}."),
    }
}

fn pull(least: &Contact) -> String {
    let [upper, lower] = least.ids;
    format!(
        "the contact of spheres {upper} and {lower} would have to pull with {} N",
        least.force.exact.trim_start_matches('-')
    )
}

/// The state of which the forces are.
pub(super) fn state(title: &CardTitle) -> String {
    match title.state {
        State::Isostatic => "isostatic: contacts between layers only".to_owned(),
        State::Elastic => {
            let ratio = title.stiffness_ratio.as_ref();
            let ratio = ratio.map_or_else(|| "1".to_owned(), ToString::to_string);
            format!(
                "elastic: springs that only push, horizontal ones {ratio} times as stiff as those between layers, in the \
                 limit of great stiffness"
            )
        }
    }
}

/// The option that names the scene for `cannonpile`.
fn scene_option(title: &CardTitle) -> String {
    if title.case.is_empty() {
        "--scene scene.toml".to_owned()
    } else {
        format!("--case {}", title.case)
    }
}

/// The command that compares.
pub(super) fn verify(facts: &Facts<'_, '_>, title: &CardTitle) -> String {
    format!(
        "cannonpile verify FORCES {} --accept {}",
        scene_option(title),
        facts.accept
    )
}

/// The command that writes the tables.
pub(super) fn export(title: &CardTitle, formats: &str) -> String {
    format!(
        "cannonpile export DIR {} --to {formats}",
        scene_option(title)
    )
}

/// Why measured forces differ from the exact ones, and by how much.
pub(super) fn tolerance() -> [&'static str; 3] {
    [
        "The spheres of this card are rigid. In a code with springs of stiffness k they sink into each other by F/k, \
         contacts turn a little, and forces are wrong by about F/(kR) of the greatest force, with F the greatest contact \
         force; a weak contact is wrong by as much, and so by more of itself.",
        "This error is of order 1 in 1/k: springs ten times as stiff make a tenth of it. An error that stays is a fault, or \
         friction, or a pile that is not yet at rest.",
        "It ends where the last digits of positions begin: about 1e-16 kR/F of the greatest force in double precision. \
         F/(kR) of 1e-6 to 1e-7 is a good place between the two.",
    ]
}

/// What a code must satisfy.
pub(super) fn criteria(facts: &Facts<'_, '_>, title: &CardTitle) -> Vec<Criterion> {
    let compliance = facts.stiffness.as_ref();
    let compliance =
        compliance.map_or_else(|| "1e-7".to_owned(), |k| format!("{:.1e}", k.compliance));
    let (verify, accept) = (verify(facts, title), &facts.accept);
    let criterion = |name, must: String, check: String| Criterion { name, must, check };
    if matches!(facts.stands, Stands::Known(Verdict::No)) {
        return vec![
            criterion(
                "contacts are lost",
                format!(
                    "Without cohesion and friction at least one of the {} contacts that would bear a force is lost.",
                    facts.bearing
                ),
                format!("`{verify}` ends with exit status 1, and says `missing` with a number above 0"),
            ),
            criterion(
                "no rest in this shape",
                "The code does not report a state at rest with all contacts.".to_owned(),
                "passes if spheres have moved by more than a tenth of R, or the code finds no solution".to_owned(),
            ),
        ];
    }
    if !is_attained(facts) {
        return vec![criterion(
            "forces",
            format!(
                "Forces of a code whose contacts may pull agree to {accept}; one whose contacts only push has no such state."
            ),
            format!("`{verify}` says `accepted yes`"),
        )];
    }
    let floor = criterion(
        "floor",
        format!(
            "The bottom spheres press on the floor with {} N together, and each as `base.csv` says.",
            facts.weight.exact
        ),
        format!("passes if the sum is right to {accept} of itself"),
    );
    if facts.bearing == 0_u32.into() {
        return vec![floor];
    }
    let mut criteria = vec![
        criterion(
            "contacts",
            format!(
                "Each of the {} contacts that bear a force is there, and no other pair of spheres bears more than {accept} of \
                 the greatest; pairs of fixed spheres do not count.",
                facts.bearing
            ),
            format!("`{verify}` says `missing 0` and `extra 0`"),
        ),
        criterion(
            "forces",
            format!(
                "With springs so stiff that F/(kR) is at most {compliance} no contact force is off by more than {accept} of \
                 itself, or of the greatest where it is 0; given as vectors, directions count."
            ),
            format!("`{verify}` says `accepted yes`, exit status 0"),
        ),
        floor,
        criterion(
            "order",
            "From springs with F/(kR) of 1e-5 to springs ten times as stiff the largest error falls to a tenth: order 1 in 1/k."
                .to_owned(),
            "passes if cannonpile verify --ladder K1=FILE1,K2=FILE2 tells an order between 0.9 and 1.1".to_owned(),
        ),
    ];
    if facts.idle > 0_u32.into() {
        criteria.insert(
            2,
            criterion(
                "no force where there is none",
                format!(
                    "The {} contacts without a force bear at most {accept} of the greatest, or are open.",
                    facts.idle
                ),
                "counted in by the two above".to_owned(),
            ),
        );
    }
    criteria
}

/// The paper and this library, as BibTeX.
pub(super) fn bibtex() -> String {
    format!(
        "@unpublished{{oron-herrmann-1998,\n  author = {{G. Oron and H. J. Herrmann}},\n  title  = {{Contact forces in regular \
         {{3D}} granular pile}},\n  year   = {{1998}}\n}}\n@software{{cannonpile,\n  author  = {{{{The cannonpile developers}}}},\n  title   = {{cannonpile: exact contact \
         forces in regular piles of spheres}},\n  version = {{{}}},\n  year    = {{2026}}\n}}",
        env!("CARGO_PKG_VERSION")
    )
}
