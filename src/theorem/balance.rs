//! Theorems on the balance of forces on every sphere.

use alloc::format;
use alloc::vec::Vec;

use num_traits::{One, Zero};

use super::setting::{P, Setting, above, int, symbol};
use super::{Formulas, ProofKind, Step, Theorem};
use crate::geometry::Vector;
use crate::lattice::Direction;

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "paper-system",
        statement: "The increments Δα = Δβ = 1, Δγ = 2s in the unit mg/(2(1+s)cosθ) solve the paper's system, \
                    denominators cleared: s(Δα+Δβ) − Δγ = 0, Δα − Δβ = 0, Δα+Δβ+Δγ = 2(1+s); for every φ; an identity",
        hypotheses: "0 < s < 1",
        method: ProofKind::Identity,
        symbols: "s",
        derive: paper_system,
    },
    Theorem {
        name: "unit-directions",
        statement: "The vectors ê_a, ê_b, ê_c have length 1, and squared distances are those of the Gram form: \
                    |n_a ê_a + n_b ê_b + n_c ê_c|² = squared_distance(n), with σ = sin²θ; an identity",
        hypotheses: "0 < s < 1, 0 < σ < 1",
        method: ProofKind::Identity,
        symbols: "a, b, c, s, σ",
        derive: unit_directions,
    },
    Theorem {
        name: "equilibrium",
        statement: "Equilibrium of every sphere, at the surface too: the three supports push with what the forces \
                    from above and the weight press, in all three components, for every φ; an identity",
        hypotheses: "0 ≤ j ≤ k, 0 ≤ i ≤ k−j, 0 < s < 1",
        method: ProofKind::Identity,
        symbols: "i, j, k, s",
        derive: equilibrium,
    },
    Theorem {
        name: "surface",
        statement: "Equilibrium at the surface: where no sphere lies above on a line, its force from above is zero, so \
                    the equations of a sphere inside hold for one at the surface i = 0, j = 0 or i+j = k; an identity",
        hypotheses: "sites of a face",
        method: ProofKind::Identity,
        symbols: "i, j, k, s",
        derive: surface,
    },
    Theorem {
        name: "action-reaction",
        statement: "Action and reaction: what a sphere passes on in a direction is what the sphere below receives from \
                    it, so that every contact has one force; for every φ; an identity",
        hypotheses: "a sphere off the floor",
        method: ProofKind::Identity,
        symbols: "i, j, k, s",
        derive: action_reaction,
    },
    Theorem {
        name: "central-force",
        statement: "Central force: the forces from above on a sphere of a pile with equilateral base sum to \
                    mg/(6R cosθ)·r, r its position from the apex; in f₀ and 2R they are equal; an identity",
        hypotheses: "s = 1/2",
        method: ProofKind::Identity,
        symbols: "i, j, k",
        derive: central_force,
    },
    Theorem {
        name: "half-turn",
        statement: "G = (2/3)J − I, which passes forces across a sign change of the stacking, takes g to (2/3)(g_1+g_2+g_3)(1,1,1) − g; it is orthogonal \
                    (|Gg|² = |g|²), symmetric (h·Gg = g·Gh), its own inverse (GGg = g), and fixes (1, 1, 1); an identity",
        hypotheses: "any forces g, h",
        method: ProofKind::Identity,
        symbols: "g_1, g_2, g_3, h_1, h_2, h_3",
        derive: half_turn,
    },
];

/// One step for each component of two vectors.
fn by_component(claim: &str, left: Vector<P>, right: Vector<P>) -> Vec<Step> {
    let sides = left.into_array().into_iter().zip(right.into_array());
    ["x", "y", "z"]
        .into_iter()
        .zip(sides)
        .map(|(axis, (left, right))| Step::equal(format!("{axis}: {claim}"), left, right))
        .collect()
}

fn paper_system(f: &Formulas) -> Vec<Step> {
    let s = symbol("s");
    let increments = (f.increments)(&s);
    let [alpha, beta, gamma] = &increments;
    let horizontal = s.clone() * &(alpha.clone() + beta) - gamma;
    let vertical = alpha.clone() + beta + gamma;
    let weight = int(2) * &(int(1) + &s);
    Vec::from([
        Step::equal("along x: s(Δα+Δβ) − Δγ = 0", horizontal, P::zero()),
        Step::equal("along y: Δα − Δβ = 0", alpha.clone() - beta, P::zero()),
        Step::equal("along z: Δα+Δβ+Δγ = 2(1+s)", vertical, weight.clone()),
        Step::equal("W = 2(1+s)", (f.weight)(&increments), weight),
    ])
}

fn unit_directions(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let sin2 = symbol("σ");
    let cos2 = P::one() - &sin2;
    let square =
        |v: &Vector<P>| setting.horizontal_square(v) * &sin2 + &(v.z.clone() * &v.z * &cos2);
    let mut steps: Vec<Step> = setting
        .directions
        .iter()
        .zip(Direction::ALL)
        .map(|(e, direction)| Step::equal(format!("|ê|² = 1 for {direction}"), square(e), P::one()))
        .collect();
    let n = ["a", "b", "c"].map(symbol);
    let apart = Vector::combination(&n, &setting.directions);
    let form = (f.squared_distance)(&n, &setting.s, &sin2);
    steps.push(Step::equal(
        "the Gram form is the squared length",
        form,
        square(&apart),
    ));
    steps
}

fn equilibrium(f: &Formulas) -> Vec<Step> {
    let (setting, here) = (Setting::isosceles(f), above(f));
    let to_below = setting.to_below(f, setting.from_above(f, &here));
    let supports = Vector::combination(&to_below, &setting.directions);
    let load = setting.handed_on(f, &here);
    let left = setting.unbalanced(f, &here);
    let mut steps = by_component("supports = −(from above + weight)", supports, -load);
    steps.extend(by_component(
        "what is left of all forces is 0",
        left,
        Vector::zero(),
    ));
    steps
}

fn surface(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let [i, j, k] = ["i", "j", "k"].map(symbol);
    let zero = P::zero();
    let faces = [
        ("α on i+j = k", (&i, &j, &(i.clone() + &j))),
        ("β on i = 0", (&zero, &j, &k)),
        ("γ on j = 0", (&i, &zero, &k)),
    ];
    faces
        .into_iter()
        .enumerate()
        .map(|(line, (claim, (i, j, k)))| {
            let forces = setting.from_above(f, &(f.above)(i, j, k));
            let force = forces.into_iter().nth(line).unwrap_or_else(P::one);
            Step::equal(
                format!("no force from above along {claim}"),
                force,
                P::zero(),
            )
        })
        .collect()
}

fn action_reaction(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let [i, j, k] = ["i", "j", "k"].map(symbol);
    let given = setting.to_below(f, setting.from_above(f, &above(f)));
    Direction::ALL
        .into_iter()
        .zip(given)
        .enumerate()
        .map(|(line, (direction, given))| {
            let [di, dj, dk] = (f.descent)(direction).map(int);
            let below = (f.above)(&(i.clone() + &di), &(j.clone() + &dj), &(k.clone() + &dk));
            let received = setting.from_above(f, &below).into_iter().nth(line);
            let claim = format!("{direction}: given above = received below");
            Step::equal(claim, given, received.unwrap_or_else(P::zero))
        })
        .collect()
}

fn central_force(f: &Formulas) -> Vec<Step> {
    let (setting, here) = (Setting::equilateral(f), above(f));
    let directions = &setting.directions;
    let force = (f.resultant)(&setting.from_above(f, &here), directions);
    by_component(
        "resultant from above = r/(2R)",
        force,
        (f.position)(&here, directions),
    )
}

fn half_turn(f: &Formulas) -> Vec<Step> {
    let dot = |a: &[P; 3], b: &[P; 3]| {
        a.iter()
            .zip(b)
            .fold(P::zero(), |sum, (x, y)| sum + &(x.clone() * y))
    };
    let g = ["g_1", "g_2", "g_3"].map(symbol);
    let h = ["h_1", "h_2", "h_3"].map(symbol);
    let (turned, other) = ((f.half_turn)(&g), (f.half_turn)(&h));
    let mut steps = Vec::from([
        Step::equal("|Gg|² = |g|²", dot(&turned, &turned), dot(&g, &g)),
        Step::equal("h·Gg = g·Gh", dot(&h, &turned), dot(&g, &other)),
    ]);
    let sum = g.iter().fold(P::zero(), |sum, x| sum + x);
    for (x, gx) in g.iter().zip(&turned) {
        let left = (x.clone() + gx) * &int(3);
        steps.push(Step::equal(
            "3(g + Gg) = 2(g_1+g_2+g_3)(1,1,1)",
            left,
            sum.clone() * &int(2),
        ));
    }
    let ones = [P::one(), P::one(), P::one()];
    let twice = (f.half_turn)(&turned);
    steps.extend(
        twice
            .into_iter()
            .zip(g)
            .map(|(left, right)| Step::equal("GGg = g", left, right)),
    );
    let fixed = (f.half_turn)(&ones).into_iter().zip(ones);
    steps.extend(fixed.map(|(left, right)| Step::equal("G(1,1,1) = (1,1,1)", left, right)));
    steps
}
