//! Generators of regions and of positions close to them: small, flat, close to the greatest coordinates, with bounds
//! that cross or exceed the limit.

use arbitrary::{Arbitrary, Result, Unstructured};

use super::draw::{rarely, valid};
use super::number;
use crate::lattice::{MAX_LAYERS, Region, Site};

/// Draws six bounds x₀, x₁, y₀, y₁, s₀, s₁ for [`Region::new`], which may be invalid.
///
/// All of them are small, or all are within ±[`MAX_LAYERS`], or some may exceed this limit. About one pair in eight has
/// its bounds in arbitrary order, so that they may cross.
///
/// # Errors
/// The errors of [`Unstructured`].
///
/// # Examples
/// ```
/// use cannonpile::arbitrary::{Unstructured, bounds};
/// use cannonpile::lattice::Region;
///
/// let [x0, x1, y0, y1, s0, s1] = bounds(&mut Unstructured::new(b"some bytes"))?;
/// if let Ok(region) = Region::new(x0..=x1, y0..=y1, s0..=s1) {
///     assert!(x0 <= *region.x().start());
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn bounds(u: &mut Unstructured<'_>) -> Result<[i128; 6]> {
    let reach = u.int_in_range(0..=4)?;
    let mut bounds = [0; 6];
    for pair in bounds.chunks_mut(2) {
        let ends = [coordinate(u, reach)?, coordinate(u, reach)?];
        let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let ordered = if rarely(u, 8)? { ends } else { [low, high] };
        pair.copy_from_slice(&ordered);
    }
    Ok(bounds)
}

/// Draws a coordinate: small for a `reach` of 0 or 1, within ±[`MAX_LAYERS`] for 2 and 3, any `i128` for a greater one.
fn coordinate(u: &mut Unstructured<'_>, reach: u8) -> Result<i128> {
    let kind = match reach {
        0 | 1 => 0,
        2 | 3 => u.int_in_range(0..=3)?,
        _ => u.int_in_range(0..=5)?,
    };
    Ok(match kind {
        0 => u.int_in_range(-5..=5)?,
        1 => -MAX_LAYERS + u.int_in_range(0..=3)?,
        2 => MAX_LAYERS - u.int_in_range(0..=3)?,
        3 => u.int_in_range(-MAX_LAYERS..=MAX_LAYERS)?,
        4 => [MAX_LAYERS + 1, -MAX_LAYERS - 1, i128::MIN, i128::MAX][u.choose_index(4)?],
        _ => number::machine_integer(u)?,
    })
}

/// Draws a region of any size, with up to about 10³⁶ rows.
///
/// # Errors
/// The errors of [`Unstructured`].
///
/// # Examples
/// ```
/// use cannonpile::arbitrary::{Unstructured, region};
///
/// let region = region(&mut Unstructured::new(b"some bytes"))?;
/// assert!(region.site_count() >= 1_u8.into());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn region(u: &mut Unstructured<'_>) -> Result<Region> {
    let [x0, x1, y0, y1, s0, s1] = bounds(u)?;
    match Region::new(x0..=x1, y0..=y1, s0..=s1) {
        Ok(region) => Ok(region),
        Err(_) => small_region(u),
    }
}

/// Draws a region of up to five sites a side, close to the origin.
///
/// # Errors
/// The errors of [`Unstructured`].
///
/// # Examples
/// ```
/// use cannonpile::arbitrary::{Unstructured, small_region};
///
/// let region = small_region(&mut Unstructured::new(b"some bytes"))?;
/// assert!(region.site_count() <= 25_u8.into());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn small_region(u: &mut Unstructured<'_>) -> Result<Region> {
    let [x, y] = [u.int_in_range(-2..=2)?, u.int_in_range(-2..=2)?];
    let [along_x, along_y] = [u.int_in_range(0..=4)?, u.int_in_range(0..=4)?];
    // The bounds on i+j remove corners. Each sum from `low` to `high` belongs to some site, so the region is not empty.
    let whole = along_x + along_y;
    let low = u.int_in_range(0..=whole)?;
    let high = u.int_in_range(low..=whole)?;
    let from = x + y;
    valid(Region::new(
        x..=x + along_x,
        y..=y + along_y,
        from + low..=from + high,
    ))
}

/// Draws a position (i, j) close to a corner of the region, or close to the middle between two corners: at most two
/// steps away in i and in j. The position may lie outside the region.
///
/// # Errors
/// The errors of [`Unstructured`].
///
/// # Examples
/// ```
/// use cannonpile::arbitrary::{Unstructured, position_near};
/// use cannonpile::lattice::Region;
///
/// let [i, j] = position_near(&mut Unstructured::new(b"some bytes"), &Region::SITE)?;
/// assert!(i.abs() <= 2 && j.abs() <= 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn position_near(u: &mut Unstructured<'_>, region: &Region) -> Result<[i128; 2]> {
    let corners = region.corners();
    let [[a, b], [c, d]] = [*u.choose(&corners)?, *u.choose(&corners)?];
    let [i, j] = if u.arbitrary()? {
        [a, b]
    } else {
        [a.midpoint(c), b.midpoint(d)]
    };
    Ok([i + u.int_in_range(-2..=2)?, j + u.int_in_range(-2..=2)?])
}

/// A region of up to five sites a side.
impl<'a> Arbitrary<'a> for Region {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        small_region(u)
    }
}

/// A site with small coordinates, with coordinates close to ±[`MAX_LAYERS`], or with any. It may lie outside every
/// pile.
impl<'a> Arbitrary<'a> for Site {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        let reach = u.int_in_range(0..=4)?;
        let [i, j] = [coordinate(u, reach)?, coordinate(u, reach)?];
        let k = coordinate(u, reach)?;
        Ok(Self { i, j, k })
    }
}
