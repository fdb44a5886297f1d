//! The files for Coq.

use super::language::{Carrier, Language};
use super::recorded::{over_integers, over_rationals};
use super::{Assistant, Checked, ProofFile, checked};
use crate::Error;
use crate::scalar::Expression;
use crate::theorem::Formulas;

/// What is written by hand, in the order in which it is to be checked; the formulas come after the first.
const BY_HAND: &[(&str, &str)] = &[
    (
        "Directions.v",
        include_str!("../../proofs/coq/Directions.v"),
    ),
    ("Sums.v", include_str!("../../proofs/coq/Sums.v")),
    ("Balance.v", include_str!("../../proofs/coq/Balance.v")),
    ("Straight.v", include_str!("../../proofs/coq/Straight.v")),
    ("Floor.v", include_str!("../../proofs/coq/Floor.v")),
    ("Counts.v", include_str!("../../proofs/coq/Counts.v")),
    ("Stackings.v", include_str!("../../proofs/coq/Stackings.v")),
    ("Census.v", include_str!("../../proofs/coq/Census.v")),
    ("Regions.v", include_str!("../../proofs/coq/Regions.v")),
    (
        "Horizontal.v",
        include_str!("../../proofs/coq/Horizontal.v"),
    ),
    ("Virtual.v", include_str!("../../proofs/coq/Virtual.v")),
    ("Bounds.v", include_str!("../../proofs/coq/Bounds.v")),
    ("Response.v", include_str!("../../proofs/coq/Response.v")),
    ("Mean.v", include_str!("../../proofs/coq/Mean.v")),
    ("Spectrum.v", include_str!("../../proofs/coq/Spectrum.v")),
];

/// Returns all files, in the order in which they are to be checked.
pub(super) fn files(formulas: &Formulas<Expression>) -> Result<Vec<ProofFile>, Error> {
    let mut files: Vec<ProofFile> = BY_HAND
        .iter()
        .map(|(name, text)| ProofFile::new(name, *text))
        .collect();
    files.insert(1, ProofFile::new("Formulas.v", definitions(formulas)?));
    files.push(ProofFile::new("Listed.v", by_name(&files)));
    let mut project = String::from("-Q . Cannonpile\n");
    for file in &files {
        project += file.name();
        project.push('\n');
    }
    files.push(ProofFile::new("_CoqProject", project));
    Ok(files)
}

fn definitions(formulas: &Formulas<Expression>) -> Result<String, Error> {
    let mut text = String::from(
        "(** The formulas of cannonpile as they run.

    Each function of the library was run on symbols, and what it did to them is written down here, in its order and
    unsimplified; x / n is x * (1 # n). Written by `cannonpile prove --to coq`: not to be changed by hand. *)

From Coq Require Import ZArith QArith.
From Cannonpile Require Import Directions.

Open Scope Q_scope.
",
    );
    let [rationals, integers] = [Carrier::Rationals, Carrier::Integers].map(|carrier| Language {
        assistant: Assistant::Coq,
        carrier,
    });
    for definition in over_rationals(formulas) {
        text.push('\n');
        text += &rationals.definition(&definition)?;
    }
    text +=
        "\n(** The same over integers, as the engines run them where no fraction is needed. *)\n";
    text += "Module Integers.\nOpen Scope Z_scope.\n";
    for definition in over_integers(formulas) {
        text.push('\n');
        text += &integers.definition(&definition)?;
    }
    text += "\nEnd Integers.\n";
    Ok(text)
}

/// The theorems by the names under which they are listed; each is stated again as it is checked.
fn by_name(files: &[ProofFile]) -> String {
    let mut text = String::from(
        "(** The theorems that `cannonpile prove` lists, with what proves them here. Written by it. *)\n\n",
    );
    text += "From Coq Require Import ZArith QArith.\nFrom Cannonpile Require";
    let modules = files
        .iter()
        .filter_map(|file| file.name().strip_suffix(".v"));
    for module in modules {
        text.extend([" ", module]);
    }
    text += ".\n\nOpen Scope Q_scope.\n";
    for Checked { theorem, coq, .. } in checked() {
        text.extend(["\n(** ", theorem.name, " *)\n"]);
        if coq.is_empty() {
            text += "(* not in Coq yet *)\n";
        }
        for name in coq {
            text.extend(["Check ", name, ".\n"]);
        }
    }
    text
}
