//! Theorems at numbers: their polynomials take the values that are counted and summed on real piles.

mod balance;
mod base;
mod counts;
mod dimensions;
mod horizontal;

use cannonpile::Pile;
use cannonpile::lattice::Site;
use cannonpile::scalar::{Ring, Symbol};
use cannonpile::theorem::{self, Formulas, Proof, Relation, Step};
use num_rational::BigRational as Q;

const RIGHT: Formulas = Formulas::LIBRARY;

fn ratio(n: i64, d: i64) -> Q {
    Q::new(n.into(), d.into())
}

fn int(n: i128) -> Q {
    Q::from_i128(n)
}

fn prove(name: &str) -> Proof {
    theorem::find(name).expect("a theorem").prove()
}

/// The values of the symbols i, j, k.
fn at_site(Site { i, j, k }: Site) -> Vec<(&'static str, Q)> {
    vec![("i", int(i)), ("j", int(j)), ("k", int(k))]
}

/// What both sides of the one step with this text in its claim come to.
fn value(proof: &Proof, claim: &str, values: &[(&'static str, Q)]) -> Q {
    let steps: Vec<_> = proof
        .steps
        .iter()
        .filter(|step| step.claim.contains(claim))
        .collect();
    let [step] = steps[..] else {
        panic!("{} steps claim {claim}", steps.len());
    };
    let [left, right] = evaluated(step, values);
    assert_eq!(left, right, "{claim}");
    left
}

fn evaluated(step: &Step, values: &[(&'static str, Q)]) -> [Q; 2] {
    let values: Vec<_> = values
        .iter()
        .map(|(name, value)| (Symbol(name), value.clone()))
        .collect();
    [&step.left, &step.right].map(|side| side.evaluate(&values).expect("a value for every symbol"))
}

/// Values of sin φ: the equilateral base, others on both sides of it, one next to zero.
fn sines() -> [Q; 5] {
    [(1, 2), (1, 3), (2, 5), (7, 9), (1, 1000)].map(|(n, d)| ratio(n, d))
}

/// Piles of 1 to `layers` layers on every base.
fn piles(layers: i128) -> impl Iterator<Item = Pile> {
    let of_one_base =
        move |s: Q| (1..=layers).map(move |l| Pile::isosceles(l, s.clone()).expect("a pile"));
    sines().into_iter().flat_map(of_one_base)
}

/// Piles of 1 to `layers` layers on an equilateral base.
fn equilateral_piles(layers: i128) -> impl Iterator<Item = Pile> {
    (1..=layers).map(|l| Pile::triangular(l).expect("a pile"))
}

/// The two sides are equal wherever they are evaluated, and different somewhere if that is the claim.
#[test]
fn sides_agree_at_every_point() {
    for theorem in theorem::all() {
        for step in theorem.prove().steps {
            let mut symbols = step.left.symbols();
            symbols.extend(step.right.symbols());
            let agree = (0..20_u32).all(|point| {
                let at =
                    |n: usize| ratio(i64::try_from(n).expect("few") * 7 - 3, 5) + int(point.into());
                let values: Vec<_> = symbols
                    .iter()
                    .enumerate()
                    .map(|(n, s)| (s.0, at(n)))
                    .collect();
                let [left, right] = evaluated(&step, &values);
                left == right
            });
            let claimed = step.relation == Relation::Equal;
            assert_eq!(agree, claimed, "{}: {}", theorem.name, step.claim);
        }
    }
}
