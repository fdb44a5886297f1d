//! The indices of the spheres of a layer: the paper's fig. 2.

use super::canvas::{Canvas, Drawing, Point, arrow, circle, line};
use super::colour::{BLACK, BLUE, GREY, ORANGE, WHITE};
use super::label::Label;
use super::layer::Layer;
use super::panel::{Margins, Panel};
use super::subject::readable;
use super::{Subject, of};
use crate::Error;
use crate::geometry::Vector;
use crate::lattice::{Direction, Sign, Site};
use num_rational::BigRational;

/// The spheres of a layer with their indices.
///
/// Paper, fig. 2, for k = 3: i and j run along rows of spheres; x and y, in which forces are given, do not. α, β and γ
/// are the directions of the three spheres below, seen from above.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::figure::{Indexing, Subject};
/// use cannonpile::geometry::Spacing;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(10)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let indexing = Indexing::new(&Subject::of_pile(&pile, &spacing)?, 3)?;
/// assert_eq!(indexing.drawing().to_string().matches("class=\"sphere\"").count(), 10);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Indexing {
    /// The layer, counted from the top.
    pub layer: i128,
    seen: Layer,
    /// From a sphere to those below it, seen from above, in R.
    descents: Vec<(Direction, [f64; 2])>,
}

/// The most spheres: their indices have to be read.
const LIMIT: u32 = 150;

impl Indexing {
    /// Of layer `k`.
    ///
    /// # Errors
    /// [`Error::LayerOutside`]; [`Error::TooManyMarks`] for more than 150 spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::{Indexing, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::{Error, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(100)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let subject = Subject::of_pile(&pile, &spacing)?;
    /// // 136 spheres, and 153.
    /// assert!(Indexing::new(&subject, 15).is_ok());
    /// assert!(matches!(Indexing::new(&subject, 16), Err(Error::TooManyMarks { .. })));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(subject: &Subject<'_>, k: i128) -> Result<Self, Error> {
        let pile = subject.pile();
        let spheres = pile.shape().layer(k)?.sites();
        readable(
            &spheres,
            LIMIT,
            "spheres of a layer",
            "choose a higher layer",
        )?;
        let seen = Layer::new(subject, k)?;
        // On the floor, the directions of the step above.
        let shape = pile.shape();
        let sign = shape.sign_below(k).or_else(|| shape.sign_below(k - 1));
        let directions = pile.directions::<BigRational>();
        let descents = pile.dimension().directions().iter().zip(directions);
        let descents = descents.map(|(&direction, along)| {
            let down = match sign {
                Some(Sign::Minus) => along.turned_about_z(),
                Some(Sign::Plus) | None => along,
            };
            let down: Vector<BigRational> = -down;
            let [x, y, _] = subject.in_radii(down)?;
            Ok((direction, seen.seen([x, y])))
        });
        Ok(Self {
            layer: k,
            descents: descents.collect::<Result<_, Error>>()?,
            seen,
        })
    }

    /// The figure: the layer as seen from above, x upwards and y to the right, as they are where z points down.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{Indexing, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let svg = Indexing::new(&Subject::of_pile(&pile, &spacing)?, 3)?.drawing().to_string();
    /// assert!(svg.contains(">1,2<") && !svg.contains(">2,2<"));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn drawing(&self) -> Drawing {
        let layer = &self.seen;
        let margins = Margins {
            left: 40.0,
            right: 40.0,
            below: 168.0,
        };
        let panel = Panel::fitting(layer.bounds(1.6), margins);
        let title = format!("Indices of the spheres of layer k = {}", self.layer);
        let mut canvas = Canvas::new(panel.page_height(), &title, &layer.caption);
        self.rows(&mut canvas, &panel);
        let radius = panel.length(1.0);
        let texts: Vec<String> = layer
            .places
            .iter()
            .map(|place| self.text(place.site))
            .collect();
        let sizes = texts
            .iter()
            .map(|text| 14.0 * 1.65 * radius / Label::new(text.as_str()).width());
        // The same for all, as large as fits a sphere.
        let size = sizes.fold(20.0, f64::min);
        for (place, text) in layer.places.iter().zip(texts) {
            let at = panel.at(place.at);
            let mark = circle(at, radius)
                .set("class", "sphere")
                .set("fill", "#dfe9f3")
                .set("stroke", BLACK.to_string())
                .set("stroke-width", (radius * 0.04).min(1.2));
            canvas.add(of(place.site, mark));
            canvas.add(Label::new(text).size(size).at(at));
        }
        self.keys(&mut canvas, &panel);
        canvas.finish()
    }

    fn text(&self, Site { i, j, .. }: Site) -> String {
        let text = if self.seen.is_of_discs() {
            i.to_string()
        } else {
            format!("{i},{j}")
        };
        text.replace('-', "−")
    }

    /// The lines along which i and j count.
    fn rows(&self, canvas: &mut Canvas, panel: &Panel) {
        let of_row = |a: Site, b: Site| a.j == b.j && a.i + 1 == b.i;
        let of_column = |a: Site, b: Site| a.i == b.i && a.j + 1 == b.j;
        let places = &self.seen.places;
        for a in places {
            for b in places {
                if of_row(a.site, b.site) || of_column(a.site, b.site) {
                    let ends = [panel.at(a.at), panel.at(b.at)];
                    canvas.add(line(ends[0], ends[1], GREY.towards(WHITE, 0.4), 1.0));
                }
            }
        }
    }

    /// The directions of the indices, of the contacts and of the components, as arrows below.
    fn keys(&self, canvas: &mut Canvas, panel: &Panel) {
        const LENGTH: f64 = 44.0;
        let layer = &self.seen;
        let y = panel.bottom() + 62.0;
        let told = |canvas: &mut Canvas, x: f64, text: &str| {
            canvas.add(Label::new(text).size(13.0).at([x, y + 74.0]));
        };
        let draw = |canvas: &mut Canvas, from: Point, [u, v]: [f64; 2], name: &str, colour| {
            let length = u.hypot(v);
            if length == 0.0 {
                return;
            }
            let end = |d: f64| [from[0] + u / length * d, from[1] - v / length * d];
            canvas.add(arrow(from, end(LENGTH), 2.2, colour).set("class", "axis"));
            let label = Label::new(name).italic().size(17.0).colour(colour);
            canvas.add(label.at(end(LENGTH + 13.0)));
        };
        let [i, j] = layer.steps;
        let indices = [140.0, y + 34.0];
        draw(canvas, indices, i, "i", BLACK);
        if !layer.is_of_discs() {
            draw(canvas, indices, j, "j", BLACK);
        }
        let counted = if layer.is_of_discs() {
            "index i"
        } else {
            "indices i, j"
        };
        told(canvas, 160.0, counted);
        for (direction, down) in &self.descents {
            let name = match direction {
                Direction::Alpha => "α",
                Direction::Beta => "β",
                Direction::Gamma => "γ",
            };
            draw(canvas, [400.0, y], *down, name, BLUE);
        }
        canvas.add(circle([400.0, y], 4.0).set("fill", BLUE.to_string()));
        told(canvas, 400.0, "contacts, downwards");
        let components = [620.0, y + 34.0];
        draw(canvas, components, layer.seen([1.0, 0.0]), "x", ORANGE);
        if layer.is_of_discs() {
            told(canvas, 640.0, "forces: x (z down)");
        } else {
            draw(canvas, components, layer.seen([0.0, 1.0]), "y", ORANGE);
            told(canvas, 640.0, "forces: x, y (z into the page)");
        }
    }
}
