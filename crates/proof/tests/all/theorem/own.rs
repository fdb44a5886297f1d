//! The theorems of this crate: each holds, names its subject, and rejects wrong formulas.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use cannonpile::theorem::Theorem;
use cannonpile_proof::Formulas;
use cannonpile_testkit::proofs;
use cannonpile_testkit::proofs::Attempts;

use super::faults;

/// Every theorem with the result of its proof for each fault. All tests share it.
static ATTEMPTS: LazyLock<Attempts<Formulas>> =
    LazyLock::new(|| Attempts::new(cannonpile_proof::own(), faults::all()));

fn theorems() -> Vec<&'static Theorem<Formulas>> {
    cannonpile_proof::own().collect()
}

#[test]
fn every_theorem_holds() {
    proofs::hold(&theorems());
}

/// The subject that each statement must name.
const SUBJECTS: [(&str, &str); 43] = [
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
    ("primary-closure", "σ_xx + σ_yy = tan²θ σ_zz"),
    ("secondary-closure", "2σ_xy = τ tanθ σ_yz"),
    ("mean-closure", "The closure of random stackings"),
    ("isometry", "S is an isometry"),
    ("inverse", "I − S is unipotent"),
    ("singular-values", "2 cos(jπ/(2m+1))"),
    ("rough-contact", "A contact on a rough floor"),
    ("rough-floor", "Two layers on a rough floor"),
    ("rough-unique", "Uniqueness on a rough floor"),
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

/// Each fault refutes exactly the theorems that it lists.
#[test]
fn faults_refute_the_listed_theorems() {
    ATTEMPTS.fail_as_listed();
}

#[test]
fn every_theorem_has_a_fault() {
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
fn every_formula_has_a_fault() {
    let fields = fields! {
        contact_drop compression elastic_field corner_field least_on_corner greatest_on_corner greatest_inside
        greatest_on_edge arch third_moment fourth_moment fourth_moment_of_pair mean_third_moment
        mean_fourth_moment_of_pairs wave registry_excess
    };
    let wrong: BTreeSet<_> = faults::own().iter().map(|fault| fault.field).collect();
    assert_eq!(wrong, BTreeSet::from(fields));
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
const STEPS: [(&str, usize); 43] = [
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
    ("primary-closure", 4),
    ("secondary-closure", 8),
    ("mean-closure", 8),
    ("isometry", 7),
    ("inverse", 6),
    ("singular-values", 2),
    ("rough-contact", 35),
    ("rough-floor", 48),
    ("rough-unique", 5),
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
