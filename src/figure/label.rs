//! Lines of text on the page.

use svg::Node;
use svg::node::Text;
use svg::node::element::{Element, Group};

use super::canvas::{Point, px};
use super::colour::{BLACK, Colour, WHITE};

/// Where a text is held.
#[derive(Clone, Copy)]
pub(super) enum Hold {
    Start,
    Middle,
    End,
}

/// In which direction a text is read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Reading {
    Across,
    Up,
}

/// A line of text, which is centred on its point unless it is held elsewhere.
pub(super) struct Label {
    text: String,
    size: f64,
    colour: Colour,
    hold: Hold,
    bold: bool,
    italic: bool,
    halo: bool,
    reading: Reading,
}

impl Label {
    pub(super) fn new(text: impl Into<String>) -> Self {
        Self {
            text: text.into(),
            size: 14.0,
            colour: BLACK,
            hold: Hold::Middle,
            bold: false,
            italic: false,
            halo: false,
            reading: Reading::Across,
        }
    }

    pub(super) fn size(self, size: f64) -> Self {
        Self { size, ..self }
    }

    pub(super) fn colour(self, colour: Colour) -> Self {
        Self { colour, ..self }
    }

    pub(super) fn hold(self, hold: Hold) -> Self {
        Self { hold, ..self }
    }

    pub(super) fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub(super) fn italic(self) -> Self {
        Self {
            italic: true,
            ..self
        }
    }

    /// With a white rim, over a drawing.
    pub(super) fn halo(self) -> Self {
        Self { halo: true, ..self }
    }

    /// Read from below to above.
    pub(super) fn turned(self) -> Self {
        Self {
            reading: Reading::Up,
            ..self
        }
    }

    /// About how wide it will be: what a viewer's font makes of it is not known.
    pub(super) fn width(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "a line of text")]
        let letters = self.text.chars().count() as f64;
        letters * self.size * if self.bold { 0.64 } else { 0.6 }
    }

    /// Smaller, if it is wider than this.
    pub(super) fn within(self, room: f64) -> Self {
        let part = (room / self.width().max(1.0)).min(1.0);
        let size = self.size * part;
        Self { size, ..self }
    }

    pub(super) fn at(self, [x, y]: Point) -> Group {
        let anchor = match self.hold {
            Hold::Start => "start",
            Hold::Middle => "middle",
            Hold::End => "end",
        };
        let text = |fill: Colour| {
            // Not `element::Text`, which puts the words on a line of their own.
            let mut text = Element::new("text");
            text.assign("x", px(x));
            text.assign("y", px(y));
            text.assign("dy", "0.35em");
            text.assign("font-size", px(self.size));
            text.assign("text-anchor", anchor);
            text.assign("fill", fill.to_string());
            if self.bold {
                text.assign("font-weight", "bold");
            }
            if self.italic {
                text.assign("font-style", "italic");
            }
            if self.reading == Reading::Up {
                text.assign("transform", format!("rotate(-90 {} {})", px(x), px(y)));
            }
            text.append(Text::new(self.text.as_str()));
            text
        };
        let group = Group::new().set("class", "label");
        if !self.halo {
            return group.add(text(self.colour));
        }
        let mut rim = text(WHITE);
        rim.assign("aria-hidden", "true");
        rim.assign("stroke", WHITE.to_string());
        rim.assign("stroke-width", 4);
        rim.assign("stroke-linejoin", "round");
        group.add(rim).add(text(self.colour))
    }
}
