//! Horizontal contacts, fields and bounds that are wrong.

use cannonpile::scalar::Ring;
use cannonpile::theorem::Formulas;
use num_traits::{One, Zero};

use super::{Fault, P, RIGHT, faults, over, sum, swapped, twice};

pub(super) fn faults() -> Vec<Fault> {
    faults! {
        "the sphere is pulled": pushed = |force, ends, leads_away| (RIGHT.pushed)(force, ends, !leads_away) => [
                "horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];
        "squares": pushed = |force, ends, leads_away| {
            (RIGHT.pushed)(force, ends, leads_away).map(|x| x.clone() * &x)
        } => ["horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];
        "more on all lines": pushed = |force, ends, leads_away| {
            (RIGHT.pushed)(force, ends, leads_away).map(|x| twice(&x) + force)
        } => ["horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];

        "no horizontal contacts": beside = |received, own, _, _| received + own => ["horizontal-balance",
                "virtual-work", "corner-greatest", "arch", "run-horizontal"];
        "under − as under +": beside = |received, own, pushed, _| received + own - pushed => ["horizontal-balance",
                "virtual-work", "run-horizontal"];
        "weightless spheres": beside = |received, _, pushed, sign| {
            (RIGHT.beside)(received, &P::zero(), pushed, sign)
        } => ["horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];
        "what comes from above is lost": beside = |_, own, pushed, sign| {
            (RIGHT.beside)(P::zero(), own, pushed, sign)
        } => ["horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];
        "squares": beside = |received, own, pushed, sign| {
            (RIGHT.beside)(received.clone() * &received, own, pushed, sign)
        } => ["horizontal-balance", "virtual-work", "corner-greatest", "arch", "run-horizontal"];

        "the floor sinks too": lowered = |here, _| here => ["virtual-work", "elastic-straight", "corner-least",
                "corner-greatest"];
        "raised": lowered = |here, below| below.clone() - &here => ["virtual-work", "elastic-straight",
                "corner-least", "corner-greatest"];
        "a step too much": lowered = |here, below| here - below + &P::one() => ["virtual-work", "elastic-straight",
                "corner-least", "corner-greatest"];

        "spheres move apart": compression = |here, there, ends, sign| (RIGHT.compression)(there, here, ends, sign) => [
                "virtual-work", "elastic-straight", "corner-least"];
        "one more": compression = |here, there, ends, sign| {
            (RIGHT.compression)(here, there, ends, sign) + &P::one()
        } => ["virtual-work", "elastic-straight", "corner-least", "corner-greatest"];

        "d·n": elastic_field = |n, d| n.clone() * d => ["elastic-straight", "elastic-energy", "settlement"];
        "d(d+1)/2": elastic_field = |_, d| (RIGHT.elastic_field)(&P::zero(), d) => ["elastic-straight",
                "elastic-energy", "settlement"];
        "one on the floor": elastic_field = |n, d| (RIGHT.elastic_field)(n, d) + &P::one() => ["elastic-straight",
                "elastic-energy", "settlement"];
        "squares": elastic_field = |n, d| (RIGHT.elastic_field)(&(n.clone() * n), d) => ["elastic-straight",
                "elastic-energy", "settlement"];

        "none": corner_field = |_, _| [P::zero(), P::zero(), P::zero()] => ["corner-least", "corner-greatest"];
        "all lines always": corner_field = |edge, _| (RIGHT.corner_field)(edge, true) => ["corner-least",
                "corner-greatest"];
        "along the edge alone": corner_field = |edge, _| (RIGHT.corner_field)(edge, false) => ["corner-greatest"];
        "the other lines": corner_field = |edge, all| {
            let right = (RIGHT.corner_field)(edge, false);
            if all { right.map(|x| int(2) - &x) } else { right.map(|x| P::one() - &x) }
        } => ["corner-least", "corner-greatest"];

        "half": least_on_corner = |k| over(k.clone(), 2) => ["corner-least"];
        "all lines of the apex too": greatest_on_corner = |k| int(3) * k => ["corner-greatest"];
        "spheres of a layer": greatest_inside = |n| {
            (RIGHT.greatest_inside)(n) - &(RIGHT.greatest_inside)(&n.clone().map(|n| n - &P::one()))
        } => ["inner-greatest"];
        "k = j as k > j": greatest_on_edge = |k, j, _| (RIGHT.greatest_on_edge)(k, j, &(j.clone() + &P::one())) => [
                "edge-greatest"];
        "k > j as k = j": greatest_on_edge = |k, j, _| (RIGHT.greatest_on_edge)(k, j, k) => ["edge-greatest"];

        "pushes of a and b": arch = |nu| swapped(&(RIGHT.arch)(nu)) => ["arch"];
        "twice the forces": arch = |nu| (RIGHT.arch)(nu).map(|x| twice(&x)) => ["arch"];
        "equal forces": arch = |nu| [sum(nu), sum(nu), sum(nu)].map(|x| over(x, 6)) => ["arch"];
    }
}

fn int(n: i128) -> P {
    P::from_i128(n)
}
