//! VTK's legacy files: `# vtk DataFile Version`, as text or binary, up to version 5.1.
//!
//! <https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html>

use std::borrow::Cow;

use super::array::{Array, Source};
use super::coding::Coding;
use super::piece::{CONNECTIVITY, INTERLEAVED, OFFSETS, Piece, Section, TYPES};
use super::words::{Words, cut, number};
use crate::error::Error;
use crate::error::quoted;

/// Reads a file without decoding its arrays.
pub(super) fn parse(bytes: &[u8]) -> Result<Piece<'_>, Error> {
    let mut file = Legacy {
        words: Words { rest: bytes },
        is_binary: false,
        piece: Piece::new(Coding::legacy()),
        data: None,
    };
    // The version, and a title.
    file.words.line();
    file.words.line();
    file.is_binary = match &*file.words.keyword()? {
        "ASCII" => false,
        "BINARY" => true,
        other => {
            return Err(Error::Vtk(format!(
                "the third line of a legacy VTK file is ASCII or BINARY, not {}",
                quoted(other)
            )));
        }
    };
    while !file.words.rest.trim_ascii_start().is_empty() {
        let keyword = file.words.keyword()?;
        file.read(&keyword)?;
    }
    Ok(file.piece)
}

struct Legacy<'f> {
    words: Words<'f>,
    is_binary: bool,
    piece: Piece<'f>,
    /// The data that are read: of points or of cells, and their number.
    data: Option<(Section, usize)>,
}

impl<'f> Legacy<'f> {
    /// Reads what follows a keyword.
    fn read(&mut self, keyword: &str) -> Result<(), Error> {
        match keyword {
            "DATASET" => match &*self.words.keyword()? {
                "POLYDATA" => {}
                "UNSTRUCTURED_GRID" => self.piece.announce(Section::Cells, 0),
                other => {
                    return Err(Error::Vtk(format!(
                        "the data set is {}: contacts are lines or vertices of POLYDATA or UNSTRUCTURED_GRID",
                        quoted(other)
                    )));
                }
            },
            "POINTS" => {
                let (count, kind) = (self.words.count()?, self.kind()?);
                self.piece.announce(Section::Points, count);
                self.array(Section::Points, "points", 3, count, kind)?;
            }
            "VERTICES" => self.cells(Section::Verts)?,
            "LINES" => self.cells(Section::Lines)?,
            "POLYGONS" => self.cells(Section::Polys)?,
            "TRIANGLE_STRIPS" => self.cells(Section::Strips)?,
            "CELLS" => self.cells(Section::Cells)?,
            "CELL_TYPES" => {
                let count = self.words.count()?;
                self.array(Section::Cells, TYPES, 1, count, "Int32")?;
            }
            "POINT_DATA" => self.data = Some((Section::PointData, self.words.count()?)),
            "CELL_DATA" => self.data = Some((Section::CellData, self.words.count()?)),
            "METADATA" => {
                // An empty line ends the block.
                self.words.line();
                while !self.words.line().trim_ascii().is_empty() {}
            }
            "FIELD" => self.field()?,
            "LOOKUP_TABLE" => {
                self.words.word()?;
                let colours = self.words.count()?.saturating_mul(4);
                self.numbers("UInt8", colours)?;
            }
            other => self.attribute(other)?,
        }
        Ok(())
    }

    /// Reads the cells of a section. Up to version 4, the number of points precedes the points of each cell.
    fn cells(&mut self, section: Section) -> Result<(), Error> {
        let (count, length) = (self.words.count()?, self.words.count()?);
        let next = self.words.rest.trim_ascii_start().get(..OFFSETS.len());
        if !next.is_some_and(|next| next.eq_ignore_ascii_case(OFFSETS.as_bytes())) {
            self.piece.announce(section, count);
            return self.array(section, INTERLEAVED, 1, length, "Int32");
        }
        self.words.keyword()?;
        let kind = self.kind()?;
        // In XML, the first offset, which is 0, is left out.
        self.piece.announce(section, count.saturating_sub(1));
        if count > 0 {
            self.numbers(kind, 1)?;
        }
        let ends = self.more_numbers(kind, count.saturating_sub(1))?;
        self.push(section, OFFSETS.to_owned(), 1, kind, ends);
        self.words.keyword()?;
        let kind = self.kind()?;
        self.array(section, CONNECTIVITY, 1, length, kind)
    }

    /// Reads an attribute of the points or cells.
    fn attribute(&mut self, keyword: &str) -> Result<(), Error> {
        let unknown = || Error::Vtk(format!("the keyword {} is unknown", quoted(keyword)));
        let (section, count) = self.data.ok_or_else(unknown)?;
        if keyword == "COLOR_SCALARS" {
            let name = self.words.name()?;
            let components = self.words.count()?;
            // As text they are fractions.
            let kind = if self.is_binary { "UInt8" } else { "Float32" };
            return self.array(section, &name, components, count, kind);
        }
        let name = self.words.name()?;
        let components = match keyword {
            "SCALARS" | "GLOBAL_IDS" | "PEDIGREE_IDS" | "EDGE_FLAGS" => 1,
            "VECTORS" | "NORMALS" => 3,
            "TENSORS" => 9,
            "TENSORS6" => 6,
            "TEXTURE_COORDINATES" => self.words.count()?,
            _ => return Err(unknown()),
        };
        let kind = self.kind()?;
        if keyword != "SCALARS" {
            return self.array(section, &name, components, count, kind);
        }
        let is_table = |word: &[u8]| word.eq_ignore_ascii_case(b"LOOKUP_TABLE");
        let mut components = components;
        let mut word = self.words.word()?;
        if !is_table(word) {
            components = number(word)?;
            word = self.words.word()?;
        }
        if !is_table(word) {
            return Err(Error::Vtk(format!(
                "the scalars {} have no LOOKUP_TABLE",
                quoted(&name)
            )));
        }
        self.words.word()?;
        self.array(section, &name, components, count, kind)
    }

    /// Reads arrays with lengths of their own.
    fn field(&mut self) -> Result<(), Error> {
        self.words.word()?;
        for _ in 0..self.words.count()? {
            let mut name = self.words.name()?;
            while name == "METADATA" {
                self.read("METADATA")?;
                name = self.words.name()?;
            }
            if name == "NULL_ARRAY" {
                continue;
            }
            let (components, count, kind) =
                (self.words.count()?, self.words.count()?, self.kind()?);
            match self.data {
                Some((section, _)) => self.array(section, &name, components, count, kind)?,
                None => {
                    self.numbers(kind, components.saturating_mul(count))?;
                }
            }
        }
        Ok(())
    }

    fn array(
        &mut self,
        section: Section,
        name: &str,
        components: usize,
        count: usize,
        kind: &'static str,
    ) -> Result<(), Error> {
        let numbers = self.numbers(kind, components.saturating_mul(count))?;
        self.push(section, name.to_owned(), components, kind, numbers);
        Ok(())
    }

    fn push(
        &mut self,
        section: Section,
        name: String,
        components: usize,
        kind: &str,
        numbers: &'f [u8],
    ) {
        let source = if self.is_binary {
            Source::Bytes(numbers)
        } else {
            Source::Text(Cow::Borrowed(numbers))
        };
        let kind = kind.to_owned();
        self.piece.push(
            section,
            Array {
                name,
                components,
                kind,
                source,
            },
        );
    }

    /// Skips the end of the line, and returns the bytes of the next numbers.
    fn numbers(&mut self, kind: &str, count: usize) -> Result<&'f [u8], Error> {
        if self.is_binary {
            self.words.line();
        }
        self.more_numbers(kind, count)
    }

    /// Returns the bytes of the next numbers, without decoding them.
    fn more_numbers(&mut self, kind: &str, count: usize) -> Result<&'f [u8], Error> {
        let begin = self.words.rest;
        match (self.is_binary, kind) {
            (true, "string") => {
                for _ in 0..count {
                    let length = self.words.string_length()?;
                    self.words.take(length)?;
                }
            }
            (true, _) => {
                let bits = count.checked_mul(bits(kind));
                let bytes = bits.map(|bits| bits.div_ceil(8));
                self.words.take(bytes.ok_or_else(cut)?)?;
            }
            (false, "string") => {
                // The first string is on the next line.
                self.words.line();
                for _ in 0..count {
                    if self.words.line().is_empty() {
                        return Err(cut());
                    }
                }
            }
            (false, _) => {
                // A variant is a type and a value.
                let words = if kind == "Variant" { 2 } else { 1 };
                for _ in 0..count.saturating_mul(words) {
                    self.words.word()?;
                }
            }
        }
        let length = begin.len() - self.words.rest.len();
        begin.get(..length).ok_or_else(cut)
    }

    /// Returns a number type, by its name in XML. Texts keep the name of legacy files, whose form differs.
    fn kind(&mut self) -> Result<&'static str, Error> {
        let word = String::from_utf8_lossy(self.words.word()?).to_ascii_lowercase();
        Ok(match &*word {
            "bit" => "Bit",
            "char" | "signed_char" => "Int8",
            "unsigned_char" => "UInt8",
            "short" => "Int16",
            "unsigned_short" => "UInt16",
            "int" | "vtkidtype" => "Int32",
            "unsigned_int" => "UInt32",
            "long" | "vtktypeint64" => "Int64",
            "unsigned_long" | "vtktypeuint64" => "UInt64",
            "float" => "Float32",
            "double" => "Float64",
            "string" => "string",
            "variant" => "Variant",
            other => {
                return Err(Error::Vtk(format!(
                    "the number type {} is unknown",
                    quoted(other)
                )));
            }
        })
    }
}

/// Returns the size of a number in bits.
fn bits(kind: &str) -> usize {
    match kind {
        "Bit" => 1,
        "Int8" | "UInt8" => 8,
        "Int16" | "UInt16" => 16,
        "Int32" | "UInt32" | "Float32" => 32,
        _ => 64,
    }
}
