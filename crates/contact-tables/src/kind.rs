//! The kind of a file, by its first bytes.

use core::fmt;

/// The kind of a file.
///
/// # Examples
/// ```
/// use contact_tables::FileKind;
///
/// assert_eq!(FileKind::of(b"ITEM: TIMESTEP\n500\n"), FileKind::Dump);
/// assert_eq!(FileKind::of(b"<!DOCTYPE html><html>").to_string(), "an HTML page");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileKind {
    /// A text with one contact on each line.
    Table,
    /// A `dump local` file of LAMMPS.
    Dump,
    /// A file of VTK in XML: `.vtp`, `.vtu`, or the `.pvtp`, `.pvtu` that name such files.
    VtkXml,
    /// A file of VTK in the format before XML.
    VtkLegacy,
    /// Any other kind, which is not read.
    Other {
        /// The kind in words, such as `an HTML page`.
        is: &'static str,
        /// The remedy, such as `save the table as CSV`.
        remedy: &'static str,
    },
}

const AS_CSV: &str = "save the table as CSV";
const NO_TABLE: &str = "give the table of contacts itself";
const BY_ZSTD: &str = "decompress it with 'zstd -d', or compress it with gzip";
const DECOMPRESSED: &str = "decompress it, or compress it with gzip";

/// The first bytes of files that are not read.
const OTHERS: [(&[u8], &str, &str); 16] = [
    (
        b"PK\x03\x04",
        "a spreadsheet or another ZIP archive",
        AS_CSV,
    ),
    (
        b"\xd0\xcf\x11\xe0",
        "a spreadsheet of the old Excel format",
        AS_CSV,
    ),
    (b"\x89HDF", "an HDF5 file", AS_CSV),
    (b"CDF", "a NetCDF file", AS_CSV),
    (
        b"\x93NUMPY",
        "an array of NumPy",
        "write it with numpy.savetxt",
    ),
    (b"SQLite format 3", "a database of SQLite", AS_CSV),
    (b"BZh", "compressed by bzip2", DECOMPRESSED),
    (b"\xfd7zXZ", "compressed by xz", DECOMPRESSED),
    (b"(\xb5/\xfd", "compressed by zstd", BY_ZSTD),
    (b"7z\xbc\xaf", "a 7z archive", DECOMPRESSED),
    (b"\x04\x22\x4d\x18", "compressed by lz4", DECOMPRESSED),
    (b"\x1f\x9d", "compressed by compress", DECOMPRESSED),
    (b"PAR1", "a Parquet file", AS_CSV),
    (b"{\\rtf", "a document of a word processor", AS_CSV),
    (b"%PDF", "a PDF document", NO_TABLE),
    (b"\x89PNG", "a picture", NO_TABLE),
];

impl FileKind {
    /// Returns the kind of a file that begins with these bytes.
    ///
    /// # Examples
    /// ```
    /// use contact_tables::FileKind;
    ///
    /// assert_eq!(FileKind::of(b"id1,id2,force\n1,2,0.5\n"), FileKind::Table);
    /// assert_eq!(FileKind::of(b"# vtk DataFile Version 3.0\n"), FileKind::VtkLegacy);
    /// ```
    #[must_use]
    pub fn of(begin: &[u8]) -> Self {
        let begin = begin.strip_prefix(b"\xef\xbb\xbf").unwrap_or(begin);
        let text = begin.trim_ascii_start();
        let begins = |words: &[u8]| {
            let start = text.get(..words.len());
            start.is_some_and(|start| start.eq_ignore_ascii_case(words))
        };
        if let Some((_, is, remedy)) = OTHERS.iter().find(|(magic, ..)| begin.starts_with(magic)) {
            return Self::Other { is, remedy };
        }
        let is_list = text.strip_prefix(b"[").is_some_and(|inside| {
            let inside = inside.trim_ascii_start();
            inside.starts_with(b"{") || inside.starts_with(b"[")
        });
        if begins(b"ITEM:") {
            Self::Dump
        } else if begins(b"# vtk DataFile") {
            Self::VtkLegacy
        } else if begins(b"<!doctype html") || begins(b"<html") || begins(b"<table") {
            let (is, remedy) = ("an HTML page", NO_TABLE);
            Self::Other { is, remedy }
        } else if begins(b"<") {
            Self::VtkXml
        } else if begins(b"{") || is_list {
            let (is, remedy) = ("JSON", AS_CSV);
            Self::Other { is, remedy }
        } else if begin.contains(&0) {
            let (is, remedy) = ("a binary file", AS_CSV);
            Self::Other { is, remedy }
        } else {
            Self::Table
        }
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Table => "a table",
            Self::Dump => "a LAMMPS dump",
            Self::VtkXml => "a VTK file (XML)",
            Self::VtkLegacy => "a VTK file (legacy)",
            Self::Other { is, .. } => is,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_known_by_content() {
        for (begin, kind) in [
            (
                &b"PK\x03\x04..."[..],
                "a spreadsheet or another ZIP archive",
            ),
            (b"\x00\x01\x02", "a binary file"),
            (b"(\xb5/\xfd\x04X", "compressed by zstd"),
            (b"  {\"a\": 1}", "JSON"),
            (b"[\n {\"a\": 1}]", "JSON"),
            (b"{\\rtf1", "a document of a word processor"),
            (b"<table>", "an HTML page"),
            (b"7z\xbc\xaf\x27\x1c", "a 7z archive"),
            (b"\xef\xbb\xbf<?xml version='1.0'?>", "a VTK file (XML)"),
            (b"# vtk DataFile Version 2.0", "a VTK file (legacy)"),
            (b"# a comment", "a table"),
            (b"", "a table"),
        ] {
            assert_eq!(FileKind::of(begin).to_string(), kind);
        }
    }
}
