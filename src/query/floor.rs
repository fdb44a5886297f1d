//! Forces on the floor.

use super::source::Source;
use super::{Statics, edge_all};
use crate::Error;
use crate::formula;
use crate::geometry::Vector;
use crate::lattice::Site;
use crate::lines::Wanted;
use crate::meter::Meter;
use crate::scalar::Algebra;
use crate::shape::Rows;

/// The force of one bottom sphere on the floor.
///
/// Paper, eqs. (result-normal) and (result-shear). In the units below from [`Statics`]; from a
/// [`Packing`](crate::Packing) all three in units of force.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Site;
/// use cannonpile::{FloorForce, Pile};
///
/// let pile = Pile::triangular(10)?;
/// // In the middle of the base there is no shear.
/// let site = Site { i: 3, j: 3, k: 9 };
/// let force = pile.statics::<f64>().on_floor(site)?;
/// assert_eq!(force, FloorForce { site, normal: 4.0, shear_x: 0.0, shear_y: 0.0 });
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FloorForce<T> {
    /// The bottom sphere.
    pub site: Site,
    /// The normal force, in mg, downwards.
    pub normal: T,
    /// The shear along x, in mg·tanθ.
    pub shear_x: T,
    /// The shear along y, in 2cosφ·mg·tanθ (√3·mg·tanθ on an equilateral base); zero for discs.
    pub shear_y: T,
}

impl<'p, T: Algebra, M: Meter> Statics<'p, T, M> {
    /// The force of a bottom sphere on the floor.
    ///
    /// Normal mg(L+2)/3 under every sphere on an equilateral base (paper, eq. (result-normal)), and
    /// mg[1 + ((L−1−j) + 2sj)/(2(1+s))] in general. Shear −mg·tanθ/3·((L−1−3j)/2, √3/2·(L−1−2i−j)) on an
    /// equilateral base (eq. (result-shear)).
    ///
    /// # Errors
    /// [`Error::SiteOutside`]; [`Error::NotOnFloor`] for a sphere of another layer; [`Error::Overflow`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let force = pile.statics::<f64>().on_floor(Site { i: 0, j: 0, k: 9 })?;
    /// assert_eq!((force.normal, force.shear_x, force.shear_y), (4.0, -1.5, -1.5));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn on_floor(&self, site: Site) -> Result<FloorForce<T>, Error> {
        let site = self.pile.shape().check(site)?;
        let floor = self.floor();
        if site.k != floor {
            return Err(Error::NotOnFloor { site, floor });
        }
        let (above, changes) = self.received(site, Wanted::All)?;
        self.floor_force(site, &above, changes)
    }

    /// What a bottom sphere hands on to the floor.
    pub(super) fn floor_force(
        &self,
        site: Site,
        above: &[T::Numerator; 3],
        changes: usize,
    ) -> Result<FloorForce<T>, Error> {
        let (force, unit) = self.floor_numerators(site, above, changes);
        let [shear_x, shear_y, normal] =
            edge_all("a force on the floor", force.into_array(), &unit)?;
        Ok(FloorForce {
            site,
            normal,
            shear_x,
            shear_y,
        })
    }

    /// The same as numerators of (shear_x, shear_y, normal), and their denominator.
    pub(super) fn floor_numerators(
        &self,
        site: Site,
        above: &[T::Numerator; 3],
        changes: usize,
    ) -> (Vector<T::Numerator>, T::Numerator) {
        let directions = self.directions_under(self.sign_above(site.k));
        let force = formula::handed_on(above, &directions, &self.weight(site, changes));
        // mg is W of the unit of forces along lines.
        let unit = self.lines.scale(changes) * &self.direction_scale * &self.increment_sum;
        (force.scaled(&self.sum_scale), unit)
    }

    /// The forces of the bottom spheres in `rows` on the floor, lazily.
    ///
    /// Each item is an error if the row is not of the bottom layer, or the scalar overflows.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::shape::Selection;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let statics = pile.statics::<f64>();
    /// let base: Result<Vec<_>, _> = statics.base(pile.rows(Selection::Base)?).collect();
    /// assert!(base?.iter().all(|force| force.normal == 4.0));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn base(
        &self,
        rows: Rows<'p>,
    ) -> impl Iterator<Item = Result<FloorForce<T>, Error>> + use<'p, T, M> {
        let mut source = Source::new(self, &rows);
        let statics = self.clone();
        rows.flatten().map(move |site| {
            statics.meter.answer(1);
            source.on_floor(&statics, site)
        })
    }
}
