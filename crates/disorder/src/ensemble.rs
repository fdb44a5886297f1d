//! What is not linear in the stackings: how many stand, the least force, the distribution of forces. By going through all
//! of them, or through samples.
//!
//! Means over random stackings obey one recursion. Whether a pile stands, its least force, and how its forces are
//! distributed do not: every stacking has to be looked at. An [`Ensemble`] is one top layer with every stacking below
//! it; a [`Choice`] says whether all are taken or some are drawn, a [`Shard`] which part of them. What is counted is a
//! [`Tally`]: exact integers and rationals, by number of faults, so that any fault probability can be put in afterwards, and
//! that the tallies of parts [merge](Tally::merge) into that of the whole, bit for bit, however it was cut up and in whatever order
//! they come.
//!
//! # What is counted of which piles
//! *All* includes stackings of which some contact would have to pull: its forces are those of a prestressed pile, whose contacts
//! can. *Standing* are those of which none pulls, those that a pile of loose spheres can have.
//!
//! # Why it is exact
//! A force below a layer is an integer over 3^d times the common denominator of the loads, with d changes of sign above it.
//! The sum of the squares of all forces of a layer depends on the weights only (each force arrives at one sphere, and
//! the half-turn is orthogonal), so that no force exceeds its root: this bound, computed beforehand, decides whether 64 bits
//! suffice, or 128, or none do and big integers are taken.
//!
//! # Why it is fast
//! Stackings that begin alike have the same forces down to where they part. All of n steps are walked as the tree that they
//! are, which has at most 2ⁿ⁺¹ layers where the stackings have n 2ⁿ. If the top layer with its loads is its own mirror image, one
//! of each mirror pair is walked.
//!
//! # With horizontal contacts
//! At a = R also stackings of which some contacts pull may stand. The beginnings of what stands stand, and what
//! stands does so with its last step repeated; so only changes of sign below what stands so far need
//! a proof. The caller's judge decides those ([`Ensemble::run_judged`]); `equilibrium` of the crate
//! `cannonpile-horizontal` decides with a proof.

mod binned;
mod choice;
mod continuations;
mod count;
mod distribution;
mod draw;
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

pub use binned::Binned;
pub use choice::{Choice, Samples, Shard};
use core::ops::Range;
pub use distribution::{Distribution, Extreme, Histogram};
pub use merge::Unmergeable;
pub use record::TallyRecord;
pub use tally::{By, Tally, WithFaults};

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use run::Run;
use setup::Task;
use verdicts::Judge;

use crate::Error;
use crate::RandomStackings;
use cannonpile::Pile;
use cannonpile::formula;
use cannonpile::lattice::{Region, Site};
use cannonpile::stacking::Stacking;

/// Every stacking below one top layer.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{By, Choice, Ensemble, FirstSign, RandomStackings, Shard};
/// use cannonpile::lattice::Region;
///
/// let stackings = RandomStackings::new(5, FirstSign::Plus)?;
/// let ensemble = Ensemble::under(Region::hexagon(2, 2)?, stackings)?;
/// let tally = ensemble.run(&Choice::All, Shard::WHOLE)?;
/// assert_eq!(tally.standing(By::Sloping), Some(6_u32.into()));
/// let least = tally.faults[3].all.least.as_ref().unwrap();
/// assert_eq!((least.stacking.to_string(), least.force.to_string()), ("+-+-".into(), "-2/27".into()));
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(try_from = "written::EnsembleParts", into = "written::EnsembleParts")]
pub struct Ensemble {
    /// The top layer, as a pile of its own.
    top: Pile,
    stackings: RandomStackings,
    has_horizontal_contacts: bool,
    bins: BigRational,
}

impl Ensemble {
    /// Returns the ensemble of these stackings under a top layer, with bins of a third.
    ///
    /// # Errors
    /// Those of [`Pile::under`].
    ///
    /// # Examples
    /// See [`Ensemble`].
    pub fn under(top: Region, stackings: RandomStackings) -> Result<Self, Error> {
        Ok(Self {
            top: Pile::under(top, Stacking::single_layer())?,
            stackings,
            has_horizontal_contacts: false,
            bins: BigRational::new(1.into(), 3.into()),
        })
    }

    /// Returns the ensemble with one more vertical load on a sphere (i, j) of the top layer, in mg. What lies below is another
    /// sphere in another stacking, and bears none.
    ///
    /// # Errors
    /// [`SiteOutside`](cannonpile::Error::SiteOutside); [`NegativeLoad`](cannonpile::Error::NegativeLoad).
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
        self.top = self.top.with_load(Site { i, j, k: 0 }, load)?;
        Ok(self)
    }

    /// Returns the ensemble with spheres that weigh nothing: the response to the loads. A pile then counts as standing if none of
    /// its contacts pulls.
    ///
    /// # Examples
    /// See [`with_load`](Self::with_load).
    #[must_use]
    pub fn weightless(mut self) -> Self {
        self.top = self.top.weightless();
        self
    }

    /// Returns the ensemble that also counts the stackings that stand at a = R, with horizontal contacts.
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
        if self.top.is_weightless() {
            return Err(Error::Weightless);
        }
        self.has_horizontal_contacts = true;
        Ok(self)
    }

    /// Returns the ensemble with bins of this width: in f₀ of contact forces, in mg of normal forces.
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
    /// assert_eq!(ensemble.bins().to_string(), "1/3");
    /// assert!(ensemble.clone().with_bins(BigRational::new(1.into(), 10.into())).is_ok());
    /// assert!(ensemble.with_bins(BigRational::from_integer(0.into())).is_err());
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn with_bins(mut self, width: BigRational) -> Result<Self, Error> {
        if !width.is_positive() {
            let expected = "a width of bins: a positive number";
            return Err(Error::syntax(&width.to_string(), expected));
        }
        self.bins = width;
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

    /// Returns the top layer, as a pile of one layer: its spheres, their loads, and whether spheres weigh nothing.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Ensemble, FirstSign, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(7, FirstSign::Plus)?;
    /// let ensemble = Ensemble::under(Region::hexagon(2, 2)?, stackings)?;
    /// assert_eq!(ensemble.top().sphere_count(), 7_u32.into());
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub const fn top(&self) -> &Pile {
        &self.top
    }

    /// Returns the width of the bins, in f₀ of contact forces, in mg of normal forces.
    ///
    /// # Examples
    /// See [`with_bins`](Self::with_bins).
    #[must_use]
    pub const fn bins(&self) -> &BigRational {
        &self.bins
    }

    /// Returns whether it is also counted how many stand with horizontal contacts.
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

    /// Returns the pile of one stacking, of as many layers as that has.
    ///
    /// # Errors
    /// Those of [`Pile::under`].
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
        let mut pile = Pile::under(self.region(), stacking)?;
        for (site, load) in self.top.loads() {
            pile = pile.with_load(site, load.clone())?;
        }
        Ok(if self.top.is_weightless() {
            pile.weightless()
        } else {
            pile
        })
    }

    /// Returns what is counted of a part of all stackings, or of samples.
    ///
    /// # Errors
    /// [`Error::TooManyStackings`] for a part of more than 2²⁴ of all; [`TooLarge`](cannonpile::Error::TooLarge) for layers
    /// that do not fit in memory, for more than 10⁵ bins, and for more than 2⁶² contact forces; [`Error::NoJudge`] with
    /// horizontal contacts.
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
    /// // In parts, on as many machines.
    /// let parts: Result<Vec<_>, _> = (1..=3).map(|part| ensemble.run(&drawn, Shard::new(part, 3)?)).collect();
    /// assert_eq!(Tally::merge(&parts?), Ok(whole));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn run(&self, choice: &Choice, shard: Shard) -> Result<Tally, Error> {
        self.run_observed(choice, shard, &|_| {})
    }

    /// Returns what [`run`](Self::run) does; the observer is called from time to time with how many stackings more have been
    /// looked at.
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
    /// stand with horizontal contacts. The judge decides whether a pile does.
    ///
    /// The run calls the judge only for piles that do not stand without horizontal contacts. Each of them ends with a
    /// sign change, and all its layers but the last stand. The judge may be called from several threads at once, and
    /// it must return the same verdict for the same pile. It is not called for an ensemble that does not count these
    /// stackings.
    ///
    /// # Errors
    /// As for [`run`](Self::run), and those of the judge. If the judge fails several times, one of its errors is returned.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{By, Choice, Ensemble, Error, FirstSign, RandomStackings, Shard};
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(7, FirstSign::Plus)?;
    /// let touching = Ensemble::under(Region::SITE, stackings)?.with_horizontal_contacts()?;
    /// // Five layers of HCP, straight from there on, stand only with horizontal contacts. For any pile the crate
    /// // `cannonpile-horizontal` decides it with a proof: `Ok(equilibrium(pile)?.claim == Claim::Stands)`.
    /// let judge = |pile: &Pile| Ok::<_, Error>(pile.shape().stacking().to_string() == "+-+-+");
    /// let tally = touching.run_judged(&Choice::All, Shard::WHOLE, &|_| {}, &judge)?;
    /// assert_eq!(tally.standing(By::Sloping), Some(11_u32.into()));
    /// assert_eq!(tally.standing(By::Horizontal), Some(12_u32.into()));
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

    /// Returns how many stackings, or samples, a part has: those that are looked at; of two mirror images that have the same forces
    /// one is.
    ///
    /// # Errors
    /// As for [`run`](Self::run), of what is too much.
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

    /// The sites of the top layer.
    fn region(&self) -> Region {
        self.top.shape().base()
    }

    /// What a sphere without a load weighs, in mg: 0 or 1.
    fn weight(&self) -> BigRational {
        if self.top.is_weightless() {
            BigRational::zero()
        } else {
            BigRational::one()
        }
    }

    /// What the spheres of the top layer add to each of their lines, in row order.
    fn own_of_top(&self, increment: &BigRational) -> Result<Vec<BigRational>, Error> {
        let weight = self.weight();
        let own = |site| -> Result<_, Error> {
            let total = weight.clone() + self.top.load(site)?;
            Ok(formula::force(total, increment))
        };
        self.top.shape().sites().map(own).collect()
    }

    /// Whether the top layer with its loads is its own mirror image, so that stackings that are mirror images of each other have
    /// the same forces.
    fn is_its_own_mirror_image(&self) -> bool {
        let region = self.region();
        let [sum_of_i, sum_of_j] =
            [region.x(), region.y()].map(|range| range.start() + range.end());
        let image = |site: Site| Site {
            i: sum_of_i - site.i,
            j: sum_of_j - site.j,
            ..site
        };
        let has_same =
            |(site, load): (Site, &BigRational)| self.top.load(image(site)).as_ref() == Ok(load);
        region.is_its_own_mirror_image() && self.top.loads().all(has_same)
    }
}
