//! Brute force in integers, layer by layer. It is faster than the oracle `balance`, and tests compare the two.
//!
//! After d sign changes, forces are integers over 3^d times the common denominator D of weights and loads. An ordinary
//! sphere then weighs D. The computation goes site by site and uses nothing of the library.

use std::collections::BTreeMap;
use std::ops::{Add, Mul, Sub};

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, pow};

use crate::oracles::balance::{Balance, Place, Sites};

/// Integers of sufficient width. The caller chooses it, and `i128` panics on overflow.
pub trait Wide: Clone + Ord + From<i32> + Signed
where
    for<'a> Self: Add<&'a Self, Output = Self>,
    for<'a> Self: Sub<&'a Self, Output = Self>,
    for<'a> Self: Mul<&'a Self, Output = Self>,
{
}

impl Wide for i128 {}
impl Wide for BigInt {}

/// The incoming or the transmitted forces of the spheres of a layer, by site (j, i).
type Triples<I> = BTreeMap<(i128, i128), [I; 3]>;

/// One layer during the computation.
#[derive(Clone, Debug)]
pub struct Front<I> {
    /// The layer.
    pub k: i128,
    sign: Option<char>,
    /// The number of sign changes above the layer.
    pub changes: usize,
    /// The forces from above on its spheres.
    pub from_above: Triples<I>,
}

/// The forces that a layer transmits, and the greatest intermediate value.
pub struct LayerForces<I> {
    /// Numerators over 3^changes of the layer below.
    pub forces: Triples<I>,
    /// The greatest intermediate value.
    pub greatest: I,
    /// The layer below.
    pub below: Front<I>,
}

impl<I: Wide> Front<I>
where
    for<'a> I: Add<&'a I, Output = I> + Sub<&'a I, Output = I> + Mul<&'a I, Output = I>,
{
    /// The top layer, without forces from above.
    pub fn top(top: &Sites) -> Self {
        let nothing = || [0, 0, 0].map(I::from);
        Self {
            k: 0,
            sign: None,
            changes: 0,
            from_above: top.iter().map(|site| (*site, nothing())).collect(),
        }
    }

    /// Goes one layer down. `weight` returns the weight of a sphere times D.
    pub fn step(&self, sign: char, weight: impl Fn(Place) -> I) -> LayerForces<I> {
        let turns = self.sign.is_some_and(|above| above != sign);
        let changes = self.changes + usize::from(turns);
        let unit = pow(I::from(3), changes);
        let (one, three) = (I::one(), I::from(3));
        let mut greatest = I::zero();
        let mut forces = Triples::new();
        let mut from_above = Triples::new();
        let supports = if sign == '+' {
            [(0, 0), (0, 1), (1, 0)]
        } else {
            [(0, 0), (0, -1), (-1, 0)]
        };
        for (&(j, i), above) in &self.from_above {
            let own = weight((self.k, j, i)) * &unit;
            let [a, b, c] = above;
            let twice_sum = (a.clone() + b + c) * &I::from(2);
            let passed = [0, 1, 2].map(|m| {
                let turned = if turns {
                    // The intermediate values of 2Σg − 3g.
                    greatest = greatest.clone().max(twice_sum.abs());
                    twice_sum.clone() - &(above[m].clone() * &three)
                } else {
                    above[m].clone() * &one
                };
                greatest = greatest.clone().max(turned.abs());
                turned + &own
            });
            for ((dj, di), force) in supports.into_iter().zip(&passed) {
                let below = from_above.entry((j + dj, i + di));
                let m = supports.iter().position(|step| *step == (dj, di));
                let lines: &mut [I; 3] = below.or_insert_with(|| [0, 0, 0].map(I::from));
                lines[m.expect("one of three")] = force.clone();
                greatest = greatest.clone().max(force.abs());
            }
            forces.insert((j, i), passed);
        }
        let below = Self {
            k: self.k + 1,
            sign: Some(sign),
            changes,
            from_above,
        };
        LayerForces {
            forces,
            greatest,
            below,
        }
    }
}

impl<I: Wide> LayerForces<I>
where
    for<'a> I: Add<&'a I, Output = I> + Sub<&'a I, Output = I> + Mul<&'a I, Output = I>,
{
    /// Tells whether some contact is tensile.
    pub fn pulls(&self) -> bool {
        self.forces.values().flatten().any(Signed::is_negative)
    }
}

/// The common denominator of weights and loads.
pub fn denominator(balance: &Balance) -> BigInt {
    let denominators = balance.weights.values().map(BigRational::denom);
    denominators.fold(BigInt::one(), |d, denom| d.lcm(denom))
}

/// The weight of a sphere times D.
pub fn numerator<'n>(balance: &'n Balance, d: &'n BigInt) -> impl Fn(Place) -> BigInt + 'n {
    move |at| {
        let weight = balance.weight(at);
        weight.numer() * (d / weight.denom())
    }
}

/// All layers of a pile that was grown from its top.
pub fn all(balance: &Balance) -> Vec<LayerForces<BigInt>> {
    let d = denominator(balance);
    let weight = numerator(balance, &d);
    let mut front = Front::top(&balance.layers[0]);
    let steps = balance.signs.chars().map(|sign| {
        let passed = front.step(sign, &weight);
        front = passed.below.clone();
        passed
    });
    steps.collect()
}

#[cfg(test)]
mod tests {
    use num_traits::Zero;

    use super::*;
    use crate::cases::{Bounds, Case, Random, all_signs};

    #[test]
    fn agrees_with_balance_up_to_8_layers() {
        for signs in (1..8).flat_map(all_signs) {
            let balance = Balance::under(&Bounds::SITE.sites(), &signs);
            agrees_with_balance(&balance);
            let forces = balance.forces();
            let mut front: Front<i128> = Front::top(&balance.layers[0]);
            let failures = (0..).zip(signs.chars()).filter_map(|(k, sign)| {
                let passed = front.step(sign, |_| 1);
                front = passed.below.clone();
                passed.pulls().then_some(k)
            });
            assert_eq!(failures.min(), forces.first_failure());
        }
    }

    #[test]
    fn agrees_with_balance_under_random_tops_with_loads() {
        let mut random = Random(61);
        for _ in 0..40 {
            let signs = random.signs(7);
            let case = Case::under(&random.bounds(3), &signs).with_random_loads(4, &mut random);
            agrees_with_balance(&case.balance);
        }
    }

    fn agrees_with_balance(balance: &Balance) {
        let (forces, d) = (balance.forces(), denominator(balance));
        for (k, passed) in (0..).zip(all(balance)) {
            let over = &d * pow(BigInt::from(3), passed.below.changes);
            for ((j, i), numerators) in passed.forces {
                let rationals = numerators.map(|n| BigRational::new(n, over.clone()));
                assert_eq!(rationals, forces.below[&(k, j, i)]);
            }
        }
        let nothing: BigInt = Zero::zero();
        assert!(d > nothing);
    }
}
