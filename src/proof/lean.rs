//! The files for Lean.

use super::language::{Carrier, Language};
use super::recorded::{over_integers, over_rationals};
use super::{Assistant, ProofFile};
use crate::Error;
use crate::scalar::Expression;
use crate::theorem::Formulas;

/// Returns all files, in the order in which they are to be checked.
pub(super) fn files(formulas: &Formulas<Expression>) -> Result<Vec<ProofFile>, Error> {
    let mut text = String::from(include_str!("../../proofs/lean/Directions.lean"));
    let [rationals, integers] = [Carrier::Rationals, Carrier::Integers].map(|carrier| Language {
        assistant: Assistant::Lean,
        carrier,
    });
    for definition in over_rationals(formulas) {
        text.push('\n');
        text += &rationals.definition(&definition)?;
    }
    text +=
        "\n/-! The same over integers, as the engines run them where no fraction is needed. -/\n";
    text += "namespace Integers\n";
    for definition in over_integers(formulas) {
        text.push('\n');
        text += &integers.definition(&definition)?;
    }
    text += "\nend Integers\n\n";
    text += include_str!("../../proofs/lean/Identities.lean");
    Ok(vec![ProofFile::new("Cannonpile.lean", text)])
}
