//! A common error type for all crates, and the argument to change.

use core::fmt;

use cannonpile_dem::Key;

/// The error of any crate.
///
/// An error that wraps the error of another crate is unwrapped, so that each error has one form.
#[derive(Clone, Debug)]
pub(crate) enum Error {
    Core(cannonpile::Error),
    Stability(cannonpile_stability::Error),
    Horizontal(cannonpile_horizontal::Error),
    Disorder(cannonpile_disorder::Error),
    Dem(cannonpile_dem::Error),
    Figure(cannonpile_figure::Error),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Core(error) => error.fmt(f),
            Self::Stability(error) => error.fmt(f),
            Self::Horizontal(error) => error.fmt(f),
            Self::Disorder(error) => error.fmt(f),
            Self::Dem(error) => error.fmt(f),
            Self::Figure(error) => error.fmt(f),
        }
    }
}

impl From<cannonpile::Error> for Error {
    fn from(error: cannonpile::Error) -> Self {
        Self::Core(error)
    }
}

impl From<cannonpile_stability::Error> for Error {
    fn from(error: cannonpile_stability::Error) -> Self {
        match error {
            cannonpile_stability::Error::Core(error) => error.into(),
            error => Self::Stability(error),
        }
    }
}

impl From<cannonpile_horizontal::Error> for Error {
    fn from(error: cannonpile_horizontal::Error) -> Self {
        match error {
            cannonpile_horizontal::Error::Core(error) => error.into(),
            cannonpile_horizontal::Error::Stability(error) => error.into(),
            error => Self::Horizontal(error),
        }
    }
}

impl From<cannonpile_disorder::Error> for Error {
    fn from(error: cannonpile_disorder::Error) -> Self {
        match error {
            cannonpile_disorder::Error::Core(error) => error.into(),
            error => Self::Disorder(error),
        }
    }
}

impl From<cannonpile_dem::Error> for Error {
    fn from(error: cannonpile_dem::Error) -> Self {
        match error {
            cannonpile_dem::Error::Core(error) => error.into(),
            cannonpile_dem::Error::Stability(error) => error.into(),
            cannonpile_dem::Error::Horizontal(error) => error.into(),
            error => Self::Dem(error),
        }
    }
}

impl From<cannonpile_figure::Error> for Error {
    fn from(error: cannonpile_figure::Error) -> Self {
        match error {
            cannonpile_figure::Error::Core(error) => error.into(),
            cannonpile_figure::Error::Stability(error) => error.into(),
            cannonpile_figure::Error::Horizontal(error) => error.into(),
            cannonpile_figure::Error::Disorder(error) => error.into(),
            cannonpile_figure::Error::Dem(error) => error.into(),
            error => Self::Figure(error),
        }
    }
}

impl Error {
    /// Returns the name of the argument to change, if there is one. Messages about spheres already name the sphere.
    /// Numbers, methods and files are not arguments.
    pub(crate) fn argument(&self) -> Option<&'static str> {
        match self {
            Self::Core(error) => of_core(error),
            Self::Horizontal(error) => of_horizontal(error),
            Self::Disorder(error) => of_disorder(error),
            Self::Dem(error) => of_dem(error),
            Self::Figure(cannonpile_figure::Error::TooManyGlyphs { .. }) => Some("layers"),
            Self::Stability(_) | Self::Figure(_) => None,
        }
    }
}

fn of_core(error: &cannonpile::Error) -> Option<&'static str> {
    use cannonpile::Error;

    Some(match error {
        Error::Layers { .. }
        | Error::LayersOfStacking { .. }
        | Error::TooHigh { .. }
        | Error::RegionTooLarge { .. }
        | Error::TooLarge { .. }
        | Error::TooManyRows { .. } => "layers",
        Error::RunLength { .. } | Error::TooManyRuns { .. } | Error::Misspelled { .. } => {
            "stacking"
        }
        Error::SinPhi { .. } | Error::NoSpacing { .. } | Error::NoHorizontalContacts { .. } => {
            "sin_phi"
        }
        Error::OutOfPlane {
            quantity: "tilt", ..
        } => "tilt",
        Error::NegativeLoad { .. } | Error::OutOfPlane { .. } => "loads",
        Error::Overlap { .. } | Error::TooFlat { .. } | Error::NotTouching { .. } => "spacing",
        Error::NotPositive { quantity, .. } => {
            let key = Key::ALL.into_iter().find(|key| key.name() == *quantity);
            return key.and_then(of_key);
        }
        Error::LayerOutside { .. } | Error::OtherLayer { .. } => "layer",
        _ => return None,
    })
}

fn of_horizontal(error: &cannonpile_horizontal::Error) -> Option<&'static str> {
    use cannonpile_horizontal::Error;

    match error {
        Error::Weightless => Some("weightless"),
        _ => None,
    }
}

fn of_disorder(error: &cannonpile_disorder::Error) -> Option<&'static str> {
    use cannonpile_disorder::Error;

    match error {
        Error::TooManyStackings { .. } | Error::NoStacking { .. } => Some("layers"),
        Error::FaultProbability { .. } => Some("fault_probability"),
        Error::PlaceOfLoad { .. }
        | Error::NotAResponse {
            weightless: true, ..
        } => Some("loads"),
        Error::Weightless | Error::NotAResponse { .. } => Some("weightless"),
        _ => None,
    }
}

fn of_dem(error: &cannonpile_dem::Error) -> Option<&'static str> {
    use cannonpile_dem::Error;

    match error {
        Error::SinPhiOfDiscs => Some("sin_phi"),
        Error::Excluded { given, .. } => of_key(*given),
        // The message about a file gives the line and the key.
        _ => None,
    }
}

/// Returns the argument for a key of a scene.
fn of_key(key: Key) -> Option<&'static str> {
    Some(match key {
        Key::Layers => "layers",
        Key::Stacking => "stacking",
        Key::Top => "top",
        Key::Base => "base",
        Key::Dimension => "dimension",
        Key::SinPhi => "sin_phi",
        Key::Load => "loads",
        Key::Tilt => "tilt",
        Key::Weightless => "weightless",
        Key::Spacing => "spacing",
        Key::Radius => "radius",
        Key::Mass => "mass",
        Key::Gravity => "gravity",
        Key::State => "state",
        Key::StiffnessRatio => "stiffness_ratio",
        Key::Floor => "floor",
        Key::Friction => "friction",
        Key::FloorFriction => "floor_friction",
        _ => return None,
    })
}
