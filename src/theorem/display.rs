//! Printing of theorems and proofs.

use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use super::{Proof, Relation, Step, Theorem};

/// The greatest width of a line of a statement, in columns.
const WIDTH: usize = 100;

/// A theorem with its proof: the statement, and the two sides of every step with their difference.
///
/// # Examples
/// ```
/// use cannonpile::theorem;
/// use cannonpile::theorem::Listing;
///
/// let theorem = theorem::find("total-shear").unwrap();
/// let text = Listing { theorem, proof: &theorem.prove(), whole: false }.to_string();
/// assert!(text.starts_with("total-shear: holds (sum)\n"));
/// assert!(text.ends_with("    ΣF_y = 0:  0 = 0,  difference 0\n"));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Listing<'a, F: 'static = super::Formulas> {
    /// The theorem.
    pub theorem: &'a Theorem<F>,
    /// Its proof.
    pub proof: &'a Proof,
    /// True for the whole derivation: hypotheses, symbols, and each side on its own line.
    pub whole: bool,
}

impl<F> fmt::Display for Listing<'_, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let theorem = self.theorem;
        let (name, method) = (theorem.name, theorem.method.name());
        let verdict = if self.proof.holds() { "holds" } else { "FAILS" };
        writeln!(f, "{name}: {verdict} ({method})")?;
        write_wrapped(f, theorem.statement)?;
        if self.whole {
            writeln!(f, "  for      {}", theorem.hypotheses)?;
            writeln!(f, "  symbols  {}", theorem.symbols)?;
        }
        for step in &self.proof.steps {
            if self.whole {
                write_step(f, step)?;
            } else {
                write_line(f, step)?;
            }
        }
        Ok(())
    }
}

/// Writes `claim:  left = right,  difference 0`.
fn write_line(f: &mut fmt::Formatter<'_>, step: &Step) -> fmt::Result {
    let (sign, failure) = (
        sign(step.relation),
        if step.holds() { "" } else { "  FAILS" },
    );
    let Step {
        claim, left, right, ..
    } = step;
    writeln!(
        f,
        "    {claim}:  {left} {sign} {right},  difference {}{failure}",
        step.difference()
    )
}

/// Writes a step on four lines.
fn write_step(f: &mut fmt::Formatter<'_>, step: &Step) -> fmt::Result {
    let verdict = match (step.holds(), step.relation) {
        (true, Relation::Equal) => "the zero polynomial: holds for all values",
        (true, Relation::Different) => "not the zero polynomial, as claimed",
        (false, _) => "FAILS",
    };
    writeln!(f, "\n    {}", step.claim)?;
    writeln!(f, "      left        {}", step.left)?;
    writeln!(f, "      right       {}", step.right)?;
    writeln!(f, "      difference  {}  ({verdict})", step.difference())
}

fn sign(relation: Relation) -> char {
    match relation {
        Relation::Equal => '=',
        Relation::Different => '≠',
    }
}

/// Writes a paragraph, indented and broken at spaces.
fn write_wrapped(f: &mut fmt::Formatter<'_>, text: &str) -> fmt::Result {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= WIDTH - 2 => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.into()),
        }
    }
    lines
        .into_iter()
        .try_for_each(|line| writeln!(f, "  {line}"))
}
