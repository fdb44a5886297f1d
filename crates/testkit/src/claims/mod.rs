//! Properties that hold for every input, as functions from bytes.
//!
//! A claim draws its input from an [`Unstructured`] through [`generators`](crate::generators). It calls the library and
//! checks the answer by a theorem. The property tests and the fuzz targets run the same claims.
//!
//! Each check is a small function. The tests at the foot of each file call it with answers that are wrong by the
//! smallest possible amount, which it must reject.
//!
//! | file | the claim |
//! |---|---|
//! | `sites` | a pile has exactly its sites |
//! | `bases` | elimination confirms the forces of discs and isosceles bases, with weights and loads |
//! | `scalars` | intervals and narrow rationals enclose the forces of mixed piles |
//! | `slices` | slices receive the forces of mixed piles within the stated bounds, or the call fails |
//! | `standing` | least forces, extremes and sums of mixed piles agree with all forces |
//! | `equilibrium` | forces on every sphere balance, both ends of a contact agree, the base supports the weight |
//! | `floats` | errors of `f32` and `f64` stay within a few roundings |
//! | `fixed` | fixed-width rationals are correct or report an overflow |
//! | `nearest` | a root is rounded correctly |
//! | `order` | roots compare and multiply as their squares do |
//! | `packing` | answers in SI units are the roots that follow from the geometry |
//! | `overlap` | a spacing is allowed exactly if no two spheres overlap |
//! | `parsers` | a parser never panics, and it reads printed values |
//! | `options` | the same for the parsers of scenes and tables (feature `dem`) |
//! | `scene` | a scene yields the described pile, or is rejected (feature `dem`) |
//! | `scene_file` | a written scene is read back; a file is read exactly or rejected (feature `dem`) |
//! | `json` | values survive a round trip through JSON; any JSON is valid or rejected (feature `serde`) |
//! | `laws` | every scalar passes the law suite |
//! | `stackings` | a text is read as a stacking by the rules of its notation, and printed again |
//! | `recorded` | formulas in Coq's syntax, read and evaluated, equal the library's formulas (feature `proof`) |
//! | `regions` | bounds are tightened completely, and small regions have their sites |
//! | `growth` | dilation and erosion of a region of any size, and the lines through its layers |
//! | `numbered` | the sphere numbers of any pile have no gap |
//! | `measured` | measured forces are read as written, and an injected fault is found (feature `dem`) |
//! | `dialect` | a table of exact forces is read whole in any dialect, and a planted fault is found (feature `dem`) |
//! | `refinement` | a refinement study finds a given order of accuracy (feature `dem`) |
//! | `vtk` | contacts in files of VTK are read as written, or rejected (feature `dem`) |
//! | `engine` | every way to compute the forces of a mixed pile solves the equations of equilibrium |
//! | `disorder` | the mean over random stackings equals a plain average over all stackings (feature `disorder`) |
//! | `ensemble` | tallies equal a plain enumeration, and parts merge into the whole (feature `disorder`) |
//! | `certificates` | an accepted certificate is true, and the Python checker agrees (feature `horizontal`) |
//! | `threads` | one thread and several give equal forces (feature `rayon`) |
//! | `horizontal` | exact linear programs and certificates confirm the answers about horizontal contacts (feature `horizontal`) |
//!
//! `reference` contains the oracle's forces of a described pile.

pub mod bases;
#[cfg(feature = "horizontal")]
pub mod certificates;
#[cfg(feature = "dem")]
pub mod dialect;
#[cfg(feature = "disorder")]
pub mod disorder;
pub mod engine;
#[cfg(feature = "disorder")]
pub mod ensemble;
pub mod equilibrium;
pub mod fixed;
pub mod floats;
pub mod growth;
#[cfg(feature = "horizontal")]
pub mod horizontal;
#[cfg(feature = "serde")]
pub mod json;
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
pub mod reference;
#[cfg(feature = "dem")]
pub mod refinement;
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
#[cfg(feature = "rayon")]
pub mod threads;
#[cfg(feature = "dem")]
pub mod vtk;

use core::fmt::{self, Debug, Display};

use arbitrary::Unstructured;
use cannonpile::scalar::laws::BrokenLaw;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed};

/// A claim about the input that the bytes determine.
pub type Claim = fn(&mut Unstructured<'_>) -> Checked;

/// `Ok` if the claim holds.
pub type Checked = Result<(), Failure>;

/// The reason why a claim was not confirmed.
#[derive(Debug)]
pub enum Failure {
    /// The bytes do not determine an input. No generator returns this today.
    NoInput(arbitrary::Error),
    /// The claim is false for this input. Contains the witness, a description of the wrong answer.
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
    /// The library rejected a valid query.
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

/// Returns `Ok` if the claim holds, and otherwise the witness.
pub fn demand(holds: bool, witness: impl FnOnce() -> String) -> Checked {
    if holds {
        Ok(())
    } else {
        Err(Failure::Refuted(witness()))
    }
}

/// `got` equals `want`.
pub fn same<T: PartialEq + Debug>(what: &str, got: &T, want: &T) -> Checked {
    demand(got == want, || format!("{what} is {got:?}, not {want:?}"))
}

/// A rational is stored as it is printed: without a common factor, and with a positive denominator.
///
/// Comparing two rationals does not show this.
pub fn in_lowest_terms(r: &BigRational) -> Checked {
    let holds = r.denom().is_positive() && r.numer().gcd(r.denom()).is_one();
    demand(holds, || format!("{r} is not in lowest terms"))
}

/// An error message is a single, nonempty line, whatever text it quotes.
pub fn one_line(refusal: &impl Display) -> Checked {
    let message = refusal.to_string();
    let printable = !message.is_empty() && !message.contains(char::is_control);
    demand(printable, || format!("not one line: {message:?}"))
}

#[cfg(test)]
mod injected_faults {
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
