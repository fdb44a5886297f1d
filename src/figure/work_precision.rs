//! Run time against error, both logarithmic: a panel for each pile, a mark for each method in each scalar.

mod marks;
mod panels;

use csv::{ReaderBuilder, StringRecord};

use super::Drawing;
use crate::Error;

/// Measured run times and errors of ways to compute the forces of some piles.
///
/// No error is clamped: a logarithm has no place for 0, so exact answers stand in a column of their own, marked 0.
///
/// # Examples
/// ```
/// use cannonpile::figure::WorkPrecision;
///
/// let measured = WorkPrecision::read(
///     "pile,contacts,method,scalar,seconds,relative_error\n\
///      10 layers,495,sparse LU,f64,6.3e-4,1.2e-15\n\
///      10 layers,495,transfer,BigRational,9.0e-5,0\n",
/// )?;
/// assert_eq!(measured.runs.len(), 2);
/// assert!(measured.drawing().to_string().contains("sparse LU, f64"));
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct WorkPrecision {
    /// The runs that have numbers, in the order of the table.
    pub runs: Vec<MeasuredRun>,
}

/// A way to all contact forces of a pile, and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredRun {
    /// The pile, in words.
    pub pile: String,
    /// The number of its contacts, as it was written.
    pub contacts: String,
    /// How the forces were found.
    pub method: String,
    /// In which numbers.
    pub scalar: String,
    /// The run time, positive.
    pub seconds: f64,
    /// The greatest error of a force over the greatest force; 0 if all are exact.
    pub error: f64,
}

/// What a table must look like.
const TABLE: &str = "a table of run times: comma-separated values with the columns pile, contacts, method, scalar, \
                     seconds and relative_error, as benches/work_precision writes it";

/// The most runs, of all piles together.
const LIMIT: usize = 10_000;

/// The most piles: each has a panel.
const MOST_PILES: usize = 24;

impl WorkPrecision {
    /// From a table with the columns `pile, contacts, method, scalar, seconds, relative_error`, in any order and among
    /// others. Rows without a time and an error are left out.
    ///
    /// # Errors
    /// [`Error::Syntax`] for a table without these columns or without a run, and for numbers that are none;
    /// [`Error::TooManyMarks`] for more than 10 000 runs or 24 piles.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Error;
    /// use cannonpile::figure::WorkPrecision;
    ///
    /// let refused = WorkPrecision::read("pile,method\n");
    /// assert!(matches!(refused, Err(Error::Syntax { .. })));
    /// ```
    pub fn read(csv: &str) -> Result<Self, Error> {
        let not_a_table = |line: &str| Error::syntax(line, TABLE);
        let first = csv.lines().next().unwrap_or("");
        let mut table = ReaderBuilder::new().from_reader(csv.as_bytes());
        let heads = table.headers().map_err(|_| not_a_table(first))?.clone();
        let column = |name: &str| {
            let found = heads.iter().position(|head| head.trim() == name);
            found.ok_or_else(|| not_a_table(first))
        };
        let columns = [
            column("pile")?,
            column("contacts")?,
            column("method")?,
            column("scalar")?,
        ];
        let numbers = [column("seconds")?, column("relative_error")?];
        let mut runs = Vec::new();
        for record in table.records() {
            let record = record.map_err(|_| not_a_table(first))?;
            runs.extend(run(&record, columns, numbers)?);
            if runs.len() > LIMIT {
                return Err(crowded(runs.len(), LIMIT, "runs", "leave some out"));
            }
        }
        if runs.is_empty() {
            return Err(not_a_table(first));
        }
        let measured = Self { runs };
        let piles = measured.piles().len();
        if piles > MOST_PILES {
            return Err(crowded(piles, MOST_PILES, "piles", "leave some out"));
        }
        Ok(measured)
    }

    /// The piles, in the order in which they come first.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::WorkPrecision;
    ///
    /// let measured = WorkPrecision::read(
    ///     "pile,contacts,method,scalar,seconds,relative_error\n\
    ///      HCP,495,transfer,f64,1.0e-6,2e-16\n\
    ///      FCC,495,transfer,f64,8.0e-6,3e-16\n\
    ///      HCP,495,transfer,BigRational,9.0e-5,0\n",
    /// )?;
    /// assert_eq!(measured.piles(), ["HCP", "FCC"]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn piles(&self) -> Vec<&str> {
        distinct(self.runs.iter().map(|run| run.pile.as_str()))
    }

    /// The figure.
    ///
    /// Marks are `<g class="mark" data-seconds="…" data-error="…">`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::figure::WorkPrecision;
    ///
    /// let measured = WorkPrecision::read(
    ///     "pile,contacts,method,scalar,seconds,relative_error\n\
    ///      10 layers,495,transfer,f64,1.0e-6,2e-16\n\
    ///      20 layers,3990,transfer,f64,8.0e-6,3e-16\n\
    ///      10 layers,495,transfer,BigRational,9.0e-5,0\n",
    /// )?;
    /// let svg = measured.drawing().to_string();
    /// // A panel for each pile, a mark for each run.
    /// assert_eq!(svg.matches("class=\"frame\"").count(), 2);
    /// assert_eq!(svg.matches("class=\"mark\"").count(), 3);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn drawing(&self) -> Drawing {
        panels::draw(self)
    }

    /// The methods in their scalars, by method.
    fn keys(&self) -> Vec<(&str, &str)> {
        let methods = distinct(self.runs.iter().map(|run| run.method.as_str()));
        let of_method = |method| {
            let runs = self.runs.iter().filter(move |run| run.method == method);
            let scalars = distinct(runs.map(|run| run.scalar.as_str()));
            scalars.into_iter().map(move |scalar| (method, scalar))
        };
        methods.into_iter().flat_map(of_method).collect()
    }
}

/// Each once, in the order in which they come first.
fn distinct<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut found = Vec::new();
    for name in names {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

/// A row, if it has numbers.
fn run(
    record: &StringRecord,
    names: [usize; 4],
    numbers: [usize; 2],
) -> Result<Option<MeasuredRun>, Error> {
    let [pile, contacts, method, scalar] = names.map(|n| printable(record.get(n).unwrap_or("")));
    let [seconds, error] = numbers.map(|n| record.get(n).unwrap_or("").trim());
    if seconds.is_empty() && error.is_empty() {
        return Ok(None);
    }
    let number = |text: &str, least: f64, expected| {
        let number = text.parse::<f64>().ok().filter(|x| x.is_finite());
        number
            .filter(|x| *x >= least)
            .ok_or_else(|| Error::syntax(text, expected))
    };
    let seconds = number(
        seconds,
        f64::MIN_POSITIVE,
        "a run time in seconds: a positive number, as 1.5e-3",
    )?;
    let error = number(
        error,
        0.0,
        "a relative error: 0 or a positive number, as 1e-15",
    )?;
    Ok(Some(MeasuredRun {
        pile,
        contacts,
        method,
        scalar,
        seconds,
        error,
    }))
}

/// What may stand in a document, and is not too long for a title.
fn printable(text: &str) -> String {
    const LONGEST: usize = 44;
    let plain = |c: char| {
        if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') {
            ' '
        } else {
            c
        }
    };
    let mut printable: String = text.chars().take(LONGEST).map(plain).collect();
    if text.chars().nth(LONGEST).is_some() {
        printable.push('…');
    }
    printable
}

fn crowded(marks: usize, limit: usize, what: &'static str, remedy: &'static str) -> Error {
    Error::TooManyMarks {
        marks: marks.into(),
        what,
        limit: u32::try_from(limit).unwrap_or(u32::MAX),
        remedy,
    }
}
