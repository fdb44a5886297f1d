//! Bounds for all bottom spheres of a part of the base.

use std::collections::HashMap;

use cannonpile::Pile;
use cannonpile::engine::{bug, map, threads};
use cannonpile::lattice::Site;
use cannonpile::shape::{Rows, Selection};

use crate::Error;
use crate::bounds::{NormalBounds, bounds};
use crate::symmetry::AxisSymmetry;

/// The number of following sites that are searched for work for other threads.
const AHEAD: usize = 1000;

/// An iterator over the bottom spheres of a part and their bounds, from [`base_bounds`].
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
    /// Bounds that other threads computed before the iterator reached their sites.
    ahead: HashMap<Site, Result<NormalBounds, Error>>,
    /// The symmetry of the pile, and the bounds that are known for each orbit, by sorted coordinates. `None`
    /// without symmetry.
    symmetric: Option<(AxisSymmetry<'p>, HashMap<[i128; 3], NormalBounds>)>,
}

/// Returns an iterator over bottom spheres with their [bounds](crate::bounds()), in mg. The part is the base or one
/// sphere.
///
/// In a pile under one sphere with equal spheres, up to six bottom spheres are images of each other. The first sphere
/// of an orbit has certificates with its bounds. Its images have the same bounds without certificates. With the feature
/// `rayon` each thread computes one sphere at a time.
///
/// # Errors
/// Returns [`NotOnFloor`](cannonpile::Error::NotOnFloor), [`SiteOutside`](cannonpile::Error::SiteOutside) or
/// [`LayerOutside`](cannonpile::Error::LayerOutside) if the part is not on the base. Items contain the errors of
/// [`bounds`](crate::bounds()).
///
/// # Examples
/// See [`BaseBounds`].
pub fn base_bounds(pile: &Pile, part: Selection) -> Result<BaseBounds<'_>, Error> {
    let rows = pile.rows(part)?;
    let floor = pile.layers() - 1;
    if let Some(site) = rows.clone().flatten().next().filter(|site| site.k != floor) {
        return Err(cannonpile::Error::NotOnFloor { site, floor }.into());
    }
    let symmetric = AxisSymmetry::of(pile).map(|symmetry| (symmetry, HashMap::new()));
    Ok(BaseBounds {
        pile,
        sites: rows.flatten(),
        ahead: HashMap::new(),
        symmetric,
    })
}

impl BaseBounds<'_> {
    /// Returns the key of the orbit of a site, if the pile is symmetric.
    fn orbit(&self, site: Site) -> Option<[i128; 3]> {
        let (symmetry, _) = self.symmetric.as_ref()?;
        let mut orbit = symmetry.coordinates(site);
        orbit.sort_unstable();
        Some(orbit)
    }

    /// Returns the bounds of an image of the site, if they are known.
    fn known(&self, site: Site) -> Option<&NormalBounds> {
        let (_, known) = self.symmetric.as_ref()?;
        known.get(&self.orbit(site)?)
    }

    /// Computes the bounds of a site, and in parallel those of following sites in other orbits, one for each
    /// further thread.
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
        // Errors of later sites are dropped here. The iterator computes such a site again when it is reached.
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
        let found = found.unwrap_or_else(|| {
            Err(bug("the bounds of a site are computed before they are returned").into())
        });
        Some(found.map(|bounds| (site, bounds)))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.sites.size_hint()
    }
}

impl NormalBounds {
    /// Returns the bounds for an image of the sphere: the certificates are about the sphere itself, so they are
    /// dropped.
    fn without_certificates(&self) -> Self {
        let mut bare = self.clone();
        bare.least.certificate = None;
        bare.greatest.certificate = None;
        bare
    }
}
