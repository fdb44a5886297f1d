//! Removal of temporary files when a signal ends the command.

/// Installs a handler of SIGINT and SIGTERM, which removes temporary files.
///
/// The handler exits with status 130 or 143, as a shell reports these signals.
#[cfg(unix)]
pub(crate) fn remove_files_on_signal() {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    // Without a handler the next command that writes to the same folder removes the leftover files.
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

/// Does nothing: other systems have no such signals.
#[cfg(not(unix))]
pub(crate) const fn remove_files_on_signal() {}
