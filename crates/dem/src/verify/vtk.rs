//! Contacts in the files of VTK: XML (`.vtp`, `.vtu`), legacy (`.vtk`), and collections of such files (`.pvtp`, `.pvtu`,
//! `.vtm`, `.pvd`).
//!
//! Each line between two points is a row of a table. In a file without lines, each vertex is a row, or each point if there
//! are no cells either.

mod array;
mod coding;
mod collection;
mod connections;
mod legacy;
mod piece;
mod table;
mod values;
mod words;
mod xml;

pub(super) use collection::Open;

use super::entry::Sink;
use super::format::{Counted, Format};
use super::refusal::Refusal;
use collection::gather;
use piece::Rows;

/// Returns the refusal of a file for this reason.
fn refused(reason: impl Into<String>) -> Refusal {
    Refusal::Vtk(reason.into())
}

/// Reads the contacts of a file as rows, and those of the files that it names. Of several time steps, it reads the given one,
/// or the last. Returns the number of steps and the step that was read. Rows are numbered from 1.
pub(super) fn read(
    bytes: &[u8],
    format: &Format,
    step: Option<&str>,
    open: Option<Open<'_>>,
    sink: &mut Counted<'_, impl Sink>,
) -> Result<(u64, Option<String>), Refusal> {
    let (files, steps, step) = gather(bytes, step, open)?;
    // Beside lines, vertices and points are not rows: they are the spheres.
    let mut rows = Rows::None;
    let mut pieces = Vec::new();
    for file in &files {
        for piece in file.pieces()? {
            let kind = file.named(piece.kind())?;
            rows = rows.max(kind);
            pieces.push((file, kind, piece));
        }
    }
    let mut line = 0;
    for (file, _, piece) in pieces.iter().filter(|(_, kind, _)| *kind == rows) {
        if rows >= Rows::Points {
            file.named(table::read(piece, rows, format, &mut line, sink))?;
        }
    }
    if line > 0 {
        return Ok((steps, step));
    }
    let found = match rows {
        Rows::None => "no points",
        _ => "no lines and no vertices",
    };
    Err(refused(format!(
        "the file has {found}: contacts are lines between centres, or points with data"
    )))
}

#[cfg(test)]
mod tests {
    use super::super::reading::Reading;
    use super::*;

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

    /// Reads the first of some files, which may name the others.
    fn read_files(
        files: &[(&str, &str)],
        step: Option<&str>,
    ) -> Result<(Reading, u64, Option<String>), String> {
        let open = |name: &str| {
            let mut files = files.iter().skip(1);
            match files.find(|(known, _)| *known == name) {
                Some((_, content)) => Ok(content.as_bytes().to_vec()),
                None => Err(std::io::Error::from(std::io::ErrorKind::NotFound).into()),
            }
        };
        let mut reading = Reading::default();
        let first = files[0].1.as_bytes();
        let mut sink = Counted::new(&mut reading);
        let (steps, step) = read(first, &Format::default(), step, Some(&open), &mut sink)
            .map_err(|refusal| refusal.to_string())?;
        Ok((reading, steps, step))
    }

    fn ids(reading: &Reading) -> Vec<[u64; 2]> {
        reading.entries().iter().map(|entry| entry.ids).collect()
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
        let (reading, steps, step) = read_files(&files, None).unwrap();
        assert_eq!(ids(&reading), [[1, 2], [1, 3]]);
        assert_eq!((steps, step), (0, None));
    }

    #[test]
    fn a_piece_that_cannot_be_read_is_named() {
        let whole = pieces("PUnstructuredGrid", &["a.vtu"]);
        let refused = |files: &[(&str, &str)]| read_files(files, None).unwrap_err();
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
        for name in [
            "../a.vtu",
            "/data/a.vtu",
            "C:\\data\\a.vtu",
            "file:///a.vtu",
            "a/../../b.vtu",
        ] {
            let outside = refused(&[("it.pvtu", &pieces("PPolyData", &[name]))]);
            assert!(
                outside.contains("is not in the folder of the collection"),
                "{outside}"
            );
        }
        let own = pieces("PPolyData", &["own.pvtp"]);
        let endless = refused(&[("own.pvtp", &own), ("own.pvtp", &own)]);
        assert!(endless.contains("more than 4 deep"), "{endless}");
    }

    #[test]
    fn without_access_to_other_files_they_are_named() {
        let whole = pieces("PUnstructuredGrid", &["chains.0.vtu", "chains.1.vtu"]);
        let mut reading = Reading::default();
        let read = read(
            whole.as_bytes(),
            &Format::default(),
            None,
            None,
            &mut Counted::new(&mut reading),
        );
        assert_eq!(
            read.unwrap_err().to_string(),
            "the contacts are in other files: give 'chains.0.vtu', 'chains.1.vtu' instead"
        );
    }

    #[test]
    fn a_step_of_a_collection_is_read_with_all_its_parts() {
        let entry = |step: &str, name: &str| {
            format!("<DataSet timestep=\"{step}\" part=\"0\" file=\"run/{name}\"/>")
        };
        // Steps are ordered by number, not by text or by their place in the file.
        let all = [
            ("10", "c.vtp"),
            ("9", "a.pvtp"),
            ("9", "b.vtp"),
            ("0", "missing.vtp"),
        ];
        let all: String = all.iter().map(|(step, name)| entry(step, name)).collect();
        let whole =
            format!("<VTKFile type=\"Collection\"><Collection>{all}</Collection></VTKFile>");
        // Pieces are beside the file that names them.
        let nested = pieces("PPolyData", &["parts/a0.vtp"]);
        let [a, b, c] = [[1, 2], [1, 3], [1, 4]].map(|ids| line(ids, "0.5"));
        let files = [
            ("it.pvd", &*whole),
            ("run/a.pvtp", &nested),
            ("run/parts/a0.vtp", &a),
            ("run/b.vtp", &b),
            ("run/c.vtp", &c),
        ];
        let (last, steps, step) = read_files(&files, None).unwrap();
        assert_eq!(
            (ids(&last), steps, step.as_deref()),
            (vec![[1, 4]], 3, Some("10"))
        );
        for step in ["9", "9.0"] {
            let (chosen, _, step) = read_files(&files, Some(step)).unwrap();
            assert_eq!(
                (ids(&chosen), step.as_deref()),
                (vec![[1, 2], [1, 3]], Some("9"))
            );
        }
        let none = read_files(&files, Some("8")).unwrap_err();
        assert_eq!(none, "no step '8': the steps are '0', '9', '10'");
        let single = read_files(&[("a.vtp", &a)], Some("8")).unwrap_err();
        assert!(single.contains("the file has no steps"), "{single}");
    }

    #[test]
    fn spheres_in_other_blocks_are_not_contacts() {
        let spheres = "# vtk DataFile Version 2.0\nspheres\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n0 0 0\n\
                       VERTICES 1 2\n1 0\n";
        let walls = "# vtk DataFile Version 2.0\nwalls\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n\
                     POLYGONS 1 4\n3 0 1 2\n";
        let blocks = ["spheres.vtk", "contacts.vtp", "walls.vtk"];
        let blocks = blocks
            .map(|name| format!("<Block><DataSet file='{name}'/></Block>"))
            .concat();
        let kind = "vtkMultiBlockDataSet";
        let whole = format!("<VTKFile type='{kind}'><{kind}>{blocks}</{kind}></VTKFile>");
        let contacts = line([1, 2], "0.5");
        let files = [
            ("it.vtm", &*whole),
            ("spheres.vtk", spheres),
            ("contacts.vtp", &contacts),
            ("walls.vtk", walls),
        ];
        assert_eq!(ids(&read_files(&files, None).unwrap().0), [[1, 2]]);
        for file in [
            walls,
            "# vtk DataFile Version 2.0\n\nASCII\nDATASET POLYDATA\n",
        ] {
            let none = read_files(&[("it.vtk", file)], None).unwrap_err();
            assert!(
                none.contains("contacts are lines between centres"),
                "{none}"
            );
        }
    }
}
