//! VTK's XML: the arrays of the pieces, and the files that are named in place of pieces.
//!
//! <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>

use std::borrow::Cow;
use std::collections::BTreeMap;

use quick_xml::Reader;
use quick_xml::escape::{resolve_predefined_entity, unescape};
use quick_xml::events::{BytesRef, BytesStart, Event};

use super::array::{Array, Source};
use super::coding::{Coding, unknown};
use super::piece::{Piece, Section};
use crate::error::Error;
use crate::error::quoted;
use crate::number::whole_number;

/// The content of a file.
#[derive(Default)]
pub(super) struct Document<'f> {
    /// The type of the data set.
    pub(super) kind: String,
    pub(super) pieces: Vec<Piece<'f>>,
    /// The files that are named in place of pieces.
    pub(super) files: Vec<String>,
}

/// An array whose end was not yet found.
struct OpenArray<'f> {
    section: Section,
    attributes: BTreeMap<String, String>,
    content: Cow<'f, [u8]>,
    depth: usize,
}

/// Reads a file without decoding its arrays.
pub(super) fn parse(bytes: &[u8]) -> Result<Document<'_>, Error> {
    let mut xml = Reader::from_reader(bytes);
    xml.config_mut().expand_empty_elements = true;
    let (mut document, mut coding) = (Document::default(), Coding::default());
    let mut section: Option<(Section, usize)> = None;
    let mut array: Option<OpenArray<'_>> = None;
    let mut depth = 0_usize;
    loop {
        let event = xml.read_event().map_err(|error| invalid(&error))?;
        match event {
            Event::Start(tag) => {
                depth += 1;
                let name = tag.name();
                match name.as_ref() {
                    _ if depth == 1 => document.kind = root(&tag, &mut coding)?,
                    b"AppendedData" => {
                        let attributes = attributes(&tag)?;
                        let is_raw = match attributes.get("encoding").map(String::as_str) {
                            Some("raw") => true,
                            None | Some("base64") => false,
                            Some(other) => return Err(unknown("encoding", other, "raw or base64")),
                        };
                        let begin = usize::try_from(xml.buffer_position()).ok();
                        let data = begin.and_then(|begin| bytes.get(begin..));
                        let data =
                            data.ok_or_else(|| Error::Vtk("a tag ends behind the file".into()))?;
                        // Raw data are not XML, and nothing of interest follows them.
                        coding.append(data, is_raw);
                        break;
                    }
                    b"Piece" | b"DataSet" => document.begin(&attributes(&tag)?)?,
                    // Texts are in the element Array.
                    b"DataArray" | b"Array" => {
                        if let (Some((section, _)), None) = (section, &array) {
                            array = Some(OpenArray {
                                section,
                                attributes: attributes(&tag)?,
                                content: Cow::default(),
                                depth,
                            });
                        }
                    }
                    name if section.is_none() => {
                        section = Section::named(name).map(|section| (section, depth));
                    }
                    _ => {}
                }
            }
            Event::End(_) => {
                if let Some(array) = array.take_if(|array| array.depth == depth)
                    && let Some(piece) = document.pieces.last_mut()
                {
                    piece.push(array.section, array.close()?);
                }
                section = section.filter(|(_, begin)| *begin != depth);
                depth = depth.saturating_sub(1);
            }
            Event::Text(text) => append(array.as_mut(), depth, text.into_inner()),
            Event::CData(text) => append(array.as_mut(), depth, text.into_inner()),
            Event::GeneralRef(name) => append(array.as_mut(), depth, character(&name)?),
            Event::DocType(name) if starts_with_html(&name) => return Err(html()),
            Event::Eof if document.kind.is_empty() => {
                return Err(Error::Vtk("the file has no element VTKFile".into()));
            }
            Event::Eof if depth > 0 => {
                return Err(Error::Vtk(
                    "the file ends within its XML: it is not complete".into(),
                ));
            }
            Event::Eof => break,
            _ => {}
        }
    }
    for piece in &mut document.pieces {
        piece.coding = coding.clone();
    }
    Ok(document)
}

impl Document<'_> {
    /// Begins a piece, or adds the file that is named in its place.
    fn begin(&mut self, attributes: &BTreeMap<String, String>) -> Result<(), Error> {
        let source = attributes.get("Source").or_else(|| attributes.get("file"));
        if let Some(path) = source {
            self.files.push(path.clone());
            return Ok(());
        }
        let (is_grid, mut piece) = (self.kind == "UnstructuredGrid", Piece::default());
        for (key, count) in attributes {
            let Some(counted) = key.strip_prefix("NumberOf") else {
                continue;
            };
            let section = COUNTED.iter().find(|(name, _)| *name == counted);
            let (_, section) = section.ok_or_else(|| unknown("the attribute", key, COUNTS))?;
            // Kratos writes 12.0.
            let number = whole_number(count.trim()).and_then(|count| usize::try_from(count).ok());
            let number = number.ok_or_else(|| unknown(key, count, "a number such as 12"))?;
            // Some programs write the number of cells of poly data, too.
            if *section == Section::Points || is_grid == (*section == Section::Cells) {
                piece.announce(*section, number);
            }
        }
        self.pieces.push(piece);
        Ok(())
    }
}

impl<'f> OpenArray<'f> {
    fn close(mut self) -> Result<Array<'f>, Error> {
        // A missing attribute reads as an empty one, which has a meaning or is refused.
        let mut text = |key| self.attributes.remove(key).unwrap_or_default();
        let (name, kind, offset) = (text("Name"), text("type"), text("offset"));
        let refused = |key, value: &str, expected| {
            let array = format!("array {}: {key}", quoted(&name));
            Err(unknown(&array, value, expected))
        };
        let source = match &*text("format") {
            "appended" => Source::Appended(offset.trim().parse().ok()),
            "binary" => Source::Base64(self.content),
            "" | "ascii" => Source::Text(self.content),
            other => return refused("format", other, "ascii, binary or appended"),
        };
        let components = match (self.section, &*text("NumberOfComponents")) {
            (Section::Points, _) => 3,
            // Like VTK: one component, unless a number is given.
            (_, "") => 1,
            (_, count) => match count.trim().parse() {
                Ok(count) => count,
                Err(_) => return refused("NumberOfComponents", count, "a number such as 3"),
            },
        };
        Ok(Array {
            name,
            components,
            kind,
            source,
        })
    }
}

/// The sections whose points or cells an attribute `NumberOf…` of a piece counts.
const COUNTED: [(&str, Section); 6] = [
    ("Points", Section::Points),
    ("Verts", Section::Verts),
    ("Lines", Section::Lines),
    ("Polys", Section::Polys),
    ("Strips", Section::Strips),
    ("Cells", Section::Cells),
];

const COUNTS: &str = "one of a piece: NumberOfPoints, NumberOfVerts, NumberOfLines, NumberOfPolys, NumberOfStrips or \
                      NumberOfCells";

impl Section {
    fn named(tag: &[u8]) -> Option<Self> {
        match tag {
            b"PointData" => Some(Self::PointData),
            b"CellData" => Some(Self::CellData),
            _ => {
                let mut cells = COUNTED.iter();
                let found = cells.find(|(name, _)| name.as_bytes() == tag);
                found.map(|(_, section)| *section)
            }
        }
    }
}

/// Appends text to an array, unless the text belongs to an element within the array.
fn append<'f>(array: Option<&mut OpenArray<'f>>, depth: usize, text: Cow<'f, [u8]>) {
    let Some(array) = array.filter(|array| array.depth == depth) else {
        return;
    };
    if array.content.is_empty() {
        array.content = text;
    } else {
        array.content.to_mut().extend_from_slice(&text);
    }
}

/// Returns the text that an entity stands for.
fn character(name: &BytesRef<'_>) -> Result<Cow<'static, [u8]>, Error> {
    let code = name.resolve_char_ref().map_err(|error| invalid(&error))?;
    let text = if let Some(character) = code {
        character.to_string()
    } else {
        let name = String::from_utf8_lossy(name);
        let text = resolve_predefined_entity(&name);
        let text = text.ok_or_else(|| invalid(&format!("the entity &{name}; is unknown")))?;
        text.to_owned()
    };
    Ok(Cow::Owned(text.into_bytes()))
}

/// Reads the root element: the encoding of the file, and the type of the data set.
fn root(tag: &BytesStart<'_>, coding: &mut Coding<'_>) -> Result<String, Error> {
    let name = tag.name();
    if starts_with_html(name.as_ref()) {
        return Err(html());
    }
    if name.as_ref() != b"VTKFile" {
        let is_spreadsheet = String::from_utf8_lossy(tag).contains("spreadsheet");
        return Err(if is_spreadsheet {
            Error::Vtk("an XML spreadsheet: save it as csv".into())
        } else {
            let name = String::from_utf8_lossy(name.as_ref());
            Error::Vtk(format!(
                "XML with the root element {}, not a VTK file",
                quoted(&name)
            ))
        });
    }
    let mut attributes = attributes(tag)?;
    for (key, value) in &attributes {
        coding.set(key, value)?;
    }
    let kind = attributes.remove("type").filter(|kind| !kind.is_empty());
    kind.ok_or_else(|| Error::Vtk("the element VTKFile has no type, such as PolyData".into()))
}

fn attributes(tag: &BytesStart<'_>) -> Result<BTreeMap<String, String>, Error> {
    let mut found = BTreeMap::new();
    for attribute in tag.attributes() {
        let attribute = attribute.map_err(|error| invalid(&error))?;
        let key = String::from_utf8_lossy(attribute.key.as_ref()).into_owned();
        let value = String::from_utf8_lossy(&attribute.value);
        let value = unescape(&value).map_err(|error| invalid(&error))?;
        found.insert(key, value.into_owned());
    }
    Ok(found)
}

fn starts_with_html(text: &[u8]) -> bool {
    let begin = text.trim_ascii_start().get(..4);
    begin.is_some_and(|begin| begin.eq_ignore_ascii_case(b"html"))
}

fn html() -> Error {
    Error::Vtk("an HTML page: save the table that it shows, or the file that it links to".into())
}

fn invalid(error: &impl ToString) -> Error {
    Error::Vtk(format!("not valid XML: {}", quoted(&error.to_string())))
}
