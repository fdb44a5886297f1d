//! The claims on random input: deterministic, from the generators that fuzzing shares.
//!
//! Each claim is a function of bytes (see `claims`); its planted faults stand beside it. A failure prints the
//! shortest bytes that proptest could find, and the claim's own witness.

mod claims;
mod generators;
#[path = "../support/mod.rs"]
mod support;

use core::cell::RefCell;
use std::collections::BTreeMap;

use arbitrary::Unstructured;
use cannonpile::Error;
use cannonpile::lattice::Sign;
use cannonpile::lattice::{Dimension, Region, Site};
use cannonpile::scene::parse;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use proptest::collection::vec;
use proptest::prelude::any;
use proptest::test_runner::{Config, RngSeed, TestCaseError, TestError, TestRunner};

use claims::{Claim, Failure};
use generators::region::Described;
use generators::{number, pile, region, stacking, text};

/// As many bytes as any claim uses up; one that gets fewer reads zeros.
const BYTES: usize = 256;

macro_rules! properties {
    ($($name:ident: $claim:path, $cases:literal;)*) => {$(
        #[test]
        fn $name() {
            holds($claim, $cases);
        }
    )*};
}

properties! {
    a_pile_has_its_sites_and_no_others: claims::sites::anywhere, 1024;
    spheres_are_numbered_without_gaps: claims::sites::numbered, 512;
    every_sphere_is_in_equilibrium: claims::equilibrium::one_sphere, 1024;
    small_piles_are_in_equilibrium_throughout: claims::equilibrium::small_pile, 48;
    the_floor_bears_what_the_paper_says: claims::equilibrium::on_floor, 1024;
    floats_are_a_few_roundings_off: claims::floats::any_pile, 512;
    floats_are_a_few_roundings_off_for_real_sin_phi: claims::floats::real_pile, 512;
    fixed_width_is_right_or_overflows: claims::fixed::any_pile, 512;
    fixed_width_results_can_be_negated: claims::fixed::results_can_be_negated, 4096;
    short_fractions_fit_128_bits: claims::fixed::small_pile, 256;
    roots_round_to_the_nearest_float: claims::nearest::of_a_root, 1024;
    rationals_round_to_the_nearest_float: claims::nearest::of_a_rational, 1024;
    roots_are_ordered_as_their_squares: claims::order::of_two_roots, 1024;
    roots_of_squares_are_rational: claims::order::of_a_square, 256;
    rows_of_places_are_nearest_floats: claims::packing::one_row, 512;
    packings_are_as_the_geometry_says: claims::packing::one_sphere, 256;
    spacings_are_allowed_just_if_no_spheres_overlap: claims::overlap::of_a_spacing, 256;
    distances_are_the_quadratic_form: claims::overlap::of_two_spheres, 256;
    scenes_are_made_or_refused: claims::scene::any_scene, 512;
    parsers_survive_any_text: claims::parsers::any_text, 1024;
    numbers_are_read_as_written: claims::parsers::a_number, 1024;
    what_is_printed_is_read_back: claims::parsers::a_value, 512;
    words_are_read_as_they_are_printed: claims::parsers::any_word, 2048;
    every_scalar_keeps_the_laws: claims::laws::one_scalar, 4096;
    ratios_are_in_lowest_terms: claims::laws::ratios_of_integers, 512;
    stackings_are_read_by_the_rules: claims::stackings::any_text, 2048;
    stackings_are_made_of_runs: claims::stackings::of_runs, 1024;
    regions_are_tight_or_refused: claims::regions::any_bounds, 2048;
    small_regions_have_their_sites: claims::regions::small, 512;
    regions_grow_and_shrink_as_their_sites: claims::growth::grown, 2048;
    spheres_of_any_pile_are_numbered_without_gaps: claims::numbered::any_pile, 1024;
    forces_of_mixed_piles_are_one_whoever_is_asked: claims::engine::every_way, 512;
    floats_follow_the_forces_of_mixed_piles: claims::engine::in_floats, 512;
    slices_are_filled_with_the_forces_or_refused: claims::slices::filled, 256;
    least_forces_and_sums_are_those_of_all_forces: claims::standing::of_all_forces, 512;
    other_bases_bear_what_elimination_says: claims::bases::any_base, 256;
    every_scalar_holds_the_forces_of_mixed_piles: claims::scalars::mixed, 256;
    means_are_those_of_all_stackings: claims::disorder::small, 256;
    means_of_any_size_are_found_or_refused: claims::disorder::any_size, 512;
}

#[cfg(feature = "horizontal")]
properties! {
    what_can_be_borne_is_what_an_exact_program_says: claims::horizontal::any_pile, 192;
    what_a_checker_accepts_is_true: claims::certificates::changed, 384;
}

#[cfg(all(feature = "horizontal", feature = "serde"))]
properties! {
    damaged_certificates_are_refused_or_true: claims::certificates::damaged, 512;
}

#[cfg(all(feature = "export", feature = "horizontal", feature = "serde"))]
properties! {
    both_checkers_come_to_one_verdict: claims::certificates::judged_twice, 384;
}

#[cfg(feature = "ensemble")]
properties! {
    ensembles_are_counted_one_by_one: claims::ensemble::counts, 96;
    parts_in_any_order_make_the_whole: claims::ensemble::parts, 96;
}

#[cfg(all(feature = "ensemble", feature = "export", feature = "serde"))]
properties! {
    damaged_tallies_are_refused_or_valid: claims::ensemble::damaged, 512;
}

#[cfg(feature = "export")]
properties! {
    any_file_of_measured_forces_is_read_or_refused: claims::measured::any_file, 1024;
    any_table_of_another_code_is_compared_or_refused: claims::measured::any_table, 512;
    measured_forces_are_read_as_written: claims::measured::a_file, 512;
    tables_are_accepted_by_place_in_any_frame: claims::measured::by_place, 96;
    a_fault_among_measured_forces_is_found: claims::measured::planted, 256;
    a_planted_order_of_accuracy_is_found: claims::ladder::planted, 1024;
    any_ladder_comes_back_from_its_record: claims::ladder::any_rungs, 1024;
    any_record_of_a_ladder_is_read_or_refused: claims::ladder::any_record, 1024;
    what_coq_reads_are_the_formulas: claims::recorded::any_values, 1024;
}

#[cfg(feature = "serde")]
properties! {
    values_come_back_from_json: claims::json::any_value, 512;
    damaged_json_is_refused_or_valid: claims::json::damaged, 1024;
    scenes_come_back_from_json: claims::json::any_scene, 512;
}

#[cfg(feature = "toml")]
properties! {
    scenes_are_written_and_read_back: claims::scene_file::written, 512;
    scene_files_are_read_or_refused: claims::scene_file::any_file, 1024;
    numbers_in_scene_files_are_exact: claims::scene_file::a_number, 512;
}

/// So many changes of sign that a number takes several words, with heavy and with weightless spheres.
#[test]
fn forces_of_tall_mixed_piles_are_one_whoever_is_asked() {
    let steps = 15;
    let sign = |plus: bool| if plus { Sign::Plus } else { Sign::Minus };
    let low = Site { i: 0, j: 0, k: 5 };
    for (period, load) in [(1, 0), (2, -90), (3, 200), (1, 90)] {
        let described = Described {
            region: Region::SITE,
            from_base: false,
            signs: (0..steps).map(|n| sign(n / period % 2 == 0)).collect(),
            weightless: load > 100,
            weights: vec![
                (low, number::ratio(0, 1)),
                (Site::APEX, number::ratio(22, 7)),
            ],
            loads: vec![
                (low, number::power(2, load)),
                (Site::APEX, number::power(10, 40)),
            ],
        };
        if let Err(failure) = claims::engine::throughout(&described, 11, 40) {
            panic!("{failure}");
        }
    }
}

/// The claim holds for `cases` random byte strings, the same in every run.
fn holds(claim: Claim, cases: u32) {
    let judged = |u: &mut Unstructured<'_>| {
        claim(u).map_err(|failure| match failure {
            Failure::NoInput(_) => TestCaseError::reject(failure.to_string()),
            Failure::Refuted(witness) => TestCaseError::fail(witness),
        })
    };
    if let Err(failure) = for_all(cases, judged) {
        panic!("{failure}");
    }
}

fn for_all(
    cases: u32,
    test: impl Fn(&mut Unstructured<'_>) -> Result<(), TestCaseError>,
) -> Result<(), TestError<Vec<u8>>> {
    let config = Config {
        cases,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1998),
        ..Config::default()
    };
    let bytes = vec(any::<u8>(), 0..=BYTES);
    TestRunner::new(config).run(&bytes, |bytes| test(&mut Unstructured::new(&bytes)))
}

/// How often each kind of input comes up in 400 byte strings.
fn census(
    kind: impl Fn(&mut Unstructured<'_>) -> arbitrary::Result<String>,
) -> BTreeMap<String, u32> {
    let counts = RefCell::new(BTreeMap::new());
    let outcome = for_all(400, |u| {
        let kind = kind(u).map_err(|error| TestCaseError::fail(error.to_string()))?;
        *counts.borrow_mut().entry(kind).or_default() += 1;
        Ok(())
    });
    outcome.expect("a generator never fails");
    counts.into_inner()
}

/// A claim about spacings would be idle if none were at a bound.
#[test]
fn spacings_meet_every_verdict() {
    let verdicts = census(|u| {
        let clearance = pile::pile(u)?.clearance();
        let spacing = pile::spacing(u, &clearance)?;
        Ok(match clearance.check(&spacing) {
            Ok(touching) if touching.is_empty() => "free".into(),
            Ok(_) => "touching".into(),
            Err(Error::Overlap { .. }) => "overlapping".into(),
            Err(Error::TooFlat { .. }) => "too flat".into(),
            Err(Error::NoSpacing { .. }) => "hopeless".into(),
            Err(other) => other.to_string(),
        })
    });
    assert_eq!(verdicts.len(), 5, "{verdicts:?}");
    assert!(verdicts["touching"] >= 20, "{verdicts:?}");
}

#[test]
fn piles_are_of_every_kind_and_asked_everywhere() {
    let kinds = census(|u| {
        let pile = pile::pile(u)?;
        let Site { i, j, k } = pile::site(u, &pile)?;
        let kind = match (pile.dimension(), pile.is_regular()) {
            (Dimension::Two, _) => "discs",
            (_, true) => "equilateral",
            _ => "isosceles",
        };
        let tall = pile.layers() > 1 << 64;
        let base = k == pile.layers() - 1;
        let inside = i > 0 && j > 0 && i + j < k;
        Ok(format!("{kind} tall={tall} base={base} inside={inside}"))
    });
    // No disc lies inside: all have j = 0.
    assert_eq!(kinds.len(), 2 * 8 + 4, "{kinds:?}");
}

#[test]
fn texts_are_accepted_and_refused() {
    let kinds = census(|u| {
        let text = text::any(u)?;
        let number = parse::rational(&text).is_ok();
        let site = parse::at(&text, Dimension::Three).is_ok();
        Ok(format!("number={number} site={site}"))
    });
    // A site has commas, a number none.
    assert_eq!(kinds.len(), 3, "{kinds:?}");
    assert!(kinds.values().all(|count| *count >= 10), "{kinds:?}");
}

#[test]
fn stackings_are_accepted_and_refused_in_every_notation() {
    let kinds = census(|u| {
        let text = stacking::text(u)?;
        let notation = match text.chars().next() {
            Some('+' | '-') => "Hägg",
            Some('A'..='C') => "ABC",
            Some('h' | 'c') => "Jagodzinski",
            Some('(') => "Zhdanov",
            _ => "none",
        };
        let verdict = match text.parse::<Stacking>() {
            Ok(stacking) if stacking.changes() > 1 => "mixed",
            Ok(_) => "plain",
            Err(Error::Layers { .. }) => "too tall",
            Err(_) => "refused",
        };
        Ok(format!("{notation} {verdict}"))
    });
    // Only numbers can be too tall, and no notation is no stacking.
    assert_eq!(kinds.len(), 4 * 3 + 1 + 1, "{kinds:?}");
}

#[cfg(feature = "toml")]
#[test]
fn scene_files_are_of_every_kind() {
    let kinds = census(|u| {
        let file = generators::scene::file(u)?;
        Ok(match cannonpile::scene::Scene::from_toml(&file) {
            Ok(_) if file.is_empty() => "empty",
            Ok(_) => "read",
            Err(Error::NotToml { .. }) => "no TOML",
            Err(Error::UnknownKey { .. }) => "unknown key",
            Err(_) => "refused",
        }
        .into())
    });
    assert_eq!(kinds.len(), 5, "{kinds:?}");
    assert!(kinds.values().all(|count| *count >= 8), "{kinds:?}");
}

#[test]
fn bounds_are_made_and_refused() {
    let kinds = census(|u| {
        let [x0, x1, y0, y1, s0, s1] = region::bounds(u)?;
        Ok(match Region::new(x0..=x1, y0..=y1, s0..=s1) {
            Ok(region) if region.site_count().bits() > 64 => "huge".into(),
            Ok(region) if region.x() == (x0..=x1) && region.s() == (s0..=s1) => "as given".into(),
            Ok(_) => "tightened".into(),
            Err(Error::EmptyRegion { .. }) => "empty".into(),
            Err(Error::RegionTooLarge { .. }) => "too large".into(),
            Err(other) => other.to_string(),
        })
    });
    assert_eq!(kinds.len(), 5, "{kinds:?}");
    assert!(kinds.values().all(|count| *count >= 8), "{kinds:?}");
}

#[cfg(feature = "horizontal")]
#[test]
fn tiny_piles_stand_or_not_with_pushes_or_without() {
    let kinds = census(|u| {
        let pile = region::tiny(u)?
            .pile()
            .expect("what was described is a pile");
        let alone = pile.first_failure().expect("a verdict").is_none();
        let claim = pile.equilibrium().expect("a verdict").claim;
        Ok(format!("{claim:?} alone={alone}"))
    });
    // What stands alone stands.
    assert_eq!(kinds.len(), 3, "{kinds:?}");
}

#[test]
fn mixed_piles_are_of_every_kind() {
    let kinds = census(|u| {
        let described = region::described(u)?;
        let pile = described.pile().expect("what was described is a pile");
        let method = pile.plan(Selection::Base).expect("a base").method;
        let changes = pile.shape().stacking().changes().min(2);
        let (from_base, loaded) = (described.from_base, !described.loads.is_empty());
        Ok(format!(
            "{method} changes={changes} from_base={from_base} loaded={loaded}"
        ))
    });
    // Straight piles are not swept, others are.
    assert_eq!(kinds.len(), 3 * 2 * 2, "{kinds:?}");
    assert!(kinds.values().all(|count| *count >= 4), "{kinds:?}");
}
