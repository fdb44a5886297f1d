//! A part of the page with a scale, its axes, and the bar that tells what colours mean.

use super::canvas::{Canvas, HEAD, Point, WIDTH, line, px, rectangle};
use super::colour::{BLACK, GREY, Scale};
use super::label::{Hold, Label};
use super::ticks::{short, ticks};

/// A box around points, u to the right and v upwards.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    least: Point,
    most: Point,
}

impl Bounds {
    /// Around discs of one radius. Of no disc it is around the origin.
    pub(super) fn around(centres: impl IntoIterator<Item = Point>, radius: f64) -> Self {
        let mut bounds: Option<Self> = None;
        for [u, v] in centres {
            let (least, most) = ([u - radius, v - radius], [u + radius, v + radius]);
            let around = bounds.get_or_insert(Self { least, most });
            for (end, new) in around.least.iter_mut().zip(least) {
                *end = end.min(new);
            }
            for (end, new) in around.most.iter_mut().zip(most) {
                *end = end.max(new);
            }
        }
        bounds.unwrap_or(Self {
            least: [-radius, -radius],
            most: [radius, radius],
        })
    }

    /// At least this wide and this high, about its middle: few spheres are not drawn huge.
    pub(super) fn at_least(self, width: f64, height: f64) -> Self {
        let mut wider = self;
        for (n, needed) in [width, height].into_iter().enumerate() {
            let (Some(least), Some(most)) = (wider.least.get_mut(n), wider.most.get_mut(n)) else {
                continue;
            };
            let lacking = needed - (*most - *least);
            if lacking > 0.0 {
                *least -= lacking / 2.0;
                *most += lacking / 2.0;
            }
        }
        wider
    }

    fn size(&self) -> Point {
        [self.most[0] - self.least[0], self.most[1] - self.least[1]]
    }
}

/// Margins left and right of a panel.
#[derive(Clone, Copy)]
pub(super) struct Margins {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) below: f64,
}

impl Margins {
    /// For axes on the left and below.
    pub(super) const AXES: Self = Self {
        left: 74.0,
        right: 30.0,
        below: 60.0,
    };
    /// The same, and a bar of colours on the right.
    pub(super) const BAR: Self = Self {
        left: 74.0,
        right: 142.0,
        below: 60.0,
    };
}

/// A part of the page with one scale in both directions.
pub(super) struct Panel {
    corner: Point,
    least: Point,
    size: Point,
    /// Pixels to a unit of length.
    scale: f64,
    below: f64,
}

/// The greatest height of a panel.
const HIGHEST: f64 = 640.0;

impl Panel {
    /// As large as fits the page.
    pub(super) fn fitting(bounds: Bounds, margins: Margins) -> Self {
        let [width, height] = bounds.size();
        let room = WIDTH - margins.left - margins.right;
        let scale = (room / width).min(HIGHEST / height);
        let left = margins.left + (room - width * scale) / 2.0;
        Self {
            corner: [left, HEAD],
            least: bounds.least,
            size: [width * scale, height * scale],
            scale,
            below: margins.below,
        }
    }

    /// The height of the page that it needs.
    pub(super) fn page_height(&self) -> f64 {
        HEAD + self.size[1] + self.below
    }

    /// Where its lower edge is on the page.
    pub(super) fn bottom(&self) -> f64 {
        HEAD + self.size[1]
    }

    /// Where its left and right edges are on the page.
    pub(super) fn sides(&self) -> [f64; 2] {
        [self.corner[0], self.corner[0] + self.size[0]]
    }

    /// A place on the page.
    pub(super) fn at(&self, [u, v]: Point) -> Point {
        [
            self.corner[0] + (u - self.least[0]) * self.scale,
            self.corner[1] + self.size[1] - (v - self.least[1]) * self.scale,
        ]
    }

    /// A length on the page.
    pub(super) fn length(&self, length: f64) -> f64 {
        length * self.scale
    }

    /// A frame with ticks. What is drawn at (0, 0) lies at `origin`, and a length 1 is `unit`, in the unit of the names.
    pub(super) fn axes(&self, canvas: &mut Canvas, names: [&str; 2], origin: Point, unit: f64) {
        let [left, top] = self.corner;
        let (right, bottom) = (left + self.size[0], self.bottom());
        let frame = rectangle(self.corner, self.size);
        canvas.add(
            frame
                .set("class", "frame")
                .set("fill", "none")
                .set("stroke", GREY.to_string()),
        );
        let value = |n: usize, data: f64| origin.get(n).copied().unwrap_or(0.0) + data * unit;
        let [width, height] = self.size.map(|length| length / self.scale);
        let [u, v] = self.least;
        // Ticks stand apart at all sizes.
        let count = |length: f64| if length < 220.0 { 3 } else { 8 };
        for tick in ticks(value(0, u), value(0, u + width), count(self.size[0])) {
            let [x, _] = self.at([(tick - origin[0]) / unit, v]);
            canvas.add(line([x, bottom], [x, bottom + 5.0], BLACK, 1.0));
            canvas.add(Label::new(short(tick)).size(13.0).at([x, bottom + 15.0]));
        }
        let [across, up] = names;
        // What has no name has no numbers either.
        let upwards = if up.is_empty() { v } else { v + height };
        for tick in ticks(value(1, v), value(1, upwards), count(self.size[1])) {
            let [_, y] = self.at([u, (tick - origin[1]) / unit]);
            canvas.add(line([left - 5.0, y], [left, y], BLACK, 1.0));
            let label = Label::new(short(tick)).size(13.0).hold(Hold::End);
            canvas.add(label.at([left - 8.0, y]));
        }
        if !across.is_empty() {
            let middle = left.midpoint(right);
            canvas.add(Label::new(across).at([middle, bottom + 38.0]));
        }
        if !up.is_empty() {
            let middle = top.midpoint(bottom);
            canvas.add(Label::new(up).turned().at([left - 54.0, middle]));
        }
    }

    /// The bar of colours beside it, with its unit.
    pub(super) fn bar(&self, canvas: &mut Canvas, scale: &Scale, name: &str, unit: &str) {
        let left = WIDTH - 112.0;
        let height = self.size[1].clamp(120.0, 420.0);
        let top = HEAD + 44.0;
        let width = 20.0;
        let named = |canvas: &mut Canvas, text: &str, y: f64| {
            canvas.add(Label::new(text).hold(Hold::Start).at([left, y]));
        };
        named(canvas, name, HEAD + 4.0);
        named(canvas, &format!("in {unit}"), HEAD + 22.0);
        let (least, most) = (scale.least(), scale.most());
        let bottom = HEAD + height;
        let bar = |fill: String, height: f64| {
            rectangle([left, top], [width, height])
                .set("class", "bar")
                .set("data-least", least)
                .set("data-most", most)
                .set("fill", fill)
                .set("stroke", GREY.to_string())
        };
        let tick = |canvas: &mut Canvas, value: f64, y: f64| {
            canvas.add(line([left + width, y], [left + width + 5.0, y], BLACK, 1.0));
            let label = Label::new(short(value)).size(13.0).hold(Hold::Start);
            canvas.add(label.at([left + width + 8.0, y]));
        };
        if scale.is_uniform() {
            canvas.add(bar(scale.colour(least).to_string(), width));
            tick(canvas, least, top + width / 2.0);
            named(canvas, "everywhere", top + width + 16.0);
            return;
        }
        let value = |part: f64| least * (1.0 - part) + most * part;
        canvas.gradient("scale", |part| scale.colour(value(part)));
        canvas.add(bar("url(#scale)".into(), bottom - top));
        for value in ticks(least, most, if height < 200.0 { 3 } else { 6 }) {
            let part = (value / 2.0 - least / 2.0) / (most / 2.0 - least / 2.0);
            tick(canvas, value, px(bottom - part * (bottom - top)));
        }
    }
}
