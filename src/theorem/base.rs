//! Theorems on the forces on the floor.

use alloc::format;
use alloc::vec::Vec;

use num_traits::Zero;

use super::setting::{
    P, Setting, above, above_floor, equations, int, last_layer, sum_over_base, sum_over_pile,
    symbol,
};
use super::{Formulas, ProofKind, Step, Theorem};
use crate::each::Each;
use crate::geometry::Vector;
use crate::lattice::Direction;
use crate::scalar::Symbol;

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "base-normal",
        statement: "The normal force on the floor is mg[1 + ((L−1−j) + 2sj)/(2(1+s))], and mg(L+2)/3 under every \
                    sphere of an equilateral base; an identity",
        hypotheses: "0 ≤ j ≤ L−1, 0 ≤ i ≤ L−1−j",
        method: ProofKind::Identity,
        symbols: "L, i, j, s",
        derive: base_normal,
    },
    Theorem {
        name: "uniform-base",
        statement: "Uniform base: the normal forces of two bottom spheres differ by (2s−1)(j−j') increments, so the \
                    pressure is uniform if and only if sin φ = 1/2; an identity",
        hypotheses: "two bottom spheres (i, j) and (i', j'), L ≥ 2",
        method: ProofKind::Identity,
        symbols: "L, i, i', j, j', s",
        derive: uniform_base,
    },
    Theorem {
        name: "weight",
        statement: "Total weight: the normal forces on the floor sum to the weight of all spheres, for every φ; by \
                    summing over the base",
        hypotheses: "L ≥ 1, 0 < s < 1",
        method: ProofKind::Sum,
        symbols: "L, s",
        derive: weight,
    },
    Theorem {
        name: "shear",
        statement: "The shear on the floor is that of the paper, −(L−1−3j)/2·sinθ along x and −√3/2·(L−1−2i−j)·sinθ \
                    along y, in f₀, on an equilateral base; an identity",
        hypotheses: "s = 1/2",
        method: ProofKind::Identity,
        symbols: "L, i, j",
        derive: shear,
    },
    Theorem {
        name: "total-shear",
        statement: "Total shear: the horizontal forces on the floor sum to zero, for every φ; by summing over the base",
        hypotheses: "L ≥ 1, 0 < s < 1",
        method: ProofKind::Sum,
        symbols: "L, s",
        derive: total_shear,
    },
    Theorem {
        name: "total-moment",
        statement: "Total moment: the shear on the floor has no moment about the axis, and about both horizontal axes \
                     the normal forces have the moments of the weights, ΣF_z r_b = Σ mg r_s; for every φ; by summing \
                     over base and pile",
        hypotheses: "L ≥ 1, 0 < s < 1",
        method: ProofKind::Sum,
        symbols: "L, s",
        derive: total_moment,
    },
    Theorem {
        name: "second-moment",
        statement: "Second moment: ΣF_z r_b² = Σ mg (r_s² + H_s² tan²θ), where r is the horizontal position relative \
                     to the axis, and H_s the height of a sphere above the base; for every φ; by summing over base and \
                     pile",
        hypotheses: "L ≥ 1, 0 < s < 1",
        method: ProofKind::Sum,
        symbols: "L, s",
        derive: second_moment,
    },
    Theorem {
        name: "shear-on-axis",
        statement: "On an equilateral base the shear of a bottom sphere, in f₀, is its horizontal position relative \
                     to the axis, in 2R. It vanishes on the axis and nowhere else: with L−1 = 3n+p, twice the shear is \
                     (3(j−n) − p, 2(i−n) + (j−n) − p). This is zero at i = j = n if p = 0, and nowhere if p is 1 or 2, \
                     because then (in words) 3 does not divide p; an identity",
        hypotheses: "s = 1/2; p = 0, 1, 2",
        method: ProofKind::Identity,
        symbols: "L, i, j, n",
        derive: shear_on_axis,
    },
    Theorem {
        name: "shear-ratio",
        statement: "Largest shear/normal ratio: tanθ(L−1)/(L+2) on an equilateral base. The normal force is L+2 \
                     everywhere, |shear|² is (L−1)² at the three corners, and (L−1)² − |shear|² = 3(N_αN_β + N_βN_γ + \
                     N_γN_α). The right side (in words) is 0 at the corners, where two of the counts are 0, and \
                     positive everywhere else; an identity",
        hypotheses: "s = 1/2, N ≥ 0",
        method: ProofKind::Identity,
        symbols: "L, i, j",
        derive: shear_ratio,
    },
];

/// Returns the force on the floor at (i, j), in f₀.
fn on_floor(f: &Formulas, setting: &Setting) -> Vector<P> {
    setting.support_load(f, &above_floor(f))
}

fn base_normal(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let (l, j, s) = (symbol("L"), symbol("j"), symbol("s"));
    let claimed = int(2) * &(int(1) + &s) + &(l.clone() - &int(1) - &j) + &(int(2) * &s * &j);
    let equilateral = on_floor(f, &Setting::equilateral(f)).z;
    equations! {
        "the normal force on the floor, in mg/W": on_floor(f, &setting).z => claimed,
        "for s = 1/2, in mg/3": equilateral => l + &int(2),
    }
}

fn uniform_base(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let here = on_floor(f, &setting).z;
    let primed = [("i", "i'"), ("j", "j'")];
    let there = primed.into_iter().fold(here.clone(), |p, (name, other)| {
        p.substitute(Symbol(name), &symbol(other))
    });
    let difference = here - &there;
    let factor = int(2) * &setting.s - &int(1);
    let rows = symbol("j") - &symbol("j'");
    // If the division fails, a step of the proof fails.
    let quotient = difference.divide_exactly(&factor).unwrap_or_else(P::zero);
    let at_half = difference.substitute(Symbol("s"), &super::setting::half());
    let mut steps = equations! {
        "difference of two normal forces": difference => factor * &rows,
        "s = 1/2: no difference": at_half => P::zero(),
        "divided by 2s−1": quotient.clone() => rows,
    };
    let claim = "other s: not zero for spheres of different rows";
    steps.push(Step::different(claim, quotient, P::zero()));
    steps
}

fn weight(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let total = sum_over_base(&on_floor(f, &setting).z);
    let spheres = (f.spheres)(&symbol("L"), 3);
    equations! {
        "ΣF_z = W·spheres, in mg/W": total => spheres * &setting.weight,
    }
}

fn shear(f: &Formulas) -> Vec<Step> {
    let force = on_floor(f, &Setting::equilateral(f));
    let [i, j] = ["i", "j"].each(symbol);
    equations! {
        "2F_x = −(L−1−3j)": force.x * &int(2) => int(3) * &j - &last_layer(),
        "2F_y = −(L−1−2i−j), with √3 in the unit":
            force.y * &int(2) => int(2) * &i + &j - &last_layer(),
    }
}

fn total_shear(f: &Formulas) -> Vec<Step> {
    let force = on_floor(f, &Setting::isosceles(f));
    equations! {
        "ΣF_x = 0": sum_over_base(&force.x) => P::zero(),
        "ΣF_y = 0": sum_over_base(&force.y) => P::zero(),
    }
}

fn total_moment(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let force = on_floor(f, &setting);
    let at = (f.position)(&above_floor(f), &setting.directions);
    let sphere = (f.position)(&above(f), &setting.directions);
    let about_axis = at.x.clone() * &force.y - &(at.y.clone() * &force.x);
    let floor = |lever: &P| sum_over_base(&(force.z.clone() * lever));
    let weights = |lever: &P| sum_over_pile(lever) * &setting.weight;
    equations! {
        "Σ(x F_y − y F_x) = 0": sum_over_base(&about_axis) => P::zero(),
        "ΣF_z x = Σ mg x": floor(&at.x) => weights(&sphere.x),
        "ΣF_z y = Σ mg y": floor(&at.y) => weights(&sphere.y),
    }
}

fn second_moment(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let at = (f.position)(&above_floor(f), &setting.directions);
    let sphere = (f.position)(&above(f), &setting.directions);
    let normal = on_floor(f, &setting).z;
    // H = (L−1−k)·2R cosθ, so H² tan²θ is (L−1−k)² in (2R sinθ)².
    let height = last_layer() - &symbol("k");
    let spheres = setting.horizontal_square(&sphere) + &(height.clone() * &height);
    let moments = normal * &setting.horizontal_square(&at);
    equations! {
        "ΣF_z r_b² = W·Σ(r_s² + (L−1−k)²), in mg/W·(2R sinθ)²":
            sum_over_base(&moments) => sum_over_pile(&spheres) * &setting.weight,
    }
}

fn shear_on_axis(f: &Formulas) -> Vec<Step> {
    let setting = Setting::equilateral(f);
    let force = on_floor(f, &setting);
    let at = (f.position)(&above_floor(f), &setting.directions);
    let [i, j, n] = ["i", "j", "n"].each(symbol);
    let [from_i, from_j] = [i.clone() - &n, j.clone() - &n];
    let twice = force.clone().map(|part| part * &int(2));
    let mut steps = equations! {
        "twice x is 3j − (L−1)": at.x.clone() * &int(2) => int(3) * &j - &last_layer(),
        "twice y is 2i+j − (L−1)": at.y.clone() * &int(2) => int(2) * &i + &j - &last_layer(),
        "F_x = x": force.x => at.x,
        "F_y = y": force.y => at.y,
    };
    for p in 0..3 {
        let layers = int(3) * &n + &int(p + 1);
        let [along_x, along_y] =
            [&twice.x, &twice.y].each(|part| part.substitute(Symbol("L"), &layers));
        steps.extend(equations! {
            (format!("L−1 = 3n+{p}: along x, 3(j−n) − {p}")):
                along_x => int(3) * &from_j - &int(p),
            (format!("L−1 = 3n+{p}: along y, 2(i−n) + (j−n) − {p}")):
                along_y => int(2) * &from_i + &from_j - &int(p),
        });
    }
    steps
}

fn shear_ratio(f: &Formulas) -> Vec<Step> {
    let setting = Setting::equilateral(f);
    let force = on_floor(f, &setting);
    let [a, b, c] = above_floor(f);
    let (last, zero) = (last_layer(), P::zero());
    let square = last.clone() * &last;
    let pairs = a.clone() * &b + &(b * &c) + &(c * &a);
    let mut steps = equations! {
        "(L−1)² − |shear|² = 3(N_αN_β + N_βN_γ + N_γN_α)":
            square.clone() - &setting.horizontal_square(&force) => int(3) * &pairs,
        "the normal force is L+2 everywhere": force.z => symbol("L") + &int(2),
    };
    let corners = [(&zero, &zero), (&last, &zero), (&zero, &last)];
    for (direction, (i, j)) in Direction::ALL.into_iter().zip(corners) {
        let there = setting.support_load(f, &(f.above)(i, j, &last));
        let claim = format!("|shear|² at the {direction} corner is (L−1)²");
        let shear = setting.horizontal_square(&there);
        steps.push(Step::equal(claim, shear, square.clone()));
    }
    steps
}
