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
//! | `options` | so do the parsers of scenes and tables (feature `dem`) |
//! | `scene` | a scene makes the pile that it describes, or is refused (feature `dem`) |
//! | `scene_file` | a scene that is written down is read back; a file is read exactly or refused (feature `dem`) |
//! | `json` | what is written as JSON is read back, and any JSON is valid or refused (feature `serde`) |
//! | `laws` | every scalar passes the law suite |
//! | `stackings` | a text is read as a stacking by the rules of its notation, and printed again |
//! | `recorded` | formulas as they are written for Coq, read and evaluated again, are the formulas (feature `proof`) |
//! | `regions` | bounds are tightened completely, and small regions have their sites |
//! | `growth` | dilation and erosion of a region of any size, and the lines through its layers |
//! | `numbered` | the spheres of any pile are numbered without a gap |
//! | `measured` | measured forces are read as written, and a planted fault is found (feature `dem`) |
//! | `ladder` | a planted order of accuracy is found, and any ladder comes back from its record (feature `dem`) |
//! | `engine` | every way to ask for the forces of a mixed pile gives what the equations of equilibrium give |
//! | `disorder` | the mean over random stackings is that of all stackings, one by one (feature `disorder`) |
//! | `ensemble` | tallies are what plain enumeration counts, and parts make the whole (feature `disorder`) |
//! | `certificates` | what a checker accepts is true, and the checker in Python says the same (feature `horizontal`) |
//! | `horizontal` | what a pile with horizontal contacts can bear is what an exact program says, with proofs (feature `horizontal`) |
//!
//! `handed_on` has the oracle's forces of what a generator describes.

pub mod bases;
#[cfg(feature = "horizontal")]
pub mod certificates;
#[cfg(feature = "disorder")]
pub mod disorder;
pub mod engine;
#[cfg(feature = "disorder")]
pub mod ensemble;
pub mod equilibrium;
pub mod fixed;
pub mod floats;
pub mod growth;
pub mod handed_on;
#[cfg(feature = "horizontal")]
pub mod horizontal;
#[cfg(feature = "serde")]
pub mod json;
#[cfg(feature = "dem")]
pub mod ladder;
pub mod laws;
#[cfg(feature = "dem")]
pub mod measured;
pub mod nearest;
pub mod numbered;
#[cfg(feature = "dem")]
pub mod options;
pub mod order;
pub mod overlap;
pub mod packing;
pub mod parsers;
#[cfg(feature = "proof")]
pub mod recorded;
pub mod regions;
pub mod scalars;
#[cfg(feature = "dem")]
pub mod scene;
#[cfg(feature = "dem")]
pub mod scene_file;
pub mod sites;
pub mod slices;
pub mod stackings;
pub mod standing;

use core::fmt::{self, Debug, Display};

use arbitrary::Unstructured;
use cannonpile::scalar::laws::BrokenLaw;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed};

/// A claim about the input that the bytes make.
pub type Claim = fn(&mut Unstructured<'_>) -> Checked;

/// Nothing, if the claim holds.
pub type Checked = Result<(), Failure>;

/// Why a claim was not confirmed.
#[derive(Debug)]
pub enum Failure {
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

impl Failure {
    /// A question that has an answer was refused.
    pub fn refused(error: &impl Display) -> Self {
        Self::Refuted(format!("refused: {error}"))
    }
}

macro_rules! refusals {
    ($($(#[$only:meta])? $error:ty;)*) => {$(
        $(#[$only])?
        impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Self::refused(&error)
            }
        }
    )*};
}

refusals! {
    exact_surd::Error;
    cannonpile::Error;
    #[cfg(feature = "horizontal")] cannonpile_horizontal::Error;
    #[cfg(feature = "disorder")] cannonpile_disorder::Error;
    #[cfg(feature = "dem")] cannonpile_dem::Error;
    #[cfg(feature = "proof")] cannonpile_proof::Error;
}

impl From<BrokenLaw> for Failure {
    fn from(broken: BrokenLaw) -> Self {
        Self::Refuted(broken.to_string())
    }
}

/// Holds, or refuted with the witness.
pub fn demand(holds: bool, witness: impl FnOnce() -> String) -> Checked {
    if holds {
        Ok(())
    } else {
        Err(Failure::Refuted(witness()))
    }
}

/// `got` is `want`.
pub fn same<T: PartialEq + Debug>(what: &str, got: &T, want: &T) -> Checked {
    demand(got == want, || format!("{what} is {got:?}, not {want:?}"))
}

/// A rational is kept as it is printed: no common factor, a positive denominator.
///
/// Comparing two rationals does not show this.
pub fn in_lowest_terms(r: &BigRational) -> Checked {
    let holds = r.denom().is_positive() && r.numer().gcd(r.denom()).is_one();
    demand(holds, || format!("{r} is not in lowest terms"))
}

/// A refusal is one line that says something, whatever was quoted in it.
pub fn one_line(refusal: &impl Display) -> Checked {
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
        let refusal = |text: &str| format!("'{text}' is not a number");
        assert!(one_line(&refusal("1\\n2")).is_ok());
        assert!(one_line(&refusal("1\n2")).is_err());
        assert!(one_line(&"").is_err());
    }
}
