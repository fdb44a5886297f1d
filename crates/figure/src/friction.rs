//! The forces on a lower sphere of two layers on a rough floor.

use super::caption::caption;
use super::colour::{BLACK, BLUE, COMPRESSION, DIM, GREY, ORANGE, PALE};
use super::glyph::{Point, arrow, line, ring, text};
use super::page::Figure;
use super::panel::Panel;
use super::subject::Subject;
use super::ticks::short;
use crate::Error;
use cannonpile::engine::bug;
use cannonpile_stability::RoughPacking;

/// The length of the arrow for N + T, in R.
const LONGEST: f64 = 1.25;

/// The left edge of the list on the page, in pixels.
const LEFT: f64 = 500.0;

/// Draws the forces that a contact exerts on a lower sphere on a rough floor, in the vertical plane of the contact.
///
/// **N** is the normal force, and **T** the tangential one. Their sum **F** leads through the point where the sphere touches
/// the floor. There the floor exerts −**F**: its vertical part is N, and its horizontal part, friction, is T.
/// Other contacts of the sphere and its weight superpose.
///
/// Arrows are `<polygon class="arrow" data-name="N" data-force="…">`, with the force over N.
///
/// # Errors
/// [`RoughFloor`](cannonpile_stability::Error::RoughFloor) unless the pile has two layers with gaps, a > R, and vertical loads.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_figure::Subject;
///
/// let pile = Pile::triangular(2)?;
/// let svg = cannonpile_figure::friction(&Subject::of_pile(&pile, &"6/5".parse()?)?)?.to_string();
/// assert_eq!(svg.matches("class=\"arrow\"").count(), 5);
/// assert!(svg.contains("tan(θ/2) = 0.4025"));
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn friction(subject: &Subject<'_>) -> Result<Figure, Error> {
    let rough = RoughPacking::new(subject.packing())?;
    let float = |needed: Option<f64>| needed.ok_or_else(|| bug("a coefficient fits in f64"));
    let half = float(rough.contact_friction().nearest())?;
    let floor = float(rough.floor_friction()?.nearest())?;
    // Of t = tan(θ/2).
    let square = half * half;
    let (sin, cos) = (2.0 * half / (1.0 + square), (1.0 - square) / (1.0 + square));
    let (upper, contact, ground) = ([2.0 * sin, 2.0 * cos], [sin, cos], [0.0, -1.0]);
    let panel = Panel::around([[0.0, -0.4], upper], 1.15, [4.2, 4.6], [20.0, 310.0, 24.0]);
    let place = |at: Point| panel.at(at);
    let [sphere, above, touch, foot] = [[0.0, 0.0], upper, contact, ground].map(place);
    let radius = panel.length(1.0);
    // N along the contact, T across it, and their sum F, on the lower sphere.
    let forces = [
        ("N", [-sin, -cos], touch, COMPRESSION),
        ("T", [sin - half, cos - 1.0], touch, ORANGE),
        ("F", [-half, -1.0], touch, BLACK),
        ("N", [0.0, 1.0], foot, COMPRESSION),
        ("T", [half, 0.0], foot, ORANGE),
    ];
    let scale = panel.length(LONGEST / half.hypot(1.0));
    let [left, right] = [-1.5, 1.5 + 2.0 * sin].map(|x| place([x, -1.0]));
    let mut glyphs = vec![
        line(left, right, BLACK, 2.0).class("floor"),
        ring(above, radius, GREY, 1.5).class("upper"),
        ring(sphere, radius, BLUE, 2.0).class("lower"),
        line(sphere, above, PALE, 1.0).set("stroke-dasharray", "5 4"),
        line(place([0.0, 1.7]), foot, PALE, 1.0).set("stroke-dasharray", "5 4"),
        line(touch, foot, GREY, 1.0).set("stroke-dasharray", "2 3"),
    ];
    for (name, [x, up], [u, v], colour) in forces {
        let tip = [u + scale * x, v - scale * up];
        let glyph = arrow([u, v], tip, 3.0, colour).set("data-name", name);
        glyphs.push(glyph.with_value("data-force", x.hypot(up)));
        let beyond = 14.0 / (scale * x.hypot(up));
        let at = [
            tip[0] + beyond * (tip[0] - u),
            tip[1] + beyond * (tip[1] - v),
        ];
        glyphs.extend(text(at, 17.0, name).bold().italic().fill(colour).with_rim());
    }
    // θ at the centre, and θ/2 at the floor.
    let turned = |share: f64, length: f64, from: Point| {
        let (sin, cos) = (share * sin.atan2(cos)).sin_cos();
        place([from[0] + length * sin, from[1] + length * cos])
    };
    glyphs.extend(text(turned(0.5, 0.75, [0.0; 2]), 16.0, "θ").with_rim());
    glyphs.extend(text(turned(0.25, 0.72, ground), 13.0, "θ/2").with_rim());
    let words = [
        (COMPRESSION, "N is the normal force".to_owned()),
        (ORANGE, "T = N·tan(θ/2) is the tangential force".to_owned()),
        (BLACK, "F is their sum, through the foot".to_owned()),
        (DIM, format!("tan(θ/2) = {}", short(half))),
        (DIM, "Friction needed".to_owned()),
        (DIM, format!("between spheres: {}", short(half))),
        (DIM, format!("on the floor: {}", short(floor))),
    ];
    for (row, (colour, words)) in (1_u8..).zip(words) {
        let at = [LEFT, 26.0 * f64::from(row)];
        glyphs.push(text(at, 14.0, words).fill(colour).start());
    }
    let title = "Forces on a lower sphere on a rough floor".to_owned();
    Ok(Figure::new(title, caption(subject)?, panel, glyphs))
}
