//! Tests of figures and of the viewer, a file for each subject.
//!
//! The tests parse the SVG of the figures. The piles of the viewer are the scenes of `cannonpile_testkit`.

mod disorder;
mod error;
mod figure;
mod horizontal;
mod shear;
mod svg;
mod viewer;
mod whole;
