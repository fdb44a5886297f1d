//! A comparison as a table, and as json.

use std::io::Write;

use num_rational::BigRational;
use serde_json::{Map, Value, json};

use super::comparison::Comparison;
use super::difference::{Difference, Extra};
use crate::lattice::{Dimension, Site};
use crate::table::{Cell, Column, FileFormat, NumberFormat, Table, WriteError};

/// How many missing and how many extra contacts the text shows.
const SHOWN: usize = 5;

/// What a comparison says at an accepted error.
///
/// As text and csv one row: `accepted, accept, contacts, matched, missing, extra, noise, fixed, largest_error, rms_error,
/// worst, beyond, factor`; in the text what they count stands behind them, and it goes on with the first of the missing and the greatest of the extra contacts. As json an array of one
/// object with the same keys and `largest_force`; `worst` is an object, and up to a thousand of each are in the arrays
/// `missing_contacts` and `extra_pairs`. An infinite error is `inf`, in json `null`.
///
/// # Examples
/// ```
/// use cannonpile::table::FileFormat;
/// use cannonpile::geometry::Spacing;
/// use cannonpile::verify::{Comparison, Measured, Report};
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
/// assert!(csv.lines().nth(1).unwrap().starts_with("yes,0.0,3,3,0,0,0,0,0.0,0.0,\"contact of sphere 1"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Report<'c> {
    comparison: &'c Comparison,
    accept: f64,
}

impl<'c> Report<'c> {
    /// The report at an accepted error.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::table::FileFormat;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::verify::{Comparison, Measured, Report};
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
        Self { comparison, accept }
    }

    /// Writes it.
    ///
    /// # Errors
    /// [`WriteError::Io`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile::table::FileFormat;
    /// use cannonpile::geometry::Spacing;
    /// use cannonpile::verify::{Comparison, Measured, Report};
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
    /// // Those with spheres 2 and 4, a line each.
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
                let comparison = self.comparison;
                let missing = comparison.missing_contacts();
                list("missing", missing, comparison.missing(), out)?;
                list(
                    "extra",
                    self.extra_pairs(),
                    comparison.extra(self.accept),
                    out,
                )
            }
        }
    }

    fn table(self) -> Table<'static> {
        let Self { comparison, accept } = self;
        let accepted = if comparison.accepted(accept) {
            "yes"
        } else {
            "no"
        };
        let worst = comparison.worst().map(ToString::to_string);
        let worst = worst.map_or(Cell::Missing, |words| Cell::Word(words.into()));
        let count = |name, count: u64, meaning| (said(name, meaning), Cell::Integer(count.into()));
        let error = |name, error: f64, meaning| (Column::measured(name, meaning), float(error));
        let relative = "of the exact force, of the largest one where that is 0";
        let factor = comparison.common_factor(accept);
        Table::record(vec![
            (Column::plain("accepted"), accepted.into()),
            error("accept", accept, ""),
            count("contacts", comparison.contacts(), ""),
            count(
                "matched",
                comparison.matched(),
                "contacts that were measured",
            ),
            count(
                "missing",
                comparison.missing(),
                "contacts with a force that were not",
            ),
            count(
                "extra",
                comparison.extra(accept),
                "other pairs with a force over accept times the largest",
            ),
            count(
                "noise",
                comparison.noise(accept),
                "other pairs with a lesser force",
            ),
            count(
                "fixed",
                comparison.fixed(),
                "pairs of the bottom layer, which are not judged",
            ),
            error("largest_error", comparison.largest_error(), relative),
            error("rms_error", comparison.rms_error(), relative),
            (Column::plain("worst"), worst),
            count(
                "beyond",
                comparison.beyond(accept),
                "contacts with an error over accept",
            ),
            (
                Column::measured(
                    "factor",
                    "times the exact force is every one that was measured",
                ),
                factor.map_or(Cell::Missing, float),
            ),
        ])
    }

    fn json(self) -> Value {
        let Self { comparison, accept } = self;
        let missing = comparison.missing_contacts();
        json!([{
            "accepted": comparison.accepted(accept),
            "accept": accept,
            "contacts": comparison.contacts(),
            "matched": comparison.matched(),
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
            "missing_contacts": missing.iter().map(contact).collect::<Vec<_>>(),
            "extra_pairs": self.extra_pairs().iter().map(pair).collect::<Vec<_>>(),
        }])
    }

    /// Those of the pairs without a contact that are no noise.
    fn extra_pairs(self) -> &'c [Extra] {
        let pairs = self.comparison.extra_pairs();
        let extra = pairs.partition_point(|pair| pair.error > self.accept);
        pairs.get(..extra).unwrap_or_default()
    }
}

/// A few of many, a line each.
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

/// A column with what it counts.
fn said(name: &'static str, meaning: &'static str) -> Column {
    Column {
        quantity: false,
        ..Column::measured(name, meaning)
    }
}

/// A float as the exact number it is.
fn float(x: f64) -> Cell {
    let exact = BigRational::from_float(x);
    exact.map_or(Cell::Word("inf".into()), Cell::from)
}

fn contact(difference: &Difference) -> Value {
    let [upper, lower] = difference.ids;
    let mut object = Map::new();
    object.insert("id1".into(), upper.into());
    object.insert("id2".into(), lower.into());
    object.extend(place(difference.site, difference.dimension));
    let measured = difference.measured;
    let vector = |vector: Option<[f64; 3]>| vector.map(Vec::from);
    let entries = [
        ("direction", difference.direction.name().into()),
        ("measured", measured.map(|measured| measured.force).into()),
        ("exact", difference.exact.into()),
        (
            "measured_vector",
            vector(measured.and_then(|measured| measured.vector)).into(),
        ),
        ("exact_vector", vector(difference.exact_vector).into()),
        ("error", difference.error.into()),
    ];
    let entries = entries.map(|(name, value)| (name.to_owned(), value));
    object.extend(entries);
    object.into()
}

fn pair(extra: &Extra) -> Value {
    let [first, second] = extra.ids;
    let sites = extra.sites.map(|site| {
        let place: Map<String, Value> = place(site, extra.dimension).collect();
        place
    });
    json!({
        "id1": first,
        "id2": second,
        "sites": sites,
        "measured": extra.force,
        "error": extra.error,
    })
}

/// k, i, and j of spheres.
fn place(site: Site, dimension: Dimension) -> impl Iterator<Item = (String, Value)> {
    let Site { i, j, k } = site;
    let j = (dimension == Dimension::Three).then_some(("j", j));
    let places = [("k", k), ("i", i)].into_iter().chain(j);
    // Of a pile of so few contacts; a single layer may be wide.
    places.map(|(name, place)| (name.to_owned(), i64::try_from(place).ok().into()))
}
