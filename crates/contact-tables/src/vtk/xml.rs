//! VTK's XML: the arrays of the pieces, and the files that a collection names.
//!
//! <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>

use std::borrow::Cow;
use std::collections::BTreeMap;

use quick_xml::Reader;
use quick_xml::escape::{resolve_predefined_entity, unescape};
use quick_xml::events::{BytesRef, BytesStart, Event};

use super::array::{Array, Source};
use super::coding::Coding;
use super::piece::{Piece, Section};
use crate::error::Error;
use crate::error::quoted;

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
                        let is_raw = attributes(&tag)?
                            .get("encoding")
                            .is_some_and(|it| it == "raw");
                        let begin = usize::try_from(xml.buffer_position()).unwrap_or(usize::MAX);
                        // Raw data are not XML, and nothing of interest follows them.
                        coding.append(bytes.get(begin..).unwrap_or_default(), is_raw);
                        break;
                    }
                    b"Piece" | b"DataSet" => document.begin(&attributes(&tag)?),
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
                    piece.push(array.section, array.close());
                }
                section = section.filter(|(_, begin)| *begin != depth);
                depth = depth.saturating_sub(1);
            }
            Event::Text(text) => append(array.as_mut(), depth, text.into_inner()),
            Event::CData(text) => append(array.as_mut(), depth, text.into_inner()),
            Event::GeneralRef(name) => append(array.as_mut(), depth, character(&name)?),
            Event::DocType(name) if starts_with_html(&name) => return Err(html()),
            Event::Eof if document.kind.is_empty() => {
                return Err(Error::vtk("the file has no element VTKFile"));
            }
            Event::Eof if depth > 0 => {
                return Err(Error::vtk(
                    "the file ends within its XML: it is not complete",
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
    fn begin(&mut self, attributes: &BTreeMap<String, String>) {
        let source = attributes.get("Source").or_else(|| attributes.get("file"));
        if let Some(path) = source {
            self.files.push(path.clone());
            return;
        }
        let cells: &[_] = match &*self.kind {
            "PolyData" => &[
                ("NumberOfVerts", Section::Verts),
                ("NumberOfLines", Section::Lines),
                ("NumberOfPolys", Section::Polys),
                ("NumberOfStrips", Section::Strips),
            ],
            _ => &[("NumberOfCells", Section::Cells)],
        };
        let mut piece = Piece::default();
        for (key, section) in [("NumberOfPoints", Section::Points)].iter().chain(cells) {
            let count = attributes
                .get(*key)
                .and_then(|count| count.trim().parse().ok());
            if let Some(count) = count {
                piece.announce(*section, count);
            }
        }
        self.pieces.push(piece);
    }
}

impl<'f> OpenArray<'f> {
    fn close(mut self) -> Array<'f> {
        let count = self.attributes.get("NumberOfComponents");
        let source = match self.attributes.get("format").map(String::as_str) {
            Some("appended") => {
                let offset = self.attributes.get("offset");
                Source::Appended(offset.and_then(|offset| offset.trim().parse().ok()))
            }
            Some("binary") => Source::Base64(self.content),
            _ => Source::Text(self.content),
        };
        let components = match self.section {
            Section::Points => 3,
            // Like VTK: one component, unless a number is given.
            _ => count
                .and_then(|count| count.trim().parse().ok())
                .unwrap_or(1),
        };
        let mut text = |key| self.attributes.remove(key).unwrap_or_default();
        Array {
            name: text("Name"),
            kind: text("type"),
            components,
            source,
        }
    }
}

impl Section {
    fn named(tag: &[u8]) -> Option<Self> {
        match tag {
            b"Points" => Some(Self::Points),
            b"Verts" => Some(Self::Verts),
            b"Lines" => Some(Self::Lines),
            b"Polys" => Some(Self::Polys),
            b"Strips" => Some(Self::Strips),
            b"Cells" => Some(Self::Cells),
            b"PointData" => Some(Self::PointData),
            b"CellData" => Some(Self::CellData),
            _ => None,
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
            Error::vtk("an XML spreadsheet: save it as csv")
        } else {
            let name = String::from_utf8_lossy(name.as_ref());
            Error::vtk(format!(
                "XML with the root element {}, not a VTK file",
                quoted(&name)
            ))
        });
    }
    let mut attributes = attributes(tag)?;
    for (key, value) in &attributes {
        coding.set(key, value);
    }
    let kind = attributes.remove("type").filter(|kind| !kind.is_empty());
    kind.ok_or_else(|| Error::vtk("the element VTKFile has no type, such as PolyData"))
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
    Error::vtk("an HTML page: save the table that it shows, or the file that it links to")
}

fn invalid(error: &impl ToString) -> Error {
    Error::vtk(format!("not valid XML: {}", quoted(&error.to_string())))
}
