//! Theorems on random stackings: conservation laws, moments, waves and faults.

mod mean;
mod moments;
mod registry;

use cannonpile::each::Each;
use cannonpile::lattice::Direction;
use cannonpile::scalar::Algebra;
use cannonpile::theorem::setting::{
    P, Setting, by_component, by_line, equations, int, symbol, transmitted,
};
use cannonpile::theorem::{Formulas, ProofKind, Step};

use super::steps::{complex, dot, steps_down};
use super::terms::{THREE, TWO, Theorem, square, sum, symbols, transferred, unit};

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "resultant-form",
        statement: "Resultant form: for forces g from above on a sphere let ψ be g under + steps and Gg under − steps. \
                    Then ψ along the directions of + has the resultant of g along its own directions. A weightless \
                    sphere transmits ψ if the next step is +, and Gψ if it is −, whatever the previous step. So the \
                    recursion does not depend on sign changes. The base is equilateral; an identity",
        hypotheses: "s = 1/2; any g_1, g_2, g_3",
        method: ProofKind::Identity,
        symbols: "g_1, g_2, g_3",
        derive: |f| resultant_form(&f.core),
    },
    Theorem {
        name: "squares",
        statement: "Sums and squares: a sphere of weight n·mg with the forces g from above transmits f = Tg + n. If \
                    the sign is kept, and if it changes, Σf = Σg + 3n and Σf² = Σg² + 2nΣg + 3n². So (in words, by \
                    summing over the spheres of all layers) the contacts below layer k of every stacking have Σf = \
                    3W_k and Σf² = Σ_j (3n_j + 6W_{j−1}), j ≤ k. Here n_j spheres of weight mg are in layer j, and W_j \
                    in all layers down to it; an identity",
        hypotheses: "s = 1/2; any g_1, g_2, g_3, n",
        method: ProofKind::Identity,
        symbols: "g_1, g_2, g_3, n",
        derive: |f| squares(&f.core),
    },
    Theorem {
        name: "third-moment",
        statement: "Threefold asymmetry of a response: a unit load at depth n has Σv r³cos3φ = Σ_s σ_s[3(n−s)(2s−1) + \
                    3s−2] in units of ρ³. The azimuth φ is measured from α, and σ_s is the sign of step s ≤ n. \
                    Consider a sphere at z in the complex plane, with load V and horizontal force h. From layer to \
                    layer z³V, z̄²h and zh̄ grow by amounts that the proof computes for every pair of signs above and \
                    below. The sum solves this recursion. Its mean over random stackings with the first sign + and the \
                    fault probability q, μ = 1−2q, is 3(1+μ)n(1+μⁿ)/(1−μ)² − 2(μ²+4μ+1)(1−μⁿ)/(1−μ)³; by induction",
        hypotheses: "s = 1/2, n ≥ 1, 0 < q ≤ 1",
        method: ProofKind::Induction,
        symbols: "g_1, g_2, g_3, x, y, n, s, μ, X = μⁿ",
        derive: moments::third_moment,
    },
    Theorem {
        name: "fourth-moment",
        statement: "Spread of a response: a unit load at depth n has Σv r⁴ = n(2n³+2n²−2n+1)/3 + \
                    2Σ_{s<t}(2n−2t+1)(2s−1)σ_sσ_t in units of ρ⁴, in every stacking. Consider a sphere at z with load \
                    V and horizontal force h. From layer to layer |z|⁴V and |z|²zh̄ grow by amounts that the proof \
                    computes for every pair of signs above and below. The sum solves this recursion. Its mean over \
                    random stackings, μ = 1−2q, is n(2n³+2n²−2n+1)/3 + 4μn³/(3(1−μ)) − 4μn²/(1−μ)² + \
                    2μ(μ²+4μ+7)n/(3(1−μ)³) − 2μ(1+μ)²(1−μⁿ)/(1−μ)⁴; by induction",
        hypotheses: "s = 1/2, n ≥ 1, 0 < q ≤ 1",
        method: ProofKind::Induction,
        symbols: "g_1, g_2, g_3, x, y, n, s, t, μ, X = μⁿ",
        derive: moments::fourth_moment,
    },
    Theorem {
        name: "mean-modes",
        statement: "Modes of the mean: let f₊ and f₋ be the mean forces before a + and a − step. For spatially \
                    constant forces a step M maps f_σ to (1−q)f_σ + qGf_−σ. Then (M−1)(M−μ) = 0 with μ = 1−2q. So M \
                    preserves the load and the horizontal force, three numbers, and multiplies three others by μ. For \
                    forces that alternate in sign from site to site along two directions, let ψ be (1, −1, 0) on f₊ \
                    and −(1, −1, 0) on f₋. Then Mψ = −ψ for every q. So (in words) this mode never decays; an identity",
        hypotheses: "any forces, any q",
        method: ProofKind::Identity,
        symbols: "f_1, f_2, f_3, h_1, h_2, h_3, q",
        derive: mean::mean_modes,
    },
    Theorem {
        name: "mean-spectrum",
        statement: "The spectrum of the mean: with D_l = exp(iθ_l), θ_α+θ_β+θ_γ = 0, det(λ−M) = λ³Q(λ+μ/λ), where Q(y) \
                    = y³ − 2(1−q)T₁y² + [8q²/3 + 2(1−q)²T₁ + (2/9)(3−q)(3−5q)S]y − 2(1−q)³ − (16/9)q²(1−q)T₁ − \
                    (2/9)(1−q)(q²−18q+9)T₂, T₁ = Σcosθ_l, T₂ = Σcos2θ_l, S = Σ_{i<j}cos(θ_i−θ_j), μ = 1−2q. So the six \
                    eigenvalues form three pairs λ, μ/λ. The proof multiplies the columns of f₋ by D_l, which does not \
                    change the determinant because D_αD_βD_γ = 1. The difference of both sides is a multiple of \
                    D_αD_βD_γ − 1. Long waves have the wave number k, and κ = kρ. Two roots have the exponents \
                    ±iκ/√2(1+bκ²) − (1−q)κ²/16q, b = (13q²−42q+21)/(768q²), and one has −(1−q)κ²/8q. With these \
                    exponents Q has no terms below κ⁶. The speed is ρ/√2 for every q; an identity",
        hypotheses: "any q, and of waves q > 0; a = D_α, b = D_β, c = D_γ with abc = 1",
        method: ProofKind::Identity,
        symbols: "a, b, c, q, λ, t",
        derive: mean::mean_spectrum,
    },
    Theorem {
        name: "wave",
        statement: "HCP is a wave: let the sign change at every step, and let three spheres receive g, h, k along the \
                    directions of one sign. They transmit Gg, Gh, Gk along the directions of the other sign. The \
                    sphere between them receives the α, β and γ parts of these forces. They are 2/3 of the three loads \
                    minus the parts g_α, h_β, k_γ, which one sphere two layers above has transmitted. So (in words) \
                    v_{n+1} = 2Pv_n − v_{n−1}, where P is the mean over the three spheres. With v_1 = Pv_0 this gives \
                    v_n = T_n(P)v_0, with the Chebyshev polynomial T_n; an identity",
        hypotheses: "any forces; spheres without weight",
        method: ProofKind::Identity,
        symbols: "g_1, g_2, g_3, h_1, h_2, h_3, k_1, k_2, k_3",
        derive: |f| wave(&f.core),
    },
    Theorem {
        name: "faults",
        statement: "Few faults: a run transmits a force along its line. A sign change turns a force into three parts, \
                    those of Gg: −1/3 of it along the same line, and 2/3 along each of the others. So d sign changes turn \
                    a unit load into 3^(d+1) forces. Their sum is 1, the sum of their squares is 1/3, and the sum of \
                    their absolute values is (5/3)^d. Each sign change multiplies the sum of 3^(d+1)v by 3, the sum of \
                    squares by 9, and the sum of absolute values by 5; by induction",
        hypotheses: "forces at the same place counted separately",
        method: ProofKind::Induction,
        symbols: "v",
        derive: |f| faults(&f.core),
    },
    Theorem {
        name: "one-fault",
        statement: "One fault, m steps above and n below it: there are six loads 2/9 at m u_a − n u_b, where r² = \
                    m²+mn+n² in units of ρ². There are three loads −1/9 at (m−n)u_a, where r² = (m−n)². The nine \
                    places are different, because two of them differ by m u + n w with u or w nonzero and of length \
                    √3ρ. The exception is m = n, where (in words) the last three loads are at the place below the unit \
                    load; an identity",
        hypotheses: "s = 1/2, m, n ≥ 1",
        method: ProofKind::Identity,
        symbols: "m, n",
        derive: |f| one_fault(&f.core),
    },
    Theorem {
        name: "registry",
        statement: "Registries: a + step leads from the registry r to r+1, a − step to r−1 (mod 3), and each sign \
                    differs from the previous one with probability q. Let p_r and m_r be the probabilities of reaching \
                    registry r by a + step and by a − step. One more step yields (1−q)p_{r−1} + q m_{r−1} and \
                    (1−q)m_{r+1} + q p_{r+1}. Let x_r be p_r + m_r minus a third of the sum of all six numbers. Then \
                    x_r = −(1−q)x' − (1−2q)x'', with its values x' one step and x'' two steps before. This also holds \
                    two steps below a top layer of registry 0 whose first signs have the probabilities u and v. So the \
                    recursion gives the excess of the probability of a registry over 1/3 in every layer; by induction",
        hypotheses: "any probabilities of the first signs, any q; from two steps below the top layer on",
        method: ProofKind::Induction,
        symbols: "p_0, p_1, p_2, m_0, m_1, m_2, u, v, q",
        derive: registry::registry,
    },
];

fn resultant_form(f: &Formulas) -> Vec<Step> {
    let (setting, g) = (Setting::equilateral(f), symbols(["g_1", "g_2", "g_3"]));
    let below = setting.turned_directions(f);
    let form = |minus: bool, g: &[P; 3]| transferred(f, minus, g);
    let mut steps = by_component(
        "under −, the resultant of g is that of Gg under +",
        (f.resultant)(&g, &below),
        (f.resultant)(&form(true, &g), &setting.directions),
    );
    let twice = form(true, &form(true, &g));
    steps.extend(by_line(
        "under −, Gψ = GGg = g is transmitted under −",
        twice,
        g,
    ));
    steps
}

fn squares(f: &Formulas) -> Vec<Step> {
    let setting = Setting::equilateral(f);
    let (g, n) = (symbols(["g_1", "g_2", "g_3"]), symbol("n"));
    let (own, weight) = setting.loaded(f, &n);
    let mut steps = equations! { "3n is the weight": weight => int(3) * &n };
    let (whole, all) = (sum(g.clone()), sum(g.each_ref().each(square)));
    for (name, changes) in [("kept", false), ("changed", true)] {
        let passed = transmitted(f, transferred(f, changes, &g), &own);
        let more = int(2) * &n * &whole + &(int(3) * &square(&n));
        steps.extend(equations! {
            (format!("the sign is {name}: Σf")):
                sum(passed.clone()) => whole.clone() + &(int(3) * &n),
            (format!("the sign is {name}: Σf²")):
                sum(passed.each_ref().each(square)) => all.clone() + &more,
        });
    }
    steps
}

fn wave(f: &Formulas) -> Vec<Step> {
    let received = [
        symbols(["g_1", "g_2", "g_3"]),
        symbols(["h_1", "h_2", "h_3"]),
        symbols(["k_1", "k_2", "k_3"]),
    ];
    let lines = Direction::ALL.into_iter().zip(&received);
    let lines = lines.map(|(direction, received)| {
        let l = direction.index();
        let load = sum(received.clone());
        let passed = (f.half_turn)(received)[l].clone() * &int(3);
        let expected = int(2) * &load - &(int(3) * &received[l]);
        Step::equal(
            format!("along {direction}: 2/3 of the load, less what arrives along it"),
            passed,
            expected,
        )
    });
    lines.collect()
}

fn faults(f: &Formulas) -> Vec<Step> {
    let v = symbol("v");
    let mut steps = Vec::new();
    for direction in Direction::ALL {
        let l = direction.index();
        let turned = (f.half_turn)(&unit(l).each(|one| one * &v)).each(|part| part * &int(3));
        let expected = unit(l).each(|one| (int(2) - &(int(3) * &one)) * &v);
        let claim = format!("along {direction}: −v along it, 2v along the others, of 3v");
        steps.extend(by_line(&claim, turned.clone(), expected));
        let apart = turned.iter().enumerate();
        // Only the part along its own direction is negative.
        let absolute = apart.map(|(line, part)| {
            if line == l {
                -part.clone()
            } else {
                part.clone()
            }
        });
        let absolute = sum(absolute);
        steps.extend(equations! {
            (format!("from {direction}: sums by 3")): sum(turned.clone()) => int(3) * &v,
            (format!("from {direction}: squares by 9")):
                sum(turned.each_ref().each(square)) => int(9) * &square(&v),
            (format!("from {direction}: absolute values by 5")): absolute => int(5) * &v,
        });
    }
    let thirds = (f.increments)(&int(1).div_int(TWO));
    steps.extend(equations! {
        "base case: Σ3v = 3": sum(thirds.clone()) => int(3),
        "base case: Σ(3v)² = 9/3": sum(thirds.each_ref().each(square)) => int(3),
    });
    steps
}

fn one_fault(f: &Formulas) -> Vec<Step> {
    let [m, n] = ["m", "n"].each(symbol);
    let [plus, minus] = steps_down(f);
    let place = |a: usize, b: usize| {
        let [above, below] = [(&plus[a], &m), (&minus[b], &n)]
            .each(|(d, n)| complex(d.x.clone() * n, d.y.clone() * n));
        above + &below
    };
    let mut steps = Vec::new();
    for a in 0..3 {
        let thirds = unit(a).each(|one| one.div_int(THREE));
        let loads = (f.half_turn)(&thirds);
        for (b, load) in loads.into_iter().enumerate() {
            let [from, to] = [a, b].each(|line| Direction::ALL[line]);
            let z = place(a, b);
            let at = |claim: &str| format!("from {from} to {to}: {claim}");
            let (nines, square_of) = if a == b {
                (-1, square(&(m.clone() - &n)))
            } else {
                (2, square(&m) + &(m.clone() * &n) + &square(&n))
            };
            steps.extend(equations! {
                (at("9v")): load * &int(9) => int(nines),
                (at("r²")): dot(&z, &z) => square_of,
            });
        }
    }
    for a in 0..3 {
        for b in 0..3 {
            if a != b {
                let apart = plus[a].clone() - &plus[b];
                let claim = format!(
                    "u_a − u_b of {} and {}",
                    Direction::ALL[a],
                    Direction::ALL[b]
                );
                steps.extend(equations! { (claim): dot(&apart, &apart) => int(3) });
            }
        }
    }
    steps
}
