//! Options that several commands share.

mod scene;
mod stackings;

use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};

use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile::{Method, Pile};
use cannonpile_dem::scene::{Scene, parse};
use cannonpile_dem::table::{FileFormat, NumberFormat, Table, Units, WriteError};
use clap::{Args, ValueEnum};
use num_bigint::BigUint;

use crate::output::{
    Failure, InputError, creates_folder_of, print_message, write_around, write_to,
};
use crate::progress::Progress;
use crate::tables::Work;
use crate::{Culprit, Error};
pub(crate) use scene::{SceneOptions, Top, in_state, shape};

/// The option `--at`, for one sphere of the base.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct BasePart {
    /// One bottom sphere: I,J or K,I,J with k from 0 at the top (discs: I or K,I) [default: all]
    #[arg(long, value_name = "I,J", allow_hyphen_values = true)]
    at: Option<String>,
}

impl BasePart {
    pub(crate) fn selection(&self, pile: &Pile) -> Result<Selection, InputError> {
        let site = parse_site(self.at.as_deref(), pile)?;
        Ok(site.map_or(Selection::Base, Selection::One))
    }
}

/// The options `--at` and `--layer`, which select a part of the pile.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct Part {
    /// One sphere: K,I,J with k from 0 at the top, or I,J on the base (discs: K,I or I) [default: all]
    #[arg(
        long,
        value_name = "K,I,J",
        allow_hyphen_values = true,
        conflicts_with = "layer"
    )]
    at: Option<String>,
    /// One layer, counted from 0 at the top [default: all]
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = parse::integer)]
    layer: Option<i128>,
}

impl Part {
    pub(crate) fn selection(&self, pile: &Pile) -> Result<Selection, InputError> {
        let whole = self.layer.map_or(Selection::All, Selection::Layer);
        let site = parse_site(self.at.as_deref(), pile)?;
        Ok(site.map_or(whole, Selection::One))
    }
}

/// Returns the number of spheres in a part of the pile.
pub(crate) fn spheres(pile: &Pile, selection: Selection) -> Result<BigUint, Error> {
    Ok(match selection {
        Selection::All => pile.sphere_count(),
        Selection::Base => pile.base_sphere_count(),
        Selection::Layer(k) => pile.shape().layer(k)?.site_count(),
        Selection::One(_) => BigUint::from(1_u32),
    })
}

/// Parses the value of `--at` and checks that the pile has this sphere.
pub(crate) fn parse_site(at: Option<&str>, pile: &Pile) -> Result<Option<Site>, InputError> {
    let Some(text) = at else { return Ok(None) };
    let at = parse::at(text, pile.dimension());
    let at = at.map_err(|error| InputError::of(Culprit::Site, error))?;
    let site = pile.shape().check(at.site(pile.layers()));
    let site = site.map_err(|error| InputError::of(Culprit::Site, error))?;
    Ok(Some(site))
}

/// Adds the options that select fewer rows to an error about too many rows.
pub(crate) fn with_row_options(error: impl Into<Error>, selection: Selection) -> InputError {
    match selection {
        Selection::All => InputError::of_rows(error, "--layer or --at"),
        Selection::Layer(_) | Selection::Base => InputError::of_rows(error, "--at"),
        Selection::One(_) => InputError::from(error),
    }
}

/// The options `--number` and `--units`.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct Numbers {
    /// Format of numbers
    #[arg(long, value_enum, default_value = "exact")]
    pub(crate) number: Number,
    /// Units of forces and lengths
    #[arg(long, value_enum, default_value = "pile")]
    pub(crate) units: UnitSystem,
}

/// The option `--explain`.
#[derive(Args)]
pub(crate) struct ExplainOption {
    /// Say on stderr how many spheres are visited, and why
    #[arg(long, help_heading = "Output")]
    explain: bool,
}

impl ExplainOption {
    /// Prints the sentence of the work on stderr, if the option is given.
    pub(crate) fn print(&self, work: impl FnOnce() -> Result<Work, Error>) -> Result<(), Failure> {
        if self.explain {
            print_message(&format!("note: {}", work()?));
        }
        Ok(())
    }
}

/// The option `--method`.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct MethodOption {
    /// Method that computes the forces [default: the cheapest one]
    #[arg(long, value_enum)]
    method: Option<MethodName>,
}

impl MethodOption {
    /// Selects this method in `units`.
    pub(crate) fn apply<'p>(&self, units: Units<'p>) -> Result<Units<'p>, Error> {
        match self.method {
            None => Ok(units),
            Some(method) => Ok(units.with_method(method.into())?),
        }
    }

    /// Returns an error with this reason if a method is given.
    pub(crate) fn refuse(&self, reason: &str) -> Result<(), Failure> {
        match self.method {
            None => Ok(()),
            Some(_) => Err(Failure::Message(format!(
                "--method: {reason}: leave it out"
            ))),
        }
    }
}

#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    /// Closed form: counts spheres on contact lines; straight stackings only
    Closed,
    /// Follows the contact lines above each sphere
    Tree,
    /// Computes layer after layer, from the top
    Sweep,
}

impl From<MethodName> for Method {
    fn from(name: MethodName) -> Self {
        match name {
            MethodName::Closed => Self::Closed,
            MethodName::Tree => Self::Tree,
            MethodName::Sweep => Self::Sweep,
        }
    }
}

/// The options `--format` and `--output` of a table.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct Output {
    /// Format of the table [default: csv or json if --output has this extension, otherwise table]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// File for the table, written atomically [default: stdout]
    #[arg(long = "output", value_name = "FILE")]
    file: Option<PathBuf>,
}

impl Output {
    /// Returns the format of `--format`, or of the file name extension. The two must agree.
    pub(crate) fn format(&self) -> Result<Format, Failure> {
        resolve_format("format", self.format, "output", self.file.as_deref())
    }

    /// Writes a table and shows its progress in rows.
    pub(crate) fn write_table(
        &self,
        table: Table<'_>,
        numbers: impl Into<NumberFormat>,
        progress: &Progress,
    ) -> Result<(), Failure> {
        let format = self.format()?;
        self.write(progress, |out| {
            table.write(format.into(), numbers.into(), out)
        })
    }

    /// Writes to the file or to stdout, and writes other files by `others`. If it fails, none is written.
    ///
    /// `others` creates the folder `made`, if it is missing.
    pub(crate) fn write_with(
        &self,
        progress: &Progress,
        content: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
        made: Option<&Path>,
        others: impl FnOnce() -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let file = self.file();
        let is_within = |file: &Path| made.is_some_and(|folder| creates_folder_of(folder, file));
        // Text that was written to stdout cannot be taken back.
        if file.is_none_or(is_within) {
            others()?;
            return self.write(progress, content);
        }
        write_around("output", file, |out| {
            let written = progress.count(out, false, |out| {
                content(out)?;
                Ok(out.flush()?)
            });
            written.map_err(|error| Failure::of_writing(error, "output", file))?;
            others()
        })
    }

    /// The file. `-` is stdout.
    fn file(&self) -> Option<&Path> {
        self.file.as_deref().filter(|file| *file != Path::new("-"))
    }

    /// Writes to the file or to stdout and shows the progress, one row a line.
    pub(crate) fn write(
        &self,
        progress: &Progress,
        content: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
    ) -> Result<(), Failure> {
        let file = self.file();
        write_to("output", file, |out| {
            progress.count(out, file.is_none(), content)
        })
    }
}

/// Returns the format that `format_option` gives, or that of the extension of the file that `file_option` names.
///
/// # Errors
/// The two differ.
pub(crate) fn resolve_format(
    format_option: &str,
    format: Option<Format>,
    file_option: &str,
    file: Option<&Path>,
) -> Result<Format, Failure> {
    let ending = file
        .and_then(Path::extension)
        .and_then(Format::from_extension);
    match (format, ending) {
        (Some(format), Some(ending)) if format != ending => {
            let (format, ending) = (format.name(), ending.name());
            Err(Failure::Message(format!(
                "--{format_option}: {format} differs from {ending}, the extension of --{file_option}: leave --{format_option} \
                 out, or change the extension"
            )))
        }
        (None, None) => match file.and_then(foreign) {
            Some(other) => Err(Failure::Message(format!(
                "--{file_option}: tables are written as text, csv or json, not as {other}: use the extension csv or json, or \
                 give --{format_option}"
            ))),
            None => Ok(Format::Table),
        },
        (Some(format), _) | (None, Some(format)) => Ok(format),
    }
}

/// Returns the extension of a file, if it is that of a format for tables that is not written.
fn foreign(file: &Path) -> Option<&str> {
    const FOREIGN: &str =
        " tsv tab jsonl ndjson xls xlsx ods parquet feather xml yaml html md tex ";
    let ending = file.extension()?.to_str()?;
    FOREIGN
        .contains(&format!(" {} ", ending.to_ascii_lowercase()))
        .then_some(ending)
}

#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Number {
    /// Rationals and roots: 7/3, 2*sqrt(3)
    Exact,
    /// Double-precision floats, correctly rounded
    F64,
    /// Single-precision floats, correctly rounded
    F32,
    /// Double-precision lower and upper bounds, in columns ..._lo and ..._hi
    Interval,
}

impl From<Number> for NumberFormat {
    fn from(number: Number) -> Self {
        match number {
            Number::Exact => Self::Exact,
            Number::F64 => Self::F64,
            Number::F32 => Self::F32,
            Number::Interval => Self::Interval,
        }
    }
}

#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum UnitSystem {
    /// Contact forces in mg/(3cosθ), base normals in mg, base shears in mg·tanθ (x) and √3·mg·tanθ (y)
    Pile,
    /// N and m, with --radius in m, --mass in kg and --gravity in m/s²
    Si,
}

impl UnitSystem {
    /// Returns `pile` in these units.
    pub(crate) fn of<'p>(self, scene: &Scene, pile: &'p Pile) -> Result<Units<'p>, Error> {
        Ok(match self {
            Self::Pile => Units::of_pile(pile),
            Self::Si => Units::of_packing(scene.packing(pile)?),
        })
    }
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub(crate) enum Format {
    /// Aligned text, with units and totals
    Table,
    /// Comma-separated values
    Csv,
    /// Array of objects
    Json,
}

impl Format {
    /// Returns the format that a file name extension stands for, if any.
    fn from_extension(ending: &OsStr) -> Option<Self> {
        [Self::Csv, Self::Json]
            .into_iter()
            .find(|format| ending.eq_ignore_ascii_case(format.name()))
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Table => "table",
            Self::Csv => "csv",
            Self::Json => "json",
        }
    }
}

impl From<Format> for FileFormat {
    fn from(format: Format) -> Self {
        match format {
            Format::Table => Self::Text,
            Format::Csv => Self::Csv,
            Format::Json => Self::Json,
        }
    }
}
