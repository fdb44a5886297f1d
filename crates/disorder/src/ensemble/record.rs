//! Tallies as JSON files.

use std::io::{self, Read, Write};

use cannonpile::data::number;
use cannonpile::scalar::{ByValue, reduced};
use hmac_sha256::Hash;
use num_bigint::BigUint;
use num_rational::BigRational;
use serde::{Deserialize, Serialize};

use super::{Choice, ContactSet, Ensemble, Shard, Tally, Unmergeable, WithFaults};
use crate::Error;

/// The size limit of a file to read: 512 MiB.
const MAX_BYTES: u64 = 512 << 20;

/// A number of stackings, in the serialised form of this crate.
#[derive(Serialize)]
#[serde(transparent)]
struct Count(#[serde(with = "number")] BigUint);

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
#[derive(Clone, Debug)]
pub struct TallyRecord {
    version: String,
    fault_probability: BigRational,
    tally: Tally,
}

cannonpile::engine::equality!(TallyRecord; |Self { version, fault_probability, tally }|
    (version, ByValue(fault_probability), tally));

/// The entries of a file from which the others follow.
#[derive(Deserialize)]
struct Parts {
    cannonpile: String,
    ensemble: Ensemble,
    choice: Choice,
    shard: Shard,
    #[serde(with = "number")]
    fault_probability: BigRational,
    faults: Vec<WithFaults>,
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
            Choice::All => reduced(fault_probability),
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
        let mut entries = Vec::new();
        self.write_entries(&mut entries)?;
        out.write_all(&entries)?;
        write!(out, "{SHA256}{}\"\n}}\n", digest(&entries))
    }

    /// Writes all entries but the digest.
    fn write_entries(&self, out: &mut Vec<u8>) -> io::Result<()> {
        let tally = &self.tally;
        let mut object = Object { out, gap: "{\n" };
        object.entry("cannonpile", &self.version)?;
        object.entry("ensemble", &tally.ensemble)?;
        object.entry("choice", &tally.choice)?;
        object.entry("shard", &tally.shard)?;
        object.entry("fault_probability", &self.fault_probability.to_string())?;
        object.entry("stackings", &Count(tally.stackings()))?;
        if let Some(left_out) = tally.left_out() {
            object.entry("left_out", &Count(left_out))?;
        }
        for (by, name) in [
            (ContactSet::Sloping, "standing"),
            (ContactSet::WithHorizontal, "held"),
        ] {
            if let Some(count) = tally.standing(by) {
                object.entry(name, &Count(count))?;
            }
            let probability = tally.standing_probability(by, &self.fault_probability);
            if let Some(exact) = probability.map_err(io::Error::other)? {
                object.entry(&format!("{name}_probability"), &exact.to_string())?;
            }
            if let Some(ends) = tally.standing_interval(by) {
                object.entry(&format!("{name}_interval"), &ends)?;
            }
        }
        let Object { out, .. } = object;
        out.write_all(b",\n  \"faults\": ")?;
        lines(tally.faults.iter(), out)
    }

    /// Reads a record that [`write`](Self::write) has written.
    ///
    /// The digest shows whether any byte was changed.
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
        let refused = |what: &str| {
            let message = format!("{what}; run this part again");
            io::Error::new(io::ErrorKind::InvalidData, message)
        };
        let mut text = String::new();
        input.take(MAX_BYTES).read_to_string(&mut text)?;
        let parts: Parts = serde_json::from_str(&text)?;
        let (entries, end) = text.rsplit_once(SHA256).ok_or_else(|| {
            refused(
                "it has no digest 'sha256' as its last entry, or was changed after it was written",
            )
        })?;
        if end.trim_end() != format!("{}\"\n}}", digest(entries.as_bytes())) {
            return Err(refused("it was changed after it was written"));
        }
        Ok(Self {
            version: parts.cannonpile,
            fault_probability: parts.fault_probability,
            tally: Tally {
                ensemble: parts.ensemble,
                choice: parts.choice,
                shard: parts.shard,
                faults: parts.faults,
            },
        })
    }
}

/// What stands before the digest.
const SHA256: &str = ",\n  \"sha256\": \"";

/// Returns the SHA-256 of some bytes, in hexadecimal digits.
fn digest(bytes: &[u8]) -> String {
    Hash::hash(bytes).map(|byte| format!("{byte:02x}")).concat()
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
