//! The forces on one sphere: the paper's fig. 3.

use num_rational::BigRational;
use num_traits::Zero;

use super::caption::caption;
use super::colour::{BLACK, DIM, GREY, ORANGE, PULL, PUSH, Scale};
use super::mark::{Mark, Point, arrow, circle, line, ring, text};
use super::page::Figure;
use super::panel::Panel;
use super::pile::shade;
use super::response::middle;
use super::subject::{Subject, below, load};
use super::ticks::{exact_or_short, short};
use super::view::{Vector, View, moved, norm};
use crate::lattice::Site;
use crate::shape::Selection;
use crate::{Error, Pile};

/// The camera, so turned that no force hides another.
const AZIMUTH: f64 = 190.0;
const ELEVATION: f64 = 24.0;

/// The length of the greatest force, and the greatest of the weight, in R.
const LONGEST: f64 = 1.55;
const WEIGHT: f64 = 0.85;

/// The length below which an arrow gets a ring, in pixels.
const SMALL: f64 = 9.0;

/// Where the table is on the page.
const TABLE: f64 = 40.0;
const LEFT: f64 = 532.0;

const UP: Vector = [0.0, 0.0, 1.0];
const DOWN: Vector = [0.0, 0.0, -1.0];

/// A force on a sphere.
struct Force {
    /// `a`, `b`, `c` from below, `a′`, `b′`, `c′` from above, `w` for the weight, `p` for a load, `n` for the floor.
    name: &'static str,
    origin: &'static str,
    /// Negative is pull.
    magnitude: f64,
    /// The unit vector along it.
    along: Vector,
    /// Where it acts, from the centre, in R.
    at: Vector,
    /// A contact force in f₀.
    multiple: Option<BigRational>,
}

/// Returns the sphere that is shown where none is chosen: one near the middle of the layer in the middle.
///
/// # Errors
/// None: every pile has such a sphere.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::figure;
/// use cannonpile::lattice::Site;
///
/// let site = figure::example(&Pile::triangular(10)?)?;
/// assert_eq!(site, Site { i: 2, j: 2, k: 5 });
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn example(pile: &Pile) -> Result<Site, Error> {
    middle(pile, pile.layers() / 2)
}

/// Returns the forces that act on one sphere, as arrows as long as the forces, and a table of their values.
///
/// Paper, fig. 3: **a**, **b** and **c** from the three spheres below, **a**′, **b**′ and **c**′ from those above, and the
/// weight **w**. A load **p** is a force of its own; under a bottom sphere is the floor, with its force **n**. A force that
/// pushes ends on the surface of the sphere, where it acts; one that pulls begins there. One too small for an arrow has a
/// ring. Arrows are `<polygon class="arrow" data-name="a" data-force="…" data-x="…" …>`, with the components of the force.
///
/// # Errors
/// [`Error::SiteOutside`]; [`Error::Overflow`] for forces beyond floats.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::figure::{self, Subject};
/// use cannonpile::geometry::Spacing;
/// use cannonpile::lattice::Site;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(10)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let svg = figure::sphere(&Subject::of_pile(&pile, &spacing)?, Site { i: 1, j: 2, k: 5 })?.to_string();
/// // Six forces of neighbours, and the weight.
/// assert_eq!(svg.matches("class=\"neighbour\"").count(), 6);
/// assert_eq!(svg.matches("class=\"arrow\"").count(), 7);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn sphere(subject: &Subject<'_>, site: Site) -> Result<Figure, Error> {
    let site = subject.pile().shape().check(site)?;
    let (forces, neighbours) = forces(subject, site)?;
    let discs = subject.is_of_discs();
    let view = if discs {
        View::of_discs([0.0; 3])
    } else {
        View::new([0.0; 3], AZIMUTH, ELEVATION, f64::INFINITY)
    };
    let around = neighbours.iter().map(|centre| view.across(*centre));
    let centres = around.chain([[0.0; 2]]);
    let panel = Panel::around(centres, 1.1, [6.4, 6.8], [20.0, 290.0, 24.0]);
    let radius = panel.length(1.0);
    let place = |vector: Vector| panel.at(view.across(vector));

    // The sphere in its neighbours' midst: what is behind it first.
    let mut marks = vec![shade("sphere", ["#ebf1f7", "#9db9d6", "#4b5661"])];
    for centre in &neighbours {
        let outline = ring(place(*centre), radius, GREY, 1.0).class("neighbour");
        marks.push(outline.set("stroke-dasharray", "5 4"));
    }
    let lengths = lengths(&forces);
    let shown = || {
        forces
            .iter()
            .zip(&lengths)
            .filter(|(force, _)| force.magnitude != 0.0)
    };
    let is_behind = |force: &Force| view.towards(force.at) < -1e-9;
    let behind = shown().filter(|(force, _)| is_behind(force));
    marks.extend(behind.flat_map(|(force, length)| arrows(force, *length, place)));
    let centre = circle(place([0.0; 3]), radius).class("sphere").of(site);
    marks.push(
        centre
            .fill("url(#sphere)")
            .set("fill-opacity", 0.62)
            .stroke(BLACK, 1.0),
    );
    let before = shown().filter(|(force, _)| !is_behind(force));
    marks.extend(before.flat_map(|(force, length)| arrows(force, *length, place)));
    let named = forces.iter().zip(&lengths);
    marks.extend(named.flat_map(|(force, length)| letter(force, *length, place)));
    let small = shown().any(|(force, length)| arrows(force, *length, place).len() > 1);
    marks.extend(table(subject, &forces, small)?);
    marks.extend(view.axes([92.0, panel.page - 34.0], discs));
    let Site { i, j, k } = site;
    let title = if discs {
        format!("Forces on the disc k = {k}, i = {i}")
    } else {
        format!("Forces on the sphere k = {k}, i = {i}, j = {j}")
    };
    let title = title.replace('-', "−");
    Ok(Figure {
        note: subject.note_of_part(forces.iter().any(|force| force.magnitude < 0.0)),
        ..Figure::new(title, caption(subject)?, panel, marks)
    })
}

/// Returns the forces on a sphere, and where its neighbours are from its centre, in R.
fn forces(subject: &Subject<'_>, site: Site) -> Result<(Vec<Force>, Vec<Vector>), Error> {
    let pile = subject.pile();
    let directions = pile.dimension().directions();
    let mut touching = Vec::new();
    for ((&direction, force), name) in directions
        .iter()
        .zip(subject.received(site)?)
        .zip(["a′", "b′", "c′"])
    {
        if let Some(upper) = pile.shape().above(site, direction) {
            touching.push((name, "from above", force, upper));
        }
    }
    let on_floor = site.k == pile.layers() - 1;
    if !on_floor {
        let names = ["a", "b", "c"].into_iter();
        for (contact, name) in subject.contacts(Selection::One(site))?.zip(names) {
            let contact = contact?;
            let lower = below(pile, site, contact.direction)?;
            touching.push((name, "from below", contact.force, lower));
        }
    }
    let (mut forces, mut neighbours) = (Vec::new(), Vec::new());
    for (name, origin, multiple, other) in touching {
        let apart = subject.from(site, other)?;
        neighbours.push(apart);
        let at = apart.map(|part| part / 2.0);
        forces.push(Force {
            name,
            origin,
            magnitude: subject.force(&multiple)?,
            along: at.map(|part| -part),
            at,
            multiple: Some(multiple),
        });
    }
    if on_floor {
        forces.push(from_floor(subject.on_floor(site)?));
    }
    let mut weights = vec![("w", "weight", pile.sphere_weight(site)?, 0.0)];
    let load = load(pile, site);
    if !load.is_zero() {
        weights.push(("p", "load", load, 1.0));
    }
    for (name, origin, weight, height) in weights {
        forces.push(Force {
            name,
            origin,
            magnitude: subject.weight(weight)?,
            along: DOWN,
            at: [0.0, 0.0, height],
            multiple: None,
        });
    }
    Ok((forces, neighbours))
}

/// Returns what the floor does to a bottom sphere: the opposite of what it feels, which is normal downwards.
fn from_floor([x, y, normal]: Vector) -> Force {
    let magnitude = x.hypot(y).hypot(normal);
    let along = [-x, -y, normal].map(|part| part / magnitude);
    Force {
        name: "n",
        origin: "from the floor",
        magnitude,
        along: if magnitude > 0.0 { along } else { UP },
        at: DOWN,
        multiple: None,
    }
}

/// Returns how long the arrows are, in R: all in one scale, in which the weight stays within the sphere.
fn lengths(forces: &[Force]) -> Vec<f64> {
    let scale = Scale::around_zero(forces.iter().map(|force| force.magnitude));
    let weight = forces.iter().find(|force| force.name == "w");
    let weight = weight.map_or(0.0, |weight| scale.part(weight.magnitude));
    let longest = LONGEST.min(WEIGHT / weight);
    let length = |force: &Force| scale.part(force.magnitude) * longest;
    forces.iter().map(length).collect()
}

/// Returns the ends of an arrow: the weight begins in the centre, what pushes ends on the surface, and what pulls begins
/// there.
fn ends(force: &Force, length: f64) -> [Vector; 2] {
    let far = |length| moved(force.at, length, force.along);
    if norm(force.at) == 0.0 || length < 0.0 {
        [force.at, far(length)]
    } else {
        [far(-length), force.at]
    }
}

/// Returns the arrow of a force, and a ring where it is too short to be seen.
fn arrows(force: &Force, length: f64, place: impl Fn(Vector) -> Point) -> Vec<Mark> {
    let [tail, tip] = ends(force, length).map(&place);
    let [x, y, z] = force.along.map(|part| part * force.magnitude);
    let mark = arrow(tail, tip, 4.0, colour(force)).set("data-name", force.name);
    let mark = mark.valued("data-force", force.magnitude);
    let mut marks = vec![
        mark.valued("data-x", x)
            .valued("data-y", y)
            .valued("data-z", z),
    ];
    if (tip[0] - tail[0]).hypot(tip[1] - tail[1]) < SMALL {
        marks.push(ring(place(force.at), 7.0, colour(force), 2.0).class("small"));
    }
    marks
}

/// Returns the letter of a force, at the end that is farther from the sphere; that of the weight beside it.
fn letter(force: &Force, length: f64, place: impl Fn(Vector) -> Point) -> [Mark; 2] {
    const BEYOND: f64 = 16.0;
    let [tail, tip] = ends(force, length);
    let at = if norm(force.at) == 0.0 {
        let [[x, y], [_, below]] = [place(tail), place(tip)];
        [x - BEYOND, y.midpoint(below)]
    } else {
        let far = if norm(tail) > norm(tip) { tail } else { tip };
        let [from, to] = [place([0.0; 3]), place(force.at)];
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let beyond = BEYOND / dx.hypot(dy).max(1.0);
        let [x, y] = place(far);
        [x + dx * beyond, y + dy * beyond]
    };
    let letter = text(at, 19.0, force.name).bold().italic();
    letter.fill(colour(force)).with_rim()
}

fn table(subject: &Subject<'_>, forces: &[Force], small: bool) -> Result<Vec<Mark>, Error> {
    let unit = subject.force_unit();
    let [words, multiples, values] = [LEFT + 30.0, LEFT + 172.0, LEFT + 248.0];
    let mut y = TABLE + 14.0;
    let mut marks = vec![
        text([multiples, TABLE], 13.0, "f₀").fill(DIM).end(),
        text([values, TABLE], 13.0, unit).fill(DIM).end(),
        line([LEFT, y], [values, y], GREY, 1.0),
    ];
    for force in forces {
        y += 22.0;
        let name = text([LEFT, y], 14.0, force.name).bold().italic().start();
        marks.push(name.fill(colour(force)));
        marks.push(text([words, y], 13.0, force.origin).start());
        if let Some(multiple) = &force.multiple {
            let words = exact_or_short(multiple);
            marks.push(text([multiples, y], 14.0, words).end());
        }
        marks.push(text([values, y], 14.0, short(force.magnitude)).end());
    }
    let (value, formula) = subject.unit_force()?;
    let unit_force = format!("f₀ = {formula} = {} {unit}", short(value));
    let pulls = forces.iter().any(|force| force.magnitude < 0.0);
    let remarks = [
        (true, BLACK, unit_force.as_str()),
        (pulls, PULL, "− is pull"),
        (small, DIM, "○ is too small for an arrow"),
    ];
    y += 12.0;
    for (_, colour, words) in remarks.into_iter().filter(|(shown, ..)| *shown) {
        y += 22.0;
        marks.push(text([LEFT, y], 13.0, words).fill(colour).start());
    }
    Ok(marks)
}

fn colour(force: &Force) -> &'static str {
    match force.name {
        "w" | "p" => ORANGE,
        _ if force.magnitude < 0.0 => PULL,
        _ => PUSH,
    }
}
