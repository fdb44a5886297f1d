//! Theorems on stackings and regions of any kind: runs, sign changes, point loads.

use cannonpile::each::Each;
use cannonpile::lattice::{Direction, Sign};
use cannonpile::scalar::{Algebra, Symbol};
use cannonpile::theorem::setting::{
    P, Setting, by_line, equations, int, nothing_left, symbol, transmitted,
};
use cannonpile::theorem::{Formulas, ProofKind, Step};
use num_traits::{One, Zero};

use super::steps::{Complex, complex, dot, steps_down};
use super::terms::{SIGNS, THREE, Theorem, symbols, transferred};

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "region-counts",
        statement: "Any base under straight steps: let (i, j) be a site m steps into a run, in a layer x₀ ≤ i ≤ x₁, \
                     y₀ ≤ j ≤ y₁, s₀ ≤ i+j ≤ s₁. Under + steps the numbers of spheres above it are min(m, x₁−i, y₁−j, \
                     s₁−i−j) along α, min(m, i−x₀, y₁−j, i+j−s₀) along β and min(m, j−y₀, x₁−i, i+j−s₀) along γ. Under \
                     − steps the upper and lower bounds are interchanged. The bounds of the layer above are tighter by \
                     one on the side to which the steps lead. For the next site up a line, three distances to bounds \
                     are those of (i, j). The other three and m, which are the arguments of the min, are one less. So \
                     (in words, by induction) if all arguments are ≥ 1, there is a sphere above, and its count is one \
                     less. If an argument is 0, there is none. In the paper's pile, (9) is one of the arguments, and \
                     no argument is less; by induction",
        hypotheses: "(i, j) within the bounds, m ≥ 0, 0 ≤ j ≤ k, 0 ≤ i ≤ k−j",
        method: ProofKind::Induction,
        symbols: "i, j, k, m, x_0, x_1, y_0, y_1, s_0, s_1",
        derive: |f| region_counts(&f.core),
    },
    Theorem {
        name: "run",
        statement: "Within a run, a line of contacts that carries f at its first sphere carries f + m w after m \
                     spheres more, because each of them transmits an increment w more than it receives. So one \
                     evaluation replaces m steps, and further forces that spheres add may be added in any order; by \
                     induction",
        hypotheses: "m ≥ 0",
        method: ProofKind::Induction,
        symbols: "f, m, e, s",
        derive: |f| run(&f.core),
    },
    Theorem {
        name: "tripled-half-turn",
        statement: "2(g_1+g_2+g_3)(1,1,1) − 3g, which is evaluated for integers, and (2(g_2+g_3) − g_1, …), which is \
                     evaluated for bounds and for the limbs of the exact engine, are 3Gg; an identity",
        hypotheses: "any forces",
        method: ProofKind::Identity,
        symbols: "g_1, g_2, g_3",
        derive: |f| tripled(&f.core),
    },
    Theorem {
        name: "change-of-sign",
        statement: "Equilibrium at a sign change on an equilateral base: a sphere of weight n·mg receives any forces \
                     g along the directions of one sign, and transmits Gg + n(1, 1, 1) along those of the other sign. \
                     It is in equilibrium, from + to − and from − to +; an identity",
        hypotheses: "s = 1/2; any g_1, g_2, g_3, n",
        method: ProofKind::Identity,
        symbols: "g_1, g_2, g_3, n",
        derive: |f| change_of_sign(&f.core),
    },
    Theorem {
        name: "edge",
        statement: "Under + steps, spheres on the edge i+j = s₀ of a layer receive nothing along β and γ, those on i \
                     = x₁ nothing along γ and α, and those on j = y₁ nothing along α and β. Under − steps this holds \
                     on the opposite edges. The third line stays on the edge (theorem region-counts). So if its first \
                     sphere in a run of m steps transmits f, the last receives f + m − 1 along the line and nothing \
                     else. If the sign changes there, it transmits 1 − (f+m−1)/3 = (4 − f − m)/3 along the line, and \
                     −(1+f+p)/3 for m = 5+p. So (in words) no run of five steps or more that ends at a sign change is \
                     stable; an identity",
        hypotheses: "f ≥ 0, m ≥ 1, p ≥ 0, weights of mg",
        method: ProofKind::Identity,
        symbols: "f, i, j, m, p, x_0, x_1, y_0, y_1, s_0, s_1",
        derive: |f| edge(&f.core),
    },
    Theorem {
        name: "point-load",
        statement: "A unit load on a wide flat top, in any stacking: at depth n the vertical parts v of the contact \
                     forces satisfy Σv = 1, Σv² = 1/3, Σv r = 0 and Σv r² = n²ρ². Here r points from the line of the \
                     load to the lower sphere, and ρ = 2R sinθ. The first layer has these sums, under either sign. Let \
                     d be the horizontal step of a contact and C = Σv r·d. From the contacts above a sphere to those \
                     below it, Σv, Σv² and Σv d stay the same, C grows by ρ²Σv, and Σv r² grows by 2C + ρ²Σv, for any \
                     two signs. So (in words) C = nρ² and Σv r² = n²ρ². Spheres transmit the sum of the forces of two \
                     loads, and a weight is a load. So (in words, by summing over the spheres) under gravity, for \
                     every stacking and base, ΣF_z is the weight, ΣF_z r_b = Σ mg r_s and ΣF_z r_b² = Σ mg (r_s² + \
                     H_s² tan²θ); by induction",
        hypotheses: "s = 1/2",
        method: ProofKind::Induction,
        symbols: "g_1, g_2, g_3, h_1, h_2, h_3, x, y",
        derive: |f| point_load(&f.core),
    },
];

/// Returns the distances of a site from the bounds x₁, y₁, s₁, x₀, y₀, s₀.
fn distances(i: &P, j: &P, lower: &[P; 3], upper: &[P; 3]) -> [P; 6] {
    let ([x0, y0, s0], [x1, y1, s1]) = (lower, upper);
    let sum = i.clone() + j;
    [
        x1.clone() - i,
        y1.clone() - j,
        s1.clone() - &sum,
        i.clone() - x0,
        j.clone() - y0,
        sum - s0,
    ]
}

/// Returns the indices of the [`distances`] whose minimum with m is the count of a line (theorem `region-counts`).
const fn arguments(sign: Sign, direction: Direction) -> [usize; 3] {
    match (sign, direction) {
        (Sign::Plus, Direction::Alpha) => [0, 1, 2],
        (Sign::Plus, Direction::Beta) => [3, 1, 5],
        (Sign::Plus, Direction::Gamma) => [4, 0, 5],
        (Sign::Minus, Direction::Alpha) => [3, 4, 5],
        (Sign::Minus, Direction::Beta) => [0, 4, 2],
        (Sign::Minus, Direction::Gamma) => [1, 3, 2],
    }
}

fn region_counts(f: &Formulas) -> Vec<Step> {
    const NAMES: [&str; 6] = ["x₁−i", "y₁−j", "s₁−i−j", "i−x₀", "j−y₀", "i+j−s₀"];
    let [i, j, m] = symbols(["i", "j", "m"]);
    let lower = symbols(["x_0", "y_0", "s_0"]);
    let upper = symbols(["x_1", "y_1", "s_1"]);
    let here = distances(&i, &j, &lower, &upper);
    let mut steps = Vec::new();
    for (name, sign) in SIGNS {
        let bounds = (f.bounds_above)(&i, &j, &lower, &upper, &m, sign);
        let tighter = |bounds: &[P; 3], by: i128| bounds.each_ref().each(|b| b.clone() + &int(by));
        let (lower, upper) = match sign {
            Sign::Plus => (lower.clone(), tighter(&upper, -1)),
            Sign::Minus => (tighter(&lower, 1), upper.clone()),
        };
        for (direction, bounds) in Direction::ALL.into_iter().zip(bounds) {
            let of_line = arguments(sign, direction);
            let [most, a, b, c] = bounds;
            let claim = |what: &str| format!("{direction} under {name}: {what}");
            steps.push(Step::equal(claim("an argument is m"), most, m.clone()));
            for (argument, n) in [a, b, c].into_iter().zip(of_line) {
                let claim = claim(&format!("an argument is {}", NAMES[n]));
                steps.push(Step::equal(claim, argument, here[n].clone()));
            }
            let [di, dj] = (f.descent)(sign, direction).each(int);
            let above = distances(&(i.clone() - &di), &(j.clone() - &dj), &lower, &upper);
            for (n, above) in above.into_iter().enumerate() {
                let (less, text) = if of_line.contains(&n) {
                    (1, "is one less above")
                } else {
                    (0, "is the same above")
                };
                let claim = claim(&format!("{} {text}", NAMES[n]));
                steps.push(Step::equal(claim, above, here[n].clone() - &int(less)));
            }
        }
    }
    // The paper's pile, 0 ≤ i, j, i+j ≤ k: each argument is N plus a nonnegative term.
    let k = symbol("k");
    let (none, all) = ([(); 3].each(|()| P::zero()), [(); 3].each(|()| k.clone()));
    let bounds = (f.bounds_above)(&i, &j, &none, &all, &k, Sign::Plus);
    let counts = (f.above)(&i, &j, &k);
    let (sum, rest) = (i.clone() + &j, k - &i - &j);
    let [rest_i, rest_j] = [&i, &j].each(|index| rest.clone() + index);
    let more = [
        [sum.clone(), j.clone(), i.clone(), P::zero()],
        [rest_j, P::zero(), rest.clone(), j],
        [rest_i, P::zero(), rest, i],
    ];
    let lines = Direction::ALL.into_iter().zip(bounds).zip(counts).zip(more);
    for (((direction, bounds), count), more) in lines {
        for (bound, more) in bounds.into_iter().zip(more) {
            let claim =
                format!("the paper's pile: an argument along {direction} minus (9) is {more}");
            steps.push(Step::equal(claim, bound - &count, more));
        }
    }
    steps
}

fn run(f: &Formulas) -> Vec<Step> {
    let (force, m, extra) = (symbol("f"), symbol("m"), symbol("e"));
    let increments = (f.increments)(&symbol("s"));
    let mut steps = Vec::new();
    for (direction, w) in Direction::ALL.into_iter().zip(&increments) {
        let transmitted = |force: &P, m: P| (f.transmitted)(force.clone(), &(f.force)(m, w));
        let after = |m: P| transmitted(&force, m);
        let with_extra = (f.transmitted)(force.clone(), &extra);
        steps.extend(equations! {
            (format!("base case along {direction}: f after 0 spheres")):
                after(P::zero()) => force.clone(),
            (format!("step along {direction}: one sphere more adds one increment")):
                after(m.clone() + &P::one()) => (f.transmitted)(after(m.clone()), w),
            (format!("along {direction}: f + m w after m spheres")):
                after(m.clone()) => force.clone() + &(m.clone() * w),
            (format!("along {direction}: a force e added before or after m spheres")):
                transmitted(&with_extra, m.clone()) => (f.transmitted)(after(m.clone()), &extra),
        });
    }
    steps
}

fn tripled(f: &Formulas) -> Vec<Step> {
    let g = symbols(["g_1", "g_2", "g_3"]);
    let ways = [
        ("2(g_1+g_2+g_3) − 3g = 3Gg", (f.tripled_half_turn)(&g)),
        ("(2(g_2+g_3) − g_1, …) = 3Gg", (f.tripled_apart)(&g)),
    ];
    let mut steps = Vec::new();
    for (claim, tripled) in ways {
        let turned = (f.half_turn)(&g).each(|part| part * &int(3));
        steps.extend(by_line(claim, tripled, turned));
    }
    steps
}

fn change_of_sign(f: &Formulas) -> Vec<Step> {
    let setting = Setting::equilateral(f);
    let g = symbols(["g_1", "g_2", "g_3"]);
    let (own, weight) = setting.loaded(f, &symbol("n"));
    let to_below = transmitted(f, (f.half_turn)(&g), &own);
    let (plus, minus) = (setting.directions.clone(), setting.turned_directions(f));
    let mut steps = Vec::new();
    for (claim, above, below) in [
        ("from + to −, the resultant is 0", &plus, &minus),
        ("from − to +, the resultant is 0", &minus, &plus),
    ] {
        let left = (f.unbalanced)(&to_below, below, &g, above, &weight);
        steps.extend(nothing_left(claim, left));
    }
    steps
}

fn edge(f: &Formulas) -> Vec<Step> {
    let [i, j, m] = symbols(["i", "j", "m"]);
    let lower @ [x0, y0, s0] = &symbols(["x_0", "y_0", "s_0"]);
    let upper @ [x1, y1, s1] = &symbols(["x_1", "y_1", "s_1"]);
    let mut steps = Vec::new();
    for (name, sign) in SIGNS {
        let (sum, column, row) = match sign {
            Sign::Plus => (s0, x1, y1),
            Sign::Minus => (s1, x0, y0),
        };
        let edges = [
            (sum.clone() - &j, j.clone()),
            (column.clone(), j.clone()),
            (i.clone(), row.clone()),
        ];
        for (direction, (i, j)) in Direction::ALL.into_iter().zip(edges) {
            let bounds = (f.bounds_above)(&i, &j, lower, upper, &m, sign);
            // The index of the distance to that edge among the arguments of the other two lines.
            let others = match direction {
                Direction::Alpha => [(1, 3), (2, 3)],
                Direction::Beta => [(0, 1), (2, 2)],
                Direction::Gamma => [(0, 2), (1, 2)],
            };
            for (line, argument) in others {
                let other = Direction::ALL[line];
                let claim =
                    format!("on the edge of {direction} under {name}, nothing along {other}");
                let least = bounds[line][argument].clone();
                steps.push(Step::equal(claim, least, P::zero()));
            }
        }
    }
    let setting = Setting::equilateral(f);
    let force = symbol("f");
    for (line, direction) in Direction::ALL.into_iter().enumerate() {
        let w = &setting.increments[line];
        let received = (f.transmitted)(force.clone(), &(f.force)(m.clone() - &P::one(), w));
        let sum = force.clone() + &m - &P::one();
        let mut g = [P::zero(), P::zero(), P::zero()];
        g[line] = received.clone();
        let passed = transmitted(f, (f.half_turn)(&g), &setting.increments);
        let passed = passed[line].clone();
        let tripled = passed.clone() * &int(3);
        let p = symbol("p");
        let long = tripled.substitute(Symbol("m"), &(int(5) + &p));
        steps.extend(equations! {
            (format!("{direction}: f + m − 1 at the end of the run")): received => sum.clone(),
            (format!("{direction}: 1 − (f+m−1)/3 transmitted")):
                passed => P::one() - &sum.div_int(THREE),
            (format!("{direction}: three times that is 4 − f − m")):
                tripled => int(4) - &force - &m,
            (format!("{direction}: −(1+f+p) with m = 5+p")): long => -(P::one() + &force + &p),
        });
    }
    steps
}

/// Returns a sum over three contacts.
fn sum(forces: &[P; 3], of: impl Fn(usize) -> P) -> P {
    let terms = forces.iter().enumerate();
    let terms = terms.map(|(line, force)| of(line) * force);
    terms.fold(P::zero(), |sum, term| sum + &term)
}

/// Returns the steps for the contacts below a loaded sphere. The load is W = 3, so each v is a third of an increment.
fn first_layer(increments: &[P; 3], name: &str, down: &[Complex; 3]) -> Vec<Step> {
    let third = P::one().div_int(THREE);
    let v = increments.clone().each(|w| w.div_int(THREE));
    let at = |claim: &str| format!("first layer, {name}: {claim}");
    equations! {
        (at("Σv = 1")): sum(&v, |_| P::one()) => P::one(),
        (at("Σv² = 1/3")): sum(&v, |line| v[line].clone()) => third,
        (at("Σv r along x = 0")): sum(&v, |line| down[line].x.clone()) => P::zero(),
        (at("Σv r along y = 0")): sum(&v, |line| down[line].y.clone()) => P::zero(),
        (at("Σv r² = ρ²")): sum(&v, |line| dot(&down[line], &down[line])) => P::one(),
    }
}

fn point_load(f: &Formulas) -> Vec<Step> {
    let setting = Setting::equilateral(f);
    let [plus, minus] = steps_down(f);
    let signs = [("+", plus), ("−", minus)];
    let mut steps = Vec::new();
    for (name, down) in &signs {
        steps.extend(first_layer(&setting.increments, name, down));
    }
    let g = symbols(["g_1", "g_2", "g_3"]);
    let r = complex(symbol("x"), symbol("y"));
    for (above, from) in &signs {
        for (below, to) in &signs {
            let passed = transferred(f, above != below, &g);
            let (whole, c) = (sum(&g, |_| P::one()), sum(&g, |line| dot(&r, &from[line])));
            let lower = |line: usize| r.clone() + &to[line];
            let at = |claim: &str| format!("{above} above, {below} below: {claim}");
            let claims = equations! {
                (at("Σv stays")): sum(&passed, |_| P::one()) => whole.clone(),
                (at("Σv² stays")):
                    sum(&passed, |line| passed[line].clone()) => sum(&g, |line| g[line].clone()),
                (at("Σv d along x stays")):
                    sum(&passed, |line| to[line].x.clone()) => sum(&g, |line| from[line].x.clone()),
                (at("Σv d along y stays")):
                    sum(&passed, |line| to[line].y.clone()) => sum(&g, |line| from[line].y.clone()),
                (at("C grows by ρ²Σv")):
                    sum(&passed, |line| dot(&lower(line), &to[line])) => c.clone() + &whole,
                (at("Σv r² grows by 2C + ρ²Σv")):
                    sum(&passed, |line| dot(&lower(line), &lower(line)))
                        => sum(&g, |_| dot(&r, &r)) + &(int(2) * &c) + &whole,
            };
            // Without a sign change, the first four sums have the same terms on both sides and prove nothing.
            let kept = if above == below { 4 } else { 0 };
            steps.extend(claims.into_iter().skip(kept));
        }
    }
    let h = symbols(["h_1", "h_2", "h_3"]);
    let both = transmitted(f, g.clone(), &h);
    let turned = transmitted(f, (f.half_turn)(&g), &(f.half_turn)(&h));
    let claim = "G(g+h) = Gg + Gh, for two loads";
    steps.extend(by_line(claim, (f.half_turn)(&both), turned));
    steps
}
