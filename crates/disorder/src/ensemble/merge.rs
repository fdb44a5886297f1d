//! Merging of the tallies of shards.

use core::fmt;

use cannonpile::lattice::Site;
use cannonpile::shape::Anchor;

use super::{Choice, Shard, Tally};

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
    /// [`Unmergeable`] if tallies are missing, occur twice, or belong to different runs.
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
}
