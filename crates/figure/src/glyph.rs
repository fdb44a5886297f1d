//! Glyphs: the SVG elements of a figure, with positions in pixels.

use cannonpile::lattice::Site;
use svg::Node;
use svg::node::element::Element;
use svg::node::{Text, Value};

use super::colour::{BLACK, WHITE};

/// A point: x to the right, y downwards on the page.
pub(super) type Point = [f64; 2];

/// Rounds a length on the page to 1/10000 of a pixel. A length that is not finite becomes 0.
pub(super) fn px(length: f64) -> f64 {
    if length.is_finite() {
        (length * 1e4).round() / 1e4 + 0.0
    } else {
        0.0
    }
}

/// An SVG element under construction.
#[derive(Clone, Debug)]
pub(super) struct Glyph(Element);

impl Glyph {
    pub(super) fn new(name: &str) -> Self {
        Self(Element::new(name))
    }

    pub(super) fn set(mut self, attribute: &str, value: impl Into<Value>) -> Self {
        self.0.assign(attribute, value);
        self
    }

    /// Sets attributes that are lengths on the page.
    pub(super) fn with_lengths<const N: usize>(self, lengths: [(&str, f64); N]) -> Self {
        let set = |glyph: Self, (name, length)| glyph.set(name, px(length));
        lengths.into_iter().fold(self, set)
    }

    pub(super) fn class(self, class: &str) -> Self {
        self.set("class", class)
    }

    pub(super) fn fill(self, colour: impl Into<Value>) -> Self {
        self.set("fill", colour)
    }

    pub(super) fn stroke(self, colour: impl Into<Value>, width: f64) -> Self {
        self.set("stroke", colour).set("stroke-width", px(width))
    }

    /// Sets the indices of the sphere that the glyph shows.
    pub(super) fn of(self, site: Site) -> Self {
        let indices = [("data-k", site.k), ("data-i", site.i), ("data-j", site.j)];
        let set = |glyph: Self, (name, index): (&str, i128)| glyph.set(name, index.to_string());
        indices.into_iter().fold(self, set)
    }

    /// Sets the value that the glyph shows.
    pub(super) fn with_value(self, name: &str, value: f64) -> Self {
        self.set(name, format!("{value:?}"))
    }

    pub(super) fn with(mut self, child: Self) -> Self {
        self.0.append(child.0);
        self
    }

    pub(super) fn words(mut self, words: impl Into<String>) -> Self {
        self.0.append(Text::new(words));
        self
    }

    pub(super) fn into_element(self) -> Element {
        self.0
    }

    // Attributes of text.

    pub(super) fn bold(self) -> Self {
        self.set("font-weight", "bold")
    }

    pub(super) fn italic(self) -> Self {
        self.set("font-style", "italic")
    }

    /// Aligns a text at its beginning.
    pub(super) fn start(self) -> Self {
        self.set("text-anchor", "start")
    }

    /// Aligns a text at its end.
    pub(super) fn end(self) -> Self {
        self.set("text-anchor", "end")
    }

    /// Returns a white rim, to be drawn first, and the glyph.
    pub(super) fn with_rim(self) -> [Self; 2] {
        let rim = self.clone().set("aria-hidden", "true").fill(WHITE);
        let rim = rim.stroke(WHITE, 4.0).set("stroke-linejoin", "round");
        [rim, self]
    }
}

/// Returns a line of text, centred on its point.
pub(super) fn text([x, y]: Point, size: f64, words: impl Into<String>) -> Glyph {
    let text = Glyph::new("text").with_lengths([("x", x), ("y", y), ("font-size", size)]);
    let text = text.set("dy", "0.35em").set("text-anchor", "middle");
    text.fill(BLACK).words(words)
}

/// Estimates the width of a text. The exact width depends on the font of the reader.
pub(super) fn width(words: &str, size: f64) -> f64 {
    let letters = u32::try_from(words.chars().count()).unwrap_or(u32::MAX);
    f64::from(letters) * size * 0.62
}

/// Returns a font size of at most `size` with which the text is at most `room` wide.
pub(super) fn fitting(words: &str, size: f64, room: f64) -> f64 {
    size * (room / width(words, size).max(1.0)).min(1.0)
}

pub(super) fn line(
    [x1, y1]: Point,
    [x2, y2]: Point,
    colour: impl Into<Value>,
    width: f64,
) -> Glyph {
    let line = Glyph::new("line").with_lengths([("x1", x1), ("y1", y1), ("x2", x2), ("y2", y2)]);
    line.stroke(colour, width)
}

pub(super) fn circle([x, y]: Point, radius: f64) -> Glyph {
    Glyph::new("circle").with_lengths([("cx", x), ("cy", y), ("r", radius)])
}

/// Returns a circle without fill.
pub(super) fn ring(centre: Point, radius: f64, colour: &str, width: f64) -> Glyph {
    circle(centre, radius).fill("none").stroke(colour, width)
}

pub(super) fn rectangle([x, y]: Point, [width, height]: Point) -> Glyph {
    Glyph::new("rect").with_lengths([("x", x), ("y", y), ("width", width), ("height", height)])
}

pub(super) fn polygon(corners: &[Point]) -> Glyph {
    let corner = |[x, y]: &Point| format!("{},{}", px(*x), px(*y));
    let points: Vec<String> = corners.iter().map(corner).collect();
    Glyph::new("polygon").set("points", points.join(" "))
}

/// Returns an arrow as one polygon. The fourth of its seven corners is the tip, and the tail lies between the first
/// corner and the last.
///
/// The tip is exactly the end of the vector. A short arrow has a short head.
pub(super) fn arrow(tail: Point, tip: Point, width: f64, colour: &str) -> Glyph {
    let [dx, dy] = [tip[0] - tail[0], tip[1] - tail[1]];
    let length = dx.hypot(dy);
    let [x, y] = if length > 0.0 {
        [dx / length, dy / length]
    } else {
        [1.0, 0.0]
    };
    let head = (4.5 * width).min(0.6 * length);
    let half_head = head * 0.42;
    let half = (width / 2.0).min(half_head * 0.6);
    let place =
        |back: f64, aside: f64| [tip[0] - x * back - y * aside, tip[1] - y * back + x * aside];
    let corners = [
        place(length, half),
        place(head, half),
        place(head, half_head),
        tip,
        place(head, -half_head),
        place(head, -half),
        place(length, -half),
    ];
    polygon(&corners).class("arrow").fill(colour)
}

/// Returns a cross with a white rim.
pub(super) fn cross([x, y]: Point, half: f64) -> Vec<Glyph> {
    let strokes = [(WHITE, 3.5), (BLACK, 1.5)].map(|(colour, width)| {
        [-half, half].map(|side| line([x - half, y - side], [x + half, y + side], colour, width))
    });
    strokes
        .into_iter()
        .flatten()
        .map(|stroke| stroke.class("cross"))
        .collect()
}
