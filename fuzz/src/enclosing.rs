//! Intervals contain the exact result, and double-doubles are within 2^−100 of it.

use arbitrary::{Result, Unstructured};
use cannonpile::scalar::{Algebra, DoubleDouble, Field, Interval, Ring, laws};
use cannonpile_testkit::real::Bounded;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use cannonpile_testkit::generators::number;
use cannonpile_testkit::pair::Pair;

/// Checks all claims on numbers generated from the bytes.
///
/// # Errors
/// There are too few bytes.
///
/// # Panics
/// A claim fails.
pub fn enclosing(data: &mut Unstructured<'_>) -> Result<()> {
    points(data)?;
    intervals(data)?;
    double_doubles(data)?;
    images(data)?;
    computation(data)
}

#[derive(Clone, Copy, Debug)]
enum Operation {
    Sum,
    Difference,
    Product,
    Quotient,
}

const OPERATIONS: [Operation; 4] = [
    Operation::Sum,
    Operation::Difference,
    Operation::Product,
    Operation::Quotient,
];

impl Operation {
    fn apply<T: Field>(self, a: &T, b: &T) -> Option<T> {
        match self {
            Self::Sum => Some(a.clone() + b),
            Self::Difference => Some(a.clone() - b),
            Self::Product => Some(a.clone() * b),
            Self::Quotient => a.checked_div(b),
        }
    }
}

/// Two floats: arbitrary, opposite, or with a product or quotient at the limits of f64.
fn floats(u: &mut Unstructured<'_>) -> Result<(f64, f64)> {
    let (x, y) = (number::float(u)?, number::float(u)?);
    let near = 1.0 - f64::from(u.arbitrary::<u16>()?) * 1e-11;
    let y = match u.int_in_range(0..=6)? {
        0 => y,
        1 => -x,
        2 => (-x).next_up(),
        3 => f64::MAX * near / x,
        4 => x / f64::MAX * near,
        5 => 2.0_f64.powi(u.int_in_range(-1074..=-890)?) / x,
        _ => f64::from(u.arbitrary::<i8>()?),
    };
    Ok((
        x,
        if y.is_finite() {
            y
        } else {
            f64::MAX.copysign(x)
        },
    ))
}

/// Returns whether x ≤ r, for an end x of an interval.
fn is_below(x: f64, r: &BigRational) -> bool {
    BigRational::from_float(x).map_or(x < 0.0, |x| x <= *r)
}

/// Checks that the interval contains `least` and `greatest`, and that its ends are at most one float too wide.
fn assert_tight(got: &Interval, least: &BigRational, greatest: &BigRational, witness: &str) {
    for (end, r) in [(got.lower(), least.clone()), (-got.upper(), -greatest)] {
        assert!(
            is_below(end, &r),
            "{witness} gave {got:?}, which does not hold {r}"
        );
        let further_in = end.next_up().next_up();
        assert!(
            !is_below(further_in, &r),
            "{witness} gave {got:?}, too wide for {r}"
        );
    }
}

/// Checks every operation on two floats.
fn points(u: &mut Unstructured<'_>) -> Result<()> {
    let (x, y) = floats(u)?;
    let (a, b) = (Interval::point(x), Interval::point(y));
    for operation in OPERATIONS {
        let exact = operation.apply(&number::exactly(x), &number::exactly(y));
        let got = operation.apply(&a, &b);
        assert_eq!(got.is_some(), exact.is_some(), "{x:e} / {y:e}");
        if let (Some(got), Some(exact)) = (got, exact) {
            assert_tight(
                &got,
                &exact,
                &exact,
                &format!("{operation:?} of {x:e} and {y:e}"),
            );
        }
    }
    Ok(())
}

/// Checks every operation on two intervals, which may be unbounded.
fn intervals(u: &mut Unstructured<'_>) -> Result<()> {
    let mut interval = || {
        let (x, y) = floats(u)?;
        let (lower, upper) = match u.int_in_range(0..=3)? {
            0 => (x, f64::INFINITY),
            1 => (f64::NEG_INFINITY, x),
            _ => (x.min(y), x.max(y)),
        };
        let inside = number::fraction(u)?;
        Ok((Interval::new(lower, upper).expect("lower ≤ upper"), inside))
    };
    let ((a, part_a), (b, part_b)) = (interval()?, interval()?);
    // A point of the interval, at a fraction of the width from a finite end.
    let inside = |of: &Interval, part: &BigRational| {
        let ends = [of.lower(), of.upper()].map(BigRational::from_float);
        match ends {
            [Some(lower), Some(upper)] => &lower + (upper - &lower) * part,
            [Some(lower), None] => lower + part * BigInt::from(1_000),
            [None, Some(upper)] => upper - part * BigInt::from(1_000),
            [None, None] => part.clone(),
        }
    };
    let (x, y) = (inside(&a, &part_a), inside(&b, &part_b));
    assert!(a.contains(&x) && b.contains(&y));
    for operation in OPERATIONS {
        let Some(got) = operation.apply(&a, &b) else {
            assert!(b.contains(&BigRational::zero()), "{a:?} over {b:?}");
            continue;
        };
        assert!(Interval::new(got.lower(), got.upper()).is_some(), "{got:?}");
        let exact = operation
            .apply(&x, &y)
            .expect("a quotient, as of the intervals");
        assert!(
            got.contains(&exact),
            "{operation:?} of {a:?} and {b:?} gave {got:?} without {exact}"
        );
    }
    Ok(())
}

/// A double-double: the lower part is at most half a unit in the last place of the upper one.
fn double_double(u: &mut Unstructured<'_>, high: f64) -> Result<DoubleDouble> {
    let low = match u.int_in_range(0..=3)? {
        0 => 0.0,
        1 => f64::EPSILON / 2.0,
        2 => f64::EPSILON / 2.0 * f64::from(u.arbitrary::<u32>()?) / f64::from(u32::MAX),
        _ => f64::EPSILON * 1e-9,
    };
    let low = if u.arbitrary()? { low } else { -low };
    Ok(DoubleDouble::new(high) + DoubleDouble::new(high * low))
}

fn double_doubles(u: &mut Unstructured<'_>) -> Result<()> {
    let (x, y) = floats(u)?;
    let (a, b) = (double_double(u, x)?, double_double(u, y)?);
    let (Some(x), Some(y)) = (exactly(&a), exactly(&b)) else {
        return Ok(());
    };
    for operation in OPERATIONS {
        let (got, exact) = (operation.apply(&a, &b), operation.apply(&x, &y));
        assert_eq!(got.is_some(), exact.is_some(), "{a:?} over {b:?}");
        if let (Some(got), Some(exact)) = (got, exact) {
            assert_near(&got, &exact, &format!("{operation:?} of {a:?} and {b:?}"));
        }
    }
    Ok(())
}

fn exactly(a: &DoubleDouble) -> Option<BigRational> {
    a.enclosure().map(|bounds| bounds.lower)
}

/// Checks that a double-double is normalised and within 2^−100 of a result between 2^−900 and 2^1023.
fn assert_near(got: &DoubleDouble, want: &BigRational, witness: &str) {
    let size = want.abs();
    if size > number::power(2, 1023) {
        return;
    }
    let unit = got.high().abs().next_up() - got.high().abs();
    assert!(
        got.low().abs() * 2.0 <= unit,
        "{witness} gave {got:?}, not in normal form"
    );
    let value = exactly(got).unwrap_or_else(|| panic!("{witness} gave {got:?}"));
    // Below this range the absolute error is at most that at its lower end.
    let limit = size.max(number::power(2, -900)) * number::power(2, -100);
    assert!(
        (value - want).abs() <= limit,
        "{witness} gave {got:?} for {want}"
    );
}

/// Checks the conversions from rationals and integers, and runs the law suite on them.
fn images(u: &mut Unstructured<'_>) -> Result<()> {
    let (r, s, n) = (
        number::rational(u)?,
        number::rational(u)?,
        number::machine_integer(u)?,
    );
    let interval = Interval::from_rational(&r);
    assert_tight(&interval, &r, &r, "an image");
    if r.abs() < number::power(2, 1023) {
        assert_near(&DoubleDouble::from_rational(&r), &r, "an image");
    }
    let integer = BigRational::from_integer(n.into());
    assert_tight(&Interval::from_integer(n), &integer, &integer, "an integer");
    assert_near(&DoubleDouble::from_integer(n), &integer, "an integer");
    obeys::<Interval>(&r, &s);
    obeys::<DoubleDouble>(&r, &s);
    obeys::<Pair<BigRational, Interval>>(&r, &s);
    Ok(())
}

fn obeys<T: Field + Bounded>(r: &BigRational, s: &BigRational) {
    let [a, b, c] = [r.clone(), s.clone(), r - s].map(|r| T::from_rational(&r));
    if let Err(broken) = laws::algebra(&a, &b, &c).and(laws::embedding(r, s, T::bounds)) {
        panic!("{broken}");
    }
}

/// Runs the same computation in rationals and intervals, and checks that each interval contains the rational.
fn computation(u: &mut Unstructured<'_>) -> Result<()> {
    type Checked = Pair<BigRational, Interval>;
    let mut values = vec![Checked::one()];
    for _ in 0..u.int_in_range(0..=8)? {
        let next = if u.arbitrary()? {
            Checked::from_rational(&number::rational(u)?)
        } else {
            let (a, b) = (u.choose(&values)?, u.choose(&values)?);
            let operation = *u.choose(&OPERATIONS)?;
            let Some(next) = operation.apply(a, b) else {
                continue;
            };
            next
        };
        assert!(next.divergence().is_none(), "{:?}", next.divergence());
        assert!(next.second().contains(next.first()), "{next:?}");
        // Long fractions slow down all further steps, and test nothing more.
        if next.first().denom().bits() + next.first().numer().bits() < 20_000 {
            values.push(next);
        }
    }
    Ok(())
}
