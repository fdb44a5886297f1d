//! Scene options, from the command line and from a file.

use std::io::{self, Read};
use std::path::Path;

use cannonpile::Pile;
use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Dimension, Region};
use cannonpile::stacking::Pattern;
use cannonpile_dem::Key;
use cannonpile_dem::scene::{Anchor, Case, Floor, Scene, SceneFile, State, parse};
use clap::Args;
use num_rational::BigRational;
use num_traits::Zero;

use crate::input::Input;
use crate::output::{Failure, InputError, reason};
use crate::progress::Progress;
use crate::{Culprit, Error};

/// The reasons why random stackings exclude horizontal loads and a tilt, with the remedies.
pub(super) const VERTICAL_LOADS: &str =
    "random stackings support vertical loads only: leave out the horizontal components";
pub(super) const UPRIGHT_GRAVITY: &str = "random stackings support upright gravity only: leave it out, or use the commands for one stacking";

/// The top layer: a region, or for the command `mean` the whole plane.
#[derive(Clone, Copy)]
pub(crate) enum Top {
    Plane,
    Region(Region),
}

/// Reads a shape in any case. The error quotes the text as it was given.
pub(crate) fn shape(text: &str) -> Result<Region, cannonpile::Error> {
    (text.to_ascii_lowercase().parse()).or_else(|_| text.parse())
}

impl Top {
    fn region(text: &str) -> Result<Self, cannonpile::Error> {
        shape(text).map(Self::Region)
    }

    pub(crate) fn region_or_plane(text: &str) -> Result<Self, String> {
        if text == "plane" {
            return Ok(Self::Plane);
        }
        Self::region(text).map_err(|error| format!("{error}, or plane"))
    }
}

#[derive(Args, Clone, Default)]
#[command(next_help_heading = "Scene")]
pub(crate) struct SceneOptions {
    /// TOML file with these options, - for stdin; the command line overrides it
    #[arg(long = "scene", value_name = "FILE", allow_hyphen_values = true, value_parser = NamedFile::read)]
    scene_file: Option<NamedFile>,
    /// Benchmark case, as listed by 'cannonpile cases'; excludes all scene options but --state
    #[arg(
        long,
        value_name = "NAME",
        value_parser = NamedFile::of_case,
        conflicts_with_all = [
            "scene_file", "layers", "stacking", "top", "base", "dimension", "sin_phi", "load", "tilt", "weightless", "spacing", "radius",
            "mass", "gravity", "stiffness_ratio", "floor", "friction", "floor_friction",
        ]
    )]
    case: Option<NamedFile>,
    /// Number of layers, 1 to 10^36 [default: from a spelled-out --stacking or --base, otherwise 10]
    #[arg(long, value_name = "L", allow_hyphen_values = true, value_parser = parse::layers)]
    layers: Option<i128>,
    /// Stacking, from the top (with --base from the base): fcc, hcp, dhcp, or spelled out as ++-+, ABCBC, chh, (2,1,1) [default: fcc]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = str::parse::<Pattern>)]
    stacking: Option<Pattern>,
    /// Top layer: hexagon:P,Q, hexagon:N, triangle:N or region:x0..x1,y0..y1,s0..s1 [default: one sphere]
    #[arg(long, value_name = "SHAPE", allow_hyphen_values = true, value_parser = Top::region, conflicts_with = "base")]
    pub(super) top: Option<Top>,
    /// Bottom layer, with the pile above it; shapes as for --top
    #[arg(long, value_name = "SHAPE", allow_hyphen_values = true, value_parser = shape)]
    base: Option<Region>,
    /// Dimension: 2 for discs, 3 for spheres [default: 3]
    #[arg(long, value_name = "D", allow_hyphen_values = true, value_parser = str::parse::<Dimension>)]
    dimension: Option<Dimension>,
    /// Sine of the azimuth phi of the base triangle, between 0 and 1; excludes --stacking, --top, --base [default: 1/2, equilateral]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = parse::rational)]
    sin_phi: Option<BigRational>,
    /// Load on a sphere: W mg down, X mg·tanθ along x, Y √3·mg·tanθ along y; I,J=W on the base; repeatable; replaces the
    /// loads of a file
    #[arg(long, value_name = "K,I,J=W[,X,Y]", allow_hyphen_values = true)]
    load: Vec<String>,
    /// Tilt of gravity: horizontal over vertical part, in tanθ along x and √3·tanθ along y (2cosφ·tanθ with --sin-phi)
    /// [default: 0,0]
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true)]
    tilt: Option<String>,
    /// Spheres without weight, so that only the loads act; --weightless=false overrides a file
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true", hide_possible_values = true)]
    weightless: Option<bool>,
    /// Half the distance between horizontal neighbours over the radius, a/R, such as 6/5 or sqrt(2) [default: 6/5; 1 with --state elastic]
    #[arg(long, value_name = "Q", allow_hyphen_values = true, value_parser = str::parse::<Spacing>)]
    spacing: Option<Spacing>,
    /// Radius R of a sphere, in m [default: 1]
    #[arg(long, value_name = "R", allow_hyphen_values = true, value_parser = parse::rational)]
    radius: Option<BigRational>,
    /// Mass m of a sphere, in kg [default: 1]
    #[arg(long, value_name = "M", allow_hyphen_values = true, value_parser = parse::rational)]
    mass: Option<BigRational>,
    /// Gravity g, in m/s² [default: 1]
    #[arg(long, value_name = "G", allow_hyphen_values = true, value_parser = parse::rational)]
    gravity: Option<BigRational>,
    /// Equilibrium state: isostatic (no horizontal contacts) or elastic (compressive springs, at a = R) [default: isostatic]
    #[arg(long, value_name = "STATE", value_parser = str::parse::<State>)]
    state: Option<State>,
    /// Stiffness of horizontal contacts over that of sloping ones, with --state elastic [default: 1]
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = parse::rational)]
    stiffness_ratio: Option<BigRational>,
    /// Floor: glued, or rough for two layers with friction everywhere [default: glued]
    #[arg(long, value_name = "FLOOR", value_parser = str::parse::<Floor>)]
    floor: Option<Floor>,
    /// Coefficient of friction between spheres, with --floor rough [default: twice the needed one]
    #[arg(long, value_name = "MU", allow_hyphen_values = true, value_parser = parse::rational)]
    friction: Option<BigRational>,
    /// Coefficient of friction of the floor, with --floor rough [default: twice the needed one]
    #[arg(long, value_name = "MU", allow_hyphen_values = true, value_parser = parse::rational)]
    floor_friction: Option<BigRational>,
}

impl SceneOptions {
    /// Returns the options of the file `scene.toml` beside a table, with its name, or no options without such a file.
    pub(crate) fn beside(table: &Path) -> Result<(Self, Option<String>), Failure> {
        let path = table.with_file_name("scene.toml");
        if table == Path::new("-") || !path.is_file() {
            return Ok((Self::default(), None));
        }
        let name = path.display().to_string();
        let file =
            NamedFile::read(&name).map_err(|error| Failure::Message(format!("{name}: {error}")))?;
        let scene_file = Some(file);
        let options = Self {
            scene_file,
            ..Self::default()
        };
        Ok((options, Some(name)))
    }

    /// Returns the scene and its pile, in the isostatic state.
    ///
    /// This function checks sizes and weights even if the command does not use them.
    ///
    /// # Errors
    /// The options select the elastic state or a rough floor.
    pub(crate) fn read(&self) -> Result<(Scene, Pile), Failure> {
        Ok(check_scene(self.isostatic()?)?)
    }

    /// Returns the scene and its pile, with the horizontal forces of its state.
    pub(crate) fn read_state(&self) -> Result<(Scene, Pile), Failure> {
        let (scene, pile) = self.read_whole()?;
        let pile = in_state(&scene, pile)?;
        Ok((scene, pile))
    }

    /// Returns the scene with its state, and its pile without horizontal forces.
    ///
    /// # Errors
    /// The options select a rough floor, which only [`read_any`](Self::read_any) accepts.
    pub(crate) fn read_whole(&self) -> Result<(Scene, Pile), Failure> {
        let scene = self.on_glue()?;
        self.check_ratio(&scene)?;
        Ok(check_scene(scene)?)
    }

    /// Returns the scene with any state and floor, and its pile without horizontal forces.
    pub(crate) fn read_any(&self) -> Result<(Scene, Pile), Failure> {
        let scene = self.scene()?;
        self.check_ratio(&scene)?;
        Ok(check_scene(scene)?)
    }

    /// Returns the scene on a rough floor and its pile, with two layers by default.
    pub(crate) fn read_rough(&self) -> Result<(Scene, Pile), Failure> {
        let mut scene = self.scene()?;
        self.check_ratio(&scene)?;
        scene.floor = Floor::Rough;
        if scene.stacking.is_none() {
            scene.layers = scene.layers.or(Some(2));
        }
        Ok(check_scene(scene)?)
    }

    fn on_glue(&self) -> Result<Scene, Failure> {
        let scene = self.scene()?;
        if scene.floor == Floor::Glued {
            return Ok(scene);
        }
        Err(self.refuse(
            Key::Floor,
            "only base, contacts, summary, export, verify, plot friction and scene support a rough floor: use --floor glued",
        ))
    }

    fn check_ratio(&self, scene: &Scene) -> Result<(), Failure> {
        if self.stiffness_ratio.is_none() || scene.state == State::Elastic {
            return Ok(());
        }
        Err(Failure::Message(
            "--stiffness-ratio: only the elastic state has springs: add --state elastic, or leave it out"
                .to_owned(),
        ))
    }

    fn isostatic(&self) -> Result<Scene, Failure> {
        let scene = self.on_glue()?;
        self.refuse_elastic(&scene)?;
        self.check_ratio(&scene)?;
        Ok(scene)
    }

    /// Returns an error if the scene is in the elastic state.
    pub(crate) fn refuse_elastic(&self, scene: &Scene) -> Result<(), Failure> {
        if scene.state == State::Isostatic {
            return Ok(());
        }
        let remedy = match self.case {
            Some(_) => "add --state isostatic",
            None => "leave it out, or use isostatic",
        };
        let why = format!(
            "only base, contacts, export, verify, plot network and plot base support the elastic state: {remedy}"
        );
        Err(self.refuse(Key::State, &why))
    }

    /// Returns a scene that fits every stacking: a top layer and loads on it, or a base.
    ///
    /// # Errors
    /// The options fix a stacking, or depend on one.
    pub(crate) fn read_for_all_stackings(&self) -> Result<Scene, Failure> {
        let scene = self.isostatic()?;
        let refused = [
            (
                scene.stacking.is_some(),
                Key::Stacking,
                "this command covers every stacking: leave it out",
            ),
            (
                scene.dimension == Dimension::Two,
                Key::Dimension,
                "discs have only one stacking: use 3",
            ),
            (
                scene.sin_phi.is_some(),
                Key::SinPhi,
                "only the straight triangular pile can have an isosceles base: leave it out",
            ),
            (
                matches!(scene.anchor, Some(Anchor::Base(_))) && !scene.loads.is_empty(),
                Key::Load,
                "the position of a sphere above a base depends on the stacking: leave the loads out, or use --top",
            ),
            (
                scene.loads.iter().any(|(at, _)| at.layer != Some(0)),
                Key::Load,
                "the position of a sphere below the top layer depends on the stacking: put loads on the top layer, 0,I,J=W",
            ),
            (
                scene.loads.iter().any(|(_, load)| !load.is_vertical()),
                Key::Load,
                VERTICAL_LOADS,
            ),
            (
                !scene.tilt.iter().all(Zero::is_zero),
                Key::Tilt,
                UPRIGHT_GRAVITY,
            ),
        ];
        for (is_given, key, why) in refused {
            if is_given {
                return Err(self.refuse(key, why));
            }
        }
        scene.check_sizes()?;
        Ok(scene)
    }

    /// Returns the number of layers of a scene that fits every stacking.
    ///
    /// # Errors
    /// The scene has a base, and no number of layers.
    pub(crate) fn layers_of_all_stackings(&self, scene: &Scene) -> Result<i128, Failure> {
        match (scene.layers, scene.anchor) {
            (Some(layers), _) => Ok(layers),
            (None, Some(Anchor::Base(_))) => Err(self.refuse(
                Key::Base,
                "the height depends on the stacking: add --layers",
            )),
            (None, _) => Ok(Scene::LAYERS),
        }
    }

    /// Returns the number of layers below a wide top with one load of 1 mg, for every stacking.
    ///
    /// # Errors
    /// The options give another top or other loads.
    pub(crate) fn read_wide_layers(&self) -> Result<i128, Failure> {
        let scene = self.read_for_all_stackings()?;
        let anchor = match scene.anchor {
            Some(Anchor::Base(_)) => Key::Base,
            _ => Key::Top,
        };
        let refused = [
            (scene.anchor.is_some(), anchor),
            (!scene.loads.is_empty(), Key::Load),
        ];
        for (is_given, key) in refused {
            if is_given {
                let why = "--fault-probability always uses a load of 1 mg on a wide top: leave it out, or use the command mean";
                return Err(self.refuse(key, why));
            }
        }
        Ok(scene.layers.unwrap_or(Scene::LAYERS))
    }

    /// Returns the scene and its pile, with the stacking that `--faults` gives.
    pub(crate) fn read_stacked(&self, stacking: Pattern) -> Result<(Scene, Pile), Failure> {
        let mut scene = self.isostatic()?;
        let given = [
            (scene.stacking.is_some(), Key::Stacking),
            (scene.layers.is_some(), Key::Layers),
        ];
        if let Some((_, key)) = given.into_iter().find(|(is_given, _)| *is_given) {
            let why = "--faults already gives the stacking and the number of layers: leave one of the two out";
            return Err(self.refuse(key, why));
        }
        scene.stacking = Some(stacking);
        Ok(check_scene(scene)?)
    }

    /// Returns the scene and its pile, with `layers` as the default number of layers.
    pub(crate) fn read_or(&self, layers: i128) -> Result<(Scene, Pile), Failure> {
        let mut scene = self.isostatic()?;
        let spelled = scene.stacking.as_ref().and_then(Pattern::layers);
        if spelled.is_none() && !matches!(scene.anchor, Some(Anchor::Base(_))) {
            scene.layers = scene.layers.or(Some(layers));
        }
        Ok(check_scene(scene)?)
    }

    /// Returns the file or the benchmark case that the command line overrides.
    fn file(&self) -> Option<&NamedFile> {
        self.scene_file.as_ref().or(self.case.as_ref())
    }

    /// Returns the benchmark case of `--case`, if no option changes its scene.
    pub(crate) fn case(&self, scene: &Scene) -> Option<&'static Case> {
        let named = self.case.as_ref()?;
        named.case.filter(|_| named.content.scene() == scene)
    }

    /// Returns the scene of the file, overridden by the options of the command line.
    pub(super) fn scene(&self) -> Result<Scene, InputError> {
        let file = self.file().map(|file| file.content.scene().clone());
        let file = file.unwrap_or_default();
        let dimension = self.dimension.unwrap_or(file.dimension);
        let load = |text: &String| {
            parse::load(text, dimension).map_err(|error| InputError::of(Key::Load, error))
        };
        let loads: Vec<_> = self.load.iter().map(load).collect::<Result<_, _>>()?;
        let tilt = |text: &String| {
            parse::tilt(text, dimension).map_err(|error| InputError::of(Key::Tilt, error))
        };
        let tilt = self.tilt.as_ref().map(tilt).transpose()?;
        let anchor = match (self.top, self.base) {
            (Some(Top::Plane), _) => None,
            (Some(Top::Region(top)), _) => Some(Anchor::Top(top)),
            (None, Some(base)) => Some(Anchor::Base(base)),
            (None, None) => file.anchor,
        };
        Ok(Scene {
            layers: self.layers.or(file.layers),
            dimension,
            sin_phi: self.sin_phi.clone().or(file.sin_phi),
            stacking: self.stacking.clone().or(file.stacking),
            anchor,
            loads: if loads.is_empty() { file.loads } else { loads },
            tilt: tilt.unwrap_or(file.tilt),
            weightless: self.weightless.unwrap_or(file.weightless),
            spacing: self.spacing.clone().or(file.spacing),
            radius: self.radius.clone().unwrap_or(file.radius),
            mass: self.mass.clone().unwrap_or(file.mass),
            gravity: self.gravity.clone().unwrap_or(file.gravity),
            state: self.state.unwrap_or(file.state),
            stiffness_ratio: self.stiffness_ratio.clone().unwrap_or(file.stiffness_ratio),
            floor: self.floor.unwrap_or(file.floor),
            friction: self.friction.clone().or(file.friction),
            floor_friction: self.floor_friction.clone().or(file.floor_friction),
        })
    }

    /// Returns whether the scene file is read from stdin.
    pub(crate) fn is_from_stdin(options: Option<&Self>) -> bool {
        let file = options.and_then(|options| options.scene_file.as_ref());
        file.is_some_and(|file| file.name == "-")
    }

    /// Converts an error of a command that always computes in floats.
    ///
    /// Such a command overflows only because of the sizes, so the message names the size that is farthest from 1.
    pub(crate) fn overflow_failure(&self, refused: InputError, scene: &Scene) -> Failure {
        let Error::Core(cannonpile::Error::Overflow {
            quantity, scalar, ..
        }) = &*refused.error
        else {
            return refused.into();
        };
        let (place, remedy) = match farthest_from_one(scene) {
            Key::Load => (self.place(Key::Load), "use smaller loads"),
            Key::Tilt => (self.place(Key::Tilt), "use a smaller tilt"),
            key => (
                self.place(key),
                "give radius, mass and gravity in other units",
            ),
        };
        Failure::Message(format!(
            "{place}: {quantity} does not fit in {scalar}: {remedy}"
        ))
    }

    /// Returns the place of the size to change after an overflow: an option, or a line of the file.
    pub(crate) fn place_of_size(&self, scene: &Scene) -> String {
        self.place(farthest_from_one(scene))
    }

    /// Returns the option as the user gave it: `--option`, or its line in the file.
    pub(crate) fn place(&self, key: Key) -> String {
        let option = key.name();
        self.line_of(option)
            .unwrap_or_else(|| format!("--{option}"))
    }

    /// Returns the error that a command does not support an option, with the place of the option.
    pub(super) fn refuse(&self, key: Key, why: &str) -> Failure {
        Failure::Message(format!("{}: {why}", self.place(key)))
    }

    /// Returns the line of the file that gives an option, unless the command line overrides it.
    pub(crate) fn line_of(&self, option: &str) -> Option<String> {
        let file = self.file()?;
        file.place_of(option).filter(|_| !self.gives(option))
    }

    /// Formats an error: the option or the line of the file to change, the reason, and the remedy.
    pub(crate) fn message(scene: Option<&Self>, refused: &InputError) -> String {
        let line_of = |option| scene.and_then(|scene| scene.line_of(option));
        let error = &refused.error;
        let place = refused.culprit.and_then(Culprit::option).map(|option| {
            let line = line_of(option);
            line.unwrap_or_else(|| format!("--{option}")) + ": "
        });
        let place = place.unwrap_or_default();
        // If two options exclude each other, the message also names the line of the other one in the file.
        let other = error.conflicts_with().map(Key::name).and_then(line_of);
        let notes = other.or(refused.remedy.map(str::to_owned));
        let notes = notes.map_or_else(String::new, |notes| format!(" ({notes})"));
        format!("{place}{error}{notes}")
    }

    /// Returns whether the command line gives this option, or one that replaces it.
    pub(super) fn gives(&self, option: &str) -> bool {
        match option {
            "layers" => self.layers.is_some(),
            "stacking" => self.stacking.is_some(),
            "top" | "base" => self.top.is_some() || self.base.is_some(),
            "dimension" => self.dimension.is_some(),
            "sin-phi" => self.sin_phi.is_some(),
            "load" => !self.load.is_empty(),
            "tilt" => self.tilt.is_some(),
            "weightless" => self.weightless.is_some(),
            "spacing" => self.spacing.is_some(),
            "radius" => self.radius.is_some(),
            "mass" => self.mass.is_some(),
            "gravity" => self.gravity.is_some(),
            "state" => self.state.is_some(),
            "stiffness-ratio" => self.stiffness_ratio.is_some(),
            "floor" => self.floor.is_some(),
            "friction" => self.friction.is_some(),
            "floor-friction" => self.floor_friction.is_some(),
            _ => false,
        }
    }
}

/// Returns the size that is farthest from 1. The radius is considered only if its cube is outside the range of `f64`.
fn farthest_from_one(scene: &Scene) -> Key {
    const FLOATS: u64 = f64::MAX_EXP.unsigned_abs() as u64;
    let distance = |size: &BigRational| size.numer().bits().abs_diff(size.denom().bits());
    let loads = scene.loads.iter().flat_map(|(_, load)| {
        let parts = [&load.down, &load.x, &load.y];
        parts.map(|part| (Key::Load, part))
    });
    let tilt = scene.tilt.iter().map(|part| (Key::Tilt, part));
    let sizes = [
        (Key::Radius, &scene.radius),
        (Key::Gravity, &scene.gravity),
        (Key::Mass, &scene.mass),
    ];
    let sizes = loads
        .chain(tilt)
        .chain(sizes)
        .filter(|(key, size)| *key != Key::Radius || 3 * distance(size) >= FLOATS);
    let farthest = sizes.max_by_key(|(_, size)| distance(size));
    farthest.map_or(Key::Mass, |(key, _)| key)
}

/// Returns the pile with the horizontal forces of the state of the scene.
pub(crate) fn in_state(scene: &Scene, pile: Pile) -> Result<Pile, InputError> {
    let progress = Progress::begin("computing the elastic state");
    let pile = scene.in_state(pile)?;
    drop(progress);
    Ok(pile)
}

/// Checks the sizes of a scene, and returns it with its pile.
fn check_scene(scene: Scene) -> Result<(Scene, Pile), InputError> {
    scene.check_sizes()?;
    let pile = scene.pile().map_err(|error| match error.into() {
        // The loads contain the only sites of a scene.
        error @ Error::Core(
            cannonpile::Error::SiteOutside { .. } | cannonpile::Error::LayerOutside { .. },
        ) => InputError::of(Key::Load, error),
        error => error.into(),
    })?;
    Ok((scene, pile))
}

/// A scene file with its name on the command line, or a benchmark case.
#[derive(Clone)]
struct NamedFile {
    name: String,
    content: SceneFile,
    case: Option<&'static Case>,
}

impl NamedFile {
    /// Returns the position of an option: the file, the line and the name.
    fn place_of(&self, option: &str) -> Option<String> {
        let line = self.content.line(option)?;
        if let Some(case) = self.case {
            return Some(format!("--case {}: {option}", case.name()));
        }
        Some(format!("--scene {}: line {line}, {option}", self.name))
    }

    fn read(name: &str) -> Result<Self, String> {
        let text = text_of(name).map_err(|error| {
            let reason = match error.kind() {
                io::ErrorKind::InvalidData => "not text in UTF-8".into(),
                _ => reason(&error),
            };
            format!("{reason}; give a readable TOML file, or - for stdin")
        })?;
        let content = text.parse::<SceneFile>();
        let content = content.map_err(|error| error.to_string())?;
        Ok(Self {
            name: name.into(),
            content,
            case: None,
        })
    }

    fn of_case(name: &str) -> Result<Self, Error> {
        let case = Case::named(name)?;
        Ok(Self {
            name: case.name().into(),
            content: case.file()?,
            case: Some(case),
        })
    }
}

/// The largest number of bytes to read. It is above the limit of a scene file, so a longer file is rejected.
const MAX_SCENE_BYTES: u64 = 32 << 20;

fn text_of(name: &str) -> io::Result<String> {
    let mut bytes = Vec::new();
    let file = Input::open(Path::new(name), false)?;
    let read = file.take(MAX_SCENE_BYTES).read_to_end(&mut bytes)?;
    // A text of this length is too long. The cut may split a character, which is not an error of the text.
    if read as u64 == MAX_SCENE_BYTES {
        return Ok(String::from_utf8_lossy(&bytes).into_owned());
    }
    String::from_utf8(bytes).map_err(|_| io::ErrorKind::InvalidData.into())
}
