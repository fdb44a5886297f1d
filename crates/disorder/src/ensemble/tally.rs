//! The result of a run, in exact numbers.

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use cannonpile::shape::Anchor;

use super::count::Counted;
use super::distribution::Distribution;
use super::layer::Numerator;
use super::setup::Setup;
use super::{Choice, Ensemble, Shard};
use crate::Error;
use crate::check_fault_probability;
use crate::error::bug;

/// The result of a run over an ensemble or one shard. It contains exact numbers only, so it does not depend on the
/// division of the work.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
/// use cannonpile::lattice::Region;
///
/// let stackings = RandomStackings::new(6, FirstSign::Plus)?;
/// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
/// // Six layers under one sphere: the straight pile stands, three stackings with one fault stand, and so on.
/// let standing = tally.faults.iter().map(|with| with.standing.stackings.to_string());
/// assert_eq!(standing.collect::<Vec<_>>(), ["1", "3", "4", "3", "0"]);
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Tally {
    /// The ensemble.
    pub ensemble: Ensemble,
    /// The selected stackings.
    pub choice: Choice,
    /// The shard.
    pub shard: Shard,
    /// The counts by the number d of faults, from d = 0 to the greatest possible number.
    pub faults: Vec<WithFaults>,
}

/// The counts of the stackings with one number of faults.
///
/// # Examples
/// See [`Tally`].
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct WithFaults {
    /// The number d of sign changes.
    pub faults: u32,
    /// The number of stackings that the base does not support. All other counts leave them out. `None` for an ensemble
    /// under a top layer.
    #[serde(
        with = "cannonpile::data::number",
        default,
        skip_serializing_if = "Option::is_none"
    )]
    pub left_out: Option<BigUint>,
    /// All these stackings. The unstable ones need a prestressed pile.
    pub all: Distribution,
    /// The standing stackings: no contact is in tension.
    pub standing: Distribution,
    /// The number of stackings that are stable with horizontal contacts, at a = R. `None` if the run did not count
    /// them.
    #[serde(with = "cannonpile::data::number")]
    pub held: Option<BigUint>,
}

impl WithFaults {
    pub(super) fn of<T: Numerator>(
        [all, standing]: [&Counted<T>; 2],
        held: Option<u64>,
        setup: &Setup<T>,
        faults: usize,
    ) -> Result<Self, Error> {
        Ok(Self {
            faults: u32::try_from(faults).map_err(|_| bug("layers that fit in memory are few"))?,
            left_out: None,
            all: Distribution::of(all, setup, faults)?,
            standing: Distribution::of(standing, setup, faults)?,
            held: held.map(|held| BigUint::from(held) * setup.factor),
        })
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.all.add(&other.all);
        self.standing.add(&other.standing);
        let optional = [
            (&mut self.held, &other.held),
            (&mut self.left_out, &other.left_out),
        ];
        for counts in optional {
            if let (Some(ours), Some(theirs)) = counts {
                *ours += theirs;
            }
        }
    }
}

/// The contacts that can make a pile stable.
///
/// # Examples
/// See [`Tally::standing`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ContactSet {
    /// The sloping contacts α, β and γ only.
    Sloping,
    /// Sloping and horizontal contacts, at a = R.
    WithHorizontal,
}

impl Tally {
    /// Returns a tally without any stacking.
    pub(super) fn nothing(ensemble: Ensemble, choice: Choice, shard: Shard) -> Result<Self, Error> {
        let most = ensemble.stackings().most_faults();
        let most = u32::try_from(most).map_err(|_| bug("layers that fit in memory are few"))?;
        let has_held = ensemble.has_horizontal_contacts();
        let on_base = matches!(ensemble.anchor(), Anchor::Base(_));
        let faults = (0..=most).map(|faults| WithFaults {
            faults,
            left_out: on_base.then(BigUint::zero),
            all: Distribution::default(),
            standing: Distribution::default(),
            held: has_held.then(BigUint::zero),
        });
        Ok(Self {
            ensemble,
            choice,
            shard,
            faults: faults.collect(),
        })
    }

    /// Returns the number of stackings. Repeated samples count repeatedly. On a base it is the number of stackings that the
    /// base supports.
    ///
    /// # Examples
    /// See [`standing`](Self::standing).
    #[must_use]
    pub fn stackings(&self) -> BigUint {
        self.faults.iter().map(|with| &with.all.stackings).sum()
    }

    /// Returns the number of stackings that the base does not support. `None` for an ensemble under a top layer.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(4, FirstSign::Plus)?;
    /// let tally = Ensemble::on(Region::hexagon(3, 2)?, stackings)?.run(&Choice::All, Shard::WHOLE)?;
    /// // Four layers on this base need two + steps and a − step: ++- and +-+ fit, +++ and +-- do not.
    /// assert_eq!((tally.stackings(), tally.left_out()), (2_u32.into(), Some(2_u32.into())));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn left_out(&self) -> Option<BigUint> {
        self.faults.iter().map(|with| with.left_out.clone()).sum()
    }

    /// Returns the number of standing stackings. `None` with horizontal contacts, if the run did not count them.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{ContactSet, Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(8, FirstSign::Random)?;
    /// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
    /// assert_eq!(tally.stackings(), 128_u32.into());
    /// // Eleven stackings and their mirror images.
    /// assert_eq!(tally.standing(ContactSet::Sloping), Some(22_u32.into()));
    /// assert_eq!(tally.standing(ContactSet::WithHorizontal), None);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn standing(&self, by: ContactSet) -> Option<BigUint> {
        self.faults.iter().map(|with| with.standing_count(by)).sum()
    }

    /// Returns the weight of each stacking in a mean, by number of faults. `None` unless the shard is the whole.
    ///
    /// For all stackings the weight is the probability of a stacking with d faults: q^d (1−q)^(n−1−d) with n steps, and
    /// half of it for a random first sign. For samples the weight is one over their number, for every `q`.
    ///
    /// On a base the mean is over the stackings that the base supports. So these weights are divided by their sum over those
    /// stackings, or by their number among the samples. `None` also if the sum is 0.
    ///
    /// For example, the mean number of contacts of one pile in a bin is the sum over d of the weight times the count.
    ///
    /// # Errors
    /// [`Error::FaultProbability`] unless 0 ≤ `q` ≤ 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let stackings = RandomStackings::new(4, FirstSign::Plus)?;
    /// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
    /// let weights = tally.weights(&BigRational::new(1.into(), 3.into()))?.unwrap();
    /// assert_eq!(weights.iter().map(|w| w.to_string()).collect::<Vec<_>>(), ["4/9", "2/9", "1/9"]);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn weights(&self, q: &BigRational) -> Result<Option<Vec<BigRational>>, Error> {
        check_fault_probability(q)?;
        if self.shard != Shard::WHOLE {
            return Ok(None);
        }
        let most = self.faults.len().saturating_sub(1);
        let stay = BigRational::one() - q;
        let weight = |d: usize| match &self.choice {
            Choice::Drawn(_) => BigRational::one(),
            Choice::All => pow(q.clone(), d) * pow(stay.clone(), most - d),
        };
        let weights: Vec<_> = (0..self.faults.len()).map(weight).collect();
        // Under a top layer the sum is the number of first signs, or the number of samples.
        let terms = weights.iter().zip(&self.faults);
        let terms = terms.map(|(weight, with)| weight * BigInt::from(with.all.stackings.clone()));
        let sum: BigRational = terms.sum();
        let is_defined = !sum.is_zero();
        Ok(is_defined.then(|| weights.into_iter().map(|weight| weight / &sum).collect()))
    }

    /// Returns the probability that a random stacking stands, at the fault probability `q`. The result is `None` for
    /// samples, for a shard that is not the whole, and with horizontal contacts if the run did not count them.
    ///
    /// The value is exact: Σ_d c_d q^d (1−q)^(n−1−d), and half of it for a random first sign. Here c_d is the number of
    /// standing stackings with d faults, and n is the number of steps.
    ///
    /// On a base it is the probability that a stacking stands, given that the base supports it. So the sum is divided by the
    /// same sum over the supported stackings. The result is `None` if that sum is 0.
    ///
    /// # Errors
    /// [`Error::FaultProbability`] unless 0 ≤ `q` ≤ 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{ContactSet, Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let stackings = RandomStackings::new(6, FirstSign::Random)?;
    /// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
    /// let probability = |q: (i32, i32)| {
    ///     let q = BigRational::new(q.0.into(), q.1.into());
    ///     Ok::<_, cannonpile_disorder::Error>(tally.standing_probability(ContactSet::Sloping, &q)?.unwrap().to_string())
    /// };
    /// // RHCP: 11 of 16 stand. FCC stands. HCP does not.
    /// assert_eq!([probability((1, 2))?, probability((0, 1))?, probability((1, 1))?], ["11/16", "1", "0"]);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn standing_probability(
        &self,
        by: ContactSet,
        q: &BigRational,
    ) -> Result<Option<BigRational>, Error> {
        let Some(weights) = self.weights(q)?.filter(|_| self.choice == Choice::All) else {
            return Ok(None);
        };
        let terms = self.faults.iter().zip(weights);
        let terms =
            terms.map(|(with, weight)| Some(weight * BigInt::from(with.standing_count(by)?)));
        Ok(terms.sum())
    }
}

impl WithFaults {
    /// Returns the number of standing stackings. `None` with horizontal contacts, if the run did not count them.
    ///
    /// # Examples
    /// See [`Tally::standing`].
    #[must_use]
    pub fn standing_count(&self, by: ContactSet) -> Option<BigUint> {
        match by {
            ContactSet::Sloping => Some(self.standing.stackings.clone()),
            ContactSet::WithHorizontal => self.held.clone(),
        }
    }
}
