//! Checks of the theorems of a crate: they hold, they reject wrong formulas, and no step is redundant.
//!
//! | file | contents |
//! |---|---|
//! | `faults` | wrong formulas of the core, each with the theorems of all crates that it refutes |
//! | `attempts` | the theorems of a crate, applied to wrong formulas |
//! | `numbers` | both sides of a step, evaluated |

mod attempts;
mod faults;
mod numbers;

pub use attempts::Attempts;
pub use faults::{Fault, of_the_core, over, sum, swapped, twice};
pub use numbers::{evaluated, sides_agree_at_every_point, value};

use cannonpile::theorem::{Library, ProofKind, Theorem};

/// Panics unless each of these theorems holds.
pub fn hold<F: Library>(theorems: &[&Theorem<F>]) {
    for theorem in theorems {
        let proof = theorem.prove();
        for step in &proof.steps {
            assert!(step.holds(), "{}: {step:?}", theorem.name);
        }
        assert!(proof.holds(), "{} has no steps", theorem.name);
    }
}

/// Panics unless each statement names its method and its subject. `subjects` lists the subject of each theorem by name.
pub fn name_subject_and_method<F>(theorems: &[&Theorem<F>], subjects: &[(&str, &str)]) {
    assert_eq!(theorems.len(), subjects.len());
    for theorem in theorems {
        let named = subjects.iter().find(|(name, _)| *name == theorem.name);
        let (_, subject) = named.unwrap_or_else(|| panic!("no subject for {}", theorem.name));
        assert!(theorem.statement.contains(subject), "{}", theorem.name);
        let words: &[_] = match theorem.method {
            ProofKind::Identity => &["an identity"],
            ProofKind::Sum => &["by summing"],
            ProofKind::Induction => &["by induction"],
            other => panic!("no words for {other:?}"),
        };
        assert!(
            words.iter().any(|word| theorem.statement.contains(word)),
            "{}",
            theorem.name
        );
        assert!(!theorem.hypotheses.is_empty() && !theorem.symbols.is_empty());
    }
}

/// Panics unless the theorems have the listed numbers of steps. This shows that no case is missing.
pub fn have_steps<F: Library>(theorems: &[&Theorem<F>], expected: &[(&str, usize)]) {
    let steps = theorems.iter();
    let steps = steps.map(|theorem| (theorem.name, theorem.prove().steps.len()));
    let steps: Vec<_> = steps.collect();
    assert_eq!(steps, expected);
}
