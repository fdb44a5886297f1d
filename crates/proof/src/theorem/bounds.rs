//! Theorems on horizontal contacts, at a = R: bounds of the forces on the floor, arches, and long runs.

use cannonpile::each::Each;
use cannonpile::lattice::{Axis, Direction, Sign};
use cannonpile::scalar::{Algebra, Symbol};
use cannonpile::theorem::setting::{P, by_line, equations, int, sum_over_layer, symbol};
use cannonpile::theorem::{ProofKind, Step};
use num_traits::{One, Zero};

use super::terms::{SIGNS, THREE, Theorem, beside, each, on, plus, sum, symbols};
use crate::Formulas;

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "corner-least",
        statement: "The smallest normal force at a corner is (L+2)/3 mg. Let φ = 1 along the edge that leads to the \
                    corner, and φ = 0 along the other lines and on other spheres. Then D = 0 at all contacts of the \
                    edge but the last, D = 1 there, and c = −1 at the horizontal contacts of the edge. Other contacts \
                    (in words) have D = c = 0. Σφ = K, so (in words, by theorem virtual-work) the load on the corner \
                    is at least K f₀; an identity",
        hypotheses: "K = L−1",
        method: ProofKind::Identity,
        symbols: "K",
        derive: corner_least,
    },
    Theorem {
        name: "corner-greatest",
        statement: "The largest normal force at a corner is (L − 2/3) mg. Let φ = 1 along all lines of the spheres of \
                    the edge below the apex, and along the edge at the apex. Then D = 0 along the edge, D = 1 at its \
                    last contact, D = 1 along the other lines (0 at the apex), and c = 0. Other contacts (in words) \
                    have D = c = 0. Σφ = 3K−2, so (in words) the load on the corner is at most 3K−2 f₀. X = 1 between \
                    the spheres of the edge and their neighbours attains it. A sphere (t, 0, 0) that receives 3t−2 \
                    along the edge, the first one from the apex, transmits 3(t+1)−2, and nothing along other lines. \
                    Its neighbour adds 0 along the edge, 2 along the line that leads to it from that edge and 1 along \
                    the third line, so that (in words) no force is negative; by induction",
        hypotheses: "K = L−1 ≥ 1, for K = 1 the field of corner-least",
        method: ProofKind::Induction,
        symbols: "K, t, g_1, g_2, g_3",
        derive: corner_greatest,
    },
    Theorem {
        name: "arch",
        statement: "An arch unloads a sphere. Three spheres would transmit ν_l to the sphere below them, and press on \
                    each other with X_ab = (ν_a+ν_b−ν_c)/2. Then each transmits ν_l − 1 + 1 − ν_l = 0 to it, and adds \
                    1 + X_ab along the lines of the others. The flank removes the load above ν: of two spheres that \
                    press on each other with X = 1, one adds nothing along one line and 2 along the other, and its \
                    neighbour the reverse. For ν = (r, n_B, n_C) X = (0, n_C, n_B) at r = n_B + n_C, and (in words) no \
                    X is negative, as n_C ≤ n_B ≤ r ≤ n_B + n_C. The paper's page proves in words that the load on n \
                    is zero and no contact is tensile; an identity",
        hypotheses: "n_A ≥ n_B ≥ n_C, n_B ≥ 1, r = min(n_A, n_B + n_C)",
        method: ProofKind::Identity,
        symbols: "g_1, g_2, g_3, ν_1, ν_2, ν_3, n_B, n_C",
        derive: arch,
    },
    Theorem {
        name: "inner-greatest",
        statement: "An upper bound for any bottom sphere n is 1 + ΣC(n_l+2, 3)/3 mg, and 1 + C(k+2, 3) at a centre (k, \
                    k, k). Let φ_l = 1 on the spheres with at least n_m along both other lines m, which form a pile of \
                    n_l layers. Then Σφ is that sum. The paper's page proves the signs of D and c in words; by summing \
                    over the spheres",
        hypotheses: "n_l ≥ 0",
        method: ProofKind::Sum,
        symbols: "k, n_1, n_2, n_3",
        derive: inner_greatest,
    },
    Theorem {
        name: "edge-greatest",
        statement: "An upper bound for the bottom sphere (k, j, 0) of an edge, with c = min(j+1, k). The field is 1 \
                    along α on S₀, along β on S₁, and along γ on the spheres of S₀ with n_α ≥ 1 and of S₁ with n_β ≥ \
                    1. It sums to 2k − 1 + (c−1)² + 2j(k−c) + j², which is 2(j+1)(k−1) + 1 for k > j, and 2k² for k = \
                    j. S₀ are the spheres of the face with n_β = j, n_α < k or n_β > j, n_α + n_β < j + c. S₁ are \
                    those with n_α ≥ c, n_β ≤ j. The paper's page proves the signs of D and c in words; by summing \
                    over the spheres",
        hypotheses: "k ≥ j ≥ 1",
        method: ProofKind::Sum,
        symbols: "c, j, k",
        derive: edge_greatest,
    },
    Theorem {
        name: "run-horizontal",
        statement: "Long runs are unstable with horizontal contacts too. Consider the spheres on the edge with line l \
                    only (theorem edge). Their two neighbours off the edge press them along l, with x and y, under \
                    either sign. Within a run such a sphere transmits g + 1 + x + y. At its end, where the sign \
                    changes, f = 1 − g/3 − x − y, or f + g + x + y = (2g+3)/3. For g = 4+p this is −(1+p)/3 − x − y. \
                    So (in words) no run of four steps from the top, or of five after a change, is followed by a \
                    change in a stable pile; an identity",
        hypotheses: "x, y, p ≥ 0, weights of mg",
        method: ProofKind::Identity,
        symbols: "g, p, x, y",
        derive: run_horizontal,
    },
];

/// Returns the other two lines.
fn others(line: Direction) -> [Direction; 2] {
    [1, 2].each(|n| Direction::ALL[(line.index() + n) % 3])
}

/// Returns the drops D of a sphere, from its field and the field of the spheres below.
fn drops(f: &Formulas, here: &[P; 3], below: &[P; 3]) -> [P; 3] {
    let of_line = |l: usize| (f.contact_drop)(here[l].clone(), &below[l]);
    Direction::ALL.each(Direction::index).each(of_line)
}

fn corner_least(f: &Formulas) -> Vec<Step> {
    let (k, one) = (symbol("K"), P::one());
    let mut steps = Vec::new();
    for edge in Direction::ALL {
        let field = (f.corner_field)(edge, false);
        let inside = drops(f, &field, &on(edge, &field[edge.index()]));
        let at = |what: &str| format!("the edge {edge}: {what}");
        steps.extend(by_line(&at("D"), inside, each(0)));
        steps.extend(by_line(
            &at("D at its end"),
            drops(f, &field, &each(0)),
            on(edge, &one),
        ));
        for other in others(edge) {
            let c = (f.compression)(&field, &each(0), [edge, other], Sign::Plus);
            steps.extend(equations! { (at("c")): c => int(-1) });
        }
        let work = k.clone() * &sum(field);
        steps.extend(equations! { (at("Σφ")): work => (f.least_on_corner)(&k) });
    }
    steps
}

fn corner_greatest(f: &Formulas) -> Vec<Step> {
    let ([k, t], one) = (["K", "t"].each(symbol), P::one());
    let g = symbols(["g_1", "g_2", "g_3"]);
    let received = |t: &P| int(3) * t - &int(2);
    let first = (f.core.beside)(P::zero(), &one, &P::zero(), Sign::Plus);
    let mut steps = equations! { "base case, from the apex": first => received(&one) };
    for edge in Direction::ALL {
        let [apex, field] = [false, true].each(|all| (f.corner_field)(edge, all));
        let below = on(edge, &field[edge.index()]);
        let at = |what: &str| format!("the edge {edge}: {what}");
        let not_along = plus(each(1), &on(edge, &int(-1)));
        steps.extend(by_line(&at("D"), drops(f, &field, &below), not_along));
        steps.extend(by_line(
            &at("D at the apex"),
            drops(f, &apex, &below),
            each(0),
        ));
        steps.extend(by_line(
            &at("D at its end"),
            drops(f, &field, &each(0)),
            each(1),
        ));
        let work = sum(apex) + &((k.clone() - &one) * &sum(field.clone()));
        steps.extend(equations! { (at("Σφ")): work => (f.greatest_on_corner)(&k) });
        let mut pushed = each(0);
        for other in others(edge) {
            let ends = [edge, other];
            let c = (f.compression)(&field, &each(0), ends, Sign::Plus);
            steps.extend(equations! { (at("c")): c => P::zero() });
            pushed = plus(pushed, &(f.core.pushed)(&one, ends, true));
            let passed = beside(
                &f.core,
                &g,
                &one,
                &(f.core.pushed)(&one, ends, false),
                Sign::Plus,
            );
            let added = plus(on(edge, &int(-1)), &plus(on(other, &one), &each(1)));
            steps.extend(by_line(&at("a neighbour"), passed, plus(g.clone(), &added)));
        }
        let passed = beside(&f.core, &on(edge, &received(&t)), &one, &pushed, Sign::Plus);
        let further = on(edge, &received(&(t.clone() + &one)));
        steps.extend(by_line(&at("step, a sphere of it"), passed, further));
    }
    steps
}

fn arch(f: &Formulas) -> Vec<Step> {
    let g = symbols(["g_1", "g_2", "g_3"]);
    let nu = symbols(["ν_1", "ν_2", "ν_3"]);
    let (forces, one) = ((f.arch)(&nu), P::one());
    let more = plus(g.clone(), &each(1));
    let mut steps = Vec::new();
    for line in Direction::ALL {
        let (l, mut received) = (line.index(), g.clone());
        let (mut pushed, mut expected) = (each(0), more.clone());
        let [a, b] = others(line);
        // The force between n − e_l and n − e_a is numbered by the third line, b.
        for (other, third) in [(a, b), (b, a)] {
            let force = &forces[third.index()];
            pushed = plus(pushed, &(f.core.pushed)(force, [other, line], true));
            expected = plus(expected, &on(other, force));
        }
        received[l] = nu[l].clone() - &one;
        expected[l] = P::zero();
        let passed = beside(&f.core, &received, &one, &pushed, Sign::Plus);
        steps.extend(by_line(
            &format!("the sphere above along {line}"),
            passed,
            expected,
        ));
    }
    for axis in Axis::ALL {
        let [a, b] = axis.ends();
        for (leads_away, twice, none) in [(true, a, b), (false, b, a)] {
            let pushed = (f.core.pushed)(&one, [a, b], leads_away);
            let passed = beside(&f.core, &g, &one, &pushed, Sign::Plus);
            let added = plus(on(twice, &one), &on(none, &int(-1)));
            let claim = format!("the flank: 2 along {twice}, nothing along {none}");
            steps.extend(by_line(&claim, passed, plus(more.clone(), &added)));
        }
    }
    let [n_b, n_c] = ["n_B", "n_C"].each(symbol);
    let steep = (f.arch)(&[n_b.clone() + &n_c, n_b.clone(), n_c.clone()]);
    steps.extend(by_line("r = n_B + n_C: X", steep, [P::zero(), n_c, n_b]));
    steps
}

fn inner_greatest(f: &Formulas) -> Vec<Step> {
    let (n, k, zero) = (symbols(["n_1", "n_2", "n_3"]), symbol("k"), P::zero());
    let layer = sum_over_layer(&P::one(), &k);
    let deep = |n: &P| layer.sum(Symbol("k"), &zero, &(n.clone() - &P::one()));
    let centre = (f.greatest_inside)(&[k.clone(), k.clone(), k.clone()]);
    let product = k.clone() * &(k.clone() + &int(1)) * &(k + &int(2));
    equations! {
        "Σφ": sum(n.each_ref().each(deep)) => (f.greatest_inside)(&n),
        "at a centre 2 Σφ is k(k+1)(k+2)": centre * &int(2) => product,
    }
}

fn edge_greatest(f: &Formulas) -> Vec<Step> {
    let [c, j, k] = &symbols(["c", "j", "k"]);
    let ([zero, one], y) = (&[P::zero(), P::one()], symbol("y"));
    let last = |p: &P| p.clone() - one;
    let row = |from: &P, to: &P| one.sum(Symbol("x"), from, to);
    // Rows from x = n_α on: S₀ with n_β = j, S₀ with n_β = j + y, and S₁ with n_β = y.
    let lone = |from: &P| row(from, &last(k));
    let above = |from: &P| row(from, &(last(c) - &y)).sum(Symbol("y"), one, &last(c));
    let right = |from: &P| row(c, &(last(k) + j - &y)).sum(Symbol("y"), from, j);
    // Along γ the spheres in both sets are counted once.
    let gamma = lone(one) + &above(one) + &right(one) - &lone(c);
    let next = j.clone() + one;
    let beyond = int(2) * &next * &last(k) + one;
    equations! {
        "Σφ": lone(zero) + &above(zero) + &right(zero) + &gamma => (f.greatest_on_edge)(k, j, c),
        "c = j+1": (f.greatest_on_edge)(k, j, &next) => beyond,
        "c = k = j": (f.greatest_on_edge)(k, k, k) => int(2) * k * k,
    }
}

fn run_horizontal(f: &Formulas) -> Vec<Step> {
    let ([g, x, y], [p, one]) = (symbols(["g", "x", "y"]), [symbol("p"), P::one()]);
    let pressed = x.clone() + &y;
    let mut steps = Vec::new();
    for (name, sign) in SIGNS {
        for line in Direction::ALL {
            let l = line.index();
            let [a, b] = others(line);
            // For + steps the layer lies on the side where the line begins. For − steps it lies on the opposite side.
            let push = |force: &P, other| (f.core.pushed)(force, [line, other], sign == Sign::Plus);
            let h = plus(push(&x, a), &push(&y, b))[l].clone();
            let within = (f.core.beside)(g.clone(), &one, &h, sign);
            let turned = (f.core.half_turn)(&on(line, &g))[l].clone();
            let end = (f.core.beside)(turned, &one, &h, -sign);
            let long = end.substitute(Symbol("g"), &(int(4) + &p)) * &int(3);
            let short = one.clone() - &g.clone().div_int(THREE) - &pressed;
            let at = |what: &str| format!("{name} along {line}: {what}");
            steps.extend(equations! {
                (at("within the run")): within => g.clone() + &one + &pressed,
                (at("at its end")): end => short,
                (at("at its end three times, g = 4+p")): long => -(one.clone() + &p + &(int(3) * &pressed)),
            });
        }
    }
    steps
}
