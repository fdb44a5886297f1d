//! Piles of random stackings, with their geometry and loads.

use cannonpile::engine::{common_denominator, not_negative};
use cannonpile::lattice::{Dimension, MAX_LAYERS, Region, Site};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::stackings::{FirstSign, RandomStackings};
use crate::Error;

/// The piles of all random stackings that share a top layer or a base, and loads.
///
/// Every sphere weighs mg, unless the piles are [`weightless`](Self::weightless). Loads act on spheres of the top
/// layer. Contacts are those of the [paper](cannonpile::paper), without horizontal ones. Unstable stackings count like
/// any other. So the results are those of piles whose contacts can bear tension, because the spheres are glued or the
/// pile is prestressed.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
/// use cannonpile::lattice::Region;
/// use num_rational::BigRational;
///
/// let stackings = RandomStackings::new(3, FirstSign::Plus)?;
/// let piles = RandomPiles::under(Region::SITE, stackings);
/// let mean = piles.exact(&BigRational::new(1.into(), 2.into()))?;
/// let total: BigRational = mean.rows().iter().map(|row| row.normal.clone()).sum();
/// // FCC has 10 spheres, HCP has 11.
/// assert_eq!(total.to_string(), "21/2");
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct RandomPiles {
    pub(super) setting: Setting,
    pub(super) stackings: RandomStackings,
    weightless: bool,
    /// By site of the top layer, in mg.
    /// By site of the top layer, in ascending order.
    loads: Vec<([i128; 2], BigRational)>,
}

cannonpile::engine::equality!(RandomPiles);

/// The region of the piles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Setting {
    /// Infinite layers.
    Plane,
    /// The top layer of piles that grow down.
    Under(Region),
    /// The base of piles that grow up.
    On(Region),
}

impl RandomPiles {
    /// Returns the piles under a top layer. Each layer consists of all supports of the layer above.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(5, FirstSign::Random)?;
    /// let piles = RandomPiles::under(Region::hexagon(2, 2)?, stackings);
    /// assert_eq!(piles.stackings(), stackings);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn under(top: Region, stackings: RandomStackings) -> Self {
        Self::of(Setting::Under(top), stackings)
    }

    /// Returns the piles on a base. Each layer consists of all sites whose three supports exist.
    ///
    /// As everywhere, signs are listed from the top. A stacking that the base does not support counts as a pile without
    /// spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(3, FirstSign::Random)?;
    /// let piles = RandomPiles::on(Region::triangle(3)?, stackings);
    /// // Of four stackings the triangle supports ++ only.
    /// let mean = piles.mean(&0.5)?;
    /// assert!(mean.rows().iter().all(|row| row.probability == 0.25));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn on(base: Region, stackings: RandomStackings) -> Self {
        Self::of(Setting::On(base), stackings)
    }

    /// Returns piles of infinite layers, for the response of weightless spheres to loads.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// let stackings = RandomStackings::new(2, FirstSign::Plus)?;
    /// let plane = RandomPiles::plane(stackings).weightless();
    /// let plane = plane.with_load(Site::APEX, BigRational::from_integer(3.into()))?;
    /// let mean = plane.mean(&0.5)?;
    /// assert!(mean.rows().iter().all(|row| (row.normal, row.probability) == (1.0, 1.0)));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn plane(stackings: RandomStackings) -> Self {
        Self::of(Setting::Plane, stackings)
    }

    const fn of(setting: Setting, stackings: RandomStackings) -> Self {
        Self {
            setting,
            stackings,
            weightless: false,
            loads: Vec::new(),
        }
    }

    /// Returns the piles with weightless spheres, for their response to loads.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(5, FirstSign::Plus)?;
    /// let piles = RandomPiles::under(Region::SITE, stackings).weightless();
    /// assert!(piles.mean(&0.5)?.rows().iter().all(|row| row.normal == 0.0));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn weightless(mut self) -> Self {
        self.weightless = true;
        self
    }

    /// Returns the piles with an additional vertical load on a sphere of the top layer, in mg.
    ///
    /// In other layers the position of a sphere depends on the stacking.
    ///
    /// # Errors
    /// * [`Error::PlaceOfLoad`] for a sphere of another layer, and for piles on a base.
    /// * [`SiteOutside`](cannonpile::Error::SiteOutside) for a site outside of the top layer.
    /// * [`NegativeLoad`](cannonpile::Error::NegativeLoad).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::{Region, Site};
    /// use num_rational::BigRational;
    ///
    /// let stackings = RandomStackings::new(5, FirstSign::Plus)?;
    /// let piles = RandomPiles::under(Region::SITE, stackings);
    /// let load = BigRational::from_integer(2.into());
    /// assert!(piles.clone().with_load(Site { i: 0, j: 0, k: 1 }, load.clone()).is_err());
    /// assert!(piles.with_load(Site::APEX, load).is_ok());
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn with_load(mut self, site: Site, load: BigRational) -> Result<Self, Error> {
        let on_base = matches!(self.setting, Setting::On(_));
        if on_base || site.k != 0 {
            return Err(Error::PlaceOfLoad { site, on_base });
        }
        let at = [site.i, site.j];
        // In the plane, coordinates outside the range of regions would overflow.
        let in_plane = at.iter().all(|n| (-MAX_LAYERS..=MAX_LAYERS).contains(n));
        let (is_inside, region) = match self.setting {
            Setting::Under(top) => (top.contains(site.i, site.j), Some(top)),
            Setting::Plane | Setting::On(_) => (in_plane, None),
        };
        if !is_inside {
            let layers = self.stackings.layers();
            let outside = cannonpile::Error::SiteOutside {
                site,
                layers,
                dimension: Dimension::Three,
                region: region.map(Box::new),
            };
            return Err(outside.into());
        }
        let load = not_negative("load", site, load)?;
        match self.loads.binary_search_by_key(&at, |(site, _)| *site) {
            Ok(place) => self.loads[place].1 += load,
            Err(place) => self.loads.insert(place, (at, load)),
        }
        Ok(self)
    }

    /// Returns the stackings.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(5, FirstSign::Plus)?;
    /// assert_eq!(RandomPiles::under(Region::SITE, stackings).stackings(), stackings);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn stackings(&self) -> RandomStackings {
        self.stackings
    }

    /// Returns whether the spheres are weightless.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(5, FirstSign::Plus)?);
    /// assert!(!piles.is_weightless());
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn is_weightless(&self) -> bool {
        self.weightless
    }

    /// Returns the loads by site of the top layer, in mg.
    pub(super) fn loads(&self) -> &[([i128; 2], BigRational)] {
        &self.loads
    }

    /// Returns the least common denominator of the loads.
    pub(super) fn denominator(&self) -> BigInt {
        common_denominator(self.loads.iter().map(|(_, load)| load))
    }

    /// Returns the weight of a sphere, in mg.
    pub(super) fn weight(&self) -> BigRational {
        if self.weightless {
            BigRational::zero()
        } else {
            BigRational::one()
        }
    }

    /// Rejects piles without loads, and spheres with weight.
    ///
    /// # Errors
    /// [`Error::NotAResponse`].
    pub(super) fn check_response(&self, quantity: &'static str) -> Result<(), Error> {
        if self.weightless && !self.loads.is_empty() {
            return Ok(());
        }
        Err(Error::NotAResponse {
            quantity,
            weightless: self.weightless,
        })
    }

    /// Returns the least and the greatest net number of steps of the bottom layer.
    pub(super) fn net_bounds(&self) -> (i128, i128) {
        let steps = self.stackings.steps();
        let turned = (steps - 2).max(-steps);
        match self.stackings.first() {
            FirstSign::Plus => (-turned, steps),
            FirstSign::Minus => (-steps, turned),
            FirstSign::Random => (-steps, steps),
        }
    }
}
