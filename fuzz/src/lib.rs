//! The claims of each fuzz target.
//!
//! The claims and their generators are those of the property tests, from `cannonpile-testkit`. Here libFuzzer chooses the
//! bytes. The first byte of an input selects a claim of its target, and the generators read the others. The bytes of a crash
//! file fail the same claim in `cannonpile_testkit::properties`.
//!
//! `RUSTC_WRAPPER=$PWD/fuzz/rustc cargo fuzz run TARGET --sanitizer none -- -max_len=512 -len_control=0` fuzzes a target on a
//! stable toolchain. Inputs have some hundred bytes, and the last option starts at this length. The wrapper is two and a half
//! times as fast as none. Targets of other crates than the core need `--features all`.

mod enclosing;
mod polynomial;

use arbitrary::Unstructured;
use cannonpile_testkit::claims;
#[cfg(feature = "all")]
use cannonpile_testkit::claims::Checked;
use cannonpile_testkit::claims::{Claim, Failure};
use libfuzzer_sys::Corpus;

/// For any sin φ, every sphere of a small pile and one sphere of any pile are in exact equilibrium. Other sites are errors.
#[must_use]
pub fn equilibrium(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[
            claims::equilibrium::one_sphere,
            claims::equilibrium::small_pile,
            claims::equilibrium::on_floor,
            claims::sites::anywhere,
        ],
    )
}

/// A spacing is valid if and only if no two spheres overlap. Forces and positions in SI follow its geometry.
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

/// No parser panics, and each reads its own output. A scene, a scene file or a JSON text gives a pile or an error.
#[cfg(feature = "all")]
#[must_use]
pub fn parsers(bytes: &[u8]) -> Corpus {
    // Parsers of the same text share a claim, because the inputs in `seeds` were collected this way.
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
            claims::json::damaged,
        ],
    )
}

/// Roots are correctly rounded and keep their order. Forces in floats have an error of a few roundings.
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

/// Every scalar satisfies its laws. Results of fixed width are correct or overflow.
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

/// Any text gives a stacking or an error. A stacking round-trips in every notation.
#[must_use]
pub fn stackings(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[claims::stackings::any_text, claims::stackings::of_runs],
    )
}

/// Regions of any size are tight, and their dilation, erosion and sphere counts agree with their sites.
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

/// The forces of a small pile solve the equations of equilibrium, by every method and in every scalar. Their extremes and
/// sums agree.
#[cfg(feature = "all")]
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
            |u| each(u, &[claims::scalars::mixed, claims::threads::any_number]),
        ],
    )
}

/// Tallies of ensembles agree with plain enumeration, parts merge to the whole, and any file is read or rejected.
#[cfg(feature = "all")]
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

/// The bounds of a tiny pile with horizontal contacts have certificates, and agree with an exact linear program.
#[cfg(feature = "all")]
#[must_use]
pub fn horizontal(bytes: &[u8]) -> Corpus {
    holds(bytes, &[claims::horizontal::small_pile])
}

/// A modified certificate or certificate file is accepted only if its claim is true.
#[cfg(feature = "all")]
#[must_use]
pub fn certificates(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[claims::certificates::changed, claims::certificates::damaged],
    )
}

/// The checker in Python and that of the library give the same verdict.
#[cfg(feature = "all")]
#[must_use]
pub fn python_checker(bytes: &[u8]) -> Corpus {
    holds(bytes, &[claims::certificates::checkers_agree])
}

/// The mean over random stackings agrees with the enumeration of all stackings.
#[cfg(feature = "all")]
#[must_use]
pub fn mean(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[claims::disorder::small, claims::disorder::any_size],
    )
}

/// Tables of measured forces are read correctly or rejected. Exact forces are accepted, and a wrong force is found.
/// Refinement studies have the order of their generator.
#[cfg(feature = "all")]
#[must_use]
pub fn measured(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[
            claims::measured::any_file,
            claims::refinement::any_levels,
            claims::refinement::given_order,
            claims::measured::any_table,
            claims::measured::a_file,
            claims::measured::injected_fault,
            claims::measured::repeated_pairs,
        ],
    )
}

/// Any bytes are read as a table, or rejected.
#[cfg(feature = "all")]
#[must_use]
pub fn bytes(bytes: &[u8]) -> Corpus {
    holds(bytes, &[claims::measured::any_file])
}

/// A table of exact forces is read whole in any dialect, and a planted fault is found.
#[cfg(feature = "all")]
#[must_use]
pub fn dialect(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[claims::dialect::exact_table, claims::dialect::planted_fault],
    )
}

/// Exact forces are accepted by position, in any frame and any order.
#[cfg(feature = "all")]
#[must_use]
pub fn placed(bytes: &[u8]) -> Corpus {
    holds(bytes, &[claims::measured::by_place])
}

/// Contacts in files of VTK are read as written. Any file is read or rejected, and a file without contacts is rejected.
#[cfg(feature = "all")]
#[must_use]
pub fn vtk(bytes: &[u8]) -> Corpus {
    holds(
        bytes,
        &[
            claims::vtk::any_file,
            claims::vtk::damaged,
            claims::vtk::written,
        ],
    )
}

/// The definitions for Coq have the values of the formulas in rationals.
#[cfg(feature = "all")]
#[must_use]
pub fn recorded(bytes: &[u8]) -> Corpus {
    holds(bytes, &[claims::recorded::any_values])
}

/// Operations on polynomials agree with those on their values.
#[must_use]
pub fn polynomial(bytes: &[u8]) -> Corpus {
    kept(polynomial::polynomial(&mut Unstructured::new(bytes)))
}

/// Intervals contain the exact result, and double-doubles are close to it.
#[must_use]
pub fn enclosing(bytes: &[u8]) -> Corpus {
    kept(enclosing::enclosing(&mut Unstructured::new(bytes)))
}

/// Rejects bytes that are too short for an input.
fn kept(outcome: arbitrary::Result<()>) -> Corpus {
    if outcome.is_ok() {
        Corpus::Keep
    } else {
        Corpus::Reject
    }
}

/// Checks several claims on the same bytes.
#[cfg(feature = "all")]
fn each(u: &mut Unstructured<'_>, claims: &[Claim]) -> Checked {
    let bytes = u.peek_bytes(u.len()).unwrap_or_default();
    claims
        .iter()
        .try_for_each(|claim| claim(&mut Unstructured::new(bytes)))
}

/// Checks one claim, selected by the first byte, on an input generated from the others.
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
