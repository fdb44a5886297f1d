//! The scene options, on the line and in a file.

use std::fs::File;
use std::io::{self, Read};

use cannonpile::Pile;
use cannonpile::lattice::{Dimension, Region};
use cannonpile::stacking::Pattern;
use cannonpile_dem::Key;
use cannonpile_dem::scene::{Anchor, Case, Scene, SceneFile, State, parse};
use clap::Args;
use num_rational::BigRational;

use crate::output::{Failure, Refused, reason};
use crate::progress::Progress;
use crate::{Culprit, Error};

#[derive(Args)]
#[command(next_help_heading = "Scene")]
pub(crate) struct SceneOptions {
    /// Read these options from a TOML file, - for stdin; options on the command line win over it
    #[arg(long = "scene", value_name = "FILE", allow_hyphen_values = true, value_parser = NamedFile::read)]
    scene_file: Option<NamedFile>,
    /// The scene of a benchmark case, C1, C2, …, which 'cannonpile cases' lists; beside it only --state
    #[arg(
        long,
        value_name = "NAME",
        value_parser = NamedFile::of_case,
        conflicts_with_all = [
            "scene_file", "layers", "stacking", "top", "base", "dimension", "sin_phi", "load", "weightless", "spacing", "radius",
            "mass", "gravity", "stiffness_ratio",
        ]
    )]
    case: Option<NamedFile>,
    /// Number of layers, 1 to 10^36 [default: 10; as many as a stacking that is spelled out has, or as a base carries]
    #[arg(long, value_name = "L", allow_hyphen_values = true, value_parser = parse::layers)]
    layers: Option<i128>,
    /// How the layers are stacked: fcc, hcp, dhcp, or spelled out as ++-+, ABCBC, chh or (2,1,1); read from the top, or with
    /// --base from the base up [default: fcc]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = str::parse::<Pattern>)]
    stacking: Option<Pattern>,
    /// Grow down from this layer: hexagon:P,Q, hexagon:N, triangle:N or region:x0..x1,y0..y1,s0..s1 [default: one sphere]
    #[arg(long, value_name = "SHAPE", allow_hyphen_values = true, value_parser = str::parse::<Region>, conflicts_with = "base")]
    top: Option<Region>,
    /// Grow up from this layer, instead of down from --top
    #[arg(long, value_name = "SHAPE", allow_hyphen_values = true, value_parser = str::parse::<Region>)]
    base: Option<Region>,
    /// 2 for discs, 3 for spheres [default: 3]
    #[arg(long, value_name = "D", allow_hyphen_values = true, value_parser = str::parse::<Dimension>)]
    dimension: Option<Dimension>,
    /// Sine of the azimuth phi of the base triangle, between 0 and 1; without --stacking, --top and --base [default: 1/2, equilateral]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = parse::rational)]
    sin_phi: Option<BigRational>,
    /// A vertical load W on one sphere, in mg; I,J=W on the base; may be repeated; takes the place of all loads of a file
    #[arg(long, value_name = "K,I,J=W", allow_hyphen_values = true)]
    load: Vec<String>,
    /// The spheres weigh nothing: only the loads act; --weightless=false overrides a file
    #[arg(long, value_name = "BOOL", num_args = 0..=1, require_equals = true, default_missing_value = "true", hide_possible_values = true)]
    weightless: Option<bool>,
    /// Half the distance of horizontal neighbours over the radius, a/R [default: 6/5 where it is needed; 1 for the elastic state]
    #[arg(long, value_name = "Q", allow_hyphen_values = true, value_parser = parse::rational)]
    spacing: Option<BigRational>,
    /// Radius R of a sphere, in m [default: 1]
    #[arg(long, value_name = "R", allow_hyphen_values = true, value_parser = parse::rational)]
    radius: Option<BigRational>,
    /// Mass m of a sphere, in kg [default: 1]
    #[arg(long, value_name = "M", allow_hyphen_values = true, value_parser = parse::rational)]
    mass: Option<BigRational>,
    /// Gravity g, in m/s² [default: 1]
    #[arg(long, value_name = "G", allow_hyphen_values = true, value_parser = parse::rational)]
    gravity: Option<BigRational>,
    /// Which forces are meant, isostatic or elastic: without horizontal contacts, or those of springs that only push, at a = R;
    /// for base, contacts, export, verify, plot network and plot base [default: isostatic]
    #[arg(long, value_name = "STATE", value_parser = str::parse::<State>)]
    state: Option<State>,
    /// Stiffness of horizontal contacts over that of sloping ones, of the elastic state [default: 1]
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = parse::rational)]
    stiffness_ratio: Option<BigRational>,
}

impl SceneOptions {
    /// Returns the scene described, and its pile.
    ///
    /// Sizes and weights are checked here: a value that is given is wrong whether it is used or not.
    /// Nothing but [`read_state`](Self::read_state) knows of another state than the isostatic one.
    pub(crate) fn read(&self) -> Result<(Scene, Pile), Failure> {
        Ok(checked(self.isostatic()?)?)
    }

    /// Returns the scene described, and its pile with the horizontal forces of its state.
    pub(crate) fn read_state(&self) -> Result<(Scene, Pile), Failure> {
        let (scene, pile) = self.read_whole()?;
        let progress = Progress::begin("finding the elastic state");
        let pile = scene.in_state(pile)?;
        drop(progress);
        Ok((scene, pile))
    }

    /// Returns the scene described, with its state, and its pile, of whose horizontal contacts nothing is known.
    pub(crate) fn read_whole(&self) -> Result<(Scene, Pile), Failure> {
        let scene = self.scene()?;
        self.check_ratio(&scene)?;
        Ok(checked(scene)?)
    }

    fn check_ratio(&self, scene: &Scene) -> Result<(), Failure> {
        if self.stiffness_ratio.is_none() || scene.state == State::Elastic {
            return Ok(());
        }
        Err(Failure::Message(
            "--stiffness-ratio: it is that of springs: give --state elastic, or leave it out"
                .to_owned(),
        ))
    }

    fn isostatic(&self) -> Result<Scene, Failure> {
        let scene = self.scene()?;
        if scene.state == State::Isostatic {
            self.check_ratio(&scene)?;
            return Ok(scene);
        }
        let place = self.place(Key::State);
        let remedy = match self.case {
            Some(_) => "give --state isostatic beside it",
            None => "leave it out, or use isostatic",
        };
        Err(Failure::Message(format!(
            "{place}: the elastic state is that of base, contacts, export, verify, plot network and plot base: {remedy}"
        )))
    }

    /// Returns the scene described, of which every stacking is meant: the layer on top, and what is put on it.
    pub(crate) fn of_all_stackings(&self) -> Result<Scene, Failure> {
        let scene = self.isostatic()?;
        let refused = [
            (
                scene.stacking.is_some(),
                Key::Stacking,
                "every stacking is meant: leave it out",
            ),
            (
                matches!(scene.anchor, Some(Anchor::Base(_))),
                Key::Base,
                "which layers a base carries depends on the stacking, and they are not gone through from there: use --top, or \
                 census --base",
            ),
            (
                scene.dimension == Dimension::Two,
                Key::Dimension,
                "discs have one stacking only: use 3",
            ),
            (
                scene.sin_phi.is_some(),
                Key::SinPhi,
                "other stackings than the paper's have an equilateral base: leave it out",
            ),
            (
                scene.loads.iter().any(|(at, _)| at.layer != Some(0)),
                Key::Load,
                "a sphere below the top layer is another one in another stacking: put loads on the top layer, 0,I,J=W",
            ),
        ];
        for (is_given, key, why) in refused {
            if is_given {
                let place = self.place(key);
                return Err(Failure::Message(format!("{place}: {why}")));
            }
        }
        scene.check_sizes()?;
        Ok(scene)
    }

    /// Returns how many layers there are below a wide top, whatever their stacking, and one load on it.
    pub(crate) fn of_wide_layers(&self) -> Result<i128, Failure> {
        let scene = self.of_all_stackings()?;
        let refused = [
            (scene.anchor.is_some(), Key::Top),
            (!scene.loads.is_empty(), Key::Load),
        ];
        for (is_given, key) in refused {
            if is_given {
                let place = self.place(key);
                return Err(Failure::Message(format!(
                    "{place}: with --fault-probability the load is 1 mg on a wide top: leave it out, or use mean"
                )));
            }
        }
        Ok(scene.layers.unwrap_or(Scene::LAYERS))
    }

    /// Returns the scene described and its pile, with a stacking that another option spells out.
    pub(crate) fn read_stacked(&self, stacking: Pattern) -> Result<(Scene, Pile), Failure> {
        let mut scene = self.isostatic()?;
        let given = [
            (scene.stacking.is_some(), Key::Stacking),
            (scene.layers.is_some(), Key::Layers),
        ];
        if let Some((_, key)) = given.into_iter().find(|(is_given, _)| *is_given) {
            let place = self.place(key);
            return Err(Failure::Message(format!(
                "{place}: --faults spells out the stacking, and with it the layers: leave out one of them"
            )));
        }
        scene.stacking = Some(stacking);
        Ok(checked(scene)?)
    }

    /// Returns the scene described and its pile, of this many layers where nothing says how many.
    pub(crate) fn read_or(&self, layers: i128) -> Result<(Scene, Pile), Failure> {
        let mut scene = self.isostatic()?;
        let spelled = scene.stacking.as_ref().and_then(Pattern::layers);
        if spelled.is_none() && !matches!(scene.anchor, Some(Anchor::Base(_))) {
            scene.layers = scene.layers.or(Some(layers));
        }
        Ok(checked(scene)?)
    }

    /// The file or the case that options on the line win over.
    fn file(&self) -> Option<&NamedFile> {
        self.scene_file.as_ref().or(self.case.as_ref())
    }

    /// Returns the case that was asked for, if the scene is that of the case.
    pub(crate) fn case(&self, scene: &Scene) -> Option<&'static Case> {
        let named = self.case.as_ref()?;
        named.case.filter(|_| named.content.scene() == scene)
    }

    /// That of the file, with the options on the line in place of its own.
    fn scene(&self) -> Result<Scene, Refused> {
        let file = self.file().map(|file| file.content.scene().clone());
        let file = file.unwrap_or_default();
        let dimension = self.dimension.unwrap_or(file.dimension);
        let load = |text: &String| {
            parse::load(text, dimension).map_err(|error| Refused::of(Key::Load, error))
        };
        let loads: Vec<_> = self.load.iter().map(load).collect::<Result<_, _>>()?;
        let anchor = self.top.map(Anchor::Top).or(self.base.map(Anchor::Base));
        Ok(Scene {
            layers: self.layers.or(file.layers),
            dimension,
            sin_phi: self.sin_phi.clone().or(file.sin_phi),
            stacking: self.stacking.clone().or(file.stacking),
            anchor: anchor.or(file.anchor),
            loads: if loads.is_empty() { file.loads } else { loads },
            weightless: self.weightless.unwrap_or(file.weightless),
            spacing: self.spacing.clone().or(file.spacing),
            radius: self.radius.clone().unwrap_or(file.radius),
            mass: self.mass.clone().unwrap_or(file.mass),
            gravity: self.gravity.clone().unwrap_or(file.gravity),
            state: self.state.unwrap_or(file.state),
            stiffness_ratio: self.stiffness_ratio.clone().unwrap_or(file.stiffness_ratio),
        })
    }

    /// Whether the file took all of stdin.
    pub(crate) fn is_from_stdin(&self) -> bool {
        self.scene_file
            .as_ref()
            .is_some_and(|file| file.name == "-")
    }

    /// Returns the failure of a command whose numbers are floats: what does not fit there comes of the sizes.
    pub(crate) fn beyond_floats(&self, refused: Refused, scene: &Scene) -> Failure {
        let Error::Core(cannonpile::Error::Overflow {
            quantity, scalar, ..
        }) = &*refused.error
        else {
            return refused.into();
        };
        let (place, remedy) = match farthest_from_one(scene) {
            Key::Load => (self.place(Key::Load), "use smaller loads"),
            key => (
                self.place(key),
                "give radius, mass and gravity in other units",
            ),
        };
        Failure::Message(format!(
            "{place}: {quantity} does not fit in {scalar}: {remedy}"
        ))
    }

    /// Returns the size of a scene to change where a number does not fit, on the line or in the file.
    pub(crate) fn place_of_size(&self, scene: &Scene) -> String {
        self.place(farthest_from_one(scene))
    }

    /// Returns the option, or where it is in the file.
    fn place(&self, key: Key) -> String {
        let option = key.name();
        self.line_of(option)
            .unwrap_or_else(|| format!("--{option}"))
    }

    /// Returns where the file gives an option that the line does not.
    pub(crate) fn line_of(&self, option: &str) -> Option<String> {
        let file = self.file()?;
        file.place_of(option).filter(|_| !self.gives(option))
    }

    /// Returns the refusal as a message: the option or the line of the file to change, what is wrong, and the remedy.
    pub(crate) fn message(scene: Option<&Self>, refused: &Refused) -> String {
        let line_of = |option| scene.and_then(|scene| scene.line_of(option));
        let error = &refused.error;
        let place = refused.culprit.and_then(Culprit::option).map(|option| {
            let line = line_of(option);
            line.unwrap_or_else(|| format!("--{option}")) + ": "
        });
        let place = place.unwrap_or_default();
        // Where the other of two inputs that exclude each other is, if it is in the file.
        let other = error.conflicts_with().map(Key::name).and_then(line_of);
        let notes = other.or(refused.remedy.map(str::to_owned));
        let notes = notes.map_or_else(String::new, |notes| format!(" ({notes})"));
        format!("{place}{error}{notes}")
    }

    /// Whether the option, or one in whose place it would be, is on the line.
    fn gives(&self, option: &str) -> bool {
        match option {
            "layers" => self.layers.is_some(),
            "stacking" => self.stacking.is_some(),
            "top" | "base" => self.top.is_some() || self.base.is_some(),
            "dimension" => self.dimension.is_some(),
            "sin-phi" => self.sin_phi.is_some(),
            "load" => !self.load.is_empty(),
            "weightless" => self.weightless.is_some(),
            "spacing" => self.spacing.is_some(),
            "radius" => self.radius.is_some(),
            "mass" => self.mass.is_some(),
            "gravity" => self.gravity.is_some(),
            "state" => self.state.is_some(),
            "stiffness-ratio" => self.stiffness_ratio.is_some(),
            _ => false,
        }
    }
}

/// Returns the size that is farthest from 1; the radius only if its cube leaves the floats.
fn farthest_from_one(scene: &Scene) -> Key {
    const FLOATS: u64 = f64::MAX_EXP.unsigned_abs() as u64;
    let distance = |size: &BigRational| size.numer().bits().abs_diff(size.denom().bits());
    let loads = scene.loads.iter().map(|(_, load)| (Key::Load, load));
    let sizes = [
        (Key::Radius, &scene.radius),
        (Key::Gravity, &scene.gravity),
        (Key::Mass, &scene.mass),
    ];
    let sizes = loads
        .chain(sizes)
        .filter(|(key, size)| *key != Key::Radius || 3 * distance(size) >= FLOATS);
    let farthest = sizes.max_by_key(|(_, size)| distance(size));
    farthest.map_or(Key::Mass, |(key, _)| key)
}

/// A scene whose sizes are right, and its pile.
fn checked(scene: Scene) -> Result<(Scene, Pile), Refused> {
    scene.check_sizes()?;
    let pile = scene.pile().map_err(|error| match error.into() {
        // The only sites of a scene.
        error @ Error::Core(
            cannonpile::Error::SiteOutside { .. } | cannonpile::Error::LayerOutside { .. },
        ) => Refused::of(Key::Load, error),
        error => error.into(),
    })?;
    Ok((scene, pile))
}

/// A scene file, and what it was called on the line; or a case.
#[derive(Clone)]
pub(super) struct NamedFile {
    name: String,
    content: SceneFile,
    case: Option<&'static Case>,
}

impl NamedFile {
    /// Returns the scene of the file.
    pub(super) const fn scene(&self) -> &Scene {
        self.content.scene()
    }

    /// Returns where the file gives an option.
    pub(super) fn place_of(&self, option: &str) -> Option<String> {
        let line = self.content.line(option)?;
        if let Some(case) = self.case {
            return Some(format!("--case {}: {option}", case.name()));
        }
        Some(format!("--scene {}: line {line}, {option}", self.name))
    }

    pub(super) fn read(name: &str) -> Result<Self, String> {
        let text = text_of(name).map_err(|error| {
            let reason = match error.kind() {
                io::ErrorKind::InvalidData => "not text in UTF-8".into(),
                _ => reason(&error),
            };
            format!("{reason}; name a TOML file that can be read, or - for stdin")
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

/// More than any scene that is read: its length is then refused.
const LONGEST: u64 = 32 << 20;

fn text_of(name: &str) -> io::Result<String> {
    let mut bytes = Vec::new();
    let read = if name == "-" {
        io::stdin().lock().take(LONGEST).read_to_end(&mut bytes)?
    } else {
        File::open(name)?.take(LONGEST).read_to_end(&mut bytes)?
    };
    // What is cut within a character is too long, not wrong.
    if read as u64 == LONGEST {
        return Ok(String::from_utf8_lossy(&bytes).into_owned());
    }
    String::from_utf8(bytes).map_err(|_| io::ErrorKind::InvalidData.into())
}
