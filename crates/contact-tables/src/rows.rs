//! Rows in as few bytes as possible.

use core::mem::discriminant;
use std::io;

use crate::contact::{Contact, Force, Place, Spheres};

/// Rows of a table, in their order. The rows of one form on consecutive lines take only the memory of their numbers: eight
/// bytes each.
#[derive(Default)]
pub struct Rows {
    ids: Vec<[i64; 2]>,
    numbers: Vec<f64>,
    runs: Vec<Run>,
    count: usize,
}

/// Rows of one form on consecutive lines: the first one, and their number.
#[derive(Clone, Copy)]
struct Run {
    first: Contact,
    count: u64,
}

/// The largest number of floats of a row: two centres, a force, and two vectors.
const MOST_NUMBERS: usize = 13;

impl Rows {
    /// Returns the number of rows.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.count
    }

    /// Returns whether there are no rows.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Appends a row.
    ///
    /// # Errors
    /// The memory does not suffice.
    pub fn push(&mut self, row: &Contact) -> io::Result<()> {
        self.ids.try_reserve(1)?;
        self.numbers.try_reserve(MOST_NUMBERS)?;
        match self.runs.last_mut() {
            Some(run) if run.is_continued_by(row) => run.count += 1,
            _ => {
                self.runs.try_reserve(1)?;
                self.runs.push(Run {
                    first: *row,
                    count: 1,
                });
            }
        }
        let mut row = *row;
        if let Spheres::Numbers(ids) = row.spheres {
            self.ids.push(ids);
        }
        each_number(&mut row, |number| self.numbers.push(*number));
        self.count += 1;
        Ok(())
    }

    /// Removes all rows.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Returns the rows.
    pub fn iter(&self) -> impl Iterator<Item = Contact> {
        let (runs, ids) = (self.runs.iter().copied(), self.ids.iter().copied());
        unpacked(runs, ids, self.numbers.iter().copied())
    }
}

impl IntoIterator for Rows {
    type Item = Contact;
    type IntoIter = Box<dyn Iterator<Item = Contact>>;

    fn into_iter(self) -> Self::IntoIter {
        let (runs, ids) = (self.runs.into_iter(), self.ids.into_iter());
        Box::new(unpacked(runs, ids, self.numbers.into_iter()))
    }
}

fn unpacked(
    runs: impl Iterator<Item = Run>,
    mut ids: impl Iterator<Item = [i64; 2]>,
    mut numbers: impl Iterator<Item = f64>,
) -> impl Iterator<Item = Contact> {
    let rows = runs.flat_map(|Run { first, count }| {
        (0..count).map(move |n| Contact {
            line: first.line + n,
            ..first
        })
    });
    rows.map(move |mut row| {
        if let Spheres::Numbers(own) = &mut row.spheres
            && let Some(stored) = ids.next()
        {
            *own = stored;
        }
        each_number(&mut row, |number| {
            if let Some(stored) = numbers.next() {
                *number = stored;
            }
        });
        row
    })
}

impl Run {
    fn is_continued_by(&self, row: &Contact) -> bool {
        let form = |row: &Contact| {
            let place = match &row.spheres {
                Spheres::Numbers(_) => None,
                Spheres::Places(place) => Some(discriminant(place)),
            };
            (place, discriminant(&row.force), row.tangential.is_some())
        };
        self.first.line + self.count == row.line && form(&self.first) == form(row)
    }
}

/// Calls a function with all floats of a row.
fn each_number(row: &mut Contact, mut call: impl FnMut(&mut f64)) {
    match &mut row.spheres {
        Spheres::Numbers(_) => {}
        Spheres::Places(Place::Centres(centres)) => {
            centres.as_flattened_mut().iter_mut().for_each(&mut call);
        }
        Spheres::Places(Place::Point(point)) => point.iter_mut().for_each(&mut call),
    }
    match &mut row.force {
        Force::Along(force) => call(force),
        Force::Vector(vector) => vector.iter_mut().for_each(&mut call),
        Force::Both(force, vector) => {
            call(force);
            vector.iter_mut().for_each(&mut call);
        }
    }
    row.tangential.iter_mut().flatten().for_each(call);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_every_form_come_back_in_their_order() {
        let spheres = [
            Spheres::Numbers([7, -8]),
            Spheres::Places(Place::Point([1.0, 2.0, 3.0])),
            Spheres::Places(Place::Centres([[4.0, 5.0, 6.0], [7.0, 8.0, 9.0]])),
        ];
        let forces = [
            Force::Along(0.5),
            Force::Vector([0.1, 0.2, 0.3]),
            Force::Both(1.5, [1.1, 1.2, 1.3]),
        ];
        let mut all = Vec::new();
        for (n, line) in [2_u32, 3, 4, 7, 8, 20, 21, 22].into_iter().enumerate() {
            let form = n / 2;
            let spheres = match spheres[form % 3] {
                Spheres::Numbers([one, other]) => Spheres::Numbers([one + i64::from(line), other]),
                Spheres::Places(place) => {
                    Spheres::Places(place.map(|point| point.map(|x| x + f64::from(line))))
                }
            };
            all.push(Contact {
                spheres,
                force: forces[form % 3],
                tangential: (form == 3).then_some([0.4, 0.5, 0.6]),
                line: u64::from(line),
            });
        }
        let mut rows = Rows::default();
        for row in &all {
            rows.push(row).unwrap();
        }
        assert_eq!(rows.len(), all.len());
        assert_eq!(rows.iter().collect::<Vec<_>>(), all);
        // Consecutive lines of one form are one run.
        assert_eq!(rows.runs.len(), 6);
        assert_eq!(rows.into_iter().collect::<Vec<_>>(), all);
    }
}
