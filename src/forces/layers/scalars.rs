//! Forces as values of a scalar.

use super::below::Below;
use super::{Layers, Quantities, Write};
use crate::Error;
use crate::engine::{Engine, to_scalar};
use crate::lattice::Row;
use crate::scalar::Algebra;

/// The division of numerators by their denominator.
pub struct Division<T: Algebra> {
    quantity: &'static str,
    scale: T::Numerator,
    /// The contact forces of ordinary spheres, from the numbers on the lines of a sweep.
    below: Option<Below<T>>,
}

impl<T: Algebra> Write for T {
    type Scalar = T;
    type Value = T;
    type Unit = ();
    type Whole = ();
    type Conversion = Division<T>;

    fn begin_whole(_: &mut Layers<'_, T>) {}

    fn conversion(
        layers: &Layers<'_, T>,
        asked: Quantities,
        k: i128,
    ) -> Result<Division<T>, Error> {
        let (source, shape) = (&layers.source, layers.shape());
        let (lines, quantity) = (&source.lines, asked.name());
        if asked == Quantities::Floor {
            return Ok(Division {
                quantity,
                scale: lines.floor_unit(shape.changes_above(k)),
                below: None,
            });
        }
        let changes = shape.changes_above(k + 1);
        let scale = lines.scale(changes);
        let below = match &source.engine {
            Engine::Cells(sweep) => Some(Below {
                own: lines.increments_after(changes),
                scale: scale.clone(),
                turns: sweep.turned_already() < changes,
                may_overflow: layers.may_overflow,
            }),
            Engine::Lines | Engine::Limbs(_) => None,
        };
        Ok(Division {
            quantity,
            scale,
            below,
        })
    }

    fn value(
        Division {
            quantity, scale, ..
        }: &Division<T>,
        _: usize,
        numerator: T::Numerator,
    ) -> Result<T, Error> {
        to_scalar(quantity, numerator, scale)
    }

    fn write_ordinary(
        layers: &Layers<'_, T>,
        conversion: &Division<T>,
        row: &Row,
        out: [&mut [T]; 3],
    ) -> Result<bool, Error> {
        match (&layers.source.engine, &conversion.below) {
            (Engine::Cells(sweep), Some(below)) => Ok(below.write(sweep.carried(row)?, out)),
            _ => Ok(false),
        }
    }
}
