//! The forces on a sphere as arrows, and a table of their values.

use super::{SphereForce, SphereForces};
use crate::figure::canvas::{Canvas, Drawing, Point, arrow, circle, line, ring};
use crate::figure::colour::{BLACK, BLUE, Colour, DIM, GREY, ORANGE};
use crate::figure::label::{Hold, Label};
use crate::figure::of;
use crate::figure::panel::{Bounds, Margins, Panel};
use crate::figure::picture::axes;
use crate::figure::ticks::{exact_or_short, short};
use crate::figure::view::{Vector, View, moved, norm};
use crate::lattice::Site;
use crate::scalar::Surd;

impl SphereForces {
    /// The figure: arrows as long as the forces, and a table of their values.
    ///
    /// A force that pushes ends on the surface of the sphere, where it acts; one that pulls begins there.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{SphereForces, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let subject = Subject::of_pile(&pile, &spacing)?;
    /// let svg = SphereForces::new(&subject, Site { i: 1, j: 2, k: 5 })?.drawing().to_string();
    /// // Six forces of neighbours, and the weight.
    /// assert_eq!(svg.matches("class=\"neighbour\"").count(), 6);
    /// assert_eq!(svg.matches("class=\"arrow\"").count(), 7);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn drawing(&self) -> Drawing {
        let view = if self.discs {
            View::of_discs([0.0; 3])
        } else {
            View::new([0.0; 3], AZIMUTH, ELEVATION, f64::INFINITY)
        };
        let lengths = self.lengths();
        let shafts: Vec<Shaft<'_>> = self
            .forces
            .iter()
            .zip(lengths)
            .map(|(force, length)| Shaft::new(force, length))
            .collect();
        let around = self.neighbours.iter().map(|centre| view.across(*centre));
        let bounds = Bounds::around(around.chain([[0.0; 2]]), 1.1).at_least(6.4, 6.8);
        let margins = Margins {
            left: 20.0,
            right: 290.0,
            below: 24.0,
        };
        let panel = Panel::fitting(bounds, margins);
        let Site { i, j, k } = self.site;
        let title = if self.discs {
            format!("Forces on the disc k = {k}, i = {i}")
        } else {
            format!("Forces on the sphere k = {k}, i = {i}, j = {j}")
        }
        .replace('-', "−");
        let height = panel.page_height().max(TABLE + 24.0 * 12.0);
        let mut canvas = Canvas::new(height, &title, &self.caption);
        canvas.shading("sphere", Colour::new(0x9d, 0xb9, 0xd6));
        let radius = panel.length(1.0);
        let place = |vector: Vector| panel.at(view.across(vector));
        // The sphere in its neighbours' midst: what is behind it first.
        for centre in &self.neighbours {
            let outline = ring(place(*centre), radius, GREY, 1.0).set("class", "neighbour");
            canvas.add(outline.set("stroke-dasharray", "5 4"));
        }
        let (behind, before): (Vec<_>, Vec<_>) = shafts
            .iter()
            .partition(|shaft| view.towards(shaft.force.at) < -1e-9);
        for shaft in behind {
            shaft.draw(&mut canvas, place);
        }
        let mark = circle(place([0.0; 3]), radius)
            .set("class", "sphere")
            .set("fill", "url(#sphere)")
            .set("fill-opacity", 0.62)
            .set("stroke", BLACK.to_string());
        canvas.add(of(self.site, mark));
        for shaft in before {
            shaft.draw(&mut canvas, place);
        }
        for shaft in &shafts {
            shaft.name(&mut canvas, place);
        }
        self.table(&mut canvas);
        let corner = [56.0, height - 76.0];
        axes(&mut canvas, &view, corner, self.discs);
        canvas.finish()
    }

    /// How long the arrows are, in R: all in one scale, in which the weight stays within the sphere.
    fn lengths(&self) -> Vec<f64> {
        let magnitudes = self.forces.iter().map(|force| force.magnitude.abs());
        let greatest = magnitudes.fold(0.0, f64::max);
        let part = |force: &SphereForce| {
            let part = force.magnitude / greatest;
            if part.is_finite() { part } else { 0.0 }
        };
        let weight = self.forces.iter().find(|force| force.name == "w");
        let weight = weight.map_or(0.0, part);
        let longest = if weight * LONGEST > WEIGHT {
            WEIGHT / weight
        } else {
            LONGEST
        };
        self.forces
            .iter()
            .map(|force| part(force) * longest)
            .collect()
    }

    fn table(&self, canvas: &mut Canvas) {
        let columns = [WHERE, WHERE + 30.0, WHERE + 172.0, WHERE + 248.0];
        let cell = |canvas: &mut Canvas, n: usize, y: f64, label: Label| {
            let hold = if n < 2 { Hold::Start } else { Hold::End };
            let x = columns.get(n).copied().unwrap_or(WHERE);
            canvas.add(label.hold(hold).at([x, y]));
        };
        let mut y = TABLE;
        cell(canvas, 2, y, Label::new("f₀").size(13.0).colour(DIM));
        cell(canvas, 3, y, Label::new(self.unit).size(13.0).colour(DIM));
        y += 14.0;
        canvas.add(line([WHERE, y], [WHERE + 248.0, y], GREY, 1.0));
        for force in &self.forces {
            y += 22.0;
            let colour = colour(force);
            cell(canvas, 0, y, name(force).colour(colour));
            cell(canvas, 1, y, Label::new(told(force)).size(13.0));
            if let Some(multiple) = &force.multiple {
                let value = Surd::from(multiple.clone()).nearest().unwrap_or(0.0);
                let text = exact_or_short(&multiple.to_string(), value);
                cell(canvas, 2, y, Label::new(text));
            }
            cell(canvas, 3, y, Label::new(short(force.magnitude)));
        }
        y += 34.0;
        let (value, meaning) = self.unit_force;
        let text = format!("f₀ = {meaning} = {} {}", short(value), self.unit);
        cell(canvas, 0, y, Label::new(text).size(13.0));
        if self.forces.iter().any(|force| force.magnitude < 0.0) {
            y += 22.0;
            cell(
                canvas,
                0,
                y,
                Label::new("− is pull").size(13.0).colour(ORANGE),
            );
        }
    }
}

/// Where the table is on the page.
const TABLE: f64 = 118.0;
const WHERE: f64 = 532.0;

/// The length of the greatest force, in R.
const LONGEST: f64 = 1.55;

/// The greatest length of the weight, in R.
const WEIGHT: f64 = 0.85;

/// The camera, so turned that no force hides another.
const AZIMUTH: f64 = 10.0;
const ELEVATION: f64 = 24.0;

/// A force from its beginning to its end, around the centre of the sphere, in R.
struct Shaft<'a> {
    force: &'a SphereForce,
    ends: [Vector; 2],
}

impl<'a> Shaft<'a> {
    fn new(force: &'a SphereForce, length: f64) -> Self {
        let SphereForce { at, along, .. } = *force;
        // The weight begins in the centre, what pushes ends on the surface, and what pulls begins there.
        let ends = if norm(at) == 0.0 || length < 0.0 {
            [at, moved(at, length, along)]
        } else {
            [moved(at, -length, along), at]
        };
        Self { force, ends }
    }

    fn draw(&self, canvas: &mut Canvas, place: impl Fn(Vector) -> Point) {
        let [tail, tip] = self.ends.map(place);
        if self.force.magnitude != 0.0 {
            canvas.add(arrow(tail, tip, 4.0, colour(self.force)));
        }
    }

    /// Its letter, at the end that is farther from the sphere; that of the weight beside it.
    fn name(&self, canvas: &mut Canvas, place: impl Fn(Vector) -> Point) {
        const BEYOND: f64 = 16.0;
        let label = name(self.force)
            .size(19.0)
            .halo()
            .colour(colour(self.force));
        let [tail, tip] = self.ends;
        let at = self.force.at;
        if norm(at) == 0.0 {
            let [[x, y], [_, below]] = [place(tail), place(tip)];
            canvas.add(label.at([x - BEYOND, y.midpoint(below)]));
            return;
        }
        let far = if norm(tail) > norm(tip) { tail } else { tip };
        let [from, to] = [place([0.0; 3]), place(at)];
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let length = dx.hypot(dy).max(1.0);
        let [x, y] = place(far);
        canvas.add(label.at([x + dx / length * BEYOND, y + dy / length * BEYOND]));
    }
}

fn name(force: &SphereForce) -> Label {
    Label::new(force.name).bold().italic()
}

fn told(force: &SphereForce) -> &'static str {
    match force.name {
        "w" => "weight",
        "p" => "load",
        "n" => "from the floor",
        name if name.ends_with('′') => "from above",
        _ => "from below",
    }
}

fn colour(force: &SphereForce) -> Colour {
    if force.multiple.is_some() || force.name == "n" {
        BLUE
    } else {
        ORANGE
    }
}
