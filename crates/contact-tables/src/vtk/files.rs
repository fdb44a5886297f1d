//! The content of a file, and the files that it names in place of pieces.

use super::legacy;
use super::xml;
use super::xml::Document;
use crate::error::{Error, quoted, shortened};
use crate::kind::FileKind;

/// Returns the content of a file beside the one that is read, by its path from there.
pub(crate) type Open<'o> = &'o dyn Fn(&str) -> Result<Vec<u8>, Error>;

/// The largest number of files that are opened.
const MOST: usize = 1 << 16;

/// Reads a file without decoding its arrays.
pub(super) fn parse(bytes: &[u8]) -> Result<Document<'_>, Error> {
    if FileKind::of(bytes) == FileKind::VtkLegacy {
        return Ok(Document {
            pieces: vec![legacy::parse(bytes)?],
            ..Document::default()
        });
    }
    let document = xml::parse(bytes)?;
    let (kind, files) = (quoted(&document.kind), &document.files);
    match (&*document.kind, files.first()) {
        ("PolyData" | "UnstructuredGrid", _) | ("PPolyData" | "PUnstructuredGrid", Some(_)) => {
            Ok(document)
        }
        (_, None) => Err(Error::Vtk(format!(
            "a VTK file of type {kind} without files: contacts are in PolyData or UnstructuredGrid"
        ))),
        (_, Some(_)) => Err(Error::Vtk(format!(
            "a VTK file of type {kind} only names others: give the one with the contacts, of {}",
            listed(files)
        ))),
    }
}

/// Returns the files that are named in place of pieces, with their names.
pub(super) fn opened(
    files: &[String],
    open: Option<Open<'_>>,
) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let Some(open) = open.filter(|_| files.len() <= MOST) else {
        return match files.len() {
            0 => Ok(Vec::new()),
            1..=MOST => Err(Error::Vtk(format!(
                "the contacts are in other files: give {} instead",
                listed(files)
            ))),
            _ => Err(Error::Vtk(format!("it names more than {MOST} files"))),
        };
    };
    let opened = files.iter().map(|path| {
        let name = inside(path)?;
        let bytes = named(&name, open(&name))?;
        Ok((name, bytes))
    });
    opened.collect()
}

fn listed(files: &[String]) -> String {
    let names: Vec<&str> = files.iter().map(String::as_str).collect();
    shortened(&names)
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
        return Err(Error::Vtk(format!(
            "the file {} is not in the folder of the file that names it: put it there, and name it without a folder",
            quoted(&path)
        )));
    }
    Ok(path)
}

/// Adds the name of a file to an error. The file that is read has an empty name.
pub(super) fn named<T>(name: &str, read: Result<T, Error>) -> Result<T, Error> {
    let within = |reason: String| match name {
        "" => reason,
        name => format!("{}: {reason}", quoted(name)),
    };
    read.map_err(|error| match error {
        Error::Vtk(reason) => Error::Vtk(within(reason)),
        Error::Io(error) if !name.is_empty() => Error::Vtk(within(error.to_string())),
        Error::Line { line, reason } => Error::Line {
            line,
            reason: within(reason),
        },
        Error::NoColumn { line, reason } => Error::NoColumn {
            line,
            reason: within(reason),
        },
        other => other,
    })
}
