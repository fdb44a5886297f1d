//! Piles of every kind, with their spacings, sizes and weights.

#[cfg(feature = "horizontal")]
use std::sync::OnceLock;

use cannonpile::geometry::Spacing;
use cannonpile::lattice::Sign;
use cannonpile::lattice::{Dimension, Direction, Region, Site};
use cannonpile::scalar::{CorrectlyRounded, Surd};
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Packing, Pile};
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::numbers::towards;
use super::random::{Random, power};
use crate::judge::{exact, midpoint};

/// A straight pile of any height, of discs or of spheres on any base triangle; or a pile of any stacking with loads and
/// weights.
pub fn any(random: &mut Random) -> Pile {
    let pile = match random.within(0..8) {
        0 => Pile::discs(layers(random)),
        1 | 2 => Pile::isosceles(layers(random), sin_phi(random)),
        3 | 4 => return loaded(random),
        _ => Pile::triangular(layers(random)),
    };
    pile.expect("layers and sin phi within their limits")
}

/// A straight pile of spheres, small enough to write down.
pub fn small(random: &mut Random) -> Pile {
    let layers = i128::from(random.within(2..40));
    let s = random.of(&[(1, 2), (1, 2), (2, 5), (5, 6)]);
    Pile::isosceles(layers, ratio(s)).expect("a pile")
}

fn layers(random: &mut Random) -> i128 {
    let few = i128::from(random.within(2..40));
    let float = (1 << 53) + i128::from(random.within(-1..2));
    random.of(&[few, few, few, 1000, float, 10_i128.pow(18), 10_i128.pow(30)])
}

/// A value of sin φ up to 5/6. Beyond 5/6 tall piles have no possible spacing.
fn sin_phi(random: &mut Random) -> BigRational {
    let any = (random.within(1..83), 100);
    ratio(random.of(&[(1, 2), (2, 5), (5, 6), (1, 1_000_000), any, any]))
}

/// An elastic state of up to eight layers with compressive horizontal contacts.
#[cfg(feature = "horizontal")]
pub fn elastic(random: &mut Random) -> Pile {
    static STATES: OnceLock<Vec<Pile>> = OnceLock::new();
    let states = STATES.get_or_init(|| {
        // All of these are stable, and each has compressive horizontal contacts.
        let stackings = ["+-+-+", "+++-++", "+-+-++", "+--+--", "++-+---"];
        let ratios = [(1, 1), (2, 7), (100, 3)].map(ratio);
        let states = stackings.into_iter().flat_map(|stacking| {
            let stacking = stacking.parse().expect("signs");
            let pile = Pile::under(Region::SITE, stacking).expect("a pile");
            let state = |ratio| {
                cannonpile_horizontal::elastic(&pile, ratio)
                    .expect("a state")
                    .pile()
                    .clone()
            };
            ratios.each_ref().map(state)
        });
        states.collect()
    });
    assert!(states.iter().all(|pile| pile.horizontal_forces().len() > 0));
    let states: Vec<&Pile> = states.iter().collect();
    random.of(&states).clone()
}

/// A pile of up to twelve layers of any stacking, with a few weights and loads.
pub fn loaded(random: &mut Random) -> Pile {
    let [p, q] = [random.within(1..4), random.within(1..4)].map(i128::from);
    let region = random.of(&[
        Region::SITE,
        Region::SITE,
        hexagon(p, q),
        hexagon(p + 3, q + 3),
    ]);
    let signs = signs(random, 11);
    let grown = if region == hexagon(p + 3, q + 3) {
        // The full height of the base, or a lower pile.
        Pile::on(region, signs).or_else(|_| Pile::on(region, Stacking::hcp(3)?))
    } else {
        Pile::under(region, signs)
    };
    let mut pile = grown.expect("a few layers");
    for _ in 0..random.within(0..4) {
        let k = random.below(pile.layers());
        let (load, weight) = (site_of(&pile, k, random), site_of(&pile, k, random));
        pile = pile.with_load(load, burden(random)).expect("a load");
        pile = pile.with_weight(weight, burden(random)).expect("a weight");
    }
    pile
}

fn hexagon(p: i128, q: i128) -> Region {
    Region::hexagon(p, q).expect("sides of one sphere or more")
}

/// HCP, or up to `most` random steps.
fn signs(random: &mut Random, most: i64) -> Stacking {
    let steps = random.within(1..most + 1);
    if random.once_in(4) {
        return Stacking::hcp(i128::from(steps + 1)).expect("a few layers");
    }
    let signs = (0..steps).map(|_| random.of(&[Sign::Plus, Sign::Minus]));
    Stacking::from_signs(signs).expect("a few layers")
}

/// A weight in mg: simple, with many digits, or 10^±30.
fn burden(random: &mut Random) -> BigRational {
    match random.within(0..4) {
        0 => random.ratio(128),
        1 => decimal(30 * random.of(&[-1, 1])),
        _ => BigRational::new(random.within(0..100).into(), random.within(1..100).into()),
    }
}

/// A site of layer k: a corner, or any other.
pub fn site_of(pile: &Pile, k: i128, random: &mut Random) -> Site {
    let layer = pile.shape().layer(k).expect("a layer of the pile");
    if random.once_in(4) {
        let [i, j] = random.of(&layer.corners());
        return Site { i, j, k };
    }
    let (y, x, s) = (layer.y(), layer.x(), layer.s());
    let j = y.start() + random.below(y.end() - y.start() + 1);
    let (low, high) = (
        *x.start().max(&(s.start() - j)),
        *x.end().min(&(s.end() - j)),
    );
    // Bounds are tight, so every row has a sphere.
    let i = low + random.below(high - low + 1);
    Site { i, j, k }
}

/// A direction of the pile's contacts.
pub fn direction(pile: &Pile, random: &mut Random) -> Direction {
    random.of(pile.dimension().directions())
}

/// A spacing: at a bound, at a neighbouring float, between the bounds, or such that cosθ is close to a midpoint of two
/// floats.
pub fn spacing(pile: &Pile, random: &mut Random) -> Spacing {
    let clearance = pile.clearance();
    let flat = match pile.dimension() {
        Dimension::Two => ratio((4, 1)),
        Dimension::Three => ratio((3, 1)),
    };
    let bound = |bound: Option<Spacing>| bound.map(|spacing| spacing.square().clone());
    let low = bound(clearance.least()).unwrap_or_else(BigRational::zero);
    let high = bound(clearance.most()).unwrap_or_else(|| flat.clone());
    let part = ratio((random.within(1..64), 64));
    let between = &low + (&high - &low) * part;
    let q = match random.within(0..10) {
        0 => low,
        1 => high,
        2 => {
            let near = f64::nearest_to_rational(&low).map_or(1.0, f64::next_up);
            exact(near)
        }
        3 => {
            let cos2 = BigRational::one() - &between / &flat;
            let cos = surd(cos2).nearest::<f64>().unwrap_or(0.5);
            let middle = midpoint(&exact(cos), &exact(cos.next_up()));
            let nearly = &middle * &middle + random.tiny() * ratio((random.of(&[1, -1]), 1));
            (BigRational::one() - nearly) * flat
        }
        _ => between.clone(),
    };
    let spacing = |q| {
        Spacing::from_square(q)
            .ok()
            .filter(|spacing| clearance.check(spacing).is_ok())
    };
    let between = spacing(between);
    spacing(q)
        .or(between)
        .expect("a spacing between the bounds")
}

/// The base unit of a quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// The radius.
    Length,
    /// The weight of a sphere.
    Force,
}

/// The packing with other sizes and weights. If `target` is given, they move this quantity (at R = m = g = 1) to a critical
/// value.
pub fn resized<'p>(
    packing: Packing<'p>,
    measure: Measure,
    target: Option<&Surd>,
    random: &mut Random,
) -> Result<Packing<'p>, Error> {
    let target = target.filter(|_| !random.once_in(3)).map(|target| {
        let place = if random.once_in(3) {
            random.critical::<f32>()
        } else {
            random.critical::<f64>()
        };
        towards(target, &place, random)
    });
    // A size cannot be zero.
    let target = target.filter(|factor| !factor.is_zero());
    let (radius, mass, gravity) = match (measure, target) {
        (Measure::Length, Some(factor)) => (factor, BigRational::one(), BigRational::one()),
        (Measure::Force, Some(factor)) => (BigRational::one(), factor, BigRational::one()),
        (_, None) => (size(random), size(random), size(random)),
    };
    packing
        .with_radius(radius)?
        .with_mass(mass)?
        .with_gravity(gravity)
}

/// A radius, mass or gravity: a short decimal, 10^±300, a float, the least float, or a fraction with many digits.
fn size(random: &mut Random) -> BigRational {
    match random.within(0..32) {
        0 => decimal(300 * random.of(&[-1, 1])),
        1 => power(-1074),
        2 => random.critical::<f64>() + power(-1100),
        3..=6 => random.ratio(64),
        _ => ratio((random.within(1..10_000), random.of(&[1, 100, 1000]))),
    }
}

/// 10^exponent.
fn decimal(exponent: i32) -> BigRational {
    num_traits::Pow::pow(ratio((10, 1)), exponent)
}

fn ratio((n, d): (i64, i64)) -> BigRational {
    BigRational::new(n.into(), d.into())
}

fn surd(square: BigRational) -> Surd {
    Surd::sqrt(square).expect("not negative")
}
