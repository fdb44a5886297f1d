//! The claims that each fuzz target makes.
//!
//! The claims and their generators are those of the property tests, from `cannonpile-testkit`; here libFuzzer chooses the bytes.
//! The first byte of an input chooses among the claims of its target. The others are the bytes of the claim: those of a crash file
//! fail the same claim in `cannonpile_testkit::properties`.
//!
//! `RUSTC_WRAPPER=$PWD/fuzz/rustc cargo fuzz run TARGET --sanitizer none -- -max_len=512 -len_control=0` fuzzes one on a stable
//! toolchain. An input takes some hundred bytes: the last option gives them from the start. The wrapper has only this project's code
//! watched, which makes it three to ten times as fast.

mod enclosing;
mod polynomial;

use arbitrary::Unstructured;
use cannonpile_testkit::claims;
use cannonpile_testkit::claims::{Checked, Claim, Failure};
use libfuzzer_sys::Corpus;

/// Every sphere of a small pile and one of any pile, any sin φ, are in exact equilibrium; other sites are none.
#[must_use]
pub fn equilibrium(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[
            claims::equilibrium::one_sphere,
            claims::equilibrium::small_pile,
            claims::equilibrium::on_floor,
            claims::sites::anywhere,
            claims::sites::numbered,
        ],
    )
}

/// A spacing is allowed just if no two spheres overlap, and answers in SI have its geometry.
#[must_use]
pub fn overlap(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[
            claims::overlap::of_a_spacing,
            claims::overlap::of_two_spheres,
            claims::packing::one_sphere,
            claims::packing::one_row,
        ],
    )
}

/// No parser panics, each reads what is printed, and a scene is a pile or is refused; scene files and JSON too.
#[must_use]
pub fn parsers(bytes: &[u8]) -> Corpus {
    // The crates share a claim where they parse the same text: the inputs in `seeds` were found so.
    holds(
        bytes,
        &[
            |u| each(u, &[claims::parsers::any_text, claims::options::any_text]),
            claims::parsers::a_number,
            |u| each(u, &[claims::parsers::a_value, claims::options::layers]),
            |u| {
                each(
                    u,
                    &[
                        claims::parsers::any_word,
                        claims::options::any_word,
                        claims::disorder::any_word,
                    ],
                )
            },
            claims::scene::any_scene,
            claims::scene_file::written,
            claims::scene_file::any_file,
            claims::scene_file::a_number,
            claims::json::any_value,
            |u| {
                each(
                    u,
                    &[claims::json::damaged, claims::scene_file::damaged_json],
                )
            },
            claims::scene_file::json,
        ],
    )
}

/// Roots round to the nearest float and keep their order; float forces are a few roundings off.
#[must_use]
pub fn rounding(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[
            claims::nearest::of_a_root,
            claims::nearest::of_a_rational,
            claims::order::of_two_roots,
            claims::order::of_a_square,
            claims::floats::any_pile,
            claims::floats::real_pile,
        ],
    )
}

/// Every scalar keeps its laws; fixed-width answers are right or overflow.
#[must_use]
pub fn scalar_laws(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[
            claims::laws::one_scalar,
            claims::laws::ratios_of_integers,
            claims::fixed::results_can_be_negated,
            claims::fixed::any_pile,
            claims::fixed::small_pile,
        ],
    )
}

/// Any text is a stacking by the rules or is refused, and what is one is printed and read again in every notation.
#[must_use]
pub fn stackings(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[claims::stackings::any_text, claims::stackings::of_runs],
    )
}

/// Regions of any size are tight, grow and shrink as their sites do, and the spheres of piles on them are counted.
#[must_use]
pub fn regions(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[
            claims::regions::any_bounds,
            claims::regions::small,
            claims::growth::grown,
            claims::numbered::any_pile,
        ],
    )
}

/// The forces of a small pile are those of the equations of equilibrium, by every way to ask for them and in every scalar; so are
/// their extremes and sums.
#[must_use]
pub fn engine(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[
            claims::engine::every_way,
            claims::engine::in_floats,
            claims::slices::filled,
            claims::standing::of_all_forces,
            claims::bases::any_base,
            claims::scalars::mixed,
        ],
    )
}

/// Tallies of ensembles are what plain enumeration counts, parts make the whole, and files of them are read or refused.
#[must_use]
pub fn ensemble(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[
            claims::ensemble::counts,
            claims::ensemble::parts,
            claims::ensemble::damaged,
        ],
    )
}

/// What a tiny pile with horizontal contacts can bear is proved, and is what an exact linear program says.
#[must_use]
pub fn horizontal(bytes: &[u8]) -> Corpus {
    holds(bytes, &[claims::horizontal::any_pile])
}

/// Whatever is changed in a certificate, or in its file: what is accepted is true.
#[must_use]
pub fn certificates(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[claims::certificates::changed, claims::certificates::damaged],
    )
}

/// The checker in Python and the library's come to one verdict.
#[must_use]
pub fn python_checker(bytes: &[u8]) -> Corpus {
    holds(bytes, &[claims::certificates::judged_twice])
}

/// The mean over random stackings is that of all stackings, looked at one by one.
#[must_use]
pub fn mean(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[claims::disorder::small, claims::disorder::any_size],
    )
}

/// Measured forces are read as they were written or refused, exact ones accepted, and a planted fault is found; ladders of
/// runs have the order that they were made with, and records of them are read back or refused.
#[must_use]
pub fn measured(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[
            claims::measured::any_file,
            claims::ladder::any_record,
            claims::ladder::any_rungs,
            claims::ladder::planted,
            claims::measured::any_table,
            claims::measured::a_file,
            claims::measured::planted,
        ],
    )
}

/// Exact forces are accepted by the places of their contacts alone, in any frame and any order.
#[must_use]
pub fn placed(bytes: &[u8]) -> Corpus {
    holds(bytes, &[claims::measured::by_place])
}

/// What is written for Coq is what the formulas give in rationals.
#[must_use]
pub fn recorded(bytes: &[u8]) -> Corpus {
    holds(bytes, &[claims::recorded::any_values])
}

/// Polynomials compute what their values compute.
#[must_use]
pub fn polynomial(bytes: &[u8]) -> Corpus {
    kept(polynomial::polynomial(&mut Unstructured::new(bytes)))
}

/// Intervals hold the exact result, double-doubles are near it.
#[must_use]
pub fn enclosing(bytes: &[u8]) -> Corpus {
    kept(enclosing::enclosing(&mut Unstructured::new(bytes)))
}

/// Bytes that make no input teach nothing.
fn kept(outcome: arbitrary::Result<()>) -> Corpus {
    if outcome.is_ok() {
        Corpus::Keep
    } else {
        Corpus::Reject
    }
}

/// Makes several claims about the same bytes.
fn each(u: &mut Unstructured<'_>, claims: &[Claim]) -> Checked {
    let bytes = u.peek_bytes(u.len()).unwrap_or_default();
    claims
        .iter()
        .try_for_each(|claim| claim(&mut Unstructured::new(bytes)))
}

/// Makes one of the claims, chosen by the first byte, about the input that it draws from the others.
fn holds(bytes: &[u8], claims: &[Claim]) -> Corpus {
    let Some((first, bytes)) = bytes.split_first() else {
        return Corpus::Reject;
    };
    let claim = claims[usize::from(*first) % claims.len()];
    match claim(&mut Unstructured::new(bytes)) {
        Ok(()) => Corpus::Keep,
        Err(Failure::NoInput(_)) => Corpus::Reject,
        Err(refuted) => panic!("{refuted}"),
    }
}
