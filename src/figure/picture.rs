//! The pile itself, in perspective: the paper's fig. 1.

use super::canvas::{Canvas, Drawing, HEAD, arrow, circle, px};
use super::colour::{BLACK, Colour};
use super::label::Label;
use super::panel::{Bounds, Margins, Panel};
use super::subject::readable;
use super::view::{Vector, View, moved, norm};
use super::{Subject, of};
use crate::Error;
use crate::lattice::Site;
use crate::shape::Selection;

/// The spheres of a pile as a camera sees them.
///
/// Paper, fig. 1: four layers with a = 1.2 R.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::figure::{Picture, Subject};
/// use cannonpile::geometry::Spacing;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(4)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let picture = Picture::new(&Subject::of_pile(&pile, &spacing)?)?;
/// // From the farthest to the nearest.
/// assert_eq!(picture.spheres.len(), 20);
/// assert!(picture.spheres.is_sorted_by(|a, b| a.distance >= b.distance));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Picture {
    /// From the farthest to the nearest, so that those in front hide those behind.
    pub spheres: Vec<PictureSphere>,
    caption: String,
    view: View,
    discs: bool,
}

/// A sphere as a camera sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureSphere {
    /// The sphere.
    pub site: Site,
    /// Where its centre appears: to the right and upwards from the middle, in R.
    pub at: [f64; 2],
    /// How large it appears, in R.
    pub radius: f64,
    /// How far from the eye its centre is, in R.
    pub distance: f64,
}

/// The most spheres.
const LIMIT: u32 = 20_000;

/// Where the camera stands, in degrees.
const AZIMUTH: f64 = 42.0;
const ELEVATION: f64 = 22.0;

/// The eye is this many times as far from the middle as the farthest sphere.
const DISTANCE: f64 = 7.0;

impl Picture {
    /// From the exact positions, each rounded once.
    ///
    /// # Errors
    /// [`Error::TooManyMarks`] for more than 20 000 spheres; [`Error::Overflow`] for positions beyond floats.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{Picture, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let picture = Picture::new(&Subject::of_pile(&pile, &spacing)?)?;
    /// // What is nearer than the middle appears larger than it is.
    /// assert!(picture.spheres[0].radius < 1.0 && picture.spheres[19].radius > 1.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(subject: &Subject<'_>) -> Result<Self, Error> {
        let pile = subject.pile();
        readable(&pile.spheres(), LIMIT, "spheres", "use fewer layers")?;
        let mut places: Vec<(Site, Vector)> = Vec::new();
        for site in pile.rows(Selection::All)?.flatten() {
            let first = places.first().map_or(site, |(site, _)| *site);
            places.push((site, subject.from(first, site)?));
        }
        let target = middle(&places);
        let discs = subject.is_of_discs();
        let farthest = places
            .iter()
            .map(|(_, place)| norm(moved(*place, -1.0, target)))
            .fold(2.0, f64::max);
        let view = if discs {
            View::of_discs(target)
        } else {
            View::new(target, AZIMUTH, ELEVATION, DISTANCE * farthest)
        };
        let mut spheres: Vec<PictureSphere> = places
            .into_iter()
            .map(|(site, place)| {
                let seen = view.see(place);
                PictureSphere {
                    site,
                    at: seen.at,
                    radius: seen.magnification,
                    distance: seen.distance,
                }
            })
            .collect();
        spheres.sort_by(|a, b| b.distance.total_cmp(&a.distance));
        Ok(Self {
            spheres,
            caption: subject.caption(),
            view,
            discs,
        })
    }

    /// The figure: shaded spheres, layers in turns of two colours, and the directions of x, y and z.
    ///
    /// Spheres are `<circle class="sphere">`, in the order of [`spheres`](Self::spheres).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{Picture, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(4)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let svg = Picture::new(&Subject::of_pile(&pile, &spacing)?)?.drawing().to_string();
    /// assert_eq!(svg.matches("class=\"sphere\"").count(), 20);
    /// // Layers 0 and 2 in one colour.
    /// assert_eq!(svg.matches("url(#even)").count(), 1 + 6);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn drawing(&self) -> Drawing {
        let centres = self.spheres.iter().map(|sphere| sphere.at);
        let largest = self.spheres.iter().map(|sphere| sphere.radius);
        let bounds = Bounds::around(centres, largest.fold(1.0, f64::max)).at_least(9.0, 6.0);
        let margins = Margins {
            left: 150.0,
            right: 40.0,
            below: 36.0,
        };
        let panel = Panel::fitting(bounds, margins);
        let title = if self.discs {
            "Pile of discs"
        } else {
            "Pile of spheres"
        };
        let mut canvas = Canvas::new(panel.page_height(), title, &self.caption);
        canvas.shading("even", Colour::new(0x6f, 0x9b, 0xc8));
        canvas.shading("odd", Colour::new(0xd9, 0xb3, 0x6c));
        for sphere in &self.spheres {
            let radius = panel.length(sphere.radius);
            let fill = if sphere.site.k % 2 == 0 {
                "even"
            } else {
                "odd"
            };
            let mark = circle(panel.at(sphere.at), radius)
                .set("class", "sphere")
                .set("fill", format!("url(#{fill})"))
                .set("stroke", BLACK.to_string())
                .set("stroke-width", px((radius * 0.02).min(0.8)));
            canvas.add(of(sphere.site, mark));
        }
        axes(&mut canvas, &self.view, [74.0, HEAD + 70.0], self.discs);
        canvas.finish()
    }
}

/// The mean of some places.
fn middle(places: &[(Site, Vector)]) -> Vector {
    #[expect(clippy::cast_precision_loss, reason = "few enough to be drawn")]
    let part = 1.0 / places.len().max(1) as f64;
    let add = |sum: Vector, (_, place): &(Site, Vector)| moved(sum, part, *place);
    places.iter().fold([0.0; 3], add)
}

/// The basis of the paper, z down, as arrows from a point of the page.
pub(super) fn axes(canvas: &mut Canvas, view: &View, from: [f64; 2], discs: bool) {
    const LENGTH: f64 = 46.0;
    let basis = [
        ("x", [1.0, 0.0, 0.0]),
        ("y", [0.0, 1.0, 0.0]),
        ("z", [0.0, 0.0, -1.0]),
    ];
    for (name, vector) in basis {
        if discs && name == "y" {
            continue;
        }
        let [right, up] = view.across(vector);
        let end = |length: f64| [from[0] + right * length, from[1] - up * length];
        canvas.add(arrow(from, end(LENGTH), 2.0, BLACK).set("class", "axis"));
        // Short ones keep their letters apart.
        let seen = right.hypot(up).max(0.1);
        canvas.add(
            Label::new(name)
                .italic()
                .size(16.0)
                .halo()
                .at(end(LENGTH + 13.0 / seen)),
        );
    }
}
