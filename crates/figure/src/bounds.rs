//! The bounds of the base normal forces, as a map.

use cannonpile::shape::Selection;

use super::caption::{LIMIT, caption};
use super::colour::{BLACK, Scale, WHITE};
use super::glyph::{fitting, polygon, text};
use super::layer::Layer;
use super::map::texts;
use super::page::{Bar, Figure};
use super::panel::BAR;
use super::subject::{Subject, nearest};
use crate::Error;

/// Draws the [bounds](cannonpile_horizontal::bounds()) of the normal force of every bottom sphere, with horizontal contacts.
///
/// The bounds are over all compressive contact forces in equilibrium. The upper half of a cell shows the largest normal
/// force, the lower half the smallest.
///
/// # Errors
/// The errors of [`cannonpile_horizontal::base_bounds`]; [`Error::TooManyGlyphs`] for more than 20 000 bottom spheres.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile_figure::Subject;
/// use cannonpile::geometry::Spacing;
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(4)?;
/// let touching = Spacing::new(BigRational::from_integer(1.into()))?;
/// let svg = cannonpile_figure::bounds(&Subject::of_pile(&pile, &touching)?)?.to_string();
/// // The normal force of a corner sphere is at most L − 2/3, in mg.
/// assert_eq!(svg.matches("data-exact=\"10/3\"").count(), 3);
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn bounds(subject: &Subject<'_>) -> Result<Figure, Error> {
    let pile = subject.pile();
    let layer = Layer::new(subject, pile.layers() - 1, LIMIT, "use fewer layers")?;
    let panel = layer.panel(1.5, BAR).with_page_end(262.0);
    let (mut exact, mut attained) = (Vec::new(), Vec::new());
    for found in cannonpile_horizontal::base_bounds(pile, Selection::Base)? {
        let (_, bounds) = found?;
        // The upper half of a cell comes first, and shows the largest force.
        for bound in [bounds.greatest, bounds.least] {
            exact.push(subject.normal(bound.normal));
            attained.push(bound.attained);
        }
    }
    let values = exact.iter().map(|force| nearest(force, "a force"));
    let values: Vec<f64> = values.collect::<Result<_, _>>()?;
    let scale = Scale::of(values.iter().copied());
    let across = panel.length(layer.apart());
    let size = (across * 0.24).min(14.0);
    let labels = texts(&exact, &values, across * 0.86 / size).filter(|_| across >= 30.0);
    let (mut cells, mut words) = (Vec::new(), Vec::new());
    for (n, (site, at)) in layer.spheres.iter().enumerate() {
        for (half, corners) in layer.halves(&panel, *at).into_iter().enumerate() {
            let n = 2 * n + half;
            let cell = polygon(&corners).class("cell").of(*site);
            let cell = cell.set("data-exact", exact[n].to_string());
            let cell = cell.with_value("data-value", values[n]);
            let cell = cell.fill(scale.colour(values[n]));
            cells.push(if attained[n] {
                cell.stroke(WHITE, (across * 0.04).min(1.2))
            } else {
                cell.stroke(BLACK, 1.0).set("stroke-dasharray", "2 2")
            });
            if let Some(labels) = &labels {
                let [x, y] = panel.at(*at);
                let off = across * 0.24 * if half == 0 { -1.0 } else { 1.0 };
                let size = fitting(&labels[n], size, across * 0.86);
                words.push(
                    text([x, y + off], size, labels[n].as_str()).fill(scale.text_colour(values[n])),
                );
            }
        }
    }
    cells.extend(words);
    let mut remarks = vec!["top: greatest".to_owned(), "bottom: least".to_owned()];
    if attained.contains(&false) {
        remarks.push("dashed: outer bound".into());
    }
    let bar = Bar {
        scale,
        name: "normal force",
        unit: subject.force_unit(),
        remarks,
    };
    let title = "Bounds of the base normal forces with horizontal contacts";
    Ok(Figure {
        axes: Some(layer.axes(subject)?),
        bar: Some(bar),
        ..Figure::new(title.into(), caption(subject)?, panel, cells)
    })
}
