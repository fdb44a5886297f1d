//! A work–precision diagram: run time and error of every method in every scalar.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench work_precision --features all`
//! computes all contact forces of some piles with every method, prints a table, and writes it as CSV to `work_precision.csv`
//! in the target folder or to `-- --csv FILE`. With `-- --smoke` it runs small piles once, and writes `smoke.csv`. The bench
//! `chart` draws `results.csv`, and `peers.csv` with the times of other programs that `side_by_side --csv` writes.
//!
//! The error is the largest difference between a contact force and the exact one, relative to the largest exact force, in
//! rational arithmetic. The exact forces are checked to be in equilibrium. The bench asserts that exact methods have no
//! error, that intervals contain the exact forces, and that floats are within their bounds.
//!
//! The time is the median of three runs, or a single run if it takes more than 10 s. It does not include the geometry of the
//! pile.

mod cases;
mod library;
mod others;
#[path = "../peers/mod.rs"]
mod peers;
mod reference;
mod run;
mod table;

use std::env;
use std::path::{Path, PathBuf};

use cases::Case;
use peers::network::Network;
use reference::Reference;
use run::{Measured, Method, Run};

fn main() {
    let Options { smoke, csv } = Options::read(env::args().skip(1));
    let mut runs = Vec::new();
    for case in cases::cases(smoke) {
        let bench = Bench::new(case, if smoke { 1 } else { 3 });
        let first = runs.len();
        runs.extend(library::runs(&bench));
        runs.extend(others::runs(&bench));
        table::print(&runs[first..]);
    }
    table::write(&csv, &runs).expect("a place for the table");
    println!("\n{}", csv.display());
}

struct Options {
    smoke: bool,
    csv: PathBuf,
}

impl Options {
    fn read(mut arguments: impl Iterator<Item = String>) -> Self {
        let (mut smoke, mut csv) = (false, None);
        while let Some(argument) = arguments.next() {
            match argument.as_str() {
                "--smoke" => smoke = true,
                "--csv" => {
                    csv = Some(PathBuf::from(arguments.next().expect("a file after --csv")));
                }
                // Options that Cargo adds.
                "--bench" => {}
                other => panic!("{other}: the options are --smoke and --csv FILE"),
            }
        }
        let name = if smoke {
            "smoke.csv"
        } else {
            "work_precision.csv"
        };
        let csv = csv.unwrap_or_else(|| Path::new(env!("CARGO_TARGET_TMPDIR")).join(name));
        Self { smoke, csv }
    }
}

/// A pile and its reference forces.
pub(crate) struct Bench {
    pub(crate) case: Case,
    pub(crate) network: Network,
    pub(crate) reference: Reference,
    pub(crate) repetitions: usize,
}

impl Bench {
    fn new(case: Case, repetitions: usize) -> Self {
        let network = Network::new(&case.pile);
        Self {
            reference: Reference::new(&case.pile, &network),
            network,
            case,
            repetitions,
        }
    }

    /// A row of the table.
    pub(crate) fn run(&self, method: Method, scalar: &'static str, measured: Measured) -> Run {
        Run {
            pile: self.case.name.clone(),
            contacts: self.case.contacts(),
            method,
            scalar,
            setting: String::new(),
            outcome: Ok(measured),
            remark: String::new(),
        }
    }

    /// Adds a row with the reason of missing numbers.
    pub(crate) fn without(&self, method: Method, scalar: &'static str, why: &str) -> Run {
        let unmeasured = Measured {
            seconds: f64::NAN,
            error: f64::NAN,
        };
        Run {
            outcome: Err(why.into()),
            ..self.run(method, scalar, unmeasured)
        }
    }
}
