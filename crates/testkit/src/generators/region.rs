//! Regions: small, flat, about the greatest coordinates; bounds that are loose, crossed or beyond the limit; and piles
//! on them.

use arbitrary::{Result, Unstructured};
use cannonpile::lattice::{MAX_LAYERS, Region, Sign, Site};
use cannonpile::shape::Shape;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile};
use num_rational::BigRational;
use num_traits::Signed;

use super::{number, rarely, stacking};

/// Six bounds x₀, x₁, y₀, y₁, s₀, s₁, in order or not: all small, up to the limit, or some of them beyond.
pub fn bounds(u: &mut Unstructured<'_>) -> Result<[i128; 6]> {
    let reach = u.int_in_range(0..=4)?;
    let mut bounds = [0; 6];
    for pair in bounds.chunks_mut(2) {
        let ends = [coordinate(u, reach)?, coordinate(u, reach)?];
        let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        // One in eight is crossed.
        let ordered = if rarely(u, 8)? { ends } else { [low, high] };
        pair.copy_from_slice(&ordered);
    }
    Ok(bounds)
}

/// Small for a reach of 0 or 1, within the limit up to 3.
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

/// A region of any size.
pub fn region(u: &mut Unstructured<'_>) -> Result<Region> {
    let [x0, x1, y0, y1, s0, s1] = bounds(u)?;
    match Region::new(x0..=x1, y0..=y1, s0..=s1) {
        Ok(region) => Ok(region),
        Err(_) => small_region(u),
    }
}

/// A region of up to five sites a side, not far from the origin.
pub fn small_region(u: &mut Unstructured<'_>) -> Result<Region> {
    let [x, y] = [u.int_in_range(-2..=2)?, u.int_in_range(-2..=2)?];
    let [along_x, along_y] = [u.int_in_range(0..=4)?, u.int_in_range(0..=4)?];
    // Corners cut off, but not so much that nothing is left.
    let whole = along_x + along_y;
    let low = u.int_in_range(0..=whole)?;
    let high = u.int_in_range(low..=whole)?;
    let from = x + y;
    let region = Region::new(x..=x + along_x, y..=y + along_y, from + low..=from + high);
    Ok(region.expect("some i+j is left"))
}

/// A site at a corner of the region, up to two steps off, or in the middle of two corners.
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

/// A pile as it was described: from which region, in which direction it was grown, what weighs how much.
#[derive(Clone, Debug)]
pub struct Described {
    /// The top layer, or the base.
    pub region: Region,
    /// Whether it is the base.
    pub from_base: bool,
    /// From the top.
    pub signs: Vec<Sign>,
    /// Whether only loads act.
    pub weightless: bool,
    /// Of spheres that do not weigh mg; the last one counts.
    pub weights: Vec<(Site, BigRational)>,
    /// All count, of one sphere too.
    pub loads: Vec<(Site, BigRational)>,
}

impl Described {
    fn shape(&self) -> core::result::Result<Shape, Error> {
        let stacking = Stacking::from_signs(self.signs.iter().copied())?;
        if self.from_base {
            Shape::on(self.region, stacking)
        } else {
            Shape::under(self.region, stacking)
        }
    }

    /// As the library makes it.
    pub fn pile(&self) -> core::result::Result<Pile, Error> {
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

/// A pile of up to six layers, under one sphere ten, small enough to look at every sphere, with weights and loads.
pub fn described(u: &mut Unstructured<'_>) -> Result<Described> {
    let from_base = u.arbitrary()?;
    let (region, most) = if rarely(u, 4)? {
        (Region::SITE, 9)
    } else {
        (small_region(u)?, 5)
    };
    let signs = stacking::signs(u, most)?;
    grown(u, from_base, region, signs, weight)
}

/// The same with weights and loads that are alike.
pub fn lightly(u: &mut Unstructured<'_>) -> Result<Described> {
    let from_base = u.arbitrary()?;
    let region = small_region(u)?;
    let signs = stacking::signs(u, 5)?;
    grown(u, from_base, region, signs, light)
}

/// A pile of up to four layers, now and then five, small enough for exact programs over all its forces; with light
/// weights and loads.
pub fn tiny(u: &mut Unstructured<'_>) -> Result<Described> {
    let from_base = u.arbitrary()?;
    let (region, most): (_, usize) = if rarely(u, 4)? {
        let [i, j] = [u.int_in_range(-2..=2)?, u.int_in_range(-2..=2)?];
        let ends = [i + u.int_in_range(0..=1)?, j + u.int_in_range(0..=1)?];
        let region = Region::new(i..=ends[0], j..=ends[1], i + j..=ends[0] + ends[1]);
        let most = if from_base { 3 } else { 2 };
        (region.expect("a rhombus or a part of its edge"), most)
    } else {
        (Region::SITE, if rarely(u, 8)? { 4 } else { 3 })
    };
    // Of fewer layers nearly all stand alone.
    let fewer = [1, 0, 2, 0][u.choose_index(4)?];
    let steps = most.saturating_sub(fewer);
    let signs = stacking::signs_of(u, steps)?;
    grown(u, from_base, region, signs, light)
}

/// From a top, or from a base that it is grown to.
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
    // A base loses the steps that do not fit.
    let shape = loop {
        match described.shape() {
            Ok(shape) => break shape,
            Err(_) => drop(described.signs.remove(0)),
        }
    };
    let sites: Vec<Site> = shape.sites().collect();
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

/// What the region is grown to, each bound moved by a site at most: some spheres of it will carry nothing, or some
/// steps will not fit.
fn base(u: &mut Unstructured<'_>, top: Region, signs: &[Sign]) -> Result<Region> {
    let grown = signs
        .iter()
        .try_fold(top, |layer, sign| layer.dilated(*sign));
    let grown = grown.expect("a few steps");
    let mut sides = [grown.x(), grown.y(), grown.s()];
    for side in &mut sides {
        let [low, high] = [u.int_in_range(-1..=1)?, u.int_in_range(-1..=1)?];
        *side = side.start() - low..=side.end() + high;
    }
    let [x, y, s] = sides;
    Ok(Region::new(x, y, s).unwrap_or(grown))
}

/// Nothing, little, or so much that it fills many words.
pub fn weight(u: &mut Unstructured<'_>) -> Result<BigRational> {
    Ok(match u.int_in_range(0..=4)? {
        0 => number::ratio(0, 1),
        1 => number::ratio(u.int_in_range(1..=9)?, 1),
        2 => number::ratio(u.int_in_range(1..=99)?, u.int_in_range(1..=99)?),
        3 => number::power(2, u.int_in_range(-70..=130)?),
        _ => number::rational(u)?.abs(),
    })
}

/// Nothing, or some weights of a sphere.
pub fn light(u: &mut Unstructured<'_>) -> Result<BigRational> {
    Ok(number::ratio(
        u.int_in_range(0..=9)?,
        *u.choose(&[1, 1, 2, 3, 7])?,
    ))
}
