//! The bounds of many bottom spheres.

use std::collections::HashMap;

use cannonpile::Pile;
use cannonpile::engine::{bug, map, threads};
use cannonpile::lattice::Site;
use cannonpile::shape::{Rows, Selection};

use crate::Error;
use crate::bounds::{NormalBound, NormalBounds, bounds};
use crate::symmetry::SixFold;

/// How far ahead a site is looked for that is none's image.
const AHEAD: usize = 1000;

/// The bounds of bottom spheres one by one, from [`base_bounds`].
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::shape::Selection;
/// use cannonpile_horizontal::base_bounds;
///
/// let pile = Pile::triangular(4)?;
/// let bounds: Result<Vec<_>, _> = base_bounds(&pile, Selection::Base)?.collect();
/// let greatest = bounds?.into_iter().map(|(_, bounds)| bounds.greatest.normal).max().unwrap();
/// assert_eq!(greatest.to_string(), "10/3");
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct BaseBounds<'p> {
    pile: &'p Pile,
    sites: core::iter::Flatten<Rows<'p>>,
    /// Found ahead of their turn, with those that follow them on other threads.
    ahead: HashMap<Site, Result<NormalBounds, Error>>,
    /// Where the symmetries of the pile map bottom spheres on each other: what is known, by their coordinates in order.
    symmetric: Option<(SixFold<'p>, HashMap<[i128; 3], NormalBounds>)>,
}

/// Returns the [bounds](crate::bounds()) of bottom spheres: of the base, or of one.
///
/// Of a pile under one sphere, all spheres alike, six spheres of the base are images of each other; what is found
/// for the first is said of the others, without its certificate. With the feature `rayon` as many spheres are asked at once
/// as there are threads.
///
/// # Errors
/// [`NotOnFloor`](cannonpile::Error::NotOnFloor), [`SiteOutside`](cannonpile::Error::SiteOutside),
/// [`LayerOutside`](cannonpile::Error::LayerOutside) of a part that is not of the base; in an item, as for
/// [`bounds`](crate::bounds()).
///
/// # Examples
/// See [`BaseBounds`].
pub fn base_bounds(pile: &Pile, part: Selection) -> Result<BaseBounds<'_>, Error> {
    let rows = pile.rows(part)?;
    let floor = pile.layers() - 1;
    if let Some(site) = rows.clone().flatten().next().filter(|site| site.k != floor) {
        return Err(cannonpile::Error::not_on_floor(site, floor).into());
    }
    let symmetric = SixFold::of(pile).map(|six_fold| (six_fold, HashMap::new()));
    Ok(BaseBounds {
        pile,
        sites: rows.flatten(),
        ahead: HashMap::new(),
        symmetric,
    })
}

impl BaseBounds<'_> {
    /// What the images of a site have in common, if it has any.
    fn orbit(&self, site: Site) -> Option<[i128; 3]> {
        let (six_fold, _) = self.symmetric.as_ref()?;
        let mut orbit = six_fold.coordinates(site);
        orbit.sort_unstable();
        Some(orbit)
    }

    /// What is known of an image of a site.
    fn known(&self, site: Site) -> Option<&NormalBounds> {
        let (_, known) = self.symmetric.as_ref()?;
        known.get(&self.orbit(site)?)
    }

    /// Finds the bounds of a site, and of as many that follow as there are threads: no two of them images, or known.
    fn find(&mut self, site: Site) {
        let mut sites = Vec::from([site]);
        for next in self.sites.clone().take(AHEAD) {
            if sites.len() >= threads() {
                break;
            }
            let orbit = self.orbit(next);
            let is_image = |other: &Site| orbit.is_some() && self.orbit(*other) == orbit;
            let is_known = self.known(next).is_some() || self.ahead.contains_key(&next);
            if !is_known && !sites.iter().any(is_image) {
                sites.push(next);
            }
        }
        let pile = self.pile;
        let found = map(sites, |site| (site, bounds(pile, site)));
        // What is refused ahead of its turn, or interrupted, is asked again then.
        let found = found
            .into_iter()
            .filter(|(found, bounds)| *found == site || bounds.is_ok());
        for (site, bounds) in found {
            let orbit = self.orbit(site);
            if let (Some(orbit), Ok(bounds), Some((_, known))) =
                (orbit, &bounds, &mut self.symmetric)
            {
                known.insert(orbit, bounds.without_certificates());
            }
            self.ahead.insert(site, bounds);
        }
    }
}

impl Iterator for BaseBounds<'_> {
    type Item = Result<(Site, NormalBounds), Error>;

    fn next(&mut self) -> Option<Self::Item> {
        let site = self.sites.next()?;
        if !self.ahead.contains_key(&site) {
            if let Some(known) = self.known(site) {
                return Some(Ok((site, known.clone())));
            }
            self.find(site);
        }
        let found = self.ahead.remove(&site);
        let found =
            found.unwrap_or_else(|| Err(bug("the bounds of a site are found with it").into()));
        Some(found.map(|bounds| (site, bounds)))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.sites.size_hint()
    }
}

impl NormalBounds {
    /// What is said of an image.
    fn without_certificates(&self) -> Self {
        let bare = |bound: &NormalBound| NormalBound {
            normal: bound.normal.clone(),
            attained: bound.attained,
            certificate: None,
        };
        Self {
            least: bare(&self.least),
            greatest: bare(&self.greatest),
        }
    }
}
