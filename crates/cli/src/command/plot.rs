//! `plot KIND`: draws figures.

use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use cannonpile::lattice::{Dimension, Region};
use cannonpile::stacking::Pattern;
use cannonpile::{Load, Pile};
use cannonpile_dem::scene::{Anchor, Scene, State, parse};
use cannonpile_dem::table::WriteError;
use cannonpile_disorder::Shard;
use cannonpile_figure as figure;
use cannonpile_figure::{Figure, Layout, Subject};
use clap::{Args, Subcommand, ValueEnum};
use num_rational::BigRational;

use super::ensemble::HistogramForces;
use super::{fault_probability, of_weight};
use crate::args::{SceneOptions, UnitSystem, parse_site};
use crate::output::{Failure, InputError, print_message, write_to};
use crate::progress::Progress;
use crate::{Culprit, Error};

const HELP: &str = "\
In figures z points up, as in exported files.

Examples:
  cannonpile plot shear --output shear.svg
  cannonpile plot network --stacking hcp --layers 12 --output network.svg
  cannonpile plot network --stacking=+-+-+ --state elastic --layer 3 --output elastic.svg
  cannonpile plot response --stacking hcp --top hexagon:5 --layers 6 --output response.svg
  cannonpile plot response --component x --top hexagon:5 --layers 6 --output push.svg
  cannonpile plot response --faults 2,3 --output fault.svg
  cannonpile plot stability --stacking=+-+++ --output stability.svg
  cannonpile plot response --fault-probability 0,1/4,1/2,1 --layers 17 --output mean.svg
  cannonpile plot response --fault-probability 1/4,1/2,3/4 --layers 61 --profile --output wave.svg
  cannonpile ensemble --layers 12 --all --output all.json; cannonpile plot distribution all.json --output forces.svg";

/// A kind of figure.
#[derive(Subcommand)]
#[command(after_help = HELP)]
pub(crate) enum Plot {
    /// Draw the pile in perspective, with four layers by default
    Pile(PileFigure),
    /// Draw the indices i, j of the spheres of a layer
    Indexing {
        #[command(flatten)]
        of: PileFigure,
        /// Layer, counted from 0 at the top [default: 3, or the bottom layer if it is higher]
        #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = parse::integer, help_heading = "Output")]
        layer: Option<i128>,
    },
    /// Draw the forces on one sphere
    Sphere {
        #[command(flatten)]
        of: ForceFigure,
        /// Sphere: K,I,J with k from 0 at the top, or I,J on the base (discs: K,I or I) [default: in the middle]
        #[arg(
            long,
            value_name = "K,I,J",
            allow_hyphen_values = true,
            help_heading = "Output"
        )]
        at: Option<String>,
    },
    /// Draw the forces on a lower sphere on a rough floor, with two layers by default
    Friction(PileFigure),
    /// Draw the base shear forces as arrows
    Shear(ForceFigure),
    /// Map the base normal forces
    Base(ForceFigure),
    /// Map the bounds of the base normal forces at a = R
    Bounds(ForceFigure),
    /// Draw the contact forces as lines, in a vertical section through the middle
    Network {
        #[command(flatten)]
        of: ForceFigure,
        /// Layer whose forces on the next one are drawn from above, counted from 0 at the top [default: a vertical section]
        #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = parse::integer, help_heading = "Output")]
        layer: Option<i128>,
    },
    /// Draw the tilts of gravity that the pile bears, with angles at --spacing (a = R by default)
    Stability(PileFigure),
    /// Map the response of a layer to --load, or to a unit load on the middle of a wide top
    Response {
        #[command(flatten)]
        of: ForceFigure,
        /// Layer, counted from 0 at the top [default: the bottom layer]
        #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = parse::integer, help_heading = "Output")]
        layer: Option<i128>,
        /// Component of the unit load; excludes --load [default: down]
        #[arg(long, value_enum, conflicts_with_all = ["load", "fault_probability"], help_heading = "Output")]
        component: Option<Component>,
        /// Stacking, as numbers of steps between faults from the top: 2,3 is ++---; excludes --stacking and --layers
        #[arg(
            long,
            value_name = "M,N,...",
            allow_hyphen_values = true,
            conflicts_with = "fault_probability"
        )]
        faults: Option<String>,
        /// Fault probabilities of random stackings that begin with +; draws the mean response, a map for each
        #[arg(long, value_name = "Q,...", allow_hyphen_values = true, value_delimiter = ',', value_parser = fault_probability, conflicts_with = "layer")]
        fault_probability: Vec<BigRational>,
        /// Draw ring sums of the mean response, as curves over the distance from the load axis
        #[arg(long, requires = "fault_probability")]
        profile: bool,
    },
    /// Draw the force distribution of an ensemble
    Distribution {
        /// JSON record of ensemble or merge
        #[arg(value_name = "FILE")]
        record: PathBuf,
        /// Forces of the histogram
        #[arg(long, value_enum, default_value = "forces")]
        histogram: HistogramForces,
        /// Probability q that a sign differs from the one before [default: that of the record]
        #[arg(long, value_name = "Q", allow_hyphen_values = true, value_parser = fault_probability)]
        fault_probability: Option<BigRational>,
        #[command(flatten)]
        output: FigureOutput,
    },
}

/// The component of a unit load.
#[derive(Clone, Copy, ValueEnum)]
pub(crate) enum Component {
    /// 1 mg downwards
    Down,
    /// 1 mg·tanθ along x
    X,
    /// 1 √3·mg·tanθ along y
    Y,
}

impl Component {
    /// Returns the unit load, which is vertical by default.
    fn load(given: Option<Self>, scene: &Scene) -> Result<Load, Failure> {
        let refused = match given {
            Some(_) if !scene.loads.is_empty() => {
                Some("the loads of the scene already have components: leave it out")
            }
            Some(Self::Y) if scene.dimension == Dimension::Two => {
                Some("discs have no component along y: use down or x")
            }
            _ => None,
        };
        if let Some(reason) = refused {
            return Err(Failure::Message(format!("--component: {reason}")));
        }
        let component = given.unwrap_or(Self::Down);
        let part = |is_one: bool| BigRational::from_integer(i32::from(is_one).into());
        Ok(Load {
            down: part(matches!(component, Self::Down)),
            x: part(matches!(component, Self::X)),
            y: part(matches!(component, Self::Y)),
        })
    }
}

/// The options of a figure without forces.
#[derive(Args)]
pub(crate) struct PileFigure {
    #[command(flatten)]
    pub(crate) scene: SceneOptions,
    #[command(flatten)]
    output: FigureOutput,
}

/// The options of a figure with forces.
#[derive(Args)]
pub(crate) struct ForceFigure {
    #[command(flatten)]
    of: PileFigure,
    /// Units of forces and lengths; with pile, lengths are in R
    #[arg(long, value_enum, default_value = "pile", help_heading = "Output")]
    units: UnitSystem,
}

/// The output options of a figure.
#[derive(Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct FigureOutput {
    /// SVG file, written atomically [default: stdout]
    #[arg(long = "output", value_name = "FILE.svg")]
    file: Option<PathBuf>,
    /// Width of the figure, in pixels, 1 to 100000; scales everything in it
    #[arg(long, value_name = "PIXELS", default_value_t = 800, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    width: u32,
    /// Omit the title and the caption
    #[arg(long)]
    no_title: bool,
}

impl Plot {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let FigureOutput {
            file,
            width,
            no_title,
        } = self.parts().1;
        check_extension(file.as_deref())?;
        if file.is_none() && io::stdout().is_terminal() {
            return Err(Failure::Message(
                "--output: a terminal does not show SVG: give a file such as pile.svg".to_owned(),
            ));
        }
        let figure = self.draw()?.laid_out(Layout {
            width: f64::from(*width),
            title: !no_title,
        });
        write_to("output", file.as_deref(), |out| {
            figure.write(out).map_err(WriteError::from)
        })?;
        if let Some(note) = figure.note() {
            print_message(&format!("note: {note}"));
        }
        Ok(true)
    }

    pub(crate) const fn scene(&self) -> Option<&SceneOptions> {
        self.parts().0
    }
}

/// Checks that the file name does not promise another format than SVG.
fn check_extension(file: Option<&Path>) -> Result<(), Failure> {
    let Some(file) = file else { return Ok(()) };
    match file.extension() {
        Some(ending) if !ending.eq_ignore_ascii_case("svg") => {
            let svg = file.with_extension("svg");
            Err(Failure::Message(format!(
                "--output: figures are SVG, which the extension of {} is not: write to {}, and convert it",
                file.display(),
                svg.display()
            )))
        }
        _ => Ok(()),
    }
}

/// The default number of layers of `plot pile`, as in the paper.
const PILE_LAYERS: i128 = 4;

/// The default layer of `plot indexing`, as in the paper.
const INDEXING_LAYER: i128 = 3;

/// The side of the default top of `plot response`. It is wide enough to show how the load spreads.
const RESPONSE_SIDE: i128 = 4;

impl Plot {
    /// Returns the scene options, if the figure has them, and the output options.
    const fn parts(&self) -> (Option<&SceneOptions>, &FigureOutput) {
        let of = match self {
            Self::Distribution { output, .. } => {
                return (None, output);
            }
            Self::Pile(of)
            | Self::Indexing { of, .. }
            | Self::Stability(of)
            | Self::Friction(of) => of,
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
                let (scene, pile) = of.scene.read_or(PILE_LAYERS)?;
                let subject = Subject::of_pile(&pile, &scene.spacing()?)?;
                Ok(figure::pile(&subject)?)
            }
            Self::Indexing { of, layer } => {
                let (scene, pile) = of.scene.read()?;
                let subject = Subject::of_pile(&pile, &scene.spacing()?)?;
                let layer = layer.unwrap_or_else(|| INDEXING_LAYER.min(pile.layers() - 1));
                Ok(figure::indexing(&subject, layer).map_err(of_layer)?)
            }
            Self::Stability(of) => of.draw_stability(),
            Self::Friction(of) => {
                let (scene, pile) = of.scene.read_rough()?;
                let subject = Subject::of_packing(scene.packing(&pile)?);
                Ok(figure::friction(&subject)?)
            }
            Self::Sphere { of, at } => of.draw(|subject, pile| {
                let site = match parse_site(at.as_deref(), pile)? {
                    Some(site) => site,
                    None => figure::example_site(pile)?,
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
                scene.spacing = Some("1".parse()?);
                of.draw_pile(&scene, &pile, |subject, _| Ok(figure::bounds(subject)?))
            }
            Self::Base(of) => of.draw_state(|subject, _| Ok(figure::base(subject)?)),
            Self::Response {
                of,
                fault_probability,
                profile,
                ..
            } if !fault_probability.is_empty() => {
                let layers = of.of.scene.read_wide_layers()?;
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
                of,
                layer,
                faults,
                component,
                ..
            } => {
                let (mut scene, mut pile) = match faults {
                    None => of.of.scene.read()?,
                    Some(faults) => of.of.scene.read_stacked(runs(faults)?)?,
                };
                if needs_a_top(&scene) {
                    scene.anchor =
                        Some(Anchor::Top(Region::hexagon(RESPONSE_SIDE, RESPONSE_SIDE)?));
                    pile = scene.pile()?;
                }
                let load = Component::load(*component, &scene)?;
                let pile = figure::with_load_on_top(pile, load)?;
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
                    let reason = if record.tally().shard == Shard::WHOLE {
                        "has no stackings at this fault probability: use another one, or draw more samples"
                    } else {
                        "is only a part of an ensemble: merge it with the others first"
                    };
                    Failure::Message(format!("{} {reason}", file.display()))
                })
            }
        }
    }
}

/// Parses the lengths of runs of equal signs. The first run has the sign +.
fn runs(text: &str) -> Result<Pattern, Failure> {
    let pattern = format!("({text})").parse();
    pattern.map_err(|_| {
        Failure::Message(format!(
            "--faults: {text} is not a list of numbers of steps: give numbers of at least 1, such as 2,3"
        ))
    })
}

/// Attributes an error to `--layer` instead of `--layers`.
fn of_layer(error: figure::Error) -> InputError {
    match error.into() {
        error @ (Error::Figure(figure::Error::TooManyGlyphs { .. })
        | Error::Core(cannonpile::Error::OnFloor { .. })) => InputError::of(Culprit::Layer, error),
        error => error.into(),
    }
}

/// Returns whether the scene gives neither a top nor loads, so that `plot response` uses its defaults.
fn needs_a_top(scene: &Scene) -> bool {
    scene.anchor.is_none()
        && scene.loads.is_empty()
        && scene.sin_phi.is_none()
        && scene.dimension == Dimension::Three
}

impl PileFigure {
    fn draw_stability(&self) -> Result<Figure, Failure> {
        let (scene, pile) = self.scene.read()?;
        // On an isosceles base, neighbours of a layer would overlap at a = R.
        let spacing = match scene.spacing {
            None if pile.is_regular() => "1".parse()?,
            _ => scene.spacing()?,
        };
        let subject = Subject::of_pile(&pile, &spacing)?;
        let progress = Progress::begin("searching for the contacts that open first");
        let drawn = figure::stability(&subject);
        drop(progress);
        Ok(drawn.map_err(|error| of_weight(&pile, error))?)
    }
}

impl ForceFigure {
    fn draw(
        &self,
        draw: impl FnOnce(&Subject<'_>, &Pile) -> Result<Figure, InputError>,
    ) -> Result<Figure, Failure> {
        let (scene, pile) = self.of.scene.read()?;
        self.draw_pile(&scene, &pile, draw)
    }

    /// Draws a figure of the state that `--state` selects.
    fn draw_state(
        &self,
        draw: impl FnOnce(&Subject<'_>, &Pile) -> Result<Figure, InputError>,
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
        draw: impl FnOnce(&Subject<'_>, &Pile) -> Result<Figure, InputError>,
    ) -> Result<Figure, Failure> {
        let subject = match self.units {
            UnitSystem::Pile => Subject::of_pile(pile, &scene.spacing()?)?,
            UnitSystem::Si => Subject::of_packing(scene.packing(pile)?),
        };
        let progress = Progress::begin("drawing");
        let drawn = draw(&subject, pile);
        drop(progress);
        // Figures use floats only.
        drawn.map_err(|refused| self.of.scene.overflow_failure(refused, scene))
    }
}
