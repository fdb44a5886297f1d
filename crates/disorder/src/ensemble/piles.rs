//! An ensemble: the piles of many stackings under one top layer, or on one base.

use cannonpile::Pile;
use cannonpile::formula;
use cannonpile::lattice::{Region, Site};
use cannonpile::scalar::{ByValue, reduced};
use cannonpile::shape::Anchor;
use cannonpile::stacking::Stacking;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::RandomStackings;
use crate::{Each, Error};

/// All stackings below one top layer, or above one base.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{ContactSet, Choice, Ensemble, FirstSign, RandomStackings, Shard};
/// use cannonpile::lattice::Region;
///
/// let stackings = RandomStackings::new(5, FirstSign::Plus)?;
/// let ensemble = Ensemble::under(Region::hexagon(2, 2)?, stackings)?;
/// let tally = ensemble.run(&Choice::All, Shard::WHOLE)?;
/// assert_eq!(tally.standing(ContactSet::Sloping), Some(6_u32.into()));
/// let least = tally.faults[3].all.least.as_ref().unwrap();
/// assert_eq!((least.stacking.to_string(), least.force.to_string()), ("+-+-".into(), "-2/27".into()));
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
#[serde(
    try_from = "super::written::EnsembleParts",
    into = "super::written::EnsembleParts"
)]
pub struct Ensemble {
    /// The top layer or the base, as a pile of one layer.
    pub(super) layer: Pile,
    stackings: RandomStackings,
    has_horizontal_contacts: bool,
    bins: BigRational,
}

cannonpile::engine::equality!(Ensemble; |Self { layer, stackings, has_horizontal_contacts, bins }|
    (layer, stackings, has_horizontal_contacts, ByValue(bins)));

impl Ensemble {
    /// Returns the ensemble of these stackings under a top layer, with bins of width 1/3.
    ///
    /// # Errors
    /// The errors of [`Pile::under`].
    ///
    /// # Examples
    /// See [`Ensemble`].
    pub fn under(top: Region, stackings: RandomStackings) -> Result<Self, Error> {
        let top = Pile::under(top, Stacking::single_layer())?;
        Ok(Self::of(top, stackings))
    }

    /// Returns the ensemble of these stackings on a base, with bins of width 1/3. Each layer consists of all sites whose
    /// three supports exist.
    ///
    /// As everywhere, signs are listed from the top. A stacking whose top layer would be empty is left out. The tally
    /// says [how many](crate::Tally::left_out) there are.
    ///
    /// # Errors
    /// The errors of [`Pile::on`] for a single layer. A [run](Self::run) fails if the base supports no stacking of this
    /// height.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(3, FirstSign::Random)?;
    /// let tally = Ensemble::on(Region::triangle(3)?, stackings)?.run(&Choice::All, Shard::WHOLE)?;
    /// // Of four stackings the triangle supports ++ only.
    /// assert_eq!((tally.stackings(), tally.left_out()), (1_u32.into(), Some(3_u32.into())));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn on(base: Region, stackings: RandomStackings) -> Result<Self, Error> {
        let base = Pile::on(base, Stacking::single_layer())?;
        Ok(Self::of(base, stackings))
    }

    fn of(layer: Pile, stackings: RandomStackings) -> Self {
        Self {
            layer,
            stackings,
            has_horizontal_contacts: false,
            bins: BigRational::new(1.into(), 3.into()),
        }
    }

    /// Returns the ensemble with an additional vertical load on a sphere (i, j) of the top layer, in mg. Spheres of
    /// other layers cannot carry a load, because their positions depend on the stacking.
    ///
    /// # Errors
    /// * [`Error::PlaceOfLoad`] for an ensemble on a base.
    /// * [`SiteOutside`](cannonpile::Error::SiteOutside), [`NegativeLoad`](cannonpile::Error::NegativeLoad).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let stackings = RandomStackings::new(3, FirstSign::Plus)?;
    /// let load = BigRational::from_integer(1.into());
    /// let loaded = Ensemble::under(Region::SITE, stackings)?.with_load([0, 0], load)?;
    /// let tally = loaded.weightless().run(&Choice::All, Shard::WHOLE)?;
    /// assert_eq!(tally.faults[1].all.least.as_ref().unwrap().force.to_string(), "-1/3");
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn with_load(mut self, [i, j]: [i128; 2], load: BigRational) -> Result<Self, Error> {
        let site = Site { i, j, k: 0 };
        if matches!(self.anchor(), Anchor::Base(_)) {
            return Err(Error::PlaceOfLoad {
                site,
                on_base: true,
            });
        }
        self.layer = self.layer.with_load(site, load)?;
        Ok(self)
    }

    /// Returns the ensemble with weightless spheres, for the response to the loads. A stacking then counts as standing
    /// if none of its contacts is in tension.
    ///
    /// # Examples
    /// See [`with_load`](Self::with_load).
    #[must_use]
    pub fn weightless(mut self) -> Self {
        self.layer = self.layer.weightless();
        self
    }

    /// Returns the ensemble that also counts the stackings that are stable with horizontal contacts, at a = R.
    ///
    /// This crate does not solve for forces in horizontal contacts. A run of such an ensemble needs a judge, which the
    /// caller passes to [`run_judged`](Self::run_judged).
    ///
    /// # Errors
    /// [`Error::Weightless`].
    ///
    /// # Examples
    /// See [`run_judged`](Self::run_judged).
    pub fn with_horizontal_contacts(mut self) -> Result<Self, Error> {
        if self.layer.is_weightless() {
            return Err(Error::Weightless);
        }
        self.has_horizontal_contacts = true;
        Ok(self)
    }

    /// Returns the ensemble with bins of this width, in f₀ for contact forces and in mg for normal forces.
    ///
    /// # Errors
    /// [`Syntax`](cannonpile::Error::Syntax) for a width that is not positive.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Ensemble, FirstSign, RandomStackings};
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let stackings = RandomStackings::new(7, FirstSign::Plus)?;
    /// let ensemble = Ensemble::under(Region::SITE, stackings)?;
    /// assert_eq!(ensemble.bin_width().to_string(), "1/3");
    /// assert!(ensemble.clone().with_bin_width(BigRational::new(1.into(), 10.into())).is_ok());
    /// assert!(ensemble.with_bin_width(BigRational::from_integer(0.into())).is_err());
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn with_bin_width(mut self, width: BigRational) -> Result<Self, Error> {
        if !width.is_positive() {
            let expected = "a positive width of bins";
            return Err(Error::syntax(&width.to_string(), expected));
        }
        self.bins = reduced(width);
        Ok(self)
    }

    /// Returns the stackings.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Ensemble, FirstSign, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(7, FirstSign::Plus)?;
    /// assert_eq!(Ensemble::under(Region::SITE, stackings)?.stackings(), stackings);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn stackings(&self) -> RandomStackings {
        self.stackings
    }

    /// Returns the layer that all piles share: the top layer, or the base.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Ensemble, FirstSign, RandomStackings};
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Anchor;
    ///
    /// let stackings = RandomStackings::new(3, FirstSign::Plus)?;
    /// let hexagon = Region::hexagon(4, 4)?;
    /// assert_eq!(Ensemble::under(hexagon, stackings)?.anchor(), Anchor::Top(hexagon));
    /// assert_eq!(Ensemble::on(hexagon, stackings)?.anchor(), Anchor::Base(hexagon));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn anchor(&self) -> Anchor {
        self.layer.shape().anchor()
    }

    /// Returns the width of the bins, in f₀ for contact forces and in mg for normal forces.
    ///
    /// # Examples
    /// See [`with_bin_width`](Self::with_bin_width).
    #[must_use]
    pub const fn bin_width(&self) -> &BigRational {
        &self.bins
    }

    /// Returns whether the ensemble also counts the stackings that are stable with horizontal contacts.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Ensemble, FirstSign, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(7, FirstSign::Plus)?;
    /// assert!(!Ensemble::under(Region::SITE, stackings)?.has_horizontal_contacts());
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn has_horizontal_contacts(&self) -> bool {
        self.has_horizontal_contacts
    }

    /// Returns the pile of one stacking, which may have any number of layers.
    ///
    /// # Errors
    /// The errors of [`Pile::under`], or of [`Pile::on`] for an ensemble on a base.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Ensemble, FirstSign, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(3, FirstSign::Plus)?;
    /// let pile = Ensemble::under(Region::SITE, stackings)?.pile("+-".parse()?)?;
    /// assert_eq!(pile.sphere_count(), 11_u32.into());
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn pile(&self, stacking: Stacking) -> Result<Pile, Error> {
        let mut pile = match self.anchor() {
            Anchor::Top(top) => Pile::under(top, stacking)?,
            Anchor::Base(base) => Pile::on(base, stacking)?,
        };
        for (site, load) in self.layer.loads() {
            pile = pile.with_load(site, load.clone())?;
        }
        Ok(if self.layer.is_weightless() {
            pile.weightless()
        } else {
            pile
        })
    }

    /// Returns the sites of the top layer, or of the base.
    pub(super) fn region(&self) -> Region {
        self.layer.shape().base()
    }

    /// Returns the weight of a sphere without a load, in mg: 0 or 1.
    pub(super) fn weight(&self) -> BigRational {
        if self.layer.is_weightless() {
            BigRational::zero()
        } else {
            BigRational::one()
        }
    }

    /// Returns the force that each sphere of the top layer adds to each of its contacts, in row order.
    pub(super) fn own_of_top(&self, increment: &BigRational) -> Result<Vec<BigRational>, Error> {
        let weight = self.weight();
        let own = |site| -> Result<_, Error> {
            let total = weight.clone() + self.layer.load(site)?.down;
            Ok(formula::force(total, increment))
        };
        self.layer.shape().sites().map(own).collect()
    }

    /// Returns whether the top layer with its loads, or the base, is its own mirror image. Then mirror images of stackings
    /// have the same forces.
    pub(super) fn is_its_own_mirror_image(&self) -> bool {
        let region = self.region();
        let [sum_of_i, sum_of_j] =
            [region.x(), region.y()].each(|range| range.start() + range.end());
        let image = |site: Site| Site {
            i: sum_of_i - site.i,
            j: sum_of_j - site.j,
            ..site
        };
        let has_same = |(site, load): (Site, &cannonpile::Load)| {
            self.layer.load(image(site)).as_ref() == Ok(load)
        };
        region.is_its_own_mirror_image() && self.layer.loads().all(has_same)
    }
}
