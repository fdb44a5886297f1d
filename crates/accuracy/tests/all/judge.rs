//! Verdicts on number types: all scalars of the core keep their promises, and each planted fault is found and named.

use std::num::NonZeroI64;
use std::ops::{Add, Mul, Sub};
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};

use cannonpile::num_rational::BigRational;
use cannonpile::scalar::{
    Algebra, DoubleDouble, Exactness, Field, FixedRational, Interval, Plain, Ring, promise,
};
use cannonpile_accuracy::{Check, Judgement, judge};

/// The faults of [`Faulty`].
const NONE: u8 = 0;
const PRODUCT_ROUNDS_UP: u8 = 1;
const SUM_NOT_COMMUTATIVE: u8 = 2;
const WRONG_SUBNORMAL: u8 = 3;
const FLUSHED_SUBNORMAL: u8 = 4;
const WRAPPED_OVERFLOW: u8 = 5;
const SATURATED: u8 = 6;
const FEW_BITS: u8 = 7;
const BIASED_THIRD: u8 = 8;

/// An `f32` with the fault [`FAULT`].
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Faulty(f32);

/// Not local to a thread, because the core may use several.
static FAULT: AtomicU8 = AtomicU8::new(NONE);

fn is_fault(fault: u8) -> bool {
    FAULT.load(Ordering::Relaxed) == fault
}

impl Faulty {
    /// Returns the result of an operation, with its fault.
    fn of(x: f32) -> Self {
        let is_subnormal = x != 0.0 && x.abs() < f32::MIN_POSITIVE;
        Self(match FAULT.load(Ordering::Relaxed) {
            WRONG_SUBNORMAL if is_subnormal => f32::from_bits(x.to_bits() ^ 1),
            FLUSHED_SUBNORMAL if is_subnormal => 0.0,
            WRAPPED_OVERFLOW if x.is_infinite() => -x.signum(),
            SATURATED => x.clamp(f32::MIN, f32::MAX),
            FEW_BITS => f32::from_bits(x.to_bits() & !1),
            _ => x,
        })
    }
}

impl Add<&Self> for Faulty {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        let sum = self.0 + other.0;
        let is_turned = is_fault(SUM_NOT_COMMUTATIVE)
            && self.0 < other.0
            && (f64::from(sum) - f64::from(self.0) - f64::from(other.0)).abs() > 0.0;
        Self::of(if is_turned { sum.next_down() } else { sum })
    }
}

impl Sub<&Self> for Faulty {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        Self::of(self.0 - other.0)
    }
}

impl Mul<&Self> for Faulty {
    type Output = Self;
    fn mul(self, other: &Self) -> Self {
        let product = self.0 * other.0;
        let is_below = f64::from(product) < f64::from(self.0) * f64::from(other.0);
        Self::of(if is_fault(PRODUCT_ROUNDS_UP) && is_below {
            product.next_up()
        } else {
            product
        })
    }
}

cannonpile::ring!(Faulty);

impl Ring for Faulty {
    fn from_integer(n: i128) -> Self {
        Self(f32::from_integer(n))
    }
}

impl Algebra for Faulty {
    const EXACTNESS: Exactness = f32::EXACTNESS;
    const NAME: &'static str = "Faulty";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        Self(f32::from_rational(r))
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        let quotient = self.0.div_int(n);
        Self::of(if is_fault(BIASED_THIRD) && n.get() == 3 {
            quotient.next_up()
        } else {
            quotient
        })
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        self.0.checked_div(&divisor.0).map(Self::of)
    }

    fn is_defined(&self) -> bool {
        self.0.is_finite()
    }
}

impl Field for Faulty {}

/// An exact rational. The addition with the number [`WRONG`] is off by 2^−80.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
struct WrongOnce(BigRational);

static ADDITIONS: AtomicU64 = AtomicU64::new(0);
static WRONG: AtomicU64 = AtomicU64::new(u64::MAX);

impl Add<&Self> for WrongOnce {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        let is_wrong = ADDITIONS.fetch_add(1, Ordering::Relaxed) == WRONG.load(Ordering::Relaxed);
        let off = BigRational::new(i32::from(is_wrong).into(), (1_u128 << 80).into());
        Self(self.0 + &other.0 + off)
    }
}

impl Sub<&Self> for WrongOnce {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        Self(self.0 - &other.0)
    }
}

impl Mul<&Self> for WrongOnce {
    type Output = Self;
    fn mul(self, other: &Self) -> Self {
        Self(self.0 * &other.0)
    }
}

cannonpile::ring!(WrongOnce);

impl Ring for WrongOnce {
    fn from_integer(n: i128) -> Self {
        Self(BigRational::from_integer(n.into()))
    }
}

impl Algebra for WrongOnce {
    const EXACTNESS: Exactness = Exactness::Exact;
    const NAME: &'static str = "WrongOnce";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        Self(r.clone())
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        Self(self.0.div_int(n))
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        self.0.checked_div(&divisor.0).map(Self)
    }

    fn is_defined(&self) -> bool {
        true
    }
}

impl Field for WrongOnce {}

fn assert_kept(judgement: &Judgement) {
    assert!(
        judgement.keeps_promise(),
        "{judgement}\n{:?}",
        judgement.findings
    );
    assert_eq!(judgement.to_string().lines().count(), 10, "{judgement}");
}

/// Asserts that a check found a fault whose witness has some text, and that the text is in its line.
fn assert_found(judgement: &Judgement, check: Check, text: &str) {
    let mut found = judgement
        .findings
        .iter()
        .filter(|finding| finding.check == check);
    assert!(
        found.any(|finding| finding.witness.contains(text)),
        "{judgement}\n{:?}",
        judgement.findings
    );
    assert!(!judgement.keeps_promise());
    assert_eq!(judgement.to_string().lines().count(), 10, "{judgement}");
    assert!(
        judgement
            .to_string()
            .lines()
            .next()
            .unwrap()
            .contains("BREAKS"),
        "{judgement}"
    );
}

#[test]
#[expect(clippy::float_cmp, reason = "the units are powers of two")]
fn floats_keep_their_promise() {
    let judgement = judge::<f32>();
    assert_kept(&judgement);
    assert_eq!(
        (
            judgement.largest_power,
            judgement.smallest_power,
            judgement.stagnation
        ),
        (Some(127), Some(-149), Some(24))
    );
    assert_eq!(judgement.unit, 2_f64.powi(-24));
    // The errors that were measured with independent code: 3.1, 6.6 and 13.8 u.
    let growth: Vec<_> = judgement
        .growth
        .iter()
        .map(|row| row.error.unwrap())
        .collect();
    for (error, expected) in growth.iter().zip([3.1, 6.6, 13.8]) {
        assert!((error - expected).abs() < 0.05, "{growth:?}");
    }

    let judgement = judge::<f64>();
    assert_kept(&judgement);
    assert_eq!(
        (
            judgement.largest_power,
            judgement.smallest_power,
            judgement.stagnation
        ),
        (Some(1023), Some(-1074), Some(53))
    );
    assert_kept(&judge::<DoubleDouble>());
}

#[test]
fn types_without_a_promise_break_none() {
    let judgement = judge::<Plain<f32>>();
    assert_kept(&judgement);
    assert_eq!(judgement.findings, []);
    assert!(
        judgement
            .to_string()
            .starts_with("Plain<f32> promises nothing; 0 findings\n"),
        "{judgement}"
    );
    // The unit is measured.
    assert!((judgement.unit.log2() + 24.0).abs() < 0.1, "{judgement}");
    assert_kept(&judge::<Plain<f32, promise::Rounded>>());
    // Exact, but it does not say so.
    let judgement = judge::<Plain<BigRational>>();
    assert_eq!(judgement.findings, []);
    assert_eq!((judgement.unit, judgement.largest_force_error), (0.0, 0.0));
}

#[test]
fn exact_scalars_and_bounds_keep_their_promise() {
    assert_kept(&judge::<BigRational>());
    assert_kept(&judge::<FixedRational<i64>>());
    let judgement = judge::<FixedRational<i8>>();
    assert_kept(&judgement);
    assert!(judgement.refused_count > 0, "{judgement}");
    assert_kept(&judge::<Interval>());
}

// It takes half a minute in debug: nine verdicts, each with a million spheres.
#[test]
fn planted_faults_of_floats_are_named() {
    assert_kept(&judge::<Faulty>());
    for (fault, check, text) in [
        (PRODUCT_ROUNDS_UP, Check::Laws, "a b:"),
        (SUM_NOT_COMMUTATIVE, Check::Laws, "a + b = b + a:"),
        (WRONG_SUBNORMAL, Check::Underflow, "x/2 of x = 2^-126"),
        (
            FLUSHED_SUBNORMAL,
            Check::Underflow,
            "x = 2^-126 is Faulty(0.0)",
        ),
        (
            WRAPPED_OVERFLOW,
            Check::Overflow,
            "x + x of x = 2^127 is Faulty(-1.0)",
        ),
        (SATURATED, Check::Overflow, "x + x of x = 2^127"),
        (FEW_BITS, Check::Operations, "in place of"),
        (BIASED_THIRD, Check::Laws, "a / n:"),
    ] {
        FAULT.store(fault, Ordering::Relaxed);
        assert_found(&judge::<Faulty>(), check, text);
    }
}

#[test]
fn one_wrong_addition_of_an_exact_type_is_found() {
    let judged = |at| {
        ADDITIONS.store(0, Ordering::Relaxed);
        WRONG.store(at, Ordering::Relaxed);
        judge::<WrongOnce>()
    };
    assert_kept(&judged(u64::MAX));
    for (at, check) in [
        (1_000, Check::Laws),
        (7_000, Check::Operations),
        (8_500, Check::Piles),
        (100_000, Check::Growth),
    ] {
        assert_found(&judged(at), check, "");
    }
}
