//! Theorems on piles with horizontal contacts, at a = R: balance, virtual work and the elastic state.

use cannonpile::each::Each;
use cannonpile::geometry::Vector;
use cannonpile::lattice::{Axis, Direction, Sign};
use cannonpile::scalar::Algebra;
use cannonpile::theorem::setting::{
    P, Setting, above, by_component, by_line, equations, int, last_layer, sum_off_floor, symbol,
};
use cannonpile::theorem::{ProofKind, Step};
use num_traits::{One, Zero};

use super::terms::{SIGNS, THREE, Theorem, beside, each, on, plus, sum, symbols, transferred};
use crate::Formulas;

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "horizontal-balance",
        statement: "At a = R neighbours touch, |ê_a − ê_b| = 1. A sphere of weight n·mg receives any forces g and \
                    transmits f = Tg + n − σH. Here T = G at a sign change, and H is the sum of the entries of its \
                    horizontal forces. Then the sphere is in equilibrium with these horizontal forces: X from the \
                    neighbour p + d_b − d_a along σ(ê_b − ê_a), and Y from p − d_b + d_a along the reverse, for all \
                    six neighbours at once; an identity",
        hypotheses: "s = 1/2, sin²θ = 1/3; any g_1, g_2, g_3, n, X, Y",
        method: ProofKind::Identity,
        symbols: "g_1, g_2, g_3, n, X_1, X_2, X_3, Y_1, Y_2, Y_3",
        derive: horizontal_balance,
    },
    Theorem {
        name: "virtual-work",
        statement: "Virtual work, for any field φ and any forces in balance. The balance of a sphere times φ is Σφ_l \
                    f_l + σΣφ_l H_l = Σg_l(Tφ)_l + wΣφ_l, since T is symmetric, with and without a sign change. For a \
                    sloping contact f φ_l(p) − f (Tφ(q))_l is f D. A horizontal contact contributes X c to σΣφ_l H_l \
                    of its two spheres. So (in words, by adding the balances of all spheres, φ = 0 on the floor) Σ f_l \
                    D_l + Σ X c = Σ w φ_l; an identity",
        hypotheses: "s = 1/2; any φ, g, H, w, X",
        method: ProofKind::Identity,
        symbols: "φ_1, φ_2, φ_3, φ'_1, φ'_2, φ'_3, g_1, g_2, g_3, h_1, h_2, h_3, f, w, X",
        derive: virtual_work,
    },
    Theorem {
        name: "elastic-straight",
        statement: "The elastic state of the paper's pile, d layers above the floor: φ_l = d·n_l + d(d+1)/2 is 0 on \
                    the floor. It has D_l = n_l + 1, the force that the sphere transmits, and c = −2d at every \
                    horizontal contact. The same holds for discs. So (in words) it satisfies the conditions of the \
                    elastic state with X = 0 for every L and every stiffness of horizontal contacts, and these open by \
                    2d f₀/κ; an identity",
        hypotheses: "s = 1/2, 0 ≤ j ≤ k, 0 ≤ i ≤ k−j; discs: j = 0",
        method: ProofKind::Identity,
        symbols: "i, j, k, n, d",
        derive: elastic_straight,
    },
    Theorem {
        name: "elastic-energy",
        statement: "Energy of the elastic state: Σf² = L(L−1)(L+1)(L+2)(2L+1)/40 f₀² over all contacts. It equals the \
                    work of the weights, Σφ_l; by summing over the spheres above the floor",
        hypotheses: "L ≥ 1, s = 1/2",
        method: ProofKind::Sum,
        symbols: "L",
        derive: elastic_energy,
    },
    Theorem {
        name: "settlement",
        statement: "Settlement in the elastic state, with φ_l = w − p_l and w the mean of the three φ_l. Every sphere \
                    of layer k has w = d(3L−k)/6, d = L−1−k, so layers stay plane. p_l = −d(n_l − k/3), so each layer \
                    dilates uniformly. The apex sinks by w = L(L−1)/2 in f₀/κ, which is (in words) \
                    L(L−1)/2·mg/(3κcos²θ); an identity",
        hypotheses: "s = 1/2, 0 ≤ j ≤ k, 0 ≤ i ≤ k−j",
        method: ProofKind::Identity,
        symbols: "L, i, j, k",
        derive: settlement,
    },
    Theorem {
        name: "elastic-monotone",
        statement: "Any base with equal steps and equal weights. A minimum of four arguments counts the spheres above \
                    a sphere (theorem region-counts). From a sphere to its neighbour p + d_b − d_a two of the \
                    arguments change by σ along b, and two by −σ along a; the others are constant. So (in words) σf_b \
                    does not decrease and σf_a does not increase. The same holds for sums of increasing functions of \
                    them along the lines below. Hence c ≤ 0 without horizontal forces, which is the elastic state; an \
                    identity",
        hypotheses: "two neighbours within the bounds",
        method: ProofKind::Identity,
        symbols: "i, j, m, x_0, x_1, y_0, y_1, s_0, s_1",
        derive: elastic_monotone,
    },
    Theorem {
        name: "no-dip",
        statement: "No dip: the arguments of the minimum that counts the spheres above a bottom sphere are linear in \
                    its position, A(p+v) + A(p−v) = 2A(p). So (in words) their minimum is concave. The normal force 1 \
                    + Σ N_l/3 under a straight pile of equal weights on any base is concave as well; an identity",
        hypotheses: "three spheres p−v, p, p+v of the floor, v = (u, v)",
        method: ProofKind::Identity,
        symbols: "i, j, m, u, v, x_0, x_1, y_0, y_1, s_0, s_1",
        derive: no_dip,
    },
];

fn dot(a: &[P; 3], b: &[P; 3]) -> P {
    sum(a.iter().zip(b).map(|(x, y)| x.clone() * y))
}

fn signed(x: P, sign: Sign) -> P {
    x * &int(sign.factor().into())
}

/// Returns the site p + d_b − d_a.
fn neighbour(f: &Formulas, axis: Axis, i: &P, j: &P) -> [P; 2] {
    let [[a_i, a_j], [b_i, b_j]] = axis.ends().each(|end| (f.core.descent)(Sign::Plus, end));
    [i.clone() + &int(b_i - a_i), j.clone() + &int(b_j - a_j)]
}

fn horizontal_balance(f: &Formulas) -> Vec<Step> {
    let setting = Setting::equilateral(&f.core);
    let (g, n) = (symbols(["g_1", "g_2", "g_3"]), symbol("n"));
    let x = symbols(["X_1", "X_2", "X_3"]);
    let y = symbols(["Y_1", "Y_2", "Y_3"]);
    let (_, weight) = setting.loaded(&f.core, &n);
    let (mut steps, mut h, mut pushes) = (Vec::new(), each(0), Vector::zero());
    for (axis, (x, y)) in Axis::ALL.into_iter().zip(x.iter().zip(&y)) {
        let [a, b] = axis.ends();
        let third = P::one().div_int(THREE);
        let apart = plus(on(a, &int(1)), &on(b, &int(-1)));
        let square = (f.core.squared_distance)(&apart, &setting.s, &third);
        steps.extend(equations! { (format!("neighbours {axis} touch")): square => P::one() });
        h = plus(h, &(f.core.pushed)(x, [a, b], true));
        h = plus(h, &(f.core.pushed)(y, [a, b], false));
        let apart = Vector::combination(&apart, &setting.directions);
        pushes = pushes + &apart.map(|part| part * &(x.clone() - y));
    }
    let under = |sign| match sign {
        Sign::Plus => setting.directions.clone(),
        Sign::Minus => setting.turned_directions(&f.core),
    };
    for (name, below) in SIGNS {
        for (above_name, above) in SIGNS {
            let received = transferred(&f.core, above != below, &g);
            let passed = beside(&f.core, &received, &n, &h, below);
            let left = (f.core.unbalanced)(&passed, &under(below), &g, &under(above), &weight);
            let claim =
                format!("{above_name} above, {name} below: the horizontal forces balance the rest");
            steps.extend(by_component(&claim, left, pushes.clone()));
        }
    }
    steps
}

fn virtual_work(f: &Formulas) -> Vec<Step> {
    let phi = symbols(["φ_1", "φ_2", "φ_3"]);
    let other = symbols(["φ'_1", "φ'_2", "φ'_3"]);
    let g = symbols(["g_1", "g_2", "g_3"]);
    let h = symbols(["h_1", "h_2", "h_3"]);
    let [w, force, x] = symbols(["w", "f", "X"]);
    let [here, below] = [&phi[0], &other[0]];
    let drop = (f.contact_drop)(here.clone(), below);
    let mut steps = equations! {
        "a sloping contact: f D": force.clone() * &drop => force.clone() * here - &(force * below),
    };
    for (name, sign) in SIGNS {
        for (text, changes) in [("kept", false), ("changed", true)] {
            let passed = beside(&f.core, &transferred(&f.core, changes, &g), &w, &h, sign);
            let left = dot(&phi, &passed) + &signed(dot(&phi, &h), sign);
            let weight = w.clone() * &sum(phi.clone());
            steps.extend(equations! {
                (format!("a sphere, {name} below, the sign is {text}")):
                    left => dot(&g, &transferred(&f.core, changes, &phi)) + &weight,
            });
        }
        for axis in Axis::ALL {
            let pushed = |leads_away| (f.core.pushed)(&x, axis.ends(), leads_away);
            let left = dot(&phi, &pushed(true)) + &dot(&other, &pushed(false));
            let c = (f.compression)(&phi, &other, axis.ends(), sign);
            steps.extend(equations! {
                (format!("a horizontal contact {axis}, {name} below: X c")):
                    signed(left, sign) => c * &x,
            });
        }
    }
    steps
}

/// Returns φ of a sphere with n_l spheres above it on its lines, d layers above the floor.
fn elastic_field(f: &Formulas, n: &[P; 3], d: &P) -> [P; 3] {
    n.each_ref().each(|n| (f.elastic_field)(n, d))
}

fn elastic_straight(f: &Formulas) -> Vec<Step> {
    let setting = Setting::equilateral(&f.core);
    let [i, j, k] = symbols(["i", "j", "k"]);
    let [n, d] = ["n", "d"].each(symbol);
    let (next, lower) = (k.clone() + &P::one(), d.clone() - &P::one());
    let mut steps = equations! {
        "on the floor φ = 0": (f.elastic_field)(&n, &P::zero()) => P::zero(),
    };
    for (name, j, dimension) in [("spheres", j, 3), ("discs", P::zero(), 2)] {
        let here = (f.core.above)(&i, &j, &k);
        let phi = elastic_field(f, &here, &d);
        let forces = setting.to_below(&f.core, setting.received(&f.core, &here));
        for direction in &Direction::ALL[..dimension] {
            let l = direction.index();
            let [di, dj] = (f.core.descent)(Sign::Plus, *direction).each(int);
            let below = (f.core.above)(&(i.clone() + &di), &(j.clone() + &dj), &next);
            let below = (f.elastic_field)(&below[l], &lower);
            let drop = (f.contact_drop)(phi[l].clone(), &below);
            let claim = format!("{name}: D along {direction} is the force");
            steps.extend(equations! { (claim): drop => forces[l].clone() });
        }
        // Discs have only the contacts along αβ.
        for axis in Axis::ALL.into_iter().take(2 * dimension - 3) {
            let [i, j] = neighbour(f, axis, &i, &j);
            let there = elastic_field(f, &(f.core.above)(&i, &j, &k), &d);
            let c = (f.compression)(&phi, &there, axis.ends(), Sign::Plus);
            steps.extend(equations! { (format!("{name}: c of {axis}")): c => int(-2) * &d });
        }
    }
    steps
}

/// Returns φ of the sphere (i, j, k) in a pile of L layers.
fn of_site(f: &Formulas) -> [P; 3] {
    elastic_field(f, &above(&f.core), &(last_layer() - &symbol("k")))
}

fn elastic_energy(f: &Formulas) -> Vec<Step> {
    let (setting, l) = (Setting::equilateral(&f.core), symbol("L"));
    let forces = setting.to_below(&f.core, setting.received(&f.core, &above(&f.core)));
    let squares = sum_off_floor(&dot(&forces, &forces));
    let factors = [0, -1, 1, 2].map(|more| l.clone() + &int(more));
    let last = int(2) * &l + &int(1);
    equations! {
        "40 Σf² is L(L−1)(L+1)(L+2)(2L+1)":
            squares.clone() * &int(40) => factors.iter().fold(last, |product, n| product * n),
        "Σf² = Σφ": squares => sum_off_floor(&sum(of_site(f))),
    }
}

fn settlement(f: &Formulas) -> Vec<Step> {
    let (phi, [k, l]) = (of_site(f), ["k", "L"].each(symbol));
    let d = last_layer() - &k;
    let w = sum(phi.clone()).div_int(THREE);
    let apex = (f.elastic_field)(&P::zero(), &last_layer());
    let mut steps = equations! {
        "6w = d(3L−k)": w.clone() * &int(6) => d.clone() * &(int(3) * &l - &k),
        "the apex: 2w = L(L−1)": apex * &int(2) => l * &last_layer(),
    };
    let p = phi.each(|phi| (w.clone() - &phi) * &int(3));
    let dilated = above(&f.core).each(|n| d.clone() * &(k.clone() - &(int(3) * &n)));
    steps.extend(by_line("3p = −d(3n−k)", p, dilated));
    steps
}

/// Returns the arguments of the minimum for each line above (i, j).
fn arguments(f: &Formulas, [i, j]: &[P; 2], sign: Sign) -> [[P; 4]; 3] {
    let lower = symbols(["x_0", "y_0", "s_0"]);
    let upper = symbols(["x_1", "y_1", "s_1"]);
    (f.core.bounds_above)(i, j, &lower, &upper, &symbol("m"), sign)
}

fn elastic_monotone(f: &Formulas) -> Vec<Step> {
    let site @ [i, j] = &["i", "j"].each(symbol);
    let mut steps = Vec::new();
    for (name, sign) in SIGNS {
        let here = arguments(f, site, sign);
        for axis in Axis::ALL {
            let there = arguments(f, &neighbour(f, axis, i, j), sign);
            for (line, change) in axis.ends().into_iter().zip([-1, 1].each(int)) {
                let at = format!("{axis} under {name}, along {line}: σ times");
                let mut all = P::zero();
                for (there, here) in there[line.index()].iter().zip(&here[line.index()]) {
                    let change_of_this = signed(there.clone() - here, sign);
                    all = all + &change_of_this;
                    let product = change_of_this.clone() * &(change_of_this - &change);
                    let claim = format!("{at} a change is 0 or {change}: their product");
                    steps.extend(equations! { (claim): product => P::zero() });
                }
                steps.extend(equations! { (format!("{at} all four")): all => change * &int(2) });
            }
        }
    }
    steps
}

fn no_dip(f: &Formulas) -> Vec<Step> {
    let [[i, j], [u, v]] = [["i", "j"], ["u", "v"]].each(|names| names.each(symbol));
    let mut steps = Vec::new();
    for (name, sign) in SIGNS {
        let at = |site: [P; 2]| arguments(f, &site, sign).into_iter().flatten();
        let there = at([i.clone() + &u, j.clone() + &v]);
        let back = at([i.clone() - &u, j.clone() - &v]);
        let both = there.zip(back).map(|(there, back)| there + &back);
        for (here, both) in at([i.clone(), j.clone()]).zip(both) {
            let claim = format!("under {name}: A(p+v) + A(p−v) = 2A(p)");
            steps.extend(equations! { (claim): both => here * &int(2) });
        }
    }
    steps
}
