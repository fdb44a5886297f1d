//! Tests of the theorems: each holds for the formulas of this crate, names its subject, and rejects wrong formulas.

mod faults;

use std::collections::BTreeSet;
use std::sync::LazyLock;

use cannonpile_disorder::theorem;
use cannonpile_disorder::theorem::{Formulas, Theorem};
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::Attempts;

/// Every theorem with the result of its proof for each fault, computed once for all tests.
static ATTEMPTS: LazyLock<Attempts<Formulas>> =
    LazyLock::new(|| Attempts::new(theorem::all(), faults::all()));

fn theorems() -> Vec<&'static Theorem> {
    theorem::all().collect()
}

#[test]
fn every_theorem_holds() {
    proofs::hold(&theorems());
}

#[test]
fn names_are_unique_and_found() {
    proofs::have_unique_names(&theorems());
    for name in theorems().iter().map(|theorem| theorem.name) {
        assert_eq!(theorem::find(name).map(|found| found.name), Some(name));
        assert!(theorem::find(&name.to_uppercase()).is_none());
    }
    assert!(theorem::find("").is_none());
}

/// The text that each statement must contain.
const SUBJECTS: [(&str, &str); 10] = [
    (
        "resultant-form",
        "has the resultant of g along its own directions",
    ),
    ("squares", "Σf² = Σg² + 2nΣg + 3n²"),
    ("third-moment", "Σv r³cos3φ"),
    ("fourth-moment", "Σv r⁴"),
    ("mean-modes", "(M−1)(M−μ) = 0"),
    ("mean-spectrum", "λ³Q(λ+μ/λ)"),
    ("wave", "HCP is a wave"),
    ("faults", "(5/3)^d"),
    ("one-fault", "six loads 2/9 at m u_a − n u_b"),
    ("registry", "from the registry r to r+1"),
];

#[test]
fn statements_name_their_subject_and_method() {
    proofs::name_subject_and_method(&theorems(), &SUBJECTS);
}

/// Each fault is rejected by exactly the listed theorems.
#[test]
fn faults_are_rejected() {
    ATTEMPTS.fail_as_listed();
}

#[test]
fn every_theorem_rejects_a_fault() {
    ATTEMPTS.every_theorem_has_a_fault();
}

/// Lists the fields by name. A missing field is a compile error.
macro_rules! fields {
    ($($field:ident)*) => {{
        let Formulas { core: _, $($field: _),* } = Formulas::<cannonpile::scalar::Polynomial>::LIBRARY;
        [$(stringify!($field)),*]
    }};
}

/// The formulas of the core have their own test.
#[test]
fn every_formula_has_a_fault() {
    let fields = fields! {
        third_moment fourth_moment fourth_moment_of_pair mean_third_moment mean_fourth_moment_of_pairs wave registry_excess
    };
    let wrong: BTreeSet<_> = faults::own().iter().map(|fault| fault.field).collect();
    assert_eq!(wrong, BTreeSet::from(fields));
}

/// Each step of each proof is broken by some fault.
#[test]
fn every_step_rejects_a_fault() {
    ATTEMPTS.every_step_has_a_fault();
}

/// The printed proof reports its failure.
#[test]
fn refuted_proofs_are_reported() {
    ATTEMPTS.report_failures();
}

/// The number of steps of each proof, counted by cases.
const STEPS: [(&str, usize); 10] = [
    ("resultant-form", 6),
    ("squares", 5),
    ("third-moment", 18),
    ("fourth-moment", 16),
    ("mean-modes", 12),
    ("mean-spectrum", 3),
    ("wave", 3),
    ("faults", 20),
    ("one-fault", 24),
    ("registry", 6),
];

/// The number of steps equals the number of cases.
#[test]
fn proofs_cover_all_cases() {
    proofs::have_steps(&theorems(), &STEPS);
}

#[test]
fn sides_agree_at_every_point() {
    proofs::sides_agree_at_every_point(&theorems());
}
