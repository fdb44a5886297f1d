//! The fixed and the exhaustive tests of figures and of the page, a file for each subject.
//!
//! Figures are read back from their SVG. The piles of the page are the scenes of `cannonpile_testkit`.

mod disorder;
mod error;
mod figure;
mod horizontal;
mod ladder;
mod shear;
mod svg;
mod viewer;
mod whole;
