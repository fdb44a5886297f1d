//! Every theorem on horizontal contacts holds of the crate's formulas, says what it is about, and refuses wrong formulas.

mod faults;
mod numbers;

use std::collections::BTreeSet;
use std::sync::LazyLock;

use cannonpile_horizontal::theorem;
use cannonpile_horizontal::theorem::{Formulas, Theorem};
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
fn names_are_unique() {
    proofs::have_names(&theorems());
}

/// What each statement must name.
const SUBJECTS: [(&str, &str); 13] = [
    ("horizontal-balance", "in equilibrium with these pushes"),
    ("virtual-work", "Σ f_l D_l + Σ X c = Σ w φ_l"),
    ("elastic-straight", "The elastic state of the paper's pile"),
    ("elastic-energy", "L(L−1)(L+1)(L+2)(2L+1)/40"),
    ("settlement", "layers stay plane"),
    ("elastic-monotone", "c ≤ 0 without horizontal forces"),
    ("no-dip", "No dip"),
    ("corner-least", "The least on a corner, (L+2)/3"),
    ("corner-greatest", "The greatest on a corner, (L − 2/3)"),
    ("arch", "The arch that empties a sphere"),
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

/// A fault is refused by the theorems it is said to break, and by no others.
#[test]
fn faults_are_refused() {
    ATTEMPTS.are_refused_as_said();
}

#[test]
fn every_theorem_refuses_a_fault() {
    ATTEMPTS.every_theorem_refuses_one();
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
        lowered compression elastic_field corner_field least_on_corner greatest_on_corner greatest_inside greatest_on_edge arch
    };
    let wrong: BTreeSet<_> = faults::own().iter().map(|fault| fault.field).collect();
    assert_eq!(wrong, BTreeSet::from(fields));
}

/// No step is idle: each is broken by some fault.
#[test]
fn every_step_refuses_a_fault() {
    ATTEMPTS.every_step_refuses_one();
}

/// The printed proof says that it fails, where it does.
#[test]
fn a_refuted_proof_is_listed_as_such() {
    ATTEMPTS.are_listed_as_refuted();
}

/// How many steps each proof has, counted by cases.
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

/// As many steps as there are cases: none is passed over.
#[test]
fn no_case_is_left_out() {
    proofs::have_steps(&theorems(), &STEPS);
}
