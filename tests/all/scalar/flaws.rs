//! For every law of scalars a scalar that breaks it, and is caught.

mod flawed;

use std::collections::BTreeSet;

use self::flawed::{Fault, Flawed, flawed};
use crate::support::answers::ratio;
use cannonpile::scalar::{Enclosure, Exactness, NearestFloat, RealSign, laws};
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::{One, Signed, Zero};

/// The laws that the suite says are broken.
fn broken<F: Fault>() -> BTreeSet<&'static str> {
    let numbers = [
        (0, 1),
        (1, 1),
        (-1, 1),
        (2, 1),
        (-2, 3),
        (7, 5),
        (1, 10),
        (i64::MAX, 1),
    ];
    let numbers = numbers.map(|(n, d)| ratio(n, d));
    let mut verdicts = vec![laws::integers::<Flawed<F>>(1 << 70)];
    for x in &numbers {
        for y in &numbers {
            verdicts.push(laws::embedding::<Flawed<F>>(x, y));
            verdicts.push(laws::numerators::<Flawed<F>>(x, y));
            for z in &numbers {
                let [a, b, c] = [x, y, z].map(|number| flawed::<F>(number.clone()));
                verdicts.push(laws::algebra(&a, &b, &c));
            }
        }
    }
    verdicts
        .into_iter()
        .filter_map(|verdict| Some(verdict.err()?.law))
        .collect()
}

/// A fault, and a test that it breaks the law named.
macro_rules! caught {
    ($($name:ident breaks $law:literal: { $($fault:item)* })*) => {$(
        #[allow(non_camel_case_types, reason = "the fault and its test have one name")]
        #[derive(Clone, Debug, PartialEq)]
        struct $name {}

        impl Fault for $name {
            $($fault)*
        }

        #[test]
        fn $name() {
            let broken = broken::<$name>();
            assert!(broken.contains($law), "only {broken:?} found");
        }
    )*};
}

/// No fault: what the suite must not object to.
#[derive(Clone, Debug, PartialEq)]
struct Faultless;

impl Fault for Faultless {}

#[test]
fn right_arithmetic_is_left_alone() {
    assert!(broken::<Faultless>().is_empty());
}

caught! {
    order_of_sum breaks "a + b = b + a": {
        fn add(a: &Q, b: &Q) -> Q { if a > b { a + b + Q::one() } else { a + b } }
    }
    order_of_product breaks "a b = b a": {
        fn mul(a: &Q, b: &Q) -> Q { if a > b { a * b + Q::one() } else { a * b } }
    }
    zero_off breaks "a + 0 = a": {
        fn zero() -> Q { ratio(1, 1_000_000) }
    }
    one_off breaks "1 a = a": {
        fn one() -> Q { ratio(1_000_001, 1_000_000) }
    }
    zero_not_absorbing breaks "0 a = 0": {
        fn mul(a: &Q, b: &Q) -> Q { if (a + b).is_one() || !(a * b).is_zero() { a * b } else { a + b } }
    }
    nothing_left breaks "a - a = 0": {
        fn sub(a: &Q, b: &Q) -> Q { if a == b { ratio(1, 1_000_000) } else { a - b } }
    }
    difference_off breaks "a + (-b) = a - b": {
        fn sub(a: &Q, b: &Q) -> Q { if a == b { Q::zero() } else { b - a } }
    }
    negation_loses breaks "-(-a) = a": {
        fn neg(a: &Q) -> Q { -a.abs() }
    }
    saturation breaks "(a + b) + c = a + (b + c)": {
        fn add(a: &Q, b: &Q) -> Q { (a + b).min(ratio(i64::MAX, 1)) }
    }
    fixed_point breaks "(a b) c = a (b c)": {
        fn mul(a: &Q, b: &Q) -> Q { (a * b * ratio(1000, 1)).trunc() * ratio(1, 1000) }
    }
    product_of_magnitudes breaks "a (b + c) = a b + a c": {
        fn mul(a: &Q, b: &Q) -> Q { (a * b).abs() }
    }
    integer_division breaks "(a / n) n = a": {
        fn div_int(a: &Q, n: i64) -> Q { (a / BigInt::from(n)).trunc() }
    }
    truncated_image breaks "the image of x is x": {
        fn rational(r: &Q) -> Q { r.trunc() }
    }
    wrapping_sum breaks "a + b": {
        fn add(a: &Q, b: &Q) -> Q { wrapped(&(a + b)) }
        fn sub(a: &Q, b: &Q) -> Q { wrapped(&(a - b)) }
    }
    wrapping_difference breaks "a - b": {
        fn sub(a: &Q, b: &Q) -> Q { wrapped(&(a - b)) }
    }
    wrapping_product breaks "a b": {
        fn mul(a: &Q, b: &Q) -> Q { wrapped(&(a * b)) }
    }
    quotient_upside_down breaks "a / b": {
        fn div(a: &Q, b: &Q) -> Option<Q> { (!b.is_zero() && !a.is_zero()).then(|| b / a) }
    }
    division_by_zero breaks "a / b is undefined just for b = 0": {
        fn div(a: &Q, b: &Q) -> Option<Q> { Some(if b.is_zero() { Q::zero() } else { a / b }) }
    }
    division_by_magnitude breaks "a / n": {
        fn div_int(a: &Q, n: i64) -> Q { a / BigInt::from(n).abs() }
    }
    sign_of_zero breaks "the sign is that of the value": {
        fn sign(a: &Q) -> RealSign { if a.is_negative() { RealSign::Negative } else { RealSign::Positive } }
    }
    cast_to_64_bits breaks "n and n/1 have one image": {
        fn integer(n: i128) -> Q { wrapped(&Q::from_integer(n.into())) }
    }
    float_that_claims_to_be_exact breaks "(a + b) + c = a + (b + c)": {
        fn add(a: &Q, b: &Q) -> Q { double(&(a + b)) }
        fn sub(a: &Q, b: &Q) -> Q { double(&(a - b)) }
        fn mul(a: &Q, b: &Q) -> Q { double(&(a * b)) }
        fn rational(r: &Q) -> Q { double(r) }
    }
    single_that_claims_to_be_double breaks "a b": {
        const CLAIMS: Exactness = Exactness::Rounded { bits: 53 };
        fn mul(a: &Q, b: &Q) -> Q { single(&(a * b)) }
    }
    double_whose_great_products_are_single breaks "a b": {
        const CLAIMS: Exactness = Exactness::Rounded { bits: 53 };
        fn rational(r: &Q) -> Q { double(r) }
        fn mul(a: &Q, b: &Q) -> Q {
            if (a * b).abs() > ratio(1 << 40, 1) { single(&(a * b)) } else { double(&(a * b)) }
        }
    }
    sum_with_zero breaks "a + 0 = a": {
        fn add(a: &Q, b: &Q) -> Q { if a.is_zero() || b.is_zero() { a + b + Q::one() } else { a + b } }
    }
    division_by_minus_one breaks "(a / n) n = a": {
        fn div_int(a: &Q, n: i64) -> Q { if n == -1 { a.clone() } else { a / BigInt::from(n) } }
    }
    division_by_minus_seven breaks "(a / n) n = a": {
        fn div_int(a: &Q, n: i64) -> Q { if n == -7 { a / BigInt::from(7) } else { a / BigInt::from(n) } }
    }
    division_by_two breaks "(a / n) n = a": {
        fn div_int(a: &Q, n: i64) -> Q { if n == 2 { a.clone() } else { a / BigInt::from(n) } }
    }
    division_by_three breaks "(a / n) n = a": {
        fn div_int(a: &Q, n: i64) -> Q { if n == 3 { a.clone() } else { a / BigInt::from(n) } }
    }
    division_by_the_least_integer breaks "(a / n) n = a": {
        fn div_int(a: &Q, n: i64) -> Q { if n == i64::MIN { a.clone() } else { a / BigInt::from(n) } }
    }
    saturation_in_place_of_a_fault breaks "(a + b) + c = a + (b + c)": {
        const CLAIMS: Exactness = Exactness::ExactOrFault;
        fn add(a: &Q, b: &Q) -> Q { (a + b).min(ratio(i64::MAX, 1)) }
    }
    fault_in_place_of_an_integer breaks "n and n/1 have one image": {
        const CLAIMS: Exactness = Exactness::ExactOrFault;
        fn integer(n: i128) -> Q { i64::try_from(n).map_or(fault(), |n| ratio(n, 1)) }
        fn is_defined(a: &Q) -> bool { *a != fault() }
    }
    division_refused breaks "a / b is undefined just for b = 0": {
        fn div(a: &Q, b: &Q) -> Option<Q> { b.is_positive().then(|| a / b) }
    }
    bounds_beside_the_sum breaks "a + b": {
        const CLAIMS: Exactness = Exactness::Enclosure;
        fn add(a: &Q, b: &Q) -> Q { a + b + ratio(1, 100) }
        fn enclosure(a: &Q) -> Enclosure {
            let hair = ratio(1, 1_000_000);
            Enclosure { lower: a - &hair, upper: a + hair }
        }
    }
    sign_of_bounds breaks "the sign is that of the value": {
        const CLAIMS: Exactness = Exactness::Enclosure;
        fn sign(a: &Q) -> RealSign { if a.is_negative() { RealSign::Positive } else { RealSign::Negative } }
    }
    denominator_left_out breaks "n / d is the value": {
        fn ratio(n: &Q, d: &Q) -> Option<Q> { (!d.is_zero()).then(|| n + d) }
    }
}

#[test]
fn what_is_broken_is_said() {
    let broken = laws::integers::<Flawed<cast_to_64_bits>>(1 << 70).unwrap_err();
    let says = "Flawed breaks n and n/1 have one image: 1180591620717411303424: ";
    assert!(broken.to_string().starts_with(says), "{broken}");
}

/// No value of its own, but a number that stands for none.
fn fault() -> Q {
    ratio(1, 1_000_003)
}

/// A numerator that wraps around like an `i64`.
fn wrapped(r: &Q) -> Q {
    let (half, whole) = (BigInt::one() << 63, BigInt::one() << 64);
    let shifted: BigInt = (r.numer() + &half) % &whole;
    let shifted = if shifted.is_negative() {
        shifted + whole
    } else {
        shifted
    };
    Q::new(shifted - half, r.denom().clone())
}

fn double(r: &Q) -> Q {
    f64::nearest_to_rational(r)
        .and_then(Q::from_float)
        .expect("in range")
}

fn single(r: &Q) -> Q {
    f32::nearest_to_rational(r)
        .and_then(Q::from_float)
        .expect("in range")
}
