//! A piece of a VTK file: its arrays by section, and its cells that are rows.
//!
//! Cell data of poly data run over vertices, lines, polygons and strips, in this order
//! (<https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>).

use super::array::Array;
use super::coding::Coding;
use super::connections::Connections;
use crate::error::Error;

/// The sections of a piece that are read.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Section {
    Points,
    Verts,
    Lines,
    Polys,
    Strips,
    /// The cells of an unstructured grid.
    Cells,
    PointData,
    CellData,
}

/// The number of sections.
const SECTIONS: usize = Section::CellData as usize + 1;

/// The cells of poly data, in the order of their data.
const POLY_CELLS: [Section; 4] = [
    Section::Verts,
    Section::Lines,
    Section::Polys,
    Section::Strips,
];

pub(super) const CONNECTIVITY: &str = "connectivity";
pub(super) const OFFSETS: &str = "offsets";
pub(super) const TYPES: &str = "types";
/// The cells of legacy files: for each cell, the number of its points and the points.
pub(super) const INTERLEAVED: &str = "cells";

/// The arrays of a piece.
#[derive(Default)]
pub(super) struct Piece<'f> {
    pub(super) coding: Coding<'f>,
    /// By section, as are the counts.
    arrays: [Vec<Array<'f>>; SECTIONS],
    /// The numbers of points and cells that the file announces.
    counts: [Option<usize>; SECTIONS],
}

/// The kind of the rows of a piece. The last kind in a file decides: beside lines, no points are rows.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// The piece is empty.
    None,
    /// The piece has only cells with an area or a volume.
    Faces,
    /// Vertices, or the points of a piece without cells.
    Points,
    /// Lines between two points.
    Lines,
}

/// A row: a line between two points, or one point.
pub(super) struct Row {
    /// The position of the cell in the cell data.
    pub(super) cell: usize,
    pub(super) first: usize,
    /// The second point of a line. For a vertex or a point, the first point again.
    pub(super) second: usize,
}

impl<'f> Piece<'f> {
    /// Returns a piece without arrays.
    pub(super) fn new(coding: Coding<'f>) -> Self {
        Self {
            coding,
            ..Self::default()
        }
    }

    pub(super) fn push(&mut self, section: Section, array: Array<'f>) {
        self.arrays[section as usize].push(array);
    }

    pub(super) fn announce(&mut self, section: Section, count: usize) {
        self.counts[section as usize] = Some(count);
    }

    pub(super) fn arrays(&self, section: Section) -> &[Array<'f>] {
        &self.arrays[section as usize]
    }

    fn find(&self, section: Section, name: &str) -> Option<&Array<'f>> {
        let mut arrays = self.arrays(section).iter();
        arrays.find(|array| array.name == name)
    }

    /// Returns the coordinates of the points.
    pub(super) fn points(&self) -> Result<&Array<'f>, Error> {
        let points = self.arrays(Section::Points).first();
        points.ok_or_else(|| Error::Vtk("a piece has no array of points".into()))
    }

    /// Returns the number of points, or of the cells of a section.
    pub(super) fn count(&self, section: Section) -> Result<usize, Error> {
        if let Some(count) = self.counts[section as usize] {
            return Ok(count);
        }
        if section != Section::Points {
            let ends = self.find(section, OFFSETS);
            let count = ends.map(|ends| Ok(ends.decode(&self.coding)?.len()));
            // A section without offsets has no cells.
            return count.unwrap_or(Ok(0));
        }
        match self.arrays(section).first() {
            Some(points) => Ok(points.decode(&self.coding)?.len() / 3),
            None => Ok(0),
        }
    }

    fn is_grid(&self) -> bool {
        let cells = Section::Cells;
        !self.arrays(cells).is_empty() || self.counts[cells as usize].is_some()
    }

    /// Returns the number of all cells.
    pub(super) fn cell_count(&self) -> Result<usize, Error> {
        if self.is_grid() {
            return self.count(Section::Cells);
        }
        let mut sum = 0_usize;
        for section in POLY_CELLS {
            sum = sum.saturating_add(self.count(section)?);
        }
        Ok(sum)
    }

    /// Returns the number of the things with this data, and their name in errors.
    pub(super) fn things(&self, data: Section) -> Result<(usize, String), Error> {
        if data != Section::CellData {
            return Ok((self.count(Section::Points)?, "points".into()));
        }
        let count = self.cell_count()?;
        let mut parts = Vec::new();
        for section in POLY_CELLS {
            match self.count(section)? {
                0 => {}
                count => parts.push(format!("{}: {count}", section.things())),
            }
        }
        Ok((
            count,
            match parts.len() {
                0 | 1 => "cells".to_owned(),
                _ => format!("cells ({})", parts.join(", ")),
            },
        ))
    }

    /// Returns the types of the cells of a grid.
    fn types(&self) -> Result<Vec<i64>, Error> {
        let count = self.count(Section::Cells)?;
        if count == 0 {
            return Ok(Vec::new());
        }
        let types = self
            .find(Section::Cells, TYPES)
            .ok_or_else(|| lacks(TYPES, Section::Cells))?;
        let mut types = types.integers(&self.coding)?;
        if types.len() < count {
            let found = types.len();
            return Err(Error::Vtk(format!(
                "array types: {found} values for {count} cells"
            )));
        }
        // Some programs write a type for each point.
        types.truncate(count);
        Ok(types)
    }

    /// Returns what the rows of this piece would be.
    pub(super) fn kind(&self) -> Result<Kind, Error> {
        let (lines, vertices, cells) = if self.is_grid() {
            let types = self.types()?;
            (
                types.iter().any(|kind| is_line(*kind)),
                types.iter().any(|kind| is_vertex(*kind)),
                !types.is_empty(),
            )
        } else {
            (
                self.count(Section::Lines)? > 0,
                self.count(Section::Verts)? > 0,
                self.cell_count()? > 0,
            )
        };
        Ok(if lines {
            Kind::Lines
        } else if vertices {
            Kind::Points
        } else if cells {
            Kind::Faces
        } else if self.count(Section::Points)? > 0 {
            Kind::Points
        } else {
            Kind::None
        })
    }

    /// Returns the rows of a piece of this kind. Earlier pieces have `before` rows.
    pub(super) fn rows(&self, kind: Kind, before: u64) -> Result<Vec<Row>, Error> {
        let is_of_points = kind == Kind::Points;
        let row = |cell, first, second| Row {
            cell,
            first,
            second,
        };
        if is_of_points && self.cell_count()? == 0 {
            let points = 0..self.count(Section::Points)?;
            return Ok(points.map(|point| row(point, point, point)).collect());
        }
        let (section, types) = if self.is_grid() {
            (Section::Cells, Some(self.types()?))
        } else if is_of_points {
            (Section::Verts, None)
        } else {
            (Section::Lines, None)
        };
        // Vertices are the first cells, and lines the next.
        let earlier = match section {
            Section::Lines => self.count(Section::Verts)?,
            _ => 0,
        };
        let cells = self.connections(section)?;
        let mut rows = Vec::new();
        for n in 0..cells.len() {
            let kind = types.as_ref().map(|types| types.get(n).copied());
            let is_row = if is_of_points { is_vertex } else { is_line };
            if !kind.is_none_or(|kind| kind.is_some_and(is_row)) {
                continue;
            }
            let number = before.saturating_add(rows.len() as u64).saturating_add(1);
            let outside = || outside(number);
            let points = cells.cell(n).ok_or_else(outside)?;
            let cell = earlier.saturating_add(n);
            let index = |point: &i64| usize::try_from(*point).map_err(|_| outside());
            if is_of_points {
                for point in points {
                    let point = index(point)?;
                    rows.push(row(cell, point, point));
                }
            } else if let [first, second] = points {
                rows.push(row(cell, index(first)?, index(second)?));
            } else {
                return Err(Error::Vtk(format!(
                    "line {number}: it has {} points, not two; is this a table of contacts?",
                    points.len()
                )));
            }
        }
        Ok(rows)
    }

    /// Returns the points of the cells of a section.
    fn connections(&self, section: Section) -> Result<Connections, Error> {
        let coding = &self.coding;
        let cells = if let Some(array) = self.find(section, INTERLEAVED) {
            Connections::interleaved(&array.integers(coding)?)
        } else {
            let found = |name| {
                let array = self.find(section, name);
                array.ok_or_else(|| lacks(name, section))
            };
            let points = found(CONNECTIVITY)?.integers(coding)?;
            Connections::new(points, &found(OFFSETS)?.integers(coding)?)
        };
        let (found, count) = (cells.len(), self.count(section)?);
        if found == count {
            return Ok(cells);
        }
        Err(Error::Vtk(format!(
            "a piece has {count} {things}, but its array offsets is that of {found} {things}",
            things = section.things()
        )))
    }
}

impl Section {
    /// Returns the name of the things that have an entry each.
    const fn things(self) -> &'static str {
        match self {
            Self::Points | Self::PointData => "points",
            Self::Verts => "vertices",
            Self::Lines => "lines",
            Self::Polys => "polygons",
            Self::Strips => "triangle strips",
            Self::Cells | Self::CellData => "cells",
        }
    }
}

/// Returns the error of a row with a point that does not exist.
pub(super) fn outside(row: u64) -> Error {
    Error::Vtk(format!(
        "line {row}: it has a point that is not in the file"
    ))
}

fn lacks(array: &str, section: Section) -> Error {
    Error::Vtk(format!(
        "a piece has no array {array} for its {}",
        section.things()
    ))
}

/// Returns whether a cell of this type is a line, or a chain of lines.
const fn is_line(kind: i64) -> bool {
    matches!(kind, 3 | 4)
}

/// Returns whether a cell of this type is a vertex, or several.
const fn is_vertex(kind: i64) -> bool {
    matches!(kind, 1 | 2)
}
