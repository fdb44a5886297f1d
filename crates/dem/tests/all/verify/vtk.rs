//! Lines with data are read as VTK writes them. The files come from vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter and
//! the writers of legacy files (9.5). Each has the twelve contacts of three layers at a = 6/5 R. The export of this crate
//! is read too.

use cannonpile::Pile;
use cannonpile_dem::verify::{Compared, Preset, Reader, Refusal};
use cannonpile_dem::{PileExport, PileFile};

use super::{packing, ratio};

/// Files of the kinds in which readers found faults, each with the expected result.
mod cases;

fn read(reader: &Reader, file: &[u8]) -> Result<Compared, Refusal> {
    let pile = Pile::triangular(3).unwrap();
    reader.compare(&packing(&pile, ratio(6, 5)), file)
}

const LINES: [(&str, &[u8]); 6] = [
    ("text", include_bytes!("vtk/ascii.vtp")),
    ("base64", include_bytes!("vtk/based.vtp")),
    ("base64, compressed", include_bytes!("vtk/packed.vtp")),
    ("appended", include_bytes!("vtk/raw.vtp")),
    (
        "appended, compressed, big-endian",
        include_bytes!("vtk/raw_packed.vtp"),
    ),
    (
        "appended in base64, compressed",
        include_bytes!("vtk/appended.vtp"),
    ),
];

const GRIDS: [&[u8]; 2] = [
    include_bytes!("vtk/lines.vtu"),
    include_bytes!("vtk/lines_ascii.vtu"),
];

/// Lines among vertices, polygons, strips and triangles, with texts, bits and numbers that are not needed. The versions of
/// legacy files are 4.2 and 5.1.
const MIXED: [(&str, &[u8]); 10] = [
    ("text, 4.2", include_bytes!("vtk/legacy_lines_ascii_42.vtk")),
    ("text, 5.1", include_bytes!("vtk/legacy_lines_ascii_51.vtk")),
    ("4.2", include_bytes!("vtk/legacy_lines_binary_42.vtk")),
    ("5.1", include_bytes!("vtk/legacy_lines_binary_51.vtk")),
    (
        "grid in text, 4.2",
        include_bytes!("vtk/legacy_grid_ascii_42.vtk"),
    ),
    (
        "grid in text, 5.1",
        include_bytes!("vtk/legacy_grid_ascii_51.vtk"),
    ),
    ("grid, 4.2", include_bytes!("vtk/legacy_grid_binary_42.vtk")),
    ("grid, 5.1", include_bytes!("vtk/legacy_grid_binary_51.vtk")),
    ("vtp", include_bytes!("vtk/mixed.vtp")),
    ("vtu", include_bytes!("vtk/mixed.vtu")),
];

#[test]
fn exponents_of_fortran_are_read() {
    let text = std::str::from_utf8(GRIDS[1]).unwrap();
    for letter in ["D", "d"] {
        let written = text.replace(
            " 0.46225016352102427",
            &format!(" 4.6225016352102427{letter}-01"),
        );
        assert_ne!(written, text);
        let reader = Reader::of(Preset::Lethe);
        let comparison = read(&reader, written.as_bytes()).unwrap().comparison;
        assert!(comparison.accepted(1e-10), "{letter}: {comparison}");
    }
}

#[test]
fn lines_among_other_cells_are_read() {
    for (form, file) in MIXED {
        // The text of VTK has eleven digits.
        let accept = if form.contains("text") { 1e-10 } else { 1e-15 };
        for reader in [Reader::new(), Reader::of(Preset::Lethe)] {
            let comparison = read(&reader, file).unwrap().comparison;
            assert_eq!(comparison.matched(), 12, "{form}");
            assert!(comparison.accepted(accept), "{form}: {comparison}");
        }
    }
}

#[test]
fn every_encoding_is_read() {
    for (coding, file) in LINES {
        // Matched by numbers, by positions, and with the vectors of points, which are the forces on the second sphere.
        let by_vectors = Reader::of(Preset::ExaDemVtp);
        for reader in [Reader::new(), Reader::of(Preset::Lethe), by_vectors] {
            let read = read(&reader, file).unwrap();
            let comparison = read.comparison;
            assert_eq!(comparison.matched(), 12, "{coding}");
            // The text of ParaView has eleven digits.
            let accept = if coding == "text" { 1e-10 } else { 1e-15 };
            assert!(comparison.accepted(accept), "{coding}: {comparison}");
        }
    }
    for file in GRIDS {
        let read = read(&Reader::of(Preset::Lethe), file).unwrap();
        assert!(read.comparison.accepted(1e-10), "{}", read.comparison);
    }
}

#[test]
fn the_export_of_this_crate_is_read_with_its_vectors() {
    let pile = Pile::triangular(9).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let mut file = Vec::new();
    let export = PileExport::new(&packing).unwrap();
    export
        .write_file(PileFile::ContactsVtp, &mut file, &mut |_| {})
        .unwrap();
    for reader in [Reader::new(), Reader::of(Preset::Lethe)] {
        let read = reader.compare(&packing, &*file).unwrap();
        assert!(read.comparison.accepted(0.0), "{}", read.comparison);
        assert!(read.comparison.worst().unwrap().exact_vector.is_some());
    }
}

#[test]
fn every_error_is_one_line() {
    let reader = Reader::of(Preset::Lethe);
    for (_, file) in LINES.into_iter().chain(MIXED) {
        let mut cut_short = 0;
        for end in (1..file.len()).step_by(13) {
            let Err(refusal) = read(&reader, &file[..end]) else {
                continue;
            };
            let line = refusal.to_string();
            assert!(line.len() < 500 && !line.contains('\n'), "{line}");
            cut_short += 1;
        }
        assert!(cut_short > file.len() / 52);
        for place in (0..file.len()).step_by(31) {
            let mut hurt = file.to_vec();
            hurt[place] = hurt[place].wrapping_add(13);
            if let Err(refusal) = read(&reader, &hurt) {
                assert!(refusal.to_string().len() < 500, "{refusal}");
            }
        }
    }
    let text = String::from_utf8(LINES[0].1.to_vec()).unwrap();
    for (from, to, said) in [
        (
            "\"connectivity\"",
            "\"else\"",
            "a piece has no array connectivity for its lines",
        ),
        (
            "NumberOfLines=\"12\"",
            "NumberOfLines=\"11\"",
            "array force: 12 values for 11 cells of 1 component",
        ),
        (
            "\"Float64\" Name=\"force\"",
            "\"Float80\" Name=\"force\"",
            "'Float80' is not one of the types",
        ),
        (
            "Name=\"force\"",
            "Name=\"power\"",
            "line 1: no column force, only",
        ),
    ] {
        assert!(text.contains(from), "{from}");
        let line = read(&reader, text.replace(from, to).as_bytes())
            .unwrap_err()
            .to_string();
        assert!(line.contains(said), "{line}");
    }
}
