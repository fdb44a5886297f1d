//! Theorems on the conditioning of the equilibrium f = S f + w, where S transfers forces to the layer below.

use cannonpile::each::Each;
use cannonpile::geometry::Load;
use cannonpile::lattice::Sign;
use cannonpile::theorem::setting::{
    P, Setting, by_line, equations, int, nothing_left, symbol, transmitted,
};
use cannonpile::theorem::{Formulas, ProofKind, Step};
use num_traits::{One, Zero};

use super::terms::{Theorem, plus, square, sum, symbols, transferred};

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "isometry",
        statement: "S is an isometry: let S transfer the forces below each sphere to the spheres below, without loads. A \
                     contact has one lower end, and a sphere receives at most one force on each line. A sphere that \
                     receives g transmits Tg, which is Gg at a sign change and g otherwise, also on isosceles bases and \
                     for discs. This keeps scalar products: Σ_l (Tg)_l (Th)_l = Σ_l g_l h_l. So (in words) S maps the \
                     forces below a layer isometrically to those below the next, in every stacking and under every \
                     top. Only equilateral bases have sign changes. If the steps of another base could turn, a sphere \
                     would transmit 2Σg·w/W − g, with the increments w and their sum W, which keeps Σ_l g_l h_l/w_l; an \
                     identity",
        hypotheses: "at sign changes s = 1/2; any forces; no horizontal contacts",
        method: ProofKind::Identity,
        symbols: "s, g_1, g_2, g_3, h_1, h_2, h_3",
        derive: |f| isometry(&f.core),
    },
    Theorem {
        name: "inverse",
        statement: "I − S is unipotent: a sphere that receives g transmits Tg + w, and T is linear. So equilibrium is f = \
                     Sf + w for all spheres, where S leads one layer down, and Sⁿ = 0 for n layers with supports. So \
                     (in words) f = Σ_j Sʲw, j < n, is the only solution, and det(I − S) = 1; an identity",
        hypotheses: "at sign changes s = 1/2; any forces; no horizontal contacts",
        method: ProofKind::Identity,
        symbols: "c, g_1, g_2, g_3, h_1, h_2, h_3, w_1, w_2, w_3",
        derive: |f| inverse(&f.core),
    },
    Theorem {
        name: "singular-values",
        statement: "The singular values of I − S: on a chain e, Se, S²e, … of m vectors with Sᵐe = 0, the coefficients v_i \
                     become v_i − v_{i−1}. So I − S is the matrix C with 1 on the diagonal and −1 below it. Let v_i = \
                     (−1)ⁱ(zⁱ − z⁻ⁱ) and λ = (1+z)²/z. Then CᵀCv = λv in all rows but the last, where both sides differ \
                     by a multiple of z^(2m+1) − 1. So (in words) z = exp(2πij/(2m+1)) gives the singular values 2 \
                     cos(jπ/(2m+1)), j = 1 … m. By theorem isometry all forces divide into orthonormal chains: \
                     d(N_k − N_{k−1}) of length m = n − k begin in layer k, with N_k spheres, d lines, and n layers \
                     with supports. The proof multiplies v_i by z·zⁱ; an identity",
        hypotheses: "1 ≤ i ≤ m, z ≠ 0",
        method: ProofKind::Identity,
        symbols: "z, Z = zⁱ",
        derive: |f| singular_values(&f.core),
    },
];

fn product(g: &[P; 3], h: &[P; 3]) -> P {
    sum(g.iter().zip(h).map(|(g, h)| g.clone() * h))
}

fn isometry(f: &Formulas) -> Vec<Step> {
    let any = Setting::isosceles(f);
    let [g, h] = [
        symbols(["g_1", "g_2", "g_3"]),
        symbols(["h_1", "h_2", "h_3"]),
    ];
    let nothing = Load::from(P::zero());
    let own = (f.load_increments)(&nothing, &any.s, Sign::Plus);
    let own_of_disc = (f.disc_load_increments)(&nothing, Sign::Plus);
    let both = |turns: bool, own: &[P; 3], [g, h]: [&[P; 3]; 2]| {
        let [g, h] = [g, h].map(|g| transmitted(f, transferred(f, turns, g), own));
        product(&g, &h)
    };
    let of_discs = |[a, b, _]: &[P; 3]| [a.clone(), b.clone(), P::zero()];
    let [g2, h2] = [&g, &h].map(of_discs);
    let equal = product(&g, &h);
    let mut steps = equations! {
        "a sign change": both(true, &own, [&g, &h]) => equal.clone(),
        "steps of one sign": both(false, &own, [&g, &h]) => equal,
        "discs": both(false, &own_of_disc, [&g2, &h2]) => product(&g2, &h2),
    };
    // W times the forces that a sphere transmits, if the steps of any base turn.
    let turned = |g: &[P; 3]| {
        let double = int(2) * &sum(g.clone());
        [0, 1, 2]
            .each(|l: usize| double.clone() * &any.increments[l] - &(any.weight.clone() * &g[l]))
    };
    let [turned_g, turned_h] = [&g, &h].map(turned);
    let above = g.each_ref().each(|g| any.weight.clone() * g);
    let left = (f.unbalanced)(
        &turned_g,
        &any.turned_directions(f),
        &above,
        &any.directions,
        &P::zero(),
    );
    steps.extend(nothing_left(
        "any base that turns, times W: the resultant is 0",
        left,
    ));
    // 2s/w_l, as w = (1, 1, 2s).
    let metric = |g: &[P; 3], h: &[P; 3]| {
        let [a, b, c] = [0, 1, 2].map(|l: usize| g[l].clone() * &h[l]);
        int(2) * &any.s * &(a + &b) + &c
    };
    steps.extend(equations! {
        "any base that turns, times 2sW²: Σ g h/w":
            metric(&turned_g, &turned_h) => square(&any.weight) * &metric(&g, &h),
    });
    steps
}

fn inverse(f: &Formulas) -> Vec<Step> {
    let [g, h, w] = [
        symbols(["g_1", "g_2", "g_3"]),
        symbols(["h_1", "h_2", "h_3"]),
        symbols(["w_1", "w_2", "w_3"]),
    ];
    let scaled = |g: &[P; 3]| g.each_ref().each(|g| symbol("c") * g);
    let mut steps = Vec::new();
    for (claim, turns) in [
        ("a sign change: T(cg + h) + w", true),
        ("steps of one sign: T(cg + h) + w", false),
    ] {
        let [t, u] = [&g, &h].map(|g| transferred(f, turns, g));
        let received = transferred(f, turns, &plus(scaled(&g), &h));
        let expected = plus(plus(scaled(&t), &u), &w);
        steps.extend(by_line(claim, transmitted(f, received, &w), expected));
    }
    steps
}

fn singular_values(f: &Formulas) -> Vec<Step> {
    let [z, power] = ["z", "Z"].each(symbol);
    let [z2, power2] = [&z, &power].map(square);
    // v_(i−1), v_i and v_(i+1), times z·zⁱ and a sign.
    let [before, here, after] = [
        z2.clone() - &power2,
        z.clone() * &(power2.clone() - &P::one()),
        P::one() - &(z2 * &power2),
    ];
    // A row of I − S: the difference of the force below a sphere and of the force that it transmits from above.
    let difference = |v: &P, above: &P| v.clone() - &(f.transmitted)(above.clone(), &P::zero());
    let (own, below) = (difference(&here, &before), difference(&after, &here));
    let one_more = P::one() + &z;
    let multiple = square(&one_more) * &here;
    equations! {
        "row i, times z": z.clone() * &(own.clone() - &below) => multiple.clone(),
        "the last row, times z, minus (1+z)² v_m":
            z.clone() * &own - &multiple => z.clone() * &one_more * &(P::one() - &(z * &power2)),
    }
}
