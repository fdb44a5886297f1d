//! Generators of small piles with weights and loads, of regular piles, and of sites of any pile.

use alloc::vec::Vec;

use arbitrary::{Arbitrary, Error, Result, Unstructured};
use num_rational::BigRational;
use num_traits::Signed;

use super::draw::{rarely, valid};
use super::number::{self, ratio};
use super::region::small_region;
use super::stacking::{signs, signs_of};
use crate::Pile;
use crate::lattice::{Dimension, Region, Sign, Site};
use crate::stacking::Stacking;

/// The data that a pile is built from, for tests that build the same pile a second way.
///
/// # Examples
/// ```
/// use cannonpile::arbitrary::{Unstructured, description};
///
/// let described = description(&mut Unstructured::new(b"some bytes"))?;
/// let pile = described.pile()?;
/// assert_eq!(pile.layers(), described.signs.len() as i128 + 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Description {
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

impl Description {
    /// Builds the pile.
    ///
    /// # Errors
    /// The errors of [`Pile::on`], [`Pile::under`], [`Pile::with_weight`] and [`Pile::with_load`], if fields were changed.
    pub fn pile(&self) -> core::result::Result<Pile, crate::Error> {
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
///
/// # Errors
/// The errors of [`Unstructured`].
pub fn description(u: &mut Unstructured<'_>) -> Result<Description> {
    described(u, weight)
}

/// Draws a pile of up to six layers, or of up to ten under one sphere, with weights and loads from `weight`.
fn described(
    u: &mut Unstructured<'_>,
    weight: fn(&mut Unstructured<'_>) -> Result<BigRational>,
) -> Result<Description> {
    let from_base = u.arbitrary()?;
    let (region, most) = if rarely(u, 4)? {
        (Region::SITE, 9)
    } else {
        (small_region(u)?, 5)
    };
    let signs = signs(u, most)?;
    grown(u, from_base, region, signs, weight)
}

/// Draws a pile of up to six layers, with weights and loads from [`light_weight`].
///
/// # Errors
/// The errors of [`Unstructured`].
pub fn light_description(u: &mut Unstructured<'_>) -> Result<Description> {
    let from_base = u.arbitrary()?;
    let region = small_region(u)?;
    let signs = signs(u, 5)?;
    grown(u, from_base, region, signs, light_weight)
}

/// Draws a pile of at most `layers` layers, and at most five, small enough for an exact linear program over all its
/// forces, with weights and loads from [`light_weight`].
///
/// # Errors
/// The errors of [`Unstructured`].
pub fn tiny_description(u: &mut Unstructured<'_>, layers: usize) -> Result<Description> {
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
    grown(u, from_base, region, signs, light_weight)
}

/// Draws the remaining data of a pile under `region`, or on a base that is obtained from `region` by dilation.
fn grown(
    u: &mut Unstructured<'_>,
    from_base: bool,
    region: Region,
    signs: Vec<Sign>,
    weight: fn(&mut Unstructured<'_>) -> Result<BigRational>,
) -> Result<Description> {
    let mut described = Description {
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
///
/// # Errors
/// The errors of [`Unstructured`].
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
///
/// # Errors
/// The errors of [`Unstructured`].
pub fn light_weight(u: &mut Unstructured<'_>) -> Result<BigRational> {
    Ok(ratio(u.int_in_range(0..=9)?, *u.choose(&[1, 1, 2, 3, 7])?))
}

/// Draws a weight or load between 0 and 300 mg, with the denominator 1, 2, 3 or 7. Three loads on one sphere stay below
/// 1000 mg.
fn moderate_weight(u: &mut Unstructured<'_>) -> Result<BigRational> {
    if rarely(u, 6)? {
        return Ok(ratio(0, 1));
    }
    let denom = *u.choose(&[1, 1, 2, 3, 7])?;
    Ok(ratio(u.int_in_range(0..=300 * denom)?, denom))
}

/// Draws a pile of up to ten layers. The weight of each sphere and the load on it lie between 0 and 1000 mg, with
/// denominators of at most 42.
///
/// Three in four piles have any stacking, on or under a small region. The others are straight piles of up to five
/// layers under one sphere: equilateral, of discs, or isosceles with a sin φ between 1/12 and 11/12. All contact forces
/// are below 10⁶ in units of f₀, so even `f32` does not overflow.
///
/// # Errors
/// The errors of [`Unstructured`].
///
/// # Examples
/// ```
/// use cannonpile::arbitrary::{Unstructured, moderate_pile};
///
/// let pile = moderate_pile(&mut Unstructured::new(b"some bytes"))?;
/// let thousand = cannonpile::ratio!(1000);
/// assert!(pile.weights().all(|(_, weight)| *weight <= thousand));
/// assert!(pile.loads().all(|(_, load)| load.down <= thousand));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn moderate_pile(u: &mut Unstructured<'_>) -> Result<Pile> {
    if !rarely(u, 4)? {
        return valid(described(u, moderate_weight)?.pile());
    }
    let layers = u.int_in_range(1..=5)?;
    valid(match u.int_in_range(0..=2)? {
        0 => Pile::triangular(layers),
        1 => Pile::discs(layers),
        _ => {
            let denom = u.int_in_range(2..=12)?;
            let sin_phi = ratio(u.int_in_range(1..=denom - 1)?, denom);
            Pile::isosceles(layers, sin_phi)
        }
    })
}

/// Draws a straight pile of `layers` layers under one sphere: equilateral, isosceles or of discs.
///
/// # Errors
/// The errors of [`Unstructured`], and [`arbitrary::Error::IncorrectFormat`] unless 1 ≤ `layers` ≤ 10³⁶.
pub fn regular_pile(u: &mut Unstructured<'_>, layers: i128) -> Result<Pile> {
    valid(match u.int_in_range(0..=3)? {
        0 => Pile::triangular(layers),
        1 => Pile::discs(layers),
        _ => Pile::isosceles(layers, number::sin_phi(u)?),
    })
}

/// Draws a site of the pile. The layer is the top, second, last but one or bottom layer, or any layer. Along i and j,
/// the site lies at an end, at a third of the length, or anywhere. The cost does not depend on the size of the layer.
///
/// # Errors
/// The errors of [`Unstructured`].
///
/// # Examples
/// ```
/// use cannonpile::Pile;
/// use cannonpile::arbitrary::{Unstructured, site};
///
/// let pile = Pile::triangular(10_i128.pow(30))?;
/// let site = site(&mut Unstructured::new(b"some bytes"), &pile)?;
/// assert!(pile.shape().contains(site));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn site(u: &mut Unstructured<'_>, pile: &Pile) -> Result<Site> {
    let floor = pile.layers() - 1;
    let k = match u.int_in_range(0..=2)? {
        0 => floor,
        // In low piles some of these layers coincide.
        1 => [0, 1, floor - 1][u.choose_index(3)?].clamp(0, floor),
        _ => u.int_in_range(0..=floor)?,
    };
    let region = valid(pile.shape().layer(k))?;
    let (first, last) = region.y().into_inner();
    let j = match pile.dimension() {
        Dimension::Two => first,
        Dimension::Three => first + offset(u, last - first)?,
    };
    // Every row of a region contains a site.
    let row = region.row(j);
    let i = row.start + offset(u, row.end - 1 - row.start)?;
    Ok(Site { i, j, k })
}

/// Draws a number from 0, …, `last`, often 0, `last` or `last`/3.
fn offset(u: &mut Unstructured<'_>, last: i128) -> Result<i128> {
    Ok(match u.int_in_range(0..=3)? {
        0 => 0,
        1 => last,
        2 => last / 3,
        _ => u.int_in_range(0..=last)?,
    })
}

/// A pile of up to ten layers: three in four by [`description`], the others by [`regular_pile`] with up to five layers.
impl<'a> Arbitrary<'a> for Pile {
    fn arbitrary(u: &mut Unstructured<'a>) -> Result<Self> {
        if rarely(u, 4)? {
            let layers = u.int_in_range(1..=5)?;
            regular_pile(u, layers)
        } else {
            valid(description(u)?.pile())
        }
    }
}
