//! The options that commands share.

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

use crate::output::{Failure, Refused, write_to};
use crate::progress::Progress;
use crate::{Culprit, Error};
pub(crate) use scene::SceneOptions;
pub(crate) use stackings::PilesOfStackings;

/// One sphere of the base.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct BaseAt {
    /// One bottom sphere only: I,J, or K,I,J with k counted from 0 at the top (discs: I or K,I)
    #[arg(long, value_name = "I,J", allow_hyphen_values = true)]
    at: Option<String>,
}

impl BaseAt {
    pub(crate) fn selection(&self, pile: &Pile) -> Result<Selection, Refused> {
        let site = one(self.at.as_deref(), pile)?;
        Ok(site.map_or(Selection::Base, Selection::One))
    }
}

/// A part of the pile.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct Part {
    /// One sphere only: K,I,J with k counted from 0 at the top, or I,J on the base (discs: K,I or I)
    #[arg(
        long,
        value_name = "K,I,J",
        allow_hyphen_values = true,
        conflicts_with = "layer"
    )]
    at: Option<String>,
    /// One layer only, counted from 0 at the top
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = parse::integer)]
    layer: Option<i128>,
}

impl Part {
    pub(crate) fn selection(&self, pile: &Pile) -> Result<Selection, Refused> {
        let whole = self.layer.map_or(Selection::All, Selection::Layer);
        let site = one(self.at.as_deref(), pile)?;
        Ok(site.map_or(whole, Selection::One))
    }
}

/// Returns how many spheres a part has.
pub(crate) fn spheres(pile: &Pile, selection: Selection) -> Result<BigUint, Error> {
    Ok(match selection {
        Selection::All => pile.sphere_count(),
        Selection::Base => pile.base_sphere_count(),
        Selection::Layer(k) => pile.shape().layer(k)?.site_count(),
        Selection::One(_) => BigUint::from(1_u32),
    })
}

/// Returns the sphere that `--at` names.
pub(crate) fn one(at: Option<&str>, pile: &Pile) -> Result<Option<Site>, Refused> {
    let Some(text) = at else { return Ok(None) };
    let at = parse::at(text, pile.dimension());
    let at = at.map_err(|error| Refused::of(Culprit::Site, error))?;
    let site = pile.shape().check(at.site(pile.layers()));
    let site = site.map_err(|error| Refused::of(Culprit::Site, error))?;
    Ok(Some(site))
}

/// Adds to a refusal of too many rows the options that ask for fewer.
pub(crate) fn narrower(error: impl Into<Error>, selection: Selection) -> Refused {
    match selection {
        Selection::All => Refused::of_rows(error, "--layer or --at"),
        Selection::Layer(_) | Selection::Base => Refused::of_rows(error, "--at"),
        Selection::One(_) => Refused::from(error),
    }
}

/// How the numbers of a pile are shown.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct Numbers {
    /// How numbers are printed
    #[arg(long, value_enum, default_value = "exact")]
    pub(crate) number: Number,
    /// The units of forces and lengths
    #[arg(long, value_enum, default_value = "pile")]
    pub(crate) units: UnitSystem,
}

/// How forces are found.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct ByMethod {
    /// How forces are found [default: the cheapest way]
    #[arg(long, value_enum)]
    method: Option<MethodName>,
}

impl ByMethod {
    /// Returns the units, with answers found so.
    pub(crate) fn of<'p>(&self, units: Units<'p>) -> Result<Units<'p>, Error> {
        match self.method {
            None => Ok(units),
            Some(method) => Ok(units.with_method(method.into())?),
        }
    }
}

#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    /// By counting spheres on lines; for straight stackings
    Closed,
    /// From the lines above each sphere
    Tree,
    /// Layer after layer
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

/// Where a table goes, and in which format.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct Output {
    /// How the table is written [default: by the ending of --output, .csv or .json; else table]
    #[arg(long, value_enum)]
    format: Option<Format>,
    /// Write to a file, which is replaced only when all is written
    #[arg(long = "output", value_name = "FILE")]
    file: Option<PathBuf>,
}

impl Output {
    /// Returns the format asked for, or that of the ending of the file; the two must agree.
    pub(crate) fn format(&self) -> Result<Format, Failure> {
        agreed("format", self.format, "output", self.file.as_deref())
    }

    /// Writes a table; its rows are counted.
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

    /// Writes to the file or to stdout; lines are counted as rows.
    pub(crate) fn write(
        &self,
        progress: &Progress,
        content: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
    ) -> Result<(), Failure> {
        let file = self.file.as_deref();
        write_to("output", file, |out| {
            progress.count(out, file.is_none(), content)
        })
    }
}

/// Returns the format that an option asks for, or that of the ending of the file that another names; the two must agree.
pub(crate) fn agreed(
    format_option: &str,
    format: Option<Format>,
    file_option: &str,
    file: Option<&Path>,
) -> Result<Format, Failure> {
    let ending = file.and_then(Path::extension).and_then(Format::of_ending);
    match (format, ending) {
        (Some(format), Some(ending)) if format != ending => {
            let (format, ending) = (format.name(), ending.name());
            Err(Failure::Message(format!(
                "--{format_option}: {format} is not what the ending of --{file_option} says, {ending}: leave --{format_option} \
                 out, or give the file another ending"
            )))
        }
        (format, ending) => Ok(format.or(ending).unwrap_or(Format::Table)),
    }
}

#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Number {
    /// Rationals and roots: 7/3, 2*sqrt(3)
    Exact,
    /// The nearest double-precision float
    F64,
    /// The nearest single-precision float
    F32,
    /// The double-precision floats on both sides, in columns ..._lo and ..._hi
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
    /// Between spheres mg/(3cosθ); on the floor mg, and mg·tanθ along x, √3·mg·tanθ along y
    Pile,
    /// N and m, for a radius in m, mass in kg and gravity in m/s², each 1 unless it is given
    Si,
}

impl UnitSystem {
    /// Returns the pile in these units.
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
    /// An array of objects
    Json,
}

impl Format {
    /// Returns the format that a file with this ending is expected to be in, if any.
    fn of_ending(ending: &OsStr) -> Option<Self> {
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
