//! The pile in perspective, as in fig. 1 of the paper.

use cannonpile::lattice::Site;
use cannonpile::shape::Selection;

use super::caption::{LIMIT, caption, readable};
use super::colour::{BLACK, PALE};
use super::glyph::{Glyph, circle, line, polygon, px};
use super::page::Figure;
use super::panel::Panel;
use super::subject::Subject;
use super::view::{Vector, View, add_scaled, norm};
use crate::Error;

/// The direction of the camera, in degrees: in front of a side of the base, a little to its left.
const AZIMUTH: f64 = 195.0;
const ELEVATION: f64 = 17.0;

/// The distance of the camera from the middle, relative to the distance of the farthest sphere from it.
const DISTANCE: f64 = 7.0;

/// The colours of even and odd layers: in the light, in between, and at the rim.
const SHADES: [(&str, [&str; 3]); 2] = [
    ("even", ["#e2ebf4", "#6f9bc8", "#3a4b5c"]),
    ("odd", ["#f7f0e2", "#d9b36c", "#625439"]),
];

/// Draws the spheres of the pile in perspective, with layers in alternating colours and the axes x, y and z.
///
/// Spheres are `<circle class="sphere">`, from the farthest to the nearest. Fig. 1 of the paper shows four layers with
/// a = 1.2 R.
///
/// # Errors
/// [`Error::TooManyGlyphs`] for more than 20 000 spheres; [`Overflow`](cannonpile::Error::Overflow) for positions
/// outside the range of `f64`.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_figure::Subject;
/// use cannonpile::geometry::Spacing;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(4)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let svg = cannonpile_figure::pile(&Subject::of_pile(&pile, &spacing)?)?.to_string();
/// assert_eq!(svg.matches("class=\"sphere\"").count(), 20);
/// // Layers 0 and 2 have the same colour.
/// assert_eq!(svg.matches("url(#even)").count(), 1 + 6);
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn pile(subject: &Subject<'_>) -> Result<Figure, Error> {
    let pile = subject.pile();
    readable(&pile.sphere_count(), LIMIT, "spheres", "use fewer layers")?;
    let discs = subject.is_of_discs();
    let mut places: Vec<(Site, Vector)> = Vec::new();
    for site in pile.rows(Selection::All)?.flatten() {
        let first = places.first().map_or(site, |(first, _)| *first);
        places.push((site, subject.from(first, site)?));
    }
    let view = view(&places, discs);
    let bottom = pile.layers() - 1;
    let on_floor = places.iter().filter(|(site, _)| site.k == bottom);
    let on_floor: Vec<Vector> = on_floor.map(|(_, at)| add_scaled(*at, -1.0, UP)).collect();
    let floor = floor(&on_floor, discs);
    let seen = places.iter().map(|(site, at)| (*site, view.see(*at)));
    let mut spheres: Vec<_> = seen.collect();
    spheres.sort_by(|(_, a), (_, b)| b.distance.total_cmp(&a.distance));

    let rims = spheres.iter().flat_map(|(_, seen)| {
        let [u, v] = seen.at;
        [-1.0, 1.0].map(|side| [u + side * seen.magnification, v + side * seen.magnification])
    });
    let ground = floor.iter().map(|at| view.see(*at).at);
    let panel = Panel::around(rims.chain(ground), 0.1, [9.0, 6.0], [96.0, 30.0, 20.0]);
    let on_page = |at: Vector| panel.at(view.see(at).at);

    let mut glyphs: Vec<Glyph> = SHADES.map(|(id, stops)| shade(id, stops)).into();
    let ground: Vec<_> = floor.into_iter().map(on_page).collect();
    if let (true, [left, right]) = (discs, ground.as_slice()) {
        glyphs.push(line(*left, *right, BLACK, 1.5).class("floor"));
    } else {
        let floor = polygon(&ground).class("floor").fill("#f3f1ec");
        glyphs.push(floor.stroke(PALE, 1.0));
        glyphs.extend(on_floor.iter().map(|at| shadow(*at, on_page)));
    }
    for (site, seen) in &spheres {
        let radius = panel.length(seen.magnification);
        let shade = if site.k % 2 == 0 { "even" } else { "odd" };
        let fill = format!("url(#{shade})");
        let sphere = circle(panel.at(seen.at), radius).class("sphere").of(*site);
        let sphere = sphere.set("data-distance", px(seen.distance)).fill(fill);
        glyphs.push(sphere.stroke(BLACK, (radius * 0.02).min(0.8)));
    }
    glyphs.extend(view.axes([84.0, 74.0], discs));
    let title = format!("Pile of {}", if discs { "discs" } else { "spheres" });
    Ok(Figure::new(title, caption(subject)?, panel, glyphs))
}

const UP: Vector = [0.0, 0.0, 1.0];
const EAST: Vector = [1.0, 0.0, 0.0];

/// Returns the camera, which looks at the mean of all positions.
fn view(places: &[(Site, Vector)], discs: bool) -> View {
    let target = mean(places.iter().map(|(_, place)| place));
    let far = places
        .iter()
        .map(|(_, place)| norm(add_scaled(*place, -1.0, target)));
    let distance = DISTANCE * far.fold(2.0, f64::max);
    View::of(discs, target, [AZIMUTH, ELEVATION], distance)
}

fn mean<'a>(points: impl Iterator<Item = &'a Vector>) -> Vector {
    let add = |(sum, count), point: &Vector| (add_scaled(sum, 1.0, *point), count + 1.0);
    let (sum, count) = points.fold(([0.0; 3], 0.0_f64), add);
    sum.map(|part| part / count.max(1.0))
}

/// Returns the rim of a round floor under the pile, or the ends of the floor under discs.
fn floor(points: &[Vector], discs: bool) -> Vec<Vector> {
    const BEYOND: f64 = 1.7;
    let middle = mean(points.iter());
    let far = points
        .iter()
        .map(|point| norm(add_scaled(*point, -1.0, middle)));
    let radius = far.fold(0.0, f64::max) + BEYOND;
    if discs {
        return vec![
            add_scaled(middle, -radius, EAST),
            add_scaled(middle, radius, EAST),
        ];
    }
    circle_around(middle, radius, 90)
}

/// Returns points of a horizontal circle.
fn circle_around(middle: Vector, radius: f64, count: u32) -> Vec<Vector> {
    let point = |n: u32| {
        let (sin, cos) = (core::f64::consts::TAU * f64::from(n) / f64::from(count)).sin_cos();
        add_scaled(middle, radius, [cos, sin, 0.0])
    };
    (0..count).map(point).collect()
}

/// Returns the shadow of a sphere on the floor, around its contact point.
fn shadow(at: Vector, on_page: impl Fn(Vector) -> [f64; 2]) -> Glyph {
    let rim = circle_around(at, 0.95, 24).into_iter().map(on_page);
    let shadow = polygon(&rim.collect::<Vec<_>>()).class("shadow");
    shadow.fill(BLACK).set("fill-opacity", 0.2)
}

/// Returns a gradient that fills spheres, lit from the upper left with a dark rim.
pub(super) fn shade(id: &str, colours: [&str; 3]) -> Glyph {
    let stops = [0.0, 0.45, 1.0].into_iter().zip(colours);
    let gradient = Glyph::new("radialGradient").set("id", id);
    let gradient = gradient.with_lengths([("cx", 0.38), ("cy", 0.34), ("r", 0.68)]);
    let add = |gradient: Glyph, (offset, colour): (f64, &str)| {
        let stop = Glyph::new("stop").set("offset", offset);
        gradient.with(stop.set("stop-color", colour))
    };
    Glyph::new("defs").with(stops.fold(gradient, add))
}
