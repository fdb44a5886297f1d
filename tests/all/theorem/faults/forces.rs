//! Forces between spheres that are wrong.

use cannonpile::closed_form::Increments;
use cannonpile::lattice::Symmetry;
use cannonpile::theorem::Formulas;
use num_traits::{One, Zero};

use super::{Fault, P, RIGHT, faults, over, sum, swapped, twice};

pub(super) fn faults() -> Vec<Fault> {
    faults! {
        "equal increments for every φ": increments = |_| Increments::regular()
            => ["paper-system", "equilibrium", "base-normal", "uniform-base", "total-shear",
                "total-moment", "second-moment", "discs"];
        "Δγ = s": increments = |s| Increments::new([P::one(), P::one(), s.clone()])
            => ["paper-system", "equilibrium", "central-force", "base-normal", "uniform-base", "shear",
                "total-shear", "total-moment", "second-moment", "shear-on-axis", "shear-ratio", "point-load"];
        "Δβ = −Δα": increments = |s| Increments::new([P::one(), -P::one(), twice(s)])
            => ["paper-system", "equilibrium", "central-force", "base-normal", "uniform-base", "shear",
                "total-shear", "total-moment", "second-moment", "shear-on-axis", "shear-ratio", "discs", "point-load"];
        "increments for twice the weight": increments = |s| {
            Increments::new((RIGHT.increments)(s).per_line().each_ref().map(twice))
        } => ["paper-system", "central-force", "base-normal", "uniform-base", "shear", "shear-on-axis",
              "shear-ratio", "discs", "point-load"];

        "a wall pushes on the surface": from_above = |increments, above| {
            let pushed = above.clone().map(|n| if n.is_zero() { P::one() } else { n });
            increments.from_above(&pushed)
        } => ["surface"];
        "what a sphere passes on": from_above = Increments::to_below => ["surface", "action-reaction"];
        "α for β": from_above = |increments, above| swapped(&increments.from_above(above))
            => ["surface", "action-reaction"];
        "twice what is given": from_above = |increments, above| {
            increments.from_above(above).each_ref().map(twice)
        } => ["action-reaction"];

        "weightless spheres": to_below = Increments::from_above => ["equilibrium", "action-reaction"];
        "α for β": to_below = |increments, above| swapped(&increments.to_below(above))
            => ["equilibrium", "action-reaction"];
        "too much along γ": to_below = |increments, above| {
            let [a, b, c] = increments.to_below(above);
            [a, b, c + &P::one()]
        } => ["equilibrium", "action-reaction"];

        "what a sphere receives": resultant_above = |above, increments, directions| {
            -(RIGHT.resultant_above)(above, increments, directions)
        } => ["central-force"];
        "its own weight included": resultant_above = |above, increments, directions| {
            (RIGHT.force_on_floor)(above, increments, directions, increments.sum())
        } => ["central-force"];

        "the paper's misprint, without a′ + b′ + c′": unbalanced = |above, increments, directions, weight| {
            let all = (RIGHT.unbalanced)(above, increments, directions, weight);
            all - &(RIGHT.resultant_above)(above, increments, directions)
        } => ["equilibrium", "discs"];
        "weightless spheres": unbalanced = |above, increments, directions, _| {
            (RIGHT.unbalanced)(above, increments, directions, &P::zero())
        } => ["equilibrium", "discs"];

        "an increment too much": force = |increments, n, line| {
            (RIGHT.force)(increments, n + &P::one(), line)
        } => ["run"];
        "the next line's increment": force = |increments, n, line| {
            (RIGHT.force)(increments, n, (line + 1) % 3)
        } => ["run"];
        "the last line's increment": force = |increments, n, line| {
            (RIGHT.force)(increments, n, (line + 2) % 3)
        } => ["run"];

        "the half-turn itself": tripled_half_turn = RIGHT.half_turn => ["tripled-half-turn"];
        "2Σ − g": tripled_half_turn = |g| g.clone().map(|x| twice(&sum(g)) - &x) => ["tripled-half-turn"];

        "−I": half_turn = |g| g.clone().map(|x| -x) => ["half-turn", "tripled-half-turn", "edge", "point-load"];
        "I": half_turn = Clone::clone => ["half-turn", "tripled-half-turn", "edge", "point-load"];
        "J − I": half_turn = |g| g.clone().map(|x| sum(g) - &x) => ["half-turn", "tripled-half-turn", "edge", "point-load"];
        "(1/3)J − I": half_turn = |g| g.clone().map(|x| over(sum(g), 3) - &x) => ["half-turn", "tripled-half-turn", "edge", "point-load"];
        "a third of a turn": half_turn = |g| Symmetry::ROTATION.permute(g) => ["half-turn", "tripled-half-turn", "edge", "point-load"];
    }
}
