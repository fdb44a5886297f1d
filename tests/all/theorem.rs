//! Every theorem holds of the crate's formulas, says what it is about, and refuses wrong formulas.

mod faults;
mod numbers;

use std::collections::BTreeSet;
use std::sync::LazyLock;

use self::faults::Fault;
use cannonpile::theorem::{self, Formulas, Listing, Proof, ProofKind, Theorem};

/// Every theorem with what becomes of its proof, for each fault: for all tests once.
static ATTEMPTS: LazyLock<Vec<(Fault, Vec<Attempt>)>> = LazyLock::new(|| {
    let attempts = |fault: Fault| {
        let attempts = theorem::all().map(|theorem| (theorem, theorem.prove_for(&fault.formulas)));
        let attempts = attempts.collect();
        (fault, attempts)
    };
    faults::all().into_iter().map(attempts).collect()
});

type Attempt = (&'static Theorem, Proof);

#[test]
fn every_theorem_holds() {
    assert!(theorem::all().count() >= 16);
    for theorem in theorem::all() {
        let proof = theorem.prove();
        for step in &proof.steps {
            assert!(step.holds(), "{}: {step:?}", theorem.name);
        }
        assert!(proof.holds(), "{} has no steps", theorem.name);
    }
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

/// What each statement must name.
const SUBJECTS: [(&str, &str); 52] = [
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
    ("discs", "pile of discs"),
    ("dimensions", "d = 2 … 6 dimensions"),
    ("region-counts", "Any base under straight steps"),
    ("run", "carries f + m w after m spheres more"),
    ("tripled-half-turn", "are 3Gg"),
    ("change-of-sign", "Equilibrium at a change of sign"),
    ("edge", "no run of five steps or more"),
    ("point-load", "Σv r² = n²ρ²"),
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
    for theorem in theorem::all() {
        let named = SUBJECTS.iter().find(|(name, _)| *name == theorem.name);
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

/// A fault is refused by the theorems it is said to break, which are some, and by no others.
#[test]
fn faults_are_refused() {
    let mut otherwise = Vec::new();
    for (fault, attempts) in ATTEMPTS.iter() {
        let failing: Vec<_> = attempts
            .iter()
            .filter(|(_, proof)| !proof.holds())
            .map(|(theorem, _)| theorem.name)
            .collect();
        if failing.is_empty() || failing != fault.refused_by {
            otherwise.push(format!("{} ({}): {failing:?}", fault.what, fault.field));
        }
    }
    assert!(otherwise.is_empty(), "{}", otherwise.join("\n"));
}

#[test]
fn every_theorem_refuses_a_fault() {
    let faults = faults::all();
    for theorem in theorem::all() {
        let refuses = |fault: &Fault| fault.refused_by.contains(&theorem.name);
        assert!(
            faults.iter().any(refuses),
            "no fault is planted for {}",
            theorem.name
        );
    }
}

/// Fields by name; one that is missing does not compile.
macro_rules! fields {
    ($($field:ident)*) => {{
        let Formulas { $($field: _),* } = Formulas::<cannonpile::scalar::Polynomial>::LIBRARY;
        [$(stringify!($field)),*]
    }};
}

#[test]
fn every_formula_is_put_wrong() {
    let fields = fields! {
        above bounds_above descent spheres spheres_in_layer contacts contacts_of_strength directions
        disc_directions turned_about_z position squared_distance increments weight force passed_on
        resultant handed_on unbalanced half_turn tripled_half_turn tripled_apart
        pushed beside lowered compression elastic_field corner_field least_on_corner
        greatest_on_corner greatest_inside greatest_on_edge arch
        third_moment fourth_moment fourth_moment_of_pair mean_third_moment mean_fourth_moment_of_pairs wave
        registry_excess
    };
    let wrong: BTreeSet<_> = faults::all().iter().map(|fault| fault.field).collect();
    assert_eq!(wrong, BTreeSet::from(fields));
}

/// No step is idle: each is broken by some fault.
#[test]
fn every_step_refuses_a_fault() {
    let (mut refused, mut idle) = (BTreeSet::new(), Vec::new());
    for (theorem, proof) in ATTEMPTS.iter().flat_map(|(_, attempts)| attempts) {
        let failing = proof
            .steps
            .iter()
            .enumerate()
            .filter(|(_, step)| !step.holds());
        refused.extend(failing.map(|(n, _)| (theorem.name, n)));
    }
    for theorem in theorem::all() {
        for (n, step) in theorem.prove().steps.iter().enumerate() {
            if !refused.contains(&(theorem.name, n)) {
                idle.push(format!("{}: {}", theorem.name, step.claim));
            }
        }
    }
    assert!(idle.is_empty(), "{}", idle.join("\n"));
}

/// Of each theorem one, the first in the list: for a quick look.
#[test]
fn the_first_fault_of_each_theorem_is_refused() {
    let faults = faults::all();
    for theorem in theorem::all() {
        let fault = faults
            .iter()
            .find(|fault| fault.refused_by.contains(&theorem.name))
            .expect("a fault");
        let proof = theorem.prove_for(&fault.formulas);
        assert!(!proof.holds(), "{}: {}", theorem.name, fault.what);
        let fails = |step: &theorem::Step| !step.holds();
        assert!(proof.steps.iter().any(fails), "{}", theorem.name);
    }
}

/// The printed proof says that it fails, where it does.
#[test]
fn a_refuted_proof_is_listed_as_such() {
    for (theorem, proof) in ATTEMPTS.iter().flat_map(|(_, attempts)| attempts) {
        let [short, whole] = [false, true].map(|whole| {
            Listing {
                theorem,
                proof,
                whole,
            }
            .to_string()
        });
        for text in [short, whole] {
            let failures = proof.steps.iter().filter(|step| !step.holds()).count();
            let verdicts = text.matches("FAILS").count();
            let expected = failures + usize::from(failures > 0);
            assert_eq!(verdicts, expected, "{text}");
        }
    }
}

/// How many steps each proof has, counted by cases: the theorem `dimensions` has 2d + 4 for each d from 2 to 6.
const STEPS: [(&str, usize); 52] = [
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
    ("discs", 8),
    ("dimensions", 60),
    ("region-counts", 72),
    ("run", 12),
    ("tripled-half-turn", 6),
    ("change-of-sign", 6),
    ("edge", 24),
    ("point-load", 29),
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

/// As many steps as there are cases: none is passed over.
#[test]
fn no_case_is_left_out() {
    let steps: Vec<_> = theorem::all()
        .map(|theorem| (theorem.name, theorem.prove().steps.len()))
        .collect();
    assert_eq!(steps, STEPS);
    // Where the sign is kept, nothing is turned.
    let proof = theorem::find("point-load").map(theorem::Theorem::prove);
    let claims = proof.into_iter().flat_map(|proof| proof.steps);
    let claims = claims.map(|step| step.claim);
    let squares = claims.filter(|claim| claim.ends_with("Σv² stays"));
    let signs = squares.map(|claim| claim.replace(": Σv² stays", ""));
    assert!(signs.eq(["+ above, − below", "− above, + below"]));
}
