//! Regions of any size, their bounds, sites about them, and small piles with weights and loads.

use arbitrary::{Error, Result, Unstructured};
use cannonpile::Pile;
use cannonpile::lattice::{MAX_LAYERS, Region, Sign, Site};
use cannonpile::stacking::Stacking;
use num_rational::BigRational;
use num_traits::Signed;

use super::number::{self, ratio};
use super::rarely;
use super::stacking::{signs, signs_of};

/// Draws six bounds x₀, x₁, y₀, y₁, s₀, s₁ for [`Region::new`], which may be invalid.
///
/// All of them are small, or all are within ±[`MAX_LAYERS`], or some may exceed this limit. About one pair in eight has
/// its bounds in arbitrary order, so that they may cross.
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
pub fn region(u: &mut Unstructured<'_>) -> Result<Region> {
    let [x0, x1, y0, y1, s0, s1] = bounds(u)?;
    match Region::new(x0..=x1, y0..=y1, s0..=s1) {
        Ok(region) => Ok(region),
        Err(_) => small_region(u),
    }
}

/// Draws a region of up to five sites a side, close to the origin.
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
pub fn site_about(u: &mut Unstructured<'_>, region: &Region) -> Result<[i128; 2]> {
    let corners = region.corners();
    let [[a, b], [c, d]] = [*u.choose(&corners)?, *u.choose(&corners)?];
    let [i, j] = if u.arbitrary()? {
        [a, b]
    } else {
        [a.midpoint(c), b.midpoint(d)]
    };
    Ok([i + u.int_in_range(-2..=2)?, j + u.int_in_range(-2..=2)?])
}

/// The data that a pile is built from, for tests that build the same pile a second way.
#[derive(Clone, Debug)]
pub struct Described {
    /// The top layer, or the base.
    pub region: Region,
    /// True if `region` is the base.
    pub from_base: bool,
    /// The Hägg signs, from the top.
    pub signs: Vec<Sign>,
    /// True if the spheres have zero weight, so that only loads act.
    pub weightless: bool,
    /// The weights that differ from mg, in mg. If a site has several, the last one applies.
    pub weights: Vec<(Site, BigRational)>,
    /// The loads, in mg. Several loads on a site add up.
    pub loads: Vec<(Site, BigRational)>,
}

impl Described {
    /// Builds the pile.
    pub fn pile(&self) -> core::result::Result<Pile, cannonpile::Error> {
        let stacking = Stacking::from_signs(self.signs.iter().copied())?;
        let mut pile = if self.from_base {
            Pile::on(self.region, stacking)
        } else {
            Pile::under(self.region, stacking)
        }?;
        for (site, weight) in &self.weights {
            pile = pile.with_weight(*site, weight.clone())?;
        }
        for (site, load) in &self.loads {
            pile = pile.with_load(*site, load.clone())?;
        }
        Ok(if self.weightless {
            pile.weightless()
        } else {
            pile
        })
    }
}

/// Draws a pile of up to six layers, or of up to ten under one sphere, with up to three weights and three loads from
/// [`weight`].
pub fn described(u: &mut Unstructured<'_>) -> Result<Described> {
    described_by(u, weight)
}

/// Draws a pile of up to six layers, or of up to ten under one sphere, with weights and loads from `weight`.
fn described_by(
    u: &mut Unstructured<'_>,
    weight: fn(&mut Unstructured<'_>) -> Result<BigRational>,
) -> Result<Described> {
    let from_base = u.arbitrary()?;
    let (region, most) = if rarely(u, 4)? {
        (Region::SITE, 9)
    } else {
        (small_region(u)?, 5)
    };
    let signs = signs(u, most)?;
    grown(u, from_base, region, signs, weight)
}

/// Draws a pile of up to six layers, with weights and loads from [`light`].
pub fn lightly(u: &mut Unstructured<'_>) -> Result<Described> {
    let from_base = u.arbitrary()?;
    let region = small_region(u)?;
    let signs = signs(u, 5)?;
    grown(u, from_base, region, signs, light)
}

/// Draws a pile of at most `layers` layers, and at most five, small enough for an exact linear program over all its
/// forces, with weights and loads from [`light`].
pub fn tiny(u: &mut Unstructured<'_>, layers: usize) -> Result<Described> {
    let from_base = u.arbitrary()?;
    let (region, most): (_, usize) = if rarely(u, 4)? {
        let [i, j] = [u.int_in_range(-2..=2)?, u.int_in_range(-2..=2)?];
        let ends = [i + u.int_in_range(0..=1)?, j + u.int_in_range(0..=1)?];
        // A rhombus of four sites, one of its edges, or one site.
        let region = Region::new(i..=ends[0], j..=ends[1], i + j..=ends[0] + ends[1]);
        let most = if from_base { 3 } else { 2 };
        (valid(region)?, most)
    } else {
        (Region::SITE, if rarely(u, 8)? { 4 } else { 3 })
    };
    // Nearly all piles of fewer layers are stable.
    let fewer = [1, 0, 2, 0][u.choose_index(4)?];
    let steps = most.min(layers.saturating_sub(1)).saturating_sub(fewer);
    let signs = signs_of(u, steps)?;
    grown(u, from_base, region, signs, light)
}

/// Draws the remaining data of a pile under `region`, or on a base that is obtained from `region` by dilation.
fn grown(
    u: &mut Unstructured<'_>,
    from_base: bool,
    region: Region,
    signs: Vec<Sign>,
    weight: fn(&mut Unstructured<'_>) -> Result<BigRational>,
) -> Result<Described> {
    let mut described = Described {
        region: if from_base {
            base(u, region, &signs)?
        } else {
            region
        },
        from_base,
        signs,
        weightless: rarely(u, 6)?,
        weights: Vec::new(),
        loads: Vec::new(),
    };
    // Steps that do not fit on the base are dropped from the top.
    let pile = loop {
        match described.pile() {
            Ok(pile) => break pile,
            // One layer fits on every region.
            Err(_) if described.signs.is_empty() => return Err(Error::IncorrectFormat),
            Err(_) => drop(described.signs.remove(0)),
        }
    };
    let sites: Vec<Site> = pile.shape().sites().collect();
    for _ in 0..u.int_in_range(0..=3)? {
        let weight = (*u.choose(&sites)?, weight(u)?);
        described.weights.push(weight);
    }
    for _ in 0..u.int_in_range(0..=3)? {
        let load = (*u.choose(&sites)?, weight(u)?);
        described.loads.push(load);
    }
    Ok(described)
}

/// Draws a base: the region that `top` dilates to, with each bound moved by at most one site. As a result, some of its
/// spheres may support no other sphere, or it may not support all steps.
fn base(u: &mut Unstructured<'_>, top: Region, signs: &[Sign]) -> Result<Region> {
    let grown = signs
        .iter()
        .try_fold(top, |layer, sign| layer.dilated(*sign));
    let grown = valid(grown)?;
    let mut sides = [grown.x(), grown.y(), grown.s()];
    for side in &mut sides {
        let [low, high] = [u.int_in_range(-1..=1)?, u.int_in_range(-1..=1)?];
        *side = side.start() - low..=side.end() + high;
    }
    let [x, y, s] = sides;
    Ok(Region::new(x, y, s).unwrap_or(grown))
}

/// Draws a weight or load, in mg: zero, an integer, a fraction, a power of two up to 2^130, or any rational ≥ 0.
pub fn weight(u: &mut Unstructured<'_>) -> Result<BigRational> {
    Ok(match u.int_in_range(0..=4)? {
        0 => ratio(0, 1),
        1 => ratio(u.int_in_range(1..=9)?, 1),
        2 => ratio(u.int_in_range(1..=99)?, u.int_in_range(1..=99)?),
        3 => number::power(2, u.int_in_range(-70..=130)?),
        _ => number::rational(u)?.abs(),
    })
}

/// Draws a weight or load of at most 9 mg, with the denominator 1, 2, 3 or 7.
pub fn light(u: &mut Unstructured<'_>) -> Result<BigRational> {
    Ok(ratio(u.int_in_range(0..=9)?, *u.choose(&[1, 1, 2, 3, 7])?))
}

/// Converts an error of the library to one of the generator.
pub(super) fn valid<T>(made: core::result::Result<T, cannonpile::Error>) -> Result<T> {
    made.map_err(|_| Error::IncorrectFormat)
}
