//! Several files that are all there, or none.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::{PileExport, PileFormat, Written};
use crate::table::Aside;
use crate::table::{Begun, WriteError};

pub(super) fn write(
    export: &PileExport<'_>,
    formats: &[PileFormat],
    folder: &Path,
    progress: &mut dyn FnMut(u64),
) -> Result<Vec<Written>, WriteError> {
    let mut formats = formats.to_vec();
    formats.sort_unstable();
    formats.dedup();
    let made = Made::folder(folder).map_err(|error| of(folder, error))?;
    let mut written = Vec::new();
    for file in formats.iter().flat_map(|format| format.files()) {
        let path = folder.join(file.name());
        let aside = Aside::write(&path, |out| export.write_file(*file, out, progress));
        let aside = aside.map_err(|error| match error {
            WriteError::Io(error) => of(&path, error),
            answer => answer,
        })?;
        written.push((*file, path, aside));
    }
    // Not one of them is there yet; a folder of the same name, or the like, is found out here.
    let (mut kept, mut new) = (Vec::new(), New::default());
    for (file, path, aside) in written {
        new.expect(aside.target());
        let bytes = aside.keep().map_err(|error| of(&path, error))?;
        let rows = export.rows(file);
        kept.push(Written {
            file,
            path,
            rows,
            bytes,
        });
    }
    new.keep();
    made.keep();
    Ok(kept)
}

fn of(path: &Path, error: io::Error) -> WriteError {
    let path = path.to_owned();
    WriteError::File { path, error }
}

/// Files that were not there before, removed again unless all are kept.
#[derive(Default)]
struct New(Vec<PathBuf>);

impl New {
    fn expect(&mut self, path: &Path) {
        if fs::symlink_metadata(path).is_err() {
            self.0.push(path.to_owned());
        }
    }

    fn keep(mut self) {
        self.0.clear();
    }
}

impl Drop for New {
    fn drop(&mut self) {
        for path in &self.0 {
            // The failure that led here is the one to tell.
            let _ = fs::remove_file(path);
        }
    }
}

/// Folders that were not there before, the innermost first, removed again unless they are kept.
struct Made {
    folders: Vec<PathBuf>,
    /// Of the folders, the outermost first.
    begun: Vec<Begun>,
}

impl Made {
    fn folder(folder: &Path) -> io::Result<Self> {
        // What is there and is no folder would be said to exist already.
        if folder.exists() && !folder.is_dir() {
            return Err(io::ErrorKind::NotADirectory.into());
        }
        let missing = folder
            .ancestors()
            .take_while(|path| *path != Path::new("") && !path.exists());
        let mut made = Self {
            folders: missing.map(Path::to_owned).collect(),
            begun: Vec::new(),
        };
        fs::create_dir_all(folder)?;
        for folder in made.folders.iter().rev() {
            made.begun.push(Begun::new(folder)?);
        }
        Ok(made)
    }

    fn keep(mut self) {
        self.folders.clear();
    }
}

impl Drop for Made {
    fn drop(&mut self) {
        for folder in &self.folders {
            // One that has something in it by now stays.
            let _ = fs::remove_dir(folder);
        }
    }
}
