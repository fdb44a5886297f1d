//! Tallies of parts, put together.

use core::fmt;

use cannonpile::lattice::Site;
use cannonpile::scalar::Ring;
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::Zero;

use super::setup::{MOST_BINS, stackings_of};
use super::{Choice, Distribution, Ensemble, Extreme, Histogram, Shard, Tally, WithFaults};

/// Why tallies do not make one.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{Tally, Unmergeable};
///
/// assert_eq!(Tally::merge(&[]), Err(Unmergeable::Nothing));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unmergeable {
    /// There is no tally at all.
    Nothing,
    /// One is of something else than the first.
    Other {
        /// Its place among those given, from 0.
        place: usize,
        /// What differs: `layers`, `top`, `seed` and so on.
        what: &'static str,
        /// What it has.
        found: String,
        /// What the first has.
        expected: String,
    },
    /// Two are of the same part.
    Twice {
        /// The place of the second among those given, from 0.
        place: usize,
        /// The part.
        shard: Shard,
    },
    /// Parts are missing.
    Missing {
        /// Which, in order; of many the first.
        shards: Vec<Shard>,
        /// How many.
        count: u64,
    },
    /// A tally that no run can have made.
    Impossible {
        /// Its place among those given, from 0.
        place: usize,
    },
}

impl fmt::Display for Unmergeable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => f.write_str("there is nothing to merge: give the parts"),
            Self::Other {
                what,
                found,
                expected,
                ..
            } => write!(
                f,
                "another {what} than that of the first part, {found} and not {expected}: leave it out, or run it again"
            ),
            Self::Twice { shard, .. } => {
                write!(
                    f,
                    "the part {shard} is there already: leave one of them out"
                )
            }
            Self::Missing { shards, count } => {
                let names: Vec<_> = shards.iter().map(Shard::to_string).collect();
                let more = if *count > shards.len() as u64 {
                    ", …"
                } else {
                    ""
                };
                let parts = if *count == 1 { "part is" } else { "parts are" };
                write!(
                    f,
                    "{count} {parts} missing, {}{more}: run ensemble with --shard for each, and give its file too",
                    names.join(", ")
                )
            }
            Self::Impossible { .. } => {
                f.write_str("its counts are not those of its stackings: run it again")
            }
        }
    }
}

impl core::error::Error for Unmergeable {}

/// How many missing parts are named.
const NAMED: usize = 20;

impl Tally {
    /// Returns the tally of the whole, of those of all its parts, in any order.
    ///
    /// # Errors
    /// [`Unmergeable`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard, Tally};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(7, FirstSign::Plus)?;
    /// let ensemble = Ensemble::under(Region::triangle(3)?, stackings)?;
    /// let part = |index| ensemble.run(&Choice::All, Shard::new(index, 3)?);
    /// let parts = [part(3)?, part(1)?, part(2)?];
    /// assert_eq!(Tally::merge(&parts), Ok(ensemble.run(&Choice::All, Shard::WHOLE)?));
    /// let missing = Tally::merge(&parts[..2]).unwrap_err();
    /// assert!(missing.to_string().starts_with("1 part is missing, 2/3: "));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn merge(parts: &[Self]) -> Result<Self, Unmergeable> {
        let first = parts.first().ok_or(Unmergeable::Nothing)?;
        for (place, part) in parts.iter().enumerate() {
            if let Some((what, found, expected)) = part.difference(first) {
                return Err(Unmergeable::Other {
                    place,
                    what,
                    found,
                    expected,
                });
            }
            if parts
                .iter()
                .take(place)
                .any(|other| other.shard == part.shard)
            {
                let shard = part.shard;
                return Err(Unmergeable::Twice { place, shard });
            }
            if !part.is_possible() {
                return Err(Unmergeable::Impossible { place });
            }
        }
        let mut present: Vec<u64> = parts.iter().map(|part| part.shard.index()).collect();
        present.sort_unstable();
        let of = first.shard.of();
        let count = of - present.len() as u64;
        if count > 0 {
            let missing = (1..=of).filter(|index| present.binary_search(index).is_err());
            let shards = missing.filter_map(|index| Shard::new(index, of).ok());
            let shards = shards.take(NAMED).collect();
            return Err(Unmergeable::Missing { shards, count });
        }
        let mut whole = first.clone();
        parts.iter().skip(1).for_each(|part| whole.add(part));
        whole.shard = Shard::WHOLE;
        Ok(whole)
    }

    /// Adds what was counted of others of the same ensemble.
    pub(super) fn add(&mut self, other: &Self) {
        let faults = self.faults.iter_mut().zip(&other.faults);
        faults.for_each(|(ours, theirs)| ours.add(theirs));
    }

    /// What makes it a part of another whole: the name of it, and both values.
    fn difference(&self, first: &Self) -> Option<(&'static str, String, String)> {
        let described = |tally: &Self| {
            let Self {
                ensemble,
                choice,
                shard,
                ..
            } = tally;
            let (stackings, top) = (ensemble.stackings(), ensemble.top());
            let none = || "none".to_owned();
            let load = |(site, load): (Site, &BigRational)| format!("{},{}={load}", site.i, site.j);
            let loads: Vec<_> = top.loads().map(load).collect();
            let loads = if loads.is_empty() {
                none()
            } else {
                loads.join(" ")
            };
            let [samples, seed, q] = match choice {
                Choice::All => [none(), none(), none()],
                Choice::Drawn(samples) => [
                    samples.count().to_string(),
                    samples.seed().to_string(),
                    samples.fault_probability().to_string(),
                ],
            };
            let weight = u8::from(!top.is_weightless());
            let spacing = ["above 1", "1"][usize::from(ensemble.has_horizontal_contacts())];
            [
                ("number of layers", stackings.layers().to_string()),
                ("first sign", stackings.first().to_string()),
                ("top", format!("{:#}", top.shape().base())),
                ("load", loads),
                ("weight of spheres", weight.to_string()),
                ("spacing", spacing.to_owned()),
                ("width of bins", ensemble.bins().to_string()),
                ("number of samples", samples),
                ("seed", seed),
                ("fault probability", q),
                ("number of parts", shard.of().to_string()),
            ]
        };
        let mut pairs = described(self).into_iter().zip(described(first));
        let (ours, theirs) = pairs.find(|(ours, theirs)| ours != theirs)?;
        Some((ours.0, ours.1, theirs.1))
    }

    /// Whether it has the stackings of its part, each number of faults once, and bins that a run can have.
    pub(super) fn is_possible(&self) -> bool {
        let stackings = self.ensemble.stackings();
        // First, since layers beyond number are not gone into.
        if self.faults.len() as i128 != stackings.most_faults() + 1 {
            return false;
        }
        let has_held = self.ensemble.has_horizontal_contacts();
        let is_row = |(d, with): (usize, &WithFaults)| {
            let WithFaults {
                faults,
                all,
                standing,
                held,
            } = with;
            // What stands does so with horizontal contacts too.
            let is_between =
                |held: &BigUint| (&standing.stackings..=&all.stackings).contains(&held);
            *faults as usize == d
                && held.is_some() == has_held
                && held.as_ref().is_none_or(is_between)
                && standing.stackings <= all.stackings
                && standing.contacts <= all.contacts
                && (self.choice != Choice::All
                    || stackings
                        .count_with(*faults)
                        .is_ok_and(|count| all.stackings <= count))
                && [all, standing]
                    .iter()
                    .all(|of| of.is_possible(&self.ensemble, d))
        };
        let expected = stackings_of(&self.ensemble, &self.choice, self.shard);
        expected == Some(self.stackings()) && self.faults.iter().enumerate().all(is_row)
    }
}

impl Distribution {
    /// Whether piles of an ensemble with so many faults can have it.
    fn is_possible(&self, ensemble: &Ensemble, faults: usize) -> bool {
        let layers = ensemble.stackings().layers();
        let ends = [
            (&self.forces, [&self.least, &self.greatest]),
            (&self.normals, [&self.least_normal, &self.greatest_normal]),
        ];
        let is_of_ensemble = |found: &Option<Extreme>| {
            found.as_ref().is_none_or(|Extreme { stacking, .. }| {
                stacking.layers() == layers && stacking.changes() == faults
            })
        };
        let are_possible = |(histogram, ends): &(&Histogram, [&Option<Extreme>; 2])| {
            histogram.is_possible(*ends, ensemble.bins())
                && ends.iter().all(|end| is_of_ensemble(end))
        };
        self.forces.total() == self.contacts
            && self.stackings.is_zero() == self.normals.counts.is_empty()
            && ends.iter().all(are_possible)
    }
}

impl Histogram {
    /// Whether its bins are those of a run: they begin and end with a count, that of the least and the greatest number.
    fn is_possible(&self, [least, greatest]: [&Option<Extreme>; 2], width: &BigRational) -> bool {
        let (Some(begin), Some(end)) = (self.counts.first(), self.counts.last()) else {
            return self.first == 0 && least.is_none() && greatest.is_none();
        };
        let last = i128::from(self.first) + self.counts.len() as i128 - 1;
        let most = i128::from(MOST_BINS);
        let is_in = |found: &Option<Extreme>, bin: i128| {
            let force = found.as_ref().map(|found| &found.force);
            force.is_some_and(|force| (force / width).floor() == BigRational::from_i128(bin))
        };
        !begin.is_zero()
            && !end.is_zero()
            && i128::from(self.first) >= -most
            && last < most
            && is_in(least, self.first.into())
            && is_in(greatest, last)
    }
}
