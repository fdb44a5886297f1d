//! The files for Coq.

use std::collections::BTreeSet;

use cannonpile_proof::{Expression, Formulas, ProofFile};

fn files() -> Vec<ProofFile> {
    cannonpile_proof::files().expect("files")
}

/// Returns the theorems of a file, as `File.name`. Lemmas are left out.
fn stated(file: &ProofFile) -> impl Iterator<Item = String> {
    let module = file.name().strip_suffix(".v").unwrap_or_default();
    let lines = file.text().lines();
    lines.filter_map(move |line| {
        let name = line.strip_prefix("Theorem ")?.split([' ', ':']).next()?;
        Some(format!("{module}.{name}"))
    })
}

#[test]
fn listed_theorems_are_stated() {
    let files = files();
    let stated: BTreeSet<_> = files.iter().flat_map(stated).collect();
    assert!(stated.len() > 100, "{}", stated.len());
    for theorem in cannonpile_proof::all() {
        for name in theorem.coq {
            assert!(stated.contains(*name), "{}: {name}", theorem.name);
        }
    }
    // The theorems about the paper's pile and about runs are proved in Coq.
    let in_coq = cannonpile_proof::all().filter(|theorem| !theorem.coq.is_empty());
    assert!(in_coq.count() >= 50);
}

#[test]
fn no_file_contains_axioms() {
    for file in files() {
        for word in ["Admitted", "admit", "Axiom", "Parameter", "Conjecture"] {
            let mut words = file.text().split(|c: char| !c.is_alphanumeric());
            assert!(words.all(|found| found != word), "{}: {word}", file.name());
        }
    }
}

/// Every formula is exported, and a changed formula changes the export.
#[test]
fn formulas_are_exported_as_executed() {
    let written = |formulas: &Formulas<_>| {
        let files = cannonpile_proof::files_of(formulas).expect("files");
        let file = files.into_iter().find(|file| file.name() == "Formulas.v");
        file.expect("formulas").text().to_owned()
    };
    let text = written(&Formulas::LIBRARY);
    for line in [
        "Definition transmitted (received : Q) (own : Q) : Q :=\n  received + own.",
        "Definition increments (s : Q) : three Q :=\n  Three 1 1 (s + s).",
        "  | Plus, Gamma => (0, 1)%Z\n",
        "  | Minus => received + own - (- pushed)\n",
        "Module Integers.\nOpen Scope Z_scope.\n",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    // The definitions include all formulas of the theorems.
    let debug = format!("{:?}", Formulas::<Expression>::LIBRARY);
    let names = debug
        .split(": 0x")
        .filter_map(|before| before.rsplit([' ', '{']).next());
    let mut all = BTreeSet::new();
    for name in names.filter(|name| !name.is_empty() && !name.ends_with('}')) {
        let defined = [
            format!("Definition {name} "),
            format!("Definition {name}_2 "),
        ];
        assert!(defined.iter().any(|begin| text.contains(begin)), "{name}");
        all.insert(name);
    }
    assert!(all.len() >= 40, "{all:?}");
    let mut wrong = Formulas::LIBRARY;
    wrong.core.transmitted = |received, own| received - own;
    assert_ne!(written(&wrong), text);
}

#[test]
fn theorems_are_listed_with_proofs() {
    let named = |name| {
        let found = cannonpile_proof::find(name);
        found.expect("a theorem").coq
    };
    assert_eq!(named("counts"), ["Straight.counts"]);
    assert_eq!(named("rotation"), ["Straight.rotation"]);
    let faults = [
        "Response.fault",
        "Response.load_is_kept",
        "Response.few_faults",
    ];
    assert_eq!(named("faults"), faults);
}

/// `Listed.v` checks the names of the list in order, and no others.
#[test]
fn every_listed_proof_is_checked() {
    let files = files();
    let mut checked: Vec<&str> = Vec::new();
    for line in files.iter().flat_map(|file| file.text().lines()) {
        checked.extend(
            line.strip_prefix("Check ")
                .and_then(|line| line.strip_suffix('.')),
        );
    }
    let listed: Vec<&str> = cannonpile_proof::all()
        .flat_map(|theorem| theorem.coq.iter().copied())
        .collect();
    assert!(listed.len() > 80);
    assert_eq!(checked, listed);
    let by_name = files.iter().find(|file| file.name() == "Listed.v");
    let by_name = by_name.expect("the file of all theorems").text();
    assert!(
        by_name.contains("\n(** rotation *)\nCheck Straight.rotation.\n"),
        "{by_name}"
    );
}

/// Formulas over integers are exported twice: over rationals, and over integers in the module `Integers`.
#[test]
fn integer_formulas_are_exported() {
    let files = files();
    let formulas = files.iter().find(|file| file.name() == "Formulas.v");
    let (rationals, integers) = formulas
        .and_then(|file| file.text().split_once("Module Integers."))
        .expect("both");
    for line in ["Definition tripled_half_turn ", "Definition above "] {
        assert!(
            rationals.contains(line) && integers.contains(line),
            "{line}"
        );
    }
}
