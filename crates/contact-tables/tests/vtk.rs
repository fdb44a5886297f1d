//! The rules of VTK, one small file each.

use contact_tables::{Columns, Force, Format, Identity, RowCounts};

const FORCE: &str = "0.46225016352102427 0.46225016352102427 0.46225016352102427";
const POINTS: &str = "0 0 1 1 0 0 -1 1 0 -1 -1 0";

/// An array of a file.
fn array(kind: &str, name: &str, values: &str) -> String {
    format!("<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">{values}</DataArray>\n")
}

fn file(kind: &str, piece: &str) -> String {
    format!("<VTKFile type=\"{kind}\"><{kind}>{piece}</{kind}></VTKFile>")
}

/// The data of three contacts of a pile of two layers, with their numbers.
fn data(force: &str) -> String {
    [
        array("Int32", "id1", "1 1 1"),
        array("Int32", "id2", "2 3 4"),
        array("Float64", "force", force),
    ]
    .concat()
}

fn points() -> String {
    let points = array("Float32", "Points", POINTS);
    let points = points.replace("Name", "NumberOfComponents=\"3\" Name");
    format!("<Points>{points}</Points>\n")
}

/// Cells between the points of a pile of two layers.
fn cells(tag: &str, connectivity: &str, offsets: &str, more: &str) -> String {
    let [connectivity, offsets] = [("connectivity", connectivity), ("offsets", offsets)]
        .map(|(name, values)| array("Int64", name, values));
    format!("<{tag}>{connectivity}{offsets}{more}</{tag}>\n")
}

fn lines() -> String {
    cells("Lines", "0 1 0 2 0 3", "2 4 6", "")
}

/// A file with three contacts as lines.
fn poly_data(attributes: &str, others: &str, force: &str) -> String {
    let (points, lines, data) = (points(), lines(), data(force));
    file(
        "PolyData",
        &format!("<Piece {attributes}>{others}{points}{lines}<CellData>{data}</CellData></Piece>"),
    )
}

/// The forces of the rows that are read.
fn read(file: &[u8], format: &Format) -> Result<(Vec<f64>, RowCounts), String> {
    let mut forces = Vec::new();
    let mut contacts = contact_tables::read(file, format).map_err(|error| error.to_string())?;
    for row in contacts.by_ref() {
        match row.map_err(|error| error.to_string())?.force {
            Force::Along(force) | Force::Both(force, _) => forces.push(force),
            Force::Vector(vector) => panic!("{vector:?}"),
        }
    }
    Ok((forces, contacts.rows().clone()))
}

/// The forces of the rows that are read by the numbers of the spheres.
fn forces(file: &str) -> Result<Vec<f64>, String> {
    Ok(read(file.as_bytes(), &Format::default())?.0)
}

/// Returns the number of rows that are read, and what was left out.
fn by_columns(file: &[u8], columns: &str) -> Result<(u64, String), String> {
    let (_, rows) = read(file, &Format::of(columns.parse::<Columns>().unwrap()))?;
    Ok((rows.used, rows.to_string()))
}

/// Returns why a file is refused, if spheres are known by position.
fn by_place(file: &str) -> String {
    let format = Format {
        identity: Identity::Places,
        ..Format::default()
    };
    read(file.as_bytes(), &format).unwrap_err()
}

#[test]
fn texts_are_kinds_of_contacts() {
    // The numbers of the bytes, and the bytes after their number.
    let text = array("String", "type", "83 83 0 83 77 0 83 83 0").replace("DataArray", "Array");
    let binary =
        "<Array type=\"String\" Name=\"type\" format=\"binary\">CQAAAFNTAFNNAFNTAA==</Array>";
    let xml =
        |kind: &str| poly_data("", "", FORCE).replace("<CellData>", &format!("<CellData>{kind}"));
    let legacy = "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 4 double\n0 0 1 1 0 0 -1 1 0 -1 -1 0\n\
                  LINES 3 9\n2 0 1 2 0 2 2 0 3\nCELL_DATA 3\nFIELD FieldData 4\ntype 1 3 string\nSS\nSM\nSS\n\
                  id1 1 3 int\n1 1 1\nid2 1 3 int\n2 3 4\nforce 1 3 double\n0.5 0.5 0.5\n";
    for file in [xml(&text), xml(binary), legacy.to_owned()] {
        let read = by_columns(file.as_bytes(), "kind=type:SS");
        assert_eq!(read, Ok((2, "1 row of another kind".into())), "{file}");
    }
}

#[test]
fn ghosts_are_left_out() {
    let ghosts = |values: &str| {
        let ghosts = array("UInt8", "vtkGhostType", values);
        poly_data("", "", FORCE).replace("<CellData>", &format!("<CellData>{ghosts}"))
    };
    // Other bits do not mark ghosts.
    assert_eq!(forces(&ghosts("0 2 0")).unwrap().len(), 3);
    let read = by_columns(ghosts("1 0 3").as_bytes(), "force=force");
    assert_eq!(read, Ok((1, "2 rows of other kinds".into())));
    // A line from a ghost to a sphere of the piece is one of its contacts.
    let points = array("UInt8", "vtkGhostType", "1 0 0 0");
    let file = poly_data("", "", FORCE).replace(
        "<Points>",
        &format!("<PointData>{points}</PointData><Points>"),
    );
    assert_eq!(forces(&file).unwrap().len(), 3);
}

#[test]
fn xml_in_utf_16_is_read() {
    let file =
        "<?xml version=\"1.0\" encoding=\"UTF-16\"?>\n".to_owned() + &poly_data("", "", FORCE);
    for mark in [Some(0xfeff), None] {
        let units = mark.into_iter().chain(file.encode_utf16());
        let bytes: Vec<u8> = units.flat_map(u16::to_le_bytes).collect();
        let read = by_columns(&bytes, "force=force");
        assert_eq!(read, Ok((3, String::new())));
    }
}

#[test]
fn cell_data_run_over_vertices_lines_polygons_and_strips() {
    // The sections may have any order, and their numbers may be left out.
    let vertices = cells("Verts", "0 1 2 3", "3 4", "");
    let polygons = cells("Polys", "1 2 3", "3", "");
    let strips = cells("Strips", "0 1 2 3", "4", "");
    let others = [strips, polygons, vertices].concat();
    for attributes in [
        "",
        "NumberOfPoints=\"4\" NumberOfVerts='2' NumberOfLines = \"3\" NumberOfPolys=\"1\" NumberOfStrips=\"1\"",
    ] {
        let of_cells = |values: &str| {
            let file = poly_data(attributes, &others, values);
            file.replace("1 1 1<", "0 0 1 1 1 0 0<")
                .replace("2 3 4<", "0 0 2 3 4 0 0<")
        };
        let right = forces(&of_cells("7 8 0.1 0.2 0.3 9 10"));
        assert_eq!(right, Ok(vec![0.1, 0.2, 0.3]));
        assert_eq!(
            forces(&of_cells("0.1 0.2 0.3")),
            Err("array force: 3 values for 7 cells (vertices: 2, lines: 3, polygons: 1, triangle strips: 1) of 1 component".into())
        );
    }
}

#[test]
fn arrays_have_a_value_for_each_cell_or_point() {
    for (values, said) in [
        ("1 2", "array force: 2 values for 3 cells of 1 component"),
        (
            "1 2 3 4",
            "array force: 4 values for 3 cells of 1 component",
        ),
        ("", "array force: 0 values for 3 cells of 1 component"),
    ] {
        assert_eq!(forces(&poly_data("", "", values)), Err(said.into()));
    }
    let two_lines = poly_data("NumberOfLines=\"2\"", "", "1 2")
        .replace("1 1 1<", "1 1<")
        .replace("2 3 4<", "2 3<");
    assert_eq!(
        forces(&two_lines),
        Err("a piece has 2 lines, but its array offsets is that of 3 lines".into())
    );
    let of_points = |values: &str| {
        let file = poly_data("NumberOfPoints=\"4\"", "", "0.1 0.2 0.3");
        let force = array("Float64", "force", values);
        let own = array("Float64", "force", "0.1 0.2 0.3");
        file.replace(&own, "").replace(
            "<Points>",
            &format!("<PointData>{force}</PointData><Points>"),
        )
    };
    // A line has the value of its first point.
    assert_eq!(forces(&of_points("5 6 7 8")), Ok(vec![5.0; 3]));
    assert_eq!(
        forces(&of_points("5 6 7")),
        Err("array force: 3 values for 4 points of 1 component".into())
    );
}

#[test]
fn what_is_not_needed_is_not_decoded() {
    let others = [
        array("String", "title", "112 0").replace("DataArray", "Array"),
        array("Bit", "flag", "1 0 1"),
        array("Float64", "vel", "-nan(ind) 1 x"),
        array("Float128", "wide", "?"),
        "<DataArray type=\"Float64\" Name=\"gone\" format=\"appended\" offset=\"99999\"/>"
            .to_owned(),
        "<DataArray type=\"Float64\" Name=\"cut\" format=\"binary\">AAA</DataArray>".to_owned(),
    ]
    .concat();
    let plain = poly_data("", "", FORCE);
    let data = "<CellData>";
    let with_others = plain.replace(
        data,
        &format!("<FieldData>{others}</FieldData>{data}{others}"),
    );
    assert_eq!(forces(&with_others), forces(&plain));
    // The points are not needed with the numbers of spheres.
    let without_points = with_others.replace(POINTS, "1 2");
    assert_eq!(forces(&without_points), forces(&plain));
    let refused = by_place(&without_points);
    assert_eq!(
        refused,
        "array Points: 2 values for 0 points of 3 components"
    );
    for (name, said) in [
        ("title", "array title: 1 values for 3 cells of 1 component"),
        ("wide", "array wide: 'Float128' is not one of the types"),
        ("flag", "array flag: 'Bit' is not one of the types"),
        ("vel", "array vel: '-nan(ind)' is not a number"),
        ("gone", "array gone: it is not in the appended data"),
        ("cut", "array cut: it is cut off"),
    ] {
        let refused = by_columns(with_others.as_bytes(), &format!("force={name}")).unwrap_err();
        assert!(refused.starts_with(said), "{refused}");
    }
}

#[test]
fn rows_of_a_grid_are_its_lines() {
    let grid = |types: &str, connectivity: &str, offsets: &str, values: [&str; 3]| {
        let types = array("UInt8", "types", types);
        let cells = cells("Cells", connectivity, offsets, &types);
        let names = [("Int32", "id1"), ("Int32", "id2"), ("Float64", "force")];
        let data = names.iter().zip(values);
        let data: String = data
            .map(|((kind, name), values)| array(kind, name, values))
            .collect();
        let points = points();
        file(
            "UnstructuredGrid",
            &format!(
                "<Piece NumberOfPoints=\"4\">{points}{cells}<CellData>{data}</CellData></Piece>"
            ),
        )
    };
    // A vertex, a line, a triangle, a chain of one line, a tetrahedron.
    let connectivity = "0 0 1 1 2 3 0 2 0 1 2 3";
    let offsets = "1 3 6 8 12";
    let values = ["0 1 0 1 0", "0 2 0 3 0", "7 0.25 7 0.5 7"];
    let mixed = grid("1 3 5 4 10", connectivity, offsets, values);
    assert_eq!(forces(&mixed), Ok(vec![0.25, 0.5]));
    // Without lines, vertices are rows. The tetrahedron is of type 10.
    let vertices = grid(
        "1 5 1 10",
        "0 1 2 3 1 0 1 2 3",
        "1 4 5 9",
        ["1 0 1 0", "2 0 3 0", "0.25 7 0.5 7"],
    );
    assert_eq!(forces(&vertices), Ok(vec![0.25, 0.5]));
    for (types, said) in [
        (
            "5 5 5 5 5",
            "the file has no lines and no vertices: contacts are lines between centres, or points with data",
        ),
        ("1 3 5 4", "array types: 4 values for 5 cells"),
        (
            "1 3 4 4 10",
            "line 2: it has 3 points, not two; is this a table of contacts?",
        ),
    ] {
        let file = grid(types, connectivity, offsets, values);
        assert_eq!(forces(&file), Err(said.into()));
    }
    let without_types = mixed.replace("\"types\"", "\"kinds\"");
    assert_eq!(
        forces(&without_types),
        Err("a piece has no array types for its cells".into())
    );
}

#[test]
fn points_outside_the_file_are_refused() {
    for (connectivity, offsets) in [
        ("0 1 0 2 0 4", "2 4 6"),
        ("0 1 0 2 0 -1", "2 4 6"),
        ("0 1 0 2 0", "2 4 6"),
        ("0 1 0 2 0 3", "2 4 -6"),
        ("0 1 0 2 0 3", "2 4 3"),
    ] {
        let file = poly_data("", "", FORCE)
            .replace("0 1 0 2 0 3", connectivity)
            .replace("2 4 6", offsets);
        let refused = by_place(&file);
        assert_eq!(refused, "line 3: it has a point that is not in the file");
    }
    let three = poly_data("", "", FORCE).replace("2 4 6", "3 4 6");
    assert_eq!(
        forces(&three),
        Err("line 1: it has 3 points, not two; is this a table of contacts?".into())
    );
    let floats = poly_data("", "", FORCE).replace("Int64", "Float64");
    assert_eq!(
        forces(&floats),
        Err("array connectivity: 'Float64' is not an integer type such as UInt8 or Int64".into())
    );
}

#[test]
fn xml_is_read_by_its_rules() {
    let plain = poly_data("", "", "0.25 0.5 0.75");
    let right = Ok(vec![0.25, 0.5, 0.75]);
    for (from, to) in [
        ("\"", "'"),
        ("Name=\"force\"", "Name = \"f&#x6f;rce\""),
        ("0.25 0.5 0.75", "<![CDATA[0.25 0.5]]> 0.75"),
        ("0.25 0.5 0.75", "0.25 <!-- 7 --> 0.5 &#48;.75"),
        (
            "0.25 0.5 0.75",
            "0.25<?it is?> 0.5 0.75<InformationKey><Value index=\"0\">7</Value></InformationKey>",
        ),
        (
            "<VTKFile",
            "\u{feff}<?xml version=\"1.0\"?>\n<!-- <AppendedData> -->\n<VTKFile compressor=\"vtkLZ4DataCompressor\"",
        ),
        ("<VTKFile", "\n <VTKFile"),
    ] {
        assert!(plain.contains(from));
        assert_eq!(forces(&plain.replace(from, to)), right, "{to}");
    }
    for (from, to, said) in [
        ("</Piece>", "", "not valid XML"),
        (
            "0.25 0.5",
            "0.25 &nbsp; 0.5",
            "the entity &nbsp; is unknown",
        ),
        (
            "VTKFile",
            "svg",
            "XML with the root element svg, not a VTK file",
        ),
        (
            "VTKFile type=\"PolyData\"",
            "VTKFile",
            "the element VTKFile has no type, such as PolyData",
        ),
        (
            "PolyData",
            "ImageData",
            "a VTK file of type ImageData without files",
        ),
        (
            "</VTKFile>",
            "",
            "the file ends within its XML: it is not complete",
        ),
    ] {
        let refused = forces(&plain.replace(from, to)).unwrap_err();
        assert!(refused.contains(said), "{refused}");
    }
    assert_eq!(
        forces("<!-- nothing -->"),
        Err("the file has no element VTKFile".into())
    );
    let packed = plain
        .replace("<VTKFile", "<VTKFile compressor=\"vtkLZMADataCompressor\"")
        .replace("ascii\">0.25 0.5 0.75", "binary\">AQAAAIAAAAAYAAAAEAAAAA==");
    assert_eq!(
        forces(&packed),
        Err("array force: it is compressed by vtkLZMADataCompressor: write the file with zlib (vtkZLibDataCompressor), without \
             compression or as text".into())
    );
}

#[test]
fn legacy_files_are_read_by_their_rules() {
    let text = "# vtk DataFile Version 3.0\nany title\nASCII\nDATASET POLYDATA\nFIELD FieldData 2\nTIME 1 1 double\n\
                0.5\nNotes 1 2 string\na note\nanother%20one\nPOINTS 4 float\n0 0 1 1 0 0\n-1 1 0 -1 -1 0\n\
                METADATA\nINFORMATION 0\n\n\
                LINES 3 9\n2 0 1\n2 0 2\n2 0 3\nPOLYGONS 1 4\n3 1 2 3\nVERTICES 1 5\n4 0 1 2 3\n\
                POINT_DATA 4\nNORMALS n float\n0 0 1 0 0 1 0 0 1 0 0 1\nTEXTURE_COORDINATES t 2 float\n1 2 3 4 5 6 7 8\n\
                CELL_DATA 5\nSCALARS force double\nLOOKUP_TABLE mine\n9 0.25 0.5 0.75 9\n\
                LOOKUP_TABLE mine 2\n0 0 0 1 1 1 1 1\nCOLOR_SCALARS c 3\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n\
                FIELD FieldData 5\nid1 1 5 int\n0 1 1 1 0\nid%32 1 5 vtkIdType\n0 2 3 4 0\nNULL_ARRAY\nbits 1 5 bit\n1 0 1 0 1\n\
                vel 3 5 double\n-nan(ind) 1 2 3 4 5 6 7 8 9 10 11 12 13 14\n";
    let right = Ok(vec![0.25, 0.5, 0.75]);
    assert_eq!(forces(text), right);
    for (from, to) in [
        ("\n", "\r\n"),
        (
            "LINES 3 9\n2 0 1\n2 0 2\n2 0 3",
            "lines 4 6\nOFFSETS vtktypeint64\n0 2 4 6\nCONNECTIVITY vtktypeint64\n0 1 0 2 0 3",
        ),
        ("force double\n", "force double 1\n"),
    ] {
        assert!(text.contains(from));
        assert_eq!(forces(&text.replace(from, to)), right, "{to}");
    }
    for (from, to, said) in [
        (
            "Notes 1 2 string",
            "Notes 1 99999999999 string",
            "the file ends within an array or a keyword: it is not complete",
        ),
        (
            "ASCII",
            "TEXT",
            "the third line of a legacy VTK file is ASCII or BINARY, not TEXT",
        ),
        (
            "POLYDATA",
            "STRUCTURED_POINTS",
            "the data set is STRUCTURED_POINTS: contacts are lines or vertices",
        ),
        ("VERTICES", "CORNERS", "the keyword CORNERS is unknown"),
        (
            "LOOKUP_TABLE mine\n",
            "",
            "the scalars force have no LOOKUP_TABLE",
        ),
        ("vtkIdType", "number", "the number type number is unknown"),
        ("POINTS 4", "POINTS four", "four is not a number of points"),
        (
            " 13 14",
            "",
            "the file ends within an array or a keyword: it is not complete",
        ),
        (
            "VERTICES 1 5\n4 0 1 2 3\n",
            "",
            "array force: 5 values for 4 cells (lines: 3, polygons: 1) of 1 component",
        ),
        (
            "2 0 3\n",
            "2 0 9\n",
            "line 3: it has a point that is not in the file",
        ),
        (
            "LINES 3",
            "LINES 2",
            "array force: 5 values for 4 cells (vertices: 1, lines: 2, polygons: 1) of 1 component",
        ),
    ] {
        assert!(text.contains(from));
        let file = text.replace(from, to);
        let refused = by_place(&file);
        assert!(refused.contains(said), "{refused}, not {said}");
    }
}

#[test]
fn every_component_of_an_array_is_a_column() {
    let data = data(FORCE).replace(
        &array("Int32", "id1", "1 1 1"),
        &array("Int32", "ids", "1 2 1 3 1 4").replace("Name", "NumberOfComponents=\"2\" Name"),
    );
    let whole = file(
        "PolyData",
        &format!(
            "<Piece>{}{}<CellData>{data}</CellData></Piece>",
            points(),
            lines()
        ),
    );
    let read = by_columns(whole.as_bytes(), "id1=ids_0,id2=ids_1");
    assert_eq!(read, Ok((3, String::new())));
}

#[test]
fn attributes_with_other_values_are_refused() {
    let counts = "NumberOfPoints, NumberOfVerts, NumberOfLines, NumberOfPolys, NumberOfStrips or NumberOfCells";
    let plain = poly_data("NumberOfPoints=\"4.0\" NumberOfCells=\"3\"", "", FORCE);
    let plain = plain.replace(
        "<VTKFile",
        "<VTKFile byte_order=\"LittleEndian\" header_type=\"UInt32\"",
    );
    assert_eq!(forces(&plain).unwrap().len(), 3);
    for (from, to, said) in [
        (
            "LittleEndian",
            "MiddleEndian",
            "byte_order 'MiddleEndian' is not LittleEndian or BigEndian".to_owned(),
        ),
        (
            "\"UInt32\"",
            "\"UInt16\"",
            "header_type 'UInt16' is not UInt32 or UInt64".to_owned(),
        ),
        (
            "NumberOfPoints",
            "NumberOfPoint",
            format!("the attribute 'NumberOfPoint' is not one of a piece: {counts}"),
        ),
        (
            "NumberOfPoints=\"4.0\"",
            "NumberOfPoints=\"four\"",
            "NumberOfPoints 'four' is not a number such as 12".to_owned(),
        ),
        (
            "Name=\"force\" format=\"ascii\"",
            "Name=\"force\" format=\"hex\"",
            "array force: format 'hex' is not ascii, binary or appended".to_owned(),
        ),
        (
            "Name=\"force\"",
            "Name=\"force\" NumberOfComponents=\"one\"",
            "array force: NumberOfComponents 'one' is not a number such as 3".to_owned(),
        ),
        (
            "</VTKFile>",
            "<AppendedData encoding=\"hex\">_</AppendedData></VTKFile>",
            "encoding 'hex' is not raw or base64".to_owned(),
        ),
        (
            "<CellData>",
            "<CellData><DataArray type=\"Float32\" Name=\"vtkGhostType\">0 1 0</DataArray>",
            "array vtkGhostType: 'Float32' is not an integer type such as UInt8 or Int64"
                .to_owned(),
        ),
    ] {
        assert!(plain.contains(from), "{from}");
        assert_eq!(forces(&plain.replacen(from, to, 1)), Err(said));
    }
}
