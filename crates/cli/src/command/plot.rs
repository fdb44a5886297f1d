//! `plot KIND`: the figures.

use std::path::{Path, PathBuf};

use cannonpile::Pile;
use cannonpile::lattice::{Dimension, Region};
use cannonpile::stacking::Pattern;
use cannonpile_dem::scene::{Anchor, Scene, State, parse};
use cannonpile_dem::table::WriteError;
use cannonpile_dem::verify::Ladder;
use cannonpile_figure as figure;
use cannonpile_figure::{Figure, Layout, Subject};
use clap::{Args, Subcommand};
use num_rational::BigRational;
use num_traits::One;

use super::ensemble::Measured as Histogram;
use super::fault_probability;
use crate::args::{SceneOptions, UnitSystem, one};
use crate::output::{Failure, Refused, complain, open, write_to};
use crate::progress::Progress;
use crate::{Culprit, Error};

const HELP: &str = "\
z points up in figures, as in exported files.

Examples:
  cannonpile plot shear --output shear.svg
  cannonpile plot network --stacking hcp --layers 12 --output network.svg
  cannonpile plot network --stacking=+-+-+ --state elastic --layer 3 --output elastic.svg
  cannonpile plot response --stacking hcp --top hexagon:5 --layers 6 --output response.svg
  cannonpile plot response --faults 2,3 --output fault.svg
  cannonpile plot response --fault-probability 0,1/4,1/2,1 --layers 17 --output mean.svg
  cannonpile plot response --fault-probability 1/4,1/2,3/4 --layers 61 --profile --output wave.svg
  cannonpile ensemble --layers 12 --all --output all.json; cannonpile plot distribution all.json --output forces.svg
  cannonpile verify --ladder 1e5=soft.csv,1e6=stiff.csv --format json --output ladder.json; cannonpile plot ladder ladder.json";

/// A kind of figure.
#[derive(Subcommand)]
#[command(after_help = HELP)]
pub(crate) enum Plot {
    /// The pile in perspective, of four layers unless the scene says how many
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
        /// The sphere: K,I,J with k counted from 0 at the top, or I,J on the base (discs: K,I or I) [default: in the middle]
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
    /// What each bottom sphere can bear at a = R, at least and at most, as a map
    Bounds(Measured),
    /// The contact forces as lines, in a vertical section through the middle
    Network {
        #[command(flatten)]
        of: Measured,
        /// Instead, the forces of this layer on the next, seen from above; counted from 0 at the top
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
        /// The steps between faults, from the top: 2,3 is ++---; in place of --stacking and --layers
        #[arg(
            long,
            value_name = "M,N,...",
            allow_hyphen_values = true,
            conflicts_with = "fault_probability"
        )]
        faults: Option<String>,
        /// Instead, the mean over random stackings below a wide top that begin with + and change with these probabilities,
        /// a map for each
        #[arg(long, value_name = "Q,...", allow_hyphen_values = true, value_delimiter = ',', value_parser = fault_probability, conflicts_with = "layer")]
        fault_probability: Vec<BigRational>,
        /// Of these means the sum over rings, as curves over the distance from the load's line
        #[arg(long, requires = "fault_probability")]
        profile: bool,
    },
    /// How forces are distributed over random stackings: the histogram of an ensemble
    Distribution {
        /// A record of ensemble or merge, in json
        #[arg(value_name = "FILE")]
        record: PathBuf,
        /// Of which forces
        #[arg(long, value_enum, default_value = "forces")]
        histogram: Histogram,
        /// The probability q that a sign differs from the one before [default: that of the record]
        #[arg(long, value_name = "Q", allow_hyphen_values = true, value_parser = fault_probability)]
        fault_probability: Option<BigRational>,
        #[command(flatten)]
        output: ToFile,
    },
    /// The errors of a code at several stiffnesses or time steps, and the order in which they vanish
    Ladder {
        /// A record of verify --ladder, in json
        #[arg(value_name = "FILE")]
        record: PathBuf,
        #[command(flatten)]
        output: ToFile,
    },
}

/// A pile, whose figure has no forces.
#[derive(Args)]
pub(crate) struct Of {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    #[command(flatten)]
    output: ToFile,
}

/// A pile and its forces.
#[derive(Args)]
pub(crate) struct Measured {
    #[command(flatten)]
    of: Of,
    /// The units of forces and lengths; with pile, lengths are in R
    #[arg(long, value_enum, default_value = "pile", help_heading = "Output")]
    units: UnitSystem,
}

/// Where a figure goes.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct ToFile {
    /// Write to an SVG file, which is replaced only when all is written [default: stdout]
    #[arg(long = "output", value_name = "FILE.svg")]
    file: Option<PathBuf>,
    /// The width of the figure, in pixels; everything in it is scaled with it
    #[arg(long, value_name = "PIXELS", default_value_t = 800, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    width: u32,
    /// Leave out the title and the line below it
    #[arg(long)]
    no_title: bool,
}

impl Plot {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let ToFile {
            file,
            width,
            no_title,
        } = self.parts().1;
        keep_to_svg(file.as_deref())?;
        let figure = self.draw()?.laid_out(Layout {
            width: f64::from(*width),
            title: !no_title,
        });
        write_to("output", file.as_deref(), |out| {
            figure.write(out).map_err(WriteError::from)
        })?;
        if let Some(note) = figure.note() {
            complain(&format!("note: {note}"));
        }
        Ok(true)
    }

    pub(crate) const fn scene(&self) -> Option<&SceneOptions> {
        self.parts().0
    }
}

/// Figures are written in one format, and a file should not say that it is in another.
fn keep_to_svg(file: Option<&Path>) -> Result<(), Failure> {
    let Some(file) = file else { return Ok(()) };
    match file.extension() {
        Some(ending) if !ending.eq_ignore_ascii_case("svg") => {
            let svg = file.with_extension("svg");
            Err(Failure::Message(format!(
                "--output: a figure is written as SVG, not in the format of {}: name the file {}, and convert it",
                file.display(),
                svg.display()
            )))
        }
        _ => Ok(()),
    }
}

/// The layers of the picture of a pile, as in the paper.
const PICTURED: i128 = 4;

/// The layer whose indices are shown, as in the paper.
const INDEXED: i128 = 3;

/// The side of the top under which a response is shown: the load is seen to spread from its middle.
const WIDE: i128 = 4;

impl Plot {
    /// The scene that is drawn, if it is one, and where the figure goes.
    const fn parts(&self) -> (Option<&SceneOptions>, &ToFile) {
        let of = match self {
            Self::Distribution { output, .. } | Self::Ladder { output, .. } => {
                return (None, output);
            }
            Self::Pile(of) | Self::Indexing { of, .. } => of,
            Self::Shear(measured)
            | Self::Base(measured)
            | Self::Bounds(measured)
            | Self::Sphere { of: measured, .. }
            | Self::Network { of: measured, .. }
            | Self::Response { of: measured, .. } => &measured.of,
        };
        (Some(&of.scene), &of.output)
    }

    fn draw(&self) -> Result<Figure, Failure> {
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
                Ok(figure::indexing(&subject, layer).map_err(of_layer)?)
            }
            Self::Sphere { of, at } => of.draw(|subject, pile| {
                let site = match one(at.as_deref(), pile)? {
                    Some(site) => site,
                    None => figure::example(pile)?,
                };
                Ok(figure::sphere(subject, site)?)
            }),
            Self::Network { of, layer } => of.draw_state(|subject, _| match layer {
                Some(k) => figure::layer(subject, *k).map_err(of_layer),
                None => Ok(figure::section(subject)?),
            }),
            Self::Shear(of) => of.draw(|subject, _| Ok(figure::shear(subject)?)),
            Self::Bounds(of) => {
                let (mut scene, pile) = of.of.scene.read_whole()?;
                scene.check_touching()?;
                scene.spacing = Some(One::one());
                of.draw_pile(&scene, &pile, |subject, _| Ok(figure::bounds(subject)?))
            }
            Self::Base(of) => of.draw_state(|subject, _| Ok(figure::base(subject)?)),
            Self::Response {
                of,
                fault_probability,
                profile,
                ..
            } if !fault_probability.is_empty() => {
                let layers = of.of.scene.of_wide_layers()?;
                let progress = Progress::begin("drawing");
                let drawn = if *profile {
                    figure::mean_profile(layers, fault_probability)
                } else {
                    figure::mean_response(layers, fault_probability)
                };
                drop(progress);
                Ok(drawn?)
            }
            Self::Response {
                of, layer, faults, ..
            } => {
                let (mut scene, mut pile) = match faults {
                    None => of.of.scene.read()?,
                    Some(faults) => of.of.scene.read_stacked(runs(faults)?)?,
                };
                if needs_a_top(&scene) {
                    scene.anchor = Some(Anchor::Top(Region::hexagon(WIDE, WIDE)?));
                    pile = scene.pile()?;
                }
                let pile = figure::of_unit_load(pile)?;
                let layer = layer.unwrap_or(pile.layers() - 1);
                of.draw_pile(&scene, &pile, |subject, _| {
                    figure::response(subject, layer).map_err(of_layer)
                })
            }
            Self::Distribution {
                record: file,
                histogram,
                fault_probability,
                ..
            } => {
                let record = super::ensemble::read(file)?;
                let of_record = record.fault_probability();
                let q = fault_probability.as_ref().unwrap_or(of_record);
                let figure = figure::distribution(record.tally(), (*histogram).into(), q)?;
                figure.ok_or_else(|| {
                    Failure::Message(format!(
                        "{}: this is a part of an ensemble: merge it with the others first",
                        file.display()
                    ))
                })
            }
            Self::Ladder { record, .. } => Ok(figure::ladder(&read_ladder(record)?)),
        }
    }
}

/// The ladder of a record.
fn read_ladder(path: &Path) -> Result<Ladder, Failure> {
    let name = path.display();
    Ladder::read(open(path)?).map_err(|error| {
        Failure::Message(format!(
            "FILE: {name} is no ladder: {error}; 'cannonpile verify --ladder K1=FILE1,K2=FILE2 --format json' writes one"
        ))
    })
}

/// Runs of + and − steps, + first.
fn runs(text: &str) -> Result<Pattern, Failure> {
    let pattern = format!("({text})").parse();
    pattern.map_err(|_| {
        Failure::Message(format!(
            "--faults: {text} is no list of steps: give the steps between faults, each 1 or more, as 2,3"
        ))
    })
}

/// Blames the layer that was to be drawn, not the number of layers.
fn of_layer(error: figure::Error) -> Refused {
    match error.into() {
        error @ (Error::Figure(figure::Error::TooManyMarks { .. })
        | Error::Core(cannonpile::Error::OnFloor { .. })) => Refused::of(Culprit::Layer, error),
        error => error.into(),
    }
}

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
        draw: impl FnOnce(&Subject<'_>, &Pile) -> Result<Figure, Refused>,
    ) -> Result<Figure, Failure> {
        let (scene, pile) = self.of.scene.read()?;
        self.draw_pile(&scene, &pile, draw)
    }

    /// Of the state that is meant.
    fn draw_state(
        &self,
        draw: impl FnOnce(&Subject<'_>, &Pile) -> Result<Figure, Refused>,
    ) -> Result<Figure, Failure> {
        let (scene, pile) = self.of.scene.read_state()?;
        self.draw_pile(&scene, &pile, |subject, pile| {
            if scene.state == State::Elastic {
                draw(&subject.clone().with_horizontal_contacts(), pile)
            } else {
                draw(subject, pile)
            }
        })
    }

    fn draw_pile(
        &self,
        scene: &Scene,
        pile: &Pile,
        draw: impl FnOnce(&Subject<'_>, &Pile) -> Result<Figure, Refused>,
    ) -> Result<Figure, Failure> {
        let subject = match self.units {
            UnitSystem::Pile => Subject::of_pile(pile, &scene.spacing()?)?,
            UnitSystem::Si => Subject::of_packing(scene.packing(pile)?),
        };
        let progress = Progress::begin("drawing");
        let drawn = draw(&subject, pile);
        drop(progress);
        // A figure has no other numbers than floats.
        drawn.map_err(|refused| self.of.scene.beyond_floats(refused, scene))
    }
}
