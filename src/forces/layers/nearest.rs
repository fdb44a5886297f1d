//! Forces as correctly rounded floats.

use alloc::vec::Vec;
use core::any::type_name;
use core::marker::PhantomData;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use super::{Layers, Quantities, Write};
use crate::Error;
use crate::each::Each;
use crate::engine::{Engine, Readout, Table, Unit};
use crate::error::bug;
use crate::formula::tripled_half_turn;
use crate::lattice::Row;
use crate::scalar::{CorrectlyRounded, Surd};

/// The [`Output`](super::Output) of layers that write forces in a unit, correctly rounded to the floats `F`.
///
/// Made by [`Layers::nearest`] in pile units, and by [`Packing::layers`](crate::Packing::layers) in newtons. Each force
/// is exact until it is rounded.
///
/// # Examples
/// ```
/// use cannonpile::shape::Selection;
/// use cannonpile::{Packing, Pile};
///
/// let pile = Pile::triangular(10)?;
/// let mut layers = Packing::new(&pile, &"6/5".parse()?)?.layers::<f64>(Selection::Layer(0))?;
/// let apex = layers.next_layer()?.expect("layer 0 is asked for");
/// let [mut alpha, mut beta, mut gamma] = [[0.0; 1]; 3];
/// apex.fill([&mut alpha, &mut beta, &mut gamma])?;
/// assert_eq!(alpha, [0.46225016352102425]);
/// # Ok::<(), cannonpile::Error>(())
/// ```
#[derive(Debug)]
pub struct Nearest<F>(PhantomData<F>);

/// The units of the forces in layers. An exact multiple of a unit is rounded once.
#[derive(Clone, Debug)]
pub struct Units {
    pub(crate) contact: Surd,
    /// The units of a contact force as a vector on the upper sphere: along x, y and z.
    pub(crate) vector: [Surd; 3],
    /// The units of shear along x, shear along y, and the normal force.
    pub(crate) floor: [Surd; 3],
}

/// The rounding of integers times units.
pub struct Rounding<F> {
    quantity: &'static str,
    units: [Unit; 3],
    from: From<F>,
}

/// What is rounded along the rows of a layer.
enum From<F> {
    /// The distinct forces of a straight pile, rounded already.
    Table(Table<F>),
    /// The numbers of increments on the lines that lead to the floor of a straight pile.
    Counts(Table<i64>, Readout),
    /// The forces that the lines carry. Limbs are read without conversion, unless a factor is too long.
    Lines(Option<Readout>),
}

impl<'p> Layers<'p, BigRational> {
    /// Returns the layers with correctly rounded forces, in pile units.
    ///
    /// # Errors
    /// [`Error::Overflow`] for a force beyond the range of the floats.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Region;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::under(Region::SITE, "+-".parse()?)?;
    /// let mut layers = pile.forces::<BigRational>().layers(Selection::Base)?.nearest::<f64>()?;
    /// let floor = layers.next_layer()?.expect("every pile has a floor");
    /// let [mut normal, mut shear_x, mut shear_y] = [[0.0; 7]; 3];
    /// floor.fill_base([&mut normal, &mut shear_x, &mut shear_y])?;
    /// assert_eq!(normal[0], 14.0 / 9.0);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn nearest<F: CorrectlyRounded>(self) -> Result<Layers<'p, Nearest<F>>, Error> {
        let one = || Surd::from(BigRational::one());
        self.into_output(Units {
            contact: one(),
            vector: [one(), one(), one()],
            floor: [one(), one(), one()],
        })
    }
}

impl<F: CorrectlyRounded> Layers<'_, Nearest<F>> {
    /// Returns whether every nonzero contact force is certain to be rounded to a normal float, with full precision.
    ///
    /// Each force is an integer multiple of the unit over a denominator. The function checks one such multiple, the
    /// smallest possible force. So the result may be `false` although every actual force is larger.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::shape::Selection;
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &"6/5".parse()?)?;
    /// assert!(packing.layers::<f64>(Selection::All)?.keeps_digits());
    /// let light = packing.with_mass("1e-310".parse::<cannonpile::scalar::Surd>()?.coefficient().clone())?;
    /// assert!(!light.layers::<f64>(Selection::All)?.keeps_digits());
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    #[must_use]
    pub fn keeps_digits(&self) -> bool {
        let least = Unit::new(self.unit.contact.clone(), self.lowest_denominator());
        let normal = F::MIN_EXPONENT + i64::from(F::PRECISION) - 1;
        least.exceeds_power_of_two(normal)
    }

    /// Writes the contact forces on consecutive spheres from their supports, as vectors, into slices: one for each
    /// component x, y, z and each direction. Pile units are those of [`contact_vector`](crate::Forces::contact_vector).
    ///
    /// # Errors
    /// As for [`fill_row`](Self::fill_row).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Row;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let layers = pile.forces::<BigRational>().layers(Selection::All)?;
    /// let mut vectors = [[[0.0]; 3]; 3];
    /// let slices = vectors.each_mut().map(|of| of.each_mut().map(|slice| slice.as_mut_slice()));
    /// layers.nearest::<f64>()?.fill_row_of_vectors(&Row { k: 1, j: 0, i: 1..2 }, slices)?;
    /// // The force f·ê of the contact along β.
    /// assert_eq!(vectors.map(|component| component[1][0]), [1.0, -1.0, -2.0]);
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_row_of_vectors(
        &mut self,
        row: &Row,
        slices: [[&mut [F]; 3]; 3],
    ) -> Result<(), Error> {
        // The numerators of the forces are the same for all axes.
        let mut numbers = None;
        for (axis, slices) in slices.into_iter().enumerate() {
            let asked = Quantities::Along(axis);
            self.fill_row_with(asked, row, slices, |layers| {
                let numbers = numbers.get_or_insert_with(|| layers.numbers(asked, row));
                numbers.clone()
            })?;
        }
        Ok(())
    }

    /// Writes the forces of consecutive bottom spheres on the floor into slices: normal, shear along x, shear along y.
    ///
    /// # Errors
    /// [`Error::NotOnFloor`]; otherwise as for [`fill_row`](Self::fill_row).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::lattice::Row;
    /// use cannonpile::shape::Selection;
    /// use num_rational::BigRational;
    ///
    /// let pile = Pile::triangular(10)?;
    /// let layers = pile.forces::<BigRational>().layers(Selection::Base)?;
    /// let [mut normal, mut shear_x, mut shear_y] = [[0.0; 2]; 3];
    /// let slices = [normal.as_mut_slice(), &mut shear_x, &mut shear_y];
    /// layers.nearest::<f64>()?.fill_row_of_base(&Row { k: 9, j: 3, i: 2..4 }, slices)?;
    /// assert_eq!((normal, shear_x, shear_y), ([4.0; 2], [0.0; 2], [-1.0 / 3.0, 0.0]));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn fill_row_of_base(&mut self, row: &Row, slices: [&mut [F]; 3]) -> Result<(), Error> {
        self.fill_row_of(Quantities::Floor, row, slices)
    }
}

impl<F: CorrectlyRounded> Write for Nearest<F> {
    type Scalar = BigRational;
    type Value = F;
    type Unit = Units;
    type Whole = ();
    type Conversion = Rounding<F>;

    fn begin_whole(_: &mut Layers<'_, Self>) {}

    fn conversion(
        layers: &Layers<'_, Self>,
        asked: Quantities,
        k: i128,
    ) -> Result<Rounding<F>, Error> {
        let (lines, engine) = (&layers.source.lines, &layers.source.engine);
        let (unit, quantity) = (&layers.unit, asked.name());
        let by_direction = match asked {
            Quantities::Contacts => [(); 3].each(|()| unit.contact.clone()),
            Quantities::Along(axis) => {
                let scale = &lines.direction_scale;
                lines.directions_below(k).each(|direction| {
                    let component = direction.into_array()[axis].clone();
                    unit.vector[axis].scaled(&BigRational::new(component, scale.clone()))
                })
            }
            Quantities::Floor => {
                let counts = |readout| {
                    let table = Table::new(lines, k + 1, |n, _| small(n))?;
                    Ok::<_, Error>(table.map(|table| From::Counts(table, readout)))
                };
                let closed = lines.floor_readout_of_counts().filter(|_| layers.is_closed);
                let counts = closed.map(counts).transpose()?.flatten();
                return Ok(Rounding {
                    quantity,
                    units: lines.floor_units(&unit.floor),
                    from: counts.unwrap_or_else(|| From::Lines(lines.floor_readout())),
                });
            }
        };
        let changes = layers.shape().changes_above(k + 1);
        let denominator = lines.scale(changes);
        let mut rounding = Rounding {
            quantity,
            units: by_direction.each(|unit| Unit::new(unit, denominator.clone())),
            from: From::Lines(None),
        };
        if let Engine::Limbs(sweep) = engine {
            let lines_alone = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
            rounding.from = From::Lines(Some(Readout {
                // 3G is symmetric, so its columns equal its rows.
                combination: if sweep.turned_already() < changes {
                    lines_alone.each_ref().each(tripled_half_turn)
                } else {
                    lines_alone
                },
                own: lines.increments_after(changes),
            }));
        } else if let (Quantities::Along(_), true) = (asked, layers.is_closed)
            && let Some(table) = layers.table_of(&rounding)?
        {
            rounding.from = From::Table(table);
        }
        Ok(rounding)
    }

    fn is_of_all_layers(rounding: &Rounding<F>) -> bool {
        !matches!(rounding.from, From::Lines(_))
    }

    fn value(rounding: &Rounding<F>, line: usize, numerator: BigInt) -> Result<F, Error> {
        let float = rounding.units[line].nearest(&numerator);
        float.ok_or_else(|| Error::overflow(rounding.quantity, type_name::<F>()))
    }

    fn write_ordinary(
        layers: &Layers<'_, Self>,
        Rounding { units, from, .. }: &Rounding<F>,
        row: &Row,
        out: [&mut [F]; 3],
    ) -> Result<bool, Error> {
        match (from, &layers.source.engine) {
            (From::Table(table), _) => table.fill_row(row, out).map(|()| true),
            (From::Counts(table, readout), _) => {
                let mut counts = [(); 3].each(|()| alloc::vec![0; out[0].len()]);
                table.fill_row(row, counts.each_mut().each(Vec::as_mut_slice))?;
                let lines = counts.each_ref().each(Vec::as_slice);
                readout.write(units, &[lines], out)
            }
            (From::Lines(Some(readout)), Engine::Limbs(sweep)) => {
                sweep.nearest_row(row, (readout, units), out)
            }
            _ => Ok(false),
        }
    }
}

/// Converts a number of increments of a table, which is at most a million.
fn small(n: i128) -> Result<i64, Error> {
    i64::try_from(n).map_err(|_| bug("a table has few increments"))
}
