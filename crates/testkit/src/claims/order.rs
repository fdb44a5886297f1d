//! Roots compare, multiply and print as their squares and signs require.

use core::cmp::Ordering;

use arbitrary::Unstructured;
use cannonpile::scalar::Surd;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::{Checked, demand, same};
use crate::generators::number::{self, ratio};

/// Represents c·√r by c²r with the sign of c. The square root preserves the order.
type SignedSquare = BigRational;

/// Checks two roots, their product and inverse, and a float.
pub fn of_two_roots(u: &mut Unstructured<'_>) -> Checked {
    let (c, r) = number::root(u)?;
    // Often the same value in another form: √(4r) = 2√r.
    let (d, s) = if u.arbitrary()? {
        (&c / ratio(2, 1), &r * ratio(4, 1))
    } else {
        number::root(u)?
    };
    let (x, y) = (
        Surd::new(c.clone(), r.clone())?,
        Surd::new(d.clone(), s.clone())?,
    );
    let (v, w) = (signed_square(&c, &r), signed_square(&d, &s));
    is_ordered(x.cmp(&y), &v, &w)?;
    same("equality", &(x == y), &(v == w))?;

    let product = x.clone() * &y;
    same("the product", &square_of(&product), &(&v * &w))?;
    match x.checked_recip() {
        Some(inverse) => same("the inverse", &square_of(&inverse), &v.recip())?,
        None => same("a value without inverse", &v, &BigRational::zero())?,
    }
    same("the negative", &square_of(&-x.clone()), &-&v)?;
    same("the scaled root", &x.scaled(&d), &Surd::new(c * &d, r)?)?;

    let float = number::float(u)?;
    let exact = number::exactly(float);
    let ordering = x.partial_cmp(&float);
    is_ordered(
        ordering.unwrap_or(Ordering::Equal),
        &v,
        &signed_square(&exact, &ratio(1, 1)),
    )?;
    demand(x.partial_cmp(&f64::NAN).is_none(), || {
        "a root compares with not-a-number".into()
    })
}

/// A rational root is recognised as rational, and its form is in lowest terms.
pub fn of_a_square(u: &mut Unstructured<'_>) -> Checked {
    let r = number::rational(u)?;
    let root = Surd::sqrt(&r * &r)?;
    same("√(r²)", &root.to_rational(), &Some(r.abs()))?;
    same("√(r²) in print", &root.to_string(), &r.abs().to_string())
}

fn signed_square(c: &BigRational, r: &BigRational) -> SignedSquare {
    c * c.abs() * r
}

/// The signed square of a surd, from its parts.
fn square_of(x: &Surd) -> SignedSquare {
    let radicand = BigRational::from_integer(x.radicand().clone().into());
    signed_square(x.coefficient(), &radicand)
}

/// The order of two values is that of their signed squares.
fn is_ordered(got: Ordering, v: &SignedSquare, w: &SignedSquare) -> Checked {
    demand(got == v.cmp(w), || {
        format!("{got:?} is not the order of the squares {v} and {w}")
    })
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::generators::number::power;

    #[test]
    fn an_order_without_signs_is_caught() {
        let (v, w) = (ratio(-2, 1), ratio(1, 1));
        assert!(is_ordered(Ordering::Less, &v, &w).is_ok());
        assert!(is_ordered(v.abs().cmp(&w.abs()), &v, &w).is_err());
    }

    #[test]
    fn an_order_of_floats_is_caught() {
        // √2 and a root that rounds to the same float.
        let (v, w) = (ratio(2, 1), ratio(2, 1) + power(2, -200));
        assert!(is_ordered(Ordering::Less, &v, &w).is_ok());
        assert!(is_ordered(Ordering::Equal, &v, &w).is_err());
    }
}
