//! The table that a piece forms, and its rows.
//!
//! The columns are the coordinates of the points of a row, and the data of its cell and of its first point. An array with
//! one component is a column with the name of the array. An array with three components is three columns with `_x`, `_y`
//! and `_z` after the name, and one with another number has `_0`, `_1` and so on. Only arrays of columns that are read are decoded.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

use super::array::Array;
use super::piece::{Kind, Piece, Row, Section, outside};
use super::values::Values;
use crate::contact::{Contact, keep};
use crate::error::{Error, Fault};
use crate::format::Format;
use crate::header::Header;
use crate::steps::Steps;

/// The largest number of components that are columns.
const MOST_COMPONENTS: usize = 16;

/// The flags of cells and points. The first bit marks a ghost: a copy of one in another piece.
const GHOSTS: &str = "vtkGhostType";

const AXES: [&str; 3] = ["x", "y", "z"];

/// A column of a table.
struct Column {
    name: String,
    /// The array of the column, by its section and its position there.
    section: Section,
    array: usize,
    component: usize,
    /// Whether the numbers are those of the second point of a row.
    is_of_second: bool,
}

/// Reads the rows of a piece. `line` is the number of rows before and after.
pub(super) fn read(
    piece: &Piece<'_>,
    kind: Kind,
    format: &Format,
    line: &mut u64,
    steps: &mut Steps,
    rows: &mut Vec<Contact>,
) -> Result<(), Error> {
    let columns = columns(piece, kind)?;
    let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    let header = Header::find(Some(&names), names.len(), format);
    let header = header.map_err(|fault| fault.at(1))?;
    let mut decoded = BTreeMap::new();
    // A line may begin at a ghost without being one.
    let ghosts = columns.iter().find(|column| {
        let is_of_rows = kind == Kind::Points || column.section == Section::CellData;
        is_of_rows && column.name == GHOSTS
    });
    let ghosts = ghosts.map(|column| {
        let (flags, _) = values(piece, column)?;
        Ok::<_, Error>((column, array(piece, column)?.whole(flags)?))
    });
    let ghosts = ghosts.transpose()?;
    for column in header.columns().filter_map(|column| columns.get(column)) {
        if let Entry::Vacant(place) = decoded.entry((column.section, column.array)) {
            place.insert(values(piece, column)?);
        }
    }
    let decoded = |column: &Column| decoded.get(&(column.section, column.array));
    let arrays: Vec<_> = columns.iter().map(decoded).collect();
    let (mut text, mut ends) = (String::new(), Vec::new());
    for row in piece.rows(kind, *line)? {
        *line += 1;
        let flags = ghosts.as_ref();
        let flags = flags.and_then(|(column, flags)| flags.get(column.place(&row, 1)?));
        if flags.is_some_and(|flags| flags & 1 == 1) {
            steps.rows.leave_ghost();
            continue;
        }
        text.clear();
        ends.clear();
        for (column, array) in columns.iter().zip(&arrays) {
            if let Some((values, components)) = array {
                let place = column.place(&row, *components);
                let written = place.and_then(|place| values.write(place, &mut text));
                written.ok_or_else(|| outside(*line))?;
            }
            ends.push(text.len());
        }
        let mut begin = 0;
        let fields = ends.iter().map(|end| {
            let field = text.get(begin..*end);
            begin = *end;
            field.ok_or_else(|| Fault::bug("each field ends in the text of its row"))
        });
        let row = fields.collect::<Result<Vec<&str>, _>>();
        let row = row.and_then(|fields| header.read(&fields, *line));
        let row = row.map_err(|fault| fault.at(*line))?;
        if let Some(contact) = steps.count(&row, *line)? {
            keep(rows, contact)?;
        }
    }
    Ok(())
}

impl Column {
    /// Returns the position of the number of a row in the array of this column.
    fn place(&self, row: &Row, components: usize) -> Option<usize> {
        let thing = match self.section {
            Section::CellData => row.cell,
            _ if self.is_of_second => row.second,
            _ => row.first,
        };
        thing.checked_mul(components)?.checked_add(self.component)
    }
}

/// Returns the columns of a piece. Cell data come before point data of the same name, and coordinates before both.
fn columns(piece: &Piece<'_>, kind: Kind) -> Result<Vec<Column>, Error> {
    let (mut columns, mut names) = (Vec::new(), BTreeSet::new());
    let mut push = |name: String, section, array, component, is_of_second| {
        if names.insert(name.clone()) {
            columns.push(Column {
                name,
                section,
                array,
                component,
                is_of_second,
            });
        }
    };
    let ends: &[_] = match kind {
        Kind::Points => &[("", false)],
        _ => &[("1", false), ("2", true)],
    };
    for (end, is_second) in ends {
        for (component, axis) in AXES.iter().enumerate() {
            let name = format!("{axis}{end}");
            push(name, Section::Points, 0, component, *is_second);
        }
    }
    let of_cells = (piece.cell_count()? > 0).then_some(Section::CellData);
    for section in of_cells.into_iter().chain([Section::PointData]) {
        for (place, array) in piece.arrays(section).iter().enumerate() {
            for component in 0..array.components.min(MOST_COMPONENTS) {
                let name = &array.name;
                let name = match (array.components, AXES.get(component)) {
                    (1, _) => name.clone(),
                    (3, Some(axis)) => format!("{name}_{axis}"),
                    _ => format!("{name}_{component}"),
                };
                push(name, section, place, component, false);
            }
        }
    }
    Ok(columns)
}

/// Returns the array of a column.
fn array<'p>(piece: &'p Piece<'_>, column: &Column) -> Result<&'p Array<'p>, Error> {
    let array = match column.section {
        Section::Points => Some(piece.points()?),
        section => piece.arrays(section).get(column.array),
    };
    array.ok_or_else(|| Fault::bug("a column has an array").at(1))
}

/// Returns the numbers of the array of a column, and their number for each point or cell.
fn values(piece: &Piece<'_>, column: &Column) -> Result<(Values, usize), Error> {
    let array = array(piece, column)?;
    let (count, things) = piece.things(column.section)?;
    let values = array.decode_for(&piece.coding, count, &things)?;
    Ok((values, array.components))
}
