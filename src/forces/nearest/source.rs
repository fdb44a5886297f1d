//! The sources of correctly rounded forces along the rows of a layer.

use alloc::boxed::Box;
use alloc::vec::Vec;
use core::sync::atomic::{AtomicBool, Ordering};

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::ToPrimitive;

use crate::Error;
use crate::each::Each;
use crate::engine::{Readout, Table, Unit, check_interrupt, fill_rows, split_front};
use crate::error::bug;
use crate::forces::layers::{Layer, Layers, check_lengths};
use crate::formula::tripled_half_turn;
use crate::geometry::Vector;
use crate::lattice::{Row, Site};
use crate::scalar::{CorrectlyRounded, Surd};

/// The units of the forces in layers. An exact multiple of a unit is rounded once.
#[derive(Clone, Debug)]
pub(crate) struct Units {
    pub(crate) contact: Surd,
    /// The units of a contact force as a vector on the upper sphere: along x, y and z.
    pub(crate) vector: [Surd; 3],
    /// The units of shear along x, shear along y, and the normal force.
    pub(crate) floor: [Surd; 3],
}

/// The quantity that is written for each sphere, as three numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RowQuantity {
    /// The contact forces, by direction.
    Contacts,
    /// The components of the contact forces along one axis, by direction.
    Along(usize),
    /// The force on the floor: normal, shear along x, shear along y.
    Floor,
}

/// The source of a quantity along the rows of a layer.
pub(super) enum RowValues<F> {
    /// The distinct forces of a straight pile.
    Table(Table<F>),
    /// The numbers of increments on the lines that lead to the floor of a straight pile.
    Counts {
        table: Table<i64>,
        readout: Readout,
        units: Box<[Unit; 3]>,
    },
    /// The forces that the lines carry. Limbs are read without conversion.
    Lines {
        units: Box<[Unit; 3]>,
        readout: Option<Readout>,
    },
}

impl Layers<'_, BigRational> {
    /// Returns the source of a quantity in layer `k`, the current layer.
    pub(super) fn source<F: CorrectlyRounded>(
        &self,
        units: &Units,
        asked: RowQuantity,
        k: i128,
    ) -> Result<RowValues<F>, Error> {
        let terms = &self.terms;
        let by_direction = match asked {
            RowQuantity::Contacts => [(); 3].each(|()| units.contact.clone()),
            RowQuantity::Along(axis) => {
                let scale = &terms.direction_scale;
                terms.directions_below(k).each(|direction| {
                    let component = direction.into_array()[axis].clone();
                    units.vector[axis].scaled(&BigRational::new(component, scale.clone()))
                })
            }
            RowQuantity::Floor => {
                let units = Box::new(terms.floor_units(&units.floor));
                if self.table.is_some()
                    && let Some(readout) = terms.floor_readout_of_counts()
                    && let Some(table) = Table::new(&terms.system, k + 1, |n, _| small(n))?
                {
                    return Ok(RowValues::Counts {
                        table,
                        readout,
                        units,
                    });
                }
                return Ok(RowValues::Lines {
                    units,
                    readout: terms.floor_readout(),
                });
            }
        };
        if self.table.is_some() {
            let units = by_direction.each(|unit| Unit::new(unit, terms.lines.scale(0)));
            let nearest = |n: i128, line: usize| {
                let force = units[line].nearest(&terms.lines.ordinary(n.into(), line));
                force.ok_or_else(|| asked.overflow::<F>())
            };
            let table = Table::new(&terms.system, self.most_increments(), nearest)?;
            return table
                .map(RowValues::Table)
                .ok_or_else(|| bug("a pile with a table of exact forces has one of floats"));
        }
        let changes = self.shape().changes_above(k + 1);
        let denominator = terms.lines.scale(changes);
        Ok(RowValues::Lines {
            units: Box::new(by_direction.each(|unit| Unit::new(unit, denominator.clone()))),
            readout: self.contacts_readout(changes),
        })
    }

    /// Returns the readout of the contact forces below an ordinary sphere, after `changes` sign changes.
    fn contacts_readout(&self, changes: usize) -> Option<Readout> {
        let (terms, sweep) = (&self.terms, self.exact_sweep()?);
        let lines = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
        Some(Readout {
            // 3G is symmetric, so its columns equal its rows.
            combination: if sweep.turned_already() < changes {
                lines.each_ref().each(tripled_half_turn)
            } else {
                lines
            },
            own: terms.lines.increments_after(changes),
        })
    }

    /// Writes the quantity `asked` for consecutive spheres of a row of the current layer.
    pub(super) fn write_row<F: CorrectlyRounded>(
        &self,
        (asked, source): (RowQuantity, &RowValues<F>),
        row: &Row,
        [a, b, c]: [&mut [F]; 3],
    ) -> Result<(), Error> {
        check_interrupt()?;
        let (units, readout) = match source {
            RowValues::Table(table) => return table.fill_row(row, [a, b, c]),
            RowValues::Lines { units, readout } => (units, readout),
            RowValues::Counts {
                table,
                readout,
                units,
            } => {
                let mut counts = [(); 3].each(|()| alloc::vec![0; a.len()]);
                table.fill_row(row, counts.each_mut().each(Vec::as_mut_slice))?;
                let lines = counts.each_ref().each(Vec::as_slice);
                let defined = readout.write(units, &[lines], [a, b, c])?;
                return if defined {
                    Ok(())
                } else {
                    Err(asked.overflow::<F>())
                };
            }
        };
        // This readout treats every sphere as ordinary. It may overflow for a sphere of another weight whose actual
        // force does not. Then the exact integers below give the row.
        if let (Some(readout), Some(sweep)) = (readout, self.exact_sweep())
            && sweep.nearest_row(row, (readout, units), [&mut *a, &mut *b, &mut *c])?
        {
            for site in self.terms.lines.extras_in_row(row) {
                let place = (site.i - row.i.start).to_usize();
                let place = place.filter(|place| *place < a.len());
                let place = place.ok_or_else(|| bug("a slice is as long as its row"))?;
                [a[place], b[place], c[place]] = self.at_extra((asked, units), site)?;
            }
            return Ok(());
        }
        let numbers = self.numbers(asked, row)?;
        for (numbers, ((a, b), c)) in numbers.iter().zip(a.iter_mut().zip(b).zip(c)) {
            [*a, *b, *c] = nearest((asked, units), numbers)?;
        }
        Ok(())
    }

    /// Returns the quantity `asked` for a sphere with loads or with a weight of its own.
    fn at_extra<F: CorrectlyRounded>(
        &self,
        (asked, units): (RowQuantity, &[Unit; 3]),
        Site { i, j, k }: Site,
    ) -> Result<[F; 3], Error> {
        let row = Row { k, j, i: i..i + 1 };
        let numbers = self.numbers(asked, &row)?.pop();
        let numbers = numbers.ok_or_else(|| bug("a row of one sphere has its numbers"))?;
        nearest((asked, units), &numbers)
    }

    /// Returns the quantity `asked` for consecutive spheres as integers, before rounding.
    fn numbers(&self, asked: RowQuantity, row: &Row) -> Result<Vec<[BigInt; 3]>, Error> {
        if asked != RowQuantity::Floor {
            let below = self.transmitted_in(row)?.into_iter();
            return Ok(below.map(|below| below.forces).collect());
        }
        let sites = row.clone().into_iter();
        let on_floor = sites.zip(self.received_in(row)?).map(|(site, above)| {
            let (Vector { x, y, z }, _) = self.terms.floor_numerators(site, &above);
            [z, x, y]
        });
        Ok(on_floor.collect())
    }
}

impl Layer<'_, '_, BigRational> {
    pub(super) fn fill_nearest<F: CorrectlyRounded>(
        &self,
        units: &Units,
        asked: RowQuantity,
        slices: [&mut [F]; 3],
    ) -> Result<(), Error> {
        check_lengths(self.sphere_count(), &slices)?;
        let source = self.layers.source(units, asked, self.k())?;
        self.write((asked, &source), slices)
    }

    /// Writes the quantity `asked` into slices over the layer, row after row.
    fn write<F: CorrectlyRounded>(
        &self,
        (asked, source): (RowQuantity, &RowValues<F>),
        slices: [&mut [F]; 3],
    ) -> Result<(), Error> {
        let (layers, k) = (self.layers, self.k());
        let [a, b, c] = slices;
        // All cores read the limbs, as if every sphere were ordinary. The result counts only if no float overflows.
        if let RowValues::Lines {
            units,
            readout: Some(readout),
        } = source
            && let Some(sweep) = layers.exact_sweep()
        {
            let defined = AtomicBool::new(true);
            // The images of a contact force are equal to it, so the stored spheres are enough.
            let by_images = asked == RowQuantity::Contacts;
            fill_rows(&self.region, k, [&mut *a, &mut *b, &mut *c], |row, out| {
                let (row, out) = if by_images {
                    sweep.stored_piece(row, out)?
                } else {
                    (row.clone(), out)
                };
                if !sweep.nearest_row(&row, (readout, units), out)? {
                    defined.store(false, Ordering::Relaxed);
                }
                Ok(())
            })?;
            if by_images {
                sweep.copy_to_images(&mut [&mut *a, &mut *b, &mut *c])?;
            }
            if defined.into_inner() {
                for site in layers.terms.lines.extras_in(k..k + 1) {
                    check_interrupt()?;
                    let floats = layers.at_extra((asked, units), site)?;
                    self.put_at(site, floats, [&mut *a, &mut *b, &mut *c])?;
                }
                return Ok(());
            }
        }
        let mut rest = [a, b, c];
        for row in self.region.rows(k) {
            let front = split_front(&mut rest, row.length()?)?;
            layers.write_row((asked, source), &row, front)?;
        }
        Ok(())
    }
}

/// Returns three integers of a sphere times their units, correctly rounded.
fn nearest<F: CorrectlyRounded>(
    (asked, units): (RowQuantity, &[Unit; 3]),
    [x, y, z]: &[BigInt; 3],
) -> Result<[F; 3], Error> {
    let [unit_x, unit_y, unit_z] = units;
    let nearest = |unit: &Unit, n| unit.nearest(n).ok_or_else(|| asked.overflow::<F>());
    Ok([
        nearest(unit_x, x)?,
        nearest(unit_y, y)?,
        nearest(unit_z, z)?,
    ])
}

/// Converts a number of increments of a table, which is at most a million.
fn small(n: i128) -> Result<i64, Error> {
    i64::try_from(n).map_err(|_| bug("a table has few increments"))
}

impl RowQuantity {
    fn overflow<F>(self) -> Error {
        Error::Overflow {
            quantity: match self {
                Self::Contacts | Self::Along(_) => "a contact force",
                Self::Floor => "a force on the floor",
            },
            scalar: core::any::type_name::<F>(),
        }
    }
}
