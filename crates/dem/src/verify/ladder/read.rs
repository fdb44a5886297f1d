//! A ladder read back from the json of its report.

use std::io::{self, ErrorKind, Read};

use serde_json::Value;

use super::{Ladder, Refinement, Rung};

/// The most bytes of a record that is read: 16 MiB.
const MAX_BYTES: u64 = 16 << 20;

impl Ladder {
    /// Reads a ladder from the json of a [`LadderReport`](super::LadderReport): an object with `refinement` and `rungs`, or
    /// an array of one. What else is in it is passed over; orders are found anew.
    ///
    /// # Errors
    /// Those of the input; of the kind [`InvalidData`](ErrorKind::InvalidData) what is no such record, with the place, and
    /// of the kind [`FileTooLarge`](ErrorKind::FileTooLarge) one of more than 16 MiB.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table::FileFormat;
    /// use cannonpile_dem::verify::{Ladder, LadderReport, Refinement, Rung};
    ///
    /// let rungs = [1e4, 1e5].map(|k| Rung::of_errors(k, 30, 5.0 / k, 2.0 / k));
    /// let ladder = Ladder::new(Refinement::Stiffness, rungs)?;
    /// let mut json = Vec::new();
    /// LadderReport::new(&ladder).write(FileFormat::Json, &mut json)?;
    /// assert_eq!(Ladder::read(&*json)?, ladder);
    ///
    /// let refused = Ladder::read(&b"[{\"refinement\": \"stiffness\"}]"[..]).unwrap_err();
    /// assert_eq!(refused.to_string(), "no array 'rungs'");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn read(input: impl Read) -> io::Result<Self> {
        let mut bytes = Vec::new();
        input.take(MAX_BYTES + 1).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > MAX_BYTES {
            let error = format!("more than {MAX_BYTES} bytes");
            return Err(io::Error::new(ErrorKind::FileTooLarge, error));
        }
        let value: Value = serde_json::from_slice(&bytes)?;
        let record = match &value {
            Value::Array(records) => match &records[..] {
                [record] => record,
                _ => return Err(invalid(format!("{} records, not one", records.len()))),
            },
            record => record,
        };
        let refinement = record.get("refinement").and_then(Value::as_str);
        let refinement = [Refinement::Stiffness, Refinement::TimeStep]
            .into_iter()
            .find(|known| Some(known.name()) == refinement)
            .ok_or_else(|| invalid("no 'refinement' that is stiffness or timestep".into()))?;
        let rungs = record.get("rungs").and_then(Value::as_array);
        let rungs = rungs.ok_or_else(|| invalid("no array 'rungs'".into()))?;
        let rungs = rungs.iter().enumerate().map(|(n, rung)| {
            let fields = Fields {
                rung,
                number: n + 1,
            };
            Ok(Rung {
                parameter: fields.number(refinement.name())?,
                contacts: fields.count("contacts")?,
                matched: fields.count("matched")?,
                missing: fields.count("missing")?,
                extra: fields.count("extra")?,
                largest_error: fields.error("largest_error")?,
                rms_error: fields.error("rms_error")?,
                predicted_error: match rung.get("predicted_error") {
                    None | Some(Value::Null) => None,
                    Some(_) => Some(fields.number("predicted_error")?),
                },
            })
        });
        let rungs = rungs.collect::<io::Result<Vec<_>>>()?;
        Self::new(refinement, rungs).map_err(|error| invalid(error.to_string()))
    }
}

/// The fields of a rung, counted from 1.
struct Fields<'v> {
    rung: &'v Value,
    number: usize,
}

impl Fields<'_> {
    fn number(&self, name: &str) -> io::Result<f64> {
        let number = self.rung.get(name).and_then(Value::as_f64);
        number.ok_or_else(|| self.missing(name, "a number"))
    }

    /// An error, which is `null` where it is infinite.
    fn error(&self, name: &str) -> io::Result<f64> {
        match self.rung.get(name) {
            Some(Value::Null) => Ok(f64::INFINITY),
            _ => self.number(name),
        }
    }

    fn count(&self, name: &str) -> io::Result<u64> {
        let count = self.rung.get(name).and_then(Value::as_u64);
        count.ok_or_else(|| self.missing(name, "a count"))
    }

    fn missing(&self, name: &str, what: &str) -> io::Error {
        invalid(format!(
            "rung {} has no '{name}' that is {what}",
            self.number
        ))
    }
}

fn invalid(reason: String) -> io::Error {
    io::Error::new(ErrorKind::InvalidData, reason)
}
