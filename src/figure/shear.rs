//! The shear of a pile on the floor, as arrows: the paper's fig. 4.

use super::canvas::{Canvas, Drawing, arrow, ring};
use super::colour::{BLUE, GREY, WHITE};
use super::label::{Hold, Label};
use super::layer::Layer;
use super::panel::{Margins, Panel};
use super::subject::{nearest, readable};
use super::ticks::{round_below, short};
use super::{Subject, of};
use crate::Error;
use crate::lattice::Site;
use crate::shape::Selection;

/// The horizontal forces of the bottom spheres on the floor.
///
/// Paper, fig. 4, for ten layers: every arrow points away from the axis of the pile and is as long as it is far from
/// there, eq. (result-shear).
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
/// let shear = Shear::new(&Subject::of_pile(&pile, &spacing)?)?;
/// // At a corner, in mg·tanθ: −1/3·(9/2, √3/2·9).
/// assert_eq!(shear.arrows[0].force, [-1.5, -1.5 * 3.0_f64.sqrt()]);
/// assert_eq!(shear.unit, "mg·tanθ");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Shear {
    /// One for each bottom sphere, in row order.
    pub arrows: Vec<ShearArrow>,
    /// The unit of the forces.
    pub unit: &'static str,
    layer: Layer,
}

/// The horizontal force of a bottom sphere on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearArrow {
    /// The sphere.
    pub site: Site,
    /// Its force along x and y.
    pub force: [f64; 2],
}

/// The most arrows.
const LIMIT: u32 = 20_000;

impl Shear {
    /// From the exact forces, each rounded once.
    ///
    /// # Errors
    /// [`Error::TooManyMarks`] for more than 20 000 bottom spheres; [`Error::Overflow`] for forces beyond floats; those
    /// of [`Packing::base`](crate::Packing::base).
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
    /// let shear = Shear::new(&Subject::of_pile(&pile, &spacing)?)?;
    /// // The floor is pulled apart, and as a whole not pushed aside.
    /// for axis in [0, 1] {
    ///     assert!(shear.arrows.iter().map(|arrow| arrow.force[axis]).sum::<f64>().abs() < 1e-12);
    /// }
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(subject: &Subject<'_>) -> Result<Self, Error> {
        let pile = subject.pile();
        readable(
            &pile.base_spheres(),
            LIMIT,
            "bottom spheres",
            "use fewer layers",
        )?;
        let mut arrows = Vec::new();
        for force in subject.packing().base(Selection::Base)? {
            let force = force?;
            arrows.push(ShearArrow {
                site: force.site,
                force: [
                    nearest(&subject.shear(force.shear_x), "a shear")?,
                    nearest(&subject.shear(force.shear_y), "a shear")?,
                ],
            });
        }
        Ok(Self {
            layer: Layer::new(subject, pile.layers() - 1)?,
            arrows,
            unit: subject.shear_unit(),
        })
    }

    /// The greatest of the forces.
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
    /// // At the corners, in mg·tanθ.
    /// let shear = Shear::new(&Subject::of_pile(&pile, &spacing)?)?;
    /// assert!((shear.greatest() - 3.0).abs() < 1e-12);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn greatest(&self) -> f64 {
        let lengths = self.arrows.iter().map(|arrow| magnitude(arrow.force));
        lengths.fold(0.0, f64::max)
    }

    /// The figure: seen from above, x upwards and y to the right, as they are where z points down.
    ///
    /// Arrows are `<polygon class="arrow">`, whose first and last corners are on both sides of the tail, and whose
    /// fourth is the tip; their lengths are to the forces as that of the key, of class `key`, is to its label.
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
    /// let svg = Shear::new(&Subject::of_pile(&pile, &spacing)?)?.drawing().to_string();
    /// // The key, and the sphere under the apex.
    /// assert_eq!(["key", "vanishing"].map(|class| svg.matches(&format!("class=\"{class}\"")).count()), [1, 1]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn drawing(&self) -> Drawing {
        let layer = &self.layer;
        let panel = Panel::fitting(
            // Arrows reach beyond the spheres.
            layer.bounds(layer.apart().max(1.2)),
            Margins {
                below: 104.0,
                ..Margins::AXES
            },
        );
        let title = "Shear force of the pile on the floor";
        let mut canvas = Canvas::new(panel.page_height(), title, &layer.caption);
        layer.axes(&panel, &mut canvas);
        // The longest reaches almost to the next sphere.
        let longest = panel.length(layer.apart()) * 0.94;
        let greatest = self.greatest();
        let radius = panel.length(1.0);
        for place in &layer.places {
            canvas.add(ring(
                panel.at(place.at),
                radius,
                GREY.towards(WHITE, 0.4),
                1.0,
            ));
        }
        let width = (longest * 0.055).clamp(0.4, 3.0);
        let pixels = |force: f64| {
            // Divided first: the least floats have a ratio too.
            let part = force / greatest;
            if part.is_finite() {
                part * longest
            } else {
                0.0
            }
        };
        for (place, ShearArrow { site, force }) in layer.places.iter().zip(&self.arrows) {
            let tail = panel.at(place.at);
            let [right, up] = layer.seen(*force).map(pixels);
            if right == 0.0 && up == 0.0 {
                // The force vanishes here, and the sphere is not forgotten.
                canvas.add(
                    of(*site, ring(tail, (2.0 * width).max(1.5), BLUE, width))
                        .set("class", "vanishing"),
                );
                continue;
            }
            let tip = [tail[0] + right, tail[1] - up];
            canvas.add(of(*site, arrow(tail, tip, width, BLUE)));
        }
        self.key(&mut canvas, &panel, pixels, width);
        canvas.finish()
    }

    /// An arrow of a round length.
    fn key(&self, canvas: &mut Canvas, panel: &Panel, pixels: impl Fn(f64) -> f64, width: f64) {
        let [left, _] = panel.sides();
        let y = panel.page_height() - 26.0;
        let greatest = self.greatest();
        let Some(round) = round_below(greatest) else {
            let text = format!("no shear anywhere (in {})", self.unit);
            canvas.add(Label::new(text).hold(Hold::Start).at([left, y]));
            return;
        };
        let tip = [left + pixels(round), y];
        canvas.add(
            arrow([left, y], tip, width, BLUE)
                .set("class", "key")
                .set("data-force", round),
        );
        let text = format!(
            "{} {}; greatest {} {}",
            short(round),
            self.unit,
            short(greatest),
            self.unit
        );
        canvas.add(Label::new(text).hold(Hold::Start).at([tip[0] + 12.0, y]));
    }
}

/// The length of a vector, also of the greatest and the least floats.
fn magnitude([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}
