//! Theorems on piles in other dimensions: discs, and d = 2 … 6.

use cannonpile::scalar::Symbol;
use cannonpile::theorem::setting::{P, Setting, equations, int, last_layer, nothing_left, symbol};
use cannonpile::theorem::{Formulas, ProofKind, Step};
use num_traits::{One, Zero};

use super::terms::Theorem;

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "discs",
        statement: "The pile of discs: every disc is in equilibrium. Every bottom disc exerts the normal force \
                     mg(L+1)/2 and the shear −(L−1−2i)/2·mg tanθ on the floor. The normal forces sum to the weight \
                     L(L+1)/2·mg, and the shears to zero; identities, and by summing over the base",
        hypotheses: "0 ≤ i ≤ k, j = 0, s = 0",
        method: ProofKind::Sum,
        symbols: "L, i, k",
        derive: |f| discs(&f.core),
    },
    Theorem {
        name: "dimensions",
        statement: "In d = 2 … 6 dimensions a sphere is supported by d others, in the directions of the corners of a \
                     regular simplex, and adds 1 to each line. It is in equilibrium for any forces from above. With \
                     n_m spheres above it on a line, it transmits the force that the sphere below receives from n_m + \
                     1 spheres. If n_1 + … + n_d = L−1, the normal force on the floor is mg(L+d−1)/d under every \
                     bottom sphere. There are C(L+d−1, d) spheres, and the normal forces sum to their weight; \
                     identities, and by summing over the layers",
        hypotheses: "n_m ≥ 0, L ≥ 1; any g_1 … g_d",
        method: ProofKind::Sum,
        symbols: "L, k, n_1 … n_d, g_1 … g_d",
        derive: |f| dimensions(&f.core),
    },
];

fn discs(f: &Formulas) -> Vec<Step> {
    let setting = Setting::discs(f);
    let (l, i, k) = (symbol("L"), symbol("i"), symbol("k"));
    let inside = (f.above)(&i, &P::zero(), &k);
    let floor = (f.above)(&i, &P::zero(), &last_layer());
    let left = setting.unbalanced(f, &inside);
    let force = setting.support_load(f, &floor);
    let over_base = |p: &P| p.sum(Symbol("i"), &P::zero(), &last_layer());
    let total = over_base(&force.z);
    let mut steps = nothing_left("the resultant of all forces is 0", left);
    steps.extend(equations! {
        "normal force, in mg/2": force.z => l.clone() + &int(1),
        "shear, in mg tanθ/2": force.x.clone() => int(2) * &i - &last_layer(),
        "no force across the plane": force.y => P::zero(),
        "ΣF_z = 2·discs, in mg/2": total => (f.spheres)(&l, 2) * &int(2),
        "ΣF_x = 0": over_base(&force.x) => P::zero(),
    });
    steps
}

fn dimensions(f: &Formulas) -> Vec<Step> {
    let mut steps = Vec::new();
    for d in 2..=6 {
        in_dimension(f, d, &mut steps);
    }
    steps
}

const COUNTS: [&str; 6] = ["n_1", "n_2", "n_3", "n_4", "n_5", "n_6"];
const FORCES: [&str; 6] = ["g_1", "g_2", "g_3", "g_4", "g_5", "g_6"];

fn in_dimension(f: &Formulas, d: u32, steps: &mut Vec<Step>) {
    let dimension = int(d.into());
    let (l, k) = (symbol("L"), symbol("k"));
    let named = |names: [&'static str; 6]| -> Vec<P> {
        let lines = (0..d).zip(names);
        lines.map(|(_, name)| symbol(name)).collect()
    };
    let own: Vec<P> = (0..d).map(|_| P::one()).collect();
    let weight = (f.weight)(&own);
    let claim = |text: &str| format!("d = {d}: {text}");
    // Along each of its lines, a sphere transmits one increment more than it receives.
    let received = named(FORCES).into_iter().zip(&own);
    let added: Vec<P> = received
        .map(|(g, w)| (f.transmitted)(g.clone(), w) - &g)
        .collect();
    let vertical = added.iter().fold(P::zero(), |sum, more| sum + more);
    steps.extend(equations! {
        (claim("the forces from the supports minus those from above sum to the weight")):
            vertical => weight.clone(),
    });
    // The horizontal part of a direction times d, in d coordinates that sum to zero: d−1 along its own, −1 along the
    // others.
    for coordinate in 0..own.len() {
        let components = added.iter().enumerate().map(|(line, more)| {
            let part = if line == coordinate {
                dimension.clone() - &P::one()
            } else {
                -P::one()
            };
            part * more
        });
        let horizontal = components.fold(P::zero(), |sum, part| sum + &part);
        let claim = format!(
            "d = {d}: no horizontal force, coordinate {}",
            coordinate + 1
        );
        steps.push(Step::equal(claim, horizontal, P::zero()));
    }
    // The counts sum to L−1, so the others determine the last one.
    let mut counts = named(COUNTS);
    let others = counts.iter().skip(1).fold(P::zero(), |sum, n| sum + n);
    if let Some(first) = counts.first_mut() {
        *first = last_layer() - &others;
    }
    for (n, w) in counts.iter().zip(&own) {
        steps.extend(equations! {
            (claim("the transmitted force is received below")):
                (f.transmitted)((f.force)(n.clone(), w), w) => (f.force)(n.clone() + &P::one(), w),
        });
    }
    let normal = l.clone() + &(dimension.clone() - &int(1));
    let above = counts.iter().zip(&own);
    let above = above.map(|(n, w)| (f.force)(n.clone(), w));
    let over_layers = |p: P| p.sum(Symbol("k"), &P::zero(), &last_layer());
    steps.extend(equations! {
        (claim("normal force, in mg/d, is L+d−1")):
            above.fold(weight, |sum, force| sum + &force) => normal.clone(),
        (claim("Σ over the layers of their spheres")):
            over_layers((f.spheres_in_layer)(&k, d)) => (f.spheres)(&l, d),
        (claim("ΣF_z = weight, in mg/d")):
            normal * &(f.spheres_in_layer)(&last_layer(), d) => (f.spheres)(&l, d) * &dimension,
    });
}
