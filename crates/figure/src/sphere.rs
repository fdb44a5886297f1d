//! The forces on one sphere, as in fig. 3 of the paper.

use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile::{Load, Pile};
use num_rational::BigRational;

use super::caption::caption;
use super::colour::{BLACK, COMPRESSION, DIM, GREY, ORANGE, Scale, TENSION};
use super::glyph::{Glyph, Point, arrow, circle, line, ring, text};
use super::page::Figure;
use super::panel::Panel;
use super::pile::shade;
use super::response::middle;
use super::subject::{Subject, below};
use super::ticks::{exact_or_short, short};
use super::view::{Vector, View, add_scaled, norm};
use crate::Error;

/// The direction of the camera, in degrees. From this direction no force hides another.
const AZIMUTH: f64 = 190.0;
const ELEVATION: f64 = 24.0;

/// The length of the largest force, and the largest length of the weight, in R.
const LONGEST: f64 = 1.55;
const WEIGHT: f64 = 0.85;

/// The length below which an arrow gets a ring, in pixels.
const SMALL: f64 = 9.0;

/// The upper and the left edge of the table on the page, in pixels.
const TABLE: f64 = 40.0;
const LEFT: f64 = 532.0;

const DOWN: Vector = [0.0, 0.0, -1.0];

/// A force on a sphere.
struct Force {
    /// `a`, `b`, `c` from below, `a′`, `b′`, `c′` from above, `w` for the weight, `p` for a load, `n` for the floor.
    name: &'static str,
    origin: &'static str,
    /// The magnitude; negative for tension.
    magnitude: f64,
    /// The unit vector of a compressive force.
    along: Vector,
    /// The point of application relative to the centre, in R.
    at: Vector,
    /// The force in f₀, for a contact.
    multiple: Option<BigRational>,
    /// The length of the arrow, in R.
    length: f64,
}

impl Force {
    fn new(
        [name, origin]: [&'static str; 2],
        magnitude: f64,
        along: Vector,
        at: Vector,
        multiple: Option<BigRational>,
    ) -> Self {
        Self {
            name,
            origin,
            magnitude,
            along,
            at,
            multiple,
            length: 0.0,
        }
    }
}

/// Returns the default sphere of [`sphere()`], near the middle of the middle layer.
///
/// # Errors
/// This function never fails: every pile has a middle sphere.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::lattice::Site;
///
/// let site = cannonpile_figure::example_site(&Pile::triangular(10)?)?;
/// assert_eq!(site, Site { i: 2, j: 2, k: 5 });
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn example_site(pile: &Pile) -> Result<Site, Error> {
    middle(pile, pile.layers() / 2)
}

/// Draws the forces that act on one sphere, as arrows to scale, with a table of their values.
///
/// The names are those of fig. 3 of the paper: **a**, **b** and **c** from the three spheres below, **a**′, **b**′ and
/// **c**′ from those above, and the weight **w**. A load is **p**, and the force of the floor is **n**.
///
/// The arrow of a compressive force ends at the contact point, and that of a tensile force begins there. A force too small
/// for an arrow has a ring. Arrows are `<polygon class="arrow" data-name="a" data-force="…" data-x="…" …>`, with the
/// components of the force.
///
/// # Errors
/// [`SiteOutside`](cannonpile::Error::SiteOutside) if there is no such sphere;
/// [`Overflow`](cannonpile::Error::Overflow) for forces outside the range of `f64`.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_figure::Subject;
/// use cannonpile::geometry::Spacing;
/// use cannonpile::lattice::Site;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(10)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let svg = cannonpile_figure::sphere(&Subject::of_pile(&pile, &spacing)?, Site { i: 1, j: 2, k: 5 })?.to_string();
/// // Six contact forces, and the weight.
/// assert_eq!(svg.matches("class=\"neighbour\"").count(), 6);
/// assert_eq!(svg.matches("class=\"arrow\"").count(), 7);
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn sphere(subject: &Subject<'_>, site: Site) -> Result<Figure, Error> {
    let site = subject.pile().shape().check(site)?;
    let (mut forces, neighbours) = forces(subject, site)?;
    to_scale(&mut forces);
    let discs = subject.is_of_discs();
    let view = View::of(discs, [0.0; 3], [AZIMUTH, ELEVATION], f64::INFINITY);
    let around = neighbours.iter().map(|centre| view.across(*centre));
    let centres = around.chain([[0.0; 2]]);
    let panel = Panel::around(centres, 1.1, [6.4, 6.8], [20.0, 290.0, 24.0]);
    let radius = panel.length(1.0);
    let place = |vector: Vector| panel.at(view.across(vector));

    // Glyphs behind the sphere are drawn first.
    let mut glyphs = vec![shade("sphere", ["#ebf1f7", "#9db9d6", "#4b5661"])];
    for centre in &neighbours {
        let outline = ring(place(*centre), radius, GREY, 1.0).class("neighbour");
        glyphs.push(outline.set("stroke-dasharray", "5 4"));
    }
    let shown = forces.iter().filter(|force| force.magnitude != 0.0);
    let (behind, before): (Vec<_>, Vec<_>) =
        shown.partition(|force| view.towards(force.at) < -1e-9);
    glyphs.extend(behind.iter().flat_map(|force| force.arrow(place)));
    let centre = circle(place([0.0; 3]), radius).class("sphere").of(site);
    let centre = centre.fill("url(#sphere)").set("fill-opacity", 0.62);
    glyphs.push(centre.stroke(BLACK, 1.0));
    glyphs.extend(before.iter().flat_map(|force| force.arrow(place)));
    glyphs.extend(forces.iter().flat_map(|force| force.letter(place)));
    let mut shown = behind.iter().chain(&before);
    let small = shown.any(|force| force.is_small(place));
    glyphs.extend(table(subject, &forces, small)?);
    glyphs.extend(view.axes([92.0, panel.page - 34.0], discs));
    let Site { i, j, k } = site;
    let title = if discs {
        format!("Forces on the disc k = {k}, i = {i}")
    } else {
        format!("Forces on the sphere k = {k}, i = {i}, j = {j}")
    };
    let title = title.replace('-', "−");
    Ok(Figure {
        note: subject.note_of_part(forces.iter().any(|force| force.magnitude < 0.0)),
        ..Figure::new(title, caption(subject)?, panel, glyphs)
    })
}

/// Returns the forces on a sphere, and the positions of its neighbours relative to its centre, in R.
fn forces(subject: &Subject<'_>, site: Site) -> Result<(Vec<Force>, Vec<Vector>), Error> {
    let pile = subject.pile();
    let directions = pile.dimension().directions();
    let mut touching = Vec::new();
    let received = subject.forces().from_above(site)?;
    let lines = directions.iter().zip(received);
    for ((direction, force), name) in lines.zip(["a′", "b′", "c′"]) {
        if let Some(upper) = pile.shape().above(site, *direction) {
            touching.push(([name, "from above"], force, upper));
        }
    }
    let on_floor = site.k == pile.layers() - 1;
    if !on_floor {
        let contacts = subject.forces().contacts(Selection::One(site))?;
        for (contact, name) in contacts.zip(["a", "b", "c"]) {
            let contact = contact?;
            let lower = below(pile, site, contact.direction)?;
            touching.push(([name, "from below"], contact.force, lower));
        }
    }
    let (mut forces, mut neighbours) = (Vec::new(), Vec::new());
    for (words, multiple, other) in touching {
        let apart = subject.from(site, other)?;
        neighbours.push(apart);
        let (at, along) = (apart.map(|x| x / 2.0), apart.map(|x| x / -2.0));
        let magnitude = subject.force(&multiple)?;
        forces.push(Force::new(words, magnitude, along, at, Some(multiple)));
    }
    if on_floor {
        let [x, y, normal] = subject.on_floor(site)?;
        let (force, along) = directed([-x, -y, normal]);
        let words = ["n", "from the floor"];
        forces.push(Force::new(words, force, along, DOWN, None));
    }
    let weight = Load::leaning(pile.sphere_weight(site)?, pile.tilt());
    let (weight, along) = directed(subject.load(weight)?);
    let centre = [0.0; 3];
    forces.push(Force::new(["w", "weight"], weight, along, centre, None));
    let load = pile.load(site)?;
    if !load.is_zero() {
        let (load, along) = directed(subject.load(load)?);
        let at = along.map(|part| -part);
        forces.push(Force::new(["p", "load"], load, along, at, None));
    }
    Ok((forces, neighbours))
}

/// Returns the magnitude and the direction of a force. The direction of no force is downwards.
fn directed(force: Vector) -> (f64, Vector) {
    let [x, y, z] = force;
    let magnitude = x.hypot(y).hypot(z);
    let along = force.map(|part| part / magnitude);
    (magnitude, if magnitude > 0.0 { along } else { DOWN })
}

/// Sets the lengths of the arrows, on a common scale. The arrow of the weight stays inside the sphere.
fn to_scale(forces: &mut [Force]) {
    let scale = Scale::around_zero(forces.iter().map(|force| force.magnitude));
    let weight = forces.iter().find(|force| force.name == "w");
    let weight = weight.map_or(0.0, |weight| scale.part(weight.magnitude));
    let longest = LONGEST.min(WEIGHT / weight);
    for force in forces {
        force.length = scale.part(force.magnitude) * longest;
    }
}

impl Force {
    /// Returns the tail and the tip of the arrow.
    ///
    /// The weight begins at the centre. A compressive force ends at its contact point, and a tensile force begins there.
    fn ends(&self) -> [Vector; 2] {
        let far = |length| add_scaled(self.at, length, self.along);
        if norm(self.at) == 0.0 || self.length < 0.0 {
            [self.at, far(self.length)]
        } else {
            [far(-self.length), self.at]
        }
    }

    /// Returns whether the arrow is too short to be visible.
    fn is_small(&self, place: impl Fn(Vector) -> Point) -> bool {
        let [tail, tip] = self.ends().map(place);
        (tip[0] - tail[0]).hypot(tip[1] - tail[1]) < SMALL
    }

    /// Returns the arrow, and a ring if the arrow is too short to be visible.
    fn arrow(&self, place: impl Fn(Vector) -> Point) -> Vec<Glyph> {
        let [tail, tip] = self.ends().map(&place);
        let [x, y, z] = self.along.map(|part| part * self.magnitude);
        let glyph = arrow(tail, tip, 4.0, self.colour()).set("data-name", self.name);
        let glyph = glyph.with_value("data-force", self.magnitude);
        let glyph = glyph.with_value("data-x", x).with_value("data-y", y);
        let mut glyphs = vec![glyph.with_value("data-z", z)];
        if self.is_small(&place) {
            glyphs.push(ring(place(self.at), 7.0, self.colour(), 2.0).class("small"));
        }
        glyphs
    }

    /// Returns the name of the force as a label, at the end of the arrow that is farther from the sphere. The label of
    /// the weight is beside its arrow.
    fn letter(&self, place: impl Fn(Vector) -> Point) -> [Glyph; 2] {
        const BEYOND: f64 = 16.0;
        let [tail, tip] = self.ends();
        let at = if norm(self.at) == 0.0 {
            let [[x, y], [_, below]] = [place(tail), place(tip)];
            [x - BEYOND, y.midpoint(below)]
        } else {
            let far = if norm(tail) > norm(tip) { tail } else { tip };
            let [from, to] = [place([0.0; 3]), place(self.at)];
            let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
            let beyond = BEYOND / dx.hypot(dy).max(1.0);
            let [x, y] = place(far);
            [x + dx * beyond, y + dy * beyond]
        };
        let letter = text(at, 19.0, self.name).bold().italic();
        letter.fill(self.colour()).with_rim()
    }

    fn colour(&self) -> &'static str {
        match self.name {
            "w" | "p" => ORANGE,
            _ if self.magnitude < 0.0 => TENSION,
            _ => COMPRESSION,
        }
    }
}

fn table(subject: &Subject<'_>, forces: &[Force], small: bool) -> Result<Vec<Glyph>, Error> {
    let unit = subject.force_unit();
    let [words, multiples, values] = [LEFT + 30.0, LEFT + 172.0, LEFT + 248.0];
    let mut y = TABLE + 14.0;
    let mut glyphs = vec![
        text([multiples, TABLE], 13.0, "f₀").fill(DIM).end(),
        text([values, TABLE], 13.0, unit).fill(DIM).end(),
        line([LEFT, y], [values, y], GREY, 1.0),
    ];
    for force in forces {
        y += 22.0;
        let name = text([LEFT, y], 14.0, force.name).bold().italic().start();
        glyphs.push(name.fill(force.colour()));
        glyphs.push(text([words, y], 13.0, force.origin).start());
        if let Some(multiple) = &force.multiple {
            let words = exact_or_short(multiple);
            glyphs.push(text([multiples, y], 14.0, words).end());
        }
        glyphs.push(text([values, y], 14.0, short(force.magnitude)).end());
    }
    let (value, formula) = subject.unit_force()?;
    let unit_force = format!("f₀ = {formula} = {} {unit}", short(value));
    let is_tensile = forces.iter().any(|force| force.magnitude < 0.0);
    let remarks = [
        (true, BLACK, unit_force.as_str()),
        (is_tensile, TENSION, "− is tension"),
        (small, DIM, "○ is too small for an arrow"),
    ];
    y += 12.0;
    for (_, colour, words) in remarks.into_iter().filter(|(shown, ..)| *shown) {
        y += 22.0;
        glyphs.push(text([LEFT, y], 13.0, words).fill(colour).start());
    }
    Ok(glyphs)
}
