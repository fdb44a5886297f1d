//! Wrong formulas for the moments and waves of the response to a load.

use cannonpile::scalar::{Polynomial, Ring};
use cannonpile_disorder::theorem::Formulas;
use cannonpile_testkit::faults;
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::{Fault, over};
use num_traits::One;

type P = Polynomial;

const RIGHT: Formulas = Formulas::LIBRARY;

fn int(n: i128) -> P {
    P::from_i128(n)
}

/// Returns all faults, in the formulas of the core and of this crate.
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

/// Returns the faults in the formulas of this crate.
pub(super) fn own() -> Vec<Fault<Formulas>> {
    faults! {
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
