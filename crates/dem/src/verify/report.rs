//! A comparison as a table and as json.

use crate::Each;
use std::io::Write;

use serde_json::{Value, json};

use super::comparison::Comparison;
use super::difference::{Difference, Extra};
use super::read::Compared;
use super::unbalanced::float;
use crate::table::{Cell, Column, FileFormat, NumberFormat, Table, WriteError};
use cannonpile::lattice::{Dimension, Site};

/// The number of missing contacts, and of extra pairs, that the text shows.
const SHOWN: usize = 5;

/// The report of a comparison at an accepted error.
///
/// Text and csv have one row: `accepted, accept, contacts, matched, repeated, missing, extra, noise, fixed,
/// largest_error, rms_error, worst, beyond, factor, walls, floor, floor_error, frame, unbalanced, findings,
/// rows, left_out, table, step`. On a rough floor, `tangential, tangential_error, floor_friction_error, net_moment` come after
/// `floor_error`. An error of nothing is missing, in json `null`. The text adds the meaning of each
/// count. It also lists the first missing contacts, and the extra pairs with the greatest forces.
///
/// The json is an array of one object with the same keys and `largest_force`. Its entry `worst` is an object, and the
/// arrays `missing_contacts` and `extra_pairs` have at most a thousand entries. An infinite error is `inf`, in json
/// `null`. On a rough floor, an object `friction` has those of tangential forces, and `net_moment_sphere`.
///
/// # Examples
/// ```
/// use cannonpile_dem::table::FileFormat;
/// use cannonpile::geometry::Spacing;
/// use cannonpile_dem::verify::{Comparison, Measured, Report};
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
/// let measured = [2, 3, 4].map(|id| Measured::new([1, id], 0.46225016352102427));
/// let comparison = Comparison::new(&packing, measured).unwrap();
/// let mut csv = Vec::new();
/// Report::new(&comparison, 0.0).write(FileFormat::Csv, &mut csv)?;
/// let csv = String::from_utf8(csv)?;
/// assert!(csv.lines().nth(1).unwrap().starts_with("yes,0.0,3,3,0,0,0,0,0,0.0,0.0,\"contact of sphere 1"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Report<'c> {
    comparison: &'c Comparison,
    accept: f64,
    file: Option<&'c Compared>,
    source: Option<&'c Source>,
}

/// The origin of the compared data, for a record that is kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// The scene, as TOML.
    pub scene: String,
    /// The name of the file.
    pub file: String,
    /// The length of the file, in bytes.
    pub bytes: u64,
    /// The SHA-256 digest of the file, in hexadecimal digits.
    pub sha256: String,
    /// The table of the floor, if there was one. Its scene is not used.
    pub floor: Option<Box<Self>>,
}

impl<'c> Report<'c> {
    /// Returns the report of a comparison at an accepted error.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table::FileFormat;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile_dem::verify::{Comparison, Measured, Report};
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let comparison = Comparison::new(&packing, [2, 3, 4].map(|id| Measured::new([1, id], 0.462)))?;
    /// for (accept, says) in [(1e-3, "yes,"), (1e-4, "no,")] {
    ///     let mut csv = Vec::new();
    ///     Report::new(&comparison, accept).write(FileFormat::Csv, &mut csv)?;
    ///     assert!(String::from_utf8(csv)?.lines().nth(1).unwrap().starts_with(says));
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn new(comparison: &'c Comparison, accept: f64) -> Self {
        Self {
            comparison,
            accept,
            file: None,
            source: None,
        }
    }

    /// Returns the report of a compared file, with its contacts with walls, its frame and its residual forces.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile_dem::table::FileFormat;
    /// use cannonpile_dem::verify::{Reader, Report};
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let reader = Reader::new().with_columns("id1=id1,id2=id2,force=force,kind=kind:pair".parse()?);
    /// let table = "id1,id2,force,kind\n1,2,0.46,pair\n1,3,0.46,pair\n1,4,0.46,pair\n4,0,1,wall\n";
    /// let read = reader.compare(&packing, table.as_bytes())?;
    /// let mut json = Vec::new();
    /// Report::of_file(&read, 0.01).write(FileFormat::Json, &mut json)?;
    /// assert!(String::from_utf8(json)?.contains("\"walls\": 1"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn of_file(file: &'c Compared, accept: f64) -> Self {
        let report = Self::new(&file.comparison, accept);
        Self {
            file: Some(file),
            ..report
        }
    }

    /// Returns the report with the origin of the data, which only json contains.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile_dem::table::FileFormat;
    /// use cannonpile_dem::verify::{Reader, Report, Source};
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let read = Reader::new().compare(&packing, &b"id1,id2,force\n1,2,1\n"[..])?;
    /// let source = Source {
    ///     scene: "layers = 2\n".into(),
    ///     file: "forces.csv".into(),
    ///     bytes: 20,
    ///     sha256: "23ae".into(),
    ///     floor: None,
    /// };
    /// let mut json = Vec::new();
    /// Report::of_file(&read, 0.01).with_source(&source).write(FileFormat::Json, &mut json)?;
    /// assert!(String::from_utf8(json)?.contains("\"scene\": \"layers = 2\\n\""));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn with_source(self, source: &'c Source) -> Self {
        Self {
            source: Some(source),
            ..self
        }
    }

    /// Writes the report.
    ///
    /// # Errors
    /// [`WriteError::Io`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table::FileFormat;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile_dem::verify::{Comparison, Measured, Report};
    /// use cannonpile::{Packing, Pile};
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let comparison = Comparison::new(&packing, [Measured::new([1, 3], 0.46)])?;
    /// let mut text = Vec::new();
    /// Report::new(&comparison, 0.01).write(FileFormat::Text, &mut text)?;
    /// let text = String::from_utf8(text)?;
    /// assert!(text.starts_with("accepted "));
    /// // The text lists each missing contact: those with spheres 2 and 4.
    /// assert_eq!(text.matches("\nmissing: contact of sphere 1 (k=0, i=0, j=0) with sphere ").count(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write(self, format: FileFormat, out: &mut dyn Write) -> Result<(), WriteError> {
        match format {
            FileFormat::Json => {
                serde_json::to_writer_pretty(&mut *out, &self.json())?;
                Ok(writeln!(out)?)
            }
            FileFormat::Csv => self.table().write(format, NumberFormat::F64, out),
            FileFormat::Text => {
                self.table().write(format, NumberFormat::F64, out)?;
                let (comparison, pairs) = (self.comparison, self.extra_pairs());
                let missing = comparison.missing_contacts();
                list("missing", missing, comparison.missing(), out)?;
                list("extra", pairs, comparison.extra(self.accept), out)
            }
        }
    }

    fn table(self) -> Table<'static> {
        let Self {
            comparison, accept, ..
        } = self;
        let accepted = comparison.accepted(accept);
        let count = |name, count: u64, meaning| (said(name, meaning), Cell::Integer(count.into()));
        let error = |name, error: Option<f64>, meaning| {
            let error = error.map_or(Cell::Missing, float);
            (Column::measured(name, meaning), error)
        };
        let measured = "contacts that were measured";
        let not_measured = "contacts with a force that were not";
        let repeated = "rows that list a pair a second time";
        let other = "other pairs with a force over accept times the largest";
        let lesser = "other pairs with a lesser force";
        let fixed = "pairs of the bottom layer, which are not judged";
        let relative = "of the exact force, of the largest one where that is 0";
        let beyond = "contacts with an error over accept";
        let times = "times the exact force is every one that was measured";
        let floor = "contacts with the floor whose normal forces are judged";
        let of_floor = "of the exact normal force of the floor";
        let factor = comparison.common_factor(accept);
        let factor = factor.map_or(Cell::Missing, float);
        let words =
            |words: Option<String>| words.map_or(Cell::Missing, |words| Cell::Word(words.into()));
        let findings: Vec<_> = comparison.findings(accept);
        let findings = findings.iter().map(ToString::to_string).collect::<Vec<_>>();
        let findings = Some(findings.join("; ")).filter(|findings| !findings.is_empty());
        let walls = self.file.map_or(0, |file| file.walls);
        let mut entries = vec![
            (
                Column::plain("accepted"),
                if accepted { "yes" } else { "no" }.into(),
            ),
            error("accept", Some(accept), ""),
            count("contacts", comparison.contacts(), ""),
            count("matched", comparison.matched(), measured),
            count("repeated", comparison.repeated(), repeated),
            count("missing", comparison.missing(), not_measured),
            count("extra", comparison.extra(accept), other),
            count("noise", comparison.noise(accept), lesser),
            count("fixed", comparison.fixed(), fixed),
            error("largest_error", comparison.largest_error(), relative),
            error("rms_error", comparison.rms_error(), relative),
            (
                Column::plain("worst"),
                words(comparison.worst().map(ToString::to_string)),
            ),
            count("beyond", comparison.beyond(accept), beyond),
            (Column::measured("factor", times), factor),
            count("walls", walls, "contacts with walls, which are not judged"),
            count("floor", comparison.floor(), floor),
            error("floor_error", comparison.floor_error(), of_floor),
        ];
        if comparison.has_friction() {
            let tangential = "contacts whose tangential forces are judged";
            let of_tangential = "of the exact tangential force, of the largest one where that is 0";
            let moment = comparison.net_moment().map(|(_, moment)| moment);
            entries.extend([
                count("tangential", comparison.tangential(), tangential),
                error(
                    "tangential_error",
                    comparison.tangential_error(),
                    of_tangential,
                ),
                error(
                    "floor_friction_error",
                    comparison.floor_friction_error(),
                    of_tangential,
                ),
                error(
                    "net_moment",
                    moment,
                    "R times the largest tangential force, on one sphere",
                ),
            ]);
        }
        entries.extend([
            (Column::plain("frame"), words(self.frame())),
            (Column::plain("unbalanced"), words(self.unbalanced())),
            (Column::plain("findings"), words(findings)),
            (said("rows", "rows that were compared"), self.rows()),
            (Column::plain("left_out"), words(self.left_out())),
            (Column::plain("table"), words(self.kind())),
            (Column::plain("step"), words(self.step())),
        ]);
        Table::record(entries)
    }

    /// Returns the number of rows that were compared.
    fn rows(self) -> Cell {
        let rows = self.file.map(|file| Cell::Integer(file.rows.used.into()));
        rows.unwrap_or(Cell::Missing)
    }

    /// Returns the rows that were left out, and why.
    fn left_out(self) -> Option<String> {
        let words = self.file?.rows.to_string();
        Some(words).filter(|words| !words.is_empty())
    }

    /// Returns the kind of the file and the dialect of a text table.
    fn kind(self) -> Option<String> {
        let file = self.file?;
        Some(match &file.dialect {
            Some(dialect) => dialect.to_string(),
            None => file.kind.to_string(),
        })
    }

    /// Returns the step that was read.
    fn step(self) -> Option<String> {
        self.file?.step.clone()
    }

    /// Returns the frame of the table, if it differs from that of the scene.
    fn frame(self) -> Option<String> {
        self.file?.frame.map(|frame| frame.to_string())
    }

    /// Returns the greatest residual force.
    fn unbalanced(self) -> Option<String> {
        let unbalanced = self.file?.unbalanced.as_ref()?;
        Some(unbalanced.to_string())
    }

    fn json(self) -> Value {
        let Self {
            comparison, accept, ..
        } = self;
        let missing = comparison.missing_contacts();
        let findings: Vec<_> = comparison.findings(accept);
        let mut record = json!({
            "accepted": comparison.accepted(accept),
            "accept": accept,
            "contacts": comparison.contacts(),
            "matched": comparison.matched(),
            "repeated": comparison.repeated(),
            "missing": comparison.missing(),
            "extra": comparison.extra(accept),
            "noise": comparison.noise(accept),
            "fixed": comparison.fixed(),
            "largest_force": comparison.largest_force(),
            "largest_error": comparison.largest_error(),
            "rms_error": comparison.rms_error(),
            "worst": comparison.worst().map(contact),
            "beyond": comparison.beyond(accept),
            "factor": comparison.common_factor(accept),
            "walls": self.file.map_or(0, |file| file.walls),
            "floor": comparison.floor(),
            "floor_error": comparison.floor_error(),
            "frame": self.frame(),
            "unbalanced": self.unbalanced(),
            "findings": findings.iter().map(ToString::to_string).collect::<Vec<_>>(),
            "rows": self.file.map(|file| file.rows.used),
            "left_out": self.left_out(),
            "table": self.kind(),
            "step": self.step(),
            "missing_contacts": missing.iter().map(contact).collect::<Vec<_>>(),
            "extra_pairs": self.extra_pairs().iter().map(pair).collect::<Vec<_>>(),
        });
        let Value::Object(entries) = &mut record else {
            return Value::Array(vec![record]);
        };
        if comparison.has_friction() {
            let moment = comparison.net_moment();
            let friction = json!({
                "tangential": comparison.tangential(),
                "tangential_error": comparison.tangential_error(),
                "floor_friction_error": comparison.floor_friction_error(),
                "net_moment": moment.map(|(_, moment)| moment),
                "net_moment_sphere": moment.map(|(sphere, _)| sphere),
            });
            entries.insert("friction".into(), friction);
        }
        if let Some(source) = self.source {
            let of = |source: &Source| {
                json!({
                    "file": source.file,
                    "bytes": source.bytes,
                    "sha256": source.sha256,
                })
            };
            let mut origin = of(source);
            origin["version"] = env!("CARGO_PKG_VERSION").into();
            origin["scene"] = source.scene.clone().into();
            if let Some(floor) = &source.floor {
                origin["floor"] = of(floor);
            }
            entries.insert("source".into(), origin);
        }
        Value::Array(vec![record])
    }

    /// Returns the pairs without a contact whose force is more than noise.
    fn extra_pairs(self) -> &'c [Extra] {
        let pairs = self.comparison.extra_pairs();
        let extra = pairs.partition_point(|pair| pair.error > self.accept);
        // A partition point is at most the length.
        &pairs[..extra]
    }
}

/// Writes a few of many items, one for each line.
fn list<T: ToString>(
    what: &str,
    items: &[T],
    count: u64,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let mut left = count;
    for item in items.iter().take(SHOWN) {
        writeln!(out, "{what}: {}", item.to_string())?;
        left = left.saturating_sub(1);
    }
    if left > 0 {
        writeln!(out, "{what}: {left} more")?;
    }
    Ok(())
}

/// Returns a column with its meaning.
fn said(name: &'static str, meaning: &'static str) -> Column {
    Column {
        quantity: false,
        ..Column::measured(name, meaning)
    }
}

fn contact(difference: &Difference) -> Value {
    let ([upper, lower], measured) = (difference.ids, difference.measured);
    let [k, i, j] = indices(difference.site);
    let contact = json!({
        "id1": upper,
        "id2": lower,
        "k": k,
        "i": i,
        "j": j,
        "direction": difference.direction.name(),
        "measured": measured.map(|measured| measured.force),
        "exact": difference.exact,
        "measured_vector": measured.and_then(|measured| measured.vector),
        "exact_vector": difference.exact_vector,
        "error": difference.error,
    });
    without_j(contact, difference.dimension)
}

fn pair(extra: &Extra) -> Value {
    let [first, second] = extra.ids;
    let sites = extra.sites.each(|site| {
        let [k, i, j] = indices(site);
        without_j(json!({ "k": k, "i": i, "j": j }), extra.dimension)
    });
    json!({
        "id1": first,
        "id2": second,
        "sites": sites,
        "measured": extra.force,
        "error": extra.error,
    })
}

/// Returns k, i and j. An index beyond 2^53 is a string, because many readers store numbers as floats: a pile with few
/// contacts may have one very wide layer.
fn indices(Site { i, j, k }: Site) -> [Value; 3] {
    [k, i, j].each(|index| match i64::try_from(index) {
        Ok(small) if small.unsigned_abs() >> 53 == 0 => small.into(),
        _ => index.to_string().into(),
    })
}

/// Removes j for discs.
fn without_j(mut place: Value, dimension: Dimension) -> Value {
    if let (Dimension::Two, Value::Object(entries)) = (dimension, &mut place) {
        entries.shift_remove("j");
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_that_no_float_holds_are_strings() {
        let (i, j, k) = (1 << 53, 1 - (1 << 53), 1 << 100);
        let said = Value::from(indices(Site { i, j, k }).to_vec()).to_string();
        let want = "[\"1267650600228229401496703205376\",\"9007199254740992\",-9007199254740991]";
        assert_eq!(said, want);
    }
}
