//! How methods and scalars look: a shape for a method, a colour for a scalar.

use svg::Node;
use svg::node::element::Group;

use crate::figure::canvas::{Point, circle, line, polygon};
use crate::figure::colour::{BLACK, Colour, WHITE};

/// Half the size of a mark, in pixels.
const SIZE: f64 = 4.5;

/// The palette of Okabe and Ito, which the colour-blind can tell apart.
pub(super) fn colour(scalar: &str) -> Colour {
    match scalar {
        "f32" => Colour::new(230, 159, 0),
        "f64" => Colour::new(0, 114, 178),
        "DoubleDouble" => Colour::new(86, 180, 233),
        "Interval" => Colour::new(0, 158, 115),
        "BigRational" => Colour::new(213, 94, 0),
        "i64" | "integers" => Colour::new(204, 121, 167),
        _ => BLACK,
    }
}

/// The mark of a method: what is computed from formulas is filled, what solves equations is open.
pub(super) fn mark(method: &str, [x, y]: Point, colour: Colour) -> Group {
    let s = SIZE;
    let at = |dx: f64, dy: f64| [x + dx, y + dy];
    let mut group = Group::new().set("class", "mark");
    let mut shape = |corners: &[Point], filled: bool| {
        let fill = if filled { colour } else { WHITE };
        let outline = polygon(corners)
            .set("fill", fill.to_string())
            .set("stroke", colour.to_string())
            .set("stroke-width", 1.5);
        group.append(outline);
    };
    match method {
        "closed form, table" => shape(&[at(-s, -s), at(s, -s), at(s, s), at(-s, s)], true),
        "closed form" => group.append(circle([x, y], s).set("fill", colour.to_string())),
        "transfer" => shape(&[at(0.0, -s), at(s, s), at(-s, s)], true),
        "exact engine" => shape(
            &[
                at(0.0, -1.3 * s),
                at(1.3 * s, 0.0),
                at(0.0, 1.3 * s),
                at(-1.3 * s, 0.0),
            ],
            true,
        ),
        "springs" => shape(&[at(-s, -s), at(s, -s), at(0.0, s)], false),
        "sparse LU" => {
            group.append(line(at(-s, 0.0), at(s, 0.0), colour, 2.0));
            group.append(line(at(0.0, -s), at(0.0, s), colour, 2.0));
        }
        "CGLS" => {
            group.append(line(at(-s, -s), at(s, s), colour, 2.0));
            group.append(line(at(-s, s), at(s, -s), colour, 2.0));
        }
        _ => shape(&[at(-s, -s), at(s, -s), at(s, s), at(-s, s)], false),
    }
    group
}
