//! Mutants of the formulas: wrong fields and bounds.

use cannonpile::scalar::{Polynomial, Ring};
use cannonpile_horizontal::theorem::Formulas;
use cannonpile_testkit::faults;
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::{Fault, over, sum, swapped, twice};
use num_traits::{One, Zero};

type P = Polynomial;

const RIGHT: Formulas = Formulas::LIBRARY;

/// Returns all mutants, of the core's formulas and of those of this crate.
pub(super) fn all() -> impl Iterator<Item = Fault<Formulas>> {
    let lifted = |fault: Fault| Fault {
        what: fault.what,
        field: fault.field,
        formulas: Formulas {
            core: fault.formulas,
            ..RIGHT
        },
        refuted_by: fault.refuted_by,
    };
    let of_the_core = proofs::of_the_core().into_iter().map(lifted);
    of_the_core.chain(own())
}

/// Returns the mutants of the formulas of this crate.
pub(super) fn own() -> Vec<Fault<Formulas>> {
    faults! {
        "the floor sinks too": contact_drop = |here, _| here => ["virtual-work", "elastic-straight", "corner-least",
                "corner-greatest"];
        "raised": contact_drop = |here, below| below.clone() - &here => ["virtual-work", "elastic-straight",
                "corner-least", "corner-greatest"];
        "a step too much": contact_drop = |here, below| here - below + &P::one() => ["virtual-work", "elastic-straight",
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
