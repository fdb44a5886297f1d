//! A spacing is allowed exactly if no two spheres of the pile overlap.
//!
//! The library examines a few pairs only and proves that they suffice. This claim examines every short difference, in
//! integers over one denominator, by the coordinates of the centres. It examines random long differences by the library's
//! quadratic form.

use core::cmp::Ordering;

use arbitrary::Unstructured;
use cannonpile::geometry::{LayerGap, Spacing, squared_distance};
use cannonpile::lattice::Dimension;
use cannonpile::{Error, Pile};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use super::{Checked, demand, one_line, packing, same};
use crate::generators::number::ratio;
use crate::generators::pile::{self, occurs};

/// Compares the verdict on a spacing with every short difference and a few long ones.
pub fn of_a_spacing(u: &mut Unstructured<'_>) -> Checked {
    // Each of the first few layers adds new pairs.
    let few = u.arbitrary()?;
    let pile = if few {
        pile::small_pile(u)?
    } else {
        pile::pile(u)?
    };
    let clearance = pile.clearance();
    let spacing = pile::spacing(u, &clearance)?;
    let verdict = clearance.check(&spacing);
    agrees(&verdict, &pile, &spacing)?;
    if let Err(refusal) = verdict {
        return one_line(&refusal);
    }
    for _ in 0..4 {
        let n = pile::difference(u, &pile)?;
        let apart = n == [0; 3] || form(n, &pile, &spacing) >= BigRational::one();
        demand(apart, || {
            format!("spheres {n:?} apart overlap at {spacing} in {pile:?}")
        })?;
    }
    Ok(())
}

/// The distance of two spheres of a packing follows the quadratic form of their difference.
pub fn of_two_spheres(u: &mut Unstructured<'_>) -> Checked {
    let pile = pile::packable_pile(u)?;
    let spacing = pile::allowed_spacing(u, &pile)?;
    let packing = pile::sizes(u)?.packing(&pile, &spacing)?;
    let sites = [pile::site(u, &pile)?, pile::site(u, &pile)?];
    let [from, to] = sites.map(|site| [site.k - site.i - site.j, site.i, site.j]);
    let n = core::array::from_fn(|m| to[m] - from[m]);
    let [from, to] = [packing.position(sites[0])?, packing.position(sites[1])?];
    let diameter = packing.radius() * ratio(2, 1);
    let want = form(n, &pile, &spacing) * &diameter * &diameter;
    let got = packing::squared_distance(&from, &to);
    same("the squared distance", &got, &Some(want))
}

/// A verdict agrees with all short differences. A rejection names a pair that overlaps. An accepted spacing lists exactly
/// the pairs that touch.
fn agrees(verdict: &Result<Vec<LayerGap>, Error>, pile: &Pile, spacing: &Spacing) -> Checked {
    let distances = Distances::new(pile, spacing);
    let mut overlapping = Vec::new();
    let mut touching = Vec::new();
    for n in short_differences(pile) {
        // A difference of one contact joins a sphere to a support.
        let layers = n.iter().sum::<i128>().unsigned_abs();
        let is_contact = layers == 1 && n.iter().filter(|c| **c != 0).count() == 1;
        let apart = LayerGap {
            layers: u8::try_from(layers).expect("a short difference"),
        };
        match distances.to_diameter(n) {
            Ordering::Less => overlapping.push(apart),
            Ordering::Equal if !is_contact => touching.push(apart),
            _ => {}
        }
    }
    touching.sort_unstable();
    touching.dedup();
    let flat = sin2(pile, spacing) >= BigRational::one();
    let holds = match verdict {
        Ok(named) => overlapping.is_empty() && *named == touching && !flat,
        Err(Error::Overlap { apart, .. }) => overlapping.contains(apart) || flat,
        Err(Error::NoSpacing { .. }) => !overlapping.is_empty() || flat,
        Err(Error::TooFlat { .. }) => flat,
        Err(_) => false,
    };
    demand(holds, || {
        format!(
            "{verdict:?}, but {overlapping:?} overlap and {touching:?} touch at {spacing} in {pile:?}"
        )
    })
}

/// Squared distances from coordinates, x² + y² + z², each square in integers over one denominator.
///
/// From (1) of the paper, with s = p/r: x = ((n_a+n_b) s − n_c) sinθ, y = (n_a−n_b) cosφ sinθ, z = (n_a+n_b+n_c) cosθ.
struct Distances {
    p: BigInt,
    r: BigInt,
    /// The factors of (r x)², (n_a−n_b)² and (n_a+n_b+n_c)², over the denominator.
    x2: BigInt,
    y2: BigInt,
    z2: BigInt,
    denominator: BigInt,
}

impl Distances {
    fn new(pile: &Pile, spacing: &Spacing) -> Self {
        // Discs lie along y: s = 0.
        let (p, r) = pile.sin_phi().clone().into_raw();
        let (sin2, one) = sin2(pile, spacing).into_raw();
        let r2 = &r * &r;
        Self {
            x2: sin2.clone(),
            y2: &sin2 * (&r2 - &p * &p),
            z2: (&one - sin2) * &r2,
            denominator: one * r2,
            p,
            r,
        }
    }

    /// Compares the distance of two spheres, n apart, with 2R.
    fn to_diameter(&self, [a, b, c]: [i128; 3]) -> Ordering {
        let square = |x: BigInt| &x * &x;
        let x = &self.p * (a + b) - &self.r * c;
        let sum = square(x) * &self.x2
            + square((a - b).into()) * &self.y2
            + square((a + b + c).into()) * &self.z2;
        sum.cmp(&self.denominator)
    }
}

/// The differences of up to three steps along each line that occur in the pile.
fn short_differences(pile: &Pile) -> impl Iterator<Item = [i128; 3]> {
    let layers = pile.layers();
    let gamma = match pile.dimension() {
        Dimension::Two => 0..=0,
        Dimension::Three => -3..=3,
    };
    let all = (-3..=3).flat_map(move |a| {
        let gamma = gamma.clone();
        (-3..=3).flat_map(move |b| gamma.clone().map(move |c| [a, b, c]))
    });
    // Only one of n and −n, and never zero.
    all.filter(move |n| *n > [0; 3] && occurs(*n, layers))
}

/// The squared distance over 4R², by the library.
fn form(n: [i128; 3], pile: &Pile, spacing: &Spacing) -> BigRational {
    let n = n.map(|c| BigRational::from_integer(c.into()));
    squared_distance(&n, pile.sin_phi(), &sin2(pile, spacing))
}

/// sin²θ. It is 1 or more if a sphere falls between its supports.
fn sin2(pile: &Pile, spacing: &Spacing) -> BigRational {
    let per_square = match pile.dimension() {
        Dimension::Two => ratio(4, 1),
        Dimension::Three => ratio(3, 1),
    };
    spacing.square() / per_square
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::power;

    /// Checks the verdict on one spacing as if it belonged to another.
    fn judged(verdict_at: &BigRational, spacing_at: &BigRational) -> bool {
        let pile = Pile::triangular(1 << 60).unwrap();
        let [checked, judged] =
            [verdict_at, spacing_at].map(|square| Spacing::from_square(square.clone()).unwrap());
        agrees(&pile.clearance().check(&checked), &pile, &judged).is_ok()
    }

    #[test]
    fn a_verdict_on_another_spacing_is_caught() {
        let trace = power(10, -50);
        for bound in [ratio(1, 1), ratio(8, 3)] {
            let (below, above) = (&bound - &trace, &bound + &trace);
            for checked in [&below, &bound, &above] {
                for spacing in [&below, &bound, &above] {
                    assert_eq!(
                        judged(checked, spacing),
                        checked == spacing,
                        "{checked} {spacing}"
                    );
                }
            }
        }
    }

    #[test]
    fn a_missing_contact_is_caught() {
        let pile = Pile::triangular(4).unwrap();
        let spacing = Spacing::from_square(ratio(8, 3)).unwrap();
        let three_layers = LayerGap { layers: 3 };
        assert!(agrees(&Ok(vec![three_layers]), &pile, &spacing).is_ok());
        assert!(agrees(&Ok(vec![]), &pile, &spacing).is_err());
        assert!(agrees(&Ok(vec![LayerGap { layers: 2 }]), &pile, &spacing).is_err());
    }

    #[test]
    fn a_wrong_reason_is_caught() {
        let pile = Pile::triangular(4).unwrap();
        let spacing = Spacing::new(ratio(1, 2)).unwrap();
        let refusal = pile.clearance().check(&spacing);
        assert!(agrees(&refusal, &pile, &spacing).is_ok());
        let wide = Spacing::new(ratio(6, 5)).unwrap();
        assert!(agrees(&refusal, &pile, &wide).is_err());
        assert!(agrees(&Err(Error::Interrupted), &pile, &spacing).is_err());
    }
}
