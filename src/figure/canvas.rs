//! The page that figures are drawn on, in pixels from the upper left corner.

use core::fmt;
use std::io;

use svg::node::element::path::Data;
use svg::node::element::{
    Circle, Definitions, Description, Line, LinearGradient, Path, Polygon, RadialGradient,
    Rectangle, Stop, Title,
};
use svg::{Document, Node};

use super::colour::{BLACK, Colour, WHITE};
use super::label::Label;

/// A finished figure: an SVG document, in which lengths are exact to a ten thousandth of a pixel.
///
/// `Display` and [`write`](Self::write) give its text. What stands for a thing of the pile has a class and its indices:
/// `<circle class="sphere" data-k="0" data-i="0" data-j="0" …/>`.
#[derive(Clone, Debug)]
pub struct Drawing {
    document: Document,
}

impl Drawing {
    /// Writes the document.
    ///
    /// # Errors
    /// Those of `out`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{Shear, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let subject = Subject::of_pile(&pile, &spacing)?;
    /// let mut svg = Vec::new();
    /// Shear::new(&subject)?.drawing().write(&mut svg)?;
    /// assert!(svg.starts_with(b"<svg "));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write(&self, out: &mut dyn io::Write) -> io::Result<()> {
        writeln!(out, "{}", self.document)
    }
}

impl fmt::Display for Drawing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.document.fmt(f)
    }
}

/// A point of the page.
pub(super) type Point = [f64; 2];

/// The width of all figures.
pub(super) const WIDTH: f64 = 800.0;

/// Where the drawing itself may begin, below the title.
pub(super) const HEAD: f64 = 78.0;

/// A page with a title.
pub(super) struct Canvas {
    document: Document,
}

impl Canvas {
    /// A white page; `caption` is the line below the title.
    pub(super) fn new(height: f64, title: &str, caption: &str) -> Self {
        let height = px(height);
        let document = Document::new()
            .set("width", WIDTH)
            .set("height", height)
            .set("viewBox", (0.0, 0.0, WIDTH, height))
            .set("role", "img")
            .set("font-family", "sans-serif")
            .add(Title::new(title))
            .add(Description::new().add(svg::node::Text::new(caption)))
            .add(
                Rectangle::new()
                    .set("class", "page")
                    .set("width", WIDTH)
                    .set("height", height)
                    .set("fill", WHITE.to_string()),
            );
        let mut canvas = Self { document };
        let room = WIDTH - 24.0;
        let label = Label::new(title).size(20.0).bold().within(room);
        canvas.add(label.at([WIDTH / 2.0, 28.0]));
        let label = Label::new(caption).size(14.0).within(room);
        canvas.add(label.at([WIDTH / 2.0, 54.0]));
        canvas
    }

    pub(super) fn add(&mut self, node: impl Into<Box<dyn Node>>) {
        self.document.append(node);
    }

    /// A way to fill spheres: lit from the upper left, with a dark rim.
    pub(super) fn shading(&mut self, id: &str, colour: Colour) {
        let stop = |offset: f64, colour: Colour| {
            Stop::new()
                .set("offset", offset)
                .set("stop-color", colour.to_string())
        };
        let gradient = RadialGradient::new()
            .set("id", id)
            .set("cx", 0.38)
            .set("cy", 0.34)
            .set("r", 0.68)
            .add(stop(0.0, colour.towards(WHITE, 0.8)))
            .add(stop(0.45, colour))
            .add(stop(1.0, colour.towards(BLACK, 0.62)));
        self.add(Definitions::new().add(gradient));
    }

    /// A way to fill a bar from its lower to its upper end.
    pub(super) fn gradient(&mut self, id: &str, colour: impl Fn(f64) -> Colour) {
        const STOPS: u32 = 48;
        let mut gradient = LinearGradient::new()
            .set("id", id)
            .set("x1", 0)
            .set("y1", 1)
            .set("x2", 0)
            .set("y2", 0);
        for n in 0..=STOPS {
            let part = f64::from(n) / f64::from(STOPS);
            gradient = gradient.add(
                Stop::new()
                    .set("offset", px(part))
                    .set("stop-color", colour(part).to_string()),
            );
        }
        self.add(Definitions::new().add(gradient));
    }

    pub(super) fn finish(self) -> Drawing {
        Drawing {
            document: self.document,
        }
    }
}

/// A length on the page: a ten thousandth of a pixel is finer than any printer. What is no number is nowhere.
pub(super) fn px(length: f64) -> f64 {
    if length.is_finite() {
        (length * 1e4).round() / 1e4 + 0.0
    } else {
        0.0
    }
}

pub(super) fn line([x1, y1]: Point, [x2, y2]: Point, colour: Colour, width: f64) -> Line {
    Line::new()
        .set("x1", px(x1))
        .set("y1", px(y1))
        .set("x2", px(x2))
        .set("y2", px(y2))
        .set("stroke", colour.to_string())
        .set("stroke-width", px(width))
}

pub(super) fn circle([x, y]: Point, radius: f64) -> Circle {
    Circle::new()
        .set("cx", px(x))
        .set("cy", px(y))
        .set("r", px(radius))
}

/// A circle that shows but its outline.
pub(super) fn ring(centre: Point, radius: f64, colour: Colour, width: f64) -> Circle {
    circle(centre, radius)
        .set("fill", "none")
        .set("stroke", colour.to_string())
        .set("stroke-width", px(width))
}

pub(super) fn rectangle([x, y]: Point, [width, height]: Point) -> Rectangle {
    Rectangle::new()
        .set("x", px(x))
        .set("y", px(y))
        .set("width", px(width))
        .set("height", px(height))
}

pub(super) fn polygon(corners: &[Point]) -> Polygon {
    let points: Vec<String> = corners
        .iter()
        .map(|[x, y]| format!("{},{}", px(*x), px(*y)))
        .collect();
    Polygon::new().set("points", points.join(" "))
}

/// An open line through some points, rounded where it turns.
pub(super) fn polyline(points: &[Point], colour: Colour, width: f64) -> Path {
    let mut data = Data::new();
    for (n, [x, y]) in points.iter().enumerate() {
        let to = (px(*x), px(*y));
        data = if n == 0 {
            data.move_to(to)
        } else {
            data.line_to(to)
        };
    }
    Path::new()
        .set("d", data)
        .set("fill", "none")
        .set("stroke", colour.to_string())
        .set("stroke-width", px(width))
        .set("stroke-linejoin", "round")
}

/// An arrow as one outline: its first and last corners are on both sides of the tail, the fourth is the tip.
///
/// The tip is where the vector ends, exactly; a short arrow has a short head.
pub(super) fn arrow(tail: Point, tip: Point, width: f64, colour: Colour) -> Polygon {
    let [dx, dy] = [tip[0] - tail[0], tip[1] - tail[1]];
    let length = dx.hypot(dy);
    let [along, across] = if length > 0.0 {
        [[dx / length, dy / length], [-dy / length, dx / length]]
    } else {
        [[1.0, 0.0], [0.0, 1.0]]
    };
    let head = (4.5 * width).min(0.6 * length);
    let half_head = head * 0.42;
    let half = (width / 2.0).min(half_head * 0.6);
    let place = |from_tip: f64, aside: f64| {
        [
            tip[0] - along[0] * from_tip + across[0] * aside,
            tip[1] - along[1] * from_tip + across[1] * aside,
        ]
    };
    polygon(&[
        place(length, half),
        place(head, half),
        place(head, half_head),
        tip,
        place(head, -half_head),
        place(head, -half),
        place(length, -half),
    ])
    .set("class", "arrow")
    .set("fill", colour.to_string())
}
