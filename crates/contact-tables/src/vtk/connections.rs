//! The points of the cells of a section.

/// The points of cells, one cell after the other.
pub(super) struct Connections {
    points: Vec<i64>,
    /// The end of each cell in the points.
    ends: Vec<usize>,
}

impl Connections {
    /// Joins the points of all cells with the end of each cell.
    pub(super) fn new(points: Vec<i64>, ends: &[i64]) -> Self {
        // An end that is no index is beyond the end of the points.
        let ends = ends
            .iter()
            .map(|end| usize::try_from(*end).unwrap_or(usize::MAX));
        let ends = ends.collect();
        Self { points, ends }
    }

    /// Reads the number of points of each cell before its points. A last cell that is cut off has too few points.
    pub(super) fn interleaved(mut numbers: &[i64]) -> Self {
        let (mut points, mut ends) = (Vec::new(), Vec::new());
        while let Some((count, rest)) = numbers.split_first() {
            // A count that is no index is beyond the end of the points.
            let count = usize::try_from(*count).unwrap_or(usize::MAX);
            let (cell, rest) = rest.split_at(count.min(rest.len()));
            points.extend_from_slice(cell);
            ends.push(points.len().saturating_add(count - cell.len()));
            numbers = rest;
        }
        Self { points, ends }
    }

    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    /// Returns the points of the n-th cell. Returns `None` if the points do not contain its end.
    pub(super) fn cell(&self, n: usize) -> Option<&[i64]> {
        let begin = match n.checked_sub(1) {
            Some(before) => *self.ends.get(before)?,
            None => 0,
        };
        self.points.get(begin..*self.ends.get(n)?)
    }
}
