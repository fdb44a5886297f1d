//! A comparison as a table and as json.

use core::iter;
use std::io::Write;

use serde_json::{Map, Value, json};

use super::comparison::Comparison;
use super::difference::{Difference, Extra};
use super::finding::{counted, short};
use super::read::Compared;
use super::shown::{Entries, Shown, cells, object};
use crate::Each;
use crate::json::placed;
use crate::table::{Cell, FileFormat, NumberFormat, Table, WriteError};

/// The number of missing contacts, and of extra pairs, that the text shows.
const SHOWN: usize = 5;

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
/// The json is an array of one object with the same keys, `reason`, `shares`, `not_judged`, `scene_file` and
/// `largest_force`. Its entry `worst` is an object, and the
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
        match format {
            FileFormat::Json => {
                serde_json::to_writer_pretty(&mut *out, &json!([self.json()]))?;
                Ok(writeln!(out)?)
            }
            FileFormat::Csv => self.table().write(format, NumberFormat::F64, out),
            FileFormat::Text => self.write_text(out),
        }
    }

    fn write_text(self, out: &mut dyn Write) -> Result<(), WriteError> {
        let Self {
            comparison, accept, ..
        } = self;
        let verdict = if comparison.accepted(accept) {
            "yes"
        } else {
            "no"
        };
        let reason = comparison.reason(accept);
        writeln!(out, "{verdict}: {reason}")?;
        let findings = self.findings().into_iter();
        for finding in findings.filter(|finding| *finding != reason) {
            writeln!(out, "finding: {finding}")?;
        }
        let (missing, extra) = (comparison.missing(), comparison.extra(accept));
        list("missing", comparison.missing_contacts(), missing, out)?;
        list("extra", self.extra_pairs(), extra, out)?;
        if let Some(worst) = comparison.worst().filter(|worst| worst.error > 0.0) {
            writeln!(out, "worst: {worst}")?;
        }
        for (key, error) in [
            ("rms_error", comparison.rms_error()),
            ("floor_error", comparison.floor_error()),
            ("tangential_error", comparison.tangential_error()),
            ("floor_friction_error", comparison.floor_friction_error()),
            ("net_moment", self.net_moment()),
        ] {
            if let Some(error) = error.filter(|error| *error != 0.0) {
                writeln!(out, "{key}: {:?}", short(error))?;
            }
        }
        let [repeated, shares] = [comparison.repeated(), comparison.shares()];
        let noise = comparison.noise(accept);
        for (count, key, meaning) in [
            (repeated, "repeated", "rows list a contact again"),
            (
                shares,
                "shares",
                "rows are shares of a force, and were added up",
            ),
            (
                noise,
                "noise",
                "other pairs with a force below the accepted error",
            ),
        ] {
            if count > 0 {
                writeln!(out, "{key}: {count} {meaning}")?;
            }
        }
        let scene_file = self
            .scene_file
            .map(|file| format!("{file}, beside the table"));
        for (key, words) in [
            ("not_judged", self.not_judged()),
            ("frame", self.frame()),
            ("left_out", self.left_out()),
            ("table", self.kind()),
            ("step", self.step()),
            ("scene_file", scene_file),
        ] {
            if let Some(words) = words {
                writeln!(out, "{key}: {words}")?;
            }
        }
        Ok(())
    }

    /// Returns what the verdict says nothing about.
    fn not_judged(self) -> Option<String> {
        let (walls, fixed) = (self.walls(), self.comparison.fixed());
        let no_floor = u64::from(self.comparison.floor() == 0);
        let floor = if walls == 0 {
            "the forces of the floor, of which none is listed"
        } else {
            "the forces of the floor, of which none is compared"
        };
        let parts = [
            (walls, counted(walls, "contact") + " with walls"),
            (fixed, counted(fixed, "pair") + " of the bottom layer"),
            (no_floor, floor.to_owned()),
        ];
        let parts = parts.into_iter().filter(|(count, _)| *count > 0);
        let parts: Vec<_> = parts.map(|(_, part)| part).collect();
        Some(parts.join(", ")).filter(|parts| !parts.is_empty())
    }

    fn walls(self) -> u64 {
        self.file.map_or(0, |file| file.walls)
    }

    fn net_moment(self) -> Option<f64> {
        self.comparison.net_moment().map(|(_, moment)| moment)
    }

    fn findings(self) -> Vec<String> {
        let findings = self.comparison.findings(self.accept);
        findings.iter().map(ToString::to_string).collect()
    }

    fn frame(self) -> Option<String> {
        Some(self.file?.frame?.to_string())
    }

    fn left_out(self) -> Option<String> {
        let file = self.file?;
        let of_floor = file
            .floor_rows
            .iter()
            .map(|rows| ("table of the floor: ", rows));
        let tables = iter::once(("", &file.rows)).chain(of_floor);
        let parts = tables.map(|(table, rows)| (table, rows.to_string()));
        let parts = parts.filter(|(_, rows)| !rows.is_empty());
        let parts: Vec<_> = parts
            .map(|(table, rows)| table.to_owned() + &rows)
            .collect();
        Some(parts.join("; ")).filter(|parts| !parts.is_empty())
    }

    /// Returns the dialect of a text table, or the kind of another file.
    fn kind(self) -> Option<String> {
        let file = self.file?;
        let dialect = file.dialect.as_ref().map(ToString::to_string);
        Some(dialect.unwrap_or_else(|| file.kind.to_string()))
    }

    fn step(self) -> Option<String> {
        self.file?.step.clone()
    }

    /// Returns the record in three parts: the middle one is about friction.
    fn entries(self) -> [Entries; 3] {
        let Self {
            comparison,
            accept,
            file,
            ..
        } = self;
        let accepted = comparison.accepted(accept);
        let yes = if accepted { "yes" } else { "no" };
        let worst = comparison.worst();
        let worst_text = worst.map_or(Cell::Missing, |worst| Cell::Word(worst.to_string().into()));
        let findings = self.findings();
        let all_findings = match &findings[..] {
            [] => Cell::Missing,
            findings => Cell::Word(findings.join("; ").into()),
        };
        let friction = vec![
            ("tangential", Shown::count(comparison.tangential())),
            (
                "tangential_error",
                Shown::number(comparison.tangential_error()),
            ),
            (
                "floor_friction_error",
                Shown::number(comparison.floor_friction_error()),
            ),
            ("net_moment", Shown::number(self.net_moment())),
            (
                "net_moment_sphere",
                Shown::new(
                    None,
                    json!(comparison.net_moment().map(|(sphere, _)| sphere)),
                ),
            ),
        ];
        let first = vec![
            ("accepted", Shown::new(Cell::from(yes), json!(accepted))),
            ("reason", Shown::new(None, json!(comparison.reason(accept)))),
            ("accept", Shown::number(accept)),
            ("contacts", Shown::count(comparison.contacts())),
            ("matched", Shown::count(comparison.matched())),
            ("repeated", Shown::count(comparison.repeated())),
            ("shares", Shown::new(None, json!(comparison.shares()))),
            ("missing", Shown::count(comparison.missing())),
            ("extra", Shown::count(comparison.extra(accept))),
            ("noise", Shown::count(comparison.noise(accept))),
            ("fixed", Shown::count(comparison.fixed())),
            (
                "largest_force",
                Shown::new(None, json!(comparison.largest_force())),
            ),
            ("largest_error", Shown::number(comparison.largest_error())),
            ("rms_error", Shown::number(comparison.rms_error())),
            ("worst", Shown::new(worst_text, json!(worst.map(contact)))),
            ("beyond", Shown::count(comparison.beyond(accept))),
            ("factor", Shown::number(comparison.common_factor(accept))),
            ("walls", Shown::count(self.walls())),
            ("floor", Shown::count(comparison.floor())),
            ("floor_error", Shown::number(comparison.floor_error())),
        ];
        let unbalanced = file.map(|file| file.unbalanced.to_string());
        let last = vec![
            ("frame", Shown::text(self.frame())),
            ("unbalanced", Shown::text(unbalanced)),
            ("findings", Shown::new(all_findings, json!(findings))),
            ("not_judged", Shown::new(None, json!(self.not_judged()))),
            ("rows", Shown::count(file.map(|file| file.rows.used))),
            ("left_out", Shown::text(self.left_out())),
            ("table", Shown::text(self.kind())),
            ("step", Shown::text(self.step())),
            ("scene_file", Shown::new(None, json!(self.scene_file))),
        ];
        [first, friction, last]
    }

    fn table(self) -> Table<'static> {
        let [first, friction, last] = self.entries();
        let friction = Some(friction).filter(|_| self.comparison.has_friction());
        let parts = [Some(first), friction, Some(last)].into_iter().flatten();
        Table::record(parts.flat_map(cells).collect())
    }

    /// Returns the whole record. An infinite error is `null`.
    fn json(self) -> Map<String, Value> {
        let [first, friction, last] = self.entries();
        let mut record = object(first);
        let friction = Some(object(friction)).filter(|_| self.comparison.has_friction());
        record.insert("friction".to_owned(), json!(friction));
        record.extend(object(last));
        let missing = self.comparison.missing_contacts().iter().map(contact);
        record.insert("missing_contacts".to_owned(), missing.collect());
        let extra = self.extra_pairs().iter().map(pair);
        record.insert("extra_pairs".to_owned(), extra.collect());
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
            record.insert("source".to_owned(), origin);
        }
        record
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

fn contact(difference: &Difference) -> Value {
    let ([upper, lower], measured) = (difference.ids, difference.measured);
    let forces = json!({
        "direction": difference.direction.name(),
        "measured": measured.map(|measured| measured.force),
        "exact": difference.exact,
        "measured_vector": measured.and_then(|measured| measured.vector),
        "exact_vector": difference.exact_vector,
        "error": difference.error,
    });
    let ids = json!({"id1": upper, "id2": lower});
    placed(difference.dimension, ids, difference.site, forces)
}

fn pair(extra: &Extra) -> Value {
    let [first, second] = extra.ids;
    let place = |site| placed(extra.dimension, json!({}), site, json!({}));
    json!({
        "id1": first,
        "id2": second,
        "sites": extra.sites.each(place),
        "measured": extra.force,
        "error": extra.error,
    })
}
