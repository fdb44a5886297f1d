//! Which input an error comes of.

use core::fmt;

use super::Error;

/// What was given to the library, or left to a default, and has to be changed after an [`Error`].
///
/// The words of the first twelve are the keys of a [scene file](crate::scene).
///
/// # Examples
/// ```
/// use cannonpile::{Culprit, Pile};
///
/// let error = Pile::triangular(0).unwrap_err();
/// assert_eq!(error.culprit(), Some(Culprit::Layers));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Culprit {
    /// The number of layers.
    Layers,
    /// How layers follow one another.
    Stacking,
    /// The layer that the pile grows down from.
    Top,
    /// The layer that the pile grows up from.
    Base,
    /// Discs or spheres.
    Dimension,
    /// sin φ.
    SinPhi,
    /// A load on a sphere.
    Load,
    /// Whether the spheres weigh nothing.
    Weightless,
    /// a/R.
    Spacing,
    /// The radius R.
    Radius,
    /// The mass m.
    Mass,
    /// The gravity g.
    Gravity,
    /// The sphere that is asked about.
    Site,
    /// The layer that is asked about.
    Layer,
    /// The way to the answer.
    Method,
    /// The type of number that the answer is to be.
    Number,
    /// Which of several forces are meant.
    State,
    /// κ′/κ of horizontal contacts.
    StiffnessRatio,
    /// The text of a file.
    File,
    /// The probability of a change of sign.
    FaultProbability,
}

impl Culprit {
    /// Returns the word for it: `layers`, `sin-phi`, `site`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Culprit;
    ///
    /// assert_eq!(Culprit::SinPhi.name(), "sin-phi");
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
            Self::Weightless => "weightless",
            Self::Spacing => "spacing",
            Self::Radius => "radius",
            Self::Mass => "mass",
            Self::Gravity => "gravity",
            Self::Site => "site",
            Self::Layer => "layer",
            Self::Method => "method",
            Self::Number => "number",
            Self::State => "state",
            Self::StiffnessRatio => "stiffness-ratio",
            Self::File => "file",
            Self::FaultProbability => "fault-probability",
        }
    }
}

impl fmt::Display for Culprit {
    /// Writes the word of [`name`](Self::name).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl Error {
    /// Returns the input to change, if it is known; none for a [bug](Self::Bug), and none for a text or a region that is
    /// refused by itself, whatever it was meant for.
    ///
    /// An answer that does not fit is put down to the [type of number](Culprit::Number) that was asked for. A figure with
    /// too many marks is put down to the number of layers, also where a single layer was to be drawn.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Culprit;
    /// use cannonpile::scene::{Scene, parse};
    ///
    /// let scene = Scene { spacing: Some(parse::rational("1.64")?), ..Scene::default() };
    /// assert_eq!(scene.pile().unwrap_err().culprit(), Some(Culprit::Spacing));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn culprit(&self) -> Option<Culprit> {
        Some(match self {
            Self::Layers { .. }
            | Self::LayersOfStacking { .. }
            | Self::TooHigh { .. }
            | Self::NoStacking { .. }
            | Self::RegionTooLarge { .. }
            | Self::TooLarge { .. }
            | Self::TooManyRows { .. }
            | Self::TooManyStackings { .. }
            | Self::NotSolved { .. }
            | Self::TooManyMarks { .. } => Culprit::Layers,
            Self::RunLength { .. } | Self::TooManyRuns { .. } | Self::Misspelled { .. } => {
                Culprit::Stacking
            }
            Self::SinPhi { .. }
            | Self::SinPhiOfDiscs
            | Self::NoSpacing { .. }
            | Self::NoHorizontalContacts { .. } => Culprit::SinPhi,
            Self::NegativeLoad { .. }
            | Self::PlaceOfLoad { .. }
            | Self::OnlyOfLoads {
                weightless: true, ..
            } => Culprit::Load,
            Self::FaultProbability { .. } => Culprit::FaultProbability,
            Self::Weightless | Self::OnlyOfLoads { .. } => Culprit::Weightless,
            Self::Overlap { .. } | Self::TooFlat { .. } | Self::NotTouching { .. } => {
                Culprit::Spacing
            }
            Self::Excluded { given, .. } => *given,
            Self::NotPositive { quantity, .. } => *quantity,
            Self::SiteOutside { .. } | Self::OnFloor { .. } | Self::NotOnFloor { .. } => {
                Culprit::Site
            }
            Self::LayerOutside { .. } | Self::OtherLayer { .. } => Culprit::Layer,
            Self::NoSuchMethod { .. } => Culprit::Method,
            Self::Overflow { .. } => Culprit::Number,
            Self::InFile { error, .. } => error.culprit().unwrap_or(Culprit::File),
            Self::NotToml { .. } | Self::UnknownKey { .. } => Culprit::File,
            Self::CannotStand
            | Self::MustPull { .. }
            | Self::NoSuchDirection { .. }
            | Self::EmptyRegion { .. }
            | Self::RegionSide { .. }
            | Self::NeedsUnits { .. }
            | Self::Length { .. }
            | Self::NegativeRadicand { .. }
            | Self::Syntax { .. }
            | Self::UnknownCase { .. }
            | Self::Interrupted
            | Self::Bug { .. } => return None,
        })
    }

    /// Returns the other input, of two that do not go together: leaving either out is a remedy.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Culprit;
    /// use cannonpile::scene::{Scene, parse};
    /// use cannonpile::stacking::Pattern;
    ///
    /// let (sin_phi, stacking) = (Some(parse::rational("1/3")?), Some(Pattern::Hcp));
    /// let error = Scene { sin_phi, stacking, ..Scene::default() }.pile().unwrap_err();
    /// assert_eq!(error.culprit(), Some(Culprit::SinPhi));
    /// assert_eq!(error.conflicts_with(), Some(Culprit::Stacking));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub const fn conflicts_with(&self) -> Option<Culprit> {
        match self {
            Self::Excluded { beside, .. } => Some(*beside),
            Self::LayersOfStacking { .. } => Some(Culprit::Stacking),
            Self::SinPhiOfDiscs => Some(Culprit::Dimension),
            Self::TooHigh { .. } | Self::NoStacking { .. } => Some(Culprit::Base),
            _ => None,
        }
    }
}
