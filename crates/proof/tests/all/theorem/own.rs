//! The theorems of this crate: each holds, names its subject, and rejects wrong formulas of the core.

use std::sync::LazyLock;

use cannonpile::theorem::{Formulas, Theorem};
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::Attempts;

/// Every theorem with the result of its proof for each fault. All tests share it.
static ATTEMPTS: LazyLock<Attempts<Formulas>> =
    LazyLock::new(|| Attempts::new(cannonpile_proof::own(), proofs::of_the_core()));

fn theorems() -> Vec<&'static Theorem> {
    cannonpile_proof::own().collect()
}

#[test]
fn every_theorem_holds() {
    proofs::hold(&theorems());
}

/// The subject that each statement must name.
const SUBJECTS: [(&str, &str); 14] = [
    ("discs", "pile of discs"),
    ("dimensions", "d = 2 … 6 dimensions"),
    ("region-counts", "Any base under straight steps"),
    ("run", "carries f + m w after m spheres more"),
    ("tripled-half-turn", "are 3Gg"),
    ("change-of-sign", "Equilibrium at a sign change"),
    ("edge", "no run of five steps or more"),
    ("point-load", "Σv r² = n²ρ²"),
    ("load", "A load of any direction"),
    ("tilt", "Gravity that leans"),
    (
        "tilt-total",
        "Total force and moment under gravity that leans",
    ),
    ("rough-contact", "A contact on a rough floor"),
    ("rough-floor", "Two layers on a rough floor"),
    ("rough-unique", "Uniqueness on a rough floor"),
];

#[test]
fn statements_name_their_subject_and_method() {
    proofs::name_subject_and_method(&theorems(), &SUBJECTS);
}

/// Each fault refutes exactly the theorems that it lists.
#[test]
fn faults_refute_the_listed_theorems() {
    ATTEMPTS.fail_as_listed();
}

#[test]
fn every_theorem_has_a_fault() {
    ATTEMPTS.every_theorem_has_a_fault();
}

/// Some fault breaks each step, so no step is redundant.
#[test]
fn every_step_has_a_fault() {
    ATTEMPTS.every_step_has_a_fault();
}

/// The printed proof reports its failure.
#[test]
fn a_printed_proof_reports_its_failure() {
    ATTEMPTS.report_failures();
}

/// The number of steps of each proof, counted by cases. The theorem `dimensions` has 2d + 4 for each d from 2 to 6.
const STEPS: [(&str, usize); 14] = [
    ("discs", 8),
    ("dimensions", 60),
    ("region-counts", 72),
    ("run", 12),
    ("tripled-half-turn", 6),
    ("change-of-sign", 6),
    ("edge", 24),
    ("point-load", 29),
    ("load", 36),
    ("tilt", 19),
    ("tilt-total", 6),
    ("rough-contact", 35),
    ("rough-floor", 48),
    ("rough-unique", 5),
];

/// The numbers of steps equal the numbers of cases, so none is missing.
#[test]
fn no_case_is_missing() {
    proofs::have_steps(&theorems(), &STEPS);
    // Without a sign change there is no half-turn.
    let proof = cannonpile_proof::find("point-load").map(|theorem| theorem.prove());
    let claims = proof.into_iter().flat_map(|proof| proof.steps);
    let claims = claims.map(|step| step.claim);
    let squares = claims.filter(|claim| claim.ends_with("Σv² stays"));
    let signs = squares.map(|claim| claim.replace(": Σv² stays", ""));
    assert!(signs.eq(["+ above, − below", "− above, + below"]));
}
