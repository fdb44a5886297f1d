//! Sets of files that are written completely or not at all.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::{Aside, Pending, WriteError};

/// Writes files into a folder, which is created if necessary, and returns their sizes in bytes. Either all files are
/// written, or none.
///
/// `write` writes the contents of each file. All files are written under temporary names as by
/// [`write_aside`](super::write_aside), and renamed when the last one is complete. If a rename fails, new files and
/// folders are removed.
///
/// # Errors
/// The errors of `write`, and [`WriteError::File`] with the path.
///
/// # Examples
/// ```
/// use cannonpile_dem::table::write_all;
///
/// let folder = tempfile::tempdir()?;
/// let folder = folder.path().join("runs");
/// let files = [("a.txt", "one"), ("b.txt", "three")].map(|(name, text)| (folder.join(name), text));
/// let written = write_all(&folder, files, |text, out| Ok(out.write_all(text.as_bytes())?))?;
/// assert_eq!(written[1], (folder.join("b.txt"), 5));
/// assert_eq!(std::fs::read_to_string(&written[1].0)?, "three");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_all<T>(
    folder: &Path,
    files: impl IntoIterator<Item = (PathBuf, T)>,
    mut write: impl FnMut(T, &mut dyn Write) -> Result<(), WriteError>,
) -> Result<Vec<(PathBuf, u64)>, WriteError> {
    let mut new = New::default();
    new.folder(folder).map_err(|error| of(folder, error))?;
    let mut written = Vec::new();
    for (path, what) in files {
        let aside = Aside::write(&path, |out| write(what, out)).map_err(|error| match error {
            WriteError::Io(error) => of(&path, error),
            answer => answer,
        })?;
        written.push((path, aside));
    }
    // Nothing has been renamed yet. This loop detects obstacles such as a folder of the same name.
    let mut all = Vec::new();
    for (path, aside) in written {
        let kept = new.announce(aside.target()).and_then(|()| aside.keep());
        let bytes = kept.map_err(|error| of(&path, error))?;
        all.push((path, bytes));
    }
    new.0.clear();
    Ok(all)
}

fn of(path: &Path, error: io::Error) -> WriteError {
    let path = path.to_owned();
    WriteError::File { path, error }
}

/// New folders and files in the order of their creation. They are removed unless all are kept.
#[derive(Default)]
struct New(Vec<Pending>);

impl New {
    /// Creates a folder and its parents.
    fn folder(&mut self, folder: &Path) -> io::Result<()> {
        // The error for an existing file would say that the folder exists.
        if folder.exists() && !folder.is_dir() {
            return Err(io::ErrorKind::NotADirectory.into());
        }
        let missing = folder
            .ancestors()
            .take_while(|path| *path != Path::new("") && !path.exists());
        let missing: Vec<&Path> = missing.collect();
        for path in missing.into_iter().rev() {
            match Pending::create(|| fs::create_dir(path), |()| path.to_path_buf()) {
                Ok(((), pending)) => self.0.push(pending),
                // Another process has created it.
                Err(_) if path.is_dir() => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// Records a path that is created next.
    fn announce(&mut self, path: &Path) -> io::Result<()> {
        if fs::symlink_metadata(path).is_err() {
            self.0.push(Pending::new(path)?);
        }
        Ok(())
    }
}

impl Drop for New {
    fn drop(&mut self) {
        for pending in self.0.iter().rev() {
            pending.remove();
        }
    }
}
