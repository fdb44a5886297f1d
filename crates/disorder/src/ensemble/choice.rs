//! Selection of stackings: all or samples, and shards of them.

use core::fmt;
use core::ops::Range;
use core::str::FromStr;

use cannonpile::data::number;
use cannonpile::scalar::{ByValue, reduced};
use num_rational::BigRational;
use num_traits::ToPrimitive;
use serde::{Deserialize, Serialize};

use crate::Error;
use crate::check_fault_probability;

/// The selection of stackings: all of them, or random samples.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{Choice, Samples};
/// use num_rational::BigRational;
///
/// let half = BigRational::new(1.into(), 2.into());
/// let drawn = Choice::Drawn(Samples::new(1000, 1, half)?);
/// assert_ne!(drawn, Choice::All);
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Choice {
    /// Each stacking once.
    All,
    /// Random samples. A stacking that is drawn several times counts several times.
    Drawn(Samples),
}

/// The parameters of random samples. Sample n depends on the seed, the fault probability and n only.
///
/// The samples are numbered from 0. Sample n reads the keystream of ChaCha with eight rounds. The key is the seed
/// (eight bytes, least significant first) followed by 24 zeros, and the nonce is n. The keystream is read in words of
/// 64 bits, least significant byte first. A word x below b⌊2⁶⁴/b⌋ yields the integer x mod b, which is uniform below b.
/// Any other word is discarded. Let q = a/b in lowest terms. A sign differs from the previous one if its integer is
/// below a. A random first sign is + if its integer is 0, for b = 2.
///
/// # Examples
/// ```
/// use cannonpile_disorder::Samples;
/// use num_rational::BigRational;
///
/// let third = BigRational::new(1.into(), 3.into());
/// let samples = Samples::new(1000, 42, third)?;
/// assert_eq!((samples.count(), samples.seed()), (1000, 42));
/// assert_eq!(samples.fault_probability().to_string(), "1/3");
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "SamplesParts")]
pub struct Samples {
    #[serde(rename = "samples")]
    count: u64,
    seed: u64,
    /// The fault probability a/b, with 0 ≤ a ≤ b < 2⁶⁴.
    #[serde(with = "number")]
    fault_probability: BigRational,
}

cannonpile::engine::equality!(Hash for Samples; |Self { count, seed, fault_probability }|
    (count, seed, ByValue(fault_probability)));

impl Samples {
    /// Returns the parameters of `count` samples with this seed and fault probability.
    ///
    /// # Errors
    /// [`Syntax`](cannonpile::Error::Syntax) for a count of 0, and for a denominator of 2⁶⁴ or more.
    /// [`Error::FaultProbability`] unless 0 ≤ `fault_probability` ≤ 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::Samples;
    /// use num_rational::BigRational;
    ///
    /// let ratio = |n: i64, d: i64| BigRational::new(n.into(), d.into());
    /// assert!(Samples::new(1, 0, ratio(1, 1)).is_ok());
    /// assert!(Samples::new(0, 0, ratio(1, 2)).is_err());
    /// assert!(Samples::new(1, 0, ratio(3, 2)).is_err());
    /// ```
    pub fn new(count: u64, seed: u64, fault_probability: BigRational) -> Result<Self, Error> {
        if count == 0 {
            return Err(Error::syntax("0", "a number of samples, at least 1"));
        }
        let fault_probability = reduced(fault_probability);
        check_fault_probability(&fault_probability)?;
        if fault_probability.denom().to_u64().is_none() {
            return Err(Error::syntax(
                &fault_probability.to_string(),
                "a fault probability whose denominator is below 2^64",
            ));
        }
        Ok(Self {
            count,
            seed,
            fault_probability,
        })
    }

    /// Returns the number of samples.
    ///
    /// # Examples
    /// See [`Samples`].
    #[must_use]
    pub const fn count(&self) -> u64 {
        self.count
    }

    /// Returns the seed.
    ///
    /// # Examples
    /// See [`Samples`].
    #[must_use]
    pub const fn seed(&self) -> u64 {
        self.seed
    }

    /// Returns the fault probability q: the probability that a sign differs from the previous one.
    ///
    /// # Examples
    /// See [`Samples`].
    #[must_use]
    pub const fn fault_probability(&self) -> &BigRational {
        &self.fault_probability
    }
}

/// The serialised form of [`Samples`].
#[derive(Deserialize)]
#[serde(rename = "Samples", deny_unknown_fields)]
struct SamplesParts {
    samples: u64,
    seed: u64,
    #[serde(with = "number")]
    fault_probability: BigRational,
}

impl TryFrom<SamplesParts> for Samples {
    type Error = Error;

    fn try_from(parts: SamplesParts) -> Result<Self, Error> {
        Self::new(parts.samples, parts.seed, parts.fault_probability)
    }
}

/// The part I of N, counted from 1, of the stackings or samples of an ensemble.
///
/// Of T stackings or samples the shard contains the indices from ⌊T(I−1)/N⌋ up to but not including ⌊TI/N⌋.
///
/// # Examples
/// ```
/// use cannonpile_disorder::Shard;
///
/// let shard: Shard = "2/3".parse()?;
/// assert_eq!((shard.index(), shard.count()), (2, 3));
/// assert_eq!(Shard::WHOLE.to_string(), "1/1");
/// assert!("4/3".parse::<Shard>().is_err());
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Shard {
    index: u64,
    count: u64,
}

impl Shard {
    /// The whole ensemble, 1/1.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// Returns the part `index` of `count` parts.
    ///
    /// # Errors
    /// [`Syntax`](cannonpile::Error::Syntax) unless 1 ≤ `index` ≤ `count`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::Shard;
    ///
    /// assert!(Shard::new(3, 3).is_ok());
    /// assert!(Shard::new(0, 3).is_err());
    /// ```
    pub fn new(index: u64, count: u64) -> Result<Self, Error> {
        if (1..=count).contains(&index) {
            return Ok(Self { index, count });
        }
        let text = Self { index, count }.to_string();
        Err(Error::syntax(&text, EXPECTED))
    }

    /// Returns the index I of the part, from 1.
    ///
    /// # Examples
    /// See [`Shard`].
    #[must_use]
    pub const fn index(&self) -> u64 {
        self.index
    }

    /// Returns the number N of parts.
    ///
    /// # Examples
    /// See [`Shard`].
    #[must_use]
    pub const fn count(&self) -> u64 {
        self.count
    }

    /// Returns the indices of this part of `total` stackings.
    pub(super) fn range(self, total: u64) -> Range<u64> {
        let end = |part: u64| {
            let end = u128::from(total) * u128::from(part) / u128::from(self.count);
            // The quotient is at most the total, so the conversion does not fail.
            u64::try_from(end).unwrap_or(total)
        };
        end(self.index - 1)..end(self.index)
    }
}

const EXPECTED: &str = "a part I/N with I from 1 to N, such as 2/3";

impl fmt::Display for Shard {
    /// Prints `2/3`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl FromStr for Shard {
    type Err = Error;

    /// Reads `2/3`.
    ///
    /// # Errors
    /// [`Syntax`](cannonpile::Error::Syntax).
    ///
    /// # Examples
    /// See [`Shard`].
    fn from_str(text: &str) -> Result<Self, Error> {
        let parts = text.split_once('/');
        let parts = parts.and_then(|(index, count)| index.parse().ok().zip(count.parse().ok()));
        let (index, count) = parts.ok_or_else(|| Error::syntax(text, EXPECTED))?;
        Self::new(index, count)
    }
}

cannonpile::data::as_text!(Shard);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_consecutive() -> Result<(), Error> {
        for (total, of) in [(7, 3), (2, 5), (0, 2), (u64::MAX, 7)] {
            let mut end = 0;
            for index in 1..=of {
                let range = Shard::new(index, of)?.range(total);
                assert_eq!(range.start, end, "{index} of {of}");
                end = range.end;
            }
            assert_eq!(end, total);
        }
        Ok(())
    }
}
