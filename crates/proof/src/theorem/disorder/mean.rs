//! The mean over random stackings: its modes, and its spectrum.

use core::num::NonZeroI64;

use cannonpile::each::Each;
use cannonpile::scalar::{Algebra, Symbol};
use cannonpile::theorem::Step;
use cannonpile::theorem::setting::{P, by_line, equations, int, symbol};
use num_traits::{One, Zero};

use crate::Formulas;
use crate::theorem::terms::{THREE, TWO, power, square, sum, symbols};

/// Returns M applied to f₊ and f₋. The caller has multiplied f₊ by the factors D_l, and f₋ by their inverses.
fn mean_step(f: &Formulas, q: &P, shifted: &[[P; 3]; 2]) -> [[P; 3]; 2] {
    let stay = P::one() - q;
    [0, 1].each(|sign: usize| {
        let other = (f.core.half_turn)(&shifted[1 - sign]);
        [0, 1, 2]
            .each(|line: usize| shifted[sign][line].clone() * &stay + &(other[line].clone() * q))
    })
}

pub(super) fn mean_modes(f: &Formulas) -> Vec<Step> {
    let q = symbol("q");
    let parts = [
        symbols(["f_1", "f_2", "f_3"]),
        symbols(["h_1", "h_2", "h_3"]),
    ];
    let mu = P::one() - &(int(2) * &q);
    let once = mean_step(f, &q, &parts);
    let twice = mean_step(f, &q, &once);
    let mut steps = Vec::new();
    for sign in [0, 1] {
        for line in 0..3 {
            let [x, y, z] = [&twice, &once, &parts].each(|parts| parts[sign][line].clone());
            let zero = x - &(y * &(P::one() + &mu)) + &(z * &mu);
            let claim = format!("(M−1)(M−μ) = 0, of f{}", ["₊", "₋"][sign]);
            steps.extend(equations! { (claim): zero => P::zero() });
        }
    }
    let across = |sign: i128| [sign, -sign, 0].each(int);
    let mode = [across(1), across(-1)];
    // The factors are −1 along α and β, and 1 along γ.
    let shifted = mode.clone().each(|[a, b, c]| [-a, -b, c]);
    let after = mean_step(f, &q, &shifted);
    for (after, mode) in after.into_iter().zip(mode) {
        steps.extend(by_line("Mψ = −ψ", after, mode.each(|part| -part)));
    }
    steps
}

/// Returns the determinant, by expansion along the rows. The minors of the first rows are indexed by the set of their
/// columns.
fn determinant(rows: &[Vec<P>]) -> P {
    let mut minors = vec![(0_usize, P::one())];
    for row in rows {
        let mut longer = vec![P::zero(); 1 << row.len()];
        for (taken, minor) in &minors {
            for (column, entry) in row.iter().enumerate() {
                let bit = 1 << column;
                if taken & bit == 0 && !entry.is_zero() {
                    // The number of inversions is the number of taken columns to the right.
                    let inversions = (taken >> column).count_ones();
                    let sign = int(if inversions % 2 == 0 { 1 } else { -1 });
                    let term = minor.clone() * entry * &sign;
                    let sum = &mut longer[taken | bit];
                    *sum = sum.clone() + &term;
                }
            }
        }
        let longer = longer.into_iter().enumerate();
        minors = longer.filter(|(_, minor)| !minor.is_zero()).collect();
    }
    sum(minors.into_iter().map(|(_, minor)| minor))
}

pub(super) fn mean_spectrum(f: &Formulas) -> Vec<Step> {
    let (q, lambda) = (symbol("q"), symbol("λ"));
    let d = symbols(["a", "b", "c"]);
    let none = || [P::zero(), P::zero(), P::zero()];
    // Column by column, the entries are those of λ − M for the six unit vectors. The columns of f₋ are multiplied by
    // D_l.
    let mut rows = vec![vec![P::zero(); 6]; 6];
    for sign in [0, 1] {
        for line in 0..3 {
            let mut shifted = [none(), none()];
            let plus = sign == 0;
            shifted[sign][line] = if plus { d[line].clone() } else { P::one() };
            let column = 3 * sign + line;
            let made = mean_step(f, &q, &shifted);
            for (row, made) in made.into_iter().flatten().enumerate() {
                rows[row][column] = -made;
            }
            let scale = if plus { P::one() } else { d[line].clone() };
            rows[column][column] = rows[column][column].clone() + &(lambda.clone() * &scale);
        }
    }
    let [a, b, c] = &d;
    let product = a.clone() * b * c;
    // Each inverse is the product of the other two factors.
    let inverse = [b.clone() * c, a.clone() * c, a.clone() * b];
    let half = |sum: P| sum.div_int(TWO);
    let t1 = half(sum(d.clone()) + &sum(inverse.clone()));
    let t2 = half(sum(d.each_ref().each(square)) + &sum(inverse.each_ref().each(square)));
    let ratios = (0..3).flat_map(|i| {
        let others = (0..3).filter(move |j| *j != i);
        others.map(move |j| (i, j))
    });
    let s = half(sum(ratios.map(|(i, j)| d[i].clone() * &inverse[j])));
    // λ³Q(λ+μ/λ), with λy = λ² + μ.
    let mu = P::one() - &(int(2) * &q);
    let q_of = cubic(&q, [&t1, &t2, &s], &(square(&lambda) + &mu), &lambda);
    let left = determinant(&rows) - &q_of;
    let relation = product - &P::one();
    // If the division leaves a remainder, the equation below fails.
    let multiple = left.divide_exactly(&relation).unwrap_or_else(P::zero);
    let mut steps = equations! {
        "det(λ−M) − λ³Q(λ+μ/λ) is a multiple of abc − 1": left => multiple * &relation,
    };
    // Long waves: κ² is a polynomial in t, and θ_l = κ cos(φ + 120°l). The sums of even powers up to the fourth do not
    // depend on the direction φ. The differences in S have the wave number √3κ.
    let of_angle = |square_of: &P| {
        let fourth = (int(3) * &square(square_of)).div_int(SIXTY_FOUR);
        int(3) - &(int(3) * square_of).div_int(FOUR) + &fourth
    };
    let t = symbol("t");
    let mut wave = |what: &str, square_of: &P, exponent: &P, order: usize| {
        let [lambda, inverse] =
            [exponent.clone(), -exponent.clone()].each(|x| exponential(&x, order));
        let [t1, t2, s] = [1, 4, 3].each(|n| of_angle(&(int(n) * square_of)));
        let y = lambda + &(mu.clone() * &inverse);
        let q_of = cubic(&q, [&t1, &t2, &s], &y, &P::one());
        let claim = format!("{what}: Q vanishes");
        steps.push(Step::equal(claim, lowest(&q_of, order), P::zero()));
    };
    // With iκ = √2qt the speed is ρ/√2, and κ² = −2q²t².
    let [damping, dispersion] = (f.wave)(&q);
    let exponent = q.clone()
        * &(t.clone() + &(int(2) * &damping * &square(&t))
            - &(int(2) * &dispersion * &power(&t, 3)));
    let square_of = int(-2) * &square(&q) * &square(&t);
    wave("the wave, below κ⁶", &square_of, &exponent, 6);
    // κ² = 8qt.
    let across = int(-16) * &damping * &t;
    wave("across, below κ⁶", &(int(8) * &q * &t), &across, 3);
    steps
}

// The compiler evaluates the `unwrap`, and rejects zero.
const FOUR: NonZeroI64 = NonZeroI64::new(4).unwrap();
const SIXTY_FOUR: NonZeroI64 = NonZeroI64::new(64).unwrap();

/// Returns the terms of e^x below this power of t, for an x without constant term.
fn exponential(x: &P, order: usize) -> P {
    let mut term = P::one();
    let mut series = P::one();
    for n in (1..).filter_map(NonZeroI64::new).take(order) {
        term = lowest(&(term * x).div_int(n), order);
        series = series + &term;
    }
    series
}

/// Returns the terms of a polynomial below this power of t.
fn lowest(p: &P, order: usize) -> P {
    let terms = p.coefficients(Symbol("t")).into_iter();
    let terms = terms.map(|(n, coefficient)| (n as usize, coefficient));
    let lowest = terms.take_while(|(n, _)| *n < order);
    sum(lowest.map(|(n, coefficient)| coefficient * &power(&symbol("t"), n)))
}

/// Returns λ³Q(y/λ), for the sums T₁, T₂ and S.
fn cubic(q: &P, [t1, t2, s]: [&P; 3], y: &P, lambda: &P) -> P {
    let stay = P::one() - q;
    let ninth = |p: P| p.div_int(THREE).div_int(THREE);
    let linear = (int(8) * &square(q)).div_int(THREE)
        + &(int(2) * &square(&stay) * t1)
        + &ninth(int(2) * &(int(3) - q) * &(int(3) - &(int(5) * q)) * s);
    let constant = int(2) * &power(&stay, 3)
        + &ninth(int(16) * &square(q) * &stay * t1)
        + &ninth(int(2) * &stay * &(square(q) - &(int(18) * q) + &int(9)) * t2);
    power(y, 3) - &(int(2) * &stay * t1 * &square(y) * lambda) + &(linear * y * &square(lambda))
        - &(constant * &power(lambda, 3))
}
