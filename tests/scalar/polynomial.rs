//! Polynomials form a ring with a canonical form. Their values at numbers equal direct computations.

use core::num::NonZeroI64;

use cannonpile::scalar::{Algebra, Polynomial, Symbol, laws};
use cannonpile_testkit::rational::ratio;
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::{One, Pow, Zero};

type P = Polynomial;

const NAMES: [&str; 4] = ["x", "y", "z", "w"];

fn symbols() -> [P; 4] {
    NAMES.map(|name| Symbol(name).into())
}

fn constant(n: i64, d: i64) -> P {
    P::constant(&ratio(n, d))
}

/// Random bits that are the same in every run (xorshift).
struct Random(u64);

impl Random {
    fn below(&mut self, n: u32) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        u32::try_from(self.0 >> 40).expect("24 bits") % n
    }

    /// Small, or of about a hundred bits.
    fn rational(&mut self) -> Q {
        let long = BigInt::from(3).pow(self.below(100));
        let n = i64::from(self.below(19)) - 9;
        let short = ratio(n, i64::from(self.below(6)) + 1);
        match self.below(4) {
            0 => short * long,
            1 => short / long,
            _ => short,
        }
    }

    fn point(&mut self) -> [Q; 4] {
        [0; 4].map(|_| self.rational())
    }

    /// Up to four terms in the first `symbols` symbols, of degree at most three in each.
    fn naive(&mut self, symbols: usize) -> Naive {
        let terms = (0..self.below(5)).map(|_| {
            let mut powers = [0; 4];
            powers
                .iter_mut()
                .take(symbols)
                .for_each(|power| *power = self.below(4));
            (self.rational(), powers)
        });
        Naive(terms.collect())
    }
}

/// A polynomial by its terms, which may repeat, cancel or vanish.
#[derive(Clone, Debug)]
struct Naive(Vec<(Q, [u32; 4])>);

impl Naive {
    fn build(&self) -> P {
        self.0.iter().fold(P::zero(), |sum, (coefficient, powers)| {
            let factors = symbols().into_iter().zip(powers);
            let monomial = factors.fold(P::one(), |product, (x, power)| {
                (0..*power).fold(product, |product, _| product * &x)
            });
            sum + &(monomial * &P::constant(coefficient))
        })
    }

    fn value(&self, point: &[Q; 4]) -> Q {
        let term = |(coefficient, powers): &(Q, [u32; 4])| {
            let factors = point
                .iter()
                .zip(powers)
                .map(|(x, power)| Pow::pow(x, *power));
            factors.fold(coefficient.clone(), |product, factor| product * factor)
        };
        self.0.iter().map(term).sum()
    }

    /// The powers whose coefficients do not cancel.
    fn powers(&self) -> Vec<[u32; 4]> {
        let mut powers: Vec<_> = self.0.iter().map(|(_, powers)| *powers).collect();
        powers.sort_unstable();
        powers.dedup();
        let total = |of: &[u32; 4]| -> Q {
            self.0
                .iter()
                .filter(|(_, powers)| powers == of)
                .map(|(c, _)| c)
                .sum()
        };
        powers.retain(|powers| !total(powers).is_zero());
        powers
    }
}

fn at(point: &[Q; 4]) -> [(Symbol, Q); 4] {
    core::array::from_fn(|m| (Symbol(NAMES[m]), point[m].clone()))
}

fn value(p: &P, point: &[Q; 4]) -> Q {
    p.evaluate(&at(point)).expect("a value for every symbol")
}

#[test]
fn a_commutative_algebra() {
    let [x, y, z, w] = symbols();
    let long = Q::new(BigInt::from(3).pow(90_u32), BigInt::from(2).pow(80_u32));
    let operands = [
        P::zero(),
        P::one(),
        constant(-7, 3),
        P::constant(&long),
        x.clone(),
        x.clone() - &y,
        x.clone() * &x + &constant(1, 2),
        (y.clone() + &z).div_int(NonZeroI64::MAX),
        x.clone() * &y * &z - &(w.clone() * &P::constant(&long)),
        (x + &y + &z + &w) * &constant(6, 35),
    ];
    for a in &operands {
        for b in &operands {
            for c in &operands {
                assert_eq!(laws::algebra(a, b, c), Ok(()));
            }
        }
    }
    let mut random = Random(1);
    for symbols in [1, 2, 3, 4].repeat(50) {
        let [a, b, c] = [0; 3].map(|_| random.naive(symbols).build());
        assert_eq!(laws::algebra(&a, &b, &c), Ok(()));
    }
    for n in [0, 1, -1, i128::MIN, i128::MAX] {
        assert_eq!(laws::integers::<P>(n), Ok(()));
    }
}

/// Equal functions have one canonical form.
#[test]
fn equal_functions_have_one_form() {
    let [x, y, _, _] = symbols();
    let sum = x.clone() + &y;
    let square = sum.clone() * &sum;
    let term_by_term = y.clone() * &y + &(x.clone() * &x) + &(constant(2, 1) * &y * &x);
    let halves = sum.clone() * &constant(1, 2) * &(sum.clone() * &constant(2, 1));
    let difference = x.clone() - &y;
    let completed = difference.clone() * &difference + &(constant(4, 1) * &x * &y);
    for other in [
        term_by_term,
        halves,
        completed,
        square.substitute(Symbol("q"), &x),
    ] {
        assert_eq!(square, other);
        assert_eq!(square.to_string(), other.to_string());
    }
    let third =
        (x.clone() * &constant(2, 1) + &constant(4, 1)).div_int(NonZeroI64::new(6).expect("6"));
    assert_eq!(third, x.clone() * &constant(1, 3) + &constant(2, 3));
    assert_eq!(third.to_string(), "(x + 2)/3");
    let nothing = (square.clone() - &(x.clone() * &sum)) - &(y.clone() * &sum);
    assert!(nothing.is_zero() && nothing == P::zero());
    assert_eq!((nothing.degree(), nothing.symbols()), (0, vec![]));
    assert_eq!(nothing.to_constant(), Some(Q::zero()));
    assert_eq!(
        (x.clone() - &x + &constant(5, 7)).to_constant(),
        Some(ratio(5, 7))
    );
    assert_ne!(x, y);
    assert_ne!(x, P::one());
    assert_ne!(constant(1, 2) * &x, constant(1, 3) * &x);
}

#[test]
fn values_equal_direct_computations() {
    let mut random = Random(2);
    for symbols in [1, 2, 3, 4].repeat(250) {
        let [f, g] = [0; 2].map(|_| random.naive(symbols));
        let (p, q, point) = (f.build(), g.build(), random.point());
        let (a, b) = (f.value(&point), g.value(&point));
        assert_eq!(value(&p, &point), a, "{p}");
        assert_eq!(value(&(p.clone() + &q), &point), &a + &b);
        assert_eq!(value(&(p.clone() - &q), &point), &a - &b);
        assert_eq!(value(&(p.clone() * &q), &point), &a * &b);
        assert_eq!(value(&-p.clone(), &point), -&a);
        let n = [1, -1, 6, i64::MIN][usize::try_from(random.below(4)).expect("few")];
        let quotient = p.clone().div_int(NonZeroI64::new(n).expect("not zero"));
        assert_eq!(value(&quotient, &point), &a / BigInt::from(n));

        // Substitutes numbers one by one, another polynomial, and a symbol that does not occur.
        let mut number = p.clone();
        for (symbol, x) in at(&point) {
            number = number.substitute(symbol, &P::constant(&x));
        }
        assert_eq!(number.to_constant(), Some(a.clone()));
        let [_, y, z, w] = point.clone();
        let composed = p.substitute(Symbol("x"), &q);
        assert_eq!(value(&composed, &point), f.value(&[b, y, z, w]));
        assert_eq!(p.substitute(Symbol("v"), &q), p);
    }
}

#[test]
fn degrees_and_symbols() {
    let mut random = Random(3);
    for symbols in [1, 2, 3, 4].repeat(100) {
        let [f, g] = [0; 2].map(|_| random.naive(symbols));
        let (p, q, powers) = (f.build(), g.build(), f.powers());
        let degree = |of: &dyn Fn(&[u32; 4]) -> u32| powers.iter().map(of).max().unwrap_or(0);
        assert_eq!(p.degree(), u64::from(degree(&|powers| powers.iter().sum())));
        let mut occurring = Vec::new();
        for (m, name) in NAMES.into_iter().enumerate() {
            let in_symbol = degree(&|powers| powers[m]);
            assert_eq!(p.degree_in(Symbol(name)), in_symbol);
            occurring.extend((in_symbol > 0).then_some(Symbol(name)));
        }
        occurring.sort_unstable();
        assert_eq!(p.symbols(), occurring);
        assert_eq!(p.to_constant().is_some(), occurring.is_empty());
        assert_eq!(p.is_zero(), powers.is_empty());
        if !p.is_zero() && !q.is_zero() {
            assert_eq!((p.clone() * &q).degree(), p.degree() + q.degree());
        }
        // A value is required exactly if its symbol occurs.
        for m in 0..4 {
            let mut values = at(&random.point()).to_vec();
            let (missing, _) = values.remove(m);
            assert_eq!(p.evaluate(&values).is_none(), occurring.contains(&missing));
        }
    }
}

#[test]
fn division_is_exact_or_undefined() {
    let mut random = Random(4);
    for symbols in [1, 2, 3, 4].repeat(100) {
        let [q, d, r] = [0; 3].map(|_| random.naive(symbols).build());
        let p = q.clone() * &d;
        if d.is_zero() {
            assert_eq!(q.divide_exactly(&d), None);
            continue;
        }
        assert_eq!(p.divide_exactly(&d), Some(q.clone()), "{p} over {d}");
        assert_eq!(p.checked_div(&d), Some(q.clone()));
        assert_eq!(P::zero().divide_exactly(&d), Some(P::zero()));
        // A nonzero polynomial of lower degree is not a multiple of d.
        if r.degree() < d.degree() {
            assert_eq!(
                (p + &r).divide_exactly(&d).is_some(),
                r.is_zero(),
                "{r} over {d}"
            );
        }
        let c = P::constant(&(random.rational() * ratio(2, 1) + ratio(1, 1_000_003)));
        let quotient = q
            .divide_exactly(&c)
            .expect("a constant divides every polynomial");
        assert_eq!(quotient * &c, q);
    }
    let [x, y, _, _] = symbols();
    assert_eq!(P::zero().divide_exactly(&P::zero()), None);
    assert_eq!(x.divide_exactly(&y), None);
    assert_eq!(P::one().divide_exactly(&x), None);
    let (monomial, factor) = (x.clone() * &x * &y, x.clone() * &y);
    assert_eq!(monomial.divide_exactly(&factor), Some(x.clone()));
    assert_eq!((monomial + &y).divide_exactly(&factor), None);
}

/// New names in the reverse order change neither values nor quotients.
#[test]
fn names_do_not_matter() {
    const OTHERS: [&str; 4] = ["zz", "yy", "xx", "ww"];
    let rename = |p: &P| {
        NAMES
            .into_iter()
            .zip(OTHERS)
            .fold(p.clone(), |p, (name, other)| {
                p.substitute(Symbol(name), &Symbol(other).into())
            })
    };
    let mut random = Random(5);
    for _ in 0..100 {
        let [p, d] = [0; 2].map(|_| random.naive(4).build());
        let (renamed, divisor) = (rename(&p), rename(&d));
        assert_eq!(rename(&(p.clone() * &d)), renamed.clone() * &divisor);
        let product = p.clone() * &d + &p;
        let quotients = [
            product.divide_exactly(&d).map(|quotient| rename(&quotient)),
            rename(&product).divide_exactly(&divisor),
        ];
        assert_eq!(quotients[0], quotients[1]);
        let point = random.point();
        let named: Vec<_> = OTHERS
            .map(Symbol)
            .into_iter()
            .zip(point.clone())
            .rev()
            .collect();
        assert_eq!(renamed.evaluate(&named), Some(value(&p, &point)));
    }
}

#[test]
fn printed_form() {
    let [x, y, z, _] = symbols();
    let n = |n| constant(n, 1);
    let half = NonZeroI64::new(2).expect("2");
    let cases = [
        (P::zero(), "0"),
        (P::one(), "1"),
        (constant(-4, 6), "-2/3"),
        (-x.clone(), "-x"),
        (x.clone().div_int(half), "x/2"),
        (n(-3) * &x.clone().div_int(half), "-3 x/2"),
        (x.clone() - &P::one(), "x - 1"),
        (P::one() - &x, "-x + 1"),
        ((x.clone() + &P::one()).div_int(half), "(x + 1)/2"),
        (y.clone() * &x * &y * &n(2), "2 x y^2"),
        // By falling degree, then by falling powers of the first symbol.
        (z.clone() + &y + &x + &(z.clone() * &z), "z^2 + x + y + z"),
        (
            x.clone() * &y + &(x.clone() * &x) - &(y.clone() * &y),
            "x^2 + x y - y^2",
        ),
    ];
    for (polynomial, text) in cases {
        assert_eq!(polynomial.to_string(), text);
    }
}

/// 32 squarings exceed the degrees of a machine integer. The result is correct or undefined, and never wraps.
#[test]
fn high_degrees_do_not_wrap() {
    let [x, y, _, _] = symbols();
    let high = |symbol: &P, squarings| {
        (0..squarings).fold(symbol.clone(), |power, _| power.clone() * &power)
    };
    let product = high(&x, 31) * &high(&y, 31);
    assert_eq!(product.to_constant(), None);
    assert_ne!(high(&x, 32) * &x, x);
}

/// A power above 2³² − 1 is undefined.
#[test]
fn undefined_polynomials_are_never_equal() {
    let [x, y, _, _] = symbols();
    let power = (0..31).fold(x.clone(), |power, _| power.clone() * &power);
    let fault = power.clone() * &power;
    assert!(power.is_defined() && !fault.is_defined());
    assert!(fault != fault.clone() && fault != x && fault != P::zero() && P::zero() != fault);
    for sum in [
        fault.clone() + &x,
        x.clone() + &fault,
        x.clone() - &fault,
        -fault.clone(),
    ] {
        assert!(!sum.is_defined());
    }
    assert!(
        !(fault.clone() * &P::zero()).is_defined()
            && power.evaluate(&[(Symbol("x"), 1.0)]) == Some(1.0)
    );
    assert!(x != y && x != constant(1, 2) && constant(1, 2) != constant(1, 3));
    // Substituted for a missing symbol, and as a bound of a sum.
    let nothing = P::zero();
    for of_fault in [
        fault.substitute(Symbol("y"), &x),
        x.substitute(Symbol("y"), &fault),
        nothing.substitute(Symbol("x"), &fault),
        fault.sum(Symbol("y"), &nothing, &x),
        nothing.sum(Symbol("y"), &fault, &x),
        nothing.sum(Symbol("y"), &x, &fault),
    ] {
        assert!(!of_fault.is_defined());
    }
}

/// The square of one float overflows, although its term does not.
#[test]
fn terms_are_multiplied_one_by_one() {
    let [x, y, _, _] = symbols();
    let term = x * &y * &y;
    for (at_x, at_y, expected) in [(0.0, 1e200, 0.0), (1e300, 1e-200, 1e-100)] {
        let value: f64 = term
            .evaluate(&[(Symbol("x"), at_x), (Symbol("y"), at_y)])
            .expect("values");
        assert!((value - expected).abs() <= 1e-12 * expected, "{value}");
    }
}

/// Powers are evaluated without writing them out.
#[test]
fn the_greatest_powers_can_be_evaluated() {
    let [x, y, _, _] = symbols();
    let high = (0..31).fold(x.clone(), |power, _| power.clone() * &power) + &y;
    for (value, expected) in [(-1, 5), (0, 4), (1, 5)] {
        let at_point = high.substitute(Symbol("x"), &constant(value, 1));
        assert_eq!(at_point, y.clone() + &constant(i64::from(value != 0), 1));
        let values = [(Symbol("x"), ratio(value, 1)), (Symbol("y"), ratio(4, 1))];
        assert_eq!(high.evaluate(&values), Some(ratio(expected, 1)));
    }
    assert_eq!(high.substitute(Symbol("x"), &x), high);
    // x³ − y^(2³¹) x², where x is that power: (x − x) x². Its factor x² exceeds all powers.
    let power = high.clone() - &y;
    let power = power.substitute(Symbol("x"), &y);
    let cancels = x.clone() * &x * &x - &(power.clone() * &x * &x);
    assert_eq!(cancels.substitute(Symbol("x"), &power), P::zero());
    assert_eq!(
        high.substitute(Symbol("y"), &-(high.clone() - &y)),
        P::zero()
    );
}

#[test]
fn a_negative_denominator_is_a_sign() {
    let of = |coefficients: [i64; 3], denominator: i64| {
        let coefficients = coefficients.map(BigInt::from);
        P::in_powers(Symbol("x"), coefficients, denominator.into())
    };
    assert_eq!(of([1, 2, 0], -3).unwrap().to_string(), "(-2 x - 1)/3");
    assert_eq!(of([1, 2, 0], -3), of([-1, -2, 0], 3));
    assert_eq!(of([4, 0, -2], -2).unwrap().to_string(), "x^2 - 2");
    assert_eq!(of([1, 2, 0], 0), None);
}
