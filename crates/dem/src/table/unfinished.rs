//! The temporary files of this process. An interrupted process can remove its files. Files of a killed process are
//! removed by the next process that writes into the same folder.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The prefix of locked temporary files, followed by six letters or digits.
pub(super) const PREFIX: &str = ".cannonpile-";

/// The prefix of temporary files that are not locked yet.
pub(super) const FRESH: &str = ".cannonpile-new-";

/// The time after which a file without a lock is considered abandoned.
const NEW: Duration = Duration::from_secs(60);

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

/// Locks a file of this process. The lock ends with the process, however the process ends.
pub(super) fn lock(file: &fs::File) -> bool {
    #[cfg(unix)]
    {
        use rustix::fs::{FlockOperation, flock};
        flock(file, FlockOperation::NonBlockingLockExclusive).is_ok()
    }
    #[cfg(not(unix))]
    {
        let _ = file;
        false
    }
}

/// Removes the files of killed processes from a folder: files with our prefixes and without a lock. Files that were
/// never locked are removed after a minute. On platforms without locks no file is removed.
pub(crate) fn remove_leftovers(folder: &Path) {
    let folder = if folder == Path::new("") {
        Path::new(".")
    } else {
        folder
    };
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let age = [(PREFIX, Duration::ZERO), (FRESH, NEW)]
            .into_iter()
            .find(|(prefix, _)| name.to_str().is_some_and(|name| is_ours(name, prefix)));
        if let Some((_, age)) = age {
            // Files that cannot be removed remain.
            let _ = remove_leftover(&entry, age);
        }
    }
}

fn is_ours(name: &str, prefix: &str) -> bool {
    let random = name.strip_prefix(prefix);
    random.is_some_and(|random| {
        random.len() == 6 && random.bytes().all(|byte| byte.is_ascii_alphanumeric())
    })
}

fn remove_leftover(entry: &fs::DirEntry, least: Duration) -> io::Result<()> {
    // The metadata of the entry itself; links are not followed.
    let metadata = entry.metadata()?;
    let age = metadata.modified()?.elapsed().unwrap_or(Duration::ZERO);
    if metadata.is_file() && age >= least && lock(&fs::File::open(entry.path())?) {
        fs::remove_file(entry.path())?;
    }
    Ok(())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn removes_only_files_of_killed_processes() {
        let folder = tempfile::tempdir().unwrap();
        let hour = Duration::from_secs(3600);
        let make = |name: &str, age| {
            let file = fs::File::create(folder.path().join(name)).unwrap();
            let modified = std::time::SystemTime::now() - age;
            file.set_modified(modified).unwrap();
            file
        };
        make(".cannonpile-left01", hour);
        make(".cannonpile-left02", Duration::ZERO);
        make(".cannonpile-new-left03", hour);
        make(".cannonpile-new-fresh1", Duration::ZERO);
        make(".cannonpile-notours", hour);
        make(".cannonpile-0000.x", hour);
        make("left01", hour);
        let locked = make(".cannonpile-locked", hour);
        assert!(lock(&locked));
        remove_leftovers(folder.path());
        let names = folder.path().read_dir().unwrap();
        let mut names: Vec<_> = names.map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(
            names,
            [
                ".cannonpile-0000.x",
                ".cannonpile-locked",
                ".cannonpile-new-fresh1",
                ".cannonpile-notours",
                "left01"
            ]
        );
        // Dropping the file releases its lock, like the end of the process.
        drop(locked);
        remove_leftovers(folder.path());
        assert_eq!(folder.path().read_dir().unwrap().count(), 4);
    }
}
