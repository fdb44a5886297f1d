//! The bounds of many bottom spheres.

use std::collections::HashMap;

use super::bounds::{NormalBound, NormalBounds};
use super::symmetry::SixFold;
use crate::lattice::Site;
use crate::shape::{Rows, Selection};
use crate::{Error, Pile};

/// The bounds of bottom spheres one by one, from [`Pile::base_bounds`].
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::shape::Selection;
///
/// let pile = Pile::triangular(4)?;
/// let bounds: Result<Vec<_>, _> = pile.base_bounds(Selection::Base)?.collect();
/// let greatest = bounds?.into_iter().map(|(_, bounds)| bounds.greatest.normal).max().unwrap();
/// assert_eq!(greatest.to_string(), "10/3");
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct BaseBounds<'p> {
    pile: &'p Pile,
    sites: core::iter::Flatten<Rows<'p>>,
    /// Where the symmetries of the pile map bottom spheres on each other: what is known, by their coordinates in order.
    symmetric: Option<(SixFold<'p>, HashMap<[i128; 3], NormalBounds>)>,
}

impl Pile {
    /// Returns the [bounds](Self::bounds) of bottom spheres: of the base, or of one.
    ///
    /// Of a pile under one sphere, all spheres alike, six spheres of the base are images of each other; what is found
    /// for the first is said of the others, without its certificate.
    ///
    /// # Errors
    /// [`Error::NotOnFloor`], [`Error::SiteOutside`], [`Error::LayerOutside`] of a part that is not of the base; in an
    /// item, as for [`bounds`](Self::bounds).
    ///
    /// # Examples
    /// See [`BaseBounds`](crate::horizontal::BaseBounds).
    pub fn base_bounds(&self, part: Selection) -> Result<BaseBounds<'_>, Error> {
        let rows = self.rows(part)?;
        let floor = self.layers() - 1;
        if let Some(site) = rows.clone().flatten().next().filter(|site| site.k != floor) {
            return Err(Error::NotOnFloor { site, floor });
        }
        let symmetric = SixFold::of(self).map(|six_fold| (six_fold, HashMap::new()));
        Ok(BaseBounds {
            pile: self,
            sites: rows.flatten(),
            symmetric,
        })
    }
}

impl Iterator for BaseBounds<'_> {
    type Item = Result<(Site, NormalBounds), Error>;

    fn next(&mut self) -> Option<Self::Item> {
        let site = self.sites.next()?;
        let Some((six_fold, known)) = &mut self.symmetric else {
            return Some(self.pile.bounds(site).map(|bounds| (site, bounds)));
        };
        let mut orbit = six_fold.coordinates(site);
        orbit.sort_unstable();
        if let Some(bounds) = known.get(&orbit) {
            return Some(Ok((site, bounds.clone())));
        }
        Some(self.pile.bounds(site).map(|bounds| {
            let bare = |bound: &NormalBound| NormalBound {
                normal: bound.normal.clone(),
                attained: bound.attained,
                certificate: None,
            };
            let image = NormalBounds {
                least: bare(&bounds.least),
                greatest: bare(&bounds.greatest),
            };
            known.insert(orbit, image);
            (site, bounds)
        }))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.sites.size_hint()
    }
}
