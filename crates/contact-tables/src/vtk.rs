//! Contacts in the files of VTK: XML (`.vtp`, `.vtu`), legacy (`.vtk`), and the files that name the pieces of one table
//! (`.pvtp`, `.pvtu`).
//!
//! Each line between two points is a row of a table. In a file without lines, each vertex is a row, or each point if there
//! are no cells either.

mod array;
mod coding;
mod connections;
mod files;
mod legacy;
mod piece;
mod table;
mod values;
mod words;
mod xml;

pub(crate) use files::Open;

use files::{named, opened, parse};
use piece::Kind;

use crate::contact::Contact;
use crate::error::Error;
use crate::format::Format;
use crate::steps::Steps;

/// Reads the contacts of a file as rows, and those of the files that it names. Rows are numbered from 1.
pub(crate) fn read(
    bytes: &[u8],
    format: &Format,
    open: Option<Open<'_>>,
    steps: &mut Steps,
    rows: &mut Vec<Contact>,
) -> Result<(), Error> {
    let document = parse(bytes)?;
    let files = opened(&document.files, open)?;
    let mut documents = vec![("", document)];
    for (name, bytes) in &files {
        let document = named(name, parse(bytes))?;
        if !document.files.is_empty() {
            let reason = "it names other files in turn: give it instead";
            return named(name, Err(Error::Vtk(reason.into())));
        }
        documents.push((name, document));
    }
    // Beside lines, vertices and points are not rows: they are the spheres.
    let mut kind = Kind::None;
    let mut pieces = Vec::new();
    for (name, document) in &documents {
        for piece in &document.pieces {
            let own = named(name, piece.kind())?;
            kind = kind.max(own);
            pieces.push((name, own, piece));
        }
    }
    let mut line = 0;
    for (name, _, piece) in pieces.iter().filter(|(_, own, _)| *own == kind) {
        if kind >= Kind::Points {
            let read = table::read(piece, kind, format, &mut line, steps, rows);
            named(name, read)?;
        }
    }
    if line > 0 {
        return Ok(());
    }
    let found = match kind {
        Kind::None => "no points",
        _ => "no lines and no vertices",
    };
    Err(Error::Vtk(format!(
        "the file has {found}: contacts are lines between centres, or points with data"
    )))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::Spheres;

    /// A file with one line between two points.
    fn line(ids: [u64; 2], force: &str) -> String {
        format!(
            "<VTKFile type='PolyData'><PolyData><Piece NumberOfPoints='2' NumberOfLines='1'><CellData>\
             <DataArray type='Int32' Name='id1'>{}</DataArray><DataArray type='Int32' Name='id2'>{}</DataArray>\
             <DataArray type='Float64' Name='force'>{force}</DataArray></CellData><Points><DataArray type='Float64'>\
             0 0 1 0 0 0</DataArray></Points><Lines><DataArray type='Int32' Name='connectivity'>0 1</DataArray>\
             <DataArray type='Int32' Name='offsets'>2</DataArray></Lines></Piece></PolyData></VTKFile>",
            ids[0], ids[1]
        )
    }

    fn pieces(kind: &str, names: &[&str]) -> String {
        let names = names
            .iter()
            .map(|name| format!("<Piece Source=\"{name}\"/>"));
        let names: String = names.collect();
        format!("<VTKFile type=\"{kind}\"><{kind} GhostLevel=\"0\">{names}</{kind}></VTKFile>")
    }

    /// Reads the first of some files, which may name the others. Returns the numbers of the spheres in their rows.
    fn read_files(files: &[(&str, &str)]) -> Result<Vec<[i64; 2]>, String> {
        let open = |name: &str| {
            let mut files = files.iter().skip(1);
            match files.find(|(known, _)| *known == name) {
                Some((_, content)) => Ok(content.as_bytes().to_vec()),
                None => Err(std::io::Error::from(std::io::ErrorKind::NotFound).into()),
            }
        };
        let (mut steps, mut rows) = (Steps::new(&Format::default()), Vec::new());
        let (first, format) = (files[0].1.as_bytes(), Format::default());
        let read = read(first, &format, Some(&open), &mut steps, &mut rows);
        read.map_err(|error| error.to_string())?;
        let ids = rows.iter().filter_map(|row| match row.spheres {
            Spheres::Numbers(ids) => Some(ids),
            Spheres::Places(_) => None,
        });
        Ok(ids.collect())
    }

    #[test]
    fn the_pieces_beside_a_file_form_one_table() {
        let whole = pieces("PPolyData", &["a.vtp", "ranks/b.vtp", "empty.vtp"]);
        let (a, b) = (line([1, 2], "0.5"), line([1, 3], "0.25"));
        let empty =
            "<VTKFile type='PolyData'><PolyData><Piece NumberOfPoints='0'/></PolyData></VTKFile>";
        let files = [
            ("it.pvtp", &*whole),
            ("a.vtp", &a),
            ("ranks/b.vtp", &b),
            ("empty.vtp", empty),
        ];
        assert_eq!(read_files(&files).unwrap(), [[1, 2], [1, 3]]);
    }

    #[test]
    fn a_piece_that_cannot_be_read_is_named() {
        let whole = pieces("PUnstructuredGrid", &["a.vtu"]);
        let refused = |files: &[(&str, &str)]| read_files(files).unwrap_err();
        let missing = refused(&[("it.pvtu", &whole)]);
        assert_eq!(missing, "a.vtu: entity not found");
        let broken = refused(&[
            ("it.pvtu", &whole),
            ("a.vtu", "<VTKFile type='PolyData'><PolyData>"),
        ]);
        assert_eq!(
            broken,
            "a.vtu: the file ends within its XML: it is not complete"
        );
        let picture = refused(&[
            ("it.pvtu", &whole),
            ("a.vtu", "<VTKFile type='ImageData'/>"),
        ]);
        assert!(
            picture.starts_with("a.vtu: a VTK file of type ImageData without files"),
            "{picture}"
        );
        let other = line([1, 2], "0.5").replace("'force'", "'power'");
        let lacks = refused(&[("it.pvtu", &whole), ("a.vtu", &other)]);
        assert!(
            lacks.starts_with("line 1: a.vtu: no column force, only"),
            "{lacks}"
        );
        for name in [
            "../a.vtu",
            "/data/a.vtu",
            "C:\\data\\a.vtu",
            "file:///a.vtu",
            "a/../../b.vtu",
        ] {
            let outside = refused(&[("it.pvtu", &pieces("PPolyData", &[name]))]);
            assert!(
                outside.contains("is not in the folder of the file that names it"),
                "{outside}"
            );
        }
        let own = pieces("PPolyData", &["own.pvtp"]);
        let endless = refused(&[("own.pvtp", &own), ("own.pvtp", &own)]);
        assert_eq!(
            endless,
            "own.pvtp: it names other files in turn: give it instead"
        );
    }

    #[test]
    fn without_access_to_other_files_they_are_named() {
        let whole = pieces("PUnstructuredGrid", &["chains.0.vtu", "chains.1.vtu"]);
        let (mut steps, mut rows) = (Steps::new(&Format::default()), Vec::new());
        let format = Format::default();
        let read = read(whole.as_bytes(), &format, None, &mut steps, &mut rows);
        assert_eq!(
            read.unwrap_err().to_string(),
            "the contacts are in other files: give 'chains.0.vtu', 'chains.1.vtu' instead"
        );
    }

    #[test]
    fn files_that_only_name_others_are_refused() {
        let set = |name: &str| format!("<DataSet timestep='1' file='{name}'/>");
        for (kind, sets) in [
            ("Collection", set("run/a.vtp") + &set("run/b.vtp")),
            (
                "vtkMultiBlockDataSet",
                format!("<Block>{}</Block>{}", set("run/a.vtp"), set("run/b.vtp")),
            ),
        ] {
            let whole = format!("<VTKFile type='{kind}'><{kind}>{sets}</{kind}></VTKFile>");
            let refused = read_files(&[("it.pvd", &*whole)]).unwrap_err();
            let want = format!(
                "a VTK file of type {kind} only names others: give the one with the contacts, of 'run/a.vtp', 'run/b.vtp'"
            );
            assert_eq!(refused, want);
        }
    }

    #[test]
    fn spheres_in_other_pieces_are_not_contacts() {
        let spheres = "# vtk DataFile Version 2.0\nspheres\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\n\
                       VERTICES 1 2\n1 0\n";
        let walls = "# vtk DataFile Version 2.0\nwalls\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n\
                     POLYGONS 1 4\n3 0 1 2\n";
        let whole = pieces("PPolyData", &["spheres.vtk", "contacts.vtp", "walls.vtk"]);
        let contacts = line([1, 2], "0.5");
        let files = [
            ("it.pvtp", &*whole),
            ("spheres.vtk", spheres),
            ("contacts.vtp", &contacts),
            ("walls.vtk", walls),
        ];
        assert_eq!(read_files(&files).unwrap(), [[1, 2]]);
        for file in [
            walls,
            "# vtk DataFile Version 2.0\n\nASCII\nDATASET POLYDATA\n",
        ] {
            let none = read_files(&[("it.vtk", file)]).unwrap_err();
            assert!(
                none.contains("contacts are lines between centres"),
                "{none}"
            );
        }
    }
}
