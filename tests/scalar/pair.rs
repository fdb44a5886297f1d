//! Two scalars in parallel. The pair reports exactly the first operation at which they differ.

use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use cannonpile::Pile;
use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::{Algebra, DoubleDouble, Exactness, Field, FixedRational, Interval, Ring};
use cannonpile::shape::Selection;
use cannonpile_testkit::real::{Bounded, Enclosure};
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::{One, Pow, Zero};

use cannonpile_testkit::pair::Pair;
use cannonpile_testkit::rational::ratio;

/// The operation of [`Faulty`] that is wrong.
const SUM: u8 = 0;
const DIFFERENCE: u8 = 1;
const PRODUCT: u8 = 2;
const NEGATION: u8 = 3;
const QUOTIENT: u8 = 4;
const QUOTIENT_BY_INTEGER: u8 = 5;
const IMAGE: u8 = 6;

/// A rational with one wrong operation, whose result is too great by a thousandth.
#[derive(Clone, Debug, PartialEq)]
struct Faulty<const WRONG: u8>(Q);

impl<const WRONG: u8> Faulty<WRONG> {
    fn result_of(operation: u8, value: Q) -> Self {
        Self(if operation == WRONG {
            value * ratio(1001, 1000)
        } else {
            value
        })
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $number:ident;)*) => {$(
        impl<const WRONG: u8> $operator<&Self> for Faulty<WRONG> {
            type Output = Self;

            fn $method(self, rhs: &Self) -> Self {
                Self::result_of($number, self.0.$method(&rhs.0))
            }
        }

        impl<const WRONG: u8> $operator for Faulty<WRONG> {
            type Output = Self;

            fn $method(self, rhs: Self) -> Self {
                self.$method(&rhs)
            }
        }
    )*};
}

operators! { Add add SUM; Sub sub DIFFERENCE; Mul mul PRODUCT; }

impl<const WRONG: u8> Neg for Faulty<WRONG> {
    type Output = Self;

    fn neg(self) -> Self {
        Self::result_of(NEGATION, -self.0)
    }
}

impl<const WRONG: u8> Zero for Faulty<WRONG> {
    fn zero() -> Self {
        Self(Q::zero())
    }

    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl<const WRONG: u8> One for Faulty<WRONG> {
    fn one() -> Self {
        Self(Q::one())
    }
}

impl<const WRONG: u8> Ring for Faulty<WRONG> {
    fn from_integer(n: i128) -> Self {
        Self(Q::from_integer(n.into()))
    }
}

impl<const WRONG: u8> Algebra for Faulty<WRONG> {
    const EXACTNESS: Exactness = Exactness::Exact;
    const NAME: &'static str = "Faulty";
    type Numerator = Self;

    fn from_rational(r: &Q) -> Self {
        Self::result_of(IMAGE, r.clone())
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        Self::result_of(QUOTIENT_BY_INTEGER, self.0.div_int(n))
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        let quotient = self.0.checked_div(&divisor.0)?;
        Some(Self::result_of(QUOTIENT, quotient))
    }

    fn is_defined(&self) -> bool {
        true
    }
}

impl<const WRONG: u8> Field for Faulty<WRONG> {}

impl<const WRONG: u8> Bounded for Faulty<WRONG> {
    fn enclosure(&self) -> Option<Enclosure> {
        self.0.enclosure()
    }
}

/// The operation at which a pair first differed.
fn first_difference<A, B>(pair: &Pair<A, B>) -> Option<&'static str>
where
    A: Field + Bounded,
    B: Field + Bounded,
{
    pair.divergence().map(|divergence| divergence.operation)
}

/// Every kind of operation in one computation.
fn compute<B: Field + Bounded>() -> Pair<Q, B> {
    type Both<B> = Pair<Q, B>;
    let (seven, three) = (Both::<B>::from_integer(7), Both::<B>::from_integer(3));
    let image = Both::from_rational(&ratio(22, 7));
    let sum = seven + &image;
    let product = (-sum) * &three;
    let quotient = product.checked_div(&image).expect("not zero");
    quotient.div_int(5.try_into().expect("5")) - &three
}

#[test]
fn each_operation_is_named() {
    assert_eq!(first_difference(&compute::<Q>()), None);
    assert_eq!(first_difference(&compute::<Faulty<SUM>>()), Some("a + b"));
    assert_eq!(
        first_difference(&compute::<Faulty<DIFFERENCE>>()),
        Some("a - b")
    );
    assert_eq!(
        first_difference(&compute::<Faulty<PRODUCT>>()),
        Some("a * b")
    );
    assert_eq!(first_difference(&compute::<Faulty<NEGATION>>()), Some("-a"));
    assert_eq!(
        first_difference(&compute::<Faulty<QUOTIENT>>()),
        Some("a / b")
    );
    assert_eq!(
        first_difference(&compute::<Faulty<QUOTIENT_BY_INTEGER>>()),
        Some("a / n")
    );
    assert_eq!(
        first_difference(&compute::<Faulty<IMAGE>>()),
        Some("a value")
    );
    for clean in [
        first_difference(&compute::<f64>()),
        first_difference(&compute::<Interval>()),
        first_difference(&compute::<DoubleDouble>()),
        first_difference(&compute::<FixedRational<i64>>()),
    ] {
        assert_eq!(clean, None);
    }
}

#[test]
fn the_first_difference_is_kept() {
    type Checked = Pair<Q, f64>;
    let big = Checked::from_integer(10_i128.pow(20));
    let lost = big.clone() + &Checked::one() - &big;
    let first = lost.divergence().expect("1 is rounded away").clone();
    assert_eq!(first.operation, "a - b");
    assert_eq!(
        first.to_string(),
        format!("a - b gave {:?} and 0.0", ratio(1, 1))
    );
    // Undefined in `f64`, which is another kind of difference.
    let overflow =
        big.clone() * &Checked::from_rational(&Q::from_integer(BigInt::from(10).pow(300_u32)));
    assert_eq!(first_difference(&overflow), Some("a * b"));
    assert!(!overflow.is_defined());

    let clean = Checked::from_integer(3);
    let later = [
        lost.clone() + &clean,
        clean.clone() - &lost,
        lost.clone() * &big,
        -lost.clone(),
        lost.clone().div_int(7.try_into().expect("7")),
        lost.checked_div(&clean).expect("not zero"),
        clean.clone() + lost.clone() * lost.clone(),
    ];
    for result in later {
        assert_eq!(result.divergence(), Some(&first));
    }
    // If both operands have a record, the result keeps one and adds none.
    let both = lost.clone() + &overflow;
    assert_eq!(both.divergence(), Some(&first));
    assert_eq!(
        (overflow - &lost)
            .divergence()
            .map(|divergence| divergence.operation),
        Some("a * b")
    );
    // The record remains even if the values agree again.
    let equal_again = lost * &Checked::zero();
    assert_eq!(
        (equal_again.first(), equal_again.divergence()),
        (&Q::zero(), Some(&first))
    );
}

/// Adds powers of two and subtracts all but the first. Returns the operation at which the pair first differed.
fn difference<B: Field + Bounded>(exponents: &[u32]) -> Option<&'static str> {
    let power = |e: &u32| Pair::<Q, B>::from_rational(&Q::from_integer(BigInt::from(2).pow(*e)));
    let sum = exponents
        .iter()
        .fold(Pair::zero(), |sum, e| sum + &power(e));
    first_difference(
        &exponents
            .iter()
            .skip(1)
            .rev()
            .fold(sum, |sum, e| sum - &power(e)),
    )
}

/// A scalar of p bits differs if half of them are wrong. One with more digits differs later.
#[test]
fn rounded_values_may_differ_by_half_their_digits() {
    for (error, operation) in [(-26, None), (-25, Some("a value"))] {
        let near = Pair::new(Q::one(), 1.0 + 2.0_f64.powi(error));
        assert_eq!(first_difference(&near), operation);
    }
    let long = [0, 80, 160];
    assert_eq!(difference::<f64>(&long[..2]), Some("a - b"));
    assert_eq!(difference::<DoubleDouble>(&long[..2]), None);
    assert_eq!(difference::<DoubleDouble>(&long), Some("a - b"));
    assert_eq!(
        difference::<FixedRational<i64>>(&long[..2]),
        Some("a value")
    );
    assert_eq!(difference::<FixedRational<i128>>(&long[..2]), None);
    // An interval becomes wide instead.
    assert_eq!(difference::<Interval>(&long), None);
}

#[test]
fn an_overflow_is_a_difference() {
    type Checked = Pair<Q, FixedRational<i64>>;
    let big = Checked::from_integer(i128::from(i64::MAX));
    assert_eq!(first_difference(&big), None);
    let fault = big.clone() + &Checked::one();
    assert_eq!(first_difference(&fault), Some("a + b"));
    assert!(
        fault
            .divergence()
            .expect("a difference")
            .values
            .ends_with("overflow")
    );
    assert_eq!(fault.enclosure(), None);
    // A quotient is missing if either scalar cannot divide.
    assert!(big.checked_div(&fault).is_none() && big.checked_div(&Checked::zero()).is_none());
    let around_zero = Pair::new(Q::one(), Interval::new(-1.0, 1.0).expect("an interval"));
    assert_eq!(around_zero.checked_div(&around_zero), None);
    assert_eq!(around_zero.enclosure(), Some(Enclosure::point(Q::one())));
}

/// All answers about a pile in a pair of scalars, each with the exact answer.
fn answers<B: Field + Bounded>(pile: &Pile) -> Vec<(Pair<Q, B>, Q)> {
    let (pairs, exact) = (pile.forces::<Pair<Q, B>>(), pile.forces::<Q>());
    let mut all = vec![(
        pairs.increment_sum().expect("W"),
        exact.increment_sum().expect("W"),
    )];
    macro_rules! ask {
        ($query:ident($($argument:expr),*) $(. $part:ident())?) => {
            let (pair, number) = (pairs.$query($($argument),*), exact.$query($($argument),*));
            let both = pair.expect("an answer")$(.$part())?.into_iter().zip(number.expect("an answer")$(.$part())?);
            all.extend(both);
        };
    }
    for site in pile.shape().sites() {
        ask!(from_above(site));
        ask!(position(site).into_array());
        ask!(resultant_above(site).into_array());
        if site.k < pile.layers() - 1 {
            ask!(unbalanced(site).into_array());
            for direction in pile.dimension().directions() {
                ask!(contact_vector(site, *direction).into_array());
            }
        }
    }
    for direction in Direction::ALL {
        ask!(direction(direction).into_array());
    }
    let part = Selection::All;
    let contacts = pairs.contacts(part).expect("a plan");
    for (pair, number) in contacts.zip(exact.contacts(part).expect("a plan")) {
        all.push((pair.expect("a force").force, number.expect("a force").force));
    }
    let part = Selection::Base;
    let base = pairs.base(part).expect("a plan");
    for (pair, number) in base.zip(exact.base(part).expect("a plan")) {
        let (pair, number) = (pair.expect("a force"), number.expect("a force"));
        all.push((pair.normal, number.normal));
        all.push((pair.shear_x, number.shear_x));
        all.push((pair.shear_y, number.shear_y));
    }
    all
}

fn piles() -> Vec<Pile> {
    let isosceles = |l| [(1, 2), (1, 3), (7, 9)].map(|(n, d)| Pile::isosceles(l, ratio(n, d)));
    let of_layers = |l| isosceles(l).into_iter().chain([Pile::discs(l)]);
    (1..=5)
        .flat_map(of_layers)
        .map(|pile| pile.expect("a pile"))
        .collect()
}

#[test]
fn statics_agree() {
    for pile in piles() {
        for (pair, exact) in answers::<Interval>(&pile) {
            assert_eq!((pair.divergence(), pair.first()), (None, &exact));
            assert!(pair.second().contains(&exact));
        }
        for (pair, exact) in answers::<FixedRational<i64>>(&pile) {
            assert_eq!(
                (pair.divergence(), pair.second().to_rational()),
                (None, Some(exact))
            );
        }
    }
}

#[test]
fn statics_in_a_wrong_scalar_differ() {
    let pile = Pile::isosceles(4, ratio(1, 3)).expect("a pile");
    let partings = |all: Vec<Option<&'static str>>| all.into_iter().flatten().collect::<Vec<_>>();
    let sums = answers::<Faulty<SUM>>(&pile);
    let sums = partings(
        sums.iter()
            .map(|(pair, _)| first_difference(pair))
            .collect(),
    );
    let products = answers::<Faulty<PRODUCT>>(&pile);
    let products = partings(
        products
            .iter()
            .map(|(pair, _)| first_difference(pair))
            .collect(),
    );
    for (operations, operation) in [(sums, "a + b"), (products, "a * b")] {
        assert!(operations.len() > 100 && operations.iter().all(|name| *name == operation));
    }
    let site = Site { i: 1, j: 0, k: 2 };
    let force = pile
        .forces::<Pair<Q, Faulty<IMAGE>>>()
        .contact(site, Direction::Gamma);
    assert_eq!(first_difference(&force.expect("a force")), Some("a value"));
}
