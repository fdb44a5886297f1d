//! The errors of double-doubles are below 2^−100 of the result, compared with rationals for operands of every size.

use core::cmp::Ordering;

use cannonpile::scalar::{Algebra, DoubleDouble, Ring};
use cannonpile_testkit::real::Bounded;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Signed, ToPrimitive, Zero};

/// The number of operand pairs for each operation.
const PAIRS: u32 = 25_000;

/// Random bits that are the same in every run (xorshift).
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[usize::try_from(self.bits() >> 40).expect("24 bits") % choices.len()]
    }

    /// ±2^exponent · (1 + m). Sometimes it is a power of two or next to one.
    fn about(&mut self, exponent: i16) -> f64 {
        let biased = u64::try_from(1023 + exponent).expect("a float's");
        let power = f64::from_bits(biased << 52);
        let any = f64::from_bits((biased << 52) | (self.bits() >> 12));
        self.of(&[power, power.next_up(), power.next_down(), any, any, any]) * self.of(&[1.0, -1.0])
    }

    /// A high part: moderate, at a limit of the algorithms, or arbitrary.
    fn high(&mut self) -> f64 {
        let limit = self.of(&[
            -1023, -960, -900, -801, -800, -450, 511, 895, 959, 960, 1022,
        ]);
        let moderate = i16::try_from(self.bits() >> 58).expect("6 bits") - 32;
        let any = i16::try_from(self.bits() % 2046).expect("11 bits") - 1023;
        let exponent = self.of(&[limit, moderate, moderate, any]);
        self.about(exponent)
    }

    /// A value with two parts. The lower one is sometimes exactly half a unit, much smaller, or zero.
    fn number(&mut self) -> DoubleDouble {
        let high = self.high();
        let half_unit = high * f64::EPSILON / 2.0;
        let any = half_unit * (self.about(0) - 1.5);
        let low = self.of(&[0.0, half_unit, -half_unit, half_unit * 1e-9, any, any, any]);
        DoubleDouble::new(high) + DoubleDouble::new(low)
    }

    /// Two values: independent, nearly opposite, or nearly reciprocal.
    fn pair(&mut self) -> (DoubleDouble, DoubleDouble) {
        let (a, b) = (self.number(), self.number());
        let near = DoubleDouble::new(a.low() * self.about(-20)) + -a;
        let far = DoubleDouble::new(self.of(&[-1.0, 1.5]) * a.high()) + b;
        let reciprocal = DoubleDouble::one().checked_div(&a).unwrap_or(b);
        let partner = self.of(&[b, b, b, near, -a, far, reciprocal]);
        (a, if partner.is_defined() { partner } else { b })
    }
}

/// The exact value: high + low as a rational.
fn exactly(a: &DoubleDouble) -> BigRational {
    let part = |x: f64| BigRational::from_float(x).expect("finite");
    part(a.high()) + part(a.low())
}

fn power_of_two(exponent: i32) -> BigRational {
    BigRational::from_integer(2.into()).pow(exponent)
}

/// |low| is at most half a unit in the last place of high.
fn is_normal(a: &DoubleDouble) -> bool {
    let unit = a.high().abs().next_up() - a.high().abs();
    !a.is_defined() || a.low().abs() * 2.0 <= unit
}

/// The errors of an operation. Their bound is relative within the documented range and absolute below it.
struct Errors {
    /// The greatest relative error.
    worst: f64,
    range: [BigRational; 3],
}

impl Errors {
    fn new() -> Self {
        Self {
            worst: 0.0,
            range: [-900, 1023, 1024].map(power_of_two),
        }
    }

    fn add(&mut self, got: &DoubleDouble, want: &BigRational, witness: impl Fn() -> String) {
        assert!(is_normal(got), "{}: {got:?}", witness());
        let [least, most, beyond] = &self.range;
        let magnitude = want.abs();
        if magnitude >= *beyond {
            let overflow = want
                .to_f64()
                .map(f64::signum)
                .map(|sign| f64::INFINITY * sign);
            let parts = (Some(got.high().to_bits()), got.low().to_bits());
            assert_eq!(parts, (overflow.map(f64::to_bits), 0), "{}", witness());
            return;
        }
        if !got.is_defined() {
            assert!(
                magnitude > *most && got.low() == 0.0,
                "{}: {got:?}",
                witness()
            );
            return;
        }
        let error = (exactly(got) - want).abs();
        if error.is_zero() {
            return;
        }
        let relative = (&error / magnitude.clone().max(least.clone()))
            .to_f64()
            .expect("a float");
        // Near the end of the range a result may keep only the digits of one float.
        let limit = if magnitude < *most { -100 } else { -53 };
        assert!(
            relative <= 2.0_f64.powi(limit),
            "{}: {got:?} is off by {relative:e}",
            witness()
        );
        if magnitude < *most && magnitude >= *least {
            self.worst = self.worst.max(relative);
        }
    }

    /// The greatest error lies between two multiples of u² = 2^−106.
    fn assert_worst(&self, least: f64, most: f64) {
        let worst = self.worst * 2.0_f64.powi(106);
        assert!(
            (least..most).contains(&worst),
            "the worst error was {worst} u²"
        );
    }
}

fn measure(
    seed: u64,
    operation: impl Fn(DoubleDouble, &DoubleDouble) -> Option<DoubleDouble>,
    exact: impl Fn(&BigRational, &BigRational) -> BigRational,
) -> Errors {
    let mut random = Random(seed);
    let mut errors = Errors::new();
    for _ in 0..PAIRS {
        let (a, b) = random.pair();
        if let Some(got) = operation(a, &b) {
            let want = exact(&exactly(&a), &exactly(&b));
            errors.add(&got, &want, || format!("{a:?} and {b:?}"));
        }
    }
    errors
}

// The upper bounds, in u², are those of Joldes, Muller and Popescu. The lower bounds show that the operands are difficult.

#[test]
fn sums() {
    measure(1, |a, b| Some(a + b), |x, y| x + y).assert_worst(1.0, 3.0);
}

#[test]
fn differences() {
    measure(2, |a, b| Some(a - b), |x, y| x - y).assert_worst(1.0, 3.0);
}

#[test]
fn products() {
    measure(3, |a, b| Some(a * b), |x, y| x * y).assert_worst(3.0, 7.0);
}

#[test]
fn quotients() {
    measure(4, |a, b| a.checked_div(b), |x, y| x / y).assert_worst(4.0, 15.0);
}

/// The result consists of the nearest two floats. Its error is below 2^−106, in fact below half of that.
#[test]
fn rationals_are_rounded_once() {
    let mut random = Random(5);
    let range = [power_of_two(-900), power_of_two(1023)];
    for _ in 0..10_000 {
        let (a, b) = random.pair();
        let thirds = BigInt::from(random.of(&[1, 3, 10, 1_000_003]));
        let r = exactly(&a) + exactly(&b) / thirds;
        let got = DoubleDouble::from_rational(&r);
        if range[0] <= r.abs() && r.abs() <= range[1] {
            let error = (exactly(&got) - &r).abs();
            assert!(error <= r.abs() * power_of_two(-106), "{r}: {got:?}");
        }
        assert!(is_normal(&got), "{r}: {got:?}");
        let back = DoubleDouble::from_rational(&exactly(&a));
        assert_eq!(exactly(&back), exactly(&a));
    }
    let beyond = DoubleDouble::from_rational(&power_of_two(1024));
    assert!(!beyond.is_defined() && beyond.low() == 0.0);
}

#[test]
fn integers_of_106_bits_are_exact() {
    let mut random = Random(6);
    let is_exact =
        |n: i128| exactly(&DoubleDouble::from_integer(n)) == BigRational::from_integer(n.into());
    for bits in 1..=106 {
        let limit = 1_i128 << bits;
        for _ in 0..100 {
            let any = i128::from(random.bits()) << 64 | i128::from(random.bits());
            let n = any & (limit - 1);
            assert!(
                [n, -n, limit - 1, 1 - limit, limit]
                    .into_iter()
                    .all(is_exact),
                "{n}"
            );
        }
    }
    assert!(is_exact(i128::MIN) && is_exact(i128::MAX));
    for n in [i128::MAX - (1 << 60), (1 << 120) + (1 << 60) + 1] {
        let (got, want) = (
            exactly(&DoubleDouble::from_integer(n)),
            BigRational::from_integer(n.into()),
        );
        assert!(
            (got - &want).abs() <= want.abs() * power_of_two(-106),
            "{n}"
        );
    }
}

/// Division by a machine integer equals division by its image. All 63 bits of the image are exact.
#[test]
fn quotients_by_integers() {
    let mut random = Random(7);
    let mut errors = Errors::new();
    for _ in 0..5000 {
        let a = random.number();
        let n = random.of(&[1, -1, 3, -10, (1 << 53) + 1, i64::MAX, i64::MIN]);
        let want = exactly(&a) / BigInt::from(n);
        let got = a.div_int(n.try_into().expect("not zero"));
        errors.add(&got, &want, || format!("{a:?} / {n}"));
    }
    errors.assert_worst(2.0, 15.0);
}

/// An undefined result is the `f64` result of the high parts, with a zero low part.
#[test]
fn infinities_and_not_a_number() {
    let numbers = [
        0.0,
        -0.0,
        1.0,
        -3.0,
        f64::MAX,
        f64::MIN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];
    let same = |got: f64, want: f64| {
        got.is_nan() && want.is_nan() || got.partial_cmp(&want) == Some(Ordering::Equal)
    };
    for x in numbers {
        let a = DoubleDouble::new(x);
        assert_eq!(a.is_defined(), x.is_finite());
        assert_eq!(a.enclosure().is_some(), x.is_finite());
        for y in numbers {
            let b = DoubleDouble::new(y);
            for (got, float) in [(a + b, x + y), (a - b, x - y), (a * b, x * y)] {
                if float.is_finite() {
                    assert!(is_normal(&got) && got.is_defined(), "{x} and {y}: {got:?}");
                } else {
                    assert!(
                        same(got.high(), float) && got.low() == 0.0,
                        "{x} and {y}: {got:?}"
                    );
                }
            }
            let quotient = a.checked_div(&b);
            assert_eq!(quotient.is_some(), y != 0.0 && y.is_finite(), "{x} / {y}");
            let high = quotient.map_or(x / y, |quotient| quotient.high());
            assert!(same(high, x / y), "{x} / {y}: {high}");
        }
    }
    let tiny = DoubleDouble::new(1.0) + DoubleDouble::new(-1e-30);
    assert!((tiny - DoubleDouble::one()).high() < 0.0);
}

/// Close to the least subnormal and the greatest float. A product that two floats can represent is exact.
#[test]
fn representable_products_are_exact() {
    let power = |e: i32| BigRational::from_integer(2.into()).pow(e);
    let value = |x: &DoubleDouble| x.enclosure().unwrap().lower;
    // (1 + 2^−60)·2^e
    let two_parts = |e: i32| (BigRational::one() + power(-60)) * power(e);
    for (n, least) in [
        (1, -1074),
        (3, -1074),
        (5, -1070),
        (7, -1030),
        (1, -1022),
        (9, -700),
    ] {
        let small = power(least) * BigInt::from(n);
        let a = DoubleDouble::from_rational(&small);
        assert_eq!(value(&a), small);
        for e in [-100, 0, 400, 700, 1000, 1023] {
            // Both parts of the product are normal.
            if least + e < -900 {
                continue;
            }
            let great = two_parts(e);
            let b = DoubleDouble::from_rational(&great);
            assert_eq!(value(&b), great);
            for product in [a * b, b * a] {
                assert_eq!(value(&product), &small * &great, "{n}*2^{least}, 2^{e}");
            }
            assert_eq!(
                (a * b).checked_div(&b).map(|q| value(&q)),
                Some(small.clone())
            );
        }
    }
}

/// Factors of 53 bits have a product of 106 bits, which depends on every bit of their halves.
#[test]
fn products_of_integers_are_exact() {
    let value = |x: &DoubleDouble| x.enclosure().unwrap().lower;
    let most = (1_i128 << 53) - 1;
    for (n, m) in [
        (most, most - 2),
        (most - 4, -most),
        (0x1a_5c3f_9d27_6be1, 0x15_39e7_c84b_2da3),
        ((1 << 52) + 1, (1 << 52) + 3),
        (134_217_729, 8_001_234_567_890_123),
    ] {
        let [a, b] = [n, m].map(DoubleDouble::from_integer);
        let product = BigRational::from_integer(n.into()) * BigRational::from_integer(m.into());
        assert_eq!(value(&(a * b)), product, "{n} * {m}");
        assert_eq!((a * b).checked_div(&b).map(|q| value(&q)), Some(value(&a)));
    }
}

/// A factor of ordinary size enters the product unscaled, even if its low part is tiny.
#[test]
fn a_tiny_low_part_is_kept() {
    let power = |e: i32| DoubleDouble::new(2.0_f64.powi(e));
    for x in [power(300) + power(-800), power(-300) - power(-900)] {
        assert_eq!(DoubleDouble::one() * x, x);
        assert_eq!(x * DoubleDouble::one(), x);
    }
}
