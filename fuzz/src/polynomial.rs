//! Operations on polynomials agree with those on their values: arithmetic, division, sums.
//!
//! The oracle is a list of terms, with repeated and cancelling ones, evaluated at rational points.

use core::num::NonZeroI64;

use arbitrary::{Result, Unstructured};
use cannonpile::scalar::{Algebra, Polynomial, Symbol};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Pow, Zero};

use cannonpile_testkit::generators::{number, rarely};

const SYMBOLS: [Symbol; 3] = [Symbol("x"), Symbol("y"), Symbol("z")];

type Point = [BigRational; 3];

/// Checks all claims on polynomials generated from the bytes.
///
/// # Errors
/// There are too few bytes.
///
/// # Panics
/// A claim fails.
pub fn polynomial(data: &mut Unstructured<'_>) -> Result<()> {
    let (f, g) = (Terms::arbitrary(data)?, Terms::arbitrary(data)?);
    arithmetic(&f, &g, &point(data)?, data)?;
    substitution(&f, &g, &point(data)?, data.choose_index(3)?);
    division(&f, &g, &Terms::arbitrary(data)?);
    sums(&f, data)
}

/// A list of terms c · x^a y^b z^c.
#[derive(Debug)]
struct Terms(Vec<(BigRational, [u32; 3])>);

impl Terms {
    fn arbitrary(u: &mut Unstructured<'_>) -> Result<Self> {
        let count = u.int_in_range(0..=4)?;
        let terms = (0..count).map(|_| {
            let mut powers = [0; 3];
            for power in &mut powers {
                *power = u.int_in_range(0..=3)?;
            }
            Ok((number::rational(u)?, powers))
        });
        terms.collect::<Result<_>>().map(Self)
    }

    fn build(&self) -> Polynomial {
        sum_of(self.0.iter())
    }

    fn value(&self, point: &Point) -> BigRational {
        let term = |(coefficient, powers): &(BigRational, [u32; 3])| {
            let factors = point
                .iter()
                .zip(powers)
                .map(|(x, power)| Pow::pow(x, *power));
            factors.fold(coefficient.clone(), |product, factor| product * factor)
        };
        self.0.iter().map(term).sum()
    }
}

fn sum_of<'a>(terms: impl Iterator<Item = &'a (BigRational, [u32; 3])>) -> Polynomial {
    terms.fold(Polynomial::zero(), |sum, (coefficient, powers)| {
        let mut term = Polynomial::constant(coefficient);
        for (symbol, power) in SYMBOLS.into_iter().zip(powers) {
            for _ in 0..*power {
                term = term * &Polynomial::from(symbol);
            }
        }
        sum + &term
    })
}

/// Generates a point with small coordinates, some of them arbitrary rationals instead.
fn point(u: &mut Unstructured<'_>) -> Result<Point> {
    let mut coordinate = || {
        if rarely(u, 8)? {
            number::rational(u)
        } else {
            Ok(number::ratio(
                u.int_in_range(-9..=9)?,
                u.int_in_range(1..=5)?,
            ))
        }
    };
    Ok([coordinate()?, coordinate()?, coordinate()?])
}

fn value(p: &Polynomial, point: &Point) -> BigRational {
    let values: Vec<_> = SYMBOLS.into_iter().zip(point.clone()).collect();
    p.evaluate(&values).expect("a value for every symbol")
}

/// Evaluation commutes with every operation, and equal polynomials have the same form.
fn arithmetic(f: &Terms, g: &Terms, point: &Point, u: &mut Unstructured<'_>) -> Result<()> {
    let (p, q) = (f.build(), g.build());
    let (a, b) = (f.value(point), g.value(point));
    assert_eq!(value(&p, point), a, "{f:?}");
    assert_eq!(value(&(p.clone() + &q), point), &a + &b, "{f:?} + {g:?}");
    assert_eq!(value(&(p.clone() - &q), point), &a - &b, "{f:?} - {g:?}");
    assert_eq!(value(&(p.clone() * &q), point), &a * &b, "{f:?} * {g:?}");
    assert_eq!(value(&-p.clone(), point), -&a, "-{f:?}");
    if let Some(n) = NonZeroI64::new(u.arbitrary()?) {
        let quotient = value(&p.clone().div_int(n), point);
        assert_eq!(quotient, a / BigInt::from(n.get()), "{f:?} / {n}");
    }
    assert_eq!(sum_of(f.0.iter().rev()), p);
    assert_eq!(p.clone() + &q - &q, p);
    let square = (p.clone() + &q) * &(p.clone() - &q);
    assert_eq!(square, p.clone() * &p - &(q.clone() * &q));
    assert_eq!(p.is_zero(), p.to_string() == "0");
    Ok(())
}

/// Evaluating f(g) at a point equals evaluating f at the value of g.
fn substitution(f: &Terms, g: &Terms, point: &Point, which: usize) {
    let symbol = SYMBOLS[which];
    let composed = f.build().substitute(symbol, &g.build());
    let mut moved = point.clone();
    moved[which] = g.value(point);
    assert_eq!(
        value(&composed, point),
        f.value(&moved),
        "{symbol:?} = {g:?} in {f:?}"
    );
}

/// A product is divisible by its factors. Any other exact quotient times the divisor equals the dividend.
fn division(f: &Terms, g: &Terms, rest: &Terms) {
    let (quotient, divisor, rest) = (f.build(), g.build(), rest.build());
    let product = quotient.clone() * &divisor;
    if divisor.is_zero() {
        assert_eq!(product.divide_exactly(&divisor), None);
        return;
    }
    assert_eq!(
        product.divide_exactly(&divisor),
        Some(quotient),
        "{f:?} * {g:?}"
    );
    let lower = rest.degree() < divisor.degree();
    let sum = product + &rest;
    let found = sum.divide_exactly(&divisor);
    if lower {
        assert_eq!(found.is_some(), rest.is_zero(), "{f:?} * {g:?} + {rest}");
    }
    if let Some(found) = found {
        assert_eq!(found * &divisor, sum);
    }
}

/// A sum in closed form equals the sum of its terms, for numeric and polynomial bounds.
fn sums(f: &Terms, u: &mut Unstructured<'_>) -> Result<()> {
    let (p, [x, _, _]) = (f.build(), SYMBOLS);
    let [a, b, c, d, at_x, at_y] = {
        let mut small = || u.int_in_range(-4..=4_i64);
        [small()?, small()?, small()?, small()?, small()?, small()?]
    };
    // Σ over x from ax + b to cy + d. The x in the lower bound is free: it is not the summation variable.
    let line = |slope: i64, symbol, height: i64| {
        Polynomial::from(symbol) * &Polynomial::constant(&number::ratio(slope, 1))
            + &Polynomial::constant(&number::ratio(height, 1))
    };
    let sum = p.sum(x, &line(a, x, b), &line(c, SYMBOLS[1], d));
    let (from, to) = (a * at_x + b, c * at_y + d);
    let point = |x: i64| {
        [
            number::ratio(x, 1),
            number::ratio(at_y, 1),
            number::ratio(2, 3),
        ]
    };
    let forwards: BigRational = (from..=to).map(|x| f.value(&point(x))).sum();
    let backwards: BigRational = (to + 1..from).map(|x| f.value(&point(x))).sum();
    assert_eq!(
        value(&sum, &point(at_x)),
        forwards - backwards,
        "{f:?}: {from} … {to}"
    );

    // Σ from x+1 to x is empty, and Σ of one term equals the term.
    let next = line(1, x, 1);
    assert!(p.sum(x, &next, &Polynomial::from(x)).is_zero());
    assert_eq!(
        p.sum(x, &Polynomial::one(), &Polynomial::one()),
        p.substitute(x, &Polynomial::one())
    );
    Ok(())
}
