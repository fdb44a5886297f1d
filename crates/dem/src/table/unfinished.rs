//! What is being written aside: a program that is interrupted can remove it, and one that was killed has it removed by
//! the next that writes into the same folder.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// What the names of files begin with that are not complete yet, and locked by who writes them; six letters or digits follow.
pub(super) const PREFIX: &str = ".cannonpile-";

/// What they begin with until they are locked.
pub(super) const FRESH: &str = ".cannonpile-new-";

/// Who has made a file has locked it within this time, if it lives.
const NEW: Duration = Duration::from_secs(60);

/// Files and folders of this process that are not complete.
struct Unfinished {
    paths: Vec<PathBuf>,
    /// Nothing more is begun.
    closed: bool,
}

static UNFINISHED: Mutex<Unfinished> = Mutex::new(Unfinished {
    paths: Vec::new(),
    closed: false,
});

fn unfinished() -> MutexGuard<'static, Unfinished> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all files that this process is writing aside, and the folders made for them, and lets none be begun or
/// completed any more: for a thread that has received SIGINT or SIGTERM, and exits next.
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
    // Files stand after the folders that were made for them.
    for path in unfinished.paths.drain(..).rev() {
        remove(&path);
    }
}

fn remove(path: &Path) {
    // What cannot be removed stays, as a folder with something in it: there is nobody to report it to.
    let _ = fs::remove_file(path).or_else(|_| fs::remove_dir(path));
}

/// A path that is unfinished until this is dropped.
#[derive(Debug)]
pub(crate) struct Pending(PathBuf);

impl Pending {
    /// # Errors
    /// [`io::ErrorKind::Interrupted`] once [`remove_unfinished`] has been called.
    pub(crate) fn new(path: &Path) -> io::Result<Self> {
        let mut unfinished = unfinished();
        if unfinished.closed {
            return Err(io::ErrorKind::Interrupted.into());
        }
        unfinished.paths.push(path.to_owned());
        Ok(Self(path.to_owned()))
    }

    /// Removes what is there.
    pub(crate) fn remove(&self) {
        remove(&self.0);
    }

    /// Does what completes the path, unless it has been removed.
    pub(super) fn complete<T>(self, complete: impl FnOnce() -> io::Result<T>) -> io::Result<T> {
        // Held meanwhile: either it is there in the end, or removed.
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

/// Marks a file as that of a living process: a lock, which ends with it however it ends.
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

/// Removes what a process that was killed has left in a folder: files with our names that no process holds a lock on, those
/// that were never locked if they are a minute old. Where there are no locks, none is removed.
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
            // What cannot be removed stays.
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
    // Of the entry itself: a link is not followed.
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
    fn what_a_killed_process_left_is_removed_and_nothing_else() {
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
        // Its process has ended.
        drop(locked);
        remove_leftovers(folder.path());
        assert_eq!(folder.path().read_dir().unwrap().count(), 4);
    }
}
