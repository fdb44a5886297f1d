//! `cannonpile plot KIND`: the figures.

use std::path::{Path, PathBuf};

use cannonpile::export::WriteError;
use cannonpile::figure::{self, Layout, Subject};
use cannonpile::lattice::{Dimension, Region};
use cannonpile::scene::{Anchor, Scene, parse};
use cannonpile::{Error, Pile};
use clap::{Args, Subcommand};

use super::options::{Refused, SceneOptions, UnitSystem, one};
use super::{Failure, complain, write_to};

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
    /// The width of the figure, in pixels; all in it grows with it
    #[arg(long, value_name = "PIXELS", default_value_t = 800, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    width: u32,
    /// Leave out the title and the line below it
    #[arg(long)]
    no_title: bool,
}

impl Figure {
    pub(crate) fn scene(&self) -> &SceneOptions {
        match self {
            Self::Pile(of) | Self::Indexing { of, .. } => &of.scene,
            Self::Shear(of)
            | Self::Base(of)
            | Self::Sphere { of, .. }
            | Self::Network { of, .. }
            | Self::Response { of, .. } => &of.scene,
        }
    }

    pub(crate) fn file(&self) -> Option<&Path> {
        self.output().file.as_deref()
    }

    fn output(&self) -> &ToFile {
        match self {
            Self::Pile(of) | Self::Indexing { of, .. } => &of.output,
            Self::Shear(of)
            | Self::Base(of)
            | Self::Sphere { of, .. }
            | Self::Network { of, .. }
            | Self::Response { of, .. } => &of.output,
        }
    }

    /// Draws it.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let ToFile {
            file,
            width,
            no_title,
        } = self.output();
        let figure = self.draw()?.laid_out(Layout {
            width: f64::from(*width),
            title: !no_title,
        });
        write_to(file.as_deref(), |out| {
            figure.write(out).map_err(WriteError::from)
        })?;
        if let Some(note) = figure.note() {
            complain(&format!("note: {note}"));
        }
        Ok(())
    }

    fn draw(&self) -> Result<figure::Figure, Failure> {
        match self {
            Self::Pile(of) => {
                let (scene, pile) = of.scene.read_or(PICTURED)?;
                let subject = Subject::of_pile(&pile, &scene.spacing()?)?;
                Ok(figure::pile(&subject)?)
            }
            Self::Indexing { of, layer } => {
                let (scene, pile) = of.scene.read()?;
                let subject = Subject::of_pile(&pile, &scene.spacing()?)?;
                let layer = layer.unwrap_or_else(|| INDEXED.min(pile.layers() - 1));
                Ok(figure::indexing(&subject, layer)?)
            }
            Self::Sphere { of, at } => {
                let (scene, pile) = of.scene.read()?;
                let site = match one(at.as_deref(), &pile)? {
                    Some(site) => site,
                    None => figure::example(&pile)?,
                };
                of.draw_pile(&scene, &pile, |subject| figure::sphere(subject, site))
            }
            Self::Network { of, layer } => of.draw(|subject| match layer {
                Some(k) => figure::layer(subject, *k),
                None => figure::section(subject),
            }),
            Self::Shear(of) => of.draw(figure::shear),
            Self::Base(of) => of.draw(figure::base),
            Self::Response { of, layer } => {
                let (mut scene, mut pile) = of.scene.read()?;
                if needs_a_top(&scene) {
                    scene.anchor = Some(Anchor::Top(Region::hexagon(WIDE, WIDE)?));
                    pile = scene.pile()?;
                }
                let pile = figure::of_unit_load(pile)?;
                let layer = layer.unwrap_or(pile.layers() - 1);
                let subject = subject(&scene, &pile, of.units)?;
                let response = figure::response(&subject, layer);
                Ok(response.map_err(|error| unfit(error, &scene))?)
            }
        }
    }
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
        draw: impl FnOnce(&Subject<'_>) -> Result<figure::Figure, Error>,
    ) -> Result<figure::Figure, Failure> {
        let (scene, pile) = self.scene.read()?;
        self.draw_pile(&scene, &pile, draw)
    }

    fn draw_pile(
        &self,
        scene: &Scene,
        pile: &Pile,
        draw: impl FnOnce(&Subject<'_>) -> Result<figure::Figure, Error>,
    ) -> Result<figure::Figure, Failure> {
        let subject = subject(scene, pile, self.units)?;
        Ok(draw(&subject).map_err(|error| unfit(error, scene))?)
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
            quantity: "a position" | "a coordinate" | "the radius",
            ..
        } => Refused::of("radius", error),
        Error::Overflow { .. } if !scene.loads.is_empty() => Refused::of("load", error),
        Error::Overflow { .. } => Refused::of("mass", error),
        // Of a layer without contacts below.
        Error::OnFloor { .. } => Refused::of("layer", error),
        error => error.into(),
    }
}
