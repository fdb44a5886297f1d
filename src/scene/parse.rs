//! Numbers, sites and shapes from text, exactly.

mod numbers;
mod roots;
mod shapes;

#[cfg(feature = "serde")]
pub(crate) use numbers::big_integer;
pub use numbers::{integer, rational};
pub use roots::surd;
pub use shapes::{load, region, stacking};

use crate::Error;
use crate::lattice::{Dimension, Direction, MAX_LAYERS, Site};

use numbers::{LONGEST, integer_digits};

/// A number of layers.
///
/// # Errors
/// [`Error::Layers`] for an integer that cannot be one, [`Error::Syntax`] for anything else.
///
/// # Examples
/// ```
/// use cannonpile::Error;
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::layers("10")?, 10);
/// assert!(matches!(parse::layers("0"), Err(Error::Layers { .. })));
/// assert!(matches!(parse::layers("ten"), Err(Error::Syntax { .. })));
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn layers(text: &str) -> Result<i128, Error> {
    if text.len() > LONGEST {
        return Err(Error::syntax(
            text,
            "a number of layers of at most 37 digits",
        ));
    }
    let given = integer_digits(text);
    let given = given.ok_or_else(|| Error::syntax(text, "a number of layers such as 10"))?;
    match i128::try_from(&given) {
        Ok(layers) if (1..=MAX_LAYERS).contains(&layers) => Ok(layers),
        _ => Err(Error::Layers { given }),
    }
}

/// A dimension: `2` or `3`.
///
/// # Errors
/// [`Error::Syntax`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Dimension;
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::dimension("2")?, Dimension::Two);
/// assert!(parse::dimension("4").is_err());
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn dimension(text: &str) -> Result<Dimension, Error> {
    match text {
        "2" => Ok(Dimension::Two),
        "3" => Ok(Dimension::Three),
        _ => Err(Error::syntax(text, "a dimension: 2 (discs) or 3 (spheres)")),
    }
}

/// One sphere as text: `K,I,J`, or `I,J` on the base; in two dimensions `K,I`, or `I`.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Dimension;
/// use cannonpile::scene::parse::{self, At};
///
/// assert_eq!(parse::at("5,7", Dimension::Three)?, At { layer: None, i: 5, j: 7 });
/// assert_eq!(parse::at("5,7", Dimension::Two)?, At { layer: Some(5), i: 7, j: 0 });
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct At {
    /// The layer; the base if there is none.
    pub layer: Option<i128>,
    /// The place within the row.
    pub i: i128,
    /// The row.
    pub j: i128,
}

impl At {
    /// The site, for a pile of this many layers. Whether the pile has it is not checked here.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Site};
    /// use cannonpile::scene::parse;
    ///
    /// let site = parse::at("5,7", Dimension::Three)?.site(10);
    /// assert_eq!(site, Site { i: 5, j: 7, k: 9 });
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn site(&self, layers: i128) -> Site {
        let k = self.layer.unwrap_or(layers.saturating_sub(1));
        Site {
            i: self.i,
            j: self.j,
            k,
        }
    }
}

/// One sphere: `K,I,J` or `I,J`; in two dimensions `K,I` or `I`.
///
/// # Errors
/// [`Error::Syntax`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Dimension;
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::at("9,5,2", Dimension::Three)?.layer, Some(9));
/// assert_eq!(parse::at("5", Dimension::Two)?.i, 5);
/// assert!(parse::at("5", Dimension::Three).is_err());
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn at(text: &str, dimension: Dimension) -> Result<At, Error> {
    let expected = match dimension {
        Dimension::Two => "a disc: K,I, or I on the base",
        Dimension::Three => "a sphere: K,I,J, or I,J on the base",
    };
    let mut numbers = [0; 3];
    let mut given = 0;
    for part in text.split(',') {
        let slot = numbers
            .get_mut(given)
            .ok_or_else(|| Error::syntax(text, expected))?;
        *slot = part
            .trim()
            .parse()
            .map_err(|_| Error::syntax(text, expected))?;
        given += 1;
    }
    let [a, b, c] = numbers;
    match (dimension, given) {
        (Dimension::Three, 3) => Ok(At {
            layer: Some(a),
            i: b,
            j: c,
        }),
        (Dimension::Three, 2) => Ok(At {
            layer: None,
            i: a,
            j: b,
        }),
        (Dimension::Two, 2) => Ok(At {
            layer: Some(a),
            i: b,
            j: 0,
        }),
        (Dimension::Two, 1) => Ok(At {
            layer: None,
            i: a,
            j: 0,
        }),
        _ => Err(Error::syntax(text, expected)),
    }
}

/// A direction by its name.
///
/// # Errors
/// [`Error::Syntax`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Direction;
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::direction("gamma")?, Direction::Gamma);
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn direction(text: &str) -> Result<Direction, Error> {
    let found = Direction::ALL
        .into_iter()
        .find(|direction| direction.name() == text);
    found.ok_or_else(|| Error::syntax(text, "a direction: alpha, beta or gamma"))
}
