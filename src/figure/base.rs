//! The normal force of a pile on the floor, as a map.

use super::Subject;
use super::canvas::Drawing;
use super::cells::{MapCell, Words, draw};
use super::colour::Scale;
use super::layer::Layer;
use super::subject::{nearest, readable};
use crate::Error;
use crate::shape::Selection;

/// The normal forces of the bottom spheres on the floor.
///
/// Under the paper's pile they are all the same, eq. (result-normal).
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::figure::{BaseMap, Subject};
/// use cannonpile::geometry::Spacing;
/// use cannonpile::lattice::Region;
/// use num_rational::BigRational;
///
/// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
/// let pile = Pile::triangular(10)?;
/// assert!(BaseMap::new(&Subject::of_pile(&pile, &spacing)?)?.scale.is_uniform());
/// let pile = Pile::under(Region::SITE, "+-+-".parse()?)?;
/// assert!(!BaseMap::new(&Subject::of_pile(&pile, &spacing)?)?.scale.is_uniform());
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct BaseMap {
    /// The bottom spheres, in row order.
    pub cells: Vec<MapCell>,
    /// The unit of the forces.
    pub unit: &'static str,
    /// Their colours.
    pub scale: Scale,
    layer: Layer,
}

/// The most cells.
pub(super) const LIMIT: u32 = 20_000;

impl BaseMap {
    /// From the exact forces, each rounded once.
    ///
    /// # Errors
    /// [`Error::TooManyMarks`] for more than 20 000 bottom spheres; [`Error::Overflow`] for forces beyond floats; those
    /// of [`Packing::base`](crate::Packing::base).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{BaseMap, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let map = BaseMap::new(&Subject::of_pile(&pile, &spacing)?)?;
    /// // 55 spheres bear the weight of all 220.
    /// assert_eq!(map.cells.len(), 55);
    /// assert_eq!(map.cells.iter().map(|cell| cell.value).sum::<f64>(), 220.0);
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
        let forces = subject.packing().base(Selection::Base)?;
        let cells = forces.map(|force| {
            let force = force?;
            Ok(MapCell {
                site: force.site,
                value: nearest(&force.normal, "a normal force")?,
                exact: force.normal,
            })
        });
        let cells: Vec<MapCell> = cells.collect::<Result<_, Error>>()?;
        Ok(Self {
            scale: Scale::of(cells.iter().map(|cell| cell.value)),
            cells,
            unit: subject.force_unit(),
            layer: Layer::new(subject, pile.layers() - 1)?,
        })
    }

    /// The figure: a map of the base as seen from above, with the bar of its colours.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::figure::{BaseMap, Subject};
    /// use cannonpile::geometry::Spacing;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
    /// let svg = BaseMap::new(&Subject::of_pile(&pile, &spacing)?)?.drawing().to_string();
    /// assert_eq!(svg.matches("class=\"cell\"").count(), 55);
    /// // The bar has one colour, since the force is the same everywhere.
    /// assert!(svg.contains("everywhere"));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn drawing(&self) -> Drawing {
        let words = Words {
            title: "Normal force of the pile on the floor",
            caption: &self.layer.caption,
            name: "normal force",
            unit: self.unit,
            marked: &[],
            mark: "",
        };
        draw(&self.layer, &self.cells, &self.scale, &words)
    }
}
