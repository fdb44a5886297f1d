//! The fixed and the exhaustive tests of piles with horizontal contacts, one file for each subject.
//!
//! Random tests are in `tests/properties.rs`. The oracles are those of `cannonpile_testkit`.

mod bounds;
mod census;
mod certificate;
mod error;
mod json;
mod near_ties;
mod rounded;
mod states;
mod tilts;

/// Returns all stackings with the given number of steps that begin with +.
fn stackings(steps: usize) -> impl Iterator<Item = String> {
    let all = cannonpile_testkit::cases::all_signs(steps);
    all.filter(|signs| signs.starts_with('+'))
}
