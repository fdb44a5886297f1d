//! Forces on lines in VTK's XML files: `.vtp` and `.vtu`.
//!
//! Each line between two points is a row of a table. Its columns are the coordinates `x1` to `z2` of the points, and
//! the data of the line. The data of points serve too: those of the first point of the line. An array with one
//! component is a column with the name of the array. An array with three components is three columns with `_x`, `_y`
//! and `_z` after the name. <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>

use std::collections::BTreeMap;

use quick_xml::events::attributes::Attributes;
use quick_xml::events::{BytesStart, Event};

use super::csv_file::{Format, take};
use super::entry::Sink;
use super::header::Header;
use super::refusal::Refusal;
use super::vtk_array::{Coding, Values};
use crate::Error;
use crate::error::quoted;

/// Reads the lines of a file as rows.
pub(super) fn read_lines(
    bytes: &[u8],
    format: &Format,
    sink: &mut impl Sink,
) -> Result<(), Refusal> {
    let mut row = 0;
    for piece in pieces(bytes)? {
        piece.read(format, sink, &mut row)?;
    }
    Ok(())
}

/// The sections of a piece that are read.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Section {
    Points,
    Lines,
    PointData,
    CellData,
}

impl Section {
    fn named(tag: &[u8]) -> Option<Self> {
        match tag {
            b"Points" => Some(Self::Points),
            b"Lines" | b"Cells" => Some(Self::Lines),
            b"PointData" => Some(Self::PointData),
            b"CellData" => Some(Self::CellData),
            _ => None,
        }
    }
}

/// An array: its name, the number of components, and the values.
struct Array {
    name: String,
    components: usize,
    values: Values,
}

/// The arrays of a piece.
#[derive(Default)]
struct Piece(BTreeMap<Section, Vec<Array>>);

/// A column of the table that a piece forms.
struct Column<'a> {
    name: String,
    values: &'a Values,
    /// The number of components for each point or line, and the component of this column.
    components: usize,
    component: usize,
    of_points: bool,
}

fn refused(reason: impl Into<String>) -> Refusal {
    Refusal::Vtk(reason.into())
}

impl Piece {
    fn read(&self, format: &Format, sink: &mut impl Sink, row: &mut u64) -> Result<(), Refusal> {
        let of = |section| self.0.get(&section).map_or(&[][..], Vec::as_slice);
        let Some(points) = of(Section::Points).first() else {
            return Err(refused(
                "a piece has no points: contacts are lines between points",
            ));
        };
        let lines = |name| {
            let mut arrays = of(Section::Lines).iter();
            let array = arrays.find(|array: &&Array| array.name == name);
            array.ok_or_else(|| refused(format!("a piece has no array {name} for its lines")))
        };
        let (connectivity, offsets) = (lines("connectivity")?, lines("offsets")?);
        let mut columns: Vec<Column<'_>> = Vec::new();
        for (section, of_points) in [(Section::CellData, false), (Section::PointData, true)] {
            for array in of(section) {
                array.columns(of_points, &mut columns);
            }
        }
        let ends = ["x1", "y1", "z1", "x2", "y2", "z2"];
        columns.retain(|column| !ends.contains(&column.name.as_str()));
        let names = ends
            .into_iter()
            .chain(columns.iter().map(|column| column.name.as_str()));
        let header = Header::find(names, &format.columns, format.identity);
        let header = header.map_err(|fault| fault.at(1))?;
        let mut begin = 0;
        for line in 0..offsets.values.len() {
            *row += 1;
            let short = || {
                refused(format!(
                    "line {}: it has a point that is not in the file",
                    *row
                ))
            };
            let end = offsets.values.index(line).ok_or_else(short)?;
            if end.checked_sub(begin) != Some(2) {
                return Err(refused(format!(
                    "line {}: it does not have two points; is this a table of contacts?",
                    *row
                )));
            }
            let mut fields = Vec::new();
            let first = connectivity.values.index(begin).ok_or_else(short)?;
            let second = connectivity.values.index(end - 1).ok_or_else(short)?;
            for place in [first, second] {
                for axis in 0..3 {
                    let at = place.checked_mul(3).and_then(|at| at.checked_add(axis));
                    let text = at.and_then(|at| points.values.text(at));
                    fields.push(text.ok_or_else(short)?);
                }
            }
            begin = end;
            for column in &columns {
                let thing = if column.of_points { first } else { line };
                let at = thing
                    .checked_mul(column.components)
                    .and_then(|at| at.checked_add(column.component));
                let text = at.and_then(|at| column.values.text(at));
                fields.push(text.ok_or_else(|| {
                    refused(format!(
                        "line {}: no value of {}",
                        *row,
                        quoted(&column.name)
                    ))
                })?);
            }
            let fields: Vec<&str> = fields.iter().map(String::as_str).collect();
            take(&header, &fields, *row, sink)?;
        }
        Ok(())
    }
}

impl Array {
    fn columns<'a>(&'a self, of_points: bool, columns: &mut Vec<Column<'a>>) {
        let names = match self.components {
            1 => vec![self.name.clone()],
            3 => ["x", "y", "z"]
                .map(|axis| format!("{}_{axis}", self.name))
                .to_vec(),
            _ => return,
        };
        for (component, name) in names.into_iter().enumerate() {
            if columns.iter().all(|known| known.name != name) {
                columns.push(Column {
                    name,
                    values: &self.values,
                    components: self.components,
                    component,
                    of_points,
                });
            }
        }
    }
}

/// Returns the pieces of a file.
fn pieces(bytes: &[u8]) -> Result<Vec<Piece>, Refusal> {
    let (text, appended) = split(bytes);
    let mut xml = quick_xml::Reader::from_reader(text);
    let mut coding = Coding::default();
    coding.append(appended);
    let (mut pieces, mut section, mut array) = (Vec::new(), None, None);
    loop {
        let event = xml
            .read_event()
            .map_err(|error| refused(format!("not valid XML: {}", quoted(&error.to_string()))))?;
        match event {
            Event::Eof => return Ok(pieces),
            Event::Start(tag) | Event::Empty(tag) if tag.name().as_ref() == b"VTKFile" => {
                for (key, value) in attributes(&tag)? {
                    coding.set(&key, &value).map_err(refused)?;
                }
            }
            Event::Start(tag) if tag.name().as_ref() == b"Piece" => pieces.push(Piece::default()),
            Event::Empty(tag) if tag.name().as_ref() == b"DataArray" => {
                let found = found(&tag, "", &coding)?;
                keep(&mut pieces, section, found);
            }
            Event::Start(tag) if tag.name().as_ref() == b"DataArray" => {
                array = Some((tag.into_owned(), String::new()));
            }
            Event::Start(tag) if section.is_none() => section = Section::named(tag.name().as_ref()),
            Event::Text(text) => {
                if let Some((_, content)) = &mut array {
                    let text = text.decode();
                    content.push_str(&text.map_err(|error| refused(error.to_string()))?);
                }
            }
            Event::End(tag) if tag.name().as_ref() == b"DataArray" => {
                if let Some((tag, text)) = array.take() {
                    let found = found(&tag, &text, &coding)?;
                    keep(&mut pieces, section, found);
                }
            }
            Event::End(tag) if Section::named(tag.name().as_ref()) == section => section = None,
            _ => {}
        }
    }
}

fn keep(pieces: &mut [Piece], section: Option<Section>, array: Array) {
    if let (Some(piece), Some(section)) = (pieces.last_mut(), section) {
        piece.0.entry(section).or_default().push(array);
    }
}

/// Reads the array of a tag and its text.
fn found(tag: &BytesStart<'_>, text: &str, coding: &Coding<'_>) -> Result<Array, Refusal> {
    let attributes: BTreeMap<String, String> = attributes(tag)?.into_iter().collect();
    let get = |key: &str| attributes.get(key).map(String::as_str);
    let name = get("Name").unwrap_or("").to_owned();
    let components = match get("NumberOfComponents") {
        None => 1,
        Some(count) => count.parse().map_err(|_| {
            refused(Error::syntax(count, "a number of components such as 3").to_string())
        })?,
    };
    let values = coding.read(get("type"), get("format"), get("offset"), text);
    let values = values.map_err(|reason| refused(format!("array {}: {reason}", quoted(&name))))?;
    Ok(Array {
        name,
        components,
        values,
    })
}

fn attributes(tag: &BytesStart<'_>) -> Result<Vec<(String, String)>, Refusal> {
    let attributes: Attributes<'_> = tag.attributes();
    let mut found = Vec::new();
    for attribute in attributes {
        let attribute = attribute
            .map_err(|error| refused(format!("not valid XML: {}", quoted(&error.to_string()))))?;
        let key = String::from_utf8_lossy(attribute.key.as_ref()).into_owned();
        let value = String::from_utf8_lossy(&attribute.value).into_owned();
        found.push((key, value));
    }
    Ok(found)
}

/// Splits the XML from the appended data after it, which may be binary.
fn split(bytes: &[u8]) -> (&[u8], &[u8]) {
    const TAG: &[u8] = b"<AppendedData";
    let place = bytes.windows(TAG.len()).position(|part| part == TAG);
    match place {
        Some(place) => bytes.split_at(place),
        None => (bytes, &[]),
    }
}
