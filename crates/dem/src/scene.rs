//! Scenes: the options that describe a pile and its spheres, the parsers of their values, and scene files.

mod cases;
mod floor;
pub mod parse;
mod toml;

use core::fmt;
use core::str::FromStr;

use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::rough::hold;
use crate::{Each, Error, Friction, Key};
use cannonpile::engine::positive;
use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Dimension, Region};
use cannonpile::shape::Shape;
use cannonpile::stacking::Pattern;
use cannonpile::{Load, Packing, Pile};
use cannonpile_horizontal::ElasticState;
use cannonpile_stability::{RoughFloor, RoughPacking};

use parse::At;

pub use cannonpile::shape::Anchor;
pub use cases::{Case, cases};
pub use floor::Floor;
pub use toml::SceneFile;

/// The state of the contact forces, where horizontal contacts allow more than one.
///
/// # Examples
/// ```
/// use cannonpile_dem::scene::State;
///
/// assert_eq!("elastic".parse::<State>()?, State::Elastic);
/// assert_eq!(State::default().to_string(), "isostatic");
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum State {
    /// The forces without horizontal contacts, as in the paper.
    #[default]
    Isostatic,
    /// The forces of springs without tension, at a = R.
    Elastic,
}

impl State {
    /// Returns `isostatic` or `elastic`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::State;
    ///
    /// assert_eq!(State::Elastic.name(), "elastic");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Isostatic => "isostatic",
            Self::Elastic => "elastic",
        }
    }
}

impl fmt::Display for State {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for State {
    type Err = Error;

    /// Reads a state by its [`name`](Self::name), in any case.
    ///
    /// # Errors
    /// [`Error::Syntax`](cannonpile::Error::Syntax).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::State;
    ///
    /// assert_eq!("Elastic".parse::<State>()?, State::Elastic);
    /// assert!("plastic".parse::<State>().is_err());
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        let found = [Self::Isostatic, Self::Elastic]
            .into_iter()
            .find(|state| state.name().eq_ignore_ascii_case(text));
        found.ok_or_else(|| Error::syntax(text, "a state: isostatic or elastic"))
    }
}

/// The user's description of a pile and its spheres. A scene is unchecked until it is converted to a [`Pile`] or a
/// [`Packing`].
///
/// # Examples
/// ```
/// use cannonpile_dem::scene::{parse, Anchor, Scene};
/// use cannonpile::stacking::Pattern;
///
/// let scene = Scene { layers: Some(4), spacing: Some("1.2".parse()?), ..Scene::default() };
/// let pile = scene.pile()?;
/// assert_eq!(pile.sphere_count(), 20_u32.into());
/// assert!(scene.packing(&pile)?.touching().is_empty());
///
/// // Without `layers` the pile is as high as the base supports.
/// let anchor = Some(Anchor::Base("hexagon:3".parse()?));
/// let scene = Scene { anchor, stacking: Some(Pattern::Hcp), ..Scene::default() };
/// assert_eq!(scene.pile()?.layers(), 5);
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Scene {
    /// The number of layers. The default is the length of a stacking given by its signs, the maximum on a base, or else
    /// 10.
    pub layers: Option<i128>,
    /// Discs or spheres (default: spheres).
    pub dimension: Dimension,
    /// sin φ (default: ½); not allowed for discs, or with a stacking, a top or a base.
    pub sin_phi: Option<BigRational>,
    /// The stacking (default: all +): from the base up if the pile grows from its base, otherwise from the top.
    pub stacking: Option<Pattern>,
    /// The layer that the pile grows from (default: one sphere on top).
    pub anchor: Option<Anchor>,
    /// The loads on spheres, in the units of [`Load`].
    pub loads: Vec<(At, Load)>,
    /// The tilt of gravity (x, y), in the units of [`Pile::with_tilt`] (default: upright).
    pub tilt: [BigRational; 2],
    /// Whether the spheres are weightless, so that only the loads act.
    pub weightless: bool,
    /// a/R (default: 6/5, or 1 for the elastic state). A given spacing is always checked, the default only where
    /// geometry is used.
    pub spacing: Option<Spacing>,
    /// The radius R (default: 1).
    pub radius: BigRational,
    /// The mass m of a sphere (default: 1).
    pub mass: BigRational,
    /// The gravity g (default: 1).
    pub gravity: BigRational,
    /// The state of the forces (default: isostatic).
    pub state: State,
    /// κ′/κ for the elastic state, the stiffness of horizontal contacts over that of sloping contacts (default: 1).
    pub stiffness_ratio: BigRational,
    /// The floor (default: glued).
    pub floor: Floor,
    /// The coefficient of friction between spheres on a rough floor (default: twice the needed one).
    pub friction: Option<BigRational>,
    /// The coefficient of friction of a rough floor (default: twice the needed one).
    pub floor_friction: Option<BigRational>,
}

cannonpile::engine::equality!(Scene);

/// Returns the key of the layer that the pile grows from: the top or the base.
const fn key_of(anchor: &Anchor) -> Key {
    match anchor {
        Anchor::Top(_) => Key::Top,
        Anchor::Base(_) => Key::Base,
    }
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            layers: None,
            dimension: Dimension::Three,
            sin_phi: None,
            stacking: None,
            anchor: None,
            loads: Vec::new(),
            tilt: [BigRational::zero(), BigRational::zero()],
            weightless: false,
            spacing: None,
            radius: BigRational::one(),
            mass: BigRational::one(),
            gravity: BigRational::one(),
            state: State::Isostatic,
            stiffness_ratio: BigRational::one(),
            floor: Floor::Glued,
            friction: None,
            floor_friction: None,
        }
    }
}

impl Scene {
    /// The default number of layers.
    pub const LAYERS: i128 = 10;

    /// Returns the pile, checked. A given spacing is checked too.
    ///
    /// # Errors
    /// The errors of the constructors and loads of [`Pile`], and of
    /// [`Clearance::check`](cannonpile::geometry::Clearance::check); [`Error::SinPhiOfDiscs`] and [`Error::Excluded`]
    /// for options that exclude each other; those of [`RoughFloor::new`] for a rough floor.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::{parse, Scene};
    /// use cannonpile::stacking::Pattern;
    ///
    /// let scene = Scene { stacking: Some(Pattern::Hcp), ..Scene::default() };
    /// assert_eq!(scene.pile()?.layers(), 10);
    ///
    /// let scene = Scene { sin_phi: Some(parse::rational("1/3")?), ..scene };
    /// let refused = "sin-phi has no meaning with stacking: leave one of the two out";
    /// assert_eq!(scene.pile().unwrap_err().to_string(), refused);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn pile(&self) -> Result<Pile, Error> {
        let mut pile = self.unloaded()?.with_tilt(self.tilt.clone())?;
        for (at, load) in &self.loads {
            let site = at.site(pile.layers());
            pile = pile.with_load(site, load.clone())?;
        }
        if self.weightless {
            pile = pile.weightless();
        }
        if let Some(spacing) = &self.spacing {
            pile.clearance().check(spacing)?;
        }
        match (self.floor, self.coefficients().next()) {
            (Floor::Rough, _) => self.check_rough(&pile)?,
            (Floor::Glued, None) => {}
            (Floor::Glued, Some((given, _))) => {
                let beside = Key::Floor;
                return Err(Error::Excluded { given, beside });
            }
        }
        Ok(pile)
    }

    /// Returns the coefficients of friction that are given.
    fn coefficients(&self) -> impl Iterator<Item = (Key, &BigRational)> {
        let spheres = (Key::Friction, &self.friction);
        let floor = (Key::FloorFriction, &self.floor_friction);
        let given = [spheres, floor].into_iter();
        given.filter_map(|(key, given)| Some((key, given.as_ref()?)))
    }

    /// Checks that the forces on a rough floor are unique.
    fn check_rough(&self, pile: &Pile) -> Result<(), Error> {
        if self.state == State::Elastic {
            return Err(Error::Excluded {
                given: Key::State,
                beside: Key::Floor,
            });
        }
        RoughFloor::new(pile)?;
        if let Some(spacing) = &self.spacing {
            RoughPacking::new(&Packing::new(pile, spacing)?)?;
        }
        Ok(())
    }

    fn unloaded(&self) -> Result<Pile, Error> {
        let layers = self.layers.unwrap_or(Self::LAYERS);
        let stacked = match (&self.anchor, &self.stacking) {
            (Some(anchor), _) => Some(key_of(anchor)),
            (None, Some(_)) => Some(Key::Stacking),
            (None, None) => None,
        };
        match (self.dimension, &self.sin_phi, stacked) {
            (Dimension::Two, Some(_), _) => Err(Error::SinPhiOfDiscs),
            (Dimension::Two, None, Some(given)) => Err(Error::Excluded {
                given,
                beside: Key::Dimension,
            }),
            (Dimension::Two, None, None) => Ok(Pile::discs(layers)?),
            (Dimension::Three, Some(_), Some(beside)) => Err(Error::Excluded {
                given: Key::SinPhi,
                beside,
            }),
            (Dimension::Three, Some(s), None) => Ok(Pile::isosceles(layers, s.clone())?),
            (Dimension::Three, None, None) => Ok(Pile::triangular(layers)?),
            (Dimension::Three, None, Some(_)) => Ok(self.stacked()?),
        }
    }

    /// Returns the pile with the stacking and the top or base of the scene, without loads.
    fn stacked(&self) -> Result<Pile, cannonpile::Error> {
        let pattern = self.stacking.as_ref().unwrap_or(&Pattern::Fcc);
        let spelled = self.layers.or(pattern.layers());
        let under = |top| Pile::under(top, pattern.stacking(spelled.unwrap_or(Self::LAYERS))?);
        match self.anchor {
            Some(Anchor::Base(base)) => {
                let layers = match spelled {
                    Some(layers) => layers,
                    None => Shape::greatest_height(base, pattern)?,
                };
                Pile::on(base, pattern.stacking(layers)?.reversed())
            }
            Some(Anchor::Top(top)) => under(top),
            None => under(Region::SITE),
        }
    }

    /// Checks that radius, mass, gravity, stiffness ratio and coefficients of friction are positive, even if they are not used.
    ///
    /// # Errors
    /// [`Error::NotPositive`](cannonpile::Error::NotPositive).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::{parse, Scene};
    ///
    /// assert!(Scene::default().check_sizes().is_ok());
    /// let scene = Scene { mass: parse::rational("-0.5")?, ..Scene::default() };
    /// assert_eq!(scene.check_sizes().unwrap_err().to_string(), "mass must be positive, not -1/2");
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn check_sizes(&self) -> Result<(), Error> {
        let sizes = [
            (Key::Radius, &self.radius),
            (Key::Mass, &self.mass),
            (Key::Gravity, &self.gravity),
            (Key::StiffnessRatio, &self.stiffness_ratio),
        ];
        for (quantity, value) in sizes.into_iter().chain(self.coefficients()) {
            positive(quantity.name(), value.clone())?;
        }
        Ok(())
    }

    /// Returns the given spacing, or the default. This function does not check that the spacing fits the pile.
    ///
    /// # Errors
    /// [`Error::NotPositive`](cannonpile::Error::NotPositive).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Scene;
    ///
    /// assert_eq!(Scene::default().spacing()?.to_string(), "6/5");
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn spacing(&self) -> Result<Spacing, Error> {
        if let Some(spacing) = &self.spacing {
            return Ok(spacing.clone());
        }
        let default = match self.state {
            State::Isostatic => BigRational::new(6.into(), 5.into()),
            State::Elastic => BigRational::one(),
        };
        Ok(Spacing::new(default)?)
    }

    /// Checks that the neighbours of a layer touch, a = R, if a spacing is given.
    ///
    /// # Errors
    /// [`Error::NotTouching`](cannonpile::Error::NotTouching).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::{parse, Scene};
    ///
    /// assert!(Scene::default().check_touching().is_ok());
    /// let scene = Scene { spacing: Some("1.2".parse()?), ..Scene::default() };
    /// assert_eq!(
    ///     scene.check_touching().unwrap_err().to_string(),
    ///     "neighbours of a layer do not touch at a/R = 6/5: omit the spacing, or use 1",
    /// );
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn check_touching(&self) -> Result<(), Error> {
        match self.spacing.clone() {
            Some(spacing) if !spacing.square().is_one() => {
                Err(cannonpile::Error::NotTouching { spacing }.into())
            }
            _ => Ok(()),
        }
    }

    /// Returns a pile of this scene with the horizontal forces of the requested state. They are zero, or those of the
    /// [elastic state](cannonpile_horizontal::elastic).
    ///
    /// # Errors
    /// The errors of [`check_touching`](Self::check_touching) and [`elastic`](cannonpile_horizontal::elastic).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::{parse, Scene, State};
    ///
    /// let stacking = Some("+-+-+".parse()?);
    /// let scene = Scene { stacking, state: State::Elastic, ..Scene::default() };
    /// let pile = scene.in_state(scene.pile()?)?;
    /// assert_eq!(pile.horizontal_forces().len(), 3);
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn in_state(&self, pile: Pile) -> Result<Pile, Error> {
        match self.state {
            State::Isostatic => Ok(pile),
            State::Elastic => Ok(self.elastic(&pile)?.pile().clone()),
        }
    }

    /// Returns the [elastic state](cannonpile_horizontal::elastic) of a pile of this scene.
    ///
    /// # Errors
    /// As for [`in_state`](Self::in_state).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Scene;
    ///
    /// let scene = Scene::default();
    /// assert!(scene.elastic(&scene.pile()?)?.certificate().is_some());
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn elastic(&self, pile: &Pile) -> Result<ElasticState, Error> {
        self.check_touching()?;
        Ok(cannonpile_horizontal::elastic(pile, &self.stiffness_ratio)?)
    }

    /// Returns the pile with the sizes and weights of the scene.
    ///
    /// # Errors
    /// The errors of [`Packing::new`], and [`Error::NotPositive`](cannonpile::Error::NotPositive).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Direction, Site};
    /// use cannonpile_dem::scene::{parse, Scene};
    ///
    /// let scene = Scene { gravity: parse::rational("9.81")?, ..Scene::default() };
    /// let pile = scene.pile()?;
    /// let force = scene.packing(&pile)?.contact(Site::APEX, Direction::Alpha)?;
    /// assert_eq!(force.to_string(), "327/260*sqrt(13)");
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn packing<'p>(&self, pile: &'p Pile) -> Result<Packing<'p>, Error> {
        let packing = Packing::new(pile, &self.spacing()?)?
            .with_radius(self.radius.clone())?
            .with_mass(self.mass.clone())?;
        Ok(packing.with_gravity(self.gravity.clone())?)
    }

    /// Returns the coefficients of friction of a packing of this scene, rounded. `None` for a floor with glue.
    ///
    /// # Errors
    /// As for [`Friction::sufficient`] and [`Friction::with_spheres`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Scene;
    ///
    /// let scene = Scene::from_toml("layers = 2\nfloor = 'rough'\nfriction = 0.41")?;
    /// let pile = scene.pile()?;
    /// let friction = scene.friction(&scene.packing(&pile)?)?.unwrap();
    /// assert_eq!((friction.spheres(), friction.floor()), (0.41, 0.201271336620499));
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn friction(&self, packing: &Packing<'_>) -> Result<Option<Friction>, Error> {
        if self.floor == Floor::Glued {
            return Ok(None);
        }
        let mut friction = Friction::sufficient(packing)?;
        if let Some(spheres) = &self.friction {
            friction = friction.with_spheres(spheres)?;
        }
        if let Some(floor) = &self.floor_friction {
            friction = friction.with_floor(floor)?;
        }
        Ok(Some(friction))
    }

    /// Returns whether a packing of this scene stands with its coefficients of friction. `None` if none is given.
    ///
    /// The comparison is exact. A coefficient that is not given is large enough.
    ///
    /// # Errors
    /// As for [`RoughPacking::new`] and [`RoughPacking::floor_holds_at`].
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Scene;
    ///
    /// // tan(θ/2) = 0.4025…
    /// for (friction, stands) in [(0.402, false), (0.403, true)] {
    ///     let scene = Scene::from_toml(&format!("layers = 2\nfloor = 'rough'\nfriction = {friction}"))?;
    ///     let pile = scene.pile()?;
    ///     assert_eq!(scene.stands_with_friction(&scene.packing(&pile)?)?, Some(stands));
    /// }
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    pub fn stands_with_friction(&self, packing: &Packing<'_>) -> Result<Option<bool>, Error> {
        if self.coefficients().next().is_none() {
            return Ok(None);
        }
        let given = [&self.friction, &self.floor_friction].each(Option::as_ref);
        let [contacts, floor] = hold(&RoughPacking::new(packing)?, given)?;
        Ok(Some(contacts && floor))
    }
}
