//! Faults in the forces between spheres.

use cannonpile::geometry::Vector;
use cannonpile::theorem::Formulas;
use num_traits::{One, Zero};

use super::parts::{Fault, P, RIGHT, faults, over, sum, twice};

pub(super) fn faults() -> Vec<Fault> {
    faults! {
        "equal increments for every φ": increments = |_| [P::one(), P::one(), P::one()]
            => ["paper-system", "equilibrium", "base-normal", "uniform-base", "total-shear", "total-moment",
                "second-moment", "discs", "load", "tilt", "tilt-total", "isometry", "rough-floor"];
        "Δγ = s": increments = |s| [P::one(), P::one(), s.clone()]
            => ["paper-system", "equilibrium", "central-force", "base-normal", "uniform-base", "shear", "total-shear",
                "total-moment", "second-moment", "shear-on-axis", "shear-ratio", "change-of-sign", "edge",
                "point-load", "load", "tilt", "tilt-total", "secondary-closure", "isometry", "rough-floor",
                "horizontal-balance", "elastic-straight", "elastic-energy", "squares", "faults"];
        "Δβ = −Δα": increments = |s| [P::one(), -P::one(), twice(s)]
            => ["paper-system", "equilibrium", "central-force", "base-normal", "uniform-base", "shear", "total-shear",
                "total-moment", "second-moment", "shear-on-axis", "shear-ratio", "discs", "change-of-sign", "edge",
                "point-load", "load", "tilt", "tilt-total", "secondary-closure", "isometry", "rough-floor",
                "horizontal-balance", "elastic-straight", "squares", "faults"];
        "increments for twice the weight": increments = |s| (RIGHT.increments)(s).each_ref().map(twice)
            => ["paper-system", "central-force", "base-normal", "uniform-base", "shear", "shear-on-axis",
                "shear-ratio", "discs", "edge", "point-load", "load", "tilt", "tilt-total",
                "horizontal-balance", "elastic-straight", "elastic-energy", "squares", "faults"];

        "one increment for all": weight = |increments| {
            increments.first().map_or_else(P::zero, Clone::clone)
        } => ["paper-system", "equilibrium", "base-normal", "weight", "total-moment", "second-moment", "shear-ratio",
                "discs", "dimensions", "change-of-sign", "load", "tilt", "tilt-total", "isometry", "rough-floor",
                "horizontal-balance", "squares"];
        "the last increment left out": weight = |increments| {
            let [all @ .., _] = increments else { return P::zero() };
            (RIGHT.weight)(all)
        } => ["paper-system", "equilibrium", "base-normal", "weight", "total-moment", "second-moment", "shear-ratio",
                "dimensions", "change-of-sign", "load", "tilt", "tilt-total", "isometry", "rough-floor",
                "horizontal-balance", "squares"];

        "one increment too many": force = |n, w| (RIGHT.force)(n + &P::one(), w) => ["surface",
                "central-force", "base-normal", "weight", "total-moment", "second-moment", "shear-ratio",
                "discs", "dimensions", "run", "edge", "load", "tilt", "tilt-total", "horizontal-balance",
                "elastic-straight", "elastic-energy", "squares"];
        "the square of the count": force = |n, w| (RIGHT.force)(n.clone() * &n, w) => ["action-reaction",
                "central-force", "base-normal", "uniform-base", "weight", "shear", "total-moment",
                "second-moment", "shear-on-axis", "shear-ratio", "discs", "dimensions", "run", "edge", "load",
                "tilt", "tilt-total", "horizontal-balance", "elastic-straight", "elastic-energy", "squares"];
        "spheres of weight 1 whatever their increment": force = |n, _| n => ["equilibrium", "action-reaction",
                "base-normal", "uniform-base", "weight", "total-shear", "total-moment", "second-moment", "run",
                "change-of-sign", "load", "tilt", "tilt-total", "rough-floor", "horizontal-balance", "squares"];

        "weightless spheres": transmitted = |received, _| received => ["equilibrium", "action-reaction", "discs",
                "dimensions", "run", "change-of-sign", "edge", "load", "tilt", "inverse", "elastic-straight",
                "elastic-energy", "squares"];
        "the forces from above left out": transmitted = |_, own| own.clone() => ["equilibrium", "action-reaction",
                "discs", "dimensions", "run", "change-of-sign", "edge", "load", "tilt", "secondary-closure",
                "isometry", "inverse", "singular-values", "elastic-straight", "elastic-energy", "squares"];
        "its own increment twice": transmitted = |received, own| received + own + own => ["equilibrium",
                "action-reaction", "discs", "dimensions", "run", "change-of-sign", "edge", "load", "tilt", "inverse",
                "elastic-straight", "elastic-energy", "squares"];

        "the resultant reversed": resultant = |from_above, directions| {
            -(RIGHT.resultant)(from_above, directions)
        } => ["central-force"];
        "nothing along γ": resultant = |[a, b, _], directions| {
            (RIGHT.resultant)(&[a.clone(), b.clone(), P::zero()], directions)
        } => ["central-force", "resultant-form"];

        "the paper's misprint, without a′ + b′ + c′": unbalanced = |to_below, below, from_above, above, weight| {
            let all = (RIGHT.unbalanced)(to_below, below, from_above, above, weight);
            all - &(RIGHT.resultant)(from_above, above)
        } => ["paper-system", "equilibrium", "discs", "change-of-sign", "load", "tilt", "isometry", "horizontal-balance"];
        "weightless spheres": unbalanced = |to_below, below, from_above, above, _| {
            (RIGHT.unbalanced)(to_below, below, from_above, above, &P::zero())
        } => ["paper-system", "equilibrium", "discs", "change-of-sign", "load", "tilt", "horizontal-balance"];

        "always zero": unbalanced = |_, _, _, _, _| Vector::zero() => ["paper-system", "load", "tilt",
                "horizontal-balance"];

        "each once, with its own added": tripled_apart = |g| {
            (RIGHT.tripled_apart)(g).map(|x| x + &g[0])
        } => ["tripled-half-turn"];

        "the half-turn itself": tripled_half_turn = RIGHT.half_turn => ["tripled-half-turn"];
        "2Σ − g": tripled_half_turn = |g| g.clone().map(|x| twice(&sum(g)) - &x) => ["tripled-half-turn"];

        "−I": half_turn = |g| g.clone().map(|x| -x) => ["half-turn", "tripled-half-turn", "change-of-sign",
                "edge", "point-load", "load", "mean-closure", "horizontal-balance", "run-horizontal",
                "resultant-form", "squares", "third-moment", "fourth-moment", "mean-spectrum", "wave", "faults",
                "one-fault"];
        "I": half_turn = Clone::clone => ["half-turn", "tripled-half-turn", "change-of-sign", "edge",
                "point-load", "load", "secondary-closure", "mean-closure", "horizontal-balance",
                "run-horizontal", "resultant-form", "third-moment", "fourth-moment", "mean-modes",
                "mean-spectrum", "wave", "faults", "one-fault"];
        "J − I": half_turn = |g| g.clone().map(|x| sum(g) - &x) => ["half-turn", "tripled-half-turn", "change-of-sign",
                "edge", "point-load", "load", "mean-closure", "isometry", "horizontal-balance", "run-horizontal",
                "resultant-form", "squares", "third-moment", "fourth-moment", "mean-modes", "mean-spectrum", "wave",
                "faults", "one-fault"];
        "(1/3)J − I": half_turn = |g| g.clone().map(|x| over(sum(g), 3) - &x) => ["half-turn", "tripled-half-turn",
                "change-of-sign", "edge", "point-load", "load", "mean-closure", "isometry", "horizontal-balance",
                "run-horizontal", "resultant-form", "squares", "third-moment", "fourth-moment", "mean-modes",
                "mean-spectrum", "wave", "faults", "one-fault"];
        "the square of the first force added": half_turn = |g| {
            (RIGHT.half_turn)(g).map(|x| x + &(g[0].clone() * &g[0]))
        } => ["half-turn", "tripled-half-turn", "change-of-sign", "edge", "point-load", "load", "mean-closure",
                "isometry", "inverse", "horizontal-balance", "virtual-work", "run-horizontal", "resultant-form",
                "squares", "third-moment", "fourth-moment", "mean-modes", "mean-spectrum", "wave", "faults",
                "one-fault"];
        "a third of a turn": half_turn = |[a, b, c]| [b.clone(), c.clone(), a.clone()] => ["half-turn",
                "tripled-half-turn", "change-of-sign", "edge", "point-load", "load", "secondary-closure",
                "mean-closure", "horizontal-balance", "virtual-work", "run-horizontal", "resultant-form",
                "third-moment", "fourth-moment", "mean-modes", "mean-spectrum", "wave", "faults", "one-fault"];
    }
}
