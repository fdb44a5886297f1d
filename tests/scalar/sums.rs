//! Sums of polynomials in closed form equal the sums term by term.

use std::collections::BTreeMap;

use cannonpile::scalar::{Algebra, Polynomial, Ring, Symbol};
use num_bigint::BigInt;
use num_rational::BigRational as Q;
use num_traits::{One, Zero};

type P = Polynomial;

const MAX_TESTED_LAYERS: i128 = 12;
const DEGREE: u32 = 8;

fn symbol(name: &'static str) -> P {
    Symbol(name).into()
}

fn int(n: i128) -> P {
    P::from_integer(n)
}

/// i^a j^b k^c.
fn monomial([a, b, c]: [u32; 3]) -> P {
    let factors = [("i", a), ("j", b), ("k", c)];
    factors
        .into_iter()
        .fold(P::one(), |product, (name, power)| {
            (0..power).fold(product, |product, _| product * &symbol(name))
        })
}

/// All (a, b, c) with a + b + c ≤ 8.
fn powers() -> impl Iterator<Item = [u32; 3]> {
    let up_to = |rest: u32| 0..=rest;
    up_to(DEGREE).flat_map(move |a| {
        up_to(DEGREE - a).flat_map(move |b| up_to(DEGREE - a - b).map(move |c| [a, b, c]))
    })
}

/// Σ over the pile: i = 0 … k−j, j = 0 … k, k = 0 … L−1.
fn over_pile(p: &P) -> P {
    let (zero, last) = (P::zero(), symbol("L") - &P::one());
    let row = p.sum(Symbol("i"), &zero, &(symbol("k") - &symbol("j")));
    let layer = row.sum(Symbol("j"), &zero, &symbol("k"));
    layer.sum(Symbol("k"), &zero, &last)
}

/// The sums for L = 0 … 12 layers, sphere by sphere.
fn one_by_one([a, b, c]: [u32; 3]) -> Vec<i128> {
    let mut sums = vec![0];
    let mut sum = 0;
    for k in 0..MAX_TESTED_LAYERS {
        for j in 0..=k {
            for i in 0..=k - j {
                sum += i.pow(a) * j.pow(b) * k.pow(c);
            }
        }
        sums.push(sum);
    }
    sums
}

fn at_layers(p: &P, layers: i128) -> Q {
    p.evaluate(&[(Symbol("L"), Q::from_integer(layers.into()))])
        .expect("a polynomial in L")
}

#[test]
fn every_monomial_over_every_pile() {
    for powers in powers() {
        let sum = over_pile(&monomial(powers));
        assert_eq!(sum.symbols(), [Symbol("L")]);
        assert_eq!(sum.degree(), u64::from(powers.iter().sum::<u32>() + 3));
        for (layers, want) in (0..).zip(one_by_one(powers)) {
            assert_eq!(
                at_layers(&sum, layers),
                Q::from_integer(want.into()),
                "{powers:?}, {layers} layers"
            );
        }
    }
}

/// Numbers without a pattern that are the same in every run.
fn scattered(seed: u64) -> impl Iterator<Item = i64> {
    let next = |n: &u64| {
        Some(
            n.wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407),
        )
    };
    core::iter::successors(Some(seed), next)
        .skip(1)
        .map(|n| i64::try_from(n >> 44).expect("20 bits") - (1 << 19))
}

#[test]
fn combinations_over_every_pile() {
    let all: Vec<_> = powers().collect();
    let direct: BTreeMap<_, _> = all
        .iter()
        .map(|powers| (*powers, one_by_one(*powers)))
        .collect();
    let mut numbers = scattered(1);
    for _ in 0..12 {
        let mut terms: BTreeMap<[u32; 3], Q> = BTreeMap::new();
        for _ in 0..8 {
            let [n, d, which] = [0; 3].map(|_| numbers.next().expect("endless"));
            let which = usize::try_from(which.unsigned_abs()).expect("small") % all.len();
            terms.insert(all[which], Q::new(n.into(), BigInt::from(d.abs() + 1)));
        }
        let p = terms.iter().fold(P::zero(), |sum, (powers, coefficient)| {
            sum + &(monomial(*powers) * &P::constant(coefficient))
        });
        let sum = over_pile(&p);
        for (n, layers) in (0..=MAX_TESTED_LAYERS).enumerate() {
            let term =
                |(powers, c): (&[u32; 3], &Q)| c * Q::from_integer((direct[powers][n]).into());
            assert_eq!(
                at_layers(&sum, layers),
                terms.iter().map(term).sum::<Q>(),
                "{p}, {layers} layers"
            );
        }
    }
}

/// Some polynomials in x and y.
fn in_x_and_y() -> [P; 5] {
    let (x, y) = (symbol("x"), symbol("y"));
    let cube = x.clone() * &x * &x;
    [
        P::zero(),
        int(5),
        y.clone() - &x,
        cube.clone() * &y.clone().div_int(7.try_into().expect("7")) - &y,
        cube.clone() * &cube * &x + &(y.clone() * &y) - &x,
    ]
}

fn at(p: &P, x: i128, y: i128) -> Q {
    p.evaluate(&[
        (Symbol("x"), Q::from_integer(x.into())),
        (Symbol("y"), Q::from_integer(y.into())),
    ])
    .expect("in x and y")
}

/// Sums the terms from `from` to `to`. If `to` < `from` − 1, returns minus the sum of the terms between.
fn term_by_term(p: &P, from: i128, to: i128, y: i128) -> Q {
    let forwards: Q = (from..=to).map(|x| at(p, x, y)).sum();
    let backwards: Q = (to + 1..from).map(|x| at(p, x, y)).sum();
    forwards - backwards
}

#[test]
fn numeric_bounds() {
    for p in in_x_and_y() {
        for from in -6..=6 {
            for to in -8..=8 {
                let sum = p.sum(Symbol("x"), &int(from), &int(to));
                assert_eq!(sum.degree_in(Symbol("x")), 0);
                for y in [-2, 0, 3] {
                    assert_eq!(
                        at(&sum, 0, y),
                        term_by_term(&p, from, to, y),
                        "{p}, {from} … {to}"
                    );
                }
                if to == from - 1 {
                    assert!(sum.is_zero(), "an empty sum");
                }
            }
        }
    }
}

/// Bounds that are polynomials in the other symbol, in the summation symbol (which then refers to the outer one), and in
/// both.
#[test]
fn symbolic_bounds() {
    let (x, y) = (symbol("x"), symbol("y"));
    let bounds = [
        (P::zero(), y.clone()),
        (-y.clone(), y.clone()),
        (y.clone(), y.clone() - &P::one()),
        (P::zero(), x.clone()),
        (x.clone() + &P::one(), x.clone() * &int(2)),
        (x.clone() - &y, x.clone() + &(y.clone() * &y)),
        (x.clone() * &x, x.clone()),
    ];
    for p in in_x_and_y() {
        for (from, to) in &bounds {
            let sum = p.sum(Symbol("x"), from, to);
            for (x, y) in [(0, 0), (1, 1), (2, 0), (3, 2), (-1, 3), (-3, -2), (5, -4)] {
                let [first, last] = [from, to]
                    .map(|bound| i128::try_from(at(bound, x, y).to_integer()).expect("small"));
                let want = term_by_term(&p, first, last, y);
                assert_eq!(at(&sum, x, y), want, "{p} from {from} to {to} at {x}, {y}");
            }
        }
    }
}

/// Σ from a to b is F(b+1) − F(a). So adjacent sums add up, and differences telescope.
#[test]
fn sums_telescope() {
    let (x, n, m) = (Symbol("x"), symbol("n"), symbol("m"));
    for p in in_x_and_y() {
        let primitive = p.sum(x, &P::zero(), &(symbol("x") - &P::one()));
        assert!(primitive.substitute(x, &P::zero()).is_zero());
        let next = primitive.substitute(x, &(symbol("x") + &P::one()));
        assert_eq!(next.clone() - &primitive, p);
        let sum = p.sum(x, &m, &n);
        let ends = [n.clone() + &P::one(), m.clone()].map(|end| primitive.substitute(x, &end));
        assert_eq!(sum, ends[0].clone() - &ends[1]);
        let differences = (next - &primitive).sum(x, &m, &n);
        assert_eq!(differences, sum);
        let rest = p.sum(x, &(n.clone() + &P::one()), &symbol("q"));
        assert_eq!(sum + &rest, p.sum(x, &m, &symbol("q")));
        // Reversed: x → m + n − x takes the same values.
        let reversed = p.substitute(x, &(m.clone() + &n - &symbol("x")));
        assert_eq!(reversed.sum(x, &m, &n), p.sum(x, &m, &n));
    }
}

/// The order of nested sums does not matter: over the triangle 0 ≤ i ≤ j ≤ n by rows or by columns.
#[test]
fn order_of_summation() {
    let (i, j, n) = (symbol("i"), symbol("j"), symbol("n"));
    for powers in powers().filter(|[a, b, c]| a + b <= 5 && *c == 0) {
        let p = monomial(powers);
        let by_rows = p
            .sum(Symbol("i"), &P::zero(), &j)
            .sum(Symbol("j"), &P::zero(), &n);
        let by_columns = p.sum(Symbol("j"), &i, &n).sum(Symbol("i"), &P::zero(), &n);
        assert_eq!(by_rows, by_columns, "{p}");
    }
}
