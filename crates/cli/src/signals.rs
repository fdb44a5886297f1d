//! A signal that ends the command takes away what it was writing aside.

/// Removes the files written aside when SIGINT or SIGTERM arrives, and exits with 130 or 143, as a shell reports these
/// signals.
#[cfg(unix)]
pub(crate) fn clean_up_after() {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    // Without a handler the next command that writes there still finds what was left.
    let Ok(mut signals) = Signals::new([SIGINT, SIGTERM]) else {
        return;
    };
    std::thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            cannonpile_dem::table::remove_unfinished();
            std::process::exit(128 + signal);
        }
    });
}

/// Leaves signals as they are, where there are none.
#[cfg(not(unix))]
pub(crate) const fn clean_up_after() {}
