//! Piles of random stackings: what they grow from, and what acts on them.

use std::collections::BTreeMap;

use cannonpile::engine::common_denominator;
use cannonpile::lattice::{Dimension, MAX_LAYERS, Region, Site};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::stackings::{FirstSign, RandomStackings};
use crate::Error;

/// The piles of all stackings of an ensemble, alike in what they grow from and in what acts on them.
///
/// Every sphere weighs mg, unless the piles are [`weightless`](Self::weightless), and loads are on spheres of the top layer.
/// Contacts are those of the [paper](cannonpile::paper), without horizontal ones and without regard to signs: stackings that
/// cannot stand count like any other, and the answers are those of piles whose contacts can pull, be it that they
/// are glued, or pressed together by more than these forces.
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
/// // 10 spheres of FCC, 11 of HCP.
/// assert_eq!(total.to_string(), "21/2");
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RandomPiles {
    pub(super) setting: Setting,
    pub(super) stackings: RandomStackings,
    weightless: bool,
    /// On sites of the top layer, in mg.
    loads: BTreeMap<[i128; 2], BigRational>,
}

/// What piles grow from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Setting {
    /// Layers without end.
    Plane,
    /// Down from a top layer.
    Under(Region),
    /// Up from a base.
    On(Region),
}

impl RandomPiles {
    /// Returns the piles that grow down from a top layer, each layer all supports of the one above.
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

    /// Returns the piles that grow up from a base, each layer all sites whose three supports are there.
    ///
    /// The signs are read from the top, as everywhere. A stacking that the base does not carry to this height is no pile: it
    /// counts as one without spheres.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(3, FirstSign::Random)?;
    /// let piles = RandomPiles::on(Region::triangle(3)?, stackings);
    /// // Of four stackings the triangle carries ++ alone.
    /// let mean = piles.mean(&0.5)?;
    /// assert!(mean.rows().iter().all(|row| row.probability == 0.25));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn on(base: Region, stackings: RandomStackings) -> Self {
        Self::of(Setting::On(base), stackings)
    }

    /// Returns layers without end in the plane: for the response to loads, of spheres that weigh nothing.
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
            loads: BTreeMap::new(),
        }
    }

    /// Returns the piles with spheres that weigh nothing: their response to loads alone.
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

    /// Returns the piles with one more vertical load on a sphere of the top layer, in mg.
    ///
    /// Only there is a sphere at its place in every stacking.
    ///
    /// # Errors
    /// [`Error::PlaceOfLoad`] for a sphere of another layer, and for piles on a base; [`SiteOutside`](cannonpile::Error::SiteOutside);
    /// [`NegativeLoad`](cannonpile::Error::NegativeLoad).
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
        // In the plane larger coordinates than those of regions would overflow.
        let in_plane = at.iter().all(|n| (-MAX_LAYERS..=MAX_LAYERS).contains(n));
        let (is_inside, region) = match self.setting {
            Setting::Under(top) => (top.contains(site.i, site.j), Some(top)),
            Setting::Plane | Setting::On(_) => (in_plane, None),
        };
        if !is_inside {
            let layers = self.stackings.layers();
            let outside = cannonpile::Error::site_outside(site, layers, Dimension::Three, region);
            return Err(outside.into());
        }
        if load.is_negative() {
            return Err(cannonpile::Error::negative_load("load", site, load).into());
        }
        *self.loads.entry(at).or_default() += load;
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

    /// Returns whether the spheres weigh nothing.
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

    /// The loads by their sites in the top layer, in mg.
    pub(super) fn loads(&self) -> &BTreeMap<[i128; 2], BigRational> {
        &self.loads
    }

    /// The least common denominator of the loads.
    pub(super) fn denominator(&self) -> BigInt {
        common_denominator(self.loads.values())
    }

    /// What a sphere weighs, in mg.
    pub(super) fn weight(&self) -> BigRational {
        if self.weightless {
            BigRational::zero()
        } else {
            BigRational::one()
        }
    }

    /// Refuses what is asked of the response to loads alone, and other piles.
    ///
    /// # Errors
    /// [`Error::OnlyOfLoads`].
    pub(super) fn check_response(&self, quantity: &'static str) -> Result<(), Error> {
        if self.weightless && !self.loads.is_empty() {
            return Ok(());
        }
        Err(Error::OnlyOfLoads {
            quantity,
            weightless: self.weightless,
        })
    }

    /// The numbers of net steps of the bottom layer, whatever the stacking.
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
