//! Correctly rounded floats of sums of line forces, straight from the limbs.
//!
//! A force is an integer n over a denominator, times c·√r: in short n·v with v = c·√r/denominator. An exact evaluation
//! needs a long integer, a gcd and a root for each force. Here a screen, a floating-point filter, rounds almost all
//! forces:
//!
//! 1. v is enclosed once, in a double-double.
//! 2. The leading bits of n are read from its top limbs, and the remainder is bounded.
//! 3. The product of both enclosures is an interval. If its ends round to the same float, so does the exact value.
//!
//! Otherwise the exact [`Surd`] decides. This happens once in some hundreds of forces, or at a tie.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero};

use super::limbs::{LIMB, limbs};
use crate::Error;
use crate::each::Each;
use crate::error::bug;
use crate::scalar::{CorrectlyRounded, DoubleDouble, Surd, float_between};

/// The unit by which integers are multiplied before they are rounded: c·√r over a denominator.
#[derive(Clone, Debug)]
pub(crate) struct Unit {
    surd: Surd,
    denominator: BigInt,
    /// `None` for a unit of zero.
    factor: Option<Factor>,
}

/// A positive number value·2^exponent, with 1/8 ≤ value ≤ 1 and a relative error of at most 2^−104.
#[derive(Clone, Copy, Debug)]
struct Factor {
    value: DoubleDouble,
    exponent: i64,
    negative: bool,
}

/// The three results of a sphere as combinations of its line forces x: `n_k = Σ_m combination[k][m]·x_m + own[k]`, in
/// units.
#[derive(Clone, Debug)]
pub(crate) struct Readout {
    pub(crate) combination: [[i32; 3]; 3],
    pub(crate) own: [BigInt; 3],
}

impl Unit {
    /// Returns the unit c·√r over a positive denominator.
    pub(crate) fn new(surd: Surd, denominator: BigInt) -> Self {
        let factor = Factor::new(&surd, &denominator);
        Self {
            surd,
            denominator,
            factor,
        }
    }

    /// Returns n units, correctly rounded, or `None` if the result is not a float.
    pub(crate) fn nearest<F: CorrectlyRounded>(&self, n: &BigInt) -> Option<F> {
        const LEADING: u64 = 120;
        let below = n.bits().saturating_sub(LEADING);
        let decided = if below == 0 {
            n.to_i128().and_then(|n| self.decide(n, 0, 0.0))
        } else {
            // n is rounded down, and the bits shifted out amount to less than one unit of the leading part.
            let (leading, exponent) = ((n >> below).to_i128()?, i64::try_from(below).ok()?);
            self.decide(leading, exponent, 1.0)
        };
        decided.or_else(|| self.exactly(n))
    }

    /// Returns n units, correctly rounded, or `None` if the result is not a float.
    pub(crate) fn nearest_to<F: CorrectlyRounded>(&self, n: i128) -> Option<F> {
        let decided = self.decide(n, 0, 0.0);
        decided.or_else(|| self.exactly(&n.into()))
    }

    fn is_zero(&self) -> bool {
        self.surd.coefficient().is_zero()
    }

    /// Returns whether the absolute value of the unit certainly exceeds 2^e.
    pub(crate) fn exceeds_power_of_two(&self, e: i64) -> bool {
        // The value of a factor is at least 1/8.
        self.factor.is_some_and(|factor| factor.exponent - 3 > e)
    }

    fn exactly<F: CorrectlyRounded>(&self, n: &BigInt) -> Option<F> {
        if n.is_zero() || self.is_zero() {
            return Surd::zero().nearest();
        }
        let multiple = BigRational::new(n.clone(), self.denominator.clone());
        self.surd.scaled(&multiple).nearest()
    }

    /// Returns (n + δ)·2^exponent units, correctly rounded, if the result is the same float for all |δ| ≤ `remainder`.
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_possible_wrap,
        reason = "high rounds correctly, the slack covers the rounding of the remainder low, nothing wraps below 2^127"
    )]
    fn decide<F: CorrectlyRounded>(&self, n: i128, exponent: i64, remainder: f64) -> Option<F> {
        // With u = 2^−53, the errors of both sums and of the product are 3u² + 7u² + 2^−104, less than 2^−101.
        const SLACK: i64 = -98;
        let factor = self.factor?;
        let magnitude = n.unsigned_abs();
        let bits = i64::from(u128::BITS - magnitude.leading_zeros());
        if bits == 0 || bits > 126 {
            return None;
        }
        let (scale, high) = (power_of_two(-bits), magnitude as f64);
        let low = magnitude as i128 - (high as u128) as i128;
        let leading = DoubleDouble::new(high * scale) + DoubleDouble::new(low as f64 * scale);
        let product = leading * factor.value;
        // The value of a factor is at most 1.
        let slack = product.high() * power_of_two(SLACK) + remainder * scale;
        let ends = [product.low() - slack, product.low() + slack].each(|low| product.high() + low);
        let negative = (n < 0) != factor.negative;
        float_between(negative, ends, exponent + bits + factor.exponent)
    }
}

impl Factor {
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_possible_wrap,
        reason = "high rounds correctly, the remainder low rounds by at most 2^−107 of the root, 108 bits do not wrap"
    )]
    fn new(surd: &Surd, denominator: &BigInt) -> Option<Self> {
        // The root of 2^(2s)·(c²r/d²) has 106 to 108 bits. Rounded down, its relative error is below 2^−105.
        const BITS: i64 = 214;
        let coefficient = surd.coefficient();
        let (c, d) = (
            coefficient.numer().magnitude(),
            coefficient.denom() * denominator,
        );
        if c.is_zero() || !d.is_positive() {
            return None;
        }
        let (n, d) = (c * c * surd.radicand(), d.magnitude() * d.magnitude());
        let bits = |n: u64| i64::try_from(n).ok();
        let half = (BITS - (bits(n.bits())? - bits(d.bits())?)).div_euclid(2);
        let shift = u64::try_from(2 * half.abs()).ok()?;
        let quotient = if half >= 0 {
            (n << shift) / d
        } else {
            n / (d << shift)
        };
        let root = quotient.sqrt().to_u128()?;
        let (high, scale) = (root as f64, power_of_two(-108));
        let low = root as i128 - (high as u128) as i128;
        Some(Self {
            value: DoubleDouble::new(high * scale) + DoubleDouble::new(low as f64 * scale),
            exponent: 108 - half,
            negative: coefficient.is_negative(),
        })
    }
}

impl Readout {
    /// Writes the correctly rounded results of the spheres of a row. Returns whether every result is a float.
    ///
    /// `top_down` holds the limbs of their lines, by direction, the top limbs first.
    ///
    /// # Errors
    /// [`Error::Bug`] if an entry of `own` does not fit in the limbs.
    pub(crate) fn write<F: CorrectlyRounded>(
        &self,
        units: &[Unit; 3],
        top_down: &[[&[i64]; 3]],
        out: [&mut [F]; 3],
    ) -> Result<bool, Error> {
        let mut defined = true;
        let parts = out
            .into_iter()
            .zip(&self.combination)
            .zip(&self.own)
            .zip(units);
        for (((out, combination), own), unit) in parts {
            if let (true, Some(zero)) = (unit.is_zero(), unit.nearest_to(0)) {
                out.fill(zero);
                continue;
            }
            let own = limbs(own, top_down.len());
            let own = own.ok_or_else(|| bug("a weight is no wider than the forces"))?;
            let limb = |place: usize, p: usize| {
                let lines = top_down[top_down.len() - 1 - p];
                let carried = lines.into_iter().zip(combination);
                carried.fold(i128::from(own[p]), |sum, (line, factor)| {
                    sum + i128::from(line[place]) * i128::from(*factor)
                })
            };
            // A limb with deferred carries is below 2^8 units of the next limb.
            let remainder = combination.iter().fold(1.0, |remainder, factor| {
                remainder + 256.0 * f64::from(factor.unsigned_abs())
            });
            for (place, out) in out.iter_mut().enumerate() {
                match nearest_of(&limb, place, top_down.len(), remainder, unit) {
                    Some(float) => *out = float,
                    None => defined = false,
                }
            }
        }
        Ok(defined)
    }
}

/// Returns Σ limb(place, p)·2^(55p) units, correctly rounded. Reads as few limbs as it needs, from the top.
fn nearest_of<F: CorrectlyRounded>(
    limb: &impl Fn(usize, usize) -> i128,
    place: usize,
    planes: usize,
    remainder: f64,
    unit: &Unit,
) -> Option<F> {
    // A sum below 2^70 stays below 2^126 after a shift by the 55 bits of a limb and the addition of a limb below
    // 2^80: those of the floor are multiplied by up to 2^15.
    const ENOUGH: u128 = 1 << 70;
    let (mut leading, mut left) = (0_i128, planes);
    while left > 0 && leading.unsigned_abs() < ENOUGH {
        left -= 1;
        leading = (leading << LIMB) + limb(place, left);
    }
    let remainder = if left == 0 { 0.0 } else { remainder };
    let exponent = i64::try_from(left).ok()? * i64::from(LIMB);
    unit.decide(leading, exponent, remainder).or_else(|| {
        let whole = (0..planes)
            .rev()
            .fold(BigInt::zero(), |n, p| (n << LIMB) + limb(place, p));
        unit.exactly(&whole)
    })
}

/// Returns 2^e, for −1022 ≤ e ≤ 0.
fn power_of_two(e: i64) -> f64 {
    f64::from_bits(((1023 + e).cast_unsigned()) << 52)
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;
    use crate::Pile;
    use crate::engine::LineForces;
    use crate::engine::rows::exact_sweep;
    use crate::formula::tripled_half_turn;
    use crate::lattice::Region;

    fn units(denominator: &BigInt) -> [Unit; 3] {
        let surd = |c: (i32, i32), r: (i32, i32)| {
            let [c, r] = [c, r].map(|(n, d)| BigRational::new(n.into(), d.into()));
            Unit::new(Surd::new(c, r).unwrap(), denominator.clone())
        };
        [
            surd((1, 1), (1, 1)),
            surd((-7, 3), (8, 17)),
            surd((1, 1_000_003), (2, 1)),
        ]
    }

    fn slowly<F: CorrectlyRounded>(unit: &Unit, n: &BigInt) -> Option<F> {
        let multiple = BigRational::new(n.clone(), unit.denominator.clone());
        unit.surd.scaled(&multiple).nearest()
    }

    /// Compares the floats from limbs with those from exact numbers, on all lines below the top layer, before and after
    /// a half-turn.
    fn compare<F: CorrectlyRounded + PartialEq + core::fmt::Debug>(pile: &Pile) {
        let last = pile.layers() - 1;
        let lines = LineForces::<BigRational>::new(pile);
        let mut sweep = exact_sweep(&lines, last).unwrap();
        for k in 1..=last {
            sweep.advance(k, crate::engine::Meter::NONE).unwrap();
            let changes = sweep.turned_already();
            for combination in [
                [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
                [[-1, 2, 2], [2, -1, 2], [2, 2, -1]],
            ] {
                let readout = Readout {
                    combination,
                    own: lines.increments_after(changes),
                };
                let units = units(&lines.scale(changes));
                for row in pile.shape().layer(k).unwrap().rows(k) {
                    let zero = slowly::<F>(&units[0], &BigInt::zero()).unwrap();
                    let n = usize::try_from(row.i.end - row.i.start).unwrap();
                    let mut out = [(); 3].map(|()| alloc::vec![zero; n]);
                    let [a, b, c] = out.each_mut().map(Vec::as_mut_slice);
                    assert!(
                        sweep
                            .nearest_row(&row, (&readout, &units), [a, b, c])
                            .unwrap()
                    );
                    for (place, site) in row.into_iter().enumerate() {
                        let mut exact = sweep.received(site).unwrap().forces;
                        if combination[0][0] < 0 {
                            exact = tripled_half_turn(&exact);
                        }
                        for (line, (exact, own)) in exact.iter().zip(&readout.own).enumerate() {
                            let exact = slowly(&units[line], &(exact + own));
                            assert_eq!(Some(out[line][place]), exact, "{site}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn floats_from_limbs_are_correctly_rounded() {
        let mixed = "+-++---+".repeat(4);
        for (top, stacking) in [
            (Region::SITE, "+-".repeat(22).as_str()),
            (Region::hexagon(2, 3).unwrap(), mixed.as_str()),
        ] {
            let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
            compare::<f64>(&pile);
            compare::<f32>(&pile);
        }
    }

    /// Returns `n` units as a float, rounded by [`Readout::write`] from the limbs of `n`.
    fn read<F: CorrectlyRounded>(unit: &Unit, n: &BigInt) -> Option<F> {
        let limbs = limbs(n, 26).unwrap();
        let top_down: Vec<[&[i64]; 3]> = limbs
            .iter()
            .rev()
            .map(|limb| [core::slice::from_ref(limb); 3])
            .collect();
        let readout = Readout {
            combination: [[1, 0, 0]; 3],
            own: [(); 3].map(|()| BigInt::zero()),
        };
        let units = [unit.clone(), unit.clone(), unit.clone()];
        let zero = slowly::<F>(unit, &BigInt::zero()).unwrap();
        let mut out = [[zero]; 3];
        let [a, b, c] = &mut out;
        let defined = readout.write(&units, &top_down, [a, b, c]).unwrap();
        defined.then(|| out[0][0])
    }

    /// Tests ties and their neighbours, which no enclosure decides, and the ends of the range of floats.
    #[test]
    fn the_exact_number_decides_where_the_screen_cannot() {
        let mut met = 0;
        for unit in units(&BigInt::from(1)) {
            for power in (0..1100).step_by(21) {
                for tie in [53, 24, 110] {
                    for off in [-1_i32, 0, 1] {
                        let n: BigInt = (((BigInt::from(1) << tie) + 1_i32) << power) + off;
                        for n in [n.clone(), -n] {
                            assert_eq!(read::<f64>(&unit, &n), slowly(&unit, &n), "{n}");
                            assert_eq!(read::<f32>(&unit, &n), slowly(&unit, &n), "{n}");
                            assert_eq!(unit.nearest::<f64>(&n), slowly(&unit, &n), "{n}");
                            assert_eq!(unit.nearest::<f32>(&n), slowly(&unit, &n), "{n}");
                            met += 1;
                        }
                    }
                }
            }
        }
        assert!(met > 2500);
    }

    /// Five lower limbs as large as an `i64` leave a remainder of nearly 5·2^8 units of the limb above. So the leading
    /// limbs may be below a tie while the number is above it.
    #[test]
    fn deferred_carries_are_bounded_in_full() {
        // This is nearly 2^7.5. For integers the largest factor is 1/√2, and here the factor is close to it.
        let great = BigRational::from(BigInt::from(181));
        let unit = Unit::new(great.into(), 1.into());
        let units = [(); 3].map(|()| unit.clone());
        let readout = Readout {
            combination: [[-1, 2, 2]; 3],
            own: [(); 3].map(|()| BigInt::zero()),
        };
        // 181·odd is an odd number of 54 bits, so it is a tie. The numbers n have 76 and 113 bits: there the error of
        // the product is as large as the remainder.
        let odd = ((1_i128 << 53) / 181 + 1) | 1;
        let ties = [odd << 30, odd << 67].into_iter();
        let below = |tie| (0..1_320).step_by(15).map(move |below| (tie, below));
        let cases = ties.flat_map(below);
        for ((tie, below), sign) in cases.flat_map(|case| [(case, 1), (case, -1)]) {
            // The upper limbs are those of β, which counts twice. The lower limbs of the three lines add up to five
            // times `i64::MAX`.
            let upper = limbs(&((tie - below) / 2 * i128::from(sign)).into(), 2).unwrap();
            let least = [-sign, sign, sign].map(|sign| sign * i64::MAX);
            let top_down = [[0, upper[1], 0], [0, upper[0], 0], least];
            let n = top_down.iter().fold(BigInt::zero(), |n, [a, b, c]| {
                (n << LIMB) + 2 * (i128::from(*b) + i128::from(*c)) - i128::from(*a)
            });
            let top_down = top_down
                .each_ref()
                .map(|limbs| limbs.each_ref().map(core::slice::from_ref));
            let mut out = [[0.0_f64]; 3];
            let [a, b, c] = &mut out;
            assert_eq!(readout.write(&units, &top_down, [a, b, c]), Ok(true));
            assert_eq!(Some(out[0][0]), slowly(&unit, &n), "{below} {sign}");
        }
    }

    /// Two adjacent integers lie on either side of a tie. The leading limbs alone cannot distinguish them from it.
    #[test]
    fn all_limbs_are_read_next_to_a_tie() {
        let mut met = 0;
        let units = units(&BigInt::from(1));
        for (unit, square) in units.iter().skip(1).zip([
            // The values of c²r: (7/3)²·8/17 and 2/1,000,003².
            (BigInt::from(392), BigInt::from(153)),
            (2.into(), BigInt::from(1_000_003_i64).pow(2)),
        ]) {
            for (odd, power) in (1_i64..40).zip((130..).step_by(3)) {
                // Halfway between two floats, divided by the unit and rounded down: n² ≤ tie²/(c²r).
                let tie = BigInt::from((1_i64 << 53) + 2 * odd - 1) << power;
                let squared: BigInt = &tie * &tie * &square.1;
                let below: BigInt = (squared / &square.0).sqrt();
                let above: BigInt = &below + 1_i32;
                for n in [below.clone(), above.clone(), -below, -above] {
                    assert_eq!(read::<f64>(unit, &n), slowly(unit, &n), "{n}");
                    met += 1;
                }
            }
        }
        assert_eq!(met, 312);
    }

    /// Tests ties of one limb and of several, zero with a negative unit, and the ends of the range of `i128`.
    #[test]
    fn ties_zeros_and_ends_agree_with_the_exact_number() {
        let units = units(&BigInt::from(1));
        for power in [0, 30, 80, 170] {
            let tie = ((BigInt::from(1) << 53) + 1) << power;
            let even = read::<f64>(&units[0], &(BigInt::from(1) << (53 + power)));
            assert_eq!(read::<f64>(&units[0], &tie), even, "{power}");
        }
        for unit in &units {
            for n in [0, 1, i128::MIN, i128::MAX, 1 << 126, -(1 << 125)] {
                let exact = slowly::<f64>(unit, &n.into()).unwrap();
                let near = unit.nearest_to::<f64>(n).unwrap();
                assert_eq!(near.to_bits(), exact.to_bits(), "{n}");
            }
        }
    }

    /// Far below all `f32`, both ends of a wide enclosure would round to zero, one of them to −0.
    #[test]
    fn numbers_that_underflow_keep_their_sign() {
        let two = |power: u32| BigInt::from(1) << power;
        let of = |radicand: i32, below: u32| {
            let unit = BigRational::new(1.into(), two(below));
            let radicand = BigRational::from(BigInt::from(radicand));
            Unit::new(Surd::new(unit, radicand).unwrap(), 1.into())
        };
        for unit in [of(1, 300), of(2, 300), of(1, 600), of(1, 900)] {
            let numbers = [
                1.into(),
                3.into(),
                1000.into(),
                two(80) * 5,
                two(130) + 12_345,
            ];
            for n in numbers.into_iter().flat_map(|n: BigInt| [n.clone(), -n]) {
                let bits = |float: Option<f32>| float.map(f32::to_bits);
                let exact = bits(slowly(&unit, &n));
                assert_eq!(bits(unit.nearest(&n)), exact, "{n}");
                assert_eq!(bits(read(&unit, &n)), exact, "{n}");
                if let Some(n) = n.to_i128() {
                    assert_eq!(bits(unit.nearest_to(n)), exact, "{n}");
                }
            }
        }
    }

    /// Each number lies below a tie of `f32`, by less than the remainder. The leading limbs alone lie above the tie.
    #[test]
    fn numbers_just_below_a_tie_are_rounded_down() {
        let surd = |c: (i32, i32), r: (i32, i32)| {
            let [c, r] = [c, r].map(|(n, d)| BigRational::new(n.into(), d.into()));
            Unit::new(Surd::new(c, r).unwrap(), 1.into())
        };
        for (unit, n) in [
            (
                surd((1, 1), (2, 1)),
                45_601_931_423_913_725_800_096_899_848_680_243_200_i128,
            ),
            (
                surd((7, 3), (8, 17)),
                155_527_338_452_583_889_240_714_752_029_982_982_144,
            ),
        ] {
            for n in [n.into(), BigInt::from(-n)] {
                assert_eq!(read::<f32>(&unit, &n), slowly(&unit, &n), "{n}");
            }
        }
    }

    #[test]
    fn a_unit_exceeds_no_power_of_two_that_is_as_great() {
        for power in [-40, -1, 0, 1, 40_i64] {
            let two = BigInt::from(1) << power.unsigned_abs();
            let two = if power < 0 {
                BigRational::new(1.into(), two)
            } else {
                two.into()
            };
            let unit = Unit::new(
                Surd::new(two, BigRational::from(BigInt::from(1))).unwrap(),
                1.into(),
            );
            assert!(!unit.exceeds_power_of_two(power));
            assert!(unit.exceeds_power_of_two(power - 3));
        }
    }
}
