//! The tables of mean base forces over random stackings.

use cannonpile::engine::bug;
use cannonpile::scalar::{Algebra, Exactness, Polynomial};
use cannonpile_dem::table::{Cell, Column, Row, Table};
use cannonpile_disorder::{ByFaults, Error, FaultForce, Mean, MeanForce};
use num_bigint::BigInt;

/// The stackings that a mean covers: all, or those with a sphere at the position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Over {
    All,
    Some,
}

/// Returns the means over random stackings, a row for each position: `a, b, probability, normal, shear_x, shear_y`.
///
/// [`Place`](cannonpile_disorder::Place) defines a and b. Exact means have totals. With `given_sphere`, the means cover only
/// the stackings with [a sphere at the position](Mean::given_sphere), and have no totals.
#[must_use]
pub(crate) fn mean<T: Algebra + Into<Cell> + 'static>(
    mean: Mean<T>,
    given_sphere: bool,
) -> Table<'static> {
    let over = if given_sphere { Over::Some } else { Over::All };
    // Floats have no totals, because a sum of rounded values is not correctly rounded.
    let exact = T::EXACTNESS == Exactness::Exact;
    let table = of_rows(mean, over, exact, Into::into);
    if exact && over == Over::All {
        table.summed_by_rows()
    } else {
        table
    }
}

/// Returns the means as polynomials in the fault probability `q`, with the columns of [`mean`].
#[must_use]
pub(crate) fn mean_of_polynomials(mean: Mean<Polynomial>) -> Table<'static> {
    of_rows(mean, Over::All, false, |polynomial| {
        Cell::Word(polynomial.to_string().into())
    })
}

fn of_rows<T: 'static>(
    mean: Mean<T>,
    over: Over,
    summed: bool,
    cell: impl Fn(T) -> Cell + 'static,
) -> Table<'static> {
    let measured = |name, unit| {
        if summed && over == Over::All {
            Column::summed(name, unit)
        } else {
            Column::measured(name, unit)
        }
    };
    let columns = vec![
        Column::plain("a"),
        Column::plain("b"),
        Column::measured("probability", ""),
        measured("normal", "mg"),
        measured("shear_x", "mg·tanθ"),
        measured("shear_y", "√3·mg·tanθ"),
    ];
    let noun = match over {
        Over::All => "means over all stackings, where an empty position counts as 0",
        Over::Some => "means over the stackings with a sphere at the position",
    };
    let count = mean.rows().len().into();
    let rows = mean.into_rows().into_iter().map(move |row| {
        let MeanForce {
            place,
            probability,
            normal,
            shear_x,
            shear_y,
        } = row;
        let mut cells = vec![place.a.into(), place.b.into()];
        cells.extend([probability, normal, shear_x, shear_y].map(&cell));
        Ok(cells)
    });
    Table::of_rows(columns, noun, rows).bounded(count, Vec::new())
}

/// Returns the sums of normal forces, a row for each position and number of faults: `a, b, faults, stackings, normal`.
///
/// `stackings` is the number of stackings with this number of faults and a sphere at the position.
#[must_use]
pub(crate) fn by_faults(by_faults: &ByFaults) -> Table<'_> {
    let mut columns: Vec<_> = ["a", "b", "faults", "stackings"].map(Column::plain).into();
    columns.push(Column::measured("normal", "mg"));
    let row = |row: Result<FaultForce, Error>| -> Row {
        let FaultForce {
            place,
            faults,
            stackings,
            normal,
            ..
        } = row.map_err(|error| match error {
            Error::Core(error) => error,
            _ => bug("the rows of computed sums return only errors of the core"),
        })?;
        Ok(vec![
            place.a.into(),
            place.b.into(),
            i128::from(faults).into(),
            Cell::Integer(BigInt::from(stackings)),
            normal.into(),
        ])
    };
    let noun = "sums over the stackings with this number of faults";
    Table::of_rows(columns, noun, by_faults.rows().map(row))
}

#[cfg(test)]
mod tests {
    use cannonpile::lattice::Region;
    use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};

    use super::super::test::{csv, ratio};
    use super::*;

    fn piles(layers: i128) -> RandomPiles {
        let stackings = RandomStackings::new(layers, FirstSign::Plus).unwrap();
        RandomPiles::under(Region::SITE, stackings)
    }

    #[test]
    fn mean_of_two_layers() {
        let exact = piles(2).exact(&ratio(1, 2)).unwrap();
        assert_eq!(
            csv(mean(exact, false)),
            "a,b,probability,normal,shear_x,shear_y\n-1,-1,1,4/3,-1/6,-1/6\n1,0,1,4/3,-1/6,1/6\n0,1,1,4/3,1/3,0\n",
        );
    }

    #[test]
    fn polynomials_in_the_fault_probability() {
        let mean = piles(3).by_faults().unwrap().polynomial().unwrap();
        assert!(csv(mean_of_polynomials(mean)).contains("\n0,0,q,5 q/3,0,0\n"));
    }

    #[test]
    fn sums_by_faults() {
        let sums = piles(3).by_faults().unwrap();
        let csv = csv(by_faults(&sums));
        assert!(csv.starts_with("a,b,faults,stackings,normal\n-2,-2,0,1,5/3\n"));
    }
}
