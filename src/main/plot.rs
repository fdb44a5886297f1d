//! `cannonpile plot KIND`: the figures.

use std::fs;
use std::path::{Path, PathBuf};

use cannonpile::figure::{
    BaseMap, Drawing, Indexing, Network, Picture, Response, Shear, SphereForces, Subject,
    WorkPrecision,
};
use cannonpile::lattice::{Dimension, Region};
use cannonpile::scene::{Anchor, Scene, parse};
use cannonpile::table::WriteError;
use cannonpile::{Error, Pile};
use clap::{Args, Subcommand};

use super::options::{Refused, SceneOptions, UnitSystem, one};
use super::{Failure, warn_if_it_falls, write_to};

/// A kind of figure.
#[derive(Subcommand)]
pub(crate) enum Figure {
    /// The pile in perspective [default: four layers]
    Pile(Of),
    /// The indices i and j of the spheres of a layer
    Indexing {
        #[command(flatten)]
        of: Of,
        /// The layer, counted from 0 at the top [default: 3, or the bottom layer if there are fewer]
        #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = parse::integer, help_heading = "Output")]
        layer: Option<i128>,
    },
    /// The forces on one sphere
    Sphere {
        #[command(flatten)]
        of: Measured,
        /// The sphere, as K,I,J, or I,J on the base (discs: K,I or I) [default: in the middle]
        #[arg(
            long,
            value_name = "K,I,J",
            allow_hyphen_values = true,
            help_heading = "Output"
        )]
        at: Option<String>,
    },
    /// The shear force on the floor, as arrows
    Shear(Measured),
    /// The normal force on the floor, as a map
    Base(Measured),
    /// The contact forces as lines, in a vertical section through the middle
    Network {
        #[command(flatten)]
        of: Measured,
        /// Instead, those of this layer on the next, seen from above; counted from 0 at the top
        #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = parse::integer, help_heading = "Output")]
        layer: Option<i128>,
    },
    /// The vertical force in a layer of weightless spheres, as a map: of --load, or of 1 mg on the middle of a wide top
    Response {
        #[command(flatten)]
        of: Measured,
        /// The layer, counted from 0 at the top [default: the bottom layer]
        #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = parse::integer, help_heading = "Output")]
        layer: Option<i128>,
    },
    /// Run times against errors, from the table that the bench work_precision writes
    WorkPrecision {
        /// Comma-separated values with the columns pile, contacts, method, scalar, seconds and relative_error
        #[arg(value_name = "FILE.csv")]
        table: PathBuf,
        #[command(flatten)]
        output: ToFile,
    },
}

/// A pile, whose figure has no forces.
#[derive(Args)]
pub(crate) struct Of {
    #[command(flatten)]
    scene: SceneOptions,
    #[command(flatten)]
    output: ToFile,
}

/// A pile and its forces.
#[derive(Args)]
pub(crate) struct Measured {
    #[command(flatten)]
    scene: SceneOptions,
    /// Multiples of mg and R, or newtons and metres
    #[arg(long, value_enum, default_value = "pile", help_heading = "Output")]
    units: UnitSystem,
    #[command(flatten)]
    output: ToFile,
}

/// Where a figure goes.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct ToFile {
    /// Write to an SVG file, which is replaced only when all is written [default: stdout]
    #[arg(long = "output", value_name = "FILE.svg")]
    pub(crate) file: Option<PathBuf>,
}

impl Figure {
    /// The scene options of the kinds that have them.
    pub(crate) fn scene(&self) -> Option<&SceneOptions> {
        match self {
            Self::Pile(of) | Self::Indexing { of, .. } => Some(&of.scene),
            Self::Shear(of)
            | Self::Base(of)
            | Self::Sphere { of, .. }
            | Self::Network { of, .. }
            | Self::Response { of, .. } => Some(&of.scene),
            Self::WorkPrecision { .. } => None,
        }
    }

    pub(crate) fn file(&self) -> Option<&Path> {
        let output = match self {
            Self::Pile(of) | Self::Indexing { of, .. } => &of.output,
            Self::Shear(of)
            | Self::Base(of)
            | Self::Sphere { of, .. }
            | Self::Network { of, .. }
            | Self::Response { of, .. } => &of.output,
            Self::WorkPrecision { output, .. } => output,
        };
        output.file.as_deref()
    }

    /// Draws it.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let drawing = self.draw()?;
        Ok(write_to(self.file(), |out| {
            drawing.write(out).map_err(WriteError::from)
        })?)
    }

    fn draw(&self) -> Result<Drawing, Failure> {
        match self {
            Self::WorkPrecision { table, .. } => Ok(measured(table)?.drawing()),
            Self::Pile(of) => {
                let (scene, pile) = of.scene.read_or(PICTURED)?;
                let subject = Subject::of_pile(&pile, &scene.spacing()?)?;
                Ok(Picture::new(&subject)?.drawing())
            }
            Self::Indexing { of, layer } => {
                let (scene, pile) = of.scene.read()?;
                let subject = Subject::of_pile(&pile, &scene.spacing()?)?;
                let layer = layer.unwrap_or_else(|| INDEXED.min(pile.layers() - 1));
                Ok(Indexing::new(&subject, layer)?.drawing())
            }
            Self::Sphere { of, at } => {
                let (scene, pile) = of.scene.read()?;
                let site = match one(at.as_deref(), &pile)? {
                    Some(site) => site,
                    None => SphereForces::example(&pile)?,
                };
                of.draw_pile(&scene, &pile, |subject| {
                    Ok(SphereForces::new(subject, site)?.drawing())
                })
            }
            Self::Network { of, layer } => of.draw(|subject| {
                let network = match layer {
                    Some(k) => Network::layer(subject, *k),
                    None => Network::section(subject),
                };
                Ok(network?.drawing())
            }),
            Self::Shear(of) => of.draw(|subject| Ok(Shear::new(subject)?.drawing())),
            Self::Base(of) => of.draw(|subject| Ok(BaseMap::new(subject)?.drawing())),
            Self::Response { of, layer } => {
                let (mut scene, mut pile) = of.scene.read()?;
                if needs_a_top(&scene) {
                    scene.anchor = Some(Anchor::Top(Region::hexagon(WIDE, WIDE)?));
                    pile = scene.pile()?;
                }
                let pile = Response::of_unit_load(pile)?;
                let layer = layer.unwrap_or(pile.layers() - 1);
                let subject = subject(&scene, &pile, of.units)?;
                let response = Response::new(&subject, layer);
                Ok(response.map_err(|error| unfit(error, &scene))?.drawing())
            }
        }
    }
}

/// The runs of a table.
fn measured(path: &Path) -> Result<WorkPrecision, Failure> {
    let refused = |told: String| Failure::Told(format!("{}: {told}", path.display()));
    let table = fs::read_to_string(path).map_err(|error| {
        let reason = error.kind();
        refused(format!(
            "cannot read it: {reason}; choose a text that exists and can be read"
        ))
    })?;
    WorkPrecision::read(&table).map_err(|error| refused(error.to_string()))
}

/// The layers of the picture of a pile, as in the paper.
const PICTURED: i128 = 4;

/// The layer whose indices are shown, as in the paper.
const INDEXED: i128 = 3;

/// The side of the top under which a response is shown: the load is seen to spread from its middle.
const WIDE: i128 = 4;

/// Whether a load is to be put on a top that nobody described.
fn needs_a_top(scene: &Scene) -> bool {
    scene.anchor.is_none()
        && scene.loads.is_empty()
        && scene.sin_phi.is_none()
        && scene.dimension == Dimension::Three
}

impl Measured {
    fn draw(
        &self,
        figure: impl FnOnce(&Subject<'_>) -> Result<Drawing, Error>,
    ) -> Result<Drawing, Failure> {
        let (scene, pile) = self.scene.read()?;
        self.draw_pile(&scene, &pile, figure)
    }

    fn draw_pile(
        &self,
        scene: &Scene,
        pile: &Pile,
        figure: impl FnOnce(&Subject<'_>) -> Result<Drawing, Error>,
    ) -> Result<Drawing, Failure> {
        let subject = subject(scene, pile, self.units)?;
        let drawing = figure(&subject).map_err(|error| unfit(error, scene))?;
        warn_if_it_falls(pile);
        Ok(drawing)
    }
}

fn subject<'p>(scene: &Scene, pile: &'p Pile, units: UnitSystem) -> Result<Subject<'p>, Error> {
    match units {
        UnitSystem::Pile => Subject::of_pile(pile, &scene.spacing()?),
        UnitSystem::Si => Ok(Subject::of_packing(scene.packing(pile)?)),
    }
}

/// A refusal with the option that it comes of: a number beyond floats, which no option of a figure asks for, of a size
/// or of a load.
fn unfit(error: Error, scene: &Scene) -> Refused {
    match error {
        Error::Overflow {
            quantity: "a position" | "the radius",
            ..
        } => Refused::of("radius", error),
        Error::Overflow { .. } if !scene.loads.is_empty() => Refused::of("load", error),
        Error::Overflow { .. } => Refused::of("mass", error),
        // Of a layer without contacts below.
        Error::OnFloor { .. } => Refused::of("layer", error),
        error => error.into(),
    }
}
