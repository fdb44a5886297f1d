//! The pieces of a file, and the files that it names in their place.

use std::borrow::Cow;

use super::legacy;
use super::piece::Piece;
use super::xml;
use crate::error::{Error, quoted, shortened};
use crate::kind::FileKind;

/// Returns the content of a file beside the one that is read, by its path from there.
pub(crate) type Open<'o> = &'o dyn Fn(&str) -> Result<Vec<u8>, Error>;

/// The largest number of files that are opened.
const MOST: usize = 1 << 16;

/// A file with pieces.
pub(super) struct Leaf<'b> {
    /// The name of the file, or nothing for the file that is read.
    name: String,
    bytes: Cow<'b, [u8]>,
}

/// Returns the files with the pieces: this file, or those that it names.
pub(super) fn gather<'b>(bytes: &'b [u8], open: Option<Open<'_>>) -> Result<Vec<Leaf<'b>>, Error> {
    let own = Leaf {
        name: String::new(),
        bytes: Cow::Borrowed(bytes),
    };
    let named = own.files()?;
    if named.is_empty() {
        return Ok(vec![own]);
    }
    let Some(open) = open else {
        let names: Vec<&str> = named.iter().map(String::as_str).collect();
        return Err(Error::vtk(format!(
            "the contacts are in other files: give {} instead",
            shortened(&names)
        )));
    };
    if named.len() > MOST {
        return Err(Error::vtk(format!("it names more than {MOST} files")));
    }
    let leaves = named.iter().map(|path| {
        let name = inside(path)?;
        let bytes = open(&name).map_err(|error| within(&name, error))?;
        let bytes = Cow::Owned(bytes);
        let leaf = Leaf { name, bytes };
        if leaf.files()?.is_empty() {
            return Ok(leaf);
        }
        leaf.named(Err(Error::vtk(
            "it names other files in turn: give it instead",
        )))
    });
    leaves.collect()
}

/// Returns a path of a file. Files outside the folder of the file that names them are refused.
fn inside(path: &str) -> Result<String, Error> {
    let path = path.trim().replace('\\', "/");
    let is_outside = path.is_empty()
        || path.starts_with('/')
        || path.contains("://")
        || path.get(1..2) == Some(":")
        || path.split('/').any(|part| part == "..");
    if is_outside {
        return Err(Error::vtk(format!(
            "the file {} is not in the folder of the collection: put it there, and name it without a folder",
            quoted(&path)
        )));
    }
    Ok(path)
}

impl Leaf<'_> {
    fn is_legacy(&self) -> bool {
        FileKind::of(&self.bytes) == FileKind::VtkLegacy
    }

    /// Returns the files that this file names in place of pieces.
    fn files(&self) -> Result<Vec<String>, Error> {
        if self.is_legacy() {
            return Ok(Vec::new());
        }
        self.named(xml::parse(&self.bytes).and_then(|document| {
            let (kind, files) = (quoted(&document.kind), document.files);
            match (&*document.kind, files.first()) {
                ("PolyData" | "UnstructuredGrid", _)
                | ("PPolyData" | "PUnstructuredGrid", Some(_)) => Ok(files),
                (_, None) => Err(Error::vtk(format!(
                    "a VTK file of type {kind} without files: contacts are in PolyData or UnstructuredGrid"
                ))),
                (_, Some(_)) => {
                    let names: Vec<&str> = files.iter().map(String::as_str).collect();
                    Err(Error::vtk(format!(
                        "a VTK file of type {kind} only names others: give the one with the contacts, of {}",
                        shortened(&names)
                    )))
                }
            }
        }))
    }

    /// Returns the pieces of this file.
    pub(super) fn pieces(&self) -> Result<Vec<Piece<'_>>, Error> {
        self.named(if self.is_legacy() {
            legacy::parse(&self.bytes).map(|piece| vec![piece])
        } else {
            xml::parse(&self.bytes).map(|document| document.pieces)
        })
    }

    /// Adds the name of this file to an error.
    pub(super) fn named<T>(&self, read: Result<T, Error>) -> Result<T, Error> {
        read.map_err(|error| {
            if self.name.is_empty() {
                error
            } else {
                within(&self.name, error)
            }
        })
    }
}

fn within(name: &str, error: Error) -> Error {
    match error {
        Error::Vtk(reason) => Error::vtk(format!("{}: {reason}", quoted(name))),
        Error::Io(error) => Error::vtk(format!("{}: {error}", quoted(name))),
        Error::Line { line, reason } => Error::Line {
            line,
            reason: format!("{}: {reason}", quoted(name)),
        },
        other => other,
    }
}
