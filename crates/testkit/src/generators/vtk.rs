//! Files of VTK: XML and legacy, poly data and grids, in any encoding and any order of their parts.

use std::fmt::Write as _;
use std::io::Write as _;

use arbitrary::{Result, Unstructured};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;

/// The content of a file.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The points.
    pub points: Vec<[f64; 3]>,
    /// The cells, each with its kind and its points.
    pub cells: Vec<(Cell, Vec<usize>)>,
    /// The arrays with data of the points.
    pub point_data: Vec<Data>,
    /// The arrays with data of the cells.
    pub cell_data: Vec<Data>,
}

/// The kind of a cell, in the order of the cells of poly data.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cell {
    /// A vertex, or several.
    Vertex,
    /// A line, or a chain of lines.
    Line,
    /// A polygon.
    Polygon,
    /// A strip of triangles.
    Strip,
}

/// An array.
#[derive(Clone, Debug)]
pub struct Data {
    /// The name.
    pub name: &'static str,
    /// The number of values of each point or cell.
    pub components: usize,
    /// The values.
    pub values: Values,
}

/// The values of an array.
#[derive(Clone, Debug)]
pub enum Values {
    /// Floats of 64 bits.
    Floats(Vec<f64>),
    /// Integers.
    Integers(Vec<i64>),
    /// A number of bits.
    Bits(usize),
    /// A number of texts.
    Texts(usize),
    /// A number of floats that are not a number, as a C library of Windows writes them.
    NotNumbers(usize),
}

impl Cell {
    const ALL: [Self; 4] = [Self::Vertex, Self::Line, Self::Polygon, Self::Strip];

    /// The element in XML, and the keyword in legacy files.
    const fn names(self) -> [&'static str; 2] {
        match self {
            Self::Vertex => ["Verts", "VERTICES"],
            Self::Line => ["Lines", "LINES"],
            Self::Polygon => ["Polys", "POLYGONS"],
            Self::Strip => ["Strips", "TRIANGLE_STRIPS"],
        }
    }

    /// The type in a grid, of a cell with this number of points.
    const fn kind(self, points: usize) -> i64 {
        match (self, points) {
            (Self::Vertex, 1) => 1,
            (Self::Vertex, _) => 2,
            (Self::Line, 2) => 3,
            (Self::Line, _) => 4,
            (Self::Polygon, _) => 7,
            (Self::Strip, _) => 6,
        }
    }
}

impl Picture {
    /// Returns the picture with its cells in the order of poly data.
    fn sorted(&self) -> Self {
        let mut order: Vec<usize> = (0..self.cells.len()).collect();
        order.sort_by_key(|cell| self.cells[*cell].0);
        let mut sorted = self.clone();
        sorted.cells = order.iter().map(|cell| self.cells[*cell].clone()).collect();
        for data in &mut sorted.cell_data {
            let of_order =
                |n: usize| order[n / data.components] * data.components + n % data.components;
            let count = order.len() * data.components;
            match &mut data.values {
                Values::Floats(values) if values.len() == count => {
                    *values = (0..count).map(|n| values[of_order(n)]).collect();
                }
                Values::Integers(values) if values.len() == count => {
                    *values = (0..count).map(|n| values[of_order(n)]).collect();
                }
                _ => {}
            }
        }
        sorted
    }

    fn cells(&self, kind: Cell) -> Vec<&[usize]> {
        let cells = self.cells.iter().filter(|(cell, _)| *cell == kind);
        cells.map(|(_, points)| &**points).collect()
    }

    fn points(&self) -> Data {
        let values = Values::Floats(self.points.iter().flatten().copied().collect());
        Data::new("Points", 3, values)
    }
}

impl Data {
    /// An array.
    #[must_use]
    pub fn new(name: &'static str, components: usize, values: Values) -> Self {
        Self {
            name,
            components,
            values,
        }
    }
}

impl Values {
    /// The number of values.
    fn len(&self) -> usize {
        match self {
            Self::Floats(values) => values.len(),
            Self::Integers(values) => values.len(),
            Self::Bits(count) | Self::Texts(count) | Self::NotNumbers(count) => *count,
        }
    }

    fn text(&self, of_text: &str) -> String {
        let mut text = String::new();
        match self {
            Self::Floats(values) => values.iter().for_each(|x| write!(text, "{x:?} ").unwrap()),
            Self::Integers(values) => values.iter().for_each(|n| write!(text, "{n} ").unwrap()),
            Self::Bits(count) => text = "1 ".repeat(*count),
            Self::Texts(count) => text = of_text.repeat(*count),
            Self::NotNumbers(count) => text = "-nan(ind) ".repeat(*count),
        }
        text
    }

    fn bytes(&self, is_narrow: bool, is_big: bool) -> Vec<u8> {
        let ordered = |mut bytes: Vec<u8>| {
            if is_big {
                bytes.reverse();
            }
            bytes
        };
        match self {
            Self::Floats(values) => {
                let values = values.iter().map(|x| ordered(x.to_le_bytes().to_vec()));
                values.flatten().collect()
            }
            Self::Integers(values) => {
                let size = if is_narrow { 4 } else { 8 };
                let values = values
                    .iter()
                    .map(|n| ordered(n.to_le_bytes()[..size].to_vec()));
                values.flatten().collect()
            }
            Self::Bits(count) => vec![0xff; count.div_ceil(8)],
            // A length of one byte, and the byte.
            Self::Texts(count) => b"\xc1\n".repeat(*count),
            Self::NotNumbers(count) => vec![0xff; 8 * count],
        }
    }
}

/// Draws an order of `count` things. It takes two bytes, whatever the number of things.
pub fn order(u: &mut Unstructured<'_>, count: usize) -> Result<Vec<usize>> {
    let mut order: Vec<usize> = (0..count).collect();
    let mut state = u64::from(u.arbitrary::<u16>()?);
    if state == 0 {
        return Ok(order);
    }
    for place in (1..count).rev() {
        // The generator of Knuth's MMIX.
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let other = usize::try_from(state >> 33).unwrap() % (place + 1);
        order.swap(place, other);
    }
    Ok(order)
}

/// Writes a file of any kind.
pub fn file(u: &mut Unstructured<'_>, picture: &Picture) -> Result<Vec<u8>> {
    let is_grid = u.arbitrary()?;
    let picture = if is_grid {
        picture.clone()
    } else {
        picture.sorted()
    };
    if u.arbitrary()? {
        legacy(u, &picture, is_grid)
    } else {
        xml(u, &picture, is_grid)
    }
}

/// The arrays of cells: the points, and the end of each cell.
fn cells(cells: &[&[usize]]) -> Vec<Data> {
    let index = |n: usize| i64::try_from(n).unwrap();
    let points = cells.iter().flat_map(|cell| cell.iter().map(|n| index(*n)));
    let ends = cells.iter().scan(0, |end, cell| {
        *end += index(cell.len());
        Some(*end)
    });
    vec![
        Data::new("connectivity", 1, Values::Integers(points.collect())),
        Data::new("offsets", 1, Values::Integers(ends.collect())),
    ]
}

/// The types of the cells of a grid.
fn types(picture: &Picture) -> Data {
    let types = picture
        .cells
        .iter()
        .map(|(cell, points)| cell.kind(points.len()));
    Data::new("types", 1, Values::Integers(types.collect()))
}

/// The encoding of the arrays of an XML file.
struct Coding {
    quote: char,
    is_big: bool,
    is_wide: bool,
    /// The length of a block.
    blocks: Option<usize>,
    is_raw: bool,
    appended: Vec<u8>,
}

fn xml(u: &mut Unstructured<'_>, picture: &Picture, is_grid: bool) -> Result<Vec<u8>> {
    let mut coding = Coding {
        quote: *u.choose(&['"', '\''])?,
        is_big: u.arbitrary()?,
        is_wide: u.arbitrary()?,
        blocks: *u.choose(&[None, Some(8), Some(1000)])?,
        is_raw: u.arbitrary()?,
        appended: Vec::new(),
    };
    let mut sections = vec![
        ("PointData", picture.point_data.clone()),
        ("CellData", picture.cell_data.clone()),
        ("Points", vec![picture.points()]),
    ];
    let mut counts = vec![("NumberOfPoints", picture.points.len())];
    if is_grid {
        let all: Vec<&[usize]> = picture.cells.iter().map(|(_, points)| &**points).collect();
        let mut arrays = cells(&all);
        arrays.push(types(picture));
        sections.push(("Cells", arrays));
        counts.push(("NumberOfCells", all.len()));
    } else {
        for kind in Cell::ALL {
            let of_kind = picture.cells(kind);
            let [name, _] = kind.names();
            counts.push((
                match kind {
                    Cell::Vertex => "NumberOfVerts",
                    Cell::Line => "NumberOfLines",
                    Cell::Polygon => "NumberOfPolys",
                    Cell::Strip => "NumberOfStrips",
                },
                of_kind.len(),
            ));
            // A section without cells may be left out.
            if !of_kind.is_empty() || u.arbitrary()? {
                sections.push((name, cells(&of_kind)));
            }
        }
    }
    let kind = if is_grid {
        "UnstructuredGrid"
    } else {
        "PolyData"
    };
    let mut file = String::new();
    if u.arbitrary()? {
        file += "<?xml version=\"1.0\"?>\n<!-- <AppendedData> begins below -->\n";
    }
    let attribute = |key: &str, value: &str, coding: &Coding| {
        let quote = coding.quote;
        format!(" {key}={quote}{value}{quote}")
    };
    file += "<VTKFile";
    file += &attribute("type", kind, &coding);
    file += &attribute(
        "byte_order",
        if coding.is_big {
            "BigEndian"
        } else {
            "LittleEndian"
        },
        &coding,
    );
    file += &attribute(
        "header_type",
        if coding.is_wide { "UInt64" } else { "UInt32" },
        &coding,
    );
    if coding.blocks.is_some() {
        file += &attribute("compressor", "vtkZLibDataCompressor", &coding);
    }
    write!(file, ">\n<{kind}>\n").unwrap();
    if u.arbitrary()? {
        file += "<FieldData><DataArray type=\"String\" Name=\"Title\" format=\"ascii\">112 0</DataArray></FieldData>\n";
    }
    file += "<Piece";
    for (key, count) in counts {
        file += &attribute(key, &count.to_string(), &coding);
    }
    file += ">\n";
    for place in order(u, sections.len())? {
        let (name, arrays) = &sections[place];
        writeln!(file, "<{name}>").unwrap();
        // The array of points is the only one of its section.
        for place in order(u, arrays.len())? {
            file += &array(u, &arrays[place], &mut coding)?;
        }
        writeln!(file, "</{name}>").unwrap();
    }
    writeln!(file, "</Piece>\n</{kind}>").unwrap();
    let mut file = file.into_bytes();
    if !coding.appended.is_empty() {
        let encoding = if coding.is_raw { "raw" } else { "base64" };
        let tag = attribute("encoding", encoding, &coding);
        write!(file, "<AppendedData{tag}>\n  _").unwrap();
        file.extend(coding.appended);
        file.extend(b"\n</AppendedData>\n");
    }
    file.extend(b"</VTKFile>\n");
    Ok(file)
}

fn array(u: &mut Unstructured<'_>, data: &Data, coding: &mut Coding) -> Result<String> {
    let is_narrow = u.arbitrary()?;
    let kind = match data.values {
        Values::Floats(_) | Values::NotNumbers(_) => "Float64",
        Values::Integers(_) if is_narrow => "Int32",
        Values::Integers(_) => "Int64",
        Values::Bits(_) => "Bit",
        Values::Texts(_) => "String",
    };
    let quote = coding.quote;
    let mut head = format!(
        "<DataArray type={quote}{kind}{quote} Name={quote}{}{quote}",
        data.name
    );
    if data.components != 1 || u.arbitrary()? {
        write!(
            head,
            " NumberOfComponents = {quote}{}{quote}",
            data.components
        )
        .unwrap();
    }
    // An array in memory of VTK may have statistics in its element.
    let extra = if u.arbitrary()? {
        "<InformationKey name=\"RANGE\"><Value index=\"0\">7</Value></InformationKey>"
    } else {
        ""
    };
    let bytes = data.values.bytes(is_narrow, coding.is_big);
    Ok(match u.int_in_range(0..=2)? {
        0 => {
            let text = data.values.text("112 0 ");
            let text = match u.int_in_range(0..=3)? {
                0 => text,
                1 => format!("<![CDATA[{text}]]>"),
                2 => text.replacen(' ', "&#32;", 1),
                _ => text.replacen(' ', " <!-- 7 --> ", 1),
            };
            format!("{head} format={quote}ascii{quote}>{text}{extra}</DataArray>\n")
        }
        1 => {
            let (head_bytes, bytes) = coding.encode(&bytes);
            let text = based(&head_bytes, &bytes, coding.blocks.is_some());
            format!("{head} format={quote}binary{quote}>\n {text}\n{extra}</DataArray>\n")
        }
        _ => {
            let offset = coding.appended.len();
            let (head_bytes, bytes) = coding.encode(&bytes);
            if coding.is_raw {
                coding.appended.extend(head_bytes);
                coding.appended.extend(bytes);
            } else {
                let text = based(&head_bytes, &bytes, coding.blocks.is_some());
                coding.appended.extend(text.into_bytes());
            }
            format!(
                "{head} format={quote}appended{quote} offset={quote}{offset}{quote}>{extra}</DataArray>\n"
            )
        }
    })
}

fn based(head: &[u8], bytes: &[u8], is_compressed: bool) -> String {
    if is_compressed {
        STANDARD.encode(head) + &STANDARD.encode(bytes)
    } else {
        STANDARD.encode([head, bytes].concat())
    }
}

impl Coding {
    /// Returns the header of an array, and its bytes.
    fn encode(&self, bytes: &[u8]) -> (Vec<u8>, Vec<u8>) {
        let number = |n: usize| {
            let mut bytes = n.to_le_bytes().to_vec();
            bytes.resize(8, 0);
            bytes.truncate(if self.is_wide { 8 } else { 4 });
            if self.is_big {
                bytes.reverse();
            }
            bytes
        };
        let Some(length) = self.blocks else {
            return (number(bytes.len()), bytes.to_vec());
        };
        let blocks: Vec<Vec<u8>> = bytes.chunks(length).map(packed).collect();
        let numbers = [blocks.len(), length, bytes.len() % length].into_iter();
        let numbers = numbers.chain(blocks.iter().map(Vec::len));
        (numbers.flat_map(number).collect(), blocks.concat())
    }
}

fn packed(block: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(block).unwrap();
    encoder.finish().unwrap()
}

fn legacy(u: &mut Unstructured<'_>, picture: &Picture, is_grid: bool) -> Result<Vec<u8>> {
    let mut legacy = Legacy {
        file: Vec::new(),
        is_binary: u.arbitrary()?,
        is_new: u.arbitrary()?,
    };
    let version = if legacy.is_new { "5.1" } else { "3.0" };
    let form = if legacy.is_binary { "BINARY" } else { "ASCII" };
    let set = if is_grid {
        "UNSTRUCTURED_GRID"
    } else {
        "POLYDATA"
    };
    legacy.line(&format!(
        "# vtk DataFile Version {version}\nnot \"the\" title\n{form}\nDATASET {set}"
    ));
    if u.arbitrary()? {
        legacy.line("FIELD FieldData 1\nTIME 1 1 double");
        legacy.values(&Values::Floats(vec![0.5]), false);
    }
    legacy.line(&format!("POINTS {} double", picture.points.len()));
    legacy.values(&picture.points().values, false);
    legacy.metadata(u)?;
    if is_grid {
        let all: Vec<&[usize]> = picture.cells.iter().map(|(_, points)| &**points).collect();
        legacy.cells("CELLS", &all);
        let types = types(picture);
        legacy.line(&format!("CELL_TYPES {}", types.values.len()));
        legacy.values(&types.values, true);
    } else {
        for place in order(u, 4)? {
            let [_, keyword] = Cell::ALL[place].names();
            legacy.cells(keyword, &picture.cells(Cell::ALL[place]));
        }
    }
    let data = [
        ("POINT_DATA", picture.points.len(), &picture.point_data),
        ("CELL_DATA", picture.cells.len(), &picture.cell_data),
    ];
    for place in order(u, 2)? {
        let (keyword, count, arrays) = data[place];
        legacy.line(&format!("{keyword} {count}"));
        for data in arrays {
            legacy.array(u, data, count)?;
            legacy.metadata(u)?;
        }
    }
    Ok(legacy.file)
}

/// A legacy file.
struct Legacy {
    file: Vec<u8>,
    is_binary: bool,
    is_new: bool,
}

impl Legacy {
    fn line(&mut self, line: &str) {
        self.file.extend(line.bytes());
        self.file.push(b'\n');
    }

    fn values(&mut self, values: &Values, is_narrow: bool) {
        self.file.extend(if self.is_binary {
            values.bytes(is_narrow, true)
        } else {
            values.text("a title\n").into_bytes()
        });
        self.file.push(b'\n');
    }

    fn metadata(&mut self, u: &mut Unstructured<'_>) -> Result<()> {
        if u.arbitrary()? {
            self.line("METADATA\nINFORMATION 1\nNAME RANGE LOCATION vtkDataArray\nDATA 2 0 1\n");
        }
        Ok(())
    }

    fn cells(&mut self, keyword: &str, of_kind: &[&[usize]]) {
        if of_kind.is_empty() {
            return;
        }
        let points: usize = of_kind.iter().map(|cell| cell.len()).sum();
        let count = of_kind.len();
        let integers = |numbers: Vec<usize>| {
            let numbers = numbers.into_iter().map(|n| i64::try_from(n).unwrap());
            Values::Integers(numbers.collect())
        };
        if !self.is_new {
            self.line(&format!("{keyword} {count} {}", count + points));
            let numbers = of_kind.iter().map(|cell| [&[cell.len()], *cell].concat());
            self.values(&integers(numbers.flatten().collect()), true);
            return;
        }
        self.line(&format!(
            "{keyword} {} {points}\nOFFSETS vtktypeint64",
            count + 1
        ));
        let ends = of_kind.iter().scan(0, |end, cell| {
            *end += cell.len();
            Some(*end)
        });
        self.values(&integers([0].into_iter().chain(ends).collect()), false);
        self.line("CONNECTIVITY vtktypeint64");
        self.values(&integers(of_kind.concat()), false);
    }

    fn array(&mut self, u: &mut Unstructured<'_>, data: &Data, count: usize) -> Result<()> {
        let is_narrow = u.arbitrary()?;
        let kind = match data.values {
            Values::Floats(_) | Values::NotNumbers(_) => "double",
            Values::Integers(_) if is_narrow => "int",
            Values::Integers(_) => "long",
            Values::Bits(_) => "bit",
            Values::Texts(_) => "string",
        };
        let (name, components) = (data.name, data.components);
        // Only the arrays of a field may have another length than the number of points or cells.
        let fits = data.values.len() == count * components;
        self.line(&match u.int_in_range(0..=1)? {
            0 if fits && components == 1 => {
                format!("SCALARS {name} {kind} 1\nLOOKUP_TABLE default")
            }
            0 if fits && components == 3 => format!("VECTORS {name} {kind}"),
            _ => {
                let tuples = data.values.len() / components;
                format!("FIELD FieldData 1\n{name} {components} {tuples} {kind}")
            }
        });
        self.values(&data.values, is_narrow);
        Ok(())
    }
}
