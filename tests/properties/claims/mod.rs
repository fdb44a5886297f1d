//! What is true for every input, as functions from bytes.
//!
//! A claim draws its input from an [`Unstructured`] by way of [`generators`](crate::generators), asks the
//! library, and judges the answer by a theorem. The property tests and the fuzz targets run the same ones.
//!
//! The judging is done by small functions of their own, whose planted faults stand at the foot of each file:
//! answers that are wrong by as little as can be, and must be caught.
//!
//! | file | the claim |
//! |---|---|
//! | `sites` | a pile has its sites and no others |
//! | `bases` | discs and isosceles bases, with weights and loads, bear what elimination says |
//! | `scalars` | intervals and narrow rationals hold the forces of mixed piles |
//! | `slices` | slices are filled with the forces of mixed piles, within the bounds that are told, or refused |
//! | `standing` | least forces, extremes and sums of mixed piles are those of all forces |
//! | `equilibrium` | forces on every sphere balance, both ends of a contact agree, the floor bears the weight |
//! | `floats` | `f32` and `f64` are a few roundings off the exact answer |
//! | `fixed` | fixed-width rationals are right or say that they overflow |
//! | `nearest` | a root is rounded to the nearest float |
//! | `order` | roots compare and multiply as their squares do |
//! | `packing` | answers in SI are the roots that the geometry makes them |
//! | `overlap` | a spacing is allowed just if no two spheres come too close |
//! | `parsers` | a parser never panics, and reads what is printed |
//! | `scene` | a scene makes the pile that it describes, or is refused |
//! | `scene_file` | a scene that is written down is read back; a file is read exactly or refused |
//! | `json` | what is written as JSON is read back, and any JSON is valid or refused |
//! | `laws` | every scalar passes the law suite |
//! | `stackings` | a text is read as a stacking by the rules of its notation, and printed again |
//! | `recorded` | formulas as they are written for Coq, read and evaluated again, are the formulas (feature `export`) |
//! | `regions` | bounds are tightened completely, and small regions have their sites |
//! | `growth` | dilation and erosion of a region of any size, and the lines through its layers |
//! | `numbered` | the spheres of any pile are numbered without a gap |
//! | `measured` | measured forces are read as written, and a planted fault is found (feature `export`) |
//! | `ladder` | a planted order of accuracy is found, and any ladder comes back from its record (feature `export`) |
//! | `engine` | every way to ask for the forces of a mixed pile gives what the equations of equilibrium give |
//! | `disorder` | the mean over random stackings is that of all stackings, one by one |
//! | `ensemble` | tallies are what plain enumeration counts, and parts make the whole (feature `ensemble`) |
//! | `certificates` | what a checker accepts is true, and the checker in Python says the same (feature `horizontal`) |
//! | `horizontal` | what a pile with horizontal contacts can bear is what an exact program says, with proofs (feature `horizontal`) |
//!
//! `handed_on` has the oracle's forces of what a generator describes.

pub(crate) mod bases;
#[cfg(feature = "horizontal")]
pub(crate) mod certificates;
pub(crate) mod disorder;
pub(crate) mod engine;
#[cfg(feature = "ensemble")]
pub(crate) mod ensemble;
pub(crate) mod equilibrium;
pub(crate) mod fixed;
pub(crate) mod floats;
pub(crate) mod growth;
pub(crate) mod handed_on;
#[cfg(feature = "horizontal")]
pub(crate) mod horizontal;
#[cfg(feature = "serde")]
pub(crate) mod json;
#[cfg(feature = "export")]
pub(crate) mod ladder;
pub(crate) mod laws;
#[cfg(feature = "export")]
pub(crate) mod measured;
pub(crate) mod nearest;
pub(crate) mod numbered;
pub(crate) mod order;
pub(crate) mod overlap;
pub(crate) mod packing;
pub(crate) mod parsers;
#[cfg(feature = "export")]
pub(crate) mod recorded;
pub(crate) mod regions;
pub(crate) mod scalars;
pub(crate) mod scene;
#[cfg(feature = "toml")]
pub(crate) mod scene_file;
pub(crate) mod sites;
pub(crate) mod slices;
pub(crate) mod stackings;
pub(crate) mod standing;

use core::fmt::{self, Debug, Display};

use arbitrary::Unstructured;
use cannonpile::Error;
use cannonpile::scalar::laws::Broken;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed};

/// A claim about the input that the bytes make.
pub(crate) type Claim = fn(&mut Unstructured<'_>) -> Checked;

/// Nothing, if the claim holds.
pub(crate) type Checked = Result<(), Failure>;

/// Why a claim was not confirmed.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The bytes make no input. No generator gives this today.
    NoInput(arbitrary::Error),
    /// It does not hold: the witness.
    Refuted(String),
}

impl Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoInput(error) => write!(f, "no input: {error}"),
            Self::Refuted(witness) => f.write_str(witness),
        }
    }
}

impl From<arbitrary::Error> for Failure {
    fn from(error: arbitrary::Error) -> Self {
        Self::NoInput(error)
    }
}

/// A question that has an answer was refused.
impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Refuted(format!("refused: {error}"))
    }
}

impl From<Broken> for Failure {
    fn from(broken: Broken) -> Self {
        Self::Refuted(broken.to_string())
    }
}

/// Holds, or refuted with the witness.
pub(crate) fn demand(holds: bool, witness: impl FnOnce() -> String) -> Checked {
    if holds {
        Ok(())
    } else {
        Err(Failure::Refuted(witness()))
    }
}

/// `got` is `want`.
pub(crate) fn same<T: PartialEq + Debug>(what: &str, got: &T, want: &T) -> Checked {
    demand(got == want, || format!("{what} is {got:?}, not {want:?}"))
}

/// A rational is kept as it is printed: no common factor, a positive denominator.
///
/// Comparing two rationals does not show this.
pub(crate) fn in_lowest_terms(r: &BigRational) -> Checked {
    let holds = r.denom().is_positive() && r.numer().gcd(r.denom()).is_one();
    demand(holds, || format!("{r} is not in lowest terms"))
}

/// A refusal is one line that says something, whatever was quoted in it.
pub(crate) fn one_line(refusal: &Error) -> Checked {
    let message = refusal.to_string();
    let printable = !message.is_empty() && !message.contains(char::is_control);
    demand(printable, || format!("not one line: {message:?}"))
}

#[cfg(test)]
mod planted {
    use super::*;
    use crate::generators::number::ratio;

    #[test]
    fn an_unreduced_rational_is_caught() {
        assert!(in_lowest_terms(&ratio(-2, 6)).is_ok());
        for (n, d) in [(2, 6), (1, -3), (0, 2)] {
            let raw = BigRational::new_raw(n.into(), d.into());
            assert!(in_lowest_terms(&raw).is_err(), "{raw}");
        }
    }

    #[test]
    fn a_message_of_two_lines_is_caught() {
        let refusal = |text: &str| Error::Syntax {
            text: text.into(),
            expected: "a number",
        };
        assert!(one_line(&refusal("1\\n2")).is_ok());
        assert!(one_line(&refusal("1\n2")).is_err());
    }
}
