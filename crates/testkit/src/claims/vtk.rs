//! Contacts in files of VTK are read as they were written, whatever else the files contain. Damaged files are read or
//! rejected in one line.

use arbitrary::Unstructured;
use cannonpile::geometry::Spacing;
use cannonpile::{Packing, Pile};
use cannonpile_dem::verify;
use cannonpile_dem::verify::{Measured, Reader, Refusal};

use super::measured::{any_pile, damage, perfect};
use super::{Checked, demand, one_line};
use crate::codes;
use crate::generators::number::ratio;
use crate::generators::pile::allowed_spacing;
use crate::generators::vtk::{Cell, Data, Picture, Values, file, order};

/// The exact forces of a pile in a file of VTK are accepted to the last bit.
pub fn written(u: &mut Unstructured<'_>) -> Checked {
    let pile = any_pile(u)?;
    let packing = Packing::new(&pile, &allowed_spacing(u, &pile)?)?;
    let Some(exact) = perfect(&packing).filter(|exact| !exact.is_empty()) else {
        return Ok(());
    };
    let centres = codes::centres(&packing)?;
    let file = any_form(u, &exact, &centres)?;
    let by_place = Reader::new().by_place(Reader::WITHIN)?;
    let loaded = exact.iter().filter(|one| one.force != 0.0).count();
    // The frame may differ by a symmetry of the pile.
    for (reader, accept) in [(Reader::new(), 0.0), (by_place, 1e-9)] {
        let read = match reader.compare(&packing, &*file) {
            Err(Refusal::OutOfRange) => return Ok(()),
            read => read?.comparison,
        };
        let all = read.matched() >= u64::try_from(loaded).unwrap_or(u64::MAX);
        demand(read.accepted(accept) && all, || format!("{read}"))?;
    }
    Ok(())
}

/// A file with these contacts.
fn any_form(
    u: &mut Unstructured<'_>,
    exact: &[Measured],
    centres: &[[f64; 3]],
) -> arbitrary::Result<Vec<u8>> {
    let picture = if u.arbitrary()? {
        with_points(u, exact, centres)?
    } else {
        with_lines(u, exact, centres)?
    };
    file(u, &picture)
}

/// Contacts are lines between centres, among other cells.
fn with_lines(
    u: &mut Unstructured<'_>,
    exact: &[Measured],
    centres: &[[f64; 3]],
) -> arbitrary::Result<Picture> {
    let index = |id: u64| usize::try_from(id - 1).unwrap();
    let mut cells: Vec<_> = exact
        .iter()
        .map(|one| (Cell::Line, one.ids.map(index).to_vec()))
        .collect();
    for kind in [Cell::Vertex, Cell::Polygon, Cell::Strip] {
        for _ in 0..u.int_in_range(0..=2)? {
            let points = if kind == Cell::Vertex { 1 } else { 3 };
            let points = (0..points).map(|_| u.choose_index(centres.len()));
            cells.push((kind, points.collect::<arbitrary::Result<_>>()?));
        }
    }
    let order = order(u, cells.len())?;
    // Other cells have other numbers, among them that of a sphere that does not exist.
    let data = of_contacts(order.iter().map(|n| exact.get(*n)));
    let mut picture = Picture {
        points: centres.to_vec(),
        cells: order.iter().map(|n| cells[*n].clone()).collect(),
        point_data: Vec::new(),
        cell_data: data,
    };
    let cell_count = picture.cells.len();
    add_others(u, &mut picture.cell_data, cell_count)?;
    add_others(u, &mut picture.point_data, centres.len())?;
    Ok(picture)
}

/// Contacts are points halfway between centres, with vertices or without cells.
fn with_points(
    u: &mut Unstructured<'_>,
    exact: &[Measured],
    centres: &[[f64; 3]],
) -> arbitrary::Result<Picture> {
    let order = order(u, exact.len())?;
    let halfway = |one: &Measured| {
        let [a, b] = one.ids.map(|id| centres[usize::try_from(id - 1).unwrap()]);
        [0, 1, 2].map(|axis: usize| a[axis].midpoint(b[axis]))
    };
    let has_cells: bool = u.arbitrary()?;
    let cells = exact.iter().enumerate().filter(|_| has_cells);
    let data = of_contacts(order.iter().map(|n| exact.get(*n)));
    let mut picture = Picture {
        points: order.iter().map(|n| halfway(&exact[*n])).collect(),
        cells: cells.map(|(n, _)| (Cell::Vertex, vec![n])).collect(),
        point_data: Vec::new(),
        cell_data: Vec::new(),
    };
    add_others(u, &mut picture.point_data, exact.len())?;
    if has_cells && u.arbitrary()? {
        picture.cell_data.extend(data);
    } else {
        picture.point_data.extend(data);
    }
    Ok(picture)
}

/// The arrays that are read: the numbers of both spheres, the force and its vector.
fn of_contacts<'m>(rows: impl Iterator<Item = Option<&'m Measured>>) -> Vec<Data> {
    let (mut ids, mut force, mut vector) = ([Vec::new(), Vec::new()], Vec::new(), Vec::new());
    for row in rows {
        for (place, ids) in ids.iter_mut().enumerate() {
            ids.push(row.map_or(-1, |row| i64::try_from(row.ids[place]).unwrap()));
        }
        force.push(row.map_or(77.0, |row| row.force));
        vector.extend(row.and_then(|row| row.vector).unwrap_or([f64::NAN; 3]));
    }
    let [one, other] = ids;
    vec![
        Data::new("id1", 1, Values::Integers(one)),
        Data::new("id2", 1, Values::Integers(other)),
        Data::new("force", 1, Values::Floats(force)),
        Data::new("force_vector", 3, Values::Floats(vector)),
    ]
}

/// Adds arrays that are not needed, and that nobody could read.
fn add_others(
    u: &mut Unstructured<'_>,
    arrays: &mut Vec<Data>,
    count: usize,
) -> arbitrary::Result<()> {
    for other in [
        Data::new("flag", 1, Values::Bits(count)),
        Data::new("title", 1, Values::Texts(count)),
        Data::new("vel", 3, Values::NotNumbers(3 * count)),
        Data::new("short", 1, Values::Floats(vec![1.0])),
        Data::new("stress", 9, Values::Floats(vec![0.0; 9 * count])),
    ] {
        if u.arbitrary()? {
            let place = u.int_in_range(0..=arrays.len())?;
            arrays.insert(place, other);
        }
    }
    Ok(())
}

/// A damaged file is read, or rejected in one line. A file without contacts is rejected.
pub fn damaged(u: &mut Unstructured<'_>) -> Checked {
    let pile = Pile::triangular(2)?;
    let packing = Packing::new(&pile, &Spacing::new(ratio(6, 5))?)?;
    let exact = perfect(&packing).unwrap_or_default();
    let centres = codes::centres(&packing)?;
    let mut file = any_form(u, &exact, &centres)?;
    for _ in 0..u.int_in_range(1..=4)? {
        damage(u, &mut file)?;
    }
    read_or_refused(&packing, &file)
}

/// Any bytes after the beginning of a file of VTK are read, or rejected in one line.
pub fn any_file(u: &mut Unstructured<'_>) -> Checked {
    const BEGINNINGS: [&[u8]; 5] = [
        b"",
        b"<VTKFile type=\"PolyData\"><PolyData><Piece NumberOfPoints=\"2\" NumberOfLines=\"1\">",
        b"<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"2\" NumberOfCells=\"1\">",
        b"# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\n",
        b"# vtk DataFile Version 5.1\n\nBINARY\nDATASET UNSTRUCTURED_GRID\n",
    ];
    let pile = Pile::triangular(2)?;
    let packing = Packing::new(&pile, &Spacing::new(ratio(6, 5))?)?;
    let begin = *u.choose(&BEGINNINGS)?;
    let file = [begin, u.arbitrary::<&[u8]>()?].concat();
    read_or_refused(&packing, &file)
}

fn read_or_refused(packing: &Packing<'_>, file: &[u8]) -> Checked {
    let is_vtk = file.first() == Some(&b'<') || file.starts_with(b"# vtk DataFile");
    // Rows of another kind are passed over.
    let has_kinds = file.windows(4).any(|part| part == b"kind");
    if let Ok(reading) = verify::read(file) {
        let is_empty = reading.is_empty();
        demand(!is_vtk || has_kinds || !is_empty, || {
            "no contact was read".to_owned()
        })?;
    }
    for reader in [Reader::new(), Reader::new().by_place(Reader::WITHIN)?] {
        let Err(refusal) = reader.compare(packing, file) else {
            continue;
        };
        one_line(&refusal)?;
        let length = refusal.to_string().len();
        demand(length < 1000, || format!("a message of {length} bytes"))?;
    }
    Ok(())
}

#[cfg(test)]
mod injected_faults {
    use super::*;
    use crate::properties::census;

    #[test]
    fn files_have_every_form() {
        let forms = census(|u| {
            let pile = any_pile(u).map_err(|_| arbitrary::Error::IncorrectFormat)?;
            let packing = Packing::new(&pile, &allowed_spacing(u, &pile)?).unwrap();
            let exact = perfect(&packing).unwrap_or_default();
            let file = any_form(u, &exact, &codes::centres(&packing).unwrap())?;
            let file = String::from_utf8_lossy(&file);
            let has =
                |forms: &[&'static str]| forms.iter().copied().find(|form| file.contains(form));
            let set = has(&[
                "PolyData",
                "UnstructuredGrid",
                "POLYDATA",
                "UNSTRUCTURED_GRID",
            ]);
            let coding = has(&[
                "\"raw", "'raw", "base64", "binary", "ascii", "OFFSETS", "BINARY", "ASCII",
            ]);
            let packed = has(&["vtkZLib"]).is_some();
            Ok(format!("{} {} {packed}", set.unwrap(), coding.unwrap()))
        });
        assert!(forms.len() > 20, "{forms:?}");
    }

    /// A reader that takes the n-th value for the n-th line is caught.
    #[test]
    fn shifted_cell_data_are_caught() {
        let pile = Pile::triangular(2).unwrap();
        let packing = Packing::new(&pile, &Spacing::new(ratio(6, 5)).unwrap()).unwrap();
        let exact = perfect(&packing).unwrap();
        let centres = codes::centres(&packing).unwrap();
        let mut u = Unstructured::new(&[]);
        let mut picture = with_lines(&mut u, &exact, &centres).unwrap();
        let right = file(&mut u, &picture).unwrap();
        picture.cells.insert(0, (Cell::Vertex, vec![0]));
        let wrong = file(&mut u, &picture).unwrap();
        let accepted = |file: &[u8]| {
            let read = Reader::new().compare(&packing, file);
            read.is_ok_and(|read| read.comparison.accepted(0.0))
        };
        assert!(accepted(&right));
        assert!(!accepted(&wrong));
    }
}
