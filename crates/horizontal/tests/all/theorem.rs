//! Every theorem about horizontal contacts holds, states its subject, and fails for wrong formulas.

mod faults;
mod numbers;

use std::collections::BTreeSet;
use std::sync::LazyLock;

use cannonpile_horizontal::theorem;
use cannonpile_horizontal::theorem::{Formulas, Theorem};
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::Attempts;

/// The proofs of all theorems with each mutant of a formula, computed once for all tests.
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
fn names_are_unique() {
    proofs::have_unique_names(&theorems());
}

/// A phrase that each statement must contain.
const SUBJECTS: [(&str, &str); 13] = [
    (
        "horizontal-balance",
        "in equilibrium with these horizontal forces",
    ),
    ("virtual-work", "Σ f_l D_l + Σ X c = Σ w φ_l"),
    ("elastic-straight", "The elastic state of the paper's pile"),
    ("elastic-energy", "L(L−1)(L+1)(L+2)(2L+1)/40"),
    ("settlement", "layers stay plane"),
    ("elastic-monotone", "c ≤ 0 without horizontal forces"),
    ("no-dip", "No dip"),
    (
        "corner-least",
        "The smallest normal force at a corner is (L+2)/3",
    ),
    (
        "corner-greatest",
        "The largest normal force at a corner is (L − 2/3)",
    ),
    ("arch", "An arch unloads a sphere"),
    ("inner-greatest", "ΣC(n_l+2, 3)/3"),
    (
        "edge-greatest",
        "2(j+1)(k−1) + 1 for k > j, and 2k² for k = j",
    ),
    ("run-horizontal", "no run of four steps from the top"),
];

#[test]
fn statements_name_their_subject_and_method() {
    proofs::name_subject_and_method(&theorems(), &SUBJECTS);
}

/// Each mutant is rejected by the theorems that it is listed for, and by no others.
#[test]
fn faults_are_refused() {
    ATTEMPTS.fail_as_listed();
}

#[test]
fn every_theorem_refuses_a_fault() {
    ATTEMPTS.every_theorem_has_a_fault();
}

/// The names of the fields. A missing field is a compile error.
macro_rules! fields {
    ($($field:ident)*) => {{
        let Formulas { core: _, $($field: _),* } = Formulas::<cannonpile::scalar::Polynomial>::LIBRARY;
        [$(stringify!($field)),*]
    }};
}

/// The formulas of the core have their own test.
#[test]
fn every_formula_has_a_mutant() {
    let fields = fields! {
        contact_drop compression elastic_field corner_field least_on_corner greatest_on_corner greatest_inside greatest_on_edge arch
    };
    let wrong: BTreeSet<_> = faults::own().iter().map(|fault| fault.field).collect();
    assert_eq!(wrong, BTreeSet::from(fields));
}

/// Every step of a proof is needed: some mutant breaks it.
#[test]
fn every_step_refuses_a_fault() {
    ATTEMPTS.every_step_has_a_fault();
}

/// A refuted proof is printed as refuted.
#[test]
fn a_refuted_proof_is_listed_as_such() {
    ATTEMPTS.report_failures();
}

/// The number of steps of each proof.
const STEPS: [(&str, usize); 13] = [
    ("horizontal-balance", 15),
    ("virtual-work", 11),
    ("elastic-straight", 10),
    ("elastic-energy", 2),
    ("settlement", 5),
    ("elastic-monotone", 60),
    ("no-dip", 24),
    ("corner-least", 27),
    ("corner-greatest", 64),
    ("arch", 30),
    ("inner-greatest", 2),
    ("edge-greatest", 3),
    ("run-horizontal", 18),
];

/// The number of steps matches the number of cases.
#[test]
fn every_case_has_a_step() {
    proofs::have_steps(&theorems(), &STEPS);
}
