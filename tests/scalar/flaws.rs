//! For every law of scalars, a scalar that breaks it. The suite must detect it.

mod flawed;

use std::collections::BTreeSet;

use self::flawed::{
    Claim, Double, Enclosed, Exact, ExactOrFault, Flawed, Operations, flawed, from_now_on,
};
use cannonpile::scalar::{CorrectlyRounded, laws};
use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::real::{Bounded, Enclosure};
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::{One, Signed, Zero};

/// The laws that the suite reports as broken, for a scalar with these operations and this claim of exactness.
fn broken<C: Claim>(operations: Operations) -> BTreeSet<&'static str> {
    from_now_on(operations);
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
    let mut verdicts = vec![laws::integers::<Flawed<C>>(1 << 70)];
    for x in &numbers {
        for y in &numbers {
            verdicts.push(laws::embedding(x, y, Flawed::<C>::bounds));
            verdicts.push(laws::numerators::<Flawed<C>>(x, y));
            for z in &numbers {
                let [a, b, c] = [x, y, z].map(|number| flawed::<C>(number.clone()));
                verdicts.push(laws::algebra(&a, &b, &c));
            }
        }
    }
    verdicts
        .into_iter()
        .filter_map(|verdict| Some(verdict.err()?.law))
        .collect()
}

/// Declares a test for each fault, which checks that the fault breaks the named law.
macro_rules! breaks_laws {
    (of $claim:ident: $($name:ident breaks $law:literal: { $($fault:tt)* })*) => {$(
        #[test]
        fn $name() {
            let broken = broken::<$claim>(Operations { $($fault)* ..Operations::RIGHT });
            assert!(broken.contains($law), "only {broken:?} found");
        }
    )*};
}

#[test]
fn correct_arithmetic_breaks_no_law() {
    assert!(broken::<Exact>(Operations::RIGHT).is_empty());
}

breaks_laws! {
    of Exact:
    order_of_sum breaks "a + b = b + a": {
        add: |a, b| if a > b { a + b + Q::one() } else { a + b },
    }
    order_of_product breaks "a b = b a": {
        mul: |a, b| if a > b { a * b + Q::one() } else { a * b },
    }
    zero_off breaks "a + 0 = a": {
        zero: || ratio(1, 1_000_000),
    }
    one_off breaks "1 a = a": {
        one: || ratio(1_000_001, 1_000_000),
    }
    zero_not_absorbing breaks "0 a = 0": {
        mul: |a, b| if (a + b).is_one() || !(a * b).is_zero() { a * b } else { a + b },
    }
    nothing_left breaks "a - a = 0": {
        sub: |a, b| if a == b { ratio(1, 1_000_000) } else { a - b },
    }
    difference_off breaks "a + (-b) = a - b": {
        sub: |a, b| if a == b { Q::zero() } else { b - a },
    }
    negation_loses breaks "-(-a) = a": {
        neg: |a| -a.abs(),
    }
    saturation breaks "(a + b) + c = a + (b + c)": {
        add: |a, b| (a + b).min(ratio(i64::MAX, 1)),
    }
    fixed_point breaks "(a b) c = a (b c)": {
        mul: |a, b| (a * b * ratio(1000, 1)).trunc() * ratio(1, 1000),
    }
    product_of_magnitudes breaks "a (b + c) = a b + a c": {
        mul: |a, b| (a * b).abs(),
    }
    integer_division breaks "(a / n) n = a": {
        div_int: |a, n| (a / BigInt::from(n)).trunc(),
    }
    truncated_image breaks "the image of x is x": {
        rational: |r| r.trunc(),
    }
    wrapping_sum breaks "a + b": {
        add: |a, b| wrapped(&(a + b)),
        sub: |a, b| wrapped(&(a - b)),
    }
    wrapping_difference breaks "a - b": {
        sub: |a, b| wrapped(&(a - b)),
    }
    wrapping_product breaks "a b": {
        mul: |a, b| wrapped(&(a * b)),
    }
    quotient_upside_down breaks "a / b": {
        div: |a, b| (!b.is_zero() && !a.is_zero()).then(|| b / a),
    }
    division_by_zero breaks "a / b is undefined just for b = 0": {
        div: |a, b| Some(if b.is_zero() { Q::zero() } else { a / b }),
    }
    division_by_magnitude breaks "a / n": {
        div_int: |a, n| a / BigInt::from(n).abs(),
    }
    cast_to_64_bits breaks "n and n/1 have one image": {
        integer: |n| wrapped(&Q::from_integer(n.into())),
    }
    float_that_claims_to_be_exact breaks "(a + b) + c = a + (b + c)": {
        add: |a, b| double(&(a + b)),
        sub: |a, b| double(&(a - b)),
        mul: |a, b| double(&(a * b)),
        rational: |r| double(r),
    }
    sum_with_zero breaks "a + 0 = a": {
        add: |a, b| if a.is_zero() || b.is_zero() { a + b + Q::one() } else { a + b },
    }
    division_by_minus_one breaks "(a / n) n = a": {
        div_int: |a, n| if n == -1 { a.clone() } else { a / BigInt::from(n) },
    }
    division_by_minus_seven breaks "(a / n) n = a": {
        div_int: |a, n| if n == -7 { a / BigInt::from(7) } else { a / BigInt::from(n) },
    }
    division_by_two breaks "(a / n) n = a": {
        div_int: |a, n| if n == 2 { a.clone() } else { a / BigInt::from(n) },
    }
    division_by_three breaks "(a / n) n = a": {
        div_int: |a, n| if n == 3 { a.clone() } else { a / BigInt::from(n) },
    }
    division_by_the_least_integer breaks "(a / n) n = a": {
        div_int: |a, n| if n == i64::MIN { a.clone() } else { a / BigInt::from(n) },
    }
    division_refused breaks "a / b is undefined just for b = 0": {
        div: |a, b| b.is_positive().then(|| a / b),
    }
    denominator_added breaks "n / d is the value": {
        div: |n, d| (!d.is_zero()).then(|| n + d),
    }
}

breaks_laws! {
    of Double:
    single_that_claims_to_be_double breaks "a b": {
        mul: |a, b| single(&(a * b)),
    }
    double_whose_great_products_are_single breaks "a b": {
        rational: |r| double(r),
        mul: |a, b| {
            if (a * b).abs() > ratio(1 << 40, 1) { single(&(a * b)) } else { double(&(a * b)) }
        },
    }
}

breaks_laws! {
    of ExactOrFault:
    saturation_in_place_of_a_fault breaks "(a + b) + c = a + (b + c)": {
        add: |a, b| (a + b).min(ratio(i64::MAX, 1)),
    }
    fault_in_place_of_an_integer breaks "n and n/1 have one image": {
        integer: |n| i64::try_from(n).map_or(fault(), |n| ratio(n, 1)),
        is_defined: |a| *a != fault(),
    }
}

breaks_laws! {
    of Enclosed:
    bounds_that_miss_the_sum breaks "a + b": {
        add: |a, b| a + b + ratio(1, 100),
        enclosure: |a| {
            let hair = ratio(1, 1_000_000);
            Enclosure { lower: a - &hair, upper: a + hair }
        },
    }
}

#[test]
fn the_error_names_the_law_and_the_operands() {
    from_now_on(Operations {
        integer: |n| wrapped(&Q::from_integer(n.into())),
        ..Operations::RIGHT
    });
    let broken = laws::integers::<Flawed<Exact>>(1 << 70).unwrap_err();
    let says = "Flawed breaks n and n/1 have one image: 1180591620717411303424: ";
    assert!(broken.to_string().starts_with(says), "{broken}");
}

/// A special value that represents a fault.
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
