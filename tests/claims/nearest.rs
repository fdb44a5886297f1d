//! A root is rounded to the nearest float, ties to even.
//!
//! Judged without a root: x is nearest to √v if v lies between the squares of the two points halfway to
//! the neighbours of x. A point halfway is a rational, so this is exact.

use core::fmt::Debug;

use arbitrary::Unstructured;
use cannonpile::scalar::{NearestFloat, Sign, Surd};
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::{Checked, demand, same};
use crate::generators::number::{self, ratio};

/// A float format, with its neighbours.
pub(crate) trait Float: NearestFloat + Debug + PartialEq {
    /// The largest finite one.
    const LARGEST: Self;

    /// The exact value; `None` for infinities and not-a-number.
    fn exactly(self) -> Option<BigRational>;
    /// |x|.
    fn magnitude(self) -> Self;
    /// The next float on the real line.
    fn up(self) -> Self;
    /// The one before.
    fn down(self) -> Self;
    /// Whether the last bit of the significand is 0.
    fn is_even(self) -> bool;
}

macro_rules! float {
    ($($float:ident)*) => {$(
        impl Float for $float {
            const LARGEST: Self = Self::MAX;

            fn exactly(self) -> Option<BigRational> {
                BigRational::from_float(self)
            }

            fn magnitude(self) -> Self {
                self.abs()
            }

            fn up(self) -> Self {
                self.next_up()
            }

            fn down(self) -> Self {
                self.next_down()
            }

            fn is_even(self) -> bool {
                self.to_bits() % 2 == 0
            }
        }
    )*};
}

float!(f32 f64);

/// c·√r is rounded to the nearest float of either format.
pub(crate) fn of_a_root(u: &mut Unstructured<'_>) -> Checked {
    let (c, r) = number::root(u)?;
    let surd = Surd::new(c.clone(), r.clone())?;
    nearest(&surd, &Value::root(&c, &r))
}

/// A rational is rounded to the nearest float of either format, and a float to itself.
pub(crate) fn of_a_rational(u: &mut Unstructured<'_>) -> Checked {
    let r = number::rational(u)?;
    let value = Value::root(&r, &ratio(1, 1));
    is_nearest(f64::nearest_to_rational(&r), &value)?;
    is_nearest(f32::nearest_to_rational(&r), &value)?;
    let x = number::float(u)?;
    let back = f64::nearest_to_rational(&number::exactly(x));
    same("a float, rounded,", &back, &Some(x))
}

/// `surd` is the value, and is rounded to the nearest float of either format.
pub(crate) fn nearest(surd: &Surd, value: &Value) -> Checked {
    same("the square", &surd.square(), &value.square)?;
    let sign = match (value.square.is_zero(), value.negative) {
        (true, _) => Sign::Zero,
        (false, true) => Sign::Negative,
        (false, false) => Sign::Positive,
    };
    same("the sign", &surd.sign(), &sign)?;
    is_nearest(surd.nearest::<f64>(), value)?;
    is_nearest(surd.nearest::<f32>(), value)
}

/// A real number by its sign and its square.
#[derive(Clone, Debug)]
pub(crate) struct Value {
    negative: bool,
    square: BigRational,
}

impl Value {
    /// `coefficient`·√`radicand`.
    pub(crate) fn root(coefficient: &BigRational, radicand: &BigRational) -> Self {
        Self {
            negative: coefficient.is_negative(),
            square: coefficient * coefficient * radicand,
        }
    }
}

/// Whether `got` is the float nearest to the value, `None` standing for an infinite one.
pub(crate) fn is_nearest<F: Float>(got: Option<F>, value: &Value) -> Checked {
    let holds = match got {
        // The largest float is odd: the point halfway beyond it already rounds to infinity.
        None => square(&edge::<F>()) <= value.square,
        Some(x) => x.exactly().is_some_and(|exact| {
            let sign_agrees = exact.is_zero() || exact.is_negative() == value.negative;
            sign_agrees && is_between_halves(x.magnitude(), &value.square)
        }),
    };
    demand(holds, || format!("{got:?} is not nearest to {value:?}"))
}

/// Whether √v is rounded to x ≥ 0.
fn is_between_halves<F: Float>(x: F, v: &BigRational) -> bool {
    let Some(exact) = x.exactly() else {
        return false;
    };
    let to = |neighbour: F| Some(square(&((&exact + neighbour.exactly()?) / ratio(2, 1))));
    let upper = to(x.up()).unwrap_or_else(|| square(&edge::<F>()));
    let below_upper = *v < upper || (*v == upper && x.is_even());
    // Nothing lies below zero.
    let above_lower = exact.is_zero()
        || to(x.down()).is_some_and(|lower| lower < *v || (lower == *v && x.is_even()));
    below_upper && above_lower
}

/// The point from which on values round to infinity: half a step beyond the largest float.
fn edge<F: Float>() -> BigRational {
    let [last, before] = [F::LARGEST, F::LARGEST.down()].map(|x| x.exactly().unwrap_or_default());
    &last + (&last - before) / ratio(2, 1)
}

fn square(x: &BigRational) -> BigRational {
    x * x
}

#[cfg(test)]
mod planted {
    use super::*;
    use crate::generators::number::{exactly, power};

    fn rounds_to(got: Option<f64>, value: &Value) -> bool {
        is_nearest(got, value).is_ok()
    }

    #[test]
    fn the_next_float_is_caught() {
        for (c, r) in [(1, 2), (-7, 3), (1, 1_000_003)] {
            let value = Value::root(&ratio(c, 1), &ratio(r, 1));
            let x = Surd::new(ratio(c, 1), ratio(r, 1)).unwrap().nearest();
            let x: f64 = x.unwrap();
            assert!(rounds_to(Some(x), &value));
            for wrong in [x.next_up(), x.next_down(), -x, f64::INFINITY, f64::NAN] {
                assert!(!rounds_to(Some(wrong), &value), "{wrong} for {value:?}");
            }
            assert!(!rounds_to(None, &value));
        }
    }

    #[test]
    fn a_tie_to_odd_is_caught() {
        let tie = (exactly(1.0) + exactly(1.0_f64.next_up())) / ratio(2, 1);
        let value = Value::root(&tie, &ratio(1, 1));
        assert!(rounds_to(Some(1.0), &value));
        assert!(!rounds_to(Some(1.0_f64.next_up()), &value));
        let above = Value::root(&(tie + power(2, -300)), &ratio(1, 1));
        assert!(!rounds_to(Some(1.0), &above));
    }

    #[test]
    fn a_float_at_the_wrong_side_of_infinity_is_caught() {
        let largest = Value::root(&exactly(f64::MAX), &ratio(1, 1));
        let beyond = Value::root(&power(2, 1024), &ratio(1, 1));
        let [finite, infinite] = [Some(f64::MAX), None];
        assert!(rounds_to(finite, &largest) && !rounds_to(infinite, &largest));
        assert!(rounds_to(infinite, &beyond) && !rounds_to(finite, &beyond));
    }

    #[test]
    fn a_subnormal_flushed_to_zero_is_caught() {
        let least = Value::root(&exactly(f64::from_bits(1)), &ratio(1, 1));
        assert!(rounds_to(Some(f64::from_bits(1)), &least));
        assert!(!rounds_to(Some(0.0), &least));
    }
}
