//! How the forces of some piles are distributed: in all, by bins, and at their extremes.

use core::cmp::Ordering;

use cannonpile::stacking::Stacking;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::Zero;

use super::count::{self, Bins, Counted, Ends};
use super::layer::Numerator;
use super::setup::Setup;
use crate::Error;

/// The forces of some piles: in all, by bins, and at their extremes. Contact forces are in f₀ = mg/(3cosθ), normal forces
/// of bottom spheres in mg.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
/// use cannonpile::lattice::Region;
///
/// let stackings = RandomStackings::new(3, FirstSign::Plus)?;
/// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
/// let hcp = &tally.faults[1].all;
/// // Three of 1, and of each of three spheres 1 + 2/3, 1 + 2/3, 1 − 1/3.
/// assert_eq!((hcp.contacts.to_string(), hcp.sum.to_string()), ("12".into(), "15".into()));
/// assert_eq!(hcp.least.as_ref().unwrap().force.to_string(), "2/3");
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Distribution {
    /// How many piles they are.
    #[serde(with = "cannonpile::data::number")]
    pub stackings: BigUint,
    /// How many contacts these have between spheres.
    #[serde(with = "cannonpile::data::number")]
    pub contacts: BigUint,
    /// Σf over all these contacts.
    #[serde(with = "cannonpile::data::number")]
    pub sum: BigRational,
    /// Σf².
    #[serde(with = "cannonpile::data::number")]
    pub sum_of_squares: BigRational,
    /// How many contacts there are by their force.
    pub forces: Histogram,
    /// The least contact force.
    pub least: Option<Extreme>,
    /// The greatest.
    pub greatest: Option<Extreme>,
    /// How many bottom spheres there are by their normal force.
    pub normals: Histogram,
    /// The least normal force.
    pub least_normal: Option<Extreme>,
    /// The greatest.
    pub greatest_normal: Option<Extreme>,
}

/// How many numbers x lie in which bin, ⌊x/w⌋ with w the [width](super::Ensemble::bins).
///
/// # Examples
/// ```
/// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
/// use cannonpile::lattice::Region;
///
/// let stackings = RandomStackings::new(4, FirstSign::Plus)?;
/// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
/// // 18 contacts of f₀, 9 of 2 f₀, 3 of 3 f₀; bins are f₀/3 wide.
/// let straight = &tally.faults[0].all.forces;
/// assert_eq!((straight.first, straight.total()), (3, 30_u32.into()));
/// assert_eq!(straight.counts.iter().map(|n| n.to_string()).collect::<Vec<_>>().join(" "), "18 0 0 9 0 0 3");
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Histogram {
    /// The bin of the first count.
    pub first: i64,
    /// The counts, bin after bin; the first and the last are not 0.
    #[serde(with = "cannonpile::data::number")]
    pub counts: Vec<BigUint>,
}

/// A force that no other is less, or greater, than, and the first stacking that has it, in the order of signs from the top, +
/// before −.
///
/// # Examples
/// See [`Distribution`].
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Extreme {
    /// The force, in f₀, or in mg on the floor.
    #[serde(with = "cannonpile::data::number")]
    pub force: BigRational,
    /// The stacking.
    pub stacking: Stacking,
}

impl Histogram {
    /// Returns how many numbers there are in all bins.
    ///
    /// # Examples
    /// See [`Histogram`].
    #[must_use]
    pub fn total(&self) -> BigUint {
        self.counts.iter().sum()
    }

    /// Returns the count of a bin, 0 beyond the first and the last. A bin may lie beyond `i64`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::Histogram;
    ///
    /// assert_eq!(Histogram::default().count(7), 0_u32.into());
    /// ```
    #[must_use]
    pub fn count(&self, bin: impl Into<i128>) -> BigUint {
        let place = bin.into().checked_sub(self.first.into());
        let place = place.and_then(|place| usize::try_from(place).ok());
        let count = place.and_then(|place| self.counts.get(place));
        // Not a default: beyond the ends nothing was counted.
        count.cloned().unwrap_or_default()
    }

    fn of(bins: &Bins, factor: u32) -> Self {
        let counts = bins.counts.iter();
        let counts = counts.map(|count| BigUint::from(*count) * factor).collect();
        Self {
            first: bins.first,
            counts,
        }
    }

    fn add(&mut self, other: &Self) {
        if other.counts.is_empty() {
            return;
        }
        if self.counts.is_empty() {
            self.clone_from(other);
            return;
        }
        let end = |of: &Self| i128::from(of.first) + of.counts.len() as i128;
        let first = self.first.min(other.first);
        let last = end(self).max(end(other));
        let bins = i128::from(first)..last;
        // Both are within, and what lies between is no longer than what the two were read or counted from.
        let bins = bins.filter_map(|bin| i64::try_from(bin).ok());
        let counts = bins.map(|bin| self.count(bin) + other.count(bin)).collect();
        *self = Self { first, counts };
    }
}

impl Distribution {
    pub(super) fn of<T: Numerator>(
        counted: &Counted<T>,
        setup: &Setup<T>,
        faults: usize,
    ) -> Result<Self, Error> {
        let factor = setup.order.factor;
        let denominator = setup.power(faults)?.clone().into() * &setup.scale;
        let extremes = |ends: &Ends<T>, denominator: &BigInt| -> Result<_, Error> {
            let extreme = |extreme: &Option<count::Extreme<T>>| {
                let found = extreme
                    .as_ref()
                    .map(|found| Extreme::of(found, denominator));
                found.transpose()
            };
            Ok((extreme(&ends.least)?, extreme(&ends.greatest)?))
        };
        let forces = &counted.forces;
        let (least, greatest) = extremes(&forces.ends, &denominator)?;
        let thirds = denominator * 3_u32;
        let (least_normal, greatest_normal) = extremes(&counted.normal_ends, &thirds)?;
        let times = BigInt::from(factor);
        Ok(Self {
            stackings: BigUint::from(counted.stackings) * factor,
            contacts: BigUint::from(forces.spheres) * (3 * factor),
            sum: setup.sums.sum(forces.layers, &forces.levels) * &times,
            sum_of_squares: setup.sums.squares(forces.layers, &forces.levels) * &times,
            forces: Histogram::of(&forces.bins, factor),
            least,
            greatest,
            normals: Histogram::of(&counted.normals, factor),
            least_normal,
            greatest_normal,
        })
    }

    pub(super) fn nothing() -> Self {
        Self {
            stackings: BigUint::zero(),
            contacts: BigUint::zero(),
            sum: BigRational::zero(),
            sum_of_squares: BigRational::zero(),
            forces: Histogram::default(),
            least: None,
            greatest: None,
            normals: Histogram::default(),
            least_normal: None,
            greatest_normal: None,
        }
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.stackings += &other.stackings;
        self.contacts += &other.contacts;
        self.sum += &other.sum;
        self.sum_of_squares += &other.sum_of_squares;
        self.forces.add(&other.forces);
        self.normals.add(&other.normals);
        let pairs = [
            (&mut self.least, &other.least, Ordering::Less),
            (&mut self.greatest, &other.greatest, Ordering::Greater),
            (&mut self.least_normal, &other.least_normal, Ordering::Less),
            (
                &mut self.greatest_normal,
                &other.greatest_normal,
                Ordering::Greater,
            ),
        ];
        for (ours, theirs, better) in pairs {
            let replaces = match (&*ours, theirs) {
                (_, None) => false,
                (None, Some(_)) => true,
                (Some(ours), Some(theirs)) => match theirs.force.cmp(&ours.force) {
                    Ordering::Equal => theirs.stacking.signs().lt(ours.stacking.signs()),
                    order => order == better,
                },
            };
            if replaces {
                ours.clone_from(theirs);
            }
        }
    }
}

impl Extreme {
    fn of<T: Numerator>(found: &count::Extreme<T>, denominator: &BigInt) -> Result<Self, Error> {
        let force = BigRational::new(found.value.clone().into(), denominator.clone());
        let stacking = Stacking::from_signs(found.signs.iter().copied())?;
        Ok(Self { force, stacking })
    }
}
