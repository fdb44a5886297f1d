//! The floor below a pile.

use core::fmt;
use core::str::FromStr;

use crate::Error;

/// The floor below the bottom spheres.
///
/// # Examples
/// ```
/// use cannonpile_dem::scene::Floor;
///
/// assert_eq!("rough".parse::<Floor>()?, Floor::Rough);
/// assert_eq!(Floor::default().to_string(), "glued");
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Floor {
    /// The bottom spheres are fixed, and no contact has friction.
    #[default]
    Glued,
    /// The bottom spheres lie on a plane, and all contacts have friction: see [`RoughPacking`](cannonpile_stability::RoughPacking).
    Rough,
}

impl Floor {
    /// Returns `glued` or `rough`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Floor;
    ///
    /// assert_eq!(Floor::Rough.name(), "rough");
    /// ```
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Glued => "glued",
            Self::Rough => "rough",
        }
    }
}

impl fmt::Display for Floor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Floor {
    type Err = Error;

    /// Reads a floor by its [`name`](Self::name), in any case.
    ///
    /// # Errors
    /// [`Error::Syntax`](cannonpile::Error::Syntax).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::scene::Floor;
    ///
    /// assert_eq!("Rough".parse::<Floor>()?, Floor::Rough);
    /// assert!("wet".parse::<Floor>().is_err());
    /// # Ok::<(), cannonpile_dem::Error>(())
    /// ```
    fn from_str(text: &str) -> Result<Self, Error> {
        let found = [Self::Glued, Self::Rough]
            .into_iter()
            .find(|floor| floor.name().eq_ignore_ascii_case(text));
        found.ok_or_else(|| Error::syntax(text, "a floor: glued or rough"))
    }
}
