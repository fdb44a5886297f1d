//! Theorems about piles of every size with horizontal contacts, at a = R: balance, virtual work, the elastic state,
//! bounds and arches.
//!
//! The proofs run the formulas of this crate and of the core on polynomials, as [`cannonpile::theorem`] explains.
//! Every theorem receives its [`Formulas`] as an argument, so that a test can replace one of them by a mutant.
//!
//! # Examples
//! ```
//! use cannonpile_horizontal::theorem;
//!
//! for theorem in theorem::all() {
//!     assert!(theorem.prove().holds(), "{}", theorem.name);
//! }
//! ```

mod formulas;

pub use formulas::Formulas;

use cannonpile::geometry::Vector;
use cannonpile::lattice::{Axis, Direction, Sign};
use cannonpile::scalar::{Algebra, Symbol};
use cannonpile::theorem::setting::{
    P, Setting, above, by_component, by_line, equations, int, last_layer, sum_off_floor,
    sum_over_layer, symbol,
};
use cannonpile::theorem::{ProofKind, Step};
use num_traits::{One, Zero};

use crate::{Each, THREE};

/// A theorem about the [`Formulas`] of horizontal contacts.
pub type Theorem = cannonpile::theorem::Theorem<Formulas>;

/// Returns all theorems about horizontal contacts, in reading order.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::theorem;
///
/// assert!(theorem::all().any(|theorem| theorem.name == "virtual-work"));
/// ```
pub fn all() -> impl Iterator<Item = &'static Theorem> {
    THEOREMS.iter()
}

/// Returns the theorem called `name`; `None` if there is none.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::theorem;
///
/// assert!(theorem::find("virtual-work").is_some());
/// assert!(theorem::find("equilibrium").is_none());
/// ```
#[must_use]
pub fn find(name: &str) -> Option<&'static Theorem> {
    all().find(|theorem| theorem.name == name)
}

const THEOREMS: &[Theorem] = &[
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

const SIGNS: [(&str, Sign); 2] = [("+", Sign::Plus), ("−", Sign::Minus)];

fn symbols(names: [&'static str; 3]) -> [P; 3] {
    names.each(symbol)
}

fn sum(terms: impl IntoIterator<Item = P>) -> P {
    terms.into_iter().fold(P::zero(), |sum, term| sum + &term)
}

fn dot(a: &[P; 3], b: &[P; 3]) -> P {
    sum(a.iter().zip(b).map(|(x, y)| x.clone() * y))
}

fn plus([a, b, c]: [P; 3], [x, y, z]: &[P; 3]) -> [P; 3] {
    [a + x, b + y, c + z]
}

fn signed(x: P, sign: Sign) -> P {
    x * &int(sign.factor().into())
}

/// Returns the same value on all three lines.
fn each(value: i128) -> [P; 3] {
    [value; 3].each(int)
}

/// Returns a value on one line, and 0 on the others.
fn on(line: Direction, value: &P) -> [P; 3] {
    Direction::ALL.each(|other| {
        if other == line {
            value.clone()
        } else {
            P::zero()
        }
    })
}

/// Returns the other two lines.
fn others(line: Direction) -> [Direction; 2] {
    [1, 2].each(|n| Direction::ALL[(line.index() + n) % 3])
}

/// Returns the site p + d_b − d_a.
fn neighbour(f: &Formulas, axis: Axis, i: &P, j: &P) -> [P; 2] {
    let [[a_i, a_j], [b_i, b_j]] = axis.ends().each(|end| (f.core.descent)(Sign::Plus, end));
    [i.clone() + &int(b_i - a_i), j.clone() + &int(b_j - a_j)]
}

/// Returns T g: the half-turn of g if the sign changes, otherwise g.
fn transferred(f: &Formulas, changes: bool, g: &[P; 3]) -> [P; 3] {
    if changes {
        (f.core.half_turn)(g)
    } else {
        g.clone()
    }
}

/// Returns the forces that a sphere transmits, with `g` from above and the sum H of its horizontal forces.
fn beside(f: &Formulas, g: &[P; 3], own: &P, pushed: &[P; 3], sign: Sign) -> [P; 3] {
    Direction::ALL
        .each(Direction::index)
        .each(|l| (f.core.beside)(g[l].clone(), own, &pushed[l], sign))
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
            let received = transferred(f, above != below, &g);
            let passed = beside(f, &received, &n, &h, below);
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
            let passed = beside(f, &transferred(f, changes, &g), &w, &h, sign);
            let left = dot(&phi, &passed) + &signed(dot(&phi, &h), sign);
            let weight = w.clone() * &sum(phi.clone());
            steps.extend(equations! {
                (format!("a sphere, {name} below, the sign is {text}")):
                    left => dot(&g, &transferred(f, changes, &phi)) + &weight,
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
            let passed = beside(f, &g, &one, &(f.core.pushed)(&one, ends, false), Sign::Plus);
            let added = plus(on(edge, &int(-1)), &plus(on(other, &one), &each(1)));
            steps.extend(by_line(&at("a neighbour"), passed, plus(g.clone(), &added)));
        }
        let passed = beside(f, &on(edge, &received(&t)), &one, &pushed, Sign::Plus);
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
        let passed = beside(f, &received, &one, &pushed, Sign::Plus);
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
            let passed = beside(f, &g, &one, &pushed, Sign::Plus);
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
