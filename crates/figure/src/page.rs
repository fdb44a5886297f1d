//! A figure as an SVG page: title, axes, colour bar and glyphs.

use core::fmt;
use std::io;

use svg::Document;

use super::colour::{BLACK, DIM, GREY, Scale, TENSION, WHITE};
use super::glyph::{Glyph, Point, fitting, line, px, rectangle, text};
use super::panel::{Panel, WIDTH};
use super::ticks::{short, ticks};

/// A figure: an SVG document that embeds no fonts.
///
/// `Display` and [`write`](Self::write) give its text, with lengths rounded to 1/10000 of a pixel. The glyph of a sphere or
/// contact has a class, its indices and its value: `<polygon class="cell" data-i="0" data-j="0" data-k="9" data-value="4.0"
/// …/>`.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_figure::Subject;
/// use cannonpile::geometry::Spacing;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(10)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let figure = cannonpile_figure::base(&Subject::of_pile(&pile, &spacing)?)?;
/// assert_eq!(figure.to_string().matches("data-value=\"4.0\"").count(), 55);
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Figure {
    pub(super) title: String,
    /// The line below the title.
    pub(super) caption: String,
    /// A note on the stability of the pile, shown with or without a title.
    pub(super) note: Option<String>,
    pub(super) panel: Panel,
    pub(super) axes: Option<Axes>,
    pub(super) bar: Option<Bar>,
    /// The glyphs, from the farthest to the nearest.
    pub(super) glyphs: Vec<Glyph>,
    pub(super) layout: Layout,
}

/// The layout of a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// The width of the page, in pixels (default 800). Height, lines and fonts scale with it.
    pub width: f64,
    /// Whether the title and the caption are shown (default `true`). The elements `title` and `desc` of the document
    /// always contain them.
    pub title: bool,
}

impl Default for Layout {
    fn default() -> Self {
        Self {
            width: WIDTH,
            title: true,
        }
    }
}

/// A frame with ticks. The point (0, 0) of the panel has the values `origin`. A unit of length of the panel is `unit`
/// on the axes.
#[derive(Clone, Debug)]
pub(super) struct Axes {
    /// The names of the horizontal and the vertical axis, with units. An axis with an empty name has no ticks.
    pub(super) names: [String; 2],
    pub(super) origin: Point,
    pub(super) unit: Point,
}

/// The colour bar.
#[derive(Clone, Debug)]
pub(super) struct Bar {
    pub(super) scale: Scale,
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    /// Lines below the bar.
    pub(super) remarks: Vec<String>,
}

impl Figure {
    /// Returns a figure without note, axes and colour bar.
    pub(super) fn new(title: String, caption: String, panel: Panel, glyphs: Vec<Glyph>) -> Self {
        Self {
            title,
            caption,
            note: None,
            panel,
            axes: None,
            bar: None,
            glyphs,
            layout: Layout::default(),
        }
    }

    /// Returns the figure in another layout.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_figure::{Layout, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let figure = cannonpile_figure::shear(&Subject::of_pile(&pile, &spacing)?)?;
    /// let svg = figure.laid_out(Layout { width: 400.0, title: false }).to_string();
    /// assert!(svg.contains("width=\"400\"") && !svg.contains("font-weight=\"bold\""));
    /// # Ok::<(), cannonpile_figure::Error>(())
    /// ```
    #[must_use]
    pub fn laid_out(self, layout: Layout) -> Self {
        Self { layout, ..self }
    }

    /// Returns a note if the pile is unstable, or if its stability is unknown.
    ///
    /// Figures without forces have no note on stability, and neither have figures of spheres without weight.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_figure::Subject;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::stacking::Stacking;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, Stacking::hcp(12)?)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let figure = cannonpile_figure::section(&Subject::of_pile(&pile, &spacing)?)?;
    /// assert!(figure.note().is_some_and(|note| note.contains("unstable")));
    /// # Ok::<(), cannonpile_figure::Error>(())
    /// ```
    #[must_use]
    pub fn note(&self) -> Option<&str> {
        self.note.as_deref()
    }

    /// Writes the document.
    ///
    /// # Errors
    /// The errors of `out`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_figure::Subject;
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let mut svg = Vec::new();
    /// cannonpile_figure::shear(&Subject::of_pile(&pile, &spacing)?)?.write(&mut svg)?;
    /// assert!(svg.starts_with(b"<svg "));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write(&self, out: &mut dyn io::Write) -> io::Result<()> {
        writeln!(out, "{self}")
    }

    fn document(&self) -> Document {
        let head = self.head();
        #[expect(clippy::cast_precision_loss, reason = "three lines at most")]
        let top = -26.0 * (head.len() + 1) as f64;
        let height = px(self.panel.page - top);
        let size = self.layout.width / WIDTH;
        let mut glyphs = vec![
            Glyph::new("title").words(self.title.as_str()),
            Glyph::new("desc").words(self.caption.as_str()),
            rectangle([0.0, top], [WIDTH, height])
                .class("page")
                .fill(WHITE),
        ];
        glyphs.extend(head);
        if let Some(axes) = &self.axes {
            glyphs.extend(axes.glyphs(&self.panel));
        }
        glyphs.extend(self.glyphs.iter().cloned());
        if let Some(bar) = &self.bar {
            glyphs.extend(bar.glyphs(&self.panel));
        }
        let document = Document::new()
            .set("width", px(WIDTH * size))
            .set("height", px(height * size))
            .set("viewBox", (0.0, top, WIDTH, height))
            .set("role", "img")
            .set("font-family", "sans-serif");
        glyphs
            .into_iter()
            .map(Glyph::into_element)
            .fold(document, Document::add)
    }

    /// Returns the lines above the panel.
    fn head(&self) -> Vec<Glyph> {
        let title = self.layout.title.then_some([
            (20.0, BLACK, self.title.as_str()),
            (14.0, BLACK, self.caption.as_str()),
        ]);
        let note = self.note.as_deref().map(capitalised);
        let note = note.as_deref().map(|note| (14.0, TENSION, note));
        let lines = title.into_iter().flatten().chain(note).rev();
        let mut y = 2.0;
        let set = lines.map(|(size, colour, words)| {
            y -= 26.0;
            let line =
                text([WIDTH / 2.0, y], fitting(words, size, WIDTH - 24.0), words).fill(colour);
            if size > 14.0 { line.bold() } else { line }
        });
        set.collect()
    }
}

fn capitalised(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters.clone()).collect()
}

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.document().fmt(f)
    }
}

impl Axes {
    fn glyphs(&self, panel: &Panel) -> Vec<Glyph> {
        let (left, right, bottom) = (panel.left, panel.right(), panel.bottom());
        let frame = rectangle([left, 0.0], panel.size).class("frame");
        let mut glyphs = vec![frame.fill("none").stroke(GREY, 1.0)];
        for (n, (name, ends)) in self.names.iter().zip(panel.ends()).enumerate() {
            if name.is_empty() {
                continue;
            }
            let (origin, unit, length) = (self.origin[n], self.unit[n], panel.size[n]);
            // Short axes have fewer ticks, so that their labels do not overlap.
            let count = if length < 220.0 { 3 } else { 8 };
            let [least, most] = ends.map(|end| origin + end * unit);
            for tick in ticks(least, most, count) {
                let place = (tick - origin) / unit;
                let [x, y] = panel.at([place; 2]);
                let words = short(tick);
                glyphs.extend(if n == 0 {
                    let at = text([x, bottom + 15.0], 13.0, words);
                    [line([x, bottom], [x, bottom + 5.0], BLACK, 1.0), at]
                } else {
                    let at = text([left - 8.0, y], 13.0, words).end();
                    [line([left - 5.0, y], [left, y], BLACK, 1.0), at]
                });
            }
            glyphs.push(if n == 0 {
                text([left.midpoint(right), bottom + 38.0], 14.0, name)
            } else {
                let (x, y) = (px(left - 54.0), px(bottom / 2.0));
                text([x, y], 14.0, name).set("transform", format!("rotate(-90 {x} {y})"))
            });
        }
        glyphs
    }
}

impl Bar {
    fn glyphs(&self, panel: &Panel) -> Vec<Glyph> {
        let (left, top, width) = (WIDTH - 112.0, 44.0, 20.0);
        let mut bottom = panel.size[1].clamp(120.0, 420.0);
        let named = |words: &str, y: f64| text([left, y], 14.0, words).start();
        let (least, most) = (self.scale.least, self.scale.most);
        let tick = |value: f64, y: f64| {
            let end = [left + width, y];
            let words = text([end[0] + 8.0, y], 13.0, short(value)).start();
            [line(end, [end[0] + 5.0, y], BLACK, 1.0), words]
        };
        let mut glyphs = vec![
            named(self.name, 4.0),
            named(&format!("in {}", self.unit), 22.0),
        ];
        let fill = if self.scale.is_uniform() {
            bottom = top + width;
            glyphs.extend(tick(least, top + width / 2.0));
            glyphs.push(named("everywhere", bottom + 16.0));
            self.scale.colour(least)
        } else {
            glyphs.push(self.gradient());
            for value in ticks(least, most, if bottom < 200.0 { 3 } else { 6 }) {
                let part = (value / 2.0 - least / 2.0) / (most / 2.0 - least / 2.0);
                glyphs.extend(tick(value, px(bottom - part * (bottom - top))));
            }
            "url(#scale)".into()
        };
        let bar = rectangle([left, top], [width, bottom - top]).class("bar");
        let bar = bar.set("data-least", least).set("data-most", most);
        // The bar is drawn before its ticks, so that it does not cover them.
        glyphs.insert(2, bar.fill(fill).stroke(GREY, 1.0));
        let mut y = bottom + 24.0;
        for remark in &self.remarks {
            glyphs.push(
                text([left - 12.0, y], fitting(remark, 13.0, 118.0), remark)
                    .start()
                    .fill(DIM),
            );
            y += 17.0;
        }
        glyphs
    }

    /// Returns the colour gradient of the bar, from its lower to its upper end.
    fn gradient(&self) -> Glyph {
        const STOPS: u32 = 48;
        let gradient = Glyph::new("linearGradient").set("id", "scale");
        let mut gradient =
            gradient.with_lengths([("x1", 0.0), ("y1", 1.0), ("x2", 0.0), ("y2", 0.0)]);
        for n in 0..=STOPS {
            let part = f64::from(n) / f64::from(STOPS);
            let value = self.scale.least * (1.0 - part) + self.scale.most * part;
            let stop = Glyph::new("stop").set("offset", px(part));
            gradient = gradient.with(stop.set("stop-color", self.scale.colour(value)));
        }
        Glyph::new("defs").with(gradient)
    }
}
