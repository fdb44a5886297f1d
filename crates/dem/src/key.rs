//! The keys of a scene.

use core::fmt;

/// A key of a scene file, which is also the name of a scene option on the command line.
///
/// # Examples
/// ```
/// use cannonpile_dem::scene::{Scene, parse};
/// use cannonpile_dem::{Error, Key};
///
/// let scene = Scene::from_toml("sin-phi = '1/3'\nstacking = 'hcp'")?;
/// let refused = scene.pile().unwrap_err();
/// assert!(matches!(refused, Error::Excluded { given: Key::SinPhi, beside: Key::Stacking, .. }));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Key {
    /// The number of layers.
    Layers,
    /// The stacking of the layers.
    Stacking,
    /// The top layer of a pile that grows down.
    Top,
    /// The bottom layer of a pile that grows up.
    Base,
    /// Discs or spheres.
    Dimension,
    /// sin φ, the sine of the azimuth of the base triangle.
    SinPhi,
    /// Loads on spheres.
    Load,
    /// The tilt of gravity.
    Tilt,
    /// Weightless spheres.
    Weightless,
    /// a/R, half the distance between horizontal neighbours over the radius.
    Spacing,
    /// The radius R.
    Radius,
    /// The mass m.
    Mass,
    /// The gravity g.
    Gravity,
    /// The isostatic or the elastic state.
    State,
    /// κ′/κ, the stiffness of horizontal contacts over that of sloping contacts.
    StiffnessRatio,
    /// A floor with glue, or a rough one.
    Floor,
    /// The coefficient of friction between spheres.
    Friction,
    /// The coefficient of friction of the floor.
    FloorFriction,
}

impl Key {
    /// All keys, in the order of a written scene file.
    pub const ALL: [Self; 18] = [
        Self::Layers,
        Self::Stacking,
        Self::Top,
        Self::Base,
        Self::Dimension,
        Self::SinPhi,
        Self::Load,
        Self::Tilt,
        Self::Weightless,
        Self::Spacing,
        Self::Radius,
        Self::Mass,
        Self::Gravity,
        Self::State,
        Self::StiffnessRatio,
        Self::Floor,
        Self::Friction,
        Self::FloorFriction,
    ];

    /// Returns the key as written in a file: `layers`, `sin-phi`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::Key;
    ///
    /// assert_eq!(Key::SinPhi.name(), "sin-phi");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Layers => "layers",
            Self::Stacking => "stacking",
            Self::Top => "top",
            Self::Base => "base",
            Self::Dimension => "dimension",
            Self::SinPhi => "sin-phi",
            Self::Load => "load",
            Self::Tilt => "tilt",
            Self::Weightless => "weightless",
            Self::Spacing => "spacing",
            Self::Radius => "radius",
            Self::Mass => "mass",
            Self::Gravity => "gravity",
            Self::State => "state",
            Self::StiffnessRatio => "stiffness-ratio",
            Self::Floor => "floor",
            Self::Friction => "friction",
            Self::FloorFriction => "floor-friction",
        }
    }
}

impl fmt::Display for Key {
    /// Writes the [`name`](Self::name).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
