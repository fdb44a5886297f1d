//! Signals: temporary files are removed before a signal ends the command.

use std::io;

/// Installs handlers of the signals that end a process. They remove temporary files.
///
/// The handlers exit with status 128 + n for the signal n, as a shell reports it. A signal that is ignored at the start, as
/// `nohup` does it, stays ignored.
///
/// # Errors
/// The thread of the handlers cannot be started.
#[cfg(unix)]
pub(crate) fn remove_files_on_signal() -> io::Result<()> {
    use signal_hook::consts::{
        SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGSYS, SIGTERM, SIGTRAP, SIGUSR1, SIGUSR2,
        SIGVTALRM, SIGXCPU,
    };
    use signal_hook::iterator::Signals;

    let ending = [
        SIGALRM, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGSYS, SIGTERM, SIGTRAP, SIGUSR1, SIGUSR2,
        SIGVTALRM, SIGXCPU,
    ];
    // Without a handler hidden files stay.
    let Ok(mut signals) = Signals::new([0_i32; 0]) else {
        return Ok(());
    };
    let ignored = ignored();
    for signal in ending.into_iter().chain(OF_LINUX).chain(REAL_TIME) {
        if !contains(ignored, signal) {
            // The system may reserve some of these signals.
            let _ = signals.add_signal(signal);
        }
    }
    turn_aborts_into_errors();
    let handler = std::thread::Builder::new().spawn(move || {
        if let Some(signal) = signals.forever().next() {
            cannonpile_dem::table::remove_unfinished();
            std::process::exit(128 + signal);
        }
    });
    handler.map(drop)
}

/// SIGSTKFLT, SIGIO and SIGPWR, which end a process on Linux.
#[cfg(all(unix, target_os = "linux"))]
const OF_LINUX: [i32; 3] = [16, signal_hook::consts::SIGIO, 30];

#[cfg(all(unix, not(target_os = "linux")))]
const OF_LINUX: [i32; 0] = [];

/// The signals of real time. The system keeps two or three before them for itself.
#[cfg(unix)]
const REAL_TIME: core::ops::Range<i32> = if cfg!(target_os = "linux") {
    34..65
} else {
    0..0
};

/// Lets a file that is too large fail to be written. Lets a process without memory end with the status of an error.
#[cfg(unix)]
fn turn_aborts_into_errors() {
    use signal_hook::consts::{SIGABRT, SIGXFSZ};
    use signal_hook::flag;
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    // With a handler, which does nothing, the write returns an error.
    let _ = flag::register(SIGXFSZ, Arc::default());
    // Large requests are refused beforehand. This is for what remains: the allocator prints a line and aborts.
    let always = Arc::new(AtomicBool::new(true));
    let _ = flag::register_conditional_shutdown(SIGABRT, crate::error::USAGE_ERROR.into(), always);
}

/// Returns the signals that this process ignores, a bit for each, if the system tells them.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    ignored_in(&status)
}

/// Reads the signals that a process ignores in the text of `/proc/PID/status`.
#[cfg(unix)]
fn ignored_in(status: &str) -> u64 {
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.unwrap_or(0)
}

#[cfg(unix)]
fn contains(signals: u64, signal: i32) -> bool {
    let bit = u32::try_from(signal - 1).ok();
    let bit = bit.and_then(|bit| 1_u64.checked_shl(bit));
    bit.is_some_and(|bit| signals & bit != 0)
}

/// Does nothing: other systems have no such signals.
#[cfg(not(unix))]
pub(crate) const fn remove_files_on_signal() -> io::Result<()> {
    Ok(())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn ignored_signals_are_bits() {
        let of_nohup =
            ignored_in("Name:\tx\nSigBlk:\t0000000000000003\nSigIgn:\t0000000000001001\n");
        let named = (-1..=130).filter(|signal| contains(of_nohup, *signal));
        assert_eq!(named.collect::<Vec<_>>(), [1, 13]);
        assert_eq!(ignored_in(""), 0);
        assert_eq!(ignored_in("SigIgn:\tx\n"), 0);
    }
}
