//! The indices of the spheres of a layer, as in fig. 2 of the paper.

use cannonpile::lattice::{Sign, Site};

use super::caption::caption;
use super::colour::{BLACK, BLUE, ORANGE, PALE};
use super::glyph::{Glyph, Point, arrow, circle, fitting, line, text};
use super::layer::Layer;
use super::page::Figure;
use super::panel::Panel;
use super::subject::Subject;
use crate::Error;

/// The largest number of spheres whose indices are legible.
const LIMIT: u32 = 150;

/// Draws layer `k` seen from above, with the indices of its spheres; x points to the right and y upwards.
///
/// The indices i and j run along rows of spheres. α, β and γ are the directions to the three spheres below. For k = 3
/// this is the mirror image of fig. 2 of the paper, where z points down.
///
/// # Errors
/// [`LayerOutside`](cannonpile::Error::LayerOutside) if there is no layer `k`; [`Error::TooManyGlyphs`] for more than
/// 150 spheres.
///
/// # Examples
/// ```
/// use cannonpile_figure::Subject;
/// use cannonpile::geometry::Spacing;
/// use cannonpile_figure::Error;
/// use cannonpile::Pile;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(100)?;
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let subject = Subject::of_pile(&pile, &spacing)?;
/// let svg = cannonpile_figure::indexing(&subject, 3)?.to_string();
/// assert!(svg.contains(">1,2<") && !svg.contains(">2,2<"));
/// // Layer 15 has 136 spheres, layer 16 has 153.
/// assert!(cannonpile_figure::indexing(&subject, 15).is_ok());
/// assert!(matches!(cannonpile_figure::indexing(&subject, 16), Err(Error::TooManyGlyphs { .. })));
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn indexing(subject: &Subject<'_>, k: i128) -> Result<Figure, Error> {
    let layer = Layer::new(subject, k, LIMIT, "choose a higher layer")?;
    let panel = layer.panel(1.6, [40.0, 40.0, 168.0]);
    let radius = panel.length(1.0);
    let words = |site| subject.indices(site).replace('-', "−");
    let size = |(site, _): &(Site, Point)| fitting(&words(*site), 20.0, 1.65 * radius);
    // All labels have the same size. The longest one fits in its sphere.
    let size = layer.spheres.iter().map(size).fold(20.0, f64::min);
    let mut glyphs = rows(&layer, &panel);
    for (site, at) in &layer.spheres {
        let at = panel.at(*at);
        let sphere = circle(at, radius).class("sphere").of(*site).fill("#dfe9f3");
        glyphs.push(sphere.stroke(BLACK, (radius * 0.04).min(1.2)));
        glyphs.push(text(at, size, words(*site)));
    }
    glyphs.extend(keys(subject, &layer, k, panel.bottom() + 62.0)?);
    let title = format!("Indices of the spheres of layer k = {k}");
    Ok(Figure::new(title, caption(subject)?, panel, glyphs))
}

/// Returns the lines along which i and j increase.
fn rows(layer: &Layer, panel: &Panel) -> Vec<Glyph> {
    let next =
        |a: Site, b: Site| (b.i - a.i, b.j - a.j) == (1, 0) || (b.i - a.i, b.j - a.j) == (0, 1);
    let spheres = layer.spheres.iter();
    let pairs = spheres.flat_map(|a| layer.spheres.iter().map(move |b| (a, b)));
    let pairs = pairs.filter(|((a, _), (b, _))| next(*a, *b));
    let line = |((_, a), (_, b)): (&(Site, Point), &(Site, Point))| {
        line(panel.at(*a), panel.at(*b), PALE, 1.0)
    };
    pairs.map(line).collect()
}

/// Returns the directions of the indices, contacts and force components, as arrows at the height `y` of the page.
fn keys(subject: &Subject<'_>, layer: &Layer, k: i128, y: f64) -> Result<Vec<Glyph>, Error> {
    let pile = subject.pile();
    // The bottom layer has the directions of the step above it.
    let shape = pile.shape();
    let sign = shape.sign_below(k).or_else(|| shape.sign_below(k - 1));
    let down = if sign == Some(Sign::Minus) { 1.0 } else { -1.0 };
    let directions = subject.directions()?.map(|[x, y, _]| [down * x, down * y]);
    let discs = subject.is_of_discs();
    let [i, j] = layer.steps;
    let groups = [
        (
            140.0,
            BLACK,
            vec![("i", i), ("j", j)],
            ["indices i, j", "index i"],
        ),
        (
            400.0,
            BLUE,
            ["α", "β", "γ"].into_iter().zip(directions).collect(),
            ["contacts, downwards"; 2],
        ),
        (
            640.0,
            ORANGE,
            vec![("x", [1.0, 0.0]), ("y", [0.0, 1.0])],
            ["forces: x, y (z towards you)", "forces: x (z up)"],
        ),
    ];
    let mut glyphs = vec![circle([400.0, y], 4.0).fill(BLUE)];
    for (x, colour, arrows, words) in groups {
        let from = [x, if colour == BLUE { y } else { y + 20.0 }];
        for (name, [u, v]) in arrows {
            let length = u.hypot(v);
            // Discs have no j, y or γ.
            if length == 0.0 || discs && ["j", "y"].contains(&name) {
                continue;
            }
            let end = |d: f64| [from[0] + u / length * d, from[1] - v / length * d];
            glyphs.push(arrow(from, end(44.0), 2.2, colour).class("axis"));
            glyphs.push(text(end(57.0), 17.0, name).italic().fill(colour));
        }
        let [spheres, of_discs] = words;
        let words = if discs { of_discs } else { spheres };
        glyphs.push(text([x, y + 76.0], 13.0, words));
    }
    Ok(glyphs)
}
