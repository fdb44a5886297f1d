//! Contact forces between spheres.

use core::fmt;

use exact_surd::layout::{padded, part};

use crate::lattice::{Direction, Site};
use crate::scalar::{Ring, Surd};

/// The force of one contact, between a sphere and one of the spheres that support it.
///
/// # Examples
/// ```
/// use cannonpile::lattice::{Direction, Site};
/// use cannonpile::shape::Selection;
/// use cannonpile::{ContactForce, Pile};
///
/// let pile = Pile::triangular(10)?;
/// let first = pile.forces::<f64>().contacts(Selection::All)?.next();
/// let (site, direction) = (Site::APEX, Direction::Alpha);
/// assert_eq!(first, Some(Ok(ContactForce { site, direction, force: 1.0 })));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(::serde::Serialize, ::serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound = "T: crate::data::Number", deny_unknown_fields)
)]
pub struct ContactForce<T> {
    /// The upper sphere.
    pub site: Site,
    /// The direction from the upper sphere to the lower one.
    pub direction: Direction,
    /// The force, in f₀. It is positive in compression. It is negative if the contact would be tensile.
    #[cfg_attr(feature = "serde", serde(with = "crate::data::number"))]
    pub force: T,
}

exact_surd::equality!(ContactForce<T>, T: Ring; |Self { site, direction, force }| (site, direction, force.comparison_key()));
exact_surd::equality!(ContactForce<Surd>; |Self { site, direction, force }| (site, direction, force));

impl<T: fmt::Display> fmt::Display for ContactForce<T> {
    /// Prints the site, the direction and the force, as `(0,0,0) alpha: 1`. The flag `+` and a precision apply to the
    /// force.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::ContactForce;
    /// use cannonpile::lattice::{Direction, Site};
    ///
    /// let contact = ContactForce { site: Site::APEX, direction: Direction::Gamma, force: 0.5 };
    /// assert_eq!(contact.to_string(), "(0,0,0) gamma: 0.5");
    /// assert_eq!(format!("{contact:+.2}"), "(0,0,0) gamma: +0.50");
    /// ```
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (
            Self {
                site, direction, ..
            },
            force,
        ) = (self, part(f, &self.force));
        padded(f, format_args!("{site} {direction}: {force}"))
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
        ];
        for pile in &piles {
            for part in [Selection::All, Selection::Layer(1), Selection::Base] {
                let mut items = pile.forces::<f64>().contacts(part).unwrap();
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
        let items = pile.forces::<f64>().contacts(Selection::All).unwrap();
        assert_eq!(items.size_hint(), (usize::MAX, None));
    }
}
