//! Enumeration and sampling of stackings, for quantities that are not linear in the stackings.
//!
//! Mean forces obey one recursion over all stackings. Stability, the least force and the distribution of forces do not,
//! so the forces of each stacking are computed. An [`Ensemble`] is a top layer with every stacking below it, or a base
//! with every stacking above it. A [`Choice`] selects all stackings or random samples, and a [`Shard`] selects a part of
//! them. The result is a [`Tally`] of exact integers and rationals, sorted by the number of faults. So the fault
//! probability can be chosen afterwards. The tallies of all shards [merge](Tally::merge) into the tally of the whole, bit
//! for bit, in any order.
//!
//! # Stackings in the counts
//! The distribution `all` includes unstable stackings, in which some contact is in tension. Their forces are those of a
//! prestressed pile. The distribution `standing` covers the stackings without tension. Loose spheres can form these
//! piles.
//!
//! # On a base
//! A layer above a base has all sites whose three supports exist. It depends on the numbers of + and − steps between the
//! base and the layer, but not on their order. So all stackings with equally many + steps have the same top layer. Once
//! this number is given, each layer follows from the steps above it. If the top layer is empty, the base does not support
//! these stackings. Only [`WithFaults::left_out`] counts them. Means and probabilities are over the other stackings.
//!
//! # Why it is exact
//! A force below a layer is an integer over 3^d times the common denominator of the loads, with d sign changes above
//! it. The sum of the squares of all forces below a layer depends on the weights only. The reason is that each force
//! acts on one sphere of the next layer, and that the half-turn is orthogonal. So no force exceeds the root of this
//! sum. The bound is computed beforehand, and decides between 64-bit, 128-bit and big integers.
//!
//! # Why it is fast
//! Stackings that begin with the same signs have the same forces in the layers of this beginning. So all stackings of n
//! steps are computed as a tree, which has at most 2ⁿ⁺¹ layers instead of n 2ⁿ. On a base there is a tree for each number
//! of + steps. If the top layer with its loads, or the base, is its own mirror image, one stacking of each mirror pair is
//! computed.
//!
//! # With horizontal contacts
//! At a = R a stacking with contacts in tension can be stable too. All beginnings of a stable stacking are stable, and
//! it stays stable if its last step is repeated. So a proof is needed only for a sign change below a stable beginning.
//! A function of the caller, the judge, decides these cases ([`Ensemble::run_judged`]). `equilibrium` of the crate
//! `cannonpile-horizontal` decides them with a proof.

mod choice;
mod continuations;
mod count;
mod distribution;
mod draw;
mod force_kind;
mod layer;
mod merge;
mod order;
mod record;
mod run;
mod setup;
mod sums;
mod tally;
mod verdicts;
mod walk;
mod wilson;
mod written;

pub use choice::{Choice, Samples, Shard};
use core::ops::Range;
pub use distribution::{Distribution, Extreme, Histogram};
pub use force_kind::ForceKind;
pub use merge::Unmergeable;
pub use record::TallyRecord;
pub use tally::{ContactSet, Tally, WithFaults};

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use run::Run;
use setup::Task;
use verdicts::Judge;

use crate::RandomStackings;
use crate::{Each, Error};
use cannonpile::Pile;
use cannonpile::formula;
use cannonpile::lattice::{Region, Site};
use cannonpile::scalar::{ByValue, reduced};
use cannonpile::shape::Anchor;
use cannonpile::stacking::Stacking;

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
#[serde(try_from = "written::EnsembleParts", into = "written::EnsembleParts")]
pub struct Ensemble {
    /// The top layer or the base, as a pile of one layer.
    layer: Pile,
    stackings: RandomStackings,
    has_horizontal_contacts: bool,
    bins: BigRational,
}

cannonpile::engine::equality!(Ensemble; |x| (&x.layer, &x.stackings, x.has_horizontal_contacts, ByValue(&x.bins)));

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
    /// says [how many](Tally::left_out) there are.
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

    /// Counts the forces of all stackings or samples of a shard.
    ///
    /// # Errors
    /// * [`Error::TooManyStackings`] for a shard of more than 2²⁴ enumerated stackings.
    /// * [`TooLarge`](cannonpile::Error::TooLarge) for layers that do not fit in memory, for more than 10⁵ bins, and
    ///   for more than 2⁶² contact forces.
    /// * [`Error::NoJudge`] with horizontal contacts.
    /// * [`Error::NoStacking`] for a base that supports no stacking of this height.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Samples, Shard, Tally};
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let stackings = RandomStackings::new(9, FirstSign::Random)?;
    /// let ensemble = Ensemble::under(Region::SITE, stackings)?;
    /// let half = BigRational::new(1.into(), 2.into());
    /// let drawn = Choice::Drawn(Samples::new(100, 1, half)?);
    /// let whole = ensemble.run(&drawn, Shard::WHOLE)?;
    /// // The shards can run on different machines.
    /// let parts: Result<Vec<_>, _> = (1..=3).map(|part| ensemble.run(&drawn, Shard::new(part, 3)?)).collect();
    /// assert_eq!(Tally::merge(&parts?), Ok(whole));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn run(&self, choice: &Choice, shard: Shard) -> Result<Tally, Error> {
        self.run_observed(choice, shard, &|_| {})
    }

    /// Returns the result of [`run`](Self::run), and reports its progress. Each call of the observer receives the
    /// number of stackings that were computed since the last call.
    ///
    /// # Errors
    /// As for [`run`](Self::run).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    /// use std::sync::atomic::{AtomicU64, Ordering};
    ///
    /// let stackings = RandomStackings::new(9, FirstSign::Plus)?;
    /// let ensemble = Ensemble::under(Region::SITE, stackings)?;
    /// let done = AtomicU64::new(0);
    /// let count = |more| { done.fetch_add(more, Ordering::Relaxed); };
    /// ensemble.run_observed(&Choice::All, Shard::WHOLE, &count)?;
    /// assert_eq!(done.into_inner(), 128);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn run_observed(
        &self,
        choice: &Choice,
        shard: Shard,
        observer: &(dyn Fn(u64) + Sync),
    ) -> Result<Tally, Error> {
        self.run_with(choice, shard, observer, None)
    }

    /// Returns the result of [`run_observed`](Self::run_observed) for an ensemble that also counts the stackings that
    /// are stable with horizontal contacts. The judge decides whether a pile is.
    ///
    /// The run calls the judge only for piles that are unstable without horizontal contacts. Each of them ends with a
    /// sign change, and is stable without its last layer. The judge may be called from several threads at once, and
    /// must return the same verdict for the same pile. It is not called for an ensemble that does not count these
    /// stackings.
    ///
    /// # Errors
    /// As for [`run`](Self::run), and those of the judge. If the judge fails several times, one of its errors is returned.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{ContactSet, Choice, Ensemble, Error, FirstSign, RandomStackings, Shard};
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(7, FirstSign::Plus)?;
    /// let touching = Ensemble::under(Region::SITE, stackings)?.with_horizontal_contacts()?;
    /// // HCP of five layers, continued straight, is stable only with horizontal contacts. For any pile the crate
    /// // `cannonpile-horizontal` decides it with a proof: `Ok(equilibrium(pile)?.claim == Claim::Stands)`.
    /// let judge = |pile: &Pile| Ok::<_, Error>(pile.shape().stacking().to_string() == "+-+-+");
    /// let tally = touching.run_judged(&Choice::All, Shard::WHOLE, &|_| {}, &judge)?;
    /// assert_eq!(tally.standing(ContactSet::Sloping), Some(11_u32.into()));
    /// assert_eq!(tally.standing(ContactSet::WithHorizontal), Some(12_u32.into()));
    ///
    /// // There is no default for the judge.
    /// assert_eq!(touching.run(&Choice::All, Shard::WHOLE), Err(Error::NoJudge));
    /// # Ok::<(), Error>(())
    /// ```
    pub fn run_judged<E: From<Error> + Send>(
        &self,
        choice: &Choice,
        shard: Shard,
        observer: &(dyn Fn(u64) + Sync),
        judge: &(dyn Fn(&Pile) -> Result<bool, E> + Sync),
    ) -> Result<Tally, E> {
        self.run_with(choice, shard, observer, Some(judge))
    }

    fn run_with<E: From<Error> + Send>(
        &self,
        choice: &Choice,
        shard: Shard,
        observer: &(dyn Fn(u64) + Sync),
        judge: Option<&Judge<'_, E>>,
    ) -> Result<Tally, E> {
        Run {
            ensemble: self,
            choice,
            shard,
            task: &Task::new(self, choice, shard)?,
            observer,
            judge,
        }
        .tally()
    }

    /// Returns the number of stackings or samples of a shard. Two mirror images with the same forces count as one. On a
    /// base the number includes the stackings that are left out.
    ///
    /// # Errors
    /// As for [`run`](Self::run), except [`Error::NoJudge`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(9, FirstSign::Random)?;
    /// let ensemble = Ensemble::under(Region::SITE, stackings)?;
    /// assert_eq!(ensemble.size(&Choice::All, Shard::new(1, 4)?)?, 32);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn size(&self, choice: &Choice, shard: Shard) -> Result<u64, Error> {
        let Range { start, end } = Task::new(self, choice, shard)?.range;
        Ok(end - start)
    }

    /// Returns the sites of the top layer, or of the base.
    fn region(&self) -> Region {
        self.layer.shape().base()
    }

    /// Returns the weight of a sphere without a load, in mg: 0 or 1.
    fn weight(&self) -> BigRational {
        if self.layer.is_weightless() {
            BigRational::zero()
        } else {
            BigRational::one()
        }
    }

    /// Returns the force that each sphere of the top layer adds to each of its contacts, in row order.
    fn own_of_top(&self, increment: &BigRational) -> Result<Vec<BigRational>, Error> {
        let weight = self.weight();
        let own = |site| -> Result<_, Error> {
            let total = weight.clone() + self.layer.load(site)?.down;
            Ok(formula::force(total, increment))
        };
        self.layer.shape().sites().map(own).collect()
    }

    /// Returns whether the top layer with its loads, or the base, is its own mirror image. Then mirror images of stackings
    /// have the same forces.
    fn is_its_own_mirror_image(&self) -> bool {
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
