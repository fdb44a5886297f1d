//! A comparison as a table and as json.

use crate::Each;
use std::io::Write;

use serde_json::{Value, json};

use super::comparison::Comparison;
use super::difference::{Difference, Extra};
use super::finding::{counted, short};
use super::read::Compared;
use super::unbalanced::float;
use crate::table::{Cell, Column, FileFormat, NumberFormat, Table, WriteError};
use cannonpile::lattice::{Dimension, Site};

/// The number of missing contacts, and of extra pairs, that the text shows.
const SHOWN: usize = 5;

const INFINITE: &str = "inf";

/// The entries of the csv, around those of a rough floor.
const FIRST: &str = "accepted accept contacts matched repeated missing extra noise fixed largest_error rms_error worst \
    beyond factor walls floor floor_error";
const FRICTION: &str = "tangential tangential_error floor_friction_error net_moment";
const LAST: &str = "frame unbalanced findings rows left_out table step";

/// The entries of the text that are not 0.
const LINES: &str = "rms_error floor_error tangential_error floor_friction_error net_moment repeated shares noise \
    not_judged frame left_out table step scene_file";

/// The report of a comparison at an accepted error.
///
/// The first line of the text is the verdict with its reason. Each other line says something else: a finding, the first missing
/// contacts, the extra pairs with the greatest forces, the worst contact, what was not judged, and so on.
///
/// Csv has one row: `accepted, accept, contacts, matched, repeated, missing, extra, noise, fixed,
/// largest_error, rms_error, worst, beyond, factor, walls, floor, floor_error, frame, unbalanced, findings,
/// rows, left_out, table, step`. On a rough floor, `tangential, tangential_error, floor_friction_error, net_moment` come after
/// `floor_error`. An error of nothing is missing, in json `null`.
///
/// The json is an array of one object with the same keys, `reason`, `shares`, `scene_file` and `largest_force`. Its entry `worst` is an object, and the
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
    scene_file: Option<&'c str>,
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
            scene_file: None,
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

    /// Returns the report with the name of the file with the scene, if the user did not give it.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::table::FileFormat;
    /// use cannonpile_dem::verify::{Comparison, Measured, Report};
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// let comparison = Comparison::new(&packing, [Measured::new([1, 3], 0.46)])?;
    /// let mut text = Vec::new();
    /// Report::new(&comparison, 0.01).with_scene_file(Some("pile/scene.toml")).write(FileFormat::Text, &mut text)?;
    /// assert!(String::from_utf8(text)?.ends_with("\nscene_file: pile/scene.toml, beside the table\n"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn with_scene_file(self, scene_file: Option<&'c str>) -> Self {
        Self { scene_file, ..self }
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
    /// assert!(text.starts_with("no: 2 of 3 contacts are missing\n"));
    /// // The text lists each missing contact: those with spheres 2 and 4.
    /// assert_eq!(text.matches("\nmissing: contact of sphere 1 (k=0, i=0, j=0) with sphere ").count(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn write(self, format: FileFormat, out: &mut dyn Write) -> Result<(), WriteError> {
        let record = self.record();
        match format {
            FileFormat::Json => {
                serde_json::to_writer_pretty(&mut *out, &self.json(record))?;
                Ok(writeln!(out)?)
            }
            FileFormat::Csv => self.table(&record).write(format, NumberFormat::F64, out),
            FileFormat::Text => self.write_text(&record, out),
        }
    }

    fn write_text(self, record: &Value, out: &mut dyn Write) -> Result<(), WriteError> {
        let comparison = self.comparison;
        let verdict = if record["accepted"] == true {
            "yes"
        } else {
            "no"
        };
        let reason = record["reason"].as_str().unwrap_or_default();
        writeln!(out, "{verdict}: {reason}")?;
        let findings = comparison
            .findings(self.accept)
            .into_iter()
            .map(|finding| finding.to_string());
        for finding in findings.filter(|finding| finding != reason) {
            writeln!(out, "finding: {finding}")?;
        }
        let (missing, extra) = (comparison.missing(), comparison.extra(self.accept));
        list("missing", comparison.missing_contacts(), missing, out)?;
        list("extra", self.extra_pairs(), extra, out)?;
        if let Some(worst) = comparison.worst().filter(|worst| worst.error > 0.0) {
            writeln!(out, "worst: {worst}")?;
        }
        for key in LINES.split_whitespace() {
            let meaning = match key {
                "repeated" => " rows list a contact again",
                "shares" => " rows are shares of a force, and were added up",
                "noise" => " other pairs with a force below the accepted error",
                "scene_file" => ", beside the table",
                _ => "",
            };
            let words = match value(record, key) {
                Value::String(words) => words.clone(),
                Value::Number(number) => match number.as_u64() {
                    Some(count) => count.to_string(),
                    None => format!("{:?}", short(number.as_f64().unwrap_or_default())),
                },
                _ => continue,
            };
            if words != "0" && words != "0.0" {
                writeln!(out, "{key}: {words}{meaning}")?;
            }
        }
        Ok(())
    }

    /// Returns what the verdict says nothing about.
    fn not_judged(self) -> Option<String> {
        let (walls, fixed) = (self.walls(), self.comparison.fixed());
        let no_floor = u64::from(self.comparison.floor() == 0);
        let parts = [
            (walls, counted(walls, "contact") + " with walls"),
            (fixed, counted(fixed, "pair") + " of the bottom layer"),
            (
                no_floor,
                "the forces of the floor, of which none is listed".into(),
            ),
        ];
        let parts = parts.into_iter().filter(|(count, _)| *count > 0);
        let parts: Vec<_> = parts.map(|(_, part)| part).collect();
        Some(parts.join(", ")).filter(|parts| !parts.is_empty())
    }

    fn walls(self) -> u64 {
        self.file.map_or(0, |file| file.walls)
    }

    fn table(self, record: &Value) -> Table<'static> {
        let friction = if self.comparison.has_friction() {
            FRICTION
        } else {
            ""
        };
        let keys = [FIRST, friction, LAST]
            .into_iter()
            .flat_map(str::split_whitespace);
        let entries = keys.map(|key| {
            let word = |text: String| Cell::Word(text.into());
            let cell = match value(record, key) {
                Value::Null => Cell::Missing,
                Value::Bool(is) => if *is { "yes" } else { "no" }.into(),
                Value::Number(number) => match number.as_u64() {
                    Some(count) => Cell::Integer(count.into()),
                    None => float(number.as_f64().unwrap_or_default()),
                },
                Value::String(text) => word(text.clone()),
                Value::Array(findings) if findings.is_empty() => Cell::Missing,
                Value::Array(findings) => {
                    let findings = findings.iter().filter_map(Value::as_str);
                    word(findings.collect::<Vec<_>>().join("; "))
                }
                Value::Object(_) => word(
                    self.comparison
                        .worst()
                        .map_or(String::new(), ToString::to_string),
                ),
            };
            (Column::plain(key), cell)
        });
        Table::record(entries.collect())
    }

    /// Returns the whole record. An infinite error is `inf`.
    fn record(self) -> Value {
        let Self {
            comparison, accept, ..
        } = self;
        let error = |error: Option<f64>| match error {
            Some(error) if error.is_infinite() => INFINITE.into(),
            error => json!(error),
        };
        let file = self.file;
        let findings: Vec<_> = comparison.findings(accept);
        let moment = comparison.net_moment();
        let friction = json!({
            "tangential": comparison.tangential(),
            "tangential_error": error(comparison.tangential_error()),
            "floor_friction_error": error(comparison.floor_friction_error()),
            "net_moment": error(moment.map(|(_, moment)| moment)),
            "net_moment_sphere": moment.map(|(sphere, _)| sphere),
        });
        json!({
            "accepted": comparison.accepted(accept),
            "reason": comparison.reason(accept),
            "accept": accept,
            "contacts": comparison.contacts(),
            "matched": comparison.matched(),
            "repeated": comparison.repeated(),
            "shares": comparison.shares(),
            "missing": comparison.missing(),
            "extra": comparison.extra(accept),
            "noise": comparison.noise(accept),
            "fixed": comparison.fixed(),
            "largest_force": comparison.largest_force(),
            "largest_error": error(comparison.largest_error()),
            "rms_error": error(comparison.rms_error()),
            "worst": comparison.worst().map(contact),
            "beyond": comparison.beyond(accept),
            "factor": comparison.common_factor(accept),
            "walls": self.walls(),
            "floor": comparison.floor(),
            "floor_error": error(comparison.floor_error()),
            "friction": Some(friction).filter(|_| comparison.has_friction()),
            "frame": file.and_then(|file| file.frame).map(|frame| frame.to_string()),
            "unbalanced": file.map(|file| file.unbalanced.to_string()),
            "findings": findings.iter().map(ToString::to_string).collect::<Vec<_>>(),
            "not_judged": self.not_judged(),
            "rows": file.map(|file| file.rows.used),
            "left_out": file.map(|file| file.rows.to_string()).filter(|rows| !rows.is_empty()),
            "table": file.map(|file| match &file.dialect {
                Some(dialect) => dialect.to_string(),
                None => file.kind.to_string(),
            }),
            "step": file.and_then(|file| file.step.clone()),
            "scene_file": self.scene_file,
        })
    }

    fn json(self, mut record: Value) -> Value {
        let missing = self.comparison.missing_contacts();
        record["missing_contacts"] = missing.iter().map(contact).collect();
        record["extra_pairs"] = self.extra_pairs().iter().map(pair).collect();
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
            record["source"] = origin;
        }
        without_infinite(&mut record);
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

/// Returns an entry of a record, or one of its entries for a rough floor.
fn value<'r>(record: &'r Value, key: &str) -> &'r Value {
    record["friction"].get(key).unwrap_or(&record[key])
}

/// Replaces infinite errors by null.
fn without_infinite(record: &mut Value) {
    for (_, value) in record.as_object_mut().into_iter().flatten() {
        without_infinite(value);
        if value == INFINITE {
            *value = Value::Null;
        }
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
