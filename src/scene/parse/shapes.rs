//! Regions, stackings and loads from text.

use num_rational::BigRational;

use super::{At, at, integer, rational};
use crate::Error;
use crate::lattice::{Dimension, Region};
use crate::stacking::Pattern;

/// The layer a pile is grown from: `hexagon:P,Q`, `hexagon:N`, `triangle:N` or `region:x0..x1,y0..y1,s0..s1`, bounds
/// included.
///
/// # Errors
/// [`Error::Syntax`]; those of [`Region::new`] and [`Region::hexagon`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Region;
/// use cannonpile::scene::parse;
///
/// assert_eq!(parse::region("hexagon:3,2")?, Region::hexagon(3, 2)?);
/// assert_eq!(parse::region("hexagon:3")?, Region::hexagon(3, 3)?);
/// assert_eq!(parse::region("triangle:4")?, Region::triangle(4)?);
/// assert_eq!(parse::region("region:0..3,0..3,0..3")?, Region::triangle(4)?);
/// assert!(parse::region("circle:4").is_err());
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn region(text: &str) -> Result<Region, Error> {
    let syntax = || {
        Error::syntax(
            text,
            "a shape: hexagon:P,Q, hexagon:N, triangle:N or region:x0..x1,y0..y1,s0..s1",
        )
    };
    let (kind, sizes) = text.split_once(':').ok_or_else(syntax)?;
    match kind {
        "hexagon" => {
            let (p, q) = sizes.split_once(',').unwrap_or((sizes, sizes));
            Region::hexagon(integer(p)?, integer(q)?)
        }
        "triangle" => Region::triangle(integer(sizes)?),
        "region" => {
            let mut ranges = sizes.split(',').map(|range| {
                let (from, to) = range.split_once("..").ok_or_else(syntax)?;
                Ok(integer(from)?..=integer(to)?)
            });
            let mut next = || ranges.next().unwrap_or_else(|| Err(syntax()));
            let (x, y, s) = (next()?, next()?, next()?);
            match ranges.next() {
                None => Region::new(x, y, s),
                Some(_) => Err(syntax()),
            }
        }
        _ => Err(syntax()),
    }
}

/// A stacking: `fcc`, `hcp`, `dhcp`, or spelled out in one of four notations.
///
/// # Errors
/// [`Error::Syntax`], and those of a stacking that is too long.
///
/// # Examples
/// ```
/// use cannonpile::scene::parse;
/// use cannonpile::stacking::Pattern;
///
/// assert_eq!(parse::stacking("hcp")?, Pattern::Hcp);
/// assert_eq!(parse::stacking("ABCB")?, Pattern::Spelled("++-".parse()?));
/// assert!(parse::stacking("bcc").is_err());
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn stacking(text: &str) -> Result<Pattern, Error> {
    Ok(match text {
        "fcc" => Pattern::Fcc,
        "hcp" => Pattern::Hcp,
        "dhcp" => Pattern::Dhcp,
        _ => Pattern::Spelled(text.parse()?),
    })
}

/// A load on one sphere, in mg: `K,I,J=W`, or `I,J=W` on the base. Discs: `K,I=W`, `I=W`.
///
/// # Errors
/// [`Error::Syntax`].
///
/// # Examples
/// ```
/// use cannonpile::lattice::Dimension;
/// use cannonpile::scene::parse;
///
/// let (at, load) = parse::load("0,0,0=5/2", Dimension::Three)?;
/// assert_eq!((at.layer, load.to_string().as_str()), (Some(0), "5/2"));
/// # Ok::<(), cannonpile::Error>(())
/// ```
pub fn load(text: &str, dimension: Dimension) -> Result<(At, BigRational), Error> {
    let expected = "a load K,I,J=W on a sphere, such as 0,0,0=5/2";
    let (site, load) = text
        .split_once('=')
        .ok_or_else(|| Error::syntax(text, expected))?;
    Ok((at(site, dimension)?, rational(load)?))
}
