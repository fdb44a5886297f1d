//! A scalar that is exact except for one fault.

use core::cell::Cell;
use core::fmt::Debug;
use core::marker::PhantomData;
use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use cannonpile::scalar::{Algebra, Exactness, Field, Ring};
use cannonpile_testkit::real::{Bounded, Enclosure};
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::{One, Zero};

/// The operations of a scalar.
#[derive(Clone, Copy)]
pub(crate) struct Operations {
    pub(crate) zero: fn() -> Q,
    pub(crate) one: fn() -> Q,
    pub(crate) add: fn(&Q, &Q) -> Q,
    pub(crate) sub: fn(&Q, &Q) -> Q,
    pub(crate) mul: fn(&Q, &Q) -> Q,
    pub(crate) neg: fn(&Q) -> Q,
    pub(crate) integer: fn(i128) -> Q,
    pub(crate) rational: fn(&Q) -> Q,
    pub(crate) div_int: fn(&Q, i64) -> Q,
    pub(crate) div: fn(&Q, &Q) -> Option<Q>,
    pub(crate) is_defined: fn(&Q) -> bool,
    pub(crate) enclosure: fn(&Q) -> Enclosure,
}

impl Operations {
    /// The correct operations.
    pub(crate) const RIGHT: Self = Self {
        zero: Q::zero,
        one: Q::one,
        add: |a, b| a + b,
        sub: |a, b| a - b,
        mul: |a, b| a * b,
        neg: |a| -a,
        integer: |n| Q::from_integer(n.into()),
        rational: Q::clone,
        div_int: |a, n| a / BigInt::from(n),
        div: |a, b| (!b.is_zero()).then(|| a / b),
        is_defined: |_| true,
        enclosure: |a| Enclosure::point(a.clone()),
    };
}

thread_local! {
    /// The operations of all flawed values on this thread. A test has one fault at a time, so the laws are compiled once for
    /// all faults.
    static OPERATIONS: Cell<Operations> = const { Cell::new(Operations::RIGHT) };
}

/// Sets the operations of the flawed values on this thread.
pub(crate) fn from_now_on(operations: Operations) {
    OPERATIONS.set(operations);
}

fn operations() -> Operations {
    OPERATIONS.get()
}

/// The exactness that a flawed scalar claims.
pub(crate) trait Claim: Clone + Debug + PartialEq + Send + Sync + 'static {
    const EXACTNESS: Exactness;
}

macro_rules! claims {
    ($($name:ident = $exactness:expr;)*) => {$(
        #[derive(Clone, Debug, PartialEq)]
        pub(crate) struct $name;

        impl Claim for $name {
            const EXACTNESS: Exactness = $exactness;
        }
    )*};
}
claims! {
    Exact = Exactness::Exact;
    Double = Exactness::Rounded { bits: 53 };
    ExactOrFault = Exactness::ExactOrFault;
    Enclosed = Exactness::Enclosure;
}

/// A rational with the operations that were last set on this thread.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Flawed<C>(Q, PhantomData<C>);

/// A value of the flawed scalar.
pub(crate) fn flawed<C>(value: Q) -> Flawed<C> {
    Flawed(value, PhantomData)
}

impl<C: Claim> Add<&Self> for Flawed<C> {
    type Output = Self;

    fn add(self, rhs: &Self) -> Self {
        flawed((operations().add)(&self.0, &rhs.0))
    }
}

impl<C: Claim> Sub<&Self> for Flawed<C> {
    type Output = Self;

    fn sub(self, rhs: &Self) -> Self {
        flawed((operations().sub)(&self.0, &rhs.0))
    }
}

impl<C: Claim> Mul<&Self> for Flawed<C> {
    type Output = Self;

    fn mul(self, rhs: &Self) -> Self {
        flawed((operations().mul)(&self.0, &rhs.0))
    }
}

cannonpile::by_value!([C: Claim] Flawed<C>);

impl<C: Claim> Neg for Flawed<C> {
    type Output = Self;

    fn neg(self) -> Self {
        flawed((operations().neg)(&self.0))
    }
}

impl<C: Claim> Zero for Flawed<C> {
    fn zero() -> Self {
        flawed((operations().zero)())
    }

    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl<C: Claim> One for Flawed<C> {
    fn one() -> Self {
        flawed((operations().one)())
    }
}

impl<C: Claim> Ring for Flawed<C> {
    fn from_integer(n: i128) -> Self {
        flawed((operations().integer)(n))
    }
}

impl<C: Claim> Algebra for Flawed<C> {
    const EXACTNESS: Exactness = C::EXACTNESS;
    const NAME: &'static str = "Flawed";
    type Numerator = Self;

    fn from_rational(r: &Q) -> Self {
        flawed((operations().rational)(r))
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        flawed((operations().div_int)(&self.0, n.get()))
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        (operations().div)(&self.0, &divisor.0).map(flawed)
    }

    fn is_defined(&self) -> bool {
        (operations().is_defined)(&self.0)
    }
}

impl<C: Claim> Field for Flawed<C> {}

impl<C: Claim> Bounded for Flawed<C> {
    fn enclosure(&self) -> Option<Enclosure> {
        Some((operations().enclosure)(&self.0))
    }
}
