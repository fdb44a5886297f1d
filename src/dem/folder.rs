//! Several files that are all there, or none.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::table::{Aside, Pending, WriteError, remove_leftovers};

/// Writes files into a folder, which is made if it is not there: all, or none; returns how many bytes each has.
///
/// `write` is called once for each file, in their order.
pub(super) fn write_all<'f>(
    folder: &Path,
    files: impl Iterator<Item = &'f PathBuf>,
    mut write: impl FnMut(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<Vec<u64>, WriteError> {
    let made = Made::folder(folder).map_err(|error| of(folder, error))?;
    remove_leftovers(folder);
    let mut written = Vec::new();
    for path in files {
        let aside = Aside::write(path, |out| write(out)).map_err(|error| match error {
            WriteError::Io(error) => of(path, error),
            answer => answer,
        })?;
        written.push((path, aside));
    }
    // Not one of them is there yet; a folder of the same name, or the like, is found out here.
    let (mut bytes, mut new) = (Vec::new(), New::default());
    for (path, aside) in written {
        let kept = new.expect(aside.target()).and_then(|()| aside.keep());
        bytes.push(kept.map_err(|error| of(path, error))?);
    }
    new.keep();
    made.keep();
    Ok(bytes)
}

fn of(path: &Path, error: io::Error) -> WriteError {
    let path = path.to_owned();
    WriteError::File { path, error }
}

/// Files that were not there before, removed again unless all are kept.
#[derive(Default)]
struct New(Vec<(PathBuf, Pending)>);

impl New {
    fn expect(&mut self, path: &Path) -> io::Result<()> {
        if fs::symlink_metadata(path).is_err() {
            self.0.push((path.to_owned(), Pending::new(path)?));
        }
        Ok(())
    }

    fn keep(mut self) {
        self.0.clear();
    }
}

impl Drop for New {
    fn drop(&mut self) {
        for (path, _) in &self.0 {
            // The failure that led here is the one to report.
            let _ = fs::remove_file(path);
        }
    }
}

/// Folders that were not there before, the innermost first, removed again unless they are kept.
struct Made(Vec<(PathBuf, Pending)>);

impl Made {
    fn folder(folder: &Path) -> io::Result<Self> {
        // What is there and is no folder would be said to exist already.
        if folder.exists() && !folder.is_dir() {
            return Err(io::ErrorKind::NotADirectory.into());
        }
        let missing = folder
            .ancestors()
            .take_while(|path| *path != Path::new("") && !path.exists());
        let mut missing: Vec<&Path> = missing.collect();
        // An interrupted program removes what was registered last first.
        missing.reverse();
        let pending = missing
            .iter()
            .map(|path| Ok((path.to_path_buf(), Pending::new(path)?)));
        let mut made = Self(pending.collect::<io::Result<_>>()?);
        made.0.reverse();
        fs::create_dir_all(folder)?;
        Ok(made)
    }

    fn keep(mut self) {
        self.0.clear();
    }
}

impl Drop for Made {
    fn drop(&mut self) {
        for (folder, _) in &self.0 {
            // One that has something in it by now stays.
            let _ = fs::remove_dir(folder);
        }
    }
}
