//! Distributions of forces: totals, histograms and extremes.

use core::cmp::Ordering;

use cannonpile::scalar::ByValue;
use cannonpile::stacking::Stacking;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;

use super::count::{self, Bins, Counted, Ends};
use super::layer::Numerator;
use super::setup::Setup;
use crate::Error;

/// The distribution of forces in some piles: totals, histograms and extremes. Contact forces are in f₀ = mg/(3cosθ),
/// and normal forces on the floor are in mg.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
/// use cannonpile::lattice::Region;
///
/// let stackings = RandomStackings::new(3, FirstSign::Plus)?;
/// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
/// let hcp = &tally.faults[1].all;
/// // Three forces of 1 below the apex. Each sphere of the second layer has forces of 1 + 2/3, 1 + 2/3 and 1 − 1/3.
/// assert_eq!((hcp.contacts.to_string(), hcp.sum.to_string()), ("12".into(), "15".into()));
/// assert_eq!(hcp.least.as_ref().unwrap().force.to_string(), "2/3");
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, Default, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Distribution {
    /// The number of piles.
    #[serde(with = "cannonpile::data::number")]
    pub stackings: BigUint,
    /// The number of contacts between spheres, in all these piles.
    #[serde(with = "cannonpile::data::number")]
    pub contacts: BigUint,
    /// The sum of the forces of all these contacts.
    #[serde(with = "cannonpile::data::number")]
    pub sum: BigRational,
    /// The sum of the squares of these forces.
    #[serde(with = "cannonpile::data::number")]
    pub sum_of_squares: BigRational,
    /// The histogram of the contact forces.
    pub forces: Histogram,
    /// The least contact force.
    pub least: Option<Extreme>,
    /// The greatest contact force.
    pub greatest: Option<Extreme>,
    /// The histogram of the normal forces of bottom spheres.
    pub normals: Histogram,
    /// The least normal force.
    pub least_normal: Option<Extreme>,
    /// The greatest normal force.
    pub greatest_normal: Option<Extreme>,
}

cannonpile::engine::equality!(Distribution);

/// A histogram. The bin of a number x is ⌊x/w⌋, with w the [width](super::Ensemble::bin_width) of the bins.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard};
/// use cannonpile::lattice::Region;
///
/// let stackings = RandomStackings::new(4, FirstSign::Plus)?;
/// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
/// // 18 contacts of f₀, 9 of 2 f₀, 3 of 3 f₀. The bins have the width f₀/3.
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
    /// The counts of consecutive bins. The first and the last count are not 0.
    #[serde(with = "cannonpile::data::number")]
    pub counts: Vec<BigUint>,
}

/// The least or the greatest force, and the first stacking in which it occurs. Stackings are sorted by their signs from
/// the top, with + before −.
///
/// # Examples
/// See [`Distribution`].
#[derive(Clone, Debug, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct Extreme {
    /// The force: a contact force in f₀, or a normal force in mg.
    #[serde(with = "cannonpile::data::number")]
    pub force: BigRational,
    /// The stacking.
    pub stacking: Stacking,
}

cannonpile::engine::equality!(Extreme; |Self { force, stacking }| (ByValue(force), stacking));

impl Histogram {
    /// Returns the total count of all bins.
    ///
    /// # Examples
    /// See [`Histogram`].
    #[must_use]
    pub fn total(&self) -> BigUint {
        self.counts.iter().sum()
    }

    /// Returns the count of a bin. It is 0 outside of the stored range.
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
        // Bins outside of the stored range have the count 0.
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
        // Both histograms were read or counted as lists, so their common range fits in memory. All its bins fit in
        // `i64`.
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
        let factor = setup.factor;
        let times = BigInt::from(factor);
        let denominator = setup.units(faults)?.power.clone().into() * &setup.scale;
        let [least, greatest] = Extreme::of_ends(&counted.ends, &denominator)?;
        let thirds = denominator * 3_u32;
        let [least_normal, greatest_normal] = Extreme::of_ends(&counted.normal_ends, &thirds)?;
        Ok(Self {
            stackings: BigUint::from(counted.stackings) * factor,
            contacts: BigUint::from(counted.level.spheres) * (3 * factor),
            sum: setup.sums.sum(&counted.level) * &times,
            sum_of_squares: setup.sums.squares(&counted.level) * &times,
            forces: Histogram::of(&counted.forces, factor),
            least,
            greatest,
            normals: Histogram::of(&counted.normals, factor),
            least_normal,
            greatest_normal,
        })
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.stackings += &other.stackings;
        self.contacts += &other.contacts;
        self.sum += &other.sum;
        self.sum_of_squares += &other.sum_of_squares;
        self.forces.add(&other.forces);
        self.normals.add(&other.normals);
        let pairs = [
            (&mut self.least, &other.least),
            (&mut self.greatest, &other.greatest),
            (&mut self.least_normal, &other.least_normal),
            (&mut self.greatest_normal, &other.greatest_normal),
        ];
        let orders = [Ordering::Less, Ordering::Greater].into_iter().cycle();
        for ((ours, theirs), better) in pairs.into_iter().zip(orders) {
            let replaces = theirs.as_ref().is_some_and(|theirs| {
                ours.as_ref().is_none_or(|ours| {
                    match ByValue(&theirs.force).cmp(&ByValue(&ours.force)) {
                        Ordering::Equal => theirs.stacking.signs().lt(ours.stacking.signs()),
                        order => order == better,
                    }
                })
            });
            if replaces {
                ours.clone_from(theirs);
            }
        }
    }
}

impl Extreme {
    fn of_ends<T: Numerator>(
        ends: &Ends<T>,
        denominator: &BigInt,
    ) -> Result<[Option<Self>; 2], Error> {
        let extreme = |end: &Option<count::Extreme<T>>| {
            let extreme = end.as_ref().map(|end| {
                let force = BigRational::new(end.value.clone().into(), denominator.clone());
                let stacking = Stacking::from_signs(end.signs.iter().copied())?;
                Ok::<_, Error>(Self { force, stacking })
            });
            extreme.transpose()
        };
        let [least, greatest] = ends;
        Ok([extreme(least)?, extreme(greatest)?])
    }
}
