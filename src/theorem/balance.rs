//! Theorems on the balance of forces on every sphere.

use alloc::format;
use alloc::vec::Vec;

use num_traits::{One, Zero};

use super::setting::{
    P, Setting, above, by_component, by_line, cross, equations, int, nothing_left, symbol,
    transmitted,
};
use super::{Formulas, ProofKind, Step, Theorem};
use crate::each::Each;
use crate::geometry::Vector;
use crate::lattice::{Direction, Sign};

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "paper-system",
        statement: "For any forces, (3) is the paper's system (4). The increments (6), Δα = Δβ = 1 and Δγ = 2s in the \
                     unit mg/(2(1+s)cosθ), solve (5) for every φ. With denominators cleared, (5) is s(Δα+Δβ) − Δγ = 0, \
                     Δα − Δβ = 0 and Δα+Δβ+Δγ = 2(1+s), which is the weight W. The solution is unique, because the \
                     determinant of the three directions is 1+s, which is not 0; an identity",
        hypotheses: "0 < s < 1",
        method: ProofKind::Identity,
        symbols: "s, w, α, β, γ, α', β', γ'",
        derive: paper_system,
    },
    Theorem {
        name: "unit-directions",
        statement: "The vectors ê_a, ê_b, ê_c have length 1, and the Gram form gives squared distances: |n_a ê_a + \
                     n_b ê_b + n_c ê_c|² = squared_distance(n), with σ = sin²θ; an identity",
        hypotheses: "0 < s < 1, 0 < σ < 1",
        method: ProofKind::Identity,
        symbols: "a, b, c, s, σ",
        derive: unit_directions,
    },
    Theorem {
        name: "equilibrium",
        statement: "Equilibrium of every sphere of the paper's pile, also at the surface: the forces from the three \
                     supports balance the forces from above and the weight, in all three components, for every φ. The \
                     same holds for a sphere of any weight n·mg that receives any forces under steps of one sign; an \
                     identity",
        hypotheses: "0 ≤ j ≤ k, 0 ≤ i ≤ k−j, 0 < s < 1; any g_1, g_2, g_3, n",
        method: ProofKind::Identity,
        symbols: "i, j, k, s, n, g_1, g_2, g_3",
        derive: equilibrium,
    },
    Theorem {
        name: "surface",
        statement: "Equilibrium at the surface: if no sphere lies above on a line, the force from above along this \
                     line is zero. So the equations of an inner sphere also hold for a sphere at the surface i = 0, j \
                     = 0 or i+j = k; an identity",
        hypotheses: "sites of a face",
        method: ProofKind::Identity,
        symbols: "i, j, k, s",
        derive: surface,
    },
    Theorem {
        name: "action-reaction",
        statement: "Action and reaction: the force that a sphere transmits in a direction is the force that the sphere \
                    below receives from it, so that every contact has one force; for every φ; an identity",
        hypotheses: "a sphere off the floor",
        method: ProofKind::Identity,
        symbols: "i, j, k, s",
        derive: action_reaction,
    },
    Theorem {
        name: "central-force",
        statement: "Central force: on an equilateral base, the forces from above on a sphere sum to mg/(6R cosθ)·r, \
                     where r is its position relative to the apex. In units of f₀ and 2R both are ((3j−k)/2, \
                     (2i+j−k)/2, k), with √3 in the unit along y; an identity",
        hypotheses: "s = 1/2",
        method: ProofKind::Identity,
        symbols: "i, j, k",
        derive: central_force,
    },
    Theorem {
        name: "half-turn",
        statement: "The matrix G = (2/3)J − I, which transmits forces across a sign change of the stacking, maps g to \
                     (2/3)(g_1+g_2+g_3)(1,1,1) − g. It is orthogonal (|Gg|² = |g|²), symmetric (h·Gg = g·Gh) and its \
                     own inverse (GGg = g), and it fixes (1, 1, 1); an identity",
        hypotheses: "any forces g, h",
        method: ProofKind::Identity,
        symbols: "g_1, g_2, g_3, h_1, h_2, h_3",
        derive: half_turn,
    },
];

fn paper_system(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let s = &setting.s;
    let up @ [a, b, c] = &["α", "β", "γ"].each(symbol);
    let down @ [a1, b1, c1] = &["α'", "β'", "γ'"].each(symbol);
    let (e, weight) = (&setting.directions, symbol("w"));
    let sum = (f.unbalanced)(up, e, down, e, &weight);
    let [delta_a, delta_b, delta_c] = [a.clone() - a1, b.clone() - b1, c.clone() - c1];
    let along_x = s.clone() * &(delta_a.clone() + &delta_b) - &delta_c;
    let along_z = weight - &delta_a - &delta_b - &delta_c;
    let [alpha, beta, gamma] = &setting.increments;
    let horizontal = s.clone() * &(alpha.clone() + beta) - gamma;
    let vertical = alpha.clone() + beta + gamma;
    let double = int(2) * &(int(1) + s);
    let [e_a, e_b, e_c] = e;
    let Vector { x, y, z } = cross(e_b, e_c);
    let determinant = e_a.x.clone() * &x + &(e_a.y.clone() * &y) + &(e_a.z.clone() * &z);
    equations! {
        "(4a), x: s(α−α'+β−β') − γ+γ'": sum.x => along_x,
        "(4b), twice y: α−α' − β+β'": sum.y * &int(2) => delta_a - &delta_b,
        "(4c), z: w − (α−α') − (β−β') − (γ−γ')": sum.z => along_z,
        "along x: s(Δα+Δβ) − Δγ = 0": horizontal => P::zero(),
        "along y: Δα − Δβ = 0": alpha.clone() - beta => P::zero(),
        "along z: Δα+Δβ+Δγ = 2(1+s)": vertical => double.clone(),
        "W = 2(1+s)": setting.weight.clone() => double,
        "ê_a·(ê_b × ê_c) = 1+s": determinant => int(1) + s,
    }
}

fn unit_directions(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let sin2 = symbol("σ");
    let cos2 = P::one() - &sin2;
    let square =
        |v: &Vector<P>| setting.horizontal_square(v) * &sin2 + &(v.z.clone() * &v.z * &cos2);
    let mut steps = Vec::new();
    for (e, direction) in setting.directions.iter().zip(Direction::ALL) {
        let claim = format!("|ê|² = 1 for {direction}");
        steps.push(Step::equal(claim, square(e), P::one()));
    }
    let n = ["a", "b", "c"].each(symbol);
    let apart = Vector::combination(&n, &setting.directions);
    let form = (f.squared_distance)(&n, &setting.s, &sin2);
    steps.extend(equations! {
        "the Gram form is the squared length": form => square(&apart),
    });
    steps
}

fn equilibrium(f: &Formulas) -> Vec<Step> {
    let (setting, here) = (Setting::isosceles(f), above(f));
    let to_below = setting.to_below(f, setting.received(f, &here));
    let supports = Vector::combination(&to_below, &setting.directions);
    let load = setting.support_load(f, &here);
    let left = setting.unbalanced(f, &here);
    let mut steps = by_component("supports = −(from above + weight)", supports, -load);
    steps.extend(nothing_left("the resultant of all forces is 0", left));
    let g = ["g_1", "g_2", "g_3"].each(symbol);
    let (own, weight) = setting.loaded(f, &symbol("n"));
    let to_below = transmitted(f, g.clone(), &own);
    for (sign, e) in [
        ("+", setting.directions.clone()),
        ("−", setting.turned_directions(f)),
    ] {
        let left = (f.unbalanced)(&to_below, &e, &g, &e, &weight);
        let claim = "the resultant is 0 for any forces and any weight";
        steps.extend(nothing_left(&format!("under {sign}, {claim}"), left));
    }
    steps
}

fn surface(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let [i, j, k] = ["i", "j", "k"].each(symbol);
    let zero = P::zero();
    let faces = [
        ("α on i+j = k", (&i, &j, &(i.clone() + &j))),
        ("β on i = 0", (&zero, &j, &k)),
        ("γ on j = 0", (&i, &zero, &k)),
    ];
    let forces = faces.each(|(face, (i, j, k))| (face, setting.received(f, &(f.above)(i, j, k))));
    let steps = forces.into_iter().zip(Direction::ALL);
    let step = |((face, forces), direction): ((&str, [P; 3]), Direction)| {
        let claim = format!("no force from above along {face}");
        Step::equal(claim, forces[direction.index()].clone(), P::zero())
    };
    steps.map(step).collect()
}

fn action_reaction(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let [i, j, k] = ["i", "j", "k"].each(symbol);
    let given = setting.to_below(f, setting.received(f, &above(f)));
    Direction::ALL
        .into_iter()
        .zip(given)
        .map(|(direction, given)| {
            let [di, dj] = (f.descent)(Sign::Plus, direction).each(int);
            let below = (f.above)(
                &(i.clone() + &di),
                &(j.clone() + &dj),
                &(k.clone() + &int(1)),
            );
            let received = setting.received(f, &below);
            let claim = format!("{direction}: given above = received below");
            Step::equal(claim, given, received[direction.index()].clone())
        })
        .collect()
}

fn central_force(f: &Formulas) -> Vec<Step> {
    let (setting, here) = (Setting::equilateral(f), above(f));
    let [i, j, k] = ["i", "j", "k"].each(symbol);
    let force = (f.resultant)(&setting.received(f, &here), &setting.directions);
    let at = (f.position)(&here, &setting.directions);
    let across = int(3) * &j - &k;
    let along = int(2) * &i + &j - &k;
    let twice = |v: Vector<P>| v.map(|part| part * &int(2));
    let written = Vector {
        x: across,
        y: along,
        z: int(2) * &k,
    };
    let written_out = "(3j−k, 2i+j−k, 2k)";
    let claim = format!("twice the resultant from above is {written_out}");
    let mut steps = by_component(&claim, twice(force), written.clone());
    let claim = format!("twice the position r is {written_out}");
    steps.extend(by_component(&claim, twice(at), written));
    steps
}

fn half_turn(f: &Formulas) -> Vec<Step> {
    let dot = |a: &[P; 3], b: &[P; 3]| {
        a.iter()
            .zip(b)
            .fold(P::zero(), |sum, (x, y)| sum + &(x.clone() * y))
    };
    let g = ["g_1", "g_2", "g_3"].each(symbol);
    let h = ["h_1", "h_2", "h_3"].each(symbol);
    let (turned, other) = ((f.half_turn)(&g), (f.half_turn)(&h));
    let mut steps = equations! {
        "|Gg|² = |g|²": dot(&turned, &turned) => dot(&g, &g),
        "h·Gg = g·Gh": dot(&h, &turned) => dot(&g, &other),
    };
    let sum = g.iter().fold(P::zero(), |sum, x| sum + x);
    for (x, gx) in g.iter().zip(&turned) {
        steps.extend(equations! {
            "3(g + Gg) = 2(g_1+g_2+g_3)(1,1,1)": (x.clone() + gx) * &int(3) => sum.clone() * &int(2),
        });
    }
    let ones = [P::one(), P::one(), P::one()];
    steps.extend(by_line("GGg = g", (f.half_turn)(&turned), g));
    steps.extend(by_line("G(1,1,1) = (1,1,1)", (f.half_turn)(&ones), ones));
    steps
}
