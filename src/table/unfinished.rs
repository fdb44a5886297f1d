//! What is written aside and not complete yet, so that a signal can have it removed.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Files written aside, and folders made for them, in the order in which they were begun.
struct Unfinished {
    paths: Vec<PathBuf>,
    /// Whether the process is about to end.
    closed: bool,
}

static UNFINISHED: Mutex<Unfinished> = Mutex::new(Unfinished {
    paths: Vec::new(),
    closed: false,
});

fn unfinished() -> MutexGuard<'static, Unfinished> {
    // A list of paths is whole whatever happened to who held it.
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes every file that is being written aside, and every new folder that has nothing else in it; no other is begun
/// afterwards.
///
/// It is for a handler of signals, right before it ends the process: [`write_aside`](super::write_aside) and
/// [`PileExport::write`](super::PileExport::write) clean up after an error by themselves.
///
/// # Examples
/// ```standalone_crate
/// use cannonpile::export::{WriteError, remove_unfinished, write_aside};
///
/// let folder = tempfile::tempdir()?;
/// let written = write_aside(&folder.path().join("base.csv"), |out| {
///     out.write_all(b"i,j")?;
///     // A signal arrives.
///     remove_unfinished();
///     Ok(())
/// });
/// assert!(matches!(written, Err(WriteError::Io(_))));
/// assert_eq!(folder.path().read_dir()?.count(), 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn remove_unfinished() {
    let mut unfinished = unfinished();
    unfinished.closed = true;
    // Files before the folders that they are in.
    while let Some(path) = unfinished.paths.pop() {
        // What is gone is finished, and a folder with something else in it stays.
        let _ = fs::remove_file(&path).or_else(|_| fs::remove_dir(&path));
    }
}

/// A path that is removed if the process is ended before this is dropped.
#[derive(Debug)]
pub(crate) struct Begun(PathBuf);

impl Begun {
    /// Fails if the process is about to end: what was begun is to be removed then.
    pub(crate) fn new(path: &Path) -> io::Result<Self> {
        let mut unfinished = unfinished();
        if unfinished.closed {
            return Err(io::ErrorKind::Interrupted.into());
        }
        unfinished.paths.push(path.to_owned());
        Ok(Self(path.to_owned()))
    }
}

impl Drop for Begun {
    fn drop(&mut self) {
        unfinished().paths.retain(|path| *path != self.0);
    }
}
