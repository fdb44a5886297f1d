//! The threads of computations, and the memory that they share.

use std::io;

/// Starts the threads of computations: one for each core, but few if the memory of the process is limited.
///
/// # Errors
/// The system refuses a thread.
pub(crate) fn start() -> io::Result<()> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let chosen = std::env::var_os("RAYON_NUM_THREADS").is_some();
    let threads = match memory() {
        Some(bytes) if !chosen => at_most(cores, bytes),
        // Rayon reads its variable.
        _ => 0,
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build_global().map_err(io::Error::other)
}

/// The address space for each thread: its stack, and what it computes.
const OF_A_THREAD: u64 = 128 << 20;

/// Returns the number of threads in a process with this much address space: at least one.
fn at_most(cores: usize, bytes: u64) -> usize {
    let few = usize::try_from(bytes / OF_A_THREAD).unwrap_or(usize::MAX);
    cores.min(few).max(1)
}

/// Returns the limit of the address space of this process, in bytes.
#[cfg(unix)]
fn memory() -> Option<u64> {
    rustix::process::getrlimit(rustix::process::Resource::As).current
}

/// Returns no limit.
#[cfg(not(unix))]
const fn memory() -> Option<u64> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn little_memory_means_few_threads() {
        for (cores, megabytes, threads) in [
            (64, 100, 1),
            (64, 200, 1),
            (64, 300, 2),
            (64, 1024, 8),
            (2, 1024, 2),
            (1, 0, 1),
        ] {
            assert_eq!(at_most(cores, megabytes << 20), threads, "{megabytes} MB");
        }
    }
}
