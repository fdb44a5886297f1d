//! Stackings: straight, periodic, with one sign change or arbitrary. Also runs of any length, their notations, and damaged
//! texts.

use arbitrary::{Result, Unstructured};
use cannonpile::lattice::{MAX_LAYERS, Sign};
use cannonpile::stacking::{Notation, Run, Stacking};

use super::damaged_by;

/// Runs as a user may list them. Some are empty, neighbours may have the same sign, lengths may be near the maximum, and a
/// rare one is negative.
pub fn runs(u: &mut Unstructured<'_>) -> Result<Vec<Run>> {
    let count = u.int_in_range(0..=6)?;
    let run = |_| {
        Ok(Run {
            sign: u.arbitrary()?,
            steps: length(u)?,
        })
    };
    (0..count).map(run).collect()
}

fn length(u: &mut Unstructured<'_>) -> Result<i128> {
    Ok(match u.int_in_range(0..=7)? {
        0 => 0,
        1..=3 => u.int_in_range(1..=9)?,
        4 => 10_i128.pow(u.int_in_range(0..=36)?),
        5 => MAX_LAYERS - u.int_in_range(0..=3)?,
        6 => u.int_in_range(0..=MAX_LAYERS / 4)? >> u.int_in_range(0..=100)?,
        _ => u.arbitrary::<i128>()?,
    })
}

/// A text that may be a stacking: in one of the notations, damaged, too tall, or arbitrary.
pub fn text(u: &mut Unstructured<'_>) -> Result<String> {
    match u.int_in_range(0..=4)? {
        0 => Ok(u.arbitrary::<&str>()?.to_owned()),
        1 => {
            let written = written(u)?;
            damaged(u, &written)
        }
        2 => {
            let lengths = runs(u)?.into_iter().map(|run| run.steps.to_string());
            Ok(format!("({})", lengths.collect::<Vec<_>>().join(",")))
        }
        _ => written(u),
    }
}

/// The library's text for a short stacking, in any notation, with any letter first.
fn written(u: &mut Unstructured<'_>) -> Result<String> {
    let stacking = Stacking::from_signs(signs(u, 24)?).expect("few steps");
    Ok(match u.int_in_range(0..=4)? {
        0 => stacking.in_notation(Notation::Hagg).to_string(),
        1 => stacking.in_notation(Notation::Abc).to_string(),
        2 => stacking.in_notation(Notation::Jagodzinski).to_string(),
        3 => stacking.in_notation(Notation::Zhdanov).to_string(),
        _ => {
            let turned = stacking.in_notation(Notation::Abc).to_string();
            let turned = turned.bytes().map(|b| b'A' + (b - b'A' + 1) % 3);
            turned.map(char::from).collect()
        }
    })
}

/// Replaces, adds or removes up to three characters of `text`.
fn damaged(u: &mut Unstructured<'_>, text: &str) -> Result<String> {
    // The characters of the four notations, and similar ones.
    const INTRUDERS: [char; 20] = [
        '+', '-', 'A', 'B', 'C', 'c', 'h', '(', ')', ',', '0', '1', '9', 'D', 'H', ' ', '\n', '−',
        '٣', '\0',
    ];
    damaged_by(u, text, &INTRUDERS)
}

/// Draws up to `most` Hägg signs.
pub fn signs(u: &mut Unstructured<'_>, most: usize) -> Result<Vec<Sign>> {
    let steps = u.int_in_range(0..=most)?;
    signs_of(u, steps)
}

/// Draws exactly `steps` Hägg signs: all equal, of period 2 or 4, with at most one sign change, or independent.
pub fn signs_of(u: &mut Unstructured<'_>, steps: usize) -> Result<Vec<Sign>> {
    let first: Sign = u.arbitrary()?;
    let signed = |plus: bool| if plus { first } else { -first };
    Ok(match u.int_in_range(0..=4)? {
        0 => vec![first; steps],
        1 => (0..steps).map(|n| signed(n % 2 == 0)).collect(),
        2 => (0..steps).map(|n| signed(n / 2 % 2 == 0)).collect(),
        3 => {
            let change = u.int_in_range(0..=steps)?;
            (0..steps).map(|n| signed(n < change)).collect()
        }
        _ => (0..steps).map(|_| u.arbitrary()).collect::<Result<_>>()?,
    })
}
