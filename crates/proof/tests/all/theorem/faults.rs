//! Wrong formulas of horizontal contacts and of random stackings, each with the theorems that it refutes.

use cannonpile::scalar::{Polynomial, Ring};
use cannonpile_proof::Formulas;
use cannonpile_testkit::faults;
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::{Fault, over, sum, swapped, twice};
use num_traits::{One, Zero};

type P = Polynomial;

const RIGHT: Formulas = Formulas::LIBRARY;

/// Returns all faults, those of the core's formulas included.
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

/// Returns the faults of the other formulas.
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

        "one less for the step itself": third_moment = |n, s| (RIGHT.third_moment)(n, s) - &P::one() => ["third-moment"];
        "every sign alike": third_moment = |n, s| (RIGHT.third_moment)(n, &(s.clone() - s + &P::one())) => ["third-moment"];
        "a step further down": third_moment = |n, s| (RIGHT.third_moment)(&(n.clone() + &P::one()), s) => ["third-moment"];
        "FCC, n⁴": fourth_moment = |n| n.clone() * n * n * n => ["fourth-moment"];
        "the last step left out": fourth_moment = |n| (RIGHT.fourth_moment)(&(n.clone() - &P::one())) => ["fourth-moment"];
        "each pair once": fourth_moment_of_pair = |n, s, t| {
            let twice = (RIGHT.fourth_moment_of_pair)(n, s, t);
            twice * &P::constant(&num_rational::BigRational::new(1.into(), 2.into()))
        } => ["fourth-moment"];
        "s and t exchanged": fourth_moment_of_pair = |n, s, t| (RIGHT.fourth_moment_of_pair)(n, t, s) => ["fourth-moment"];
        "the mean without what decays": mean_third_moment = |n, mu, _| (RIGHT.mean_third_moment)(n, mu, &int(0)) => ["third-moment"];
        "the mean of −q": mean_third_moment = |n, mu, x| (RIGHT.mean_third_moment)(n, &-mu.clone(), x) => ["third-moment"];
        "μ too much": mean_third_moment = |n, mu, x| (RIGHT.mean_third_moment)(n, mu, x) + mu => ["third-moment"];
        "pairs without what decays": mean_fourth_moment_of_pairs =
            |n, mu, _| (RIGHT.mean_fourth_moment_of_pairs)(n, mu, &int(0)) => ["fourth-moment"];
        "pairs of a step less": mean_fourth_moment_of_pairs =
            |n, mu, x| (RIGHT.mean_fourth_moment_of_pairs)(&(n.clone() - &P::one()), mu, x) => ["fourth-moment"];
        "twice the damping": wave = |q| {
            let [damping, dispersion] = (RIGHT.wave)(q);
            [int(2) * &damping, dispersion]
        } => ["mean-spectrum"];
        "no dispersion": wave = |q| {
            let [damping, _] = (RIGHT.wave)(q);
            [damping, int(0)]
        } => ["mean-spectrum"];
        "a fault with 1 − q": registry_excess = |x, y, q| (RIGHT.registry_excess)(x, y, &(P::one() - q)) => ["registry"];
        "the layers exchanged": registry_excess = |x, y, q| (RIGHT.registry_excess)(y, x, q) => ["registry"];
        "as if a layer knew one above only": registry_excess = |_, y, q| (RIGHT.registry_excess)(&int(0), y, q) => ["registry"];
        "the half of it, as at q = 1/2": registry_excess = |x, y, _| over((RIGHT.registry_excess)(x, y, &int(0)), 2) => ["registry"];
        "of −q": wave = |q| (RIGHT.wave)(&-q.clone()) => ["mean-spectrum"];
    }
}

fn int(n: i128) -> P {
    P::from_integer(n)
}
