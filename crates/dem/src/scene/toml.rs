//! Scenes as TOML files. The keys have the names of the scene options of the command line.

mod nearest;
mod value;
mod write;

use core::str::FromStr;

use ::toml::Spanned;
use ::toml::de::{DeString, DeTable, DeValue};
use num_rational::BigRational;
use num_traits::Zero;

use super::parse::{self, At};
use super::{Anchor, Scene};
use crate::error::quoted;
use crate::{Error, Key};
use cannonpile::Load;
use cannonpile::lattice::Dimension;

pub(super) use nearest::nearest;
use value::{Value, line_of};

/// The keys of a scene file, in the order of a written file.
const KEYS: [&str; Key::ALL.len()] = {
    let mut names = [""; Key::ALL.len()];
    let mut n = 0;
    while n < names.len() {
        names[n] = Key::ALL[n].name();
        n += 1;
    }
    names
};

/// The keys of a load.
const LOAD_KEYS: [&str; 4] = ["at", "weight", "x", "y"];

/// The maximal size of a file, in bytes; a stacking of a million runs fits.
const LONGEST: usize = 16 << 20;

/// A scene read from a TOML file, with the line of each option. The keys have the names of the scene options of the
/// command line.
///
/// ```toml
/// layers = 4
/// stacking = "hcp"
/// top = "hexagon:3,2"
/// spacing = 1.2                 # read as 6/5, not as a float; "6/5" is the same
/// load = ["0,0,0=5/2"]
/// ```
/// | key | value | by default |
/// |---|---|---|
/// | `layers` | a number, up to 10³⁶ | 10, or as for [`Scene::layers`] |
/// | `stacking` | `"fcc"`, `"hcp"`, `"dhcp"`, or spelled out | `"fcc"` |
/// | `top` or `base` | `"hexagon:P,Q"`, `"hexagon:N"`, `"triangle:N"` or `"region:x0..x1,y0..y1,s0..s1"` | one sphere on top |
/// | `dimension` | 2 or 3 | 3 |
/// | `sin-phi` | a number | ½ |
/// | `spacing` | a number, or a root such as `"sqrt(2)"` | where it is needed 6/5, or 1 for the elastic state |
/// | `radius`, `mass`, `gravity` | a number | 1 |
/// | `load` | an array of `"K,I,J=W"` or `"K,I,J=W,X,Y"`, or of tables with `at`, `weight`, `x` and `y` | none |
/// | `tilt` | `"X,Y"`, or an array of two numbers | `"0,0"` |
/// | `weightless` | `true` or `false` | `false` |
/// | `state` | `"isostatic"` or `"elastic"` | `"isostatic"` |
/// | `stiffness-ratio` | a number | 1 |
/// | `floor` | `"glued"` or `"rough"` | `"glued"` |
/// | `friction`, `floor-friction` | a number | twice the one that a rough floor needs |
///
/// A number is a TOML number or a string, and is read exactly: `6`, `1.2`, `1e-3`, `"6/5"`. Keys outside the table are
/// rejected. A load may also be written as
/// ```toml
/// [[load]]
/// at = [0, 0, 0]                # or "0,0,0"; with one number less, on the base
/// weight = "5/2"                # the force downwards; the horizontal components x and y are 0 by default
/// ```
///
/// An option of the command line replaces the same option of the file. A base also replaces a top, and the loads of the
/// command line replace all loads of the file. Options that exclude each other are rejected, with the line of the file
/// if one is from the file. The dimension of the file determines the format of loads.
///
/// # Examples
/// ```
/// use cannonpile_dem::scene::SceneFile;
///
/// let file: SceneFile = "layers = 4\n\nspacing = 1.2\n".parse()?;
/// assert_eq!(file.scene().spacing.as_ref().unwrap().to_string(), "6/5");
/// assert_eq!((file.line("spacing"), file.line("radius")), (Some(3), None));
///
/// let error = "layers = 4\nspcaing = 1.2".parse::<SceneFile>().unwrap_err();
/// assert_eq!(error.to_string(), "line 2: there is no key 'spcaing'; did you mean 'spacing'?");
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneFile {
    scene: Scene,
    lines: Vec<(&'static str, usize)>,
}

impl SceneFile {
    /// Returns the scene.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::{Scene, SceneFile};
    ///
    /// assert_eq!("".parse::<SceneFile>()?.scene(), &Scene::default());
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub const fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Returns the line of a key, counted from 1; `None` if the file does not contain the key.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::SceneFile;
    ///
    /// assert_eq!("# heavy\nmass = 5".parse::<SceneFile>()?.line("mass"), Some(2));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    #[must_use]
    pub fn line(&self, key: &str) -> Option<usize> {
        let mut lines = self.lines.iter();
        Some(lines.find(|(known, _)| *known == key)?.1)
    }
}

impl FromStr for SceneFile {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        if text.len() > LONGEST {
            let reason = format!("the file is longer than {LONGEST} bytes");
            return Err(Error::NotToml { line: 1, reason });
        }
        let table = DeTable::parse(text).map_err(|error| value::not_toml(text, &error))?;
        let values = values(text, table.get_ref(), &KEYS)?;
        let lines = values.iter().map(|value| (value.key, value.line()));
        Ok(Self {
            lines: lines.collect(),
            scene: scene(&values)?,
        })
    }
}

impl Scene {
    /// Returns the scene that a TOML file describes. The keys are those of [`SceneFile`].
    ///
    /// Each value is checked on its own. The conversion to a [`Pile`](cannonpile::Pile) checks combinations of values.
    ///
    /// # Errors
    /// [`Error::NotToml`]; [`Error::UnknownKey`] for an unknown key; [`Error::InFile`] for an invalid value. Each error
    /// contains its line.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Scene;
    ///
    /// let scene = Scene::from_toml("layers = 1_000_000_000_000_000_000_000\nradius = 0.1")?;
    /// assert_eq!(scene.layers, Some(10_i128.pow(21)));
    /// assert_eq!(scene.radius.to_string(), "1/10");
    ///
    /// let error = Scene::from_toml("\nmass = '1/0'").unwrap_err();
    /// assert_eq!(
    ///     error.to_string(),
    ///     "line 2, mass: '1/0' is not a number with a denominator other than zero",
    /// );
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn from_toml(text: &str) -> Result<Self, Error> {
        text.parse().map(|file: SceneFile| file.scene)
    }
}

/// Returns the values of a table in the order of the file.
fn values<'a>(
    text: &'a str,
    table: &'a DeTable<'a>,
    known: &'static [&'static str],
) -> Result<Vec<Value<'a>>, Error> {
    let mut entries: Vec<(&Spanned<DeString<'_>>, &Spanned<DeValue<'_>>)> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    let value = |(key, value): (&Spanned<DeString<'_>>, &'a Spanned<DeValue<'a>>)| {
        let (name, start) = (key.get_ref().as_ref(), key.span().start);
        match known.iter().find(|known| **known == name) {
            Some(key) => Ok(Value::new(text, start, key, value)),
            None => Err(Error::UnknownKey {
                line: line_of(text, start),
                key: quoted(name),
                nearest: nearest(name, known),
                known,
            }),
        }
    };
    entries.into_iter().map(value).collect()
}

fn scene(values: &[Value<'_>]) -> Result<Scene, Error> {
    let mut scene = Scene::default();
    // The dimension is read first, because the formats of loads and tilts depend on it.
    if let Some(dimension) = values.iter().find(|value| value.key == "dimension") {
        scene.dimension = dimension.read(str::parse)?;
    }
    for value in values {
        match value.key {
            "layers" => scene.layers = Some(value.read(parse::layers)?),
            "stacking" => scene.stacking = Some(value.read(str::parse)?),
            "top" | "base" => {
                if let Some(anchor) = &scene.anchor {
                    let beside = super::key_of(anchor);
                    let given = match beside {
                        Key::Top => Key::Base,
                        _ => Key::Top,
                    };
                    return Err(value.refused(Error::Excluded { given, beside }));
                }
                let grown = if value.key == "top" {
                    Anchor::Top
                } else {
                    Anchor::Base
                };
                scene.anchor = Some(grown(value.read(str::parse)?));
            }
            "sin-phi" => scene.sin_phi = Some(value.read(parse::rational)?),
            "load" => scene.loads = loads(value, scene.dimension)?,
            "tilt" => {
                let numbers = value.numbers();
                scene.tilt = value.read(|text| {
                    parse::tilt(numbers.as_deref().unwrap_or(text), scene.dimension)
                })?;
            }
            "weightless" => scene.weightless = value.flag()?,
            "spacing" => scene.spacing = Some(value.read(str::parse)?),
            "radius" => scene.radius = value.read(parse::rational)?,
            "mass" => scene.mass = value.read(parse::rational)?,
            "gravity" => scene.gravity = value.read(parse::rational)?,
            "state" => scene.state = value.read(str::parse)?,
            "stiffness-ratio" => scene.stiffness_ratio = value.read(parse::rational)?,
            "floor" => scene.floor = value.read(str::parse)?,
            "friction" => scene.friction = Some(value.read(parse::rational)?),
            "floor-friction" => scene.floor_friction = Some(value.read(parse::rational)?),
            // The dimension has been read already.
            _ => {}
        }
    }
    Ok(scene)
}

fn loads(value: &Value<'_>, dimension: Dimension) -> Result<Vec<(At, Load)>, Error> {
    let expected = "an array of loads, such as [\"0,0,0=5/2\"]";
    let load = |item: Value<'_>| match item.table() {
        Some(table) => load_of(&item, table, dimension),
        None => item.read(|text| parse::load(text, dimension)),
    };
    value.items(expected)?.map(load).collect()
}

/// Reads a load from a table.
fn load_of(
    load: &Value<'_>,
    table: &DeTable<'_>,
    dimension: Dimension,
) -> Result<(At, Load), Error> {
    let values = values(load.file, table, &LOAD_KEYS)?;
    let given = |key| values.iter().find(|value| value.key == key);
    let of = |key| given(key).ok_or_else(|| load.is_not("a load with the keys at and weight"));
    let component = |key| {
        let read = given(key).map(|value| value.read(parse::rational));
        read.unwrap_or_else(|| Ok(BigRational::zero()))
    };
    let (at, weight) = (of("at")?, of("weight")?);
    let integers = at.integers();
    let at = at.read(|text| parse::at(integers.as_deref().unwrap_or(text), dimension))?;
    let load = Load {
        down: weight.read(parse::rational)?,
        x: component("x")?,
        y: component("y")?,
    };
    Ok((at, load))
}
