//! Rows with positions, in as few bytes as possible.

use core::mem::discriminant;

use super::entry::{Force, Place};

/// A row of a table with positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Row {
    pub(super) place: Place,
    pub(super) force: Force,
    pub(super) tangential: Option<[f64; 3]>,
    pub(super) line: u64,
}

/// Rows of a table. The rows of one form on consecutive lines take only the memory of their numbers.
#[derive(Default)]
pub(super) struct Rows {
    numbers: Vec<f64>,
    runs: Vec<Run>,
    count: usize,
}

/// Rows of one form on consecutive lines: the first one, and their number.
struct Run {
    first: Row,
    count: usize,
}

impl Rows {
    pub(super) fn len(&self) -> usize {
        self.count
    }

    pub(super) fn push(&mut self, row: &Row) {
        match self.runs.last_mut() {
            Some(run) if run.is_continued_by(row) => run.count += 1,
            _ => self.runs.push(Run {
                first: *row,
                count: 1,
            }),
        }
        let mut row = *row;
        row.each(|number| self.numbers.push(*number));
        self.count += 1;
    }

    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Returns the rows in their order.
    pub(super) fn iter(&self) -> impl Iterator<Item = Row> {
        let mut numbers = self.numbers.iter();
        let rows = self.runs.iter().flat_map(|run| {
            (0..run.count as u64).map(|n| Row {
                line: run.first.line + n,
                ..run.first
            })
        });
        rows.map(move |mut row| {
            row.each(|number| {
                if let Some(stored) = numbers.next() {
                    *number = *stored;
                }
            });
            row
        })
    }
}

impl Run {
    fn is_continued_by(&self, row: &Row) -> bool {
        let form = |row: &Row| {
            let tangential = row.tangential.is_some();
            (
                discriminant(&row.place),
                discriminant(&row.force),
                tangential,
            )
        };
        self.first.line + self.count as u64 == row.line && form(&self.first) == form(row)
    }
}

impl Row {
    /// Calls a function with all numbers of the row.
    fn each(&mut self, mut call: impl FnMut(&mut f64)) {
        match &mut self.place {
            Place::Centres(centres) => centres.as_flattened_mut().iter_mut().for_each(&mut call),
            Place::Point(point) => point.iter_mut().for_each(&mut call),
        }
        match &mut self.force {
            Force::Along(force) => call(force),
            Force::Vector(vector) => vector.iter_mut().for_each(&mut call),
            Force::Both(force, vector) => {
                call(force);
                vector.iter_mut().for_each(&mut call);
            }
        }
        self.tangential.iter_mut().flatten().for_each(call);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_every_form_come_back_in_their_order() {
        let places = [
            Place::Point([1.0, 2.0, 3.0]),
            Place::Centres([[4.0, 5.0, 6.0], [7.0, 8.0, 9.0]]),
        ];
        let forces = [
            Force::Along(0.5),
            Force::Vector([0.1, 0.2, 0.3]),
            Force::Both(1.5, [1.1, 1.2, 1.3]),
        ];
        let mut all = Vec::new();
        for (n, line) in [2_u32, 3, 4, 7, 8, 20, 21, 22].into_iter().enumerate() {
            let form = n / 2;
            let place = places[form % 2].map(|point| point.map(|x| x + f64::from(line)));
            all.push(Row {
                place,
                force: forces[form % 3],
                tangential: (form == 3).then_some([0.4, 0.5, 0.6]),
                line: u64::from(line),
            });
        }
        let mut rows = Rows::default();
        for row in &all {
            rows.push(row);
        }
        assert_eq!(rows.len(), all.len());
        assert_eq!(rows.iter().collect::<Vec<_>>(), all);
        // Consecutive lines of one form are one run.
        assert_eq!(rows.runs.len(), 6);
        rows.clear();
        assert_eq!(rows.iter().count(), 0);
    }
}
