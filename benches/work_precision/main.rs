//! Run time against error, for every method in every scalar.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench work_precision`
//! computes all contact forces of some piles in every way there is, prints a table, and
//! writes it as CSV and as a log–log chart, to `work_precision.csv` and `work_precision.svg` in the directory of targets or to
//! `-- --csv FILE --svg FILE`. With `-- --smoke` it tries small piles once, and writes to `smoke.csv` and `smoke.svg` there;
//! with `-- --draw` it measures nothing, and draws the CSV that is there.
//!
//! The error is the greatest difference of a contact force from the exact one, in rational arithmetic, over the
//! greatest exact force; the exact forces are proved to be in equilibrium. 0 means that every force is exact. It is
//! asserted that exact methods have no error, that intervals hold the exact forces, and that no float is further off
//! than its bound. The time is the median of three runs, or of the only one if it takes over 10 s; which spheres touch,
//! and where they are, is given.

mod cases;
mod chart;
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
    let options = Options::read(env::args().skip(1));
    if !options.draw {
        measure(&options);
    }
    // From the table as it was written.
    chart::draw(&options.csv, &options.svg).expect("a table, and a place for the chart");
    println!("\n{}\n{}", options.csv.display(), options.svg.display());
}

fn measure(options: &Options) {
    let mut runs = Vec::new();
    for case in cases::cases(options.smoke) {
        let bench = Bench::new(case, if options.smoke { 1 } else { 3 });
        let first = runs.len();
        runs.extend(library::runs(&bench));
        runs.extend(others::runs(&bench));
        table::print(&runs[first..]);
    }
    table::write(&options.csv, &runs).expect("a place for the table");
}

struct Options {
    smoke: bool,
    /// Only the chart, from a table that is there.
    draw: bool,
    csv: PathBuf,
    svg: PathBuf,
}

impl Options {
    fn read(mut arguments: impl Iterator<Item = String>) -> Self {
        let (mut smoke, mut draw, mut csv, mut svg) = (false, false, None, None);
        while let Some(argument) = arguments.next() {
            let mut file = || PathBuf::from(arguments.next().expect("a file after its option"));
            match argument.as_str() {
                "--smoke" => smoke = true,
                "--draw" => draw = true,
                "--csv" => csv = Some(file()),
                "--svg" => svg = Some(file()),
                // Cargo's own.
                "--bench" => {}
                other => {
                    panic!("{other}: the options are --smoke, --draw, --csv FILE and --svg FILE")
                }
            }
        }
        let name = if smoke { "smoke" } else { "work_precision" };
        let default = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        Self {
            smoke,
            draw,
            csv: csv.unwrap_or_else(|| default.with_extension("csv")),
            svg: svg.unwrap_or_else(|| default.with_extension("svg")),
        }
    }
}

/// A pile, and what its forces are compared with.
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

    /// A row that says why there are no numbers.
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
