//! The temporary files of this process, which an interrupted process can remove.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The prefix of temporary files, followed by six letters or digits.
pub(super) const PREFIX: &str = ".cannonpile-";

/// The incomplete files and folders of this process.
struct Unfinished {
    paths: Vec<PathBuf>,
    /// Whether new files are rejected.
    closed: bool,
}

static UNFINISHED: Mutex<Unfinished> = Mutex::new(Unfinished {
    paths: Vec::new(),
    closed: false,
});

fn unfinished() -> MutexGuard<'static, Unfinished> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all temporary files of this process, and the folders created for them. Afterwards no file can be begun or
/// completed. This function is for a thread that handles a signal, such as SIGINT or SIGTERM, and then exits.
///
/// # Examples
/// ```standalone_crate
/// use cannonpile_dem::table;
///
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("base.csv");
/// let interrupted = table::write_aside(&path, |out| {
///     out.write_all(b"i,j\n")?;
///     Ok(table::remove_unfinished())
/// });
/// assert!(interrupted.is_err());
/// assert_eq!(folder.path().read_dir()?.count(), 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn remove_unfinished() {
    let mut unfinished = unfinished();
    unfinished.closed = true;
    // Files come after the folders created for them.
    for path in unfinished.paths.drain(..).rev() {
        remove(&path);
    }
}

fn remove(path: &Path) {
    // Errors, such as that of a folder that is not empty, are ignored: no caller could handle them.
    let _ = fs::remove_file(path).or_else(|_| fs::remove_dir(path));
}

/// A path that is unfinished until this value is dropped.
#[derive(Debug)]
pub(crate) struct Pending(PathBuf);

impl Pending {
    /// # Errors
    /// [`io::ErrorKind::Interrupted`] once [`remove_unfinished`] has been called.
    pub(crate) fn new(path: &Path) -> io::Result<Self> {
        Self::create(|| Ok(path), |path| path.to_path_buf()).map(|(_, pending)| pending)
    }

    /// Creates a file or folder. The lock is held meanwhile, so that every path which exists is known.
    ///
    /// # Errors
    /// Those of `create`, and [`io::ErrorKind::Interrupted`] once [`remove_unfinished`] has been called.
    pub(crate) fn create<T>(
        create: impl FnOnce() -> io::Result<T>,
        path: impl FnOnce(&T) -> PathBuf,
    ) -> io::Result<(T, Self)> {
        let mut unfinished = unfinished();
        if unfinished.closed {
            return Err(io::ErrorKind::Interrupted.into());
        }
        let created = create()?;
        let path = path(&created);
        unfinished.paths.push(path.clone());
        drop(unfinished);
        Ok((created, Self(path)))
    }

    /// Removes the file or folder.
    pub(crate) fn remove(&self) {
        remove(&self.0);
    }

    /// Completes the path by `complete`, unless it has been removed.
    pub(super) fn complete<T>(self, complete: impl FnOnce() -> io::Result<T>) -> io::Result<T> {
        // The lock is held meanwhile, so that the path is either completed or removed.
        let mut unfinished = unfinished();
        if unfinished.closed {
            return Err(io::ErrorKind::Interrupted.into());
        }
        unfinished.paths.retain(|path| *path != self.0);
        let completed = complete();
        drop(unfinished);
        completed
    }
}

impl Drop for Pending {
    fn drop(&mut self) {
        unfinished().paths.retain(|path| *path != self.0);
    }
}
