//! Forces on the floor.

use core::fmt;

use exact_surd::layout::{padded, part};

use crate::each::Each;
use crate::lattice::Site;
use crate::scalar::{Ring, Surd, SurdSum};

/// The force of one bottom sphere on the floor.
///
/// Paper, (13) and (14). The units below are those of [`Forces`](crate::Forces). From a [`Packing`](crate::Packing),
/// all three components are in units of force.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Site;
/// use cannonpile::{FloorForce, Pile};
///
/// let pile = Pile::triangular(10)?;
/// // The shear is zero in the middle of the base.
/// let site = Site { i: 3, j: 3, k: 9 };
/// let force = pile.forces::<f64>().on_floor(site)?;
/// assert_eq!(force, FloorForce { site, normal: 4.0, shear_x: 0.0, shear_y: 0.0 });
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(::serde::Serialize, ::serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound = "T: crate::data::Number", deny_unknown_fields)
)]
pub struct FloorForce<T> {
    /// The bottom sphere.
    pub site: Site,
    /// The normal force, in mg. It points downwards.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub normal: T,
    /// The shear along x, in mg·tanθ.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub shear_x: T,
    /// The shear along y, in 2cosφ·mg·tanθ, which is √3·mg·tanθ on an equilateral base. It is zero for discs.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub shear_y: T,
}

exact_surd::equality!(FloorForce<T>, T: Ring; |Self { site, normal, shear_x, shear_y }|
    (site, [normal, shear_x, shear_y].map(Ring::comparison_key)));
exact_surd::equality!(FloorForce<Surd>; |Self { site, normal, shear_x, shear_y }| (site, normal, shear_x, shear_y));
exact_surd::equality!(FloorForce<SurdSum>; |Self { site, normal, shear_x, shear_y }| (site, normal, shear_x, shear_y));

impl<T> FloorForce<T> {
    /// Returns the force with `f` applied to each component.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::FloorForce;
    /// use cannonpile::lattice::Site;
    ///
    /// let force = FloorForce { site: Site::APEX, normal: 4, shear_x: -1, shear_y: 0 };
    /// assert_eq!(force.map(f64::from).normal, 4.0);
    /// ```
    #[must_use]
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> FloorForce<U> {
        FloorForce {
            site: self.site,
            normal: f(self.normal),
            shear_x: f(self.shear_x),
            shear_y: f(self.shear_y),
        }
    }
}

impl<T: fmt::Display> fmt::Display for FloorForce<T> {
    /// Prints `(3,3,9): normal 4, shear (0, 0)`. The flag `+` and a precision apply to the components.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Site;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let force = pile.forces::<f64>().on_floor(Site::new(0, 0, 9))?;
    /// assert_eq!(force.to_string(), "(0,0,9): normal 4, shear (-1.5, -1.5)");
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let components = [&self.normal, &self.shear_x, &self.shear_y];
        let [normal, x, y] = components.each(|component| part(f, component));
        let site = self.site;
        padded(f, format_args!("{site}: normal {normal}, shear ({x}, {y})"))
    }
}

#[cfg(test)]
mod tests {
    use crate::Pile;
    use crate::shape::Selection;

    #[test]
    fn hints_are_exact() {
        let piles = [
            Pile::triangular(4).unwrap(),
            Pile::discs(4).unwrap(),
            Pile::under("hexagon:2".parse().unwrap(), "+-+".parse().unwrap()).unwrap(),
            // A row is computed in several pieces.
            Pile::under(
                "region:0..99,0..0,0..99".parse().unwrap(),
                "+-+".parse().unwrap(),
            )
            .unwrap(),
        ];
        for pile in &piles {
            for part in [Selection::Base, Selection::Layer(3)] {
                let mut items = pile.forces::<f64>().base(part).unwrap();
                let mut left = items.clone().count();
                loop {
                    assert_eq!(items.size_hint(), (left, Some(left)));
                    if items.next().is_none() {
                        break;
                    }
                    left -= 1;
                }
                assert!(left == 0 && items.next().is_none());
            }
        }
    }

    #[test]
    fn more_than_a_usize_has_no_upper_bound() {
        let pile = Pile::triangular(10_i128.pow(30)).unwrap();
        let items = pile.forces::<f64>().base(Selection::Base).unwrap();
        assert_eq!(items.size_hint(), (usize::MAX, None));
    }
}
