//! Claims about the crate `cannonpile` on random input. The runs are deterministic and use the same generators as
//! fuzzing.
//!
//! Each claim is a function of bytes in `cannonpile_testkit`, next to the tests that inject faults. A failure prints the
//! shortest bytes that proptest finds, and the witness of the claim.

use cannonpile::Error;
use cannonpile::lattice::{Dimension, Region, Sign, Site};
use cannonpile::scalar::parse;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile_testkit::claims;
use cannonpile_testkit::generators::region::Described;
use cannonpile_testkit::generators::{number, pile, region, stacking, text};
use cannonpile_testkit::properties;
use cannonpile_testkit::properties::census;

properties! {
    a_pile_has_its_sites_and_no_others: claims::sites::anywhere, 1024;
    every_sphere_is_in_equilibrium: claims::equilibrium::one_sphere, 1024;
    small_piles_are_in_equilibrium: claims::equilibrium::small_pile, 48;
    the_base_force_follows_the_paper: claims::equilibrium::on_floor, 1024;
    floats_are_a_few_roundings_off: claims::floats::any_pile, 512;
    floats_are_a_few_roundings_off_for_real_sin_phi: claims::floats::real_pile, 512;
    fixed_width_is_right_or_overflows: claims::fixed::any_pile, 512;
    fixed_width_results_can_be_negated: claims::fixed::results_can_be_negated, 4096;
    short_fractions_fit_128_bits: claims::fixed::small_pile, 256;
    rows_of_places_are_correctly_rounded: claims::packing::one_row, 512;
    packings_follow_the_geometry: claims::packing::one_sphere, 256;
    spacings_are_allowed_exactly_without_overlap: claims::overlap::of_a_spacing, 256;
    distances_are_the_quadratic_form: claims::overlap::of_two_spheres, 256;
    parsers_survive_any_text: claims::parsers::any_text, 1024;
    numbers_are_read_as_written: claims::parsers::a_number, 1024;
    printed_values_are_read_back: claims::parsers::a_value, 512;
    words_are_read_as_they_are_printed: claims::parsers::any_word, 2048;
    every_scalar_keeps_the_laws: claims::laws::one_scalar, 4096;
    ratios_are_in_lowest_terms: claims::laws::ratios_of_integers, 512;
    stackings_are_read_by_the_rules: claims::stackings::any_text, 2048;
    stackings_are_made_of_runs: claims::stackings::of_runs, 1024;
    regions_are_tight_or_rejected: claims::regions::any_bounds, 2048;
    small_regions_have_their_sites: claims::regions::small, 512;
    regions_grow_and_shrink_as_their_sites: claims::growth::grown, 2048;
    spheres_of_any_pile_are_numbered_without_gaps: claims::numbered::any_pile, 1024;
    all_ways_to_compute_forces_agree: claims::engine::every_way, 512;
    floats_are_close_to_the_forces_of_mixed_piles: claims::engine::in_floats, 512;
    slices_receive_the_forces_or_fail: claims::slices::filled, 256;
    least_forces_and_sums_agree_with_all_forces: claims::standing::of_all_forces, 512;
    other_bases_agree_with_elimination: claims::bases::any_base, 256;
    every_scalar_contains_the_forces_of_mixed_piles: claims::scalars::mixed, 256;
}

#[cfg(feature = "rayon")]
properties! {
    threads_do_not_change_answers: claims::threads::any_number, 24;
}

#[cfg(feature = "serde")]
properties! {
    values_survive_json: claims::json::any_value, 512;
    damaged_json_is_rejected_or_valid: claims::json::damaged, 1024;
}

/// So many sign changes that a value takes several words, with and without weight.
#[test]
fn all_ways_agree_on_tall_mixed_piles() {
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
        if let Err(failure) = claims::engine::all_ways_agree(&described, 11) {
            panic!("{failure}");
        }
    }
}

/// The claim about spacings would be useless without spacings at a bound.
#[test]
fn spacings_cover_every_verdict() {
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
fn generated_piles_and_sites_cover_every_kind() {
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
    // A disc has j = 0, so it is never inside.
    assert_eq!(kinds.len(), 2 * 8 + 4, "{kinds:?}");
}

#[test]
fn generated_numbers_are_valid_and_invalid() {
    let kinds = census(|u| {
        let text = text::any(u)?;
        Ok(format!("number={}", parse::rational(&text).is_ok()))
    });
    assert_eq!(kinds.len(), 2, "{kinds:?}");
    assert!(kinds.values().all(|count| *count >= 10), "{kinds:?}");
}

#[test]
fn generated_stackings_are_valid_and_invalid() {
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
    // Only numbers can be too tall. A text without a notation is invalid.
    assert_eq!(kinds.len(), 4 * 3 + 1 + 1, "{kinds:?}");
}

#[test]
fn generated_bounds_are_valid_and_invalid() {
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

#[test]
fn generated_mixed_piles_cover_every_kind() {
    let kinds = census(|u| {
        let described = region::described(u)?;
        let pile = described.pile().expect("a valid pile");
        let method = pile.plan(Selection::Base).expect("a base").method;
        let changes = pile.shape().stacking().changes().min(2);
        let (from_base, loaded) = (described.from_base, !described.loads.is_empty());
        Ok(format!(
            "{method} changes={changes} from_base={from_base} loaded={loaded}"
        ))
    });
    // Straight piles do not use a sweep, mixed ones do.
    assert_eq!(kinds.len(), 3 * 2 * 2, "{kinds:?}");
    assert!(kinds.values().all(|count| *count >= 4), "{kinds:?}");
}
