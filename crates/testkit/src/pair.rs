//! Two scalars in parallel, to find the first operation at which they differ.

use core::fmt;
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use crate::real::{Bounded, Enclosure};
use cannonpile::scalar::{Algebra, Exactness, Field, Ring};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

/// The first operation after which two scalars represented different numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Divergence {
    /// The operation, such as `a * b`.
    pub operation: &'static str,
    /// The value in each scalar.
    pub values: String,
}

impl fmt::Display for Divergence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} gave {}", self.operation, self.values)
    }
}

/// A scalar with division whose values are real numbers.
pub trait Real: Field + Bounded {}

impl<T: Field + Bounded> Real for T {}

/// Runs every operation in two scalars and records the first at which they differ.
///
/// Two values *differ* if their enclosures are disjoint. The enclosure of a rounded scalar of p bits is first widened by
/// 2^(−p/2) of its value, so a difference means that half of its digits are wrong. Two values also differ if one is
/// undefined. Every operation keeps the record, so a check of the result covers a whole computation.
#[derive(Clone, Debug)]
pub struct Pair<A, B> {
    first: A,
    second: B,
    divergence: Option<Box<Divergence>>,
}

impl<A: Real, B: Real> Pair<A, B> {
    /// Two values that should be the same number.
    pub fn new(first: A, second: B) -> Self {
        Self {
            first,
            second,
            divergence: None,
        }
        .checked("a value")
    }

    /// The value in the first scalar.
    pub fn first(&self) -> &A {
        &self.first
    }

    /// The value in the second scalar.
    pub fn second(&self) -> &B {
        &self.second
    }

    /// The first operation at which the two scalars differed.
    pub fn divergence(&self) -> Option<&Divergence> {
        self.divergence.as_deref()
    }

    /// Records a difference unless there already is one.
    fn checked(mut self, operation: &'static str) -> Self {
        if self.divergence.is_none() && !may_be_equal(&self.first, &self.second) {
            let values = format!("{:?} and {:?}", self.first, self.second);
            self.divergence = Some(Box::new(Divergence { operation, values }));
        }
        self
    }

    fn combined(
        self,
        rhs: &Self,
        operation: &'static str,
        first: impl FnOnce(A, &A) -> A,
        second: impl FnOnce(B, &B) -> B,
    ) -> Self {
        let result = Self {
            first: first(self.first, &rhs.first),
            second: second(self.second, &rhs.second),
            divergence: self.divergence.or_else(|| rhs.divergence.clone()),
        };
        result.checked(operation)
    }
}

/// Tells whether two values may be the same number, as far as their scalars can decide.
fn may_be_equal<A: Real, B: Real>(a: &A, b: &B) -> bool {
    match (widened(a), widened(b)) {
        (Some(a), Some(b)) => a.lower <= b.upper && b.lower <= a.upper,
        // An enclosure without finite bounds contains every number.
        _ => a.is_defined() && b.is_defined(),
    }
}

fn widened<T: Algebra + Bounded>(value: &T) -> Option<Enclosure> {
    let Enclosure { lower, upper } = value.enclosure()?;
    let Exactness::Rounded { bits } = T::EXACTNESS else {
        return Some(Enclosure { lower, upper });
    };
    let slack = |end: &BigRational| end.abs() / (BigInt::one() << (bits / 2));
    Some(Enclosure {
        lower: &lower - slack(&lower),
        upper: &upper + slack(&upper),
    })
}

impl<A: PartialEq, B: PartialEq> PartialEq for Pair<A, B> {
    fn eq(&self, other: &Self) -> bool {
        self.first == other.first && self.second == other.second
    }
}

macro_rules! operators {
    ($($operation:ident $method:ident $text:literal),*) => {$(
        impl<A: Real, B: Real> $operation<&Self> for Pair<A, B> {
            type Output = Self;

            fn $method(self, rhs: &Self) -> Self {
                self.combined(rhs, $text, |a, b| a.$method(b), |a, b| a.$method(b))
            }
        }
    )*};
}

operators!(Add add "a + b", Sub sub "a - b", Mul mul "a * b");

cannonpile::by_value!([A: Real, B: Real] Pair<A, B>);

impl<A: Real, B: Real> Neg for Pair<A, B> {
    type Output = Self;

    fn neg(self) -> Self {
        let negated = Self {
            first: -self.first,
            second: -self.second,
            divergence: self.divergence,
        };
        negated.checked("-a")
    }
}

impl<A: Real, B: Real> Zero for Pair<A, B> {
    fn zero() -> Self {
        Self::new(A::zero(), B::zero())
    }

    fn is_zero(&self) -> bool {
        self.first.is_zero() && self.second.is_zero()
    }
}

impl<A: Real, B: Real> One for Pair<A, B> {
    fn one() -> Self {
        Self::new(A::one(), B::one())
    }
}

impl<A: Real, B: Real> Ring for Pair<A, B> {
    fn from_integer(n: i128) -> Self {
        Self::new(A::from_integer(n), B::from_integer(n))
    }
}

impl<A: Real, B: Real> Algebra for Pair<A, B> {
    /// The weaker of the two scalars.
    const EXACTNESS: Exactness = weaker(A::EXACTNESS, B::EXACTNESS);
    const NAME: &'static str = "Pair";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        Self::new(A::from_rational(r), B::from_rational(r))
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        let quotient = Self {
            first: self.first.div_int(n),
            second: self.second.div_int(n),
            divergence: self.divergence,
        };
        quotient.checked("a / n")
    }

    fn is_defined(&self) -> bool {
        self.first.is_defined() && self.second.is_defined()
    }

    /// `None` if either scalar cannot divide.
    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        let quotient = Self {
            first: self.first.checked_div(&divisor.first)?,
            second: self.second.checked_div(&divisor.second)?,
            divergence: self
                .divergence
                .clone()
                .or_else(|| divisor.divergence.clone()),
        };
        Some(quotient.checked("a / b"))
    }
}

impl<A: Real, B: Real> Field for Pair<A, B> {}

impl<A: Real, B: Real> Bounded for Pair<A, B> {
    /// The enclosure of the first scalar, because this type checks the second. `None` if either value is undefined.
    fn enclosure(&self) -> Option<Enclosure> {
        self.is_defined().then(|| self.first.enclosure())?
    }

    /// Where one of the scalars is an interval, the bounds of both, since either may contain zero.
    fn bounds(&self) -> Option<[BigRational; 2]> {
        let Enclosure { lower, upper } = self.enclosure()?;
        if Self::EXACTNESS != Exactness::Enclosure {
            return Some([lower, upper]);
        }
        let second = self.second.enclosure()?;
        Some([lower.min(second.lower), upper.max(second.upper)])
    }
}

/// Returns the exactness of a computation that uses two scalar types.
pub const fn weaker(one: Exactness, other: Exactness) -> Exactness {
    use Exactness::{Enclosure, Exact, Rounded, Unknown};
    match (one, other) {
        (Unknown, _) | (_, Unknown) => Unknown,
        (Rounded { bits: a }, Rounded { bits: b }) if b < a => other,
        (Rounded { .. }, _) => one,
        (_, Rounded { .. }) => other,
        (Enclosure, _) | (_, Exact) => one,
        _ => other,
    }
}
