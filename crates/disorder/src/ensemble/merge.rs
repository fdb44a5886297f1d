//! Merging of the tallies of shards.

use crate::Each;
use core::fmt;

use cannonpile::lattice::Site;
use cannonpile::scalar::Ring;
use cannonpile::shape::Anchor;
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::setup::{MAX_BINS, stackings_of};
use super::{Choice, Distribution, Ensemble, Extreme, Histogram, Shard, Tally, WithFaults};

/// The reason why tallies do not merge into one.
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
    /// The list of tallies is empty.
    Nothing,
    /// A tally belongs to another run than the first one.
    Other {
        /// The index of the tally in the list, from 0.
        place: usize,
        /// The property that differs: `number of layers`, `top`, `seed` and so on.
        what: &'static str,
        /// The value in this tally.
        found: String,
        /// The value in the first tally.
        expected: String,
    },
    /// Two tallies have the same shard.
    Twice {
        /// The index of the second tally in the list, from 0.
        place: usize,
        /// The shard.
        shard: Shard,
    },
    /// Shards are missing.
    Missing {
        /// The first missing shards, in order.
        shards: Vec<Shard>,
        /// The number of missing shards.
        count: u64,
    },
    /// No run can produce this tally.
    Impossible {
        /// The index of the tally in the list, from 0.
        place: usize,
    },
}

impl fmt::Display for Unmergeable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => {
                f.write_str("there are no tallies to merge; give the tally of each part")
            }
            Self::Other {
                what,
                found,
                expected,
                ..
            } => write!(
                f,
                "the {what} is {found}, but {expected} in the first part; remove this part or run it again"
            ),
            Self::Twice { shard, .. } => {
                write!(f, "part {shard} occurs twice; remove one of the two")
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
                    "{count} {parts} missing, {}{more}: run ensemble with --shard for each, and add its file",
                    names.join(", ")
                )
            }
            Self::Impossible { .. } => {
                f.write_str("the counts do not match the stackings; run this part again")
            }
        }
    }
}

impl core::error::Error for Unmergeable {}

/// The largest number of missing shards that an error names.
const NAMED: usize = 20;

impl Tally {
    /// Returns the tally of the whole, given the tallies of all shards in any order.
    ///
    /// # Errors
    /// [`Unmergeable`] if tallies are missing, occur twice, belong to different runs, or are damaged.
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
        let of = first.shard.count();
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

    /// Adds the counts of another tally of the same run.
    pub(super) fn add(&mut self, other: &Self) {
        let faults = self.faults.iter_mut().zip(&other.faults);
        faults.for_each(|(ours, theirs)| ours.add(theirs));
    }

    /// Returns the first property that differs from the run of another tally: its name and both values.
    fn difference(&self, first: &Self) -> Option<(&'static str, String, String)> {
        let described = |tally: &Self| {
            let Self {
                ensemble,
                choice,
                shard,
                ..
            } = tally;
            let (stackings, layer) = (ensemble.stackings(), &ensemble.layer);
            let none = || "none".to_owned();
            let [top, base] = match ensemble.anchor() {
                Anchor::Top(top) => [format!("{top:#}"), none()],
                Anchor::Base(base) => [none(), format!("{base:#}")],
            };
            let load =
                |(site, load): (Site, &cannonpile::Load)| format!("{},{}={load}", site.i, site.j);
            let loads: Vec<_> = layer.loads().map(load).collect();
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
            let weight = u8::from(!layer.is_weightless());
            let spacing = ["above 1", "1"][usize::from(ensemble.has_horizontal_contacts())];
            [
                ("number of layers", stackings.layers().to_string()),
                ("first sign", stackings.first().to_string()),
                ("top", top),
                ("base", base),
                ("load", loads),
                ("weight of spheres", weight.to_string()),
                ("spacing", spacing.to_owned()),
                ("width of bins", ensemble.bin_width().to_string()),
                ("number of samples", samples),
                ("seed", seed),
                ("fault probability", q),
                ("number of parts", shard.count().to_string()),
            ]
        };
        let mut pairs = described(self).into_iter().zip(described(first));
        let (ours, theirs) = pairs.find(|(ours, theirs)| ours != theirs)?;
        Some((ours.0, ours.1, theirs.1))
    }

    /// Returns whether a run can produce this tally. The number of stackings has to match the shard, each number of
    /// faults has to occur once, and the histograms have to be consistent.
    pub(super) fn is_possible(&self) -> bool {
        let stackings = self.ensemble.stackings();
        // This comparison comes first, because the others take time proportional to the number of layers.
        if self.faults.len() as i128 != stackings.most_faults() + 1 {
            return false;
        }
        let has_held = self.ensemble.has_horizontal_contacts();
        let on_base = matches!(self.ensemble.anchor(), Anchor::Base(_));
        let is_row = |(d, with): (usize, &WithFaults)| {
            let WithFaults {
                faults,
                left_out,
                all,
                standing,
                held,
            } = with;
            // A stacking that is stable without horizontal contacts is stable with them.
            let is_between =
                |held: &BigUint| (&standing.stackings..=&all.stackings).contains(&held);
            *faults as usize == d
                && held.is_some() == has_held
                && left_out.is_some() == on_base
                && held.as_ref().is_none_or(is_between)
                && standing.stackings <= all.stackings
                && standing.is_part_of(all, self.ensemble.bin_width())
                && (self.choice != Choice::All
                    || stackings
                        .count_with(*faults)
                        .is_ok_and(|count| listed(with) <= count))
                && [all, standing]
                    .iter()
                    .all(|of| of.is_possible(&self.ensemble, d))
        };
        let expected = stackings_of(&self.ensemble, &self.choice, self.shard);
        let found = self.faults.iter().map(listed).sum();
        expected == Some(found) && self.faults.iter().enumerate().all(is_row)
    }
}

/// Returns the number of stackings with one number of faults, including those that are left out.
fn listed(with: &WithFaults) -> BigUint {
    let left_out = with.left_out.as_ref();
    left_out.map_or_else(
        || with.all.stackings.clone(),
        |left_out| left_out + &with.all.stackings,
    )
}

impl Distribution {
    /// Returns whether piles of this ensemble with this number of faults can have this distribution.
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
            histogram.is_possible(*ends, ensemble.bin_width())
                && ends.iter().all(|end| is_of_ensemble(end))
        };
        self.forces.total() == self.contacts
            && self.has_possible_sums(ensemble.bin_width())
            && self.stackings.is_zero() == self.normals.counts.is_empty()
            && ends.iter().all(are_possible)
    }
}

impl Distribution {
    /// Returns whether these forces without tension, and others, can be the forces of `all`.
    fn is_part_of(&self, all: &Self, width: &BigRational) -> bool {
        let is_tension = |least: &Option<Extreme>| {
            let least = least.as_ref();
            least.is_some_and(|least| least.force.is_negative())
        };
        let forces = all.forces.without(&self.forces);
        let normals = all.normals.without(&self.normals);
        let (Some(forces), Some(_)) = (forces, normals) else {
            return false;
        };
        let others = Self {
            contacts: forces.total(),
            sum: &all.sum - &self.sum,
            sum_of_squares: &all.sum_of_squares - &self.sum_of_squares,
            forces,
            ..Self::default()
        };
        others.has_possible_sums(width)
            && !is_tension(&self.least)
            && !is_tension(&self.least_normal)
    }

    /// Returns whether the contact forces in the bins can have these sums.
    ///
    /// Each force lies between the ends of its bin, and its square between those of their squares. The square of the sum is
    /// at most the sum of the squares times the number of forces (Cauchy and Schwarz).
    fn has_possible_sums(&self, width: &BigRational) -> bool {
        let count = BigRational::from_integer(self.contacts.clone().into());
        let [mut least, mut greatest] = [(); 2].each(|()| [BigInt::zero(), BigInt::zero()]);
        for (place, count) in (0..).zip(&self.forces.counts) {
            let count = BigInt::from(count.clone());
            let [begin, end] =
                [0, 1].each(|n| BigInt::from(i128::from(self.forces.first) + place + n));
            let squares = [&begin * &begin, &end * &end];
            let [small, large] = if squares[0] <= squares[1] {
                [0, 1]
            } else {
                [1, 0]
            };
            least[0] += &count * begin;
            least[1] += &count * &squares[small];
            greatest[0] += &count * end;
            greatest[1] += count * &squares[large];
        }
        let square = width * width;
        let is_between = |sum: &BigRational, of: usize, unit: &BigRational| {
            unit * &least[of] <= *sum && *sum <= unit * &greatest[of]
        };
        is_between(&self.sum, 0, width)
            && is_between(&self.sum_of_squares, 1, &square)
            && &self.sum * &self.sum <= &self.sum_of_squares * count
    }
}

impl Histogram {
    /// Returns the counts without those of a part. `None` if some count of the part is greater.
    fn without(&self, part: &Self) -> Option<Self> {
        let bins = (0..).map(|place| i128::from(self.first) + place);
        let rest = self.counts.iter().zip(bins).map(|(count, bin)| {
            let of_part = part.count(bin);
            (of_part <= *count).then(|| count - of_part)
        });
        let counts: Vec<_> = rest.collect::<Option<_>>()?;
        let (first, total) = (self.first, self.total());
        let rest = Self { first, counts };
        // Counts of the part in other bins are missing here.
        (rest.total() + part.total() == total).then_some(rest)
    }

    /// Returns whether the first and the last bin contain the least and the greatest number.
    fn is_possible(&self, [least, greatest]: [&Option<Extreme>; 2], width: &BigRational) -> bool {
        let (Some(begin), Some(end)) = (self.counts.first(), self.counts.last()) else {
            return self.first == 0 && least.is_none() && greatest.is_none();
        };
        let last = i128::from(self.first) + self.counts.len() as i128 - 1;
        let most = i128::from(MAX_BINS);
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
