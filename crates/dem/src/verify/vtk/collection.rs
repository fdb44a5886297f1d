//! The pieces of a file, and the files that a collection names.

use std::borrow::Cow;

use super::super::format::{is_same_step, shortened};
use super::super::kind::FileKind;
use super::super::refusal::Refusal;
use super::legacy;
use super::piece::Piece;
use super::refused;
use super::xml::{self, File};
use crate::error::quoted;

/// Returns the content of a file beside the one that is read, by its path from there.
pub(in super::super) type Open<'o> = &'o dyn Fn(&str) -> Result<Vec<u8>, Refusal>;

/// The largest depth of files that name files. A collection names parts, and these name pieces.
const DEEPEST: u32 = 4;
/// The largest number of files that are opened.
const MOST: usize = 1 << 16;

/// A file with pieces.
pub(super) struct Leaf<'b> {
    /// The name of the file, or nothing for the file that is read.
    name: String,
    bytes: Cow<'b, [u8]>,
}

/// Returns the files with the pieces of a time step, or of the last one, the number of time steps of the collection, and the
/// chosen one.
pub(super) fn gather<'b>(
    bytes: &'b [u8],
    step: Option<&str>,
    open: Option<Open<'_>>,
) -> Result<(Vec<Leaf<'b>>, u64, Option<String>), Refusal> {
    let own = Leaf {
        name: String::new(),
        bytes: Cow::Borrowed(bytes),
    };
    let named = own.files()?;
    let (named, steps, step) = chosen(named, step)?;
    if named.is_empty() {
        return Ok((vec![own], steps, step));
    }
    let Some(open) = open else {
        let names: Vec<&str> = named.iter().map(|file| file.path.as_str()).collect();
        return Err(refused(format!(
            "the contacts are in other files: give {} instead",
            shortened(&names)
        )));
    };
    let mut leaves = Vec::new();
    let mut opened = 0;
    load(&named, "", open, DEEPEST, (&mut opened, &mut leaves))?;
    Ok((leaves, steps, step))
}

/// Chooses the files of a time step, or of the last one.
fn chosen(
    mut files: Vec<File>,
    step: Option<&str>,
) -> Result<(Vec<File>, u64, Option<String>), Refusal> {
    let time = |text: &str| text.trim().parse::<f64>().ok();
    let mut steps: Vec<&str> = files
        .iter()
        .filter_map(|file| file.timestep.as_deref())
        .collect();
    if steps.iter().all(|text| time(text).is_some()) {
        steps.sort_by(|a, b| {
            time(a)
                .partial_cmp(&time(b))
                .unwrap_or(core::cmp::Ordering::Equal)
        });
    }
    steps.dedup();
    let last = match step {
        None => steps.last().copied(),
        Some(step) => {
            let found = steps
                .iter()
                .copied()
                .find(|known| is_same_step(step, known));
            Some(found.ok_or_else(|| Refusal::NoStep {
                wanted: shortened(&[step]),
                found: shortened(&steps),
            })?)
        }
    };
    let (count, last) = (steps.len() as u64, last.map(str::to_owned));
    files.retain(|file| file.timestep.is_none() || file.timestep == last);
    Ok((files, count, last))
}

/// Opens files, and the files that they name in turn.
fn load(
    files: &[File],
    folder: &str,
    open: Open<'_>,
    depth: u32,
    (opened, leaves): (&mut usize, &mut Vec<Leaf<'_>>),
) -> Result<(), Refusal> {
    for file in files {
        let name = beside(folder, &file.path)?;
        *opened += 1;
        if depth == 0 || *opened > MOST {
            return Err(refused(format!(
                "{}: files name files more than {DEEPEST} deep, or more than {MOST} in all",
                quoted(&name)
            )));
        }
        let bytes = open(&name).map_err(|refusal| within(&name, refusal))?;
        let leaf = Leaf {
            name,
            bytes: Cow::Owned(bytes),
        };
        let (named, ..) = chosen(leaf.files()?, None)?;
        if named.is_empty() {
            leaves.push(leaf);
            continue;
        }
        let folder = leaf.name.rsplit_once('/').map_or("", |(folder, _)| folder);
        load(&named, folder, open, depth - 1, (opened, leaves))?;
    }
    Ok(())
}

/// Returns the path of a file that a file in `folder` names. Files outside the folder of the first file are refused.
fn beside(folder: &str, path: &str) -> Result<String, Refusal> {
    let path = path.trim().replace('\\', "/");
    let is_outside = path.is_empty()
        || path.starts_with('/')
        || path.contains("://")
        || path.get(1..2) == Some(":")
        || path.split('/').any(|part| part == "..");
    if is_outside {
        return Err(refused(format!(
            "the file {} is not in the folder of the collection: put it there, and name it without a folder",
            quoted(&path)
        )));
    }
    Ok(if folder.is_empty() {
        path
    } else {
        format!("{folder}/{path}")
    })
}

impl Leaf<'_> {
    fn is_legacy(&self) -> bool {
        FileKind::of(&self.bytes) == FileKind::VtkLegacy
    }

    /// Returns the files that this file names in place of pieces.
    fn files(&self) -> Result<Vec<File>, Refusal> {
        if self.is_legacy() {
            return Ok(Vec::new());
        }
        self.named(xml::parse(&self.bytes).and_then(|document| {
            let has_pieces = ["PolyData", "UnstructuredGrid"].contains(&&*document.kind);
            if has_pieces || !document.files.is_empty() {
                Ok(document.files)
            } else {
                Err(refused(format!(
                    "a VTK file of type {} without files: contacts are in PolyData or UnstructuredGrid",
                    quoted(&document.kind)
                )))
            }
        }))
    }

    /// Returns the pieces of this file.
    pub(super) fn pieces(&self) -> Result<Vec<Piece<'_>>, Refusal> {
        self.named(if self.is_legacy() {
            legacy::parse(&self.bytes).map(|piece| vec![piece])
        } else {
            xml::parse(&self.bytes).map(|document| document.pieces)
        })
    }

    /// Adds the name of this file to a refusal.
    pub(super) fn named<T>(&self, read: Result<T, Refusal>) -> Result<T, Refusal> {
        read.map_err(|refusal| {
            if self.name.is_empty() {
                refusal
            } else {
                within(&self.name, refusal)
            }
        })
    }
}

fn within(name: &str, refusal: Refusal) -> Refusal {
    match refusal {
        Refusal::Vtk(reason) => refused(format!("{}: {reason}", quoted(name))),
        Refusal::Io(error) => refused(format!("{}: {error}", quoted(name))),
        other => other,
    }
}
