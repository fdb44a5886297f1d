//! The equations of equilibrium as a sparse matrix, with their exact solution: the files of `PileFormat::Mtx`.
//!
//! The unknowns are the contact forces f below every sphere that has supports. A pile has d = 3 lines of contacts, or 2 for
//! discs, and line l of sphere `id` is unknown d (id − 1) + l + 1. In f₀ the equations are f = S f + w: a sphere transmits the
//! forces from above, turned by G = (2/3)J − 1 at a sign change, and adds w. The matrix is 3(I − S), which has integer
//! entries, or I − S in piles that have no sign changes: of discs and on isosceles bases. In newtons the equations balance the
//! components of the forces on each sphere.

mod properties;

use std::fmt::Display;
use std::io::Write;

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::One;

use super::file::PileFile;
use super::numbered::{NumberedPile, rounded};
use super::weights::{rounded_newtons, special_sites};
use crate::error::bug;
use crate::table::{PIECE, WriteError, columns, slices};
use crate::{Each, Error, Key};
use cannonpile::formula;
use cannonpile::geometry::{Vector, square_across};
use cannonpile::lattice::{Dimension, Direction, Site};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::{Interrupt, Layers, Output};

/// The equations of a pile.
#[derive(Clone, Copy)]
pub(super) struct Equations<'e, 'p> {
    pile: &'e NumberedPile<'p>,
    in_si: bool,
}

impl<'e, 'p> Equations<'e, 'p> {
    /// # Errors
    /// [`Error::NoEquations`] for a pile of one layer, or with horizontal contact forces.
    pub(super) fn new(pile: &'e NumberedPile<'p>, in_si: bool) -> Result<Self, Error> {
        let pushes = pile.pile().horizontal_forces().len();
        let given = match (pile.pile().layers(), pushes) {
            (1, _) => Key::Layers,
            (_, 0) => return Ok(Self { pile, in_si }),
            _ => Key::State,
        };
        Err(Error::NoEquations { given })
    }

    /// Returns d.
    fn lines(self) -> u32 {
        self.pile.pile().dimension().number()
    }

    /// Returns the factor of I − S in f₀, and 1 in newtons.
    fn scale(self) -> u8 {
        let pile = self.pile.pile();
        let turns = pile.dimension() == Dimension::Three && pile.is_regular();
        if turns && !self.in_si { 3 } else { 1 }
    }

    /// Returns the number of rows, which is that of columns.
    pub(super) fn unknowns(self) -> BigUint {
        self.pile.pile().contact_count()
    }

    /// Returns the number of entries of the matrix that are not 0, from the columns of one sphere of each layer.
    pub(super) fn entries(self) -> Result<BigUint, Error> {
        let (pile, mut entries) = (self.pile.pile(), BigUint::ZERO);
        for k in 0..pile.layers() - 1 {
            let spheres = pile.shape().layer(k)?.site_count();
            let site = pile.sites(Selection::Layer(k))?.next();
            let site = site.ok_or_else(|| bug("every layer has a sphere"))?;
            for direction in pile.dimension().directions() {
                let column = self.column(site, *direction)?.into_iter().flatten();
                entries += &spheres * column.filter(|entry| *entry != 0.0).count();
            }
        }
        Ok(entries)
    }

    /// Writes one of the files.
    pub(super) fn write(self, file: PileFile, rows: &mut Rows<'_>) -> Result<(), WriteError> {
        let (packing, n) = (self.pile.packing(), self.unknowns());
        let field = if self.in_si { "real" } else { "integer" };
        match file {
            PileFile::EquilibriumMtx => {
                let d = self.pile.pile().dimension().directions().len();
                let rows_are = if self.in_si {
                    "rows by axes"
                } else {
                    "rows in the same order"
                };
                let last = d - 1;
                let comment = format!(
                    "column {d} (id - 1) + l + 1 is the force on line l = 0 to {last} below sphere id; {rows_are}"
                );
                let size = format!("{n} {n} {}", self.entries()?);
                rows.head(&format!("coordinate {field}"), &comment, &size)?;
                self.write_columns(rows)
            }
            PileFile::LoadsMtx => {
                let denominator = self.denominator();
                let comment = format!("b times {denominator}; no integer is cut to 64 bits");
                rows.head(&format!("array {field}"), &comment, &format!("{n} 1"))?;
                self.write_loads(rows)
            }
            PileFile::ForcesMtx => {
                let layers = if self.in_si {
                    packing.layers::<f64>(Selection::All)?
                } else {
                    packing.forces().layers(Selection::All)?.nearest()?
                };
                let comment = format!("x in {}", self.unit());
                rows.head("array real", &comment, &format!("{n} 1"))?;
                self.write_forces(layers, rows, |force| format!("{force:?}"))
            }
            PileFile::ForcesExact => {
                let unit = Some(packing.unit_force()).filter(|_| self.in_si);
                self.write_forces(packing.forces().layers(Selection::All)?, rows, |force| {
                    let in_si = unit.as_ref().map(|unit| unit.scaled(force).to_string());
                    in_si.unwrap_or_else(|| force.to_string())
                })
            }
            _ => Err(bug("the other files are not of Matrix Market").into()),
        }
    }

    /// Writes the entries, column by column.
    fn write_columns(self, rows: &mut Rows<'_>) -> Result<(), WriteError> {
        let d = u64::from(self.lines());
        for spheres in self.pile.linked_rows()? {
            Interrupt::check().map_err(Error::from)?;
            let (spheres, mut entries) = (spheres?, Vec::new());
            for (direction, below) in &spheres.below {
                let column = d * (spheres.upper - 1) + direction.index() as u64 + 1;
                let parts = self.column(spheres.first, *direction)?;
                for (id, part) in [spheres.upper, *below].into_iter().zip(parts) {
                    let part = (d * (id - 1) + 1..).zip(part);
                    entries.extend(
                        part.filter(|(_, entry)| *entry != 0.0)
                            .map(|(row, entry)| (row, column, entry)),
                    );
                }
            }
            for n in 0..spheres.spheres {
                for (row, column, entry) in &entries {
                    rows.write(format_args!("{} {} {entry}", row + d * n, column + d * n))?;
                }
            }
        }
        Ok(())
    }

    /// Writes the right-hand sides. Those of ordinary spheres are equal in a layer.
    fn write_loads(self, rows: &mut Rows<'_>) -> Result<(), WriteError> {
        let special = special_sites(self.pile.pile());
        let (mut known, mut loads) = (None, Default::default());
        for site in self.pile.rows_above_the_floor()?.flatten() {
            let sphere = Some((site.k, special.binary_search(&site).ok()));
            if known != sphere {
                Interrupt::check().map_err(Error::from)?;
                (known, loads) = (sphere, self.loads(site)?);
            }
            for load in &loads[..self.lines() as usize] {
                rows.write(load)?;
            }
        }
        Ok(())
    }

    /// Returns a column in the rows of the upper sphere of the contact, and in those of the lower one.
    fn column(self, site: Site, direction: Direction) -> Result<[[f64; 3]; 2], Error> {
        let shape = self.pile.pile().shape();
        let signs = [site.k, site.k + 1].each(|k| shape.sign_below(k));
        let mut line = [0.0; 3];
        line[direction.index()] = 1.0;
        let column = if self.in_si {
            self.direction(site, direction)?
        } else {
            line.each(|entry| f64::from(self.scale()) * entry)
        };
        let transmitted = match signs {
            [_, None] => [0.0; 3],
            [above, below] if self.in_si || above == below => column,
            _ => formula::tripled_half_turn(&line),
        };
        Ok([column, transmitted.each(|entry| 0.0 - entry)])
    }

    /// Returns the unit vector up along a contact, by axis of the equations.
    fn direction(self, site: Site, direction: Direction) -> Result<[f64; 3], Error> {
        let packing = self.pile.packing();
        let Vector { x, y, z } = packing.forces().contact_direction(site, direction)?;
        let (sin, cos) = (packing.inclination().sin(), packing.inclination().cos());
        let across = Surd::sqrt(square_across(self.pile.pile().sin_phi()));
        let across = across.map_err(cannonpile::Error::from)? * &sin;
        let along = [sin.scaled(&x), across.scaled(&y), cos.scaled(&-z)];
        Ok(self.by_axis(rounded(&along, "a direction")?))
    }

    /// Returns a vector by axis of the equations. Discs have x and z, and then nothing.
    fn by_axis(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self.pile.pile().dimension() {
            Dimension::Two => [x, z, y],
            Dimension::Three => [x, y, z],
        }
    }

    /// Returns the right-hand sides of a sphere, times the denominator.
    fn loads(self, site: Site) -> Result<[String; 3], Error> {
        let pile = self.pile.pile();
        if self.in_si {
            let load = rounded_newtons(self.pile.packing(), pile.total_load(site), "load")?;
            // The subtraction yields 0, never −0.
            return Ok(self.by_axis(load).each(|part| format!("{:?}", 0.0 - part)));
        }
        let factor = BigRational::from_integer(self.denominator() * self.scale());
        let own = pile.own_increments(site);
        Ok(own.each(|increment| (increment * &factor).to_string()))
    }

    /// Returns a common denominator of the right-hand sides in f₀, and 1 in newtons.
    fn denominator(self) -> BigInt {
        if self.in_si {
            return BigInt::one();
        }
        self.pile.pile().denominator()
    }

    fn unit(self) -> &'static str {
        if self.in_si { "newtons" } else { "f0" }
    }

    /// Writes the unknowns in their order.
    fn write_forces<O: Output>(
        self,
        mut layers: Layers<'p, O>,
        rows: &mut Rows<'_>,
        text: impl Fn(&O::Value) -> String,
    ) -> Result<(), WriteError>
    where
        O::Value: Default,
    {
        for piece in self
            .pile
            .rows_above_the_floor()?
            .flat_map(|row| row.pieces(PIECE))
        {
            let mut forces = columns(&piece)?;
            layers.fill_row(&piece, slices(&mut forces))?;
            for n in 0..piece.length()? {
                for line in &forces[..self.lines() as usize] {
                    rows.write(text(&line[n]))?;
                }
            }
        }
        Ok(())
    }
}

/// The rows of a file, which are counted.
pub(super) struct Rows<'w> {
    pub(super) out: &'w mut dyn Write,
    pub(super) row: &'w mut dyn FnMut(),
}

impl Rows<'_> {
    /// Writes the head of a file of Matrix Market.
    fn head(&mut self, kind: &str, comment: &str, size: &str) -> std::io::Result<()> {
        writeln!(
            self.out,
            "%%MatrixMarket matrix {kind} general\n% {comment}\n{size}"
        )
    }

    fn write(&mut self, row: impl Display) -> Result<(), WriteError> {
        writeln!(self.out, "{row}")?;
        (self.row)();
        Ok(())
    }
}
