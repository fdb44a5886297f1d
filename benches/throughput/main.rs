//! The throughput of forces, compared with filling the same memory, plain floats, plain rationals and a sparse solver.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench throughput`
//! prints, last, lines `ratio NAME VALUE`: medians of ratios of two times, measured alternately in one run. With `-- --smoke`
//! it only asserts the results of small piles. Every result is compared with that of another method.

#[expect(dead_code, reason = "another bench uses the rest")]
#[path = "../peers/mod.rs"]
mod peers;

mod fill;
mod growth;
mod plain;
mod solver;
mod sweeps;
mod time;

/// The extent of the measurement.
#[derive(Clone, Copy)]
pub(crate) struct Extent {
    /// Assert the results only.
    pub(crate) smoke: bool,
    /// Measure this number of pairs of times.
    pub(crate) pairs: usize,
}

impl Extent {
    /// Returns the size of the pile to measure, or the small one for `--smoke`.
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

/// Runs a measurement on one thread.
fn on_one_thread(measure: impl FnOnce() + Send) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread").install(measure);
}

/// The ratios, printed at the end.
pub(crate) type Results = Vec<(String, f64)>;
