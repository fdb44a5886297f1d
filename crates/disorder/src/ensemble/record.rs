//! Tallies as JSON files.

use std::io::{self, BufReader, Read, Write};

use cannonpile::data::number;
use hmac_sha256::Hash;
use num_bigint::BigUint;
use num_rational::BigRational;
use serde::{Deserialize, Serialize};
use serde_json::Number;

use super::{Choice, ContactSet, Ensemble, Shard, Tally, Unmergeable, WithFaults};
use crate::Error;

/// The size limit of a file to read: 512 MiB.
const MAX_BYTES: u64 = 512 << 20;

/// A number of stackings, in the serialised form of this crate.
#[derive(PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
struct Count(#[serde(with = "number")] BigUint);

/// The entries of a file that follow from the others.
#[derive(PartialEq)]
struct Derived {
    stackings: Count,
    left_out: Option<Count>,
    /// The stable stackings, and those that are stable with horizontal contacts.
    stable: [Stable; 2],
}

/// The number of stable stackings, and its share. Not every run counts them.
#[derive(PartialEq)]
struct Stable {
    count: Option<Count>,
    probability: Option<String>,
    /// The ends as they are written.
    interval: Option<[Number; 2]>,
}

/// The names of the entries of [`Stable`].
const STABLE: [[&str; 3]; 2] = [
    ["standing", "standing_probability", "standing_interval"],
    ["held", "held_probability", "held_interval"],
];

/// A tally with the metadata of its file: the version of this crate, and the fault probability of the reported
/// probabilities.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{Choice, Ensemble, FirstSign, RandomStackings, Shard, TallyRecord};
/// use cannonpile::lattice::Region;
/// use num_rational::BigRational;
///
/// let stackings = RandomStackings::new(6, FirstSign::Plus)?;
/// let ensemble = Ensemble::under(Region::SITE, stackings)?;
/// let third = BigRational::new(1.into(), 3.into());
/// let part = |index| {
///     let tally = ensemble.run(&Choice::All, Shard::new(index, 2)?)?;
///     TallyRecord::new(tally, third.clone())
/// };
/// let merged = TallyRecord::merge(&[part(2)?, part(1)?]).unwrap();
/// let mut text = Vec::new();
/// merged.write(&mut text)?;
/// assert_eq!(TallyRecord::read(&*text)?, merged);
///
/// // The bytes are those of the whole.
/// let whole = TallyRecord::new(ensemble.run(&Choice::All, Shard::WHOLE)?, third)?;
/// let mut of_whole = Vec::new();
/// whole.write(&mut of_whole)?;
/// assert_eq!(text, of_whole);
/// assert!(String::from_utf8(text)?.contains("\n  \"standing_probability\": \"62/81\",\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TallyRecord {
    version: String,
    fault_probability: BigRational,
    tally: Tally,
}

/// The entries of a file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Parts {
    cannonpile: String,
    ensemble: Ensemble,
    choice: Choice,
    shard: Shard,
    #[serde(with = "number")]
    fault_probability: BigRational,
    stackings: Count,
    left_out: Option<Count>,
    standing: Count,
    standing_probability: Option<String>,
    standing_interval: Option<[Number; 2]>,
    held: Option<Count>,
    held_probability: Option<String>,
    held_interval: Option<[Number; 2]>,
    faults: Vec<WithFaults>,
    sha256: Option<String>,
}

impl TallyRecord {
    /// Returns the record of a tally of this version. For samples their own fault probability replaces
    /// `fault_probability`.
    ///
    /// # Errors
    /// [`Error::FaultProbability`] unless 0 ≤ `fault_probability` ≤ 1.
    ///
    /// # Examples
    /// See [`TallyRecord`].
    pub fn new(tally: Tally, fault_probability: BigRational) -> Result<Self, Error> {
        let fault_probability = match &tally.choice {
            Choice::Drawn(samples) => samples.fault_probability().clone(),
            Choice::All => fault_probability,
        };
        tally.weights(&fault_probability)?;
        Ok(Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            fault_probability,
            tally,
        })
    }

    /// Returns the tally.
    ///
    /// # Examples
    /// See [`TallyRecord`].
    #[must_use]
    pub const fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Returns the fault probability of the reported probabilities.
    ///
    /// # Examples
    /// See [`TallyRecord`].
    #[must_use]
    pub const fn fault_probability(&self) -> &BigRational {
        &self.fault_probability
    }

    /// Returns the record of the whole, given the records of all shards in any order.
    ///
    /// # Errors
    /// [`Unmergeable`]. It is also returned for records of different versions or fault probabilities.
    ///
    /// # Examples
    /// See [`TallyRecord`].
    pub fn merge(parts: &[Self]) -> Result<Self, Unmergeable> {
        let first = parts.first().ok_or(Unmergeable::Nothing)?;
        let metadata = |part: &Self| {
            let q = part.fault_probability.to_string();
            [("version", part.version.clone()), ("fault probability", q)]
        };
        for (place, part) in parts.iter().enumerate() {
            let pairs = metadata(part).into_iter().zip(metadata(first));
            for ((what, found), (_, expected)) in pairs {
                if found != expected {
                    return Err(Unmergeable::Other {
                        place,
                        what,
                        found,
                        expected,
                    });
                }
            }
        }
        let tallies: Vec<Tally> = parts.iter().map(|part| part.tally.clone()).collect();
        Ok(Self {
            tally: Tally::merge(&tallies)?,
            ..first.clone()
        })
    }

    /// Writes the record as JSON, with a line for each number of faults. Equal records yield equal bytes.
    ///
    /// The last entry, `sha256`, is the SHA-256 of the bytes before it, without the comma and the line end.
    ///
    /// # Errors
    /// Any error of the output.
    ///
    /// # Examples
    /// See [`TallyRecord`].
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        self.write_entries(out)?;
        write!(out, ",\n  \"sha256\": \"{}\"\n}}\n", self.digest()?)
    }

    /// Returns the SHA-256 of the entries, in hexadecimal digits.
    fn digest(&self) -> io::Result<String> {
        let mut entries = Vec::new();
        self.write_entries(&mut entries)?;
        let digest = Hash::hash(&entries);
        Ok(digest.map(|byte| format!("{byte:02x}")).concat())
    }

    /// Writes all entries but the digest.
    fn write_entries(&self, out: &mut impl Write) -> io::Result<()> {
        let tally = &self.tally;
        let mut object = Object { out, gap: "{\n" };
        object.entry("cannonpile", &self.version)?;
        object.entry("ensemble", &tally.ensemble)?;
        object.entry("choice", &tally.choice)?;
        object.entry("shard", &tally.shard)?;
        object.entry("fault_probability", &self.fault_probability.to_string())?;
        let derived = self.derived().map_err(io::Error::other)?;
        object.entry("stackings", &derived.stackings)?;
        if let Some(left_out) = &derived.left_out {
            object.entry("left_out", left_out)?;
        }
        for (stable, [count, probability, interval]) in derived.stable.iter().zip(STABLE) {
            if let Some(found) = &stable.count {
                object.entry(count, found)?;
            }
            if let Some(exact) = &stable.probability {
                object.entry(probability, exact)?;
            }
            if let Some(bounds) = &stable.interval {
                object.entry(interval, bounds)?;
            }
        }
        let Object { out, .. } = object;
        out.write_all(b",\n  \"faults\": ")?;
        lines(tally.faults.iter(), out)
    }

    /// Computes the entries that follow from the others.
    fn derived(&self) -> Result<Derived, Error> {
        let tally = &self.tally;
        let stable = |by| {
            let probability = tally.standing_probability(by, &self.fault_probability)?;
            Ok::<_, Error>(Stable {
                count: tally.standing(by).map(Count),
                probability: probability.map(|exact| exact.to_string()),
                interval: tally
                    .standing_interval(by)
                    .and_then(|[from, to]| Some([Number::from_f64(from)?, Number::from_f64(to)?])),
            })
        };
        Ok(Derived {
            stackings: Count(tally.stackings()),
            left_out: tally.left_out().map(Count),
            stable: [
                stable(ContactSet::Sloping)?,
                stable(ContactSet::WithHorizontal)?,
            ],
        })
    }

    /// Reads a record that [`write`](Self::write) has written.
    ///
    /// Entries that follow from the counts are computed again and compared. The digest shows whether any other entry was
    /// changed. Space and line ends between entries do not matter.
    ///
    /// # Errors
    /// * The errors of the input.
    /// * [`InvalidData`](io::ErrorKind::InvalidData) or [`UnexpectedEof`](io::ErrorKind::UnexpectedEof), with the line
    ///   in the message, if the input is an invalid record or has more than 512 MiB.
    /// * [`InvalidData`](io::ErrorKind::InvalidData) if the record was changed after it was written, or has no digest.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::TallyRecord;
    ///
    /// assert!(TallyRecord::read(&b"{}"[..]).is_err());
    /// ```
    pub fn read(input: impl Read) -> io::Result<Self> {
        let input = BufReader::new(input.take(MAX_BYTES));
        let parts: Parts = serde_json::from_reader(input)?;
        let Parts {
            cannonpile: version,
            ensemble,
            choice,
            shard,
            fault_probability,
            stackings,
            left_out,
            standing,
            standing_probability,
            standing_interval,
            held,
            held_probability,
            held_interval,
            faults,
            sha256,
        } = parts;
        let stable = |count, probability, interval| Stable {
            count,
            probability,
            interval,
        };
        let derived = Derived {
            stackings,
            left_out,
            stable: [
                stable(Some(standing), standing_probability, standing_interval),
                stable(held, held_probability, held_interval),
            ],
        };
        let tally = Tally {
            ensemble,
            choice,
            shard,
            faults,
        };
        let refused = |message: String| io::Error::new(io::ErrorKind::InvalidData, message);
        if !tally.is_possible() {
            return Err(refused(Unmergeable::Impossible { place: 0 }.to_string()));
        }
        let record = Self::new(tally, fault_probability.clone());
        let record = record.map_err(|error| refused(error.to_string()))?;
        if record.fault_probability != fault_probability {
            return Err(refused(format!(
                "the samples were drawn with the fault probability {}, not {fault_probability}; run this part again",
                record.fault_probability
            )));
        }
        let record = Self { version, ..record };
        if record.derived().map_err(io::Error::other)? != derived {
            return Err(refused(
                "the totals do not match the counts; run this part again".to_owned(),
            ));
        }
        match sha256 {
            Some(digest) if digest == record.digest()? => Ok(record),
            Some(_) => Err(refused(
                "it was changed after it was written; run this part again".to_owned(),
            )),
            None => Err(refused(
                "it has no digest 'sha256', as an earlier version wrote it; run this part again"
                    .to_owned(),
            )),
        }
    }
}

/// A writer of a JSON object with a line for each entry.
struct Object<'w, W> {
    out: &'w mut W,
    gap: &'static str,
}

impl<W: Write> Object<'_, W> {
    fn entry(&mut self, key: &str, value: &impl Serialize) -> io::Result<()> {
        write!(self.out, "{}  \"{key}\": ", self.gap)?;
        self.gap = ",\n";
        Ok(serde_json::to_writer(&mut *self.out, value)?)
    }
}

/// Writes a JSON list with a line for each entry.
fn lines(entries: impl Iterator<Item = impl Serialize>, out: &mut impl Write) -> io::Result<()> {
    let mut gap = "[\n    ";
    for entry in entries {
        out.write_all(gap.as_bytes())?;
        serde_json::to_writer(&mut *out, &entry)?;
        gap = ",\n    ";
    }
    let end = if gap.starts_with('[') { "[]" } else { "\n  ]" };
    out.write_all(end.as_bytes())
}
