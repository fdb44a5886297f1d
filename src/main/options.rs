//! The options of the command line.

use std::path::{Path, PathBuf};

use cannonpile::export::{FileFormat, NumberFormat, Units};
use cannonpile::lattice::{Region, Site};
use cannonpile::scene::parse;
use cannonpile::shape::Selection;
use cannonpile::{Error, Method, Pile, Quantity, theorem};
use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::completions::Completions;
use crate::export::Export;
use crate::plot::Figure;
pub(crate) use crate::scene::SceneOptions;
use crate::scene::WriteScene;
use crate::verify::Verify;

/// Exact contact forces in regular piles of spheres.
#[derive(Parser)]
#[command(version, about, max_term_width = 100, arg_required_else_help = false)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// The pile in one row: counts, weight, extreme forces
    Summary {
        #[command(flatten)]
        scene: SceneOptions,
        #[command(flatten)]
        numbers: Numbers,
        #[command(flatten)]
        output: Output,
    },
    /// The force of each bottom sphere on the floor
    Base {
        #[command(flatten)]
        scene: SceneOptions,
        #[command(flatten)]
        at: BaseAt,
        #[command(flatten)]
        numbers: Numbers,
        #[command(flatten)]
        method: ByMethod,
        #[command(flatten)]
        output: Output,
    },
    /// The force of each contact between two spheres
    Contacts {
        #[command(flatten)]
        scene: SceneOptions,
        #[command(flatten)]
        part: Part,
        #[command(flatten)]
        numbers: Numbers,
        #[command(flatten)]
        method: ByMethod,
        #[command(flatten)]
        output: Output,
    },
    /// The place, size and mass of each sphere, in SI units
    Spheres {
        #[command(flatten)]
        scene: SceneOptions,
        #[command(flatten)]
        part: Part,
        #[command(flatten)]
        numbers: Numbers,
        #[command(flatten)]
        output: Output,
    },
    /// Which stackings stand, under one sphere or on a base
    Census {
        /// Number of layers, 1 to 10^36
        #[arg(long, value_name = "L", default_value = "10", allow_hyphen_values = true, value_parser = parse::layers)]
        layers: i128,
        /// Every stacking of this base, carried as high as it goes: hexagon:P,Q, hexagon:N, triangle:N or
        /// region:x0..x1,y0..y1,s0..s1
        #[arg(long, value_name = "SHAPE", allow_hyphen_values = true, value_parser = parse::region, conflicts_with = "layers")]
        base: Option<Region>,
        /// Only those that stand
        #[arg(long)]
        standing: bool,
        /// How numbers are printed
        #[arg(long, value_enum, default_value = "exact", help_heading = "Output")]
        number: Number,
        #[command(flatten)]
        output: Output,
    },
    /// How a question would be answered, what that takes at most, and what it took
    Explain {
        #[command(flatten)]
        scene: SceneOptions,
        /// What is asked of the spheres
        #[arg(long, value_enum, default_value = "contacts", help_heading = "Output")]
        of: Asked,
        #[command(flatten)]
        part: Part,
        /// Multiples of mg and friends, or newtons and metres
        #[arg(long, value_enum, default_value = "pile", help_heading = "Output")]
        units: UnitSystem,
        #[command(flatten)]
        method: ByMethod,
        /// The plan only: nothing is run
        #[arg(long, help_heading = "Output")]
        no_run: bool,
        #[command(flatten)]
        output: Output,
    },
    /// The whole pile as files: tables, input for LAMMPS and YADE, geometry for ParaView; in SI units
    Export(Export),
    /// The scene as a TOML file, which --scene reads
    Scene(WriteScene),
    /// What is proved for every pile, with the proofs; exit status 1 if one fails
    Prove {
        /// One theorem only, with its whole derivation
        #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(theorem::all().map(|t| t.name)))]
        theorem: Option<String>,
        #[command(flatten)]
        output: Output,
    },
    /// Measured contact forces against the exact ones; exit status 1 if they differ
    Verify(Verify),
    /// A figure, as SVG
    #[command(subcommand, arg_required_else_help = false)]
    Plot(Figure),
    /// A script with which a shell completes commands and options
    Completions(Completions),
}

impl Command {
    /// Where the output goes, for messages.
    pub(crate) fn target(&self) -> String {
        match self {
            Self::Scene(command) => target(command.file.as_deref()),
            Self::Plot(figure) => target(figure.file()),
            Self::Completions(_) => target(None),
            Self::Summary { output, .. }
            | Self::Base { output, .. }
            | Self::Contacts { output, .. }
            | Self::Spheres { output, .. }
            | Self::Census { output, .. }
            | Self::Explain { output, .. }
            | Self::Prove { output, .. }
            | Self::Export(Export { output, .. })
            | Self::Verify(Verify { output, .. }) => target(output.file.as_deref()),
        }
    }

    /// The scene options of the commands that have them.
    pub(crate) fn scene(&self) -> Option<&SceneOptions> {
        match self {
            Self::Summary { scene, .. }
            | Self::Base { scene, .. }
            | Self::Contacts { scene, .. }
            | Self::Spheres { scene, .. }
            | Self::Explain { scene, .. }
            | Self::Export(Export { scene, .. })
            | Self::Verify(Verify { scene, .. }) => Some(scene),
            Self::Scene(command) => Some(&command.scene),
            Self::Plot(figure) => Some(figure.scene()),
            Self::Census { .. } | Self::Prove { .. } | Self::Completions(_) => None,
        }
    }
}

/// A refusal, and the option to change if it is known.
#[derive(Debug)]
pub(crate) struct Refused {
    pub(crate) option: Option<&'static str>,
    pub(crate) error: Error,
}

impl Refused {
    pub(crate) fn of(option: &'static str, error: Error) -> Self {
        Self {
            option: Some(option),
            error,
        }
    }
}

impl From<Error> for Refused {
    fn from(error: Error) -> Self {
        Self {
            option: None,
            error,
        }
    }
}

/// One sphere of the base.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct BaseAt {
    /// One bottom sphere only, as I,J (or K,I,J; discs: I or K,I)
    #[arg(long, value_name = "I,J", allow_hyphen_values = true)]
    at: Option<String>,
}

impl BaseAt {
    pub(crate) fn on_base(&self, pile: &Pile) -> Result<Selection, Refused> {
        let site = one(self.at.as_deref(), pile)?;
        Ok(site.map_or(Selection::Base, Selection::One))
    }
}

/// A part of the pile.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct Part {
    /// One sphere only, as K,I,J, or I,J on the base (discs: K,I or I)
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

/// The sphere that `--at` names.
pub(crate) fn one(at: Option<&str>, pile: &Pile) -> Result<Option<Site>, Refused> {
    let Some(text) = at else { return Ok(None) };
    let at = parse::at(text, pile.dimension()).map_err(|error| Refused::of("at", error))?;
    let site = pile.shape().check(at.site(pile.layers()));
    let site = site.map_err(|error| Refused::of("at", error))?;
    Ok(Some(site))
}

/// How the numbers of a pile are shown.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct Numbers {
    /// How numbers are printed
    #[arg(long, value_enum, default_value = "exact")]
    pub(crate) number: Number,
    /// Multiples of mg and friends, or newtons and metres
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
    /// The units, with answers found so.
    pub(crate) fn of<'p>(&self, units: Units<'p>) -> Result<Units<'p>, Refused> {
        match self.method {
            None => Ok(units),
            Some(method) => units
                .by(method.into())
                .map_err(|error| Refused::of("method", error)),
        }
    }
}

#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum MethodName {
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

/// What is asked of spheres.
#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub(crate) enum Asked {
    /// What `contacts` prints
    Contacts,
    /// The magnitudes alone; in SI
    Magnitudes,
    /// What `base` prints
    Base,
    /// What `spheres` prints: places, in SI
    Spheres,
}

impl Asked {
    /// The quantity, and the units that it is in: magnitudes and places are in SI.
    pub(crate) fn quantity(self, units: UnitSystem) -> (Quantity, UnitSystem) {
        let quantity = match (self, units) {
            (Self::Contacts, UnitSystem::Pile) => Quantity::ContactMultiples,
            (Self::Contacts, UnitSystem::Si) => Quantity::ContactVectors,
            (Self::Magnitudes, _) => Quantity::ContactMagnitudes,
            (Self::Base, UnitSystem::Pile) => Quantity::FloorMultiples,
            (Self::Base, UnitSystem::Si) => Quantity::FloorForces,
            (Self::Spheres, _) => Quantity::Positions,
        };
        let units = match self {
            Self::Magnitudes | Self::Spheres => UnitSystem::Si,
            Self::Contacts | Self::Base => units,
        };
        (quantity, units)
    }

    /// The part that is asked about: on the floor there is but the base.
    pub(crate) fn part(self, part: Selection, pile: &Pile) -> Selection {
        match part {
            Selection::All if self == Self::Base => Selection::Base,
            Selection::Layer(k) if self == Self::Base && k == pile.layers() - 1 => Selection::Base,
            part => part,
        }
    }
}

/// Where a table goes, and in which format.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct Output {
    /// For people, or for programs
    #[arg(long, value_enum, default_value = "table")]
    pub(crate) format: Format,
    /// Write to a file, which is replaced only when all is written
    #[arg(long = "output", value_name = "FILE")]
    pub(crate) file: Option<PathBuf>,
}

/// Where output goes, for messages.
fn target(file: Option<&Path>) -> String {
    match file {
        None => "to stdout".into(),
        Some(path) => format!("--output {}", path.display()),
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
    /// Contact forces in mg/(3cosθ), the floor's in mg and mg·tanθ
    Pile,
    /// N and m, for a radius in m, mass in kg, gravity in m/s²
    Si,
}

#[derive(Clone, Copy, PartialEq, ValueEnum)]
pub(crate) enum Format {
    /// Aligned, with units and totals
    Table,
    /// Comma-separated values
    Csv,
    /// An array of objects
    Json,
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
