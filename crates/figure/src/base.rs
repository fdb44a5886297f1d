//! The base normal forces, as a map.

use super::caption::LIMIT;
use super::colour::Scale;
use super::layer::Layer;
use super::map::Map;
use super::page::Figure;
use super::subject::Subject;
use crate::Error;

/// Draws the base normal forces, as a map of the base seen from above.
///
/// In the pile of the paper all these forces are equal, by (13) of the paper.
///
/// # Errors
/// [`Error::TooManyGlyphs`] for more than 20 000 bottom spheres; [`Overflow`](cannonpile::Error::Overflow) for forces
/// outside the range of `f64`; the errors of [`Packing::base`](cannonpile::Packing::base).
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
/// let svg = cannonpile_figure::base(&Subject::of_pile(&pile, &spacing)?)?.to_string();
/// // The 55 bottom spheres carry the weight of all 220: 4 mg each.
/// assert_eq!(svg.matches("data-exact=\"4\"").count(), 55);
/// assert!(svg.contains("everywhere"));
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn base(subject: &Subject<'_>) -> Result<Figure, Error> {
    let bottom = subject.pile().layers() - 1;
    let layer = Layer::new(subject, bottom, LIMIT, "use fewer layers")?;
    let forces = subject.base()?.map(|force| force.map(|force| force.normal));
    let map = Map {
        layer,
        title: "Normal force of the pile on the floor".into(),
        name: "normal force",
        forces: forces.collect::<Result<_, _>>()?,
        scale: |values| Scale::of(values.iter().copied()),
        note: subject.note(),
        crossed: Vec::new(),
        cross_label: "",
    };
    map.figure(subject)
}
