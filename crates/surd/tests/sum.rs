//! Sums of two surds, against comparisons by squares alone.

use std::cmp::Ordering;

use exact_surd::num_bigint::{BigInt, Sign};
use exact_surd::num_rational::BigRational;
use exact_surd::{Surd, SurdSum};

fn ratio(n: i64, d: i64) -> BigRational {
    BigRational::new(n.into(), d.into())
}

fn surd(n: i64, d: i64, radicand: i64) -> Surd {
    Surd::new(ratio(n, d), ratio(radicand, 1)).unwrap()
}

/// Compares a + b with x: the sign of b − (x − a), by squares.
fn compare(a: &Surd, b: &Surd, x: &BigRational) -> Ordering {
    let rest = Surd::from(x.clone()).cmp(a);
    let own = b.cmp(&Surd::zero());
    if own != rest {
        return own.cmp(&rest);
    }
    // b² − x² − a² against −2xa.
    let squares = b.square() - x * x - a.square();
    let squares = Surd::from(squares).cmp(&a.scaled(&(x * ratio(-2, 1))));
    match own {
        Ordering::Less => squares.reverse(),
        _ => squares,
    }
}

fn rational(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

/// Checks that no other `f64` is closer, that the sum compares with it exactly, and the rounding to `f32`.
fn check(a: &Surd, b: &Surd) {
    let sum = SurdSum::new(a.clone(), b.clone());
    let nearest: f64 = sum.nearest().unwrap();
    let middle = |other: f64| (rational(nearest) + rational(other)) * ratio(1, 2);
    let [below, above] = [nearest.next_down(), nearest.next_up()];
    assert_ne!(compare(a, b, &middle(below)), Ordering::Less, "{sum}");
    assert_ne!(compare(a, b, &middle(above)), Ordering::Greater, "{sum}");
    for x in [below, nearest, above, 0.0, -1.5] {
        assert_eq!(sum.partial_cmp(&x), Some(compare(a, b, &rational(x))));
    }
    let sign = match compare(a, b, &ratio(0, 1)) {
        Ordering::Less => Sign::Minus,
        Ordering::Equal => Sign::NoSign,
        Ordering::Greater => Sign::Plus,
    };
    assert_eq!(sum.sign(), sign, "{sum}");
    assert_eq!(nearest.is_sign_negative(), sign == Sign::Minus, "{sum}");
    let single: f32 = sum.nearest().unwrap();
    let [below, above] = [single.next_down(), single.next_up()]
        .map(|other| (rational(single.into()) + rational(other.into())) * ratio(1, 2));
    assert_ne!(compare(a, b, &below), Ordering::Less, "{sum}");
    assert_ne!(compare(a, b, &above), Ordering::Greater, "{sum}");
}

#[test]
fn sums_round_correctly() {
    let numbers = [-7, -3, -1, 0, 1, 2, 5];
    for a in numbers {
        for b in numbers {
            for (m, n) in [(1, 2), (2, 3), (2, 8), (3, 4), (39, 3), (1, 1), (12, 27)] {
                check(&surd(a, 3, m), &surd(b, 7, n));
                check(&surd(a, 1_000_003, m), &surd(b, 1, n));
            }
        }
    }
}

#[test]
fn differences_of_close_roots_round_correctly() {
    // √(n² + 1) − n, about 1/(2n), down to the subnormals.
    for digits in [1, 8, 17, 60, 150, 307, 310, 322, 323, 400, 700] {
        let n = BigInt::from(10).pow(digits) + 7;
        let root = Surd::sqrt(BigRational::from_integer(&n * &n + 1)).unwrap();
        let n = Surd::from(BigRational::from_integer(n));
        check(&root, &-n.clone());
        check(&-root, &n);
    }
}

#[test]
fn terms_with_one_root_are_one_term() {
    let sum = SurdSum::new(surd(1, 2, 2), surd(1, 3, 18));
    assert_eq!(sum.to_surd(), Some(&surd(3, 2, 2)));
    assert_eq!(
        SurdSum::new(surd(1, 1, 5), surd(-1, 1, 5)).sign(),
        Sign::NoSign
    );
    // 1009² is a square that is not extracted from a product.
    let hidden = 1009_i64 * 1009;
    let product = Surd::sqrt(ratio(hidden * 1013, 1)).unwrap();
    let root = surd(1, 1, 1013);
    assert_eq!(product.checked_add(&root), Some(surd(1010, 1, 1013)));
    assert_eq!(root.checked_add(&product), Some(surd(1010, 1, 1013)));
    let zero = SurdSum::new(product, surd(-1009, 1, 1013));
    assert_eq!(
        (zero.sign(), zero.to_string()),
        (Sign::NoSign, "0".to_owned())
    );
}

#[test]
fn equal_sums_have_equal_terms() {
    let [a, b] = [surd(5, 6, 3), surd(-1, 6, 39)];
    let sum = SurdSum::new(a.clone(), b.clone());
    assert_eq!(sum, SurdSum::new(b, a));
    // tan(θ/2) times its reciprocal 1/sinθ + cosθ/sinθ: (5/6·√3)² − (1/6·√39)² = 1.
    let root = surd(1, 1, 3);
    let product = sum.clone() * &root;
    assert_eq!(product.to_string(), "5/2-1/2*sqrt(13)");
    assert_eq!(product * &root * &Surd::from(ratio(1, 3)), sum);
}

#[test]
fn sums_beyond_the_floats_overflow() {
    let huge = Surd::from(BigRational::from_integer(BigInt::from(10).pow(400)));
    let sum = SurdSum::new(huge, surd(1, 1, 2));
    assert_eq!(sum.nearest::<f64>(), None);
    assert_eq!(sum.partial_cmp(&f64::MAX), Some(Ordering::Greater));
    assert_eq!(sum.partial_cmp(&f64::INFINITY), Some(Ordering::Less));
    assert_eq!(sum.partial_cmp(&f64::NAN), None);
}

#[test]
fn sums_are_written_with_both_terms() {
    let sum = SurdSum::new(surd(1, 2, 2), surd(-1, 1, 3));
    assert_eq!(sum.to_string(), "-sqrt(3)+1/2*sqrt(2)");
    assert_eq!(format!("{sum:>25}|"), "     -sqrt(3)+1/2*sqrt(2)|");
    let other = SurdSum::new(surd(1, 2, 2), surd(1, 1, 3));
    assert_eq!(format!("{other:+}"), "+sqrt(3)+1/2*sqrt(2)");
    assert_eq!(SurdSum::from(surd(1, 1, 3)).to_string(), "sqrt(3)");
}
