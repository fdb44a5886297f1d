//! VTK's XML files of poly data: a header with the offset of each array, then the arrays in base64.
//!
//! Each array is its size in bytes as a `u64`, followed by the bytes
//! (<https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>). All sizes are known before the first
//! number is written. Raw bytes would be shorter, but a file with raw bytes is not XML.

use std::io::{self, Write};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// The number of bytes that are encoded at once: a multiple of three, so that padding occurs only at the end of an array.
const CHUNK: usize = 3 << 12;

/// The number type of an array.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    Float64,
    Int64,
    UInt8,
}

impl Kind {
    const fn bytes(self) -> u64 {
        match self {
            Self::UInt8 => 1,
            Self::Float64 | Self::Int64 => 8,
        }
    }
}

/// An array: its name, its number type, the components of an element, and the number of elements.
pub(super) struct Array {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) components: u64,
    pub(super) things: u64,
}

impl Array {
    pub(super) const fn new(name: &'static str, kind: Kind, components: u64, things: u64) -> Self {
        Self {
            name,
            kind,
            components,
            things,
        }
    }

    fn bytes(&self) -> u64 {
        self.kind.bytes() * self.components * self.things
    }

    /// Returns the length in base64, with the size in front.
    fn encoded(&self) -> u64 {
        4 * (8 + self.bytes()).div_ceil(3)
    }
}

/// A part of the file with some arrays: `PointData`, `CellData`, `Points`, `Verts`, `Lines`.
pub(super) struct Section {
    pub(super) tag: &'static str,
    pub(super) arrays: Vec<Array>,
}

/// A writer of a file.
pub(super) struct PolyData<'w> {
    out: &'w mut dyn Write,
    /// The sizes in bytes of the remaining arrays, in reverse order.
    coming: Vec<u64>,
    /// The remaining bytes of the current array.
    left: u64,
    /// Bytes that are not yet encoded.
    chunk: Vec<u8>,
}

impl<'w> PolyData<'w> {
    /// Writes the header. The arrays must follow in the order of the sections.
    pub(super) fn begin(
        out: &'w mut dyn Write,
        points: u64,
        [verts, lines]: [u64; 2],
        sections: &[Section],
    ) -> io::Result<Self> {
        write!(
            out,
            "<?xml version=\"1.0\"?>
<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">
<PolyData>
<Piece NumberOfPoints=\"{points}\" NumberOfVerts=\"{verts}\" NumberOfLines=\"{lines}\" NumberOfStrips=\"0\" \
             NumberOfPolys=\"0\">
"
        )?;
        let (mut offset, mut coming) = (0, Vec::new());
        for Section { tag, arrays } in sections {
            writeln!(out, "<{tag}>")?;
            for array in arrays {
                writeln!(
                    out,
                    "<DataArray type=\"{:?}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{offset}\"/>",
                    array.kind, array.name, array.components,
                )?;
                offset += array.encoded();
                coming.push(array.bytes());
            }
            writeln!(out, "</{tag}>")?;
        }
        write!(
            out,
            "</Piece>\n</PolyData>\n<AppendedData encoding=\"base64\">\n_"
        )?;
        coming.reverse();
        Ok(Self {
            out,
            coming,
            left: 0,
            chunk: Vec::with_capacity(CHUNK),
        })
    }

    /// Begins the next array.
    pub(super) fn array(&mut self) -> io::Result<()> {
        self.finish()?;
        let size = self.coming.pop();
        let size = size.ok_or_else(|| io::Error::other("an array too many"))?;
        self.left = 8 + size;
        self.bytes(&size.to_le_bytes())
    }

    pub(super) fn float(&mut self, x: f64) -> io::Result<()> {
        self.bytes(&x.to_le_bytes())
    }

    pub(super) fn vector(&mut self, vector: [f64; 3]) -> io::Result<()> {
        vector.into_iter().try_for_each(|x| self.float(x))
    }

    /// Writes an integer that fits in an `i64`.
    pub(super) fn integer(&mut self, n: u64) -> io::Result<()> {
        self.bytes(&n.to_le_bytes())
    }

    pub(super) fn byte(&mut self, n: u8) -> io::Result<()> {
        self.bytes(&[n])
    }

    /// Writes `step`, 2·`step`, …: the offsets of the ends of cells with `step` points each.
    pub(super) fn multiples(&mut self, step: u64, cells: u64) -> io::Result<()> {
        (1..=cells).try_for_each(|cell| self.integer(step * cell))
    }

    /// Writes 0, 1, 2, ….
    pub(super) fn count_up(&mut self, points: u64) -> io::Result<()> {
        (0..points).try_for_each(|point| self.integer(point))
    }

    /// Writes the end of the file.
    pub(super) fn end(mut self) -> io::Result<()> {
        self.finish()?;
        if !self.coming.is_empty() {
            return Err(io::Error::other("an array too few"));
        }
        self.out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
    }

    fn bytes(&mut self, bytes: &[u8]) -> io::Result<()> {
        let left = self.left.checked_sub(bytes.len() as u64);
        self.left = left.ok_or_else(|| io::Error::other("an array that is too long"))?;
        for byte in bytes {
            self.chunk.push(*byte);
            if self.chunk.len() == CHUNK {
                self.encode()?;
            }
        }
        Ok(())
    }

    fn encode(&mut self) -> io::Result<()> {
        self.out
            .write_all(STANDARD.encode(&self.chunk).as_bytes())?;
        self.chunk.clear();
        Ok(())
    }

    /// Writes the end of the current array.
    fn finish(&mut self) -> io::Result<()> {
        if self.left == 0 {
            self.encode()
        } else {
            Err(io::Error::other("an array that is too short"))
        }
    }
}
