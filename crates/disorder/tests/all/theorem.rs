//! Every theorem on random stackings holds of the crate's formulas, says what it is about, and refuses wrong formulas.

mod faults;

use std::collections::BTreeSet;
use std::sync::LazyLock;

use cannonpile_disorder::theorem;
use cannonpile_disorder::theorem::{Formulas, Theorem};
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::Attempts;

/// Every theorem with what becomes of its proof, for each fault: for all tests once.
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

/// What each statement must name.
const SUBJECTS: [(&str, &str); 10] = [
    ("resultant-form", "do without the signs"),
    ("squares", "Σf² = Σg² + 2nΣg + 3n²"),
    ("third-moment", "Σv r³cos3φ"),
    ("fourth-moment", "Σv r⁴"),
    ("mean-modes", "(M−1)(M−μ) = 0"),
    ("mean-spectrum", "λ³Q(λ+μ/λ)"),
    ("wave", "HCP is a wave"),
    ("faults", "(5/3)^d"),
    ("one-fault", "six loads 2/9"),
    ("registry", "from the registry r to r+1"),
];

#[test]
fn statements_name_their_subject_and_method() {
    proofs::name_subject_and_method(&theorems(), &SUBJECTS);
}

/// A fault is refused by the theorems it is said to break, and by no others.
#[test]
fn faults_are_refused() {
    ATTEMPTS.fail_as_listed();
}

#[test]
fn every_theorem_refuses_a_fault() {
    ATTEMPTS.every_theorem_has_a_fault();
}

/// Fields by name; one that is missing does not compile.
macro_rules! fields {
    ($($field:ident)*) => {{
        let Formulas { core: _, $($field: _),* } = Formulas::<cannonpile::scalar::Polynomial>::LIBRARY;
        [$(stringify!($field)),*]
    }};
}

/// The formulas of the core have their own test.
#[test]
fn every_formula_is_put_wrong() {
    let fields = fields! {
        third_moment fourth_moment fourth_moment_of_pair mean_third_moment mean_fourth_moment_of_pairs wave registry_excess
    };
    let wrong: BTreeSet<_> = faults::own().iter().map(|fault| fault.field).collect();
    assert_eq!(wrong, BTreeSet::from(fields));
}

/// No step is idle: each is broken by some fault.
#[test]
fn every_step_refuses_a_fault() {
    ATTEMPTS.every_step_has_a_fault();
}

/// The printed proof says that it fails, where it does.
#[test]
fn a_refuted_proof_is_listed_as_such() {
    ATTEMPTS.report_failures();
}

/// How many steps each proof has, counted by cases.
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

/// As many steps as there are cases: none is passed over.
#[test]
fn no_case_is_left_out() {
    proofs::have_steps(&theorems(), &STEPS);
}

#[test]
fn sides_agree_at_every_point() {
    proofs::sides_agree_at_every_point(&theorems());
}
