//! The compiled part of the Python package `cannonpile`: its class and functions.
//!
//! It contains no mathematics. It converts the results of the library to Python integers and fractions and to NumPy
//! arrays. Users see the Python module `cannonpile`.

mod array;
mod census;
mod comparison;
mod error;
mod exception;
mod figure;
mod input;
mod mean;
mod numbers;
mod pile;
mod theorem;
mod work;

use pyo3::prelude::*;

/// The compiled part of the package cannonpile.
#[pymodule]
mod _cannonpile {
    /// The version of the package and of the library.
    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "the name that Python requires")]
    const __version__: &str = env!("CARGO_PKG_VERSION");

    #[pymodule_export]
    use crate::census::{Census, census};
    #[pymodule_export]
    use crate::comparison::Comparison;
    #[pymodule_export]
    use crate::mean::mean;
    #[pymodule_export]
    use crate::pile::answers::{
        bounds, force, on_floor, response, sensitivity, site, sphere_id, spread, stability, weakest,
    };
    #[pymodule_export]
    use crate::pile::arrays::{
        base, contact_ids, contact_points, forces, long_multiples, multiples, positions, sites,
        stresses, vectors,
    };
    #[pymodule_export]
    use crate::pile::rough::{
        RoughFloor, compare_rough, compare_rough_tables, export_rough, friction_cases, rough_base,
        rough_contacts,
    };
    #[pymodule_export]
    use crate::pile::tools::{compare, export, page, plot};
    #[pymodule_export]
    use crate::pile::{Pile, cases};
    #[pymodule_export]
    use crate::theorem::prove;
}
