//! Proof of the recursion of registries.

use cannonpile::each::Each;
use cannonpile::scalar::Algebra;
use cannonpile::theorem::Step;
use cannonpile::theorem::setting::{P, equations, symbol};
use num_traits::{One, Zero};

use crate::Formulas;
use crate::theorem::terms::{THREE, sum, symbols};

/// The probabilities of each registry after a + step, and after a − step.
type Shares = [[P; 3]; 2];

/// Returns the probabilities after one more step.
fn stepped([plus, minus]: &Shares, q: &P) -> Shares {
    let straight = P::one() - q;
    let chosen = |same: &P, other: &P| same.clone() * &straight + &(other.clone() * q);
    [
        [0, 1, 2].each(|r: usize| chosen(&plus[(r + 2) % 3], &minus[(r + 2) % 3])),
        [0, 1, 2].each(|r: usize| chosen(&minus[(r + 1) % 3], &plus[(r + 1) % 3])),
    ]
}

/// Returns the excess of each registry over a third of the total.
fn excesses([plus, minus]: &Shares) -> [P; 3] {
    let third = sum(plus.iter().chain(minus).cloned()).div_int(THREE);
    [0, 1, 2].each(|r: usize| plus[r].clone() + &minus[r] - &third)
}

pub(super) fn registry(f: &Formulas) -> Vec<Step> {
    let q = symbol("q");
    let shares = [
        symbols(["p_0", "p_1", "p_2"]),
        symbols(["m_0", "m_1", "m_2"]),
    ];
    let once = stepped(&shares, &q);
    let twice = stepped(&once, &q);
    // A single layer has no sign. So its probability can be assigned to either sign.
    let [u, v] = ["u", "v"].each(symbol);
    let nothing = || [(); 3].each(|()| P::zero());
    let begun = [[u.clone() + &v, P::zero(), P::zero()], nothing()];
    let first = [[P::zero(), u, P::zero()], [P::zero(), P::zero(), v]];
    let second = stepped(&first, &q);
    let mut steps = Vec::new();
    for (case, layers) in [
        ("two steps below a single layer", [begun, first, second]),
        ("two steps more", [shares, once, twice]),
    ] {
        let [before, after, below] = layers.each_ref().each(excesses);
        for r in 0..3 {
            steps.extend(equations! {
                (format!("{case}: registry {r}")):
                    (f.registry_excess)(&before[r], &after[r], &q) => below[r].clone(),
            });
        }
    }
    steps
}
