//! Theorems on stackings and regions of any kind: runs, changes of sign, point loads.

use alloc::format;
use alloc::vec::Vec;

use num_traits::{One, Zero};

use super::setting::{P, Setting, int, symbol};
use super::{Formulas, ProofKind, Step, Theorem};
use crate::formula::THREE;
use crate::geometry::Vector;
use crate::lattice::Direction;
use crate::scalar::Algebra;

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "region-counts",
        statement: "Any base under straight steps: m steps into a run, in a layer x₀ ≤ i ≤ x₁, y₀ ≤ j ≤ y₁, \
                    s₀ ≤ i+j ≤ s₁, the spheres above (i, j) are min(m, x₁−i, y₁−j, s₁−i−j) along α, \
                    min(m, i−x₀, y₁−j, i+j−s₀) along β, min(m, j−y₀, x₁−i, i+j−s₀) along γ: each argument is 0 at \
                    its surface, or at the first layer of the run, and one more at the sphere below on the line; by \
                    induction, for − steps under (i, j) → (−i, −j)",
        hypotheses: "bounds tight",
        method: ProofKind::Induction,
        symbols: "i, j, m, x_0, x_1, y_0, y_1, s_0, s_1",
        derive: region_counts,
    },
    Theorem {
        name: "run",
        statement: "Within a run of one sign a line of contacts that carries f at its first sphere carries f + m w \
                    after m spheres more, w an increment: one jump is as good as m steps; by induction",
        hypotheses: "m ≥ 0",
        method: ProofKind::Induction,
        symbols: "f, m, s",
        derive: run,
    },
    Theorem {
        name: "tripled-half-turn",
        statement: "2(g_1+g_2+g_3)(1,1,1) − 3g, which the exact engine computes, is 3Gg; an identity",
        hypotheses: "any forces",
        method: ProofKind::Identity,
        symbols: "g_1, g_2, g_3",
        derive: tripled,
    },
    Theorem {
        name: "edge",
        statement: "A run of m steps begins with a sphere on the edge that passes on f along its one loaded line; m \
                    steps further down the line ends at a sphere that receives f + m − 1 along it and nothing else. \
                    If the sign changes there, that sphere passes on 1 − (f+m−1)/3 along it, which is negative if \
                    f + m > 4: so no run of five steps or more, after which the sign changes, stands; an identity",
        hypotheses: "f ≥ 0, m ≥ 1, weights of mg",
        method: ProofKind::Identity,
        symbols: "f, m",
        derive: edge,
    },
    Theorem {
        name: "point-load",
        statement: "A unit load on a wide flat top, in any stacking: at depth n the vertical parts v of the contact \
                    forces have Σv = 1, Σv² = 1/3, Σv r = 0 and Σv r² = n²ρ², r from the load's line to the lower \
                    sphere, ρ = 2R sinθ. The first layer has them, and every sphere passes them on, with C = Σv r·d, \
                    d the horizontal step of a contact: Σv r² grows by 2C + ρ² and C = nρ² by ρ², across a change of \
                    sign or not. Loads add up, and a weight is a load: so under gravity, of every stacking and base, \
                    ΣF_z is the weight, ΣF_z r_b = Σ mg r_s and ΣF_z r_b² = Σ mg (r_s² + H_s² tan²θ); by induction",
        hypotheses: "s = 1/2, no other weights",
        method: ProofKind::Induction,
        symbols: "g_1, g_2, g_3, x, y",
        derive: point_load,
    },
];

fn region_counts(f: &Formulas) -> Vec<Step> {
    let [i, j, m] = ["i", "j", "m"].map(symbol);
    let lower = ["x_0", "y_0", "s_0"].map(symbol);
    let upper = ["x_1", "y_1", "s_1"].map(symbol);
    let names = [
        ["m", "x₁−i", "y₁−j", "s₁−i−j"],
        ["m", "i−x₀", "y₁−j", "i+j−s₀"],
        ["m", "j−y₀", "x₁−i", "i+j−s₀"],
    ];
    let here = (f.bounds_above)(&i, &j, &lower, &upper, &m);
    let wider = upper.each_ref().map(|bound| bound.clone() + &P::one());
    let mut steps = Vec::new();
    for (line, direction) in Direction::ALL.into_iter().enumerate() {
        let [di, dj, dk] = (f.descent)(direction).map(int);
        let (below_i, below_j) = (i.clone() + &di, j.clone() + &dj);
        let below = (f.bounds_above)(&below_i, &below_j, &lower, &wider, &(m.clone() + &dk));
        let sides = here[line].iter().zip(&below[line]).zip(names[line]);
        for ((here, below), name) in sides {
            let claim = format!("step along {direction}: {name} grows by one");
            steps.push(Step::equal(claim, below.clone(), here.clone() + &P::one()));
        }
    }
    // At each surface, and above the first step, the argument that belongs to it vanishes.
    let [x0, y0, s0] = lower.clone();
    let [x1, y1, s1] = upper.clone();
    let surfaces = [
        ("i = x₁", &x1, &j, &m, [Some(1), None, Some(2)]),
        ("j = y₁", &i, &y1, &m, [Some(2), Some(2), None]),
        ("i+j = s₁", &(s1 - &j), &j, &m, [Some(3), None, None]),
        ("i = x₀", &x0, &j, &m, [None, Some(1), None]),
        ("j = y₀", &i, &y0, &m, [None, None, Some(1)]),
        ("i+j = s₀", &(s0 - &j), &j, &m, [None, Some(3), Some(3)]),
        ("m = 0", &i, &j, &P::zero(), [Some(0); 3]),
    ];
    for (surface, i, j, m, arguments) in surfaces {
        let bounds = (f.bounds_above)(i, j, &lower, &upper, m);
        for ((bounds, argument), direction) in bounds.iter().zip(arguments).zip(Direction::ALL) {
            if let Some(bound) = argument.and_then(|argument| bounds.get(argument)) {
                let claim = format!("base case: {direction} begins at {surface}");
                steps.push(Step::equal(claim, bound.clone(), P::zero()));
            }
        }
    }
    steps
}

fn run(f: &Formulas) -> Vec<Step> {
    let (force, m) = (symbol("f"), symbol("m"));
    let increments = (f.increments)(&symbol("s"));
    let mut steps = Vec::new();
    for (direction, w) in Direction::ALL.into_iter().zip(&increments) {
        let after = |m: P| (f.passed_on)(force.clone(), &(f.force)(m, w));
        let claim = format!("base case along {direction}: f after no sphere");
        steps.push(Step::equal(claim, after(P::zero()), force.clone()));
        let one_more = (f.passed_on)(after(m.clone()), w);
        let claim = format!("step along {direction}: an increment more after one sphere more");
        steps.push(Step::equal(claim, after(m.clone() + &P::one()), one_more));
    }
    steps
}

fn tripled(f: &Formulas) -> Vec<Step> {
    let g = ["g_1", "g_2", "g_3"].map(symbol);
    let ways = [
        ("2Σg − 3g", (f.tripled_half_turn)(&g)),
        ("each once", (f.tripled_apart)(&g)),
    ];
    let mut steps = Vec::new();
    for (claim, tripled) in ways {
        let sides = tripled.into_iter().zip((f.half_turn)(&g));
        steps.extend(sides.map(|(left, turned)| Step::equal(claim, left, turned * &int(3))));
    }
    steps
}

fn edge(f: &Formulas) -> Vec<Step> {
    let received = symbol("f") + &symbol("m") - &P::one();
    let third = received.clone().div_int(THREE);
    let mut steps = Vec::new();
    for (line, direction) in Direction::ALL.into_iter().enumerate() {
        let mut g = [P::zero(), P::zero(), P::zero()];
        g[line] = received.clone();
        let [alpha, beta, gamma] = (f.half_turn)(&g).map(|force| force + &P::one());
        let along = match direction {
            Direction::Alpha => alpha,
            Direction::Beta => beta,
            Direction::Gamma => gamma,
        };
        let claim = format!("{direction}: 1 − (f+m−1)/3");
        steps.push(Step::equal(claim, along, P::one() - &third));
    }
    steps
}

fn point_load(f: &Formulas) -> Vec<Step> {
    let setting = Setting::equilateral(f);
    let sum = |forces: &[P; 3], of: &dyn Fn(usize) -> P| {
        let terms = forces
            .iter()
            .enumerate()
            .map(|(line, force)| of(line) * force);
        terms.fold(P::zero(), |sum, term| sum + &term)
    };
    let dot = |a: &Vector<P>, b: &Vector<P>| a.x.clone() * &b.x + &(int(3) * &(a.y.clone() * &b.y));
    let flat = |v: &Vector<P>, sign: i128| Vector {
        x: v.x.clone() * &int(sign),
        y: v.y.clone() * &int(sign),
        z: P::zero(),
    };
    let r = Vector {
        x: symbol("x"),
        y: symbol("y"),
        z: P::zero(),
    };
    let mut steps = Vec::new();
    // A contact leads down against ê.
    let down: [Vector<P>; 3] = setting.directions.each_ref().map(|e| flat(e, -1));
    // What the loaded sphere adds to its lines, in the unit of the load: W = 3.
    let thirds = setting.increments.clone().map(|w| w.div_int(THREE));
    let first = [
        ("Σv = 1", sum(&thirds, &|_| P::one()), P::one()),
        (
            "Σv² = 1/3",
            sum(&thirds, &|line| thirds[line].clone()),
            P::one().div_int(THREE),
        ),
        (
            "Σv r along x = 0",
            sum(&thirds, &|line| down[line].x.clone()),
            P::zero(),
        ),
        (
            "Σv r along y = 0",
            sum(&thirds, &|line| down[line].y.clone()),
            P::zero(),
        ),
        (
            "Σv r² = ρ²",
            sum(&thirds, &|line| dot(&down[line], &down[line])),
            P::one(),
        ),
    ];
    let claims = first.into_iter();
    steps.extend(
        claims
            .map(|(claim, left, right)| Step::equal(format!("first layer: {claim}"), left, right)),
    );

    let g = ["g_1", "g_2", "g_3"].map(symbol);
    for (case, passed, sign) in [
        ("same sign", g.clone(), 1),
        ("change", (f.half_turn)(&g), -1),
    ] {
        let next: [Vector<P>; 3] = down.each_ref().map(|d| flat(d, sign));
        let below = |line: usize| r.clone() + &next[line];
        let whole = sum(&g, &|_| P::one());
        let c = sum(&g, &|line| dot(&r, &down[line]));
        // Under the same sign they are what they were.
        let kept = [
            ("Σv stays", sum(&passed, &|_| P::one()), whole.clone()),
            (
                "Σv² stays",
                sum(&passed, &|line| passed[line].clone()),
                sum(&g, &|line| g[line].clone()),
            ),
            (
                "Σv d along x stays",
                sum(&passed, &|line| next[line].x.clone()),
                sum(&g, &|line| down[line].x.clone()),
            ),
            (
                "Σv d along y stays",
                sum(&passed, &|line| next[line].y.clone()),
                sum(&g, &|line| down[line].y.clone()),
            ),
        ];
        let grown = [
            (
                "C grows by ρ²Σv",
                sum(&passed, &|line| dot(&below(line), &next[line])),
                c.clone() + &whole,
            ),
            (
                "Σv r² grows by 2C + ρ²Σv",
                sum(&passed, &|line| dot(&below(line), &below(line))),
                sum(&g, &|_| dot(&r, &r)) + &(int(2) * &c) + &whole,
            ),
        ];
        let kept = kept.into_iter().filter(|_| sign < 0);
        let claims = kept.chain(grown);
        steps.extend(
            claims.map(|(claim, left, right)| Step::equal(format!("{case}: {claim}"), left, right)),
        );
    }
    steps
}
