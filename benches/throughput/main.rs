//! Compares the time to compute contact forces with other times: of filling the same memory, of hand-written loops, of plain
//! floats, of plain rationals and of a sparse solver.
//!
//! `cargo bench --manifest-path benches/Cargo.toml --bench throughput`
//! ends its output with lines `ratio NAME VALUE`. Each value is the median of ratios of two times, measured
//! alternately in one run. With `-- --smoke` the piles are small and each ratio is measured once, to test only the
//! results. Every result is compared with that of another method.

#[expect(dead_code, reason = "the other bench uses the rest")]
#[path = "../peers/mod.rs"]
mod peers;

mod fill;
mod growth;
mod limit;
mod plain;
mod solver;
mod sweeps;
mod time;

/// The extent of the measurement.
#[derive(Clone, Copy)]
pub(crate) struct Extent {
    /// `true` for small piles, which only test the results.
    pub(crate) smoke: bool,
    /// The number of pairs of times for each ratio.
    pub(crate) pairs: usize,
}

impl Extent {
    /// Returns `full`, or `smoke` with `--smoke`.
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
        limit::measure(extent, &mut results);
        solver::measure(extent, &mut results);
        growth::measure(extent, &mut results);
    });
    sweeps::measure_threads(extent, &mut results);
    limit::measure_threads(extent, &mut results);
    for (name, value) in results {
        println!("ratio {name} {value:.2}");
    }
}

/// Runs a measurement on one thread.
fn on_one_thread(measure: impl FnOnce() + Send) {
    pool(1).install(measure);
}

/// Starts a pool of threads.
pub(crate) fn pool(threads: usize) -> rayon::ThreadPool {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build().expect("threads")
}

/// The ratios, printed at the end.
pub(crate) type Results = Vec<(String, f64)>;
