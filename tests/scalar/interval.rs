//! An interval contains every true result and is almost as narrow as possible, compared with rationals for operands of every
//! size.

use cannonpile::scalar::{Algebra, Interval, Ring};
use cannonpile_testkit::real::Bounded;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Zero};

/// The number of point pairs for each operation.
const PAIRS: u32 = 50_000;

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

    /// A float of about ±2^`exponent`, where −1023 includes the subnormals. It is often a power of two, or next to a power
    /// of two.
    fn about(&mut self, exponent: i16) -> f64 {
        let biased = u64::try_from(1023 + exponent + self.of(&[0, 1, 2])).expect("a float's");
        let power = f64::from_bits(biased.min(2046) << 52);
        let any = f64::from_bits(power.to_bits() | (self.bits() >> 12));
        self.of(&[power, power.next_up(), power.next_down(), any, any]) * self.of(&[1.0, -1.0])
    }

    /// Special and moderate floats, and floats near 2^`limit`: at the limits of the format, or very large or small.
    fn float(&mut self) -> f64 {
        let limit = self.of(&[-1023, -1020, -900, -450, 511, 958, 959, 1021, 1023]);
        let moderate = i16::try_from(self.bits() >> 58).expect("6 bits") - 32;
        let any = f64::from_bits(self.bits());
        let special = self.of(&[-3.0, -1.0, -0.0, 0.0, 0.1, 1.0, 7.0, f64::MAX, f64::MIN]);
        let floats = [
            self.about(limit),
            self.about(moderate),
            self.about(moderate),
            any,
            special,
        ];
        Some(self.of(&floats))
            .filter(|x| x.is_finite())
            .unwrap_or(special)
    }

    /// Two floats: independent, cancelling, or with a product at a limit.
    fn pair(&mut self) -> (f64, f64) {
        let (x, y) = (self.float(), self.float());
        let (most, least) = (
            f64::MAX * (1.0 - self.float().abs().min(1.0) * 1e-7),
            self.about(-900),
        );
        let subnormal = f64::from_bits(self.bits() >> 40);
        let partner = self.of(&[y, y, -x, (-x).next_up(), most / x, least / x, subnormal / x]);
        (x, if partner.is_finite() { partner } else { y })
    }

    /// An interval between two floats, or from a float to infinity.
    fn interval(&mut self) -> Interval {
        let (x, y) = self.pair();
        let (lower, upper) = (x.min(y), x.max(y));
        let inf = f64::INFINITY;
        let ends = self.of(&[
            (lower, upper),
            (lower, upper),
            (lower, upper),
            (lower, inf),
            (-inf, upper),
        ]);
        Interval::new(ends.0, ends.1).expect("lower ≤ upper")
    }

    /// A rational in an interval, often an end.
    fn inside(&mut self, interval: &Interval) -> BigRational {
        let far = BigRational::from_integer(BigInt::from(2).pow(self.of(&[0_u32, 60, 1100])));
        match [interval.lower(), interval.upper()].map(BigRational::from_float) {
            [Some(lower), Some(upper)] => {
                let share = BigRational::new(self.of(&[0, 0, 1, 31, 63, 64, 64]).into(), 64.into());
                &lower + (upper - &lower) * share
            }
            [Some(lower), None] => lower + far,
            [None, Some(upper)] => upper - far,
            [None, None] => far,
        }
    }
}

/// The exact value of a finite float.
fn exactly(x: f64) -> BigRational {
    BigRational::from_float(x).expect("finite")
}

/// x ≤ r, for an end x of an interval.
fn is_below(x: f64, r: &BigRational) -> bool {
    BigRational::from_float(x).map_or(x < 0.0, |x| x <= *r)
}

/// The interval contains `least` and `greatest`. It would contain neither if its ends moved inwards by `slack` + 1 floats.
fn encloses(got: &Interval, [least, greatest]: [&BigRational; 2], slack: u32) -> bool {
    // An upper end is a lower end of the negated interval.
    [(got.lower(), least.clone()), (-got.upper(), -greatest)]
        .iter()
        .all(|(end, r)| {
            let further_in = (0..=slack).fold(*end, |end, _| end.next_up());
            is_below(*end, r) && !is_below(further_in, r)
        })
}

#[test]
fn sums_of_points_are_tightest() {
    let mut random = Random(1);
    for _ in 0..PAIRS {
        let (x, y) = random.pair();
        let (a, b) = (Interval::point(x), Interval::point(y));
        let exact = exactly(x) + exactly(y);
        assert!(encloses(&(a + b), [&exact; 2], 0), "{x:e} + {y:e}");
        assert!(encloses(&(a - (-b)), [&exact; 2], 0), "{x:e} - {:e}", -y);
    }
}

/// The extra width that a product or quotient may have: zero, except among the subnormals.
fn slack(result: f64) -> u32 {
    u32::from(result.abs() <= f64::MIN_POSITIVE)
}

#[test]
fn products_of_points_are_tight() {
    let mut random = Random(2);
    for _ in 0..PAIRS {
        let (x, y) = random.pair();
        let product = Interval::point(x) * Interval::point(y);
        let exact = exactly(x) * exactly(y);
        assert!(
            encloses(&product, [&exact; 2], slack(x * y)),
            "{x:e} * {y:e}: {product:?}"
        );
    }
}

#[test]
fn quotients_of_points_are_tight() {
    let mut random = Random(3);
    for _ in 0..PAIRS {
        let (x, y) = random.pair();
        // A product divided by its factor is almost a float.
        let x = random.of(&[x, x * y]);
        if y != 0.0 && x.is_finite() {
            let quotient = Interval::point(x)
                .checked_div(&Interval::point(y))
                .expect("y is not 0");
            let exact = exactly(x) / exactly(y);
            assert!(
                encloses(&quotient, [&exact; 2], slack(x / y)),
                "{x:e} / {y:e}: {quotient:?}"
            );
        }
    }
}

type Operation = (
    char,
    fn(Interval, Interval) -> Option<Interval>,
    fn(&BigRational, &BigRational) -> BigRational,
);

const OPERATIONS: [Operation; 4] = [
    ('+', |a, b| Some(a + b), |x, y| x + y),
    ('-', |a, b| Some(a - b), |x, y| x - y),
    ('*', |a, b| Some(a * b), |x, y| x * y),
    ('/', |a, b| a.checked_div(&b), |x, y| x / y),
];

/// The ends come from corners of the operands, and the results of inner points lie between them.
#[test]
fn intervals_contain_the_results_of_their_points() {
    let mut random = Random(4);
    for _ in 0..2000 {
        let (a, b) = (random.interval(), random.interval());
        for (name, interval, rational) in &OPERATIONS {
            let Some(result) = interval(a, b) else {
                assert!(b.contains(&BigRational::zero()), "{a:?} {name} {b:?}");
                continue;
            };
            for _ in 0..3 {
                let (x, y) = (random.inside(&a), random.inside(&b));
                let holds = result.contains(&rational(&x, &y));
                assert!(holds, "{a:?} {name} {b:?} at {x}, {y}: {result:?}");
            }
            let (Some(p), Some(q)) = (a.enclosure(), b.enclosure()) else {
                continue;
            };
            let corners =
                [&p.lower, &p.upper].map(|x| [&q.lower, &q.upper].map(|y| rational(x, y)));
            let corners = corners.as_flattened();
            let ends = [corners.iter().min(), corners.iter().max()].map(|end| end.expect("four"));
            assert!(encloses(&result, ends, 1), "{a:?} {name} {b:?}: {result:?}");
        }
    }
}

#[test]
fn rationals_and_integers_are_enclosed_tightly() {
    let mut random = Random(5);
    for _ in 0..5000 {
        let (x, y) = random.pair();
        let r = exactly(x) * exactly(y) / BigInt::from(random.of(&[1, 3, 7, 10]));
        assert!(encloses(&Interval::from_rational(&r), [&r; 2], 0), "{r}");

        let n = (i128::from(random.bits().cast_signed()) << random.of(&[0, 1, 10, 63]))
            + random.of(&[-1, 0, 1]);
        let integer = BigRational::from_integer(n.into());
        assert!(
            encloses(&Interval::from_integer(n), [&integer; 2], 0),
            "{n}"
        );

        let divisor = random.of(&[i64::MIN, -10, -1, 1, 3, 1 << 53, (1 << 53) + 1, i64::MAX]);
        let quotient = Interval::point(x).div_int(divisor.try_into().expect("not zero"));
        let exact = exactly(x) / BigInt::from(divisor);
        // A divisor of more than 53 bits is itself rounded outwards.
        assert!(
            encloses(&quotient, [&exact; 2], 2),
            "{x:e} / {divisor}: {quotient:?}"
        );
    }
}

/// A representable result stays a point if it is not near the limits.
#[test]
fn results_that_are_floats_stay_points() {
    let mut random = Random(6);
    let mut factor = || f64::from(u32::try_from(random.bits() >> 38).expect("26 bits") + 1);
    for exponent in (-800..800).step_by(4) {
        // With 26 bits each, sum and product have at most 53.
        let (x, y) = (factor() * -2.0_f64.powi(exponent), factor());
        let [a, b] = [x, y].map(Interval::point);
        assert_eq!(a * b, Interval::point(x * y));
        assert_eq!((a * b).checked_div(&b), Some(a));
        assert_eq!(b + b, Interval::point(y + y));
        assert_eq!(
            (a - a, a * Interval::zero()),
            (Interval::zero(), Interval::zero())
        );
        assert_eq!(
            a.div_int(4.try_into().expect("not zero")),
            Interval::point(x / 4.0)
        );
    }
}

/// All intervals between difficult ends, including −0 and the infinities.
fn difficult() -> Vec<Interval> {
    let positive = [
        0.0,
        5e-324,
        f64::MIN_POSITIVE,
        1.0,
        3.0,
        1e300,
        f64::MAX,
        f64::INFINITY,
    ];
    let ends = positive.into_iter().flat_map(|end| [-end, end]);
    let from = |lower| {
        ends.clone()
            .filter_map(move |upper| Interval::new(lower, upper))
    };
    ends.clone().flat_map(from).collect()
}

#[test]
fn no_result_has_a_nan_end() {
    for a in difficult() {
        for b in difficult() {
            for (name, operation, _) in &OPERATIONS {
                if let Some(result) = operation(a, b) {
                    let again = Interval::new(result.lower(), result.upper());
                    let whole = result.is_defined() && again == Some(result);
                    assert!(whole, "{a:?} {name} {b:?}: {result:?}");
                } else {
                    assert!(*name == '/' && b.contains(&BigRational::zero()));
                }
            }
        }
    }
    for undefined in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(Interval::point(undefined), Interval::WHOLE);
    }
}

/// A quotient exists if the divisor does not contain zero.
#[test]
fn divisors_do_not_contain_zero() {
    for a in difficult() {
        let holds_zero = a.contains(&BigRational::zero());
        let is_zero = holds_zero && a.width() == 0.0;
        assert_eq!(a.is_zero(), is_zero, "{a:?}");
        assert_eq!(
            Interval::one().checked_div(&a).is_none(),
            holds_zero,
            "{a:?}"
        );
        let infinite = a.lower().is_infinite() || a.upper().is_infinite();
        assert_eq!(a.enclosure().is_none(), infinite, "{a:?}");
    }
}

/// An infinite end is not a bound, and no real number lies there.
#[test]
fn infinite_ends() {
    let of = |lower, upper| Interval::new(lower, upper).expect("lower ≤ upper");
    let (inf, zero) = (f64::INFINITY, Interval::zero());
    let ray = of(2.0, inf);
    assert_eq!((Interval::WHOLE * zero, ray * zero), (zero, zero));
    assert_eq!(ray * of(0.0, 1.0), of(0.0, inf));
    assert_eq!(ray * -ray, of(-inf, -4.0));
    assert_eq!(ray - ray, Interval::WHOLE);
    assert_eq!(Interval::one().checked_div(&ray), Some(of(0.0, 0.5)));
    assert_eq!(ray.checked_div(&ray), Some(of(0.0, inf)));
    assert_eq!(zero.checked_div(&ray), Some(zero));
    // A result above the largest float lies between it and infinity.
    let most = Interval::point(f64::MAX);
    assert_eq!(
        (most + most, -most * most),
        (of(f64::MAX, inf), of(-inf, f64::MIN))
    );
    let beyond = exactly(f64::MAX) * exactly(f64::MAX);
    assert_eq!(Interval::from_rational(&beyond), of(f64::MAX, inf));
    assert!(ray.contains(&beyond) && Interval::WHOLE.contains(&-beyond));
}

/// A subnormal times a large number, or divided by a small one. The interval contains the exact result and is tightest.
#[test]
fn subnormals_are_multiplied_and_divided_tightly() {
    let mut inexact = 0;
    for bits in [1, 3, 5, 7, 1025, (1 << 40) + 1, (1 << 51) - 1] {
        for odd in [1, 3, 5, 0xf_ffff_ffff_ffff] {
            let subnormal = f64::from_bits(bits);
            // (1 + odd·2^−52)·2^1000 and ·2^−1000.
            let [great, small] = [2023_u64, 23].map(|power| f64::from_bits(power << 52 | odd));
            let [x, y, z] = [subnormal, -great, small].map(Interval::point);
            let product = exactly(subnormal) * exactly(-great);
            assert!(encloses(&(x * y), [&product; 2], 0), "{bits} * {great:e}");
            assert_eq!(y * x, x * y);
            let quotient = exactly(subnormal) / exactly(small);
            let found = x.checked_div(&z).unwrap();
            assert!(encloses(&found, [&quotient; 2], 0), "{bits} / {small:e}");
            inexact += u32::from((x * y).lower() < (x * y).upper());
        }
    }
    assert!(inexact > 15, "{inexact}");
}

/// MAX − 3/2 units lies between MAX − 2 and MAX − 1, in any order of the summands.
#[test]
fn sums_next_to_the_greatest_float_are_enclosed_tightly() {
    let unit = f64::MAX - f64::MAX.next_down();
    let [most, less] = [f64::MAX, -1.5 * unit].map(Interval::point);
    let below = f64::MAX.next_down();
    let between = Interval::new(below.next_down(), below).unwrap();
    assert_eq!((most + less, less + most), (between, between));
    assert_eq!((-less - most, -most - less), (-between, -between));
}

#[test]
fn intervals_without_a_common_point_are_not_equal() {
    let of = |lower, upper| Interval::new(lower, upper).expect("lower ≤ upper");
    for (a, b, may) in [
        (of(1.0, 2.0), of(2.0, 3.0), true),
        (of(1.0, 2.0), of(0.0, 9.0), true),
        (of(1.0, 2.0), of(3.0, 4.0), false),
        (of(1.0, 1.0), of(1.0_f64.next_up(), f64::INFINITY), false),
        (Interval::WHOLE, Interval::zero(), true),
    ] {
        // The laws compare bounds in this way.
        let may_equal = |a, b: &Interval| Interval::one().checked_div(&(a - b)).is_none();
        assert_eq!(
            (may_equal(a, &b), may_equal(b, &a)),
            (may, may),
            "{a:?} {b:?}"
        );
    }
}

/// 2^−1022 (1 − 2^−53) rounds up to the least normal float, because no subnormal has a significand of 53 bits.
#[test]
fn a_product_rounded_to_the_least_normal_float_is_contained() {
    let (x, y) = (1.0_f64.next_down(), f64::MIN_POSITIVE);
    for product in [
        Interval::point(x) * Interval::point(y),
        Interval::point(y) * Interval::point(x),
    ] {
        assert!(product.upper() <= f64::MIN_POSITIVE.next_up());
        assert!(product.contains(&(exactly(x) * exactly(y))), "{product:?}");
    }
    let quotient = Interval::point(y)
        .checked_div(&Interval::point(1.0_f64.next_up()))
        .unwrap();
    assert!(
        quotient.contains(&(exactly(y) / exactly(1.0_f64.next_up()))),
        "{quotient:?}"
    );
}
