//! Every theorem holds for the crate's formulas, states its subject, and rejects wrong formulas.

mod numbers;

use std::collections::BTreeSet;
use std::sync::LazyLock;

use cannonpile::theorem;
use cannonpile::theorem::{Formulas, Theorem};
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::Attempts;

/// Every theorem with the result of its proof for each fault. All tests share it.
static ATTEMPTS: LazyLock<Attempts<Formulas>> =
    LazyLock::new(|| Attempts::new(theorem::all(), proofs::of_the_core()));

fn theorems() -> Vec<&'static Theorem> {
    theorem::all().collect()
}

#[test]
fn every_theorem_holds() {
    proofs::hold(&theorems());
}

#[test]
fn names_are_unique_and_found() {
    let names: BTreeSet<_> = theorem::all().map(|theorem| theorem.name).collect();
    assert_eq!(names.len(), theorem::all().count());
    for name in names {
        assert_eq!(theorem::find(name).map(|found| found.name), Some(name));
        assert!(theorem::find(&name.to_uppercase()).is_none());
    }
    assert!(theorem::find("").is_none());
}

/// The subject that each statement must name.
const SUBJECTS: [(&str, &str); 21] = [
    ("counts", "(N_α, N_β, N_γ) = (k−i−j, i, j)"),
    ("rotation", "rotation"),
    ("spheres", "L(L+1)(L+2)/6 spheres"),
    ("contacts", "L(L−1)(L+1)/2 contacts"),
    ("strengths", "carry n·f₀"),
    ("paper-system", "the paper's system"),
    ("unit-directions", "length 1"),
    ("equilibrium", "Equilibrium of every sphere"),
    ("surface", "at the surface"),
    ("action-reaction", "Action and reaction"),
    ("central-force", "Central force"),
    ("half-turn", "its own inverse"),
    ("base-normal", "normal force on the floor"),
    ("uniform-base", "Uniform base"),
    ("weight", "Total weight"),
    ("shear", "shear on the floor"),
    ("total-shear", "Total shear"),
    ("total-moment", "Total moment"),
    ("second-moment", "Second moment"),
    ("shear-on-axis", "vanishes on the axis"),
    ("shear-ratio", "Largest shear/normal ratio"),
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

/// The names of fields. A missing field does not compile.
macro_rules! fields {
    ($($field:ident)*) => {{
        let Formulas { $($field: _),* } = Formulas::<cannonpile::scalar::Polynomial>::LIBRARY;
        [$(stringify!($field)),*]
    }};
}

#[test]
fn every_formula_has_a_fault() {
    let fields = fields! {
        above bounds_above descent spheres spheres_in_layer contacts contacts_of_strength directions
        disc_directions turned_about_z position squared_distance increments load_increments disc_load_increments weight force transmitted
        resultant support_load unbalanced half_turn tripled_half_turn tripled_apart pushed beside
    };
    ATTEMPTS.are_faults_of(&fields);
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

/// The number of steps of each proof, counted by cases.
const STEPS: [(&str, usize); 21] = [
    ("counts", 15),
    ("rotation", 3),
    ("spheres", 3),
    ("contacts", 6),
    ("strengths", 6),
    ("paper-system", 8),
    ("unit-directions", 4),
    ("equilibrium", 12),
    ("surface", 3),
    ("action-reaction", 3),
    ("central-force", 6),
    ("half-turn", 11),
    ("base-normal", 2),
    ("uniform-base", 4),
    ("weight", 1),
    ("shear", 2),
    ("total-shear", 2),
    ("total-moment", 3),
    ("second-moment", 1),
    ("shear-on-axis", 10),
    ("shear-ratio", 5),
];

/// The numbers of steps equal the numbers of cases, so none is missing.
#[test]
fn no_case_is_missing() {
    proofs::have_steps(&theorems(), &STEPS);
}
