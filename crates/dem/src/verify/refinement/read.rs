//! Reads a refinement study from the json of its report.

use std::io::{self, ErrorKind, Read};

use serde_json::Value;

use super::{Level, Refinement, RefinementStudy};

/// The largest size of a record in bytes: 16 MiB.
const MAX_BYTES: u64 = 16 << 20;

impl RefinementStudy {
    /// Reads a refinement study from the json of a [`RefinementReport`](super::RefinementReport): an object with
    /// `refinement` and `levels`, or an array of one such object. Other entries are ignored, and orders are computed
    /// again.
    ///
    /// # Errors
    /// Errors of the input. The kind [`InvalidData`](ErrorKind::InvalidData) reports a record of another form, and
    /// names the place. The kind [`FileTooLarge`](ErrorKind::FileTooLarge) reports more than 16 MiB.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table::FileFormat;
    /// use cannonpile_dem::verify::{RefinementStudy, RefinementReport, Refinement, Level};
    ///
    /// let levels = [1e4, 1e5].map(|k| Level::of_errors(k, 30, 5.0 / k, 2.0 / k));
    /// let study = RefinementStudy::new(Refinement::Stiffness, levels)?;
    /// let mut json = Vec::new();
    /// RefinementReport::new(&study).write(FileFormat::Json, &mut json)?;
    /// assert_eq!(RefinementStudy::read(&*json)?, study);
    ///
    /// let refused = RefinementStudy::read(&b"[{\"refinement\": \"stiffness\"}]"[..]).unwrap_err();
    /// assert_eq!(refused.to_string(), "no array 'levels'");
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
        let levels = record.get("levels").and_then(Value::as_array);
        let levels = levels.ok_or_else(|| invalid("no array 'levels'".into()))?;
        let levels = levels.iter().enumerate().map(|(n, level)| {
            let fields = Fields {
                level,
                number: n + 1,
            };
            Ok(Level {
                parameter: fields.number(refinement.name())?,
                contacts: fields.count("contacts")?,
                matched: fields.count("matched")?,
                missing: fields.count("missing")?,
                extra: fields.count("extra")?,
                largest_error: fields.error("largest_error")?,
                rms_error: fields.error("rms_error")?,
                predicted_error: match level.get("predicted_error") {
                    None | Some(Value::Null) => None,
                    Some(_) => Some(fields.number("predicted_error")?),
                },
            })
        });
        let levels = levels.collect::<io::Result<Vec<_>>>()?;
        Self::new(refinement, levels).map_err(|error| invalid(error.to_string()))
    }
}

/// The entries of a level; levels are counted from 1.
struct Fields<'v> {
    level: &'v Value,
    number: usize,
}

impl Fields<'_> {
    fn number(&self, name: &str) -> io::Result<f64> {
        let number = self.level.get(name).and_then(Value::as_f64);
        number.ok_or_else(|| self.missing(name, "a number"))
    }

    /// Returns an error; `null` stands for infinity.
    fn error(&self, name: &str) -> io::Result<f64> {
        match self.level.get(name) {
            Some(Value::Null) => Ok(f64::INFINITY),
            _ => self.number(name),
        }
    }

    fn count(&self, name: &str) -> io::Result<u64> {
        let count = self.level.get(name).and_then(Value::as_u64);
        count.ok_or_else(|| self.missing(name, "a count"))
    }

    fn missing(&self, name: &str, what: &str) -> io::Error {
        invalid(format!(
            "level {} has no '{name}' that is {what}",
            self.number
        ))
    }
}

fn invalid(reason: String) -> io::Error {
    io::Error::new(ErrorKind::InvalidData, reason)
}
