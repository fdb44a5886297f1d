//! Theorems on counts: the appendix of the paper, the rotation, spheres, contacts and their strengths.

use alloc::format;
use alloc::vec::Vec;

use num_traits::{One, Zero};

use super::setting::{
    P, above, equations, int, last_layer, sum_off_floor, sum_over_layer, sum_over_pile, symbol,
};
use super::{Formulas, ProofKind, Step, Theorem};
use crate::each::Each;
use crate::lattice::{Direction, Sign};
use crate::scalar::Symbol;

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "counts",
        statement: "The counts of the appendix: (N_α, N_β, N_γ) = (k−i−j, i, j) spheres lie above (i, j, k) on its \
                     lines. At the apex the counts are 0. One step down a line, the count of this line grows by one, \
                     and the other two stay the same. At the surface where a line begins, its count is 0; by induction",
        hypotheses: "0 ≤ j ≤ k, 0 ≤ i ≤ k−j",
        method: ProofKind::Induction,
        symbols: "i, j, k",
        derive: counts,
    },
    Theorem {
        name: "rotation",
        statement: "The rotation {j → k−i−j, i → j} about the axis permutes the counts, N_α → N_β → N_γ → N_α; an \
                     identity",
        hypotheses: "any site",
        method: ProofKind::Identity,
        symbols: "i, j, k",
        derive: rotation,
    },
    Theorem {
        name: "spheres",
        statement: "A pile has L(L+1)(L+2)/6 spheres, (k+1)(k+2)/2 in layer k; by summing over the layers",
        hypotheses: "L ≥ 1",
        method: ProofKind::Sum,
        symbols: "L, k",
        derive: spheres,
    },
    Theorem {
        name: "contacts",
        statement: "A pile has L(L−1)(L+1)/2 contacts. There is one in each of three directions below each sphere \
                     that is not on the floor. Counted from below, there is one above each sphere on each line with N \
                     ≥ 1; by summing over the spheres",
        hypotheses: "L ≥ 1",
        method: ProofKind::Sum,
        symbols: "L",
        derive: contacts,
    },
    Theorem {
        name: "strengths",
        statement: "In one direction (L−n)(L−n+1)/2 contacts carry n·f₀, for n = 1 … L−1. The forces of one direction \
                     sum to C(L+2,4)·f₀, their mean is (L+2)/4·f₀, and their squares sum to C(L+2,4)(2L+1)/5·f₀²; by \
                     summing over the spheres, and over n",
        hypotheses: "1 ≤ n ≤ L−1, s = 1/2",
        method: ProofKind::Sum,
        symbols: "L, n",
        derive: strengths,
    },
];

fn counts(f: &Formulas) -> Vec<Step> {
    let names = ["N_α", "N_β", "N_γ"];
    let [i, j, k] = ["i", "j", "k"].each(symbol);
    let here = above(f);
    let zero = P::zero();
    let mut steps = Vec::new();
    for (name, n) in names.iter().zip((f.above)(&zero, &zero, &zero)) {
        let claim = format!("base case: {name}(0, 0, 0) = 0");
        steps.push(Step::equal(claim, n, zero.clone()));
    }
    for (line, direction) in Direction::ALL.into_iter().enumerate() {
        let [di, dj] = (f.descent)(Sign::Plus, direction).each(int);
        let below = (f.above)(
            &(i.clone() + &di),
            &(j.clone() + &dj),
            &(k.clone() + &int(1)),
        );
        for (other, (name, n)) in names.iter().zip(below).enumerate() {
            let more = if other == line {
                P::one()
            } else {
                zero.clone()
            };
            let claim = format!("step along {direction}: {name} below is {name} + {more}");
            steps.push(Step::equal(claim, n, here[other].clone() + &more));
        }
    }
    let surfaces = [
        (&i, &j, &(i.clone() + &j)),
        (&zero, &j, &k),
        (&i, &zero, &k),
    ];
    for ((i, j, k), direction) in surfaces.into_iter().zip(Direction::ALL) {
        let name = names[direction.index()];
        let claim = format!("surface ({i}, {j}, {k}): {name} = 0");
        let n = (f.above)(i, j, k)[direction.index()].clone();
        steps.push(Step::equal(claim, n, zero.clone()));
    }
    steps
}

fn rotation(f: &Formulas) -> Vec<Step> {
    let [i, j, k] = ["i", "j", "k"].each(symbol);
    let [n_alpha, n_beta, n_gamma] = above(f);
    let image = (f.above)(&j, &(k.clone() - &i - &j), &k);
    let [alpha, beta, gamma] = image;
    equations! {
        "N_α of the image is N_β": alpha => n_beta,
        "N_β of the image is N_γ": beta => n_gamma,
        "N_γ of the image is N_α": gamma => n_alpha,
    }
}

fn spheres(f: &Formulas) -> Vec<Step> {
    let (l, k) = (symbol("L"), symbol("k"));
    let one = P::one();
    let cubic = l.clone() * &(l.clone() + &one) * &(l.clone() + &int(2));
    equations! {
        "Σ 1 over layer k is (k+1)(k+2)/2": sum_over_layer(&one, &k) => (f.spheres_in_layer)(&k, 3),
        "Σ 1 over the pile": sum_over_pile(&one) => (f.spheres)(&l, 3),
        "six times that is L(L+1)(L+2)": (f.spheres)(&l, 3) * &int(6) => cubic,
    }
}

fn contacts(f: &Formulas) -> Vec<Step> {
    let l = symbol("L");
    let closed = l.clone() * &(l.clone() - &P::one()) * &(l.clone() + &P::one());
    // A site with a sphere above it on a line is the image of a sphere off the floor. So the site N = 0 of each line is
    // left out.
    let [j, k] = ["j", "k"].each(symbol);
    let (zero, one) = (P::zero(), P::one());
    let rows = k.clone() - &j;
    let above = [
        // (j from, i from, i to)
        ("N_α = k−i−j ≥ 1", &zero, &zero, rows.clone() - &one),
        ("N_β = i ≥ 1", &zero, &one, rows.clone()),
        ("N_γ = j ≥ 1", &one, &zero, rows),
    ];
    let mut in_all = P::zero();
    let mut steps = Vec::new();
    for (claim, first_row, first, last) in above {
        let row = P::one().sum(Symbol("i"), first, &last);
        let layer = row.sum(Symbol("j"), first_row, &k);
        let touched = layer.sum(Symbol("k"), &zero, &last_layer());
        in_all = in_all + &touched;
        let off_floor = (f.spheres)(&last_layer(), 3);
        let claim = format!("spheres with {claim}: as many as off the floor");
        steps.push(Step::equal(claim, touched, off_floor));
    }
    let below = Direction::ALL
        .iter()
        .fold(P::zero(), |sum, _| sum + &sum_off_floor(&P::one()));
    steps.extend(equations! {
        "Σ over the spheres off the floor of the contacts below": below => (f.contacts)(&l, 3),
        "Σ over all spheres of the contacts above": in_all => (f.contacts)(&l, 3),
        "twice that is L(L−1)(L+1)": (f.contacts)(&l, 3) * &int(2) => closed,
    });
    steps
}

fn strengths(f: &Formulas) -> Vec<Step> {
    let (l, n) = (symbol("L"), symbol("n"));
    let count = (f.contacts_of_strength)(&l, &n, 3);
    // γ contacts of n increments: the spheres with j = n−1 in the layers n−1 … L−2, 0 ≤ i ≤ k−j.
    let k = symbol("k");
    let j = n.clone() - &P::one();
    let row = P::one().sum(Symbol("i"), &P::zero(), &(k - &j));
    let counted = row.sum(Symbol("k"), &j, &(last_layer() - &P::one()));
    let over_n = |p: P| p.sum(Symbol("n"), &P::one(), &last_layer());
    let total = over_n(count.clone() * &n);
    let factors = [2, 1, 0, -1].map(|more| l.clone() + &int(more));
    let binomial = factors
        .iter()
        .fold(P::one(), |product, factor| product * factor);
    // Σ over the contacts themselves: (N_γ + 1) over the spheres off the floor.
    let [_, _, gamma] = above(f);
    let by_contact = sum_off_floor(&(gamma + &P::one()));
    equations! {
        "the spheres with N_γ = n−1 off the floor": counted => count.clone(),
        "Σ over n counts every contact of the direction":
            over_n(count.clone()) * &int(3) => (f.contacts)(&l, 3),
        "Σ of strengths, by n and by contact": total.clone() => by_contact,
        "24 Σ n is (L+2)(L+1)L(L−1)": total.clone() * &int(24) => binomial,
        "the mean is (L+2)/4":
            total.clone() * &int(4) => over_n(count.clone()) * &(l.clone() + &int(2)),
        "5 Σ n² = (2L+1) Σ n":
            over_n(count * &n * &n) * &int(5) => total * &(l * &int(2) + &int(1)),
    }
}
