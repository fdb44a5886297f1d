//! Parsers of scene values without a type of their own: numbers, positions of spheres, loads and tilts. `str::parse` reads the
//! other values: [`Region`](cannonpile::lattice::Region), [`Pattern`](cannonpile::stacking::Pattern),
//! [`Spacing`](cannonpile::geometry::Spacing), [`Dimension`], [`Surd`](cannonpile::scalar::Surd).

use num_rational::BigRational;
use num_traits::Zero;

use crate::Error;
use cannonpile::Load;
use cannonpile::lattice::{Dimension, MAX_LAYERS, Site};
use cannonpile::scalar::parse as exact;

/// Reads a rational number exactly: `6/5`, `1.2`, `1e-3`.
///
/// # Errors
/// [`Error::Core`].
///
/// # Examples
/// ```
/// use cannonpile_dem::scene::parse;
///
/// assert_eq!(parse::rational("1.2")?, parse::rational("6/5")?);
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
pub fn rational(text: &str) -> Result<BigRational, Error> {
    exact::rational(text).map_err(|error| cannonpile::Error::from(error).into())
}

/// Reads an integer: `10`, `-3`, `1e36`.
///
/// # Errors
/// [`Error::Core`].
///
/// # Examples
/// ```
/// use cannonpile_dem::scene::parse;
///
/// assert_eq!(parse::integer("-5")?, -5);
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
pub fn integer(text: &str) -> Result<i128, Error> {
    exact::integer(text).map_err(|error| cannonpile::Error::from(error).into())
}

/// Reads a number of layers: `10`, `1e36`.
///
/// # Errors
/// [`Error::Layers`](cannonpile::Error::Layers) for an integer out of range,
/// [`Error::Syntax`](cannonpile::Error::Syntax) for any other text.
///
/// # Examples
/// ```
/// use cannonpile_dem::Error;
/// use cannonpile_dem::scene::parse;
///
/// assert_eq!(parse::layers("10")?, 10);
/// assert_eq!(parse::layers("1e36")?, 10_i128.pow(36));
/// assert!(matches!(parse::layers("0"), Err(Error::Core(cannonpile::Error::Layers { .. }))));
/// assert!(matches!(parse::layers("ten"), Err(Error::Core(cannonpile::Error::Syntax { .. }))));
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
pub fn layers(text: &str) -> Result<i128, Error> {
    let given = exact::big_integer(text)
        .map_err(|_| Error::syntax(text, "a number of layers such as 10 or 1e36"))?;
    match i128::try_from(&given) {
        Ok(layers) if (1..=MAX_LAYERS).contains(&layers) => Ok(layers),
        _ => Err(cannonpile::Error::Layers { given }.into()),
    }
}

/// The position of one sphere in a pile of any height: in its base, or in a layer counted from the top.
///
/// The parser is [`at`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Dimension;
/// use cannonpile_dem::scene::parse;
/// use cannonpile_dem::scene::parse::At;
///
/// assert_eq!(parse::at("5,7", Dimension::Three)?, At { layer: None, i: 5, j: 7 });
/// assert_eq!(parse::at("5,7", Dimension::Two)?, At { layer: Some(5), i: 7, j: 0 });
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct At {
    /// The layer; `None` for the base.
    pub layer: Option<i128>,
    /// The position within the row.
    pub i: i128,
    /// The row.
    pub j: i128,
}

impl At {
    /// Returns the site in a pile of this many layers. This function does not check that the pile contains the site.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::lattice::{Dimension, Site};
    /// use cannonpile_dem::scene::parse;
    ///
    /// let site = parse::at("5,7", Dimension::Three)?.site(10);
    /// assert_eq!(site, Site { i: 5, j: 7, k: 9 });
    /// # Ok::<(), cannonpile_dem::Error>(())
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

/// Reads the position of one sphere: `K,I,J`, or `I,J` on the base; in two dimensions `K,I`, or `I`.
///
/// # Errors
/// [`Error::Syntax`](cannonpile::Error::Syntax).
///
/// # Examples
/// ```
/// use cannonpile::lattice::Dimension;
/// use cannonpile_dem::scene::parse;
///
/// assert_eq!(parse::at("9,5,2", Dimension::Three)?.layer, Some(9));
/// assert_eq!(parse::at("5", Dimension::Two)?.i, 5);
/// assert!(parse::at("5", Dimension::Three).is_err());
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
pub fn at(text: &str, dimension: Dimension) -> Result<At, Error> {
    let expected = match dimension {
        Dimension::Two => "a disc: K,I, or I on the base",
        Dimension::Three => "a sphere: K,I,J, or I,J on the base",
    };
    let syntax = || Error::syntax(text, expected);
    // Four parts are enough to detect a list that is too long.
    let numbers = text.split(',').take(4).map(|part| integer(part.trim()));
    let numbers: Vec<i128> = numbers.collect::<Result<_, _>>().map_err(|_| syntax())?;
    let (layer, i, j) = match (dimension, numbers.as_slice()) {
        (Dimension::Three, &[k, i, j]) => (Some(k), i, j),
        (Dimension::Three, &[i, j]) => (None, i, j),
        (Dimension::Two, &[k, i]) => (Some(k), i, 0),
        (Dimension::Two, &[i]) => (None, i, 0),
        _ => return Err(syntax()),
    };
    Ok(At { layer, i, j })
}

/// Reads a load on one sphere: `K,I,J=W` for W mg downwards, or `K,I,J=W,X,Y` with horizontal components in the units of
/// [`Load`]. `I,J` is a sphere of the base. Discs: `K,I` or `I`, and `W` or `W,X`.
///
/// # Errors
/// [`Error::Syntax`](cannonpile::Error::Syntax).
///
/// # Examples
/// ```
/// use cannonpile::lattice::Dimension;
/// use cannonpile_dem::scene::parse;
///
/// let (at, load) = parse::load("0,0,0=5/2", Dimension::Three)?;
/// assert_eq!((at.layer, load.to_string().as_str()), (Some(0), "5/2"));
/// let (_, load) = parse::load("0,0,0=1,-1/4,0.5", Dimension::Three)?;
/// assert_eq!(load.to_string(), "(1, -1/4, 1/2)");
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
pub fn load(text: &str, dimension: Dimension) -> Result<(At, Load), Error> {
    let expected = match dimension {
        Dimension::Two => "a load K,I=W or K,I=W,X on a disc, such as 0,0=5/2",
        Dimension::Three => "a load K,I,J=W or K,I,J=W,X,Y on a sphere, such as 0,0,0=5/2",
    };
    let syntax = || Error::syntax(text, expected);
    let (site, load) = text.split_once('=').ok_or_else(syntax)?;
    let site = at(site, dimension)?;
    let load = match load.split_once(',') {
        None => rational(load)?.into(),
        Some((down, horizontal)) => {
            let [x, y] = components(horizontal, dimension).ok_or_else(syntax)??;
            Load {
                down: rational(down.trim())?,
                x,
                y,
            }
        }
    };
    Ok((site, load))
}

/// Reads a tilt of gravity `X,Y`, in the units of [`Pile::with_tilt`](cannonpile::Pile::with_tilt). For discs, `X` is
/// sufficient.
///
/// # Errors
/// [`Error::Syntax`](cannonpile::Error::Syntax).
///
/// # Examples
/// ```
/// use cannonpile::lattice::Dimension;
/// use cannonpile_dem::scene::parse;
///
/// let tilt = parse::tilt("0.25,-1/8", Dimension::Three)?;
/// assert_eq!(tilt.map(|part| part.to_string()), ["1/4", "-1/8"]);
/// assert!(parse::tilt("1/4", Dimension::Three).is_err());
/// # Ok::<(), cannonpile_dem::Error>(())
/// ```
pub fn tilt(text: &str, dimension: Dimension) -> Result<[BigRational; 2], Error> {
    let expected = match dimension {
        Dimension::Two => "a tilt X of gravity, such as 1/4",
        Dimension::Three => "a tilt X,Y of gravity, such as 1/4,0",
    };
    components(text, dimension).ok_or_else(|| Error::syntax(text, expected))?
}

/// Reads the components `X,Y` of a horizontal vector; for discs also `X`. Returns `None` for another number of
/// components.
fn components(text: &str, dimension: Dimension) -> Option<Result<[BigRational; 2], Error>> {
    let mut parts = text.split(',').map(str::trim);
    let (x, y, more) = (parts.next()?, parts.next(), parts.next());
    if more.is_some() || (y.is_none() && dimension == Dimension::Three) {
        return None;
    }
    let both = || {
        let y = y.map_or_else(|| Ok(BigRational::zero()), rational)?;
        Ok([rational(x)?, y])
    };
    Some(both())
}
