//! Piles and sites in them: one layer, layers at the ends of integer widths, corners, bounds of the spacing.

use arbitrary::{Result, Unstructured};
use cannonpile::geometry::{Clearance, Spacing};
use cannonpile::lattice::{Dimension, Direction, MAX_LAYERS, Site};
use cannonpile::{Error, Packing, Pile};
use num_rational::BigRational;
use num_traits::Zero;

use super::number;
use super::region::valid;

/// A number of layers up to the maximum: few, near the powers of two where floats round or machine integers end, a power of
/// ten, or any.
pub fn layers(u: &mut Unstructured<'_>) -> Result<i128> {
    let layers = match u.int_in_range(0..=4)? {
        0 => u.int_in_range(1..=12)?,
        1 => (1 << u.int_in_range(0..=119)?) + u.int_in_range(-1..=1)?,
        2 => (1 << 53) + u.int_in_range(-1..=1)?,
        3 => 10_i128.pow([18, 30, 36][u.choose_index(3)?]),
        _ => u.int_in_range(1..=MAX_LAYERS)?,
    };
    Ok(layers.clamp(1, MAX_LAYERS))
}

/// Any straight pile: equilateral, isosceles or of discs.
pub fn pile(u: &mut Unstructured<'_>) -> Result<Pile> {
    let layers = layers(u)?;
    regular_pile(u, layers)
}

/// A pile that is small enough to examine every sphere.
pub fn small_pile(u: &mut Unstructured<'_>) -> Result<Pile> {
    let layers = u.int_in_range(1..=5)?;
    regular_pile(u, layers)
}

/// A pile whose sin φ is a float.
pub fn real_pile(u: &mut Unstructured<'_>) -> Result<Pile> {
    let (layers, s) = (layers(u)?, number::real_sin_phi(u)?);
    Ok(Pile::isosceles(layers, number::exactly(s)).expect("0 < s < 1"))
}

/// A site of the bottom layer.
pub fn bottom_site(u: &mut Unstructured<'_>, pile: &Pile) -> Result<Site> {
    let site = site(u, pile)?;
    // Every layer below has the i and j of a site above it.
    Ok(Site {
        k: pile.layers() - 1,
        ..site
    })
}

/// A direction of the pile's contacts.
pub fn direction(u: &mut Unstructured<'_>, pile: &Pile) -> Result<Direction> {
    u.choose(pile.dimension().directions()).copied()
}

/// The difference n of two sites of the pile. Each component is a few steps or as long as the pile.
///
/// Zero for suitable bytes: the same sphere twice.
pub fn difference(u: &mut Unstructured<'_>, pile: &Pile) -> Result<[i128; 3]> {
    let counts = |site: Site| [site.k - site.i - site.j, site.i, site.j];
    if u.arbitrary()? {
        let (from, to) = (counts(site(u, pile)?), counts(site(u, pile)?));
        return Ok(core::array::from_fn(|m| to[m] - from[m]));
    }
    let lines = pile.dimension().directions().len();
    let mut n = [0_i128; 3];
    for component in n.iter_mut().take(lines) {
        *component = u.int_in_range(-4..=4)?;
    }
    // Shrinks the difference until the pile contains it.
    while !occurs(n, pile.layers()) {
        n = n.map(|component| component / 2);
    }
    Ok(n)
}

/// Tells whether a pile with `layers` layers has two spheres whose difference is n.
///
/// From a common ancestor, the lower sphere is as many steps down as n has positive steps. The upper sphere is as many steps
/// down as n has negative ones.
pub fn occurs(n: [i128; 3], layers: i128) -> bool {
    let steps = |sign: i128| n.iter().map(|c| (c * sign).max(0)).sum::<i128>();
    steps(1) < layers && steps(-1) < layers
}

/// A spacing: at a bound, right next to it, far outside, or inside.
pub fn spacing(u: &mut Unstructured<'_>, clearance: &Clearance) -> Result<Spacing> {
    let bounds = [clearance.least(), clearance.most()];
    let square = match (u.int_in_range(0..=2)?, &bounds[u.choose_index(2)?]) {
        (0, Some(bound)) => {
            let off = number::power(2, u.int_in_range(-150..=-1)?);
            bound.square() * (off * number::ratio(u.int_in_range(-1..=1)?, 1) + number::ratio(1, 1))
        }
        (1, _) => number::quantity(u)?,
        _ => number::fraction(u)? * number::ratio(4, 1),
    };
    let square = if square.is_zero() {
        number::ratio(1, 1)
    } else {
        square
    };
    Ok(Spacing::from_square(square).expect("positive"))
}

/// A pile that allows some spacing: s ≤ 5/6 from three layers on (`paper`, "Overlap"). For two layers s² < 3/4, which keeps
/// θ below 90°.
pub fn packable_pile(u: &mut Unstructured<'_>) -> Result<Pile> {
    let pile = pile(u)?;
    let s = pile.sin_phi();
    let has_room = match pile.layers() {
        1 => true,
        2 => s * s < number::ratio(3, 4),
        _ => s <= &number::ratio(5, 6),
    };
    let equilateral = Pile::triangular(pile.layers()).expect("the same number of layers");
    Ok(if has_room { pile } else { equilateral })
}

/// A spacing for a [`packable_pile`]: at a bound, next to it, or between.
pub fn allowed_spacing(u: &mut Unstructured<'_>, pile: &Pile) -> Result<Spacing> {
    let clearance = pile.clearance();
    let flat = match pile.dimension() {
        Dimension::Two => number::ratio(4, 1),
        Dimension::Three => number::ratio(3, 1),
    };
    let (least, most) = (clearance.least(), clearance.most());
    let low = least
        .as_ref()
        .map_or_else(Zero::zero, |b| b.square().clone());
    let high = most.as_ref().map_or(flat, |b| b.square().clone());
    let q = &low + (&high - &low) * number::fraction(u)?;
    // The ends 0 and θ = 90°, which no pair of spheres sets, are excluded.
    let excluded = (least.is_none() && q == low) || (most.is_none() && q == high);
    let middle = (low + high) / number::ratio(2, 1);
    Ok(Spacing::from_square(if excluded { middle } else { q }).expect("positive"))
}

/// The sizes and weights of a packing: R, m, g.
pub struct Sizes {
    /// R.
    pub radius: BigRational,
    /// m.
    pub mass: BigRational,
    /// g.
    pub gravity: BigRational,
}

/// Sizes from the smallest to the largest floats and beyond.
pub fn sizes(u: &mut Unstructured<'_>) -> Result<Sizes> {
    Ok(Sizes {
        radius: number::quantity(u)?,
        mass: number::quantity(u)?,
        gravity: number::quantity(u)?,
    })
}

impl Sizes {
    /// The pile packed with these sizes.
    pub fn packing<'p>(
        self,
        pile: &'p Pile,
        spacing: &Spacing,
    ) -> core::result::Result<Packing<'p>, Error> {
        Packing::new(pile, spacing)?
            .with_radius(self.radius)?
            .with_mass(self.mass)?
            .with_gravity(self.gravity)
    }
}

/// Draws a straight pile of `layers` layers under one sphere: equilateral, isosceles or of discs.
pub fn regular_pile(u: &mut Unstructured<'_>, layers: i128) -> Result<Pile> {
    valid(match u.int_in_range(0..=3)? {
        0 => Pile::triangular(layers),
        1 => Pile::discs(layers),
        _ => Pile::isosceles(layers, number::sin_phi(u)?),
    })
}

/// Draws a site of the pile. The layer is the top, second, last but one or bottom layer, or any layer. Along i and j,
/// the site lies at an end, at a third of the length, or anywhere. The cost does not depend on the size of the layer.
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
    let (x, s) = (region.x(), region.s());
    let [first, last] = [
        *x.start().max(&(s.start() - j)),
        *x.end().min(&(s.end() - j)),
    ];
    let i = first + offset(u, last - first)?;
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
