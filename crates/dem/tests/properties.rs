//! Properties of scenes and tables, checked on random input. The generators are deterministic, and the fuzz targets use
//! the same ones.
//!
//! Each property is a function of bytes, defined in `cannonpile_testkit` together with planted faults that it must
//! detect. A failure prints the shortest bytes that proptest found, and the input that they describe.

use cannonpile::lattice::Dimension;
use cannonpile_dem::Error;
use cannonpile_dem::scene::{Scene, parse};
use cannonpile_testkit::claims;
use cannonpile_testkit::generators::{scene, text};
use cannonpile_testkit::properties;
use cannonpile_testkit::properties::census;

properties! {
    scenes_are_made_or_refused: claims::scene::any_scene, 512;
    parsers_survive_any_text: claims::options::any_text, 1024;
    layers_are_read_as_they_are_printed: claims::options::layers, 512;
    words_are_read_as_they_are_printed: claims::options::any_word, 2048;
    scenes_are_written_and_read_back: claims::scene_file::written, 512;
    scene_files_are_read_or_refused: claims::scene_file::any_file, 1024;
    numbers_in_scene_files_are_exact: claims::scene_file::a_number, 512;
    any_file_of_measured_forces_is_read_or_refused: claims::measured::any_file, 1024;
    any_table_of_another_code_is_compared_or_refused: claims::measured::any_table, 512;
    measured_forces_are_read_as_written: claims::measured::a_file, 512;
    contacts_in_files_of_vtk_are_read_as_written: claims::vtk::written, 512;
    damaged_files_of_vtk_are_read_or_refused: claims::vtk::damaged, 1024;
    any_file_like_one_of_vtk_is_read_or_refused: claims::vtk::any_file, 1024;
    tables_are_accepted_by_place_in_any_frame: claims::measured::by_place, 192;
    a_fault_among_measured_forces_is_found: claims::measured::injected_fault, 256;
    a_fault_among_repeated_pairs_is_found: claims::measured::repeated_pairs, 512;
    exact_tables_are_read_whole_in_any_dialect: claims::dialect::exact_table, 10_000;
    a_fault_is_found_in_any_dialect: claims::dialect::planted_fault, 10_000;
    a_planted_order_of_accuracy_is_found: claims::refinement::given_order, 1024;
    any_refinement_study_is_reported: claims::refinement::any_levels, 1024;
}

/// Few dialects are refused.
#[test]
fn tables_of_most_dialects_are_accepted() {
    let kinds = census(|u| Ok(claims::dialect::outcome(u).expect("a table")));
    let all: u32 = kinds.values().sum();
    assert!(kinds["accepted"] * 10 > all * 9, "{kinds:?}");
}

#[test]
fn texts_are_accepted_and_refused() {
    let kinds = census(|u| {
        let text = text::any(u)?;
        let number = parse::rational(&text).is_ok();
        let site = parse::at(&text, Dimension::Three).is_ok();
        Ok(format!("number={number} site={site}"))
    });
    // Sites contain commas, numbers do not.
    assert_eq!(kinds.len(), 3, "{kinds:?}");
    assert!(kinds.values().all(|count| *count >= 10), "{kinds:?}");
}

#[test]
fn scene_files_are_of_every_kind() {
    let kinds = census(|u| {
        let file = scene::file(u)?;
        Ok(match Scene::from_toml(&file) {
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
