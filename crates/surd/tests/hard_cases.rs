//! Numbers that are hard to round, with floats of an independent implementation.
//!
//! `hard_cases.txt` lists each number as printed, and the bits of its `f64` and `f32`. `peers/surd.py` recomputes the floats
//! with python-flint. Other implementations may read the file too.

use exact_surd::num_bigint::Sign;
use exact_surd::{CorrectlyRounded, Surd, SurdSum};

const CASES: &str = include_str!("hard_cases.txt");

/// A number and the bits of its floats.
struct Case {
    number: &'static str,
    double: u64,
    single: u32,
}

fn cases() -> impl Iterator<Item = Case> {
    let lines = CASES
        .lines()
        .filter(|line| !line.starts_with('#') && !line.is_empty());
    lines.map(|line| {
        let columns: Vec<&str> = line.split(' ').collect();
        let [number, double, single] = columns[..] else {
            panic!("{line} has other columns");
        };
        Case {
            number,
            double: u64::from_str_radix(double, 16).unwrap(),
            single: u32::from_str_radix(single, 16).unwrap(),
        }
    })
}

/// Returns the terms of a number as printed, as one surd or two.
fn terms(number: &str) -> Vec<Surd> {
    let parse = |text: &str| text.parse().unwrap();
    match number[1..].rfind(['+', '-']) {
        None => vec![parse(number)],
        Some(at) => {
            let (first, second) = number.split_at(at + 1);
            let second = second.strip_prefix('+').unwrap_or(second);
            vec![parse(first), parse(second)]
        }
    }
}

/// Returns the bits of both floats. An overflow is an infinity.
fn bits(negative: bool, double: Option<f64>, single: Option<f32>) -> (u64, u32) {
    let sign = if negative { -1.0_f32 } else { 1.0 };
    let double = double.unwrap_or(f64::INFINITY * f64::from(sign));
    let single = single.unwrap_or(f32::INFINITY * sign);
    (double.to_bits(), single.to_bits())
}

#[test]
fn hard_cases_round_correctly() {
    let (mut surds, mut sums) = (0, 0);
    for Case {
        number,
        double,
        single,
    } in cases()
    {
        let terms = terms(number);
        if let [surd] = &terms[..] {
            surds += 1;
            assert_eq!(surd.to_string(), number);
            let negative = surd.sign() == Sign::Minus;
            let got = bits(negative, surd.nearest(), surd.nearest());
            assert_eq!(got, (double, single), "{number}");
            assert_eq!(surd.to_f64().to_bits(), double, "{number}");
            if let Some(rational) = surd.to_rational() {
                let got = bits(
                    negative,
                    f64::nearest_to_rational(&rational),
                    f32::nearest_to_rational(&rational),
                );
                assert_eq!(got, (double, single), "{number}");
            }
            // The same number as a sum with zero.
            let sum = SurdSum::new(Surd::zero(), surd.clone());
            assert_eq!(
                bits(negative, sum.nearest(), sum.nearest()),
                (double, single),
                "{number}"
            );
        } else {
            sums += 1;
            let [one, other] = <[Surd; 2]>::try_from(terms).unwrap();
            let sum = SurdSum::new(other, one);
            assert_eq!(sum.to_string(), number);
            let negative = sum.sign() == Sign::Minus;
            assert_eq!(
                bits(negative, sum.nearest(), sum.nearest()),
                (double, single),
                "{number}"
            );
        }
    }
    assert!(surds > 250 && sums > 60, "{surds} surds and {sums} sums");
}

/// The number lies between both neighbours of its float. Only `peers/surd.py` finds a wrong last digit of a long number.
#[test]
fn hard_cases_compare_with_their_floats() {
    for Case { number, double, .. } in cases() {
        let [one, other] = match &terms(number)[..] {
            [one] => [one.clone(), Surd::zero()],
            [one, other] => [one.clone(), other.clone()],
            _ => panic!("{number} has more terms"),
        };
        let sum = SurdSum::new(one, other);
        let float = f64::from_bits(double);
        // The neighbour of an infinity is on one side only.
        for neighbour in [float.next_down(), float.next_up()]
            .into_iter()
            .filter(|x| x.to_bits() != float.to_bits())
        {
            let order = sum.partial_cmp(&neighbour).unwrap();
            assert_eq!(
                order,
                float.partial_cmp(&neighbour).unwrap(),
                "{number} {neighbour:e}"
            );
        }
    }
}

/// More than a third of the cases are out of reach of `f64`, and one in eight fails if it is rounded to `f64` first and then
/// to `f32`.
#[test]
fn hard_cases_are_hard() {
    let (mut twice, mut in_floats, mut all) = (0, 0, 0);
    for Case {
        number,
        double,
        single,
    } in cases()
    {
        all += 1;
        #[expect(
            clippy::cast_possible_truncation,
            reason = "double rounding is the error under test"
        )]
        let rounded_twice = f64::from_bits(double) as f32;
        twice += i32::from(rounded_twice.to_bits() != single);
        let terms = terms(number);
        let float = |surd: &Surd| {
            let c = surd.coefficient();
            let part = |n: &num_bigint::BigInt| num_traits::ToPrimitive::to_f64(n).unwrap();
            let radicand = num_traits::ToPrimitive::to_f64(surd.radicand()).unwrap();
            part(c.numer()) / part(c.denom()) * radicand.sqrt()
        };
        let sum: f64 = terms.iter().map(float).sum();
        in_floats += i32::from(sum.to_bits() != double);
    }
    assert!(
        twice > 40 && in_floats > 120,
        "{twice} and {in_floats} of {all}"
    );
}
