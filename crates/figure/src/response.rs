//! The response of a layer to a load on the top.

use cannonpile::lattice::Site;
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::{Load, Pile};
use num_rational::BigRational;

use super::caption::LIMIT;
use super::colour::Scale;
use super::layer::Layer;
use super::map::Map;
use super::page::Figure;
use super::subject::Subject;
use crate::Error;

/// Removes the weight of the spheres and the horizontal forces. A pile without loads receives this load on the middle of the
/// top.
///
/// # Errors
/// The errors of [`Pile::with_load`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Site;
/// use cannonpile::{Load, Pile, ratio};
///
/// let push = Load { down: ratio!(0), x: ratio!(1), y: ratio!(0) };
/// let pile = cannonpile_figure::with_load_on_top(Pile::triangular(10)?, push.clone())?;
/// assert_eq!(pile.load(Site::APEX)?, push);
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn with_load_on_top(pile: Pile, load: impl Into<Load>) -> Result<Pile, Error> {
    let pile = pile.weightless().without_horizontal_forces();
    if pile.loads().len() > 0 {
        return Ok(pile);
    }
    let middle = middle(&pile, 0)?;
    Ok(pile.with_load(middle, load)?)
}

/// Draws the vertical forces that the spheres of layer `k` transmit downwards, as a map from above.
///
/// Blue is tension, red is compression. In a weightless pile with a unit load the forces of a layer add up to 1. A straight
/// stacking transmits the load along three lines. At sign changes the load spreads, and some contacts carry tension, which
/// needs a prestressed pile.
///
/// # Errors
/// [`LayerOutside`](cannonpile::Error::LayerOutside) if there is no layer `k`; [`Error::TooManyGlyphs`] for a layer of
/// more than 20 000 spheres; [`Overflow`](cannonpile::Error::Overflow) for forces outside the range of `f64`; the
/// errors of the force computation.
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
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let floor = |stacking: Stacking| {
///     let pile = cannonpile_figure::with_load_on_top(Pile::under(Region::hexagon(3, 3)?, stacking)?, cannonpile::ratio!(1))?;
///     cannonpile_figure::response(&Subject::of_pile(&pile, &spacing)?, pile.layers() - 1).map(|figure| figure.to_string())
/// };
/// assert_eq!(floor(Stacking::fcc(6)?)?.matches("data-exact=\"1/3\"").count(), 3);
/// assert!(floor(Stacking::hcp(6)?)?.contains("data-exact=\"-"));
/// # Ok::<(), cannonpile_figure::Error>(())
/// ```
pub fn response(subject: &Subject<'_>, k: i128) -> Result<Figure, Error> {
    let pile = subject.pile();
    let layer = Layer::new(subject, k, LIMIT, "use a higher layer, or a smaller top")?;
    let floor = k == pile.layers() - 1;
    let (title, forces) = if floor {
        let forces = subject.base()?.map(|force| force.map(|force| force.normal));
        (
            "Response of the floor".into(),
            forces.collect::<Result<_, _>>()?,
        )
    } else {
        (format!("Response of layer {k}"), transmitted(subject, k)?)
    };
    // Loads below the layer do not act on it.
    let loads = pile.loads().filter(|(site, _)| site.k <= k);
    let map = Map {
        layer,
        title,
        name: "vertical force",
        forces,
        scale: |values| Scale::around_zero(values.iter().copied()),
        note: None,
        crossed: loads.take(LIMIT as usize).map(|(site, _)| site).collect(),
        cross_label: "below a load",
    };
    map.figure(subject)
}

/// Returns the sphere nearest to the middle of a layer.
pub(super) fn middle(pile: &Pile, k: i128) -> Result<Site, Error> {
    let region = pile.shape().layer(k)?;
    let corners = region.corners();
    // The mean of six corners, rounded to the nearest integer.
    let mean = |n: usize| (corners.iter().map(|corner| corner[n]).sum::<i128>() + 3).div_euclid(6);
    let j = mean(1).clamp(*region.y().start(), *region.y().end());
    let ([x, s], i) = ([region.x(), region.s()], mean(0));
    let i = i
        .max(*x.start())
        .max(s.start() - j)
        .min(*x.end())
        .min(s.end() - j);
    Ok(Site { i, j, k })
}

/// Returns the vertical force that each sphere of a layer transmits to those below.
fn transmitted(subject: &Subject<'_>, k: i128) -> Result<Vec<Surd>, Error> {
    let mut forces: Vec<(Site, BigRational)> = Vec::new();
    for contact in subject.forces().contacts(Selection::Layer(k))? {
        let contact = contact?;
        match forces.last_mut() {
            Some((site, sum)) if *site == contact.site => *sum += contact.force,
            _ => forces.push((contact.site, contact.force)),
        }
    }
    let forces = forces.into_iter();
    forces.map(|(_, sum)| subject.vertical(&sum)).collect()
}
