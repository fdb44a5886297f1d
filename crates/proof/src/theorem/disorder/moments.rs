//! Proofs of the moments of the response to a load.

use cannonpile::each::Each;
use cannonpile::scalar::Symbol;
use cannonpile::theorem::Step;
use cannonpile::theorem::setting::{P, equations, int, symbol};
use num_traits::{One, Zero};

use crate::Formulas;
use crate::theorem::steps::{Complex, complex, conjugate, dot, steps_down, times};
use crate::theorem::terms::{SIGNS, power, square, sum, symbols, transferred};

/// The contributions of the contact forces of one sphere to moments. Each is a sum over its contacts, with z the end of
/// the contact.
struct Moments {
    /// Σf.
    load: P,
    /// Σf|z|².
    second: P,
    /// Σf Re(z̄³E), with E the cube of a step under +.
    third: P,
    /// Σf|z|⁴.
    fourth: P,
    /// Σf Re(z d̄), with d the horizontal part of the contact.
    along: P,
    /// Σf Re(z̄²d̄E).
    across: P,
    /// Σf|z|²Re(z d̄).
    outward: P,
}

impl Moments {
    /// Returns the moments of forces f along contacts d that end at these places.
    fn of(f: &[P; 3], d: &[Complex; 3], places: &[Complex; 3], cube: &Complex) -> Self {
        let over = |term: &dyn Fn(&Complex, &Complex) -> P| {
            let contacts = f.iter().zip(d).zip(places);
            sum(contacts.map(|((f, d), z)| term(z, d) * f))
        };
        let [bar_square, bar_cube] = [2, 3].each(|n| {
            move |z: &Complex| (1..n).fold(conjugate(z), |power, _| times(&power, &conjugate(z)))
        });
        Self {
            load: over(&|_, _| P::one()),
            second: over(&|z, _| dot(z, z)),
            third: over(&|z, _| times(&bar_cube(z), cube).x),
            fourth: over(&|z, _| square(&dot(z, z))),
            along: over(&|z, d| dot(z, d)),
            across: over(&|z, d| times(&times(&bar_square(z), &conjugate(d)), cube).x),
            outward: over(&|z, d| dot(z, z) * &dot(z, d)),
        }
    }
}

/// Returns the moments of the forces on a sphere at z and of the forces below it, for all four pairs of signs above and
/// below. Each entry contains the name of the case, and the sign σ of the step below.
fn at_a_sphere(f: &Formulas) -> Vec<(String, P, Moments, Moments)> {
    let (g, down) = (symbols(["g_1", "g_2", "g_3"]), steps_down(&f.core));
    let z = complex(symbol("x"), symbol("y"));
    let [alpha, ..] = &down[0];
    let cube = times(alpha, &times(alpha, alpha));
    let mut cases = Vec::new();
    for (above, from) in down.iter().enumerate() {
        for (below, to) in down.iter().enumerate() {
            let passed = transferred(&f.core, above != below, &g);
            let here = [(); 3].each(|()| z.clone());
            let there = to.each_ref().each(|step| z.clone() + step);
            cases.push((
                format!("{} above, {} below", SIGNS[above].0, SIGNS[below].0),
                int(if below == 0 { 1 } else { -1 }),
                Moments::of(&g, from, &here, &cube),
                Moments::of(&passed, to, &there, &cube),
            ));
        }
    }
    cases
}

/// Returns the polynomial at n + 1, with X = μⁿ.
fn next(of_n: &P) -> P {
    let n = of_n.substitute(Symbol("n"), &(symbol("n") + &P::one()));
    n.substitute(Symbol("X"), &(symbol("X") * &symbol("μ")))
}

/// Returns the difference between n + 1 and n.
fn growth(of_n: &P) -> P {
    next(of_n) - of_n
}

/// Returns the polynomial at n = 0, where X = 1.
fn at_first(of_n: &P) -> P {
    of_n.substitute(Symbol("n"), &P::zero())
        .substitute(Symbol("X"), &P::one())
}

pub(super) fn third_moment(f: &Formulas) -> Vec<Step> {
    let mut steps = Vec::new();
    for (case, sigma, received, passed) in at_a_sphere(f) {
        let at = |claim: &str| format!("{case}: {claim}");
        let twice = int(2) * &received.along + &received.load;
        let thrice = int(3) * &received.across;
        let rest = sigma.clone() * &(int(3) * &received.along + &received.load);
        steps.extend(equations! {
            (at("Re Σz h̄ grows by V")):
                passed.along => received.along.clone() + &received.load,
            (at("Re Σz̄²h̄ grows by σ(2Re zh̄ + V)")):
                passed.across => received.across.clone() + &(sigma * &twice),
            (at("Σv r³cos3φ grows by 3Re z̄²h̄ + 3σRe zh̄ + σV")):
                passed.third => received.third + &thrice + &rest,
        });
    }
    let [n, s, mu, x] = ["n", "s", "μ", "X"].map(symbol);
    let one = P::one();
    let after = n.clone() + &one;
    let share = f.third_moment;
    // Re Σzh̄ = n and Re Σz̄²h̄ = Σσ_s(2s−1).
    steps.extend(equations! {
        "the first step: σ_1": share(&one, &one) => one.clone(),
        "a step more: 3(2s−1) for each before":
            share(&after, &s) - &share(&n, &s) => int(3) * &(int(2) * &s - &one),
        "and 3n+1 for the step itself": share(&after, &after) => int(3) * &n + &one,
    });
    // Eσ_s = μ^(s−1). So a step adds 3Σ(2s−1)μ^(s−1) + (3n+1)μⁿ to the mean, and that sum grows by (2n+1)μⁿ. All terms
    // are multiplied by (1−μ)³.
    let mean = (f.mean_third_moment)(&n, &mu, &x);
    let gap = power(&(one.clone() - &mu), 3);
    let last = |n: &P| int(3) * n + &one;
    let grown = int(3) * &(int(2) * &n + &one) + &(last(&after) * &mu) - &last(&n);
    steps.extend(equations! {
        "the mean of no step": at_first(&mean) => P::zero(),
        "and of one": at_first(&next(&mean)) => gap.clone(),
        "its second difference is 3(2n+1)μⁿ plus the difference of (3n+1)μⁿ":
            growth(&growth(&mean)) => grown * &x * &gap,
    });
    steps
}

pub(super) fn fourth_moment(f: &Formulas) -> Vec<Step> {
    let mut steps = Vec::new();
    for (case, sigma, received, passed) in at_a_sphere(f) {
        let at = |claim: &str| format!("{case}: {claim}");
        let turned = sigma * &received.across;
        let outward = turned.clone()
            + &(int(2) * &received.second)
            + &(int(3) * &received.along)
            + &received.load;
        let fourth = received.load.clone()
            + &(int(4) * &(received.second + &received.outward + &received.along))
            + &(int(2) * &turned);
        steps.extend(equations! {
            (at("Re Σ|z|²zh̄ grows by σRe z̄²h̄ + 2|z|²V + 3Re zh̄ + V")):
                passed.outward => received.outward + &outward,
            (at("Σv r⁴ grows by V + 4(|z|²V + |z|²Re zh̄ + Re zh̄) + 2σRe z̄²h̄")):
                passed.fourth => received.fourth + &fourth,
        });
    }
    let [n, s, t, mu, x] = ["n", "s", "t", "μ", "X"].map(symbol);
    let one = P::one();
    let (alone, pair) = (f.fourth_moment, f.fourth_moment_of_pair);
    let after = n.clone() + &one;
    let layer = int(2) * &square(&n) + &(int(3) * &n) + &one;
    let outward = layer.sum(Symbol("n"), &P::zero(), &symbol("m"));
    let outward = outward.substitute(Symbol("m"), &(n.clone() - &one));
    let grown = one.clone() + &(int(4) * &(square(&n) + &outward + &n));
    let odd = int(2) * &s - &one;
    steps.extend(equations! {
        "the first step: 1": alone(&one) => one.clone(),
        "a step more, without signs: 1 + 4(n² + Σ(2m²+3m+1) + n)":
            alone(&after) - &alone(&n) => grown,
        "4(2s−1) for two signs before": pair(&after, &s, &t) - &pair(&n, &s, &t) => int(4) * &odd,
        "and 2(2s−1) with the sign of the step itself":
            pair(&after, &s, &after) => int(2) * &odd,
    });
    // Eσ_sσ_t = μ^(t−s). Let D_n = Σ(2s−1)μ^(n+1−s), s ≤ n. Then the second difference of the mean of pairs is 2(D_n +
    // D_{n+1}), and D_{n+1} = μ(D_n + 2n+1). All terms are multiplied by (1−μ)⁴.
    let mean = (f.mean_fourth_moment_of_pairs)(&n, &mu, &x);
    let gap = power(&(one - &mu), 4);
    let second = growth(&growth(&mean));
    let further = next(&second) - &(mu.clone() * &second);
    steps.extend(equations! {
        "the mean of pairs, of no step": at_first(&mean) => P::zero(),
        "of one": at_first(&next(&mean)) => P::zero(),
        "of two": at_first(&next(&next(&mean))) => int(2) * &mu * &gap,
        "its second difference at n + 1 is μ times that at n, plus 8(n+1)μ":
            further => int(8) * &after * &mu * &gap,
    });
    steps
}
