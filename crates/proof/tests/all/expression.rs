//! Evaluation, printing and comparison of expressions.

use core::num::NonZeroI64;

use cannonpile::scalar::{Algebra, Symbol};
use cannonpile_proof::Expression;
use num_rational::BigRational;
use num_traits::{One, Zero};

use cannonpile_testkit::answers::ratio;

fn symbols() -> [Expression; 2] {
    ["x", "y"].map(|name| Symbol(name).into())
}

fn number(n: i64, d: i64) -> Expression {
    Expression::from_rational(&ratio(n, d))
}

fn over(dividend: Expression, n: i64) -> Expression {
    dividend.div_int(NonZeroI64::new(n).unwrap())
}

#[test]
fn operations_evaluate() {
    let [x, y] = symbols();
    let values = [(Symbol("x"), ratio(3, 2)), (Symbol("y"), ratio(-5, 7))];
    for (expression, value) in [
        (x.clone(), ratio(3, 2)),
        (number(2, 9), ratio(2, 9)),
        (-y.clone(), ratio(5, 7)),
        (x.clone() + &y, ratio(11, 14)),
        (x.clone() - &y, ratio(31, 14)),
        (x.clone() * &y, ratio(-15, 14)),
        (x.clone() + y.clone(), ratio(11, 14)),
        (x.clone() * y.clone(), ratio(-15, 14)),
        (over(x.clone(), -4), ratio(-3, 8)),
        (over(x.clone() + &x, 3) - &(y.clone() * &y), ratio(24, 49)),
    ] {
        assert_eq!(
            expression.evaluate(&values),
            Ok(Some(value)),
            "{expression}"
        );
    }
    let floats = [(Symbol("x"), 1.5), (Symbol("y"), -0.25)];
    assert_eq!((x.clone() * &x + &y).evaluate(&floats), Ok(Some(2.0)));
    // A symbol without a value.
    assert_eq!((x + &y).evaluate(&values[..1]), Ok(None));
}

#[test]
fn brackets_are_minimal() {
    let [x, y] = symbols();
    let sum = || x.clone() + &y;
    for (expression, text) in [
        (sum() + &x, "x + y + x"),
        (x.clone() + &sum(), "x + (x + y)"),
        (x.clone() - &sum(), "x - (x + y)"),
        (sum() - &x, "x + y - x"),
        (sum() * &y, "(x + y) * y"),
        (x.clone() * &y * &x, "x * y * x"),
        (x.clone() * &(y.clone() * &x), "x * (y * x)"),
        (x.clone() * &y + &x, "x * y + x"),
        (x.clone() + &(x.clone() * &y), "x + x * y"),
        (-x.clone(), "-x"),
        (-sum(), "-(x + y)"),
        (over(sum(), 2), "(x + y) / 2"),
        (over(x.clone(), -2), "x / (-2)"),
        (number(2, 3) * &x, "2/3 * x"),
        (x.clone() * &number(2, 3), "x * (2/3)"),
        (number(-2, 1) * &x, "(-2) * x"),
        (number(5, 1) * &x, "5 * x"),
    ] {
        assert_eq!(expression.to_string(), text);
        assert_eq!(format!("{expression:?}"), text);
    }
}

#[test]
fn equal_polynomials_are_equal_expressions() {
    let [x, y] = symbols();
    assert_eq!(x.clone() + &y, y.clone() + &x);
    assert_eq!(over(x.clone() + &x, 2), x);
    assert_ne!(x, y);
    assert!((x.clone() - &x).is_zero() && Expression::zero().is_zero());
    assert!(!x.is_zero() && !Expression::one().is_zero());
    assert!(x.is_defined() && Expression::zero().is_defined());
}

#[test]
fn division_needs_nonzero_constant() {
    let [x, y] = symbols();
    let quotient = |d: &Expression| x.checked_div(d);
    assert_eq!(quotient(&number(-4, 3)), Some(number(-3, 4) * &x));
    assert_eq!(quotient(&Expression::one()).unwrap().to_string(), "x");
    assert_eq!(quotient(&(y.clone() - &y)), None);
    assert_eq!(quotient(&y), None);
    let undefined = BigRational::new_raw(1.into(), 0.into());
    assert!(!Expression::from_rational(&undefined).is_defined());
    let third = x.clone().div_int(NonZeroI64::new(3).unwrap());
    assert_eq!(third.to_string(), "x / 3");
    let values = [(Symbol("x"), ratio(8, 1))];
    let value: Option<BigRational> = quotient(&number(4, 1)).unwrap().evaluate(&values).unwrap();
    assert_eq!(value, Some(ratio(2, 1)));
}
