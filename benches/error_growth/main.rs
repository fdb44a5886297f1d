//! How the rounding errors of sweeps grow with the number of layers.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench error_growth --features half` writes `work_precision/errors.csv`,
//! from which the chart is drawn, and prints the worst stackings and loads that a search finds. With `-- --search` it only
//! searches. No time is measured: the numbers are the same on every machine. With `-- --smoke` it checks the first rows of the
//! table.
//!
//! The unit of all errors is u·F, with the unit roundoff u of the format and the greatest contact force F above the floor.
//! The column `error` is the error of the worst of these contacts, and `mean` the mean of all, with its sign. Up to 160 layers
//! the exact forces are rationals; beyond, and in the search, they are double-doubles, whose own error is below 2^−40 units.

mod format;
mod growth;
mod random;
mod search;

use std::env;

use format::{Brain, Half};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/work_precision/errors.csv");

fn main() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1);
    one.build_global().expect("the first pool");
    if env::args().any(|argument| argument == "--smoke") {
        let written = std::fs::read_to_string(FILE).expect("the table");
        for row in growth::table(true).lines() {
            assert!(written.lines().any(|line| line == row), "{row} is new");
        }
        search::print::<Half>(4, 3, Some(5));
        return;
    }
    if env::args().all(|argument| argument != "--search") {
        std::fs::write(FILE, growth::table(false)).expect("a place for the table");
    }
    for layers in [10, 40, 160] {
        let (steps, more) = (40_000 / layers, (layers == 160).then_some(1000));
        search::print::<Half>(layers, steps, None);
        search::print::<Brain>(layers, steps, None);
        search::print::<f32>(layers, steps, more);
        search::print::<f64>(layers, steps, more);
    }
}
