//! How fast forces are found, against what they are worth comparing with: filling the same memory, plain floats, plain
//! rationals, a sparse solver.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench throughput`
//! prints, last, lines `ratio NAME VALUE`: medians of pairs that are
//! measured in turn in one run. With `-- --smoke` it only checks the answers, on small piles. Every answer is compared
//! with one that was found another way.

#[expect(dead_code, reason = "another bench uses the rest")]
#[path = "../peers/mod.rs"]
mod peers;

mod fill;
mod growth;
mod plain;
mod solver;
mod sweeps;
mod time;

/// How much is measured.
#[derive(Clone, Copy)]
pub(crate) struct Extent {
    /// Only that the answers are right.
    pub(crate) smoke: bool,
    /// Pairs of measurements.
    pub(crate) pairs: usize,
}

impl Extent {
    /// The size of a pile to measure, or one that is quickly checked.
    pub(crate) fn size(self, full: i128, smoke: i128) -> i128 {
        if self.smoke { smoke } else { full }
    }
}

fn main() {
    let smoke = std::env::args().any(|argument| argument == "--smoke");
    let extent = Extent {
        smoke,
        pairs: if smoke { 1 } else { 9 },
    };
    let mut results = Vec::new();
    on_one_thread(|| {
        fill::measure(extent, &mut results);
        sweeps::measure(extent, &mut results);
        solver::measure(extent, &mut results);
        growth::measure(extent, &mut results);
    });
    sweeps::measure_threads(extent, &mut results);
    for (name, value) in results {
        println!("ratio {name} {value:.2}");
    }
}

/// Times are compared thread by thread.
fn on_one_thread(measure: impl FnOnce() + Send) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread").install(measure);
}

/// What is printed at the end.
pub(crate) type Results = Vec<(String, f64)>;
