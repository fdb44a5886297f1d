//! Evaluates both sides of a step.

use cannonpile::scalar::Symbol;
use cannonpile::theorem::{Library, Proof, Relation, Step, Theorem};
use num_rational::BigRational as Q;

use crate::answers::ratio;

/// Returns the common value of both sides of the only step whose claim contains `claim`.
pub fn value(proof: &Proof, claim: &str, values: &[(&'static str, Q)]) -> Q {
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

/// Returns both sides of a step for these values of the symbols.
pub fn evaluated(step: &Step, values: &[(&'static str, Q)]) -> [Q; 2] {
    let values: Vec<_> = values
        .iter()
        .map(|(name, value)| (Symbol(name), value.clone()))
        .collect();
    [&step.left, &step.right].map(|side| side.evaluate(&values).expect("a value for every symbol"))
}

/// Panics unless both sides of each step are equal at every point. If the step claims an inequality, they must differ
/// somewhere.
pub fn sides_agree_at_every_point<F: Library>(theorems: &[&Theorem<F>]) {
    for theorem in theorems {
        for step in theorem.prove().steps {
            let mut symbols = step.left.symbols();
            symbols.extend(step.right.symbols());
            let agree = (0..20_u32).all(|point| {
                let at = |n: usize| {
                    ratio(i64::try_from(n).expect("few") * 7 - 3, 5) + Q::from_integer(point.into())
                };
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
