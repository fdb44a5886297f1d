//! How a layer feels what is put on the top: the response of a pile to a load.

use num_rational::BigRational;
use num_traits::One;

use super::Subject;
use super::base::LIMIT;
use super::canvas::Drawing;
use super::cells::{MapCell, Words, draw};
use super::colour::Scale;
use super::layer::Layer;
use super::subject::{nearest, readable};
use crate::lattice::Site;
use crate::scalar::Surd;
use crate::shape::Selection;
use crate::{Error, Pile};

/// The vertical forces that the spheres of a layer hand on downwards.
///
/// Of a unit load on one sphere of a weightless pile they add up to 1. All + steps lead it along three lines; where the
/// signs change it spreads, and some spheres are pulled: the response needs a pile that presses on them.
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::figure::{Response, Subject};
/// use cannonpile::geometry::Spacing;
/// use cannonpile::lattice::Region;
/// use cannonpile::stacking::Stacking;
/// use num_rational::BigRational;
///
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let touched = |stacking: Stacking| {
///     let pile = Response::of_unit_load(Pile::under(Region::hexagon(3, 3)?, stacking)?)?;
///     let response = Response::new(&Subject::of_pile(&pile, &spacing)?, pile.layers() - 1)?;
///     let forces = response.cells.iter().map(|cell| cell.value);
///     Ok::<_, cannonpile::Error>(forces.filter(|force| *force != 0.0).collect::<Vec<_>>())
/// };
/// assert_eq!(touched(Stacking::fcc(6)?)?, [1.0 / 3.0; 3]);
/// assert!(touched(Stacking::hcp(6)?)?.iter().any(|force| *force < 0.0));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Response {
    /// The spheres of the layer, in row order.
    pub cells: Vec<MapCell>,
    /// The layer, counted from the top.
    pub layer: i128,
    /// The unit of the forces.
    pub unit: &'static str,
    /// Their colours.
    pub scale: Scale,
    seen: Layer,
    floor: bool,
    /// Where the loads are, seen from above.
    loads: Vec<[f64; 2]>,
}

impl Response {
    /// The same pile without weight, and with a load of 1 mg on the sphere in the middle of its top; unless it carries
    /// loads of its own.
    ///
    /// # Errors
    /// Those of [`Pile::with_load`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::Response;
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// assert_eq!(Response::of_unit_load(pile.clone())?.weight().to_string(), "1");
    /// let loaded = pile.with_load(Site::APEX, BigRational::from_integer(2.into()))?;
    /// assert_eq!(Response::of_unit_load(loaded)?.weight().to_string(), "2");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn of_unit_load(pile: Pile) -> Result<Pile, Error> {
        let pile = pile.weightless();
        if pile.loading().loads().len() > 0 {
            return Ok(pile);
        }
        let middle = middle(&pile, 0)?;
        pile.with_load(middle, BigRational::one())
    }

    /// From the exact forces below layer `k`, each rounded once.
    ///
    /// # Errors
    /// [`Error::LayerOutside`]; [`Error::TooManyMarks`] for a layer of more than 20 000 spheres; [`Error::Overflow`] for
    /// forces beyond floats; those of [`Forces::contacts`](crate::Forces::contacts).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{Response, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::stacking::Stacking;
    /// use num_rational::BigRational;
    ///
    /// let pile = Response::of_unit_load(Pile::under(Region::hexagon(3, 3)?, Stacking::hcp(6)?)?)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let subject = Subject::of_pile(&pile, &spacing)?;
    /// // Every layer hands on the whole load.
    /// for k in 0..6 {
    ///     let handed_on: f64 = Response::new(&subject, k)?.cells.iter().map(|cell| cell.value).sum();
    ///     assert!((handed_on - 1.0).abs() < 1e-12);
    /// }
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn new(subject: &Subject<'_>, k: i128) -> Result<Self, Error> {
        let pile = subject.pile();
        let spheres = pile.shape().layer(k)?.sites();
        readable(
            &spheres,
            LIMIT,
            "spheres of a layer",
            "use a higher layer, or a smaller top",
        )?;
        let floor = k == pile.layers() - 1;
        let forces = if floor {
            on_the_floor(subject)?
        } else {
            handed_on(subject, k)?
        };
        let cells = forces.into_iter().map(|(site, exact)| {
            Ok(MapCell {
                site,
                value: nearest(&exact, "a vertical force")?,
                exact,
            })
        });
        let cells: Vec<MapCell> = cells.collect::<Result<_, Error>>()?;
        let seen = Layer::new(subject, k)?;
        // Those below do not act on it.
        let loads = pile.loading().loads().filter(|(site, _)| site.k <= k);
        let loads = loads.take(LIMIT as usize);
        let loads = loads.map(|(site, _)| seen.above(subject, site));
        Ok(Self {
            loads: loads.collect::<Result<_, _>>()?,
            scale: Scale::around_zero(cells.iter().map(|cell| cell.value)),
            cells,
            layer: k,
            unit: subject.force_unit(),
            seen,
            floor,
        })
    }

    /// The figure: a map of the layer as seen from above; blue is pulled, orange pushed.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{Response, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Response::of_unit_load(Pile::triangular(4)?)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let subject = Subject::of_pile(&pile, &spacing)?;
    /// let svg = |k| Response::new(&subject, k).map(|response| response.drawing().to_string());
    /// assert!(svg(2)?.contains("Response of layer 2"));
    /// assert!(svg(3)?.contains("Response of the floor"));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn drawing(&self) -> Drawing {
        let title = if self.floor {
            "Response of the floor".into()
        } else {
            format!("Response of layer {}", self.layer)
        };
        let words = Words {
            title: &title,
            caption: &self.seen.caption,
            name: "vertical force",
            unit: self.unit,
            marked: &self.loads,
            mark: "below a load",
        };
        draw(&self.seen, &self.cells, &self.scale, &words)
    }
}

/// The sphere nearest to the middle of a layer.
pub(super) fn middle(pile: &Pile, k: i128) -> Result<Site, Error> {
    let region = pile.shape().layer(k)?;
    let corners = region.corners();
    let mean = |n: usize| {
        let sum: i128 = corners.iter().filter_map(|corner| corner.get(n)).sum();
        // To the nearest integer.
        (sum + 3).div_euclid(6)
    };
    let j = mean(1).clamp(*region.y().start(), *region.y().end());
    let row = region.row(j);
    let i = mean(0).clamp(row.start, row.end - 1);
    Ok(Site { i, j, k })
}

fn on_the_floor(subject: &Subject<'_>) -> Result<Vec<(Site, Surd)>, Error> {
    let forces = subject.packing().base(Selection::Base)?;
    forces
        .map(|force| force.map(|force| (force.site, force.normal)))
        .collect()
}

/// The vertical parts of what each sphere of a layer passes on, together: a contact force is f·mg/W along the vertical.
fn handed_on(subject: &Subject<'_>, k: i128) -> Result<Vec<(Site, Surd)>, Error> {
    let packing = subject.packing();
    let statics = packing.forces();
    let unit = packing.sphere_weight() / statics.increment_sum()?;
    let mut forces: Vec<(Site, BigRational)> = Vec::new();
    for contact in statics.contacts(Selection::Layer(k))? {
        let contact = contact?;
        match forces.last_mut() {
            Some((site, sum)) if *site == contact.site => *sum += contact.force,
            _ => forces.push((contact.site, contact.force)),
        }
    }
    let in_units = |(site, force): (Site, BigRational)| (site, Surd::from(force * &unit));
    Ok(forces.into_iter().map(in_units).collect())
}
