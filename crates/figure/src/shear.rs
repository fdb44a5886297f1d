//! Draws the base shear forces as arrows, as in fig. 4 of the paper.

use super::caption::{LIMIT, caption};
use super::colour::{BLUE, PALE, Scale};
use super::glyph::{Glyph, Point, arrow, ring, text};
use super::layer::Layer;
use super::page::Figure;
use super::panel::AXES;
use super::subject::{Subject, nearest};
use super::ticks::{round_below, short};
use crate::Error;

/// Draws the horizontal forces of the bottom spheres on the floor, as arrows from above.
///
/// Fig. 4 of the paper shows ten layers. In that figure every arrow points away from the axis of the pile, and its
/// length is proportional to the distance from the axis, by (14) of the paper.
///
/// Each arrow is a `<polygon class="arrow">` with the force as `data-x` and `data-y`. The fourth of its seven corners
/// is the tip, and the tail lies between the first corner and the last. The arrow of class `key` gives the scale.
///
/// # Errors
/// * [`Error::TooManyGlyphs`] for more than 20 000 bottom spheres.
/// * [`Overflow`](cannonpile::Error::Overflow) for forces outside the range of `f64`.
/// * The errors of [`Packing::base`](cannonpile::Packing::base).
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
/// let svg = cannonpile_figure::shear(&Subject::of_pile(&pile, &spacing)?)?.to_string();
/// // 54 arrows, the key, and a ring under the apex, where the shear force is zero.
/// let count = |class: &str| svg.matches(&format!("class=\"{class}\"")).count();
/// assert_eq!(["arrow", "key", "vanishing"].map(count), [54, 1, 1]);
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn shear(subject: &Subject<'_>) -> Result<Figure, Error> {
    let bottom = subject.pile().layers() - 1;
    let layer = Layer::new(subject, bottom, LIMIT, "use fewer layers")?;
    let mut forces: Vec<Point> = Vec::new();
    for force in subject.base()? {
        let force = force?;
        let nearest = |part| nearest(part, "a shear");
        forces.push([nearest(&force.shear_x)?, nearest(&force.shear_y)?]);
    }
    // Arrows may end outside the spheres, and the key needs space below.
    let [left, right, below] = AXES;
    let margins = [left, right, below + 44.0];
    let panel = layer.panel(layer.apart().max(1.2), margins);
    let greatest = forces.iter().map(|[x, y]| x.hypot(*y)).fold(0.0, f64::max);
    // The longest arrow ends just before the next sphere.
    let longest = panel.length(layer.apart()) * 0.94;
    let width = (longest * 0.055).clamp(0.4, 3.0);
    let scale = Scale::around_zero([greatest]);
    let pixels = |force: f64| scale.part(force) * longest;
    let radius = panel.length(1.0);
    let spheres = layer.spheres.iter();
    let mut glyphs: Vec<Glyph> = spheres
        .map(|(_, at)| ring(panel.at(*at), radius, PALE, 1.0))
        .collect();
    for ((site, at), force) in layer.spheres.iter().zip(forces) {
        let tail = panel.at(*at);
        let [right, up] = force.map(pixels);
        let glyph = if right == 0.0 && up == 0.0 {
            // A ring marks a sphere with zero force.
            ring(tail, (2.0 * width).max(1.5), BLUE, width).class("vanishing")
        } else {
            arrow(tail, [tail[0] + right, tail[1] - up], width, BLUE)
        };
        let [x, y] = force;
        glyphs.push(
            glyph
                .of(*site)
                .with_value("data-x", x)
                .with_value("data-y", y),
        );
    }
    let unit = subject.shear_unit();
    let [left, y] = [panel.left, panel.bottom() + 78.0];
    match round_below(greatest) {
        None => {
            glyphs.push(text([left, y], 14.0, format!("no shear forces (in {unit})")).start());
        }
        Some(round) => {
            let tip = [left + pixels(round), y];
            let key = arrow([left, y], tip, width, BLUE).class("key");
            let words = format!(
                "{} {unit}; greatest {} {unit}",
                short(round),
                short(greatest)
            );
            glyphs.push(key.with_value("data-force", round));
            glyphs.push(text([tip[0] + 12.0, y], 14.0, words).start());
        }
    }
    let title = "Shear force of the pile on the floor".into();
    Ok(Figure {
        note: subject.note(),
        axes: Some(layer.axes(subject)?),
        ..Figure::new(title, caption(subject)?, panel, glyphs)
    })
}
