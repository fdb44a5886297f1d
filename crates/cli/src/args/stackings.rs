//! Options of `mean`: a scene without a stacking, because the mean is over all stackings.

use cannonpile::Load;
use cannonpile::lattice::{Dimension, Region};
use cannonpile_dem::Key;
use cannonpile_dem::scene::parse::At;
use cannonpile_dem::scene::{Anchor, Floor, Scene, State, parse};
use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
use clap::Args;
use num_traits::Zero;

use super::scene::{NamedFile, UPRIGHT_GRAVITY, VERTICAL_LOADS};
use crate::Culprit;
use crate::output::{Failure, InputError};

/// The top layer of random stackings: a region, or the whole plane.
#[derive(Clone, Copy)]
enum Top {
    Plane,
    Region(Region),
}

impl Top {
    fn read(text: &str) -> Result<Self, String> {
        if text == "plane" {
            return Ok(Self::Plane);
        }
        let region = text.parse::<Region>().map(Self::Region);
        region.map_err(|error| format!("{error}, or plane"))
    }
}

#[derive(Args)]
#[command(next_help_heading = "Scene")]
pub(crate) struct RandomSceneOptions {
    /// TOML file with layers, top or base, load and weightless, - for stdin; the command line overrides it
    #[arg(long = "scene", value_name = "FILE", allow_hyphen_values = true, value_parser = NamedFile::read)]
    scene_file: Option<NamedFile>,
    /// Number of layers, 1 to 10^36; required with --base [default: 10]
    #[arg(long, value_name = "L", allow_hyphen_values = true, value_parser = parse::layers)]
    layers: Option<i128>,
    /// Top layer: hexagon:P,Q, hexagon:N, triangle:N, region:x0..x1,y0..y1,s0..s1, or plane (infinite; requires --weightless
    /// and --load) [default: one sphere]
    #[arg(long, value_name = "SHAPE", allow_hyphen_values = true, value_parser = Top::read, conflicts_with = "base")]
    top: Option<Top>,
    /// Bottom layer, with the pile above it; shapes as for --top
    #[arg(long, value_name = "SHAPE", allow_hyphen_values = true, value_parser = str::parse::<Region>)]
    base: Option<Region>,
    /// Vertical load W on a sphere of the top layer, in mg; repeatable; replaces the loads of a file
    #[arg(long, value_name = "0,I,J=W", allow_hyphen_values = true)]
    load: Vec<String>,
    /// Spheres without weight, so that only the loads act; --weightless=false overrides a file
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true", hide_possible_values = true)]
    weightless: Option<bool>,
    /// Sign of the first step, below the top layer: +, - or random (probability 1/2 each)
    #[arg(long, value_name = "SIGN", default_value = "+", allow_hyphen_values = true, value_parser = str::parse::<FirstSign>)]
    first: FirstSign,
    #[command(flatten)]
    unsupported: UnsupportedOptions,
}

/// Scene options that `mean` does not support. Each is rejected with the reason.
#[derive(Args)]
struct UnsupportedOptions {
    #[arg(long, hide = true, allow_hyphen_values = true)]
    stacking: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    tilt: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    dimension: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    sin_phi: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    spacing: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    state: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    stiffness_ratio: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    floor: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    friction: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    floor_friction: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    radius: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    mass: Option<String>,
    #[arg(long, hide = true, allow_hyphen_values = true)]
    gravity: Option<String>,
}

impl UnsupportedOptions {
    fn given(&self) -> Option<Key> {
        let options = [
            (Key::Stacking, &self.stacking),
            (Key::Tilt, &self.tilt),
            (Key::Dimension, &self.dimension),
            (Key::SinPhi, &self.sin_phi),
            (Key::Spacing, &self.spacing),
            (Key::State, &self.state),
            (Key::StiffnessRatio, &self.stiffness_ratio),
            (Key::Floor, &self.floor),
            (Key::Friction, &self.friction),
            (Key::FloorFriction, &self.floor_friction),
            (Key::Radius, &self.radius),
            (Key::Mass, &self.mass),
            (Key::Gravity, &self.gravity),
        ];
        let given = options.into_iter().find(|(_, given)| given.is_some());
        given.map(|(key, _)| key)
    }
}

/// Returns a key of a scene file that `mean` does not support. Radius, mass, gravity and stiffness ratio are ignored.
fn unsupported_key(scene: &Scene) -> Option<Key> {
    if scene.stacking.is_some() {
        Some(Key::Stacking)
    } else if !scene.tilt.iter().all(Zero::is_zero) {
        Some(Key::Tilt)
    } else if scene.dimension != Dimension::Three {
        Some(Key::Dimension)
    } else if scene.sin_phi.is_some() {
        Some(Key::SinPhi)
    } else if scene.spacing.is_some() {
        Some(Key::Spacing)
    } else if scene.state != State::Isostatic {
        Some(Key::State)
    } else if scene.floor != Floor::Glued {
        Some(Key::Floor)
    } else {
        None
    }
}

/// Returns the reason why `mean` does not support an option, and the remedy.
const fn reason(key: Key) -> &'static str {
    match key {
        Key::Stacking => "the mean is over all stackings: leave it out, or use the command base",
        Key::Tilt => UPRIGHT_GRAVITY,
        Key::Floor | Key::Friction | Key::FloorFriction => {
            "random stackings stand on a floor with glue: leave it out"
        }
        Key::Dimension | Key::SinPhi => {
            "random stackings consist of spheres on an equilateral lattice: leave it out"
        }
        Key::Spacing | Key::State | Key::StiffnessRatio => {
            "mean does not include horizontal contacts, and its forces do not depend on the spacing: leave it out"
        }
        _ => "the mean is in multiples of mg: leave it out",
    }
}

impl RandomSceneOptions {
    /// Returns the random piles that the options describe.
    pub(crate) fn read(&self) -> Result<RandomPiles, Failure> {
        if let Some(key) = self.unsupported.given() {
            return Err(Failure::Message(format!("--{key}: {}", reason(key))));
        }
        let file = self.scene_file.as_ref().map(NamedFile::scene);
        if let Some(key) = file.and_then(unsupported_key) {
            let place = self.place(key.into());
            return Err(Failure::Message(format!("{place}: {}", reason(key))));
        }
        let piles = self.piles(file)?;
        let loads = self.loads(file)?;
        let blamed = |error| self.refused(InputError::of(Key::Load, error));
        let layers = piles.stackings().layers();
        if loads.iter().any(|(_, load)| !load.is_vertical()) {
            let place = self.place(Key::Load.into());
            return Err(Failure::Message(format!("{place}: {VERTICAL_LOADS}")));
        }
        let piles = loads.into_iter().try_fold(piles, |piles, (at, load)| {
            piles.with_load(at.site(layers), load.down).map_err(blamed)
        })?;
        // Spheres have weight unless an option or a file says otherwise.
        let weightless = self
            .weightless
            .or(file.map(|scene| scene.weightless))
            .unwrap_or(false);
        Ok(if weightless {
            piles.weightless()
        } else {
            piles
        })
    }

    /// Returns the random piles, before loads are added.
    fn piles(&self, file: Option<&Scene>) -> Result<RandomPiles, Failure> {
        let of_file = file
            .and_then(|scene| scene.anchor)
            .map(|anchor| match anchor {
                Anchor::Top(top) => (Some(Top::Region(top)), None),
                Anchor::Base(base) => (None, Some(base)),
            });
        let of_line = (self.top.is_some() || self.base.is_some()).then_some((self.top, self.base));
        let (top, base) = of_line.or(of_file).unwrap_or((None, None));
        let layers = self.layers.or(file.and_then(|scene| scene.layers));
        let layers = match (layers, base) {
            (Some(layers), _) => layers,
            (None, None) => 10,
            (None, Some(_)) => {
                return Err(Failure::Message(
                    "--base: the height depends on the stacking: add --layers".to_owned(),
                ));
            }
        };
        let stackings = RandomStackings::new(layers, self.first)?;
        Ok(match (top, base) {
            (_, Some(base)) => RandomPiles::on(base, stackings),
            (Some(Top::Plane), None) => RandomPiles::plane(stackings),
            (Some(Top::Region(top)), None) => RandomPiles::under(top, stackings),
            (None, None) => RandomPiles::under(Region::SITE, stackings),
        })
    }

    fn loads(&self, file: Option<&Scene>) -> Result<Vec<(At, Load)>, InputError> {
        if self.load.is_empty() {
            return Ok(file.map_or_else(Vec::new, |scene| scene.loads.clone()));
        }
        let load = |text: &String| parse::load(text, Dimension::Three);
        let loads: Result<_, _> = self.load.iter().map(load).collect();
        loads.map_err(|error| InputError::of(Key::Load, error))
    }

    /// Formats an error with the option to change, or with its line in the scene file.
    pub(crate) fn refused(&self, refused: impl Into<InputError>) -> Failure {
        let refused = refused.into();
        let option = refused.culprit.filter(|culprit| culprit.option().is_some());
        match option {
            Some(culprit) => {
                Failure::Message(format!("{}: {}", self.place(culprit), refused.error))
            }
            None => refused.into(),
        }
    }

    /// Returns the option as the user gave it: `--option`, or its line in the file.
    fn place(&self, culprit: Culprit) -> String {
        let on_line = match culprit {
            Culprit::Key(Key::Layers) => self.layers.is_some(),
            Culprit::Key(Key::Top | Key::Base) => self.top.is_some() || self.base.is_some(),
            Culprit::Key(Key::Load) => !self.load.is_empty(),
            Culprit::Key(Key::Weightless) => self.weightless.is_some(),
            _ => false,
        };
        let file = self.scene_file.as_ref().filter(|_| !on_line);
        let place = file.and_then(|file| file.place_of(culprit.name()));
        place.unwrap_or_else(|| format!("--{culprit}"))
    }
}
