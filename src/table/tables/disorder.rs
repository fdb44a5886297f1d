//! What the base bears in the mean over random stackings.

use num_bigint::BigInt;

use crate::Error;
use crate::disorder::{ByFaults, FaultForce, Mean, MeanForce};
use crate::scalar::{Algebra, Exactness, Polynomial};
use crate::table::cell::Cell;
use crate::table::rows::{Column, Table};

/// Of which stackings a mean is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Over {
    All,
    Some,
}

/// The mean over random stackings, a place a row: `a, b, probability, normal, shear_x, shear_y`.
///
/// [`Place`](crate::disorder::Place) says what a and b are. Below stand the totals of what is exact; none if `given_sphere` says
/// that the means are [over the stackings that have a sphere there](Mean::given_sphere), whose totals mean nothing.
///
/// # Examples
/// ```
/// use cannonpile::disorder::{FirstSign, RandomPiles, RandomStackings};
/// use cannonpile::lattice::Region;
/// use cannonpile::table::{self, FileFormat, NumberFormat};
/// use num_rational::BigRational;
///
/// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(2, FirstSign::Plus)?);
/// let mean = piles.exact(&BigRational::new(1.into(), 2.into()))?;
/// let mut csv = Vec::new();
/// table::mean(mean, false).write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert_eq!(
///     String::from_utf8(csv)?,
///     "a,b,probability,normal,shear_x,shear_y\n-1,-1,1,4/3,-1/6,-1/6\n1,0,1,4/3,-1/6,1/6\n0,1,1,4/3,1/3,0\n",
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn mean<T: Algebra + Into<Cell> + 'static>(
    mean: Mean<T>,
    given_sphere: bool,
) -> Table<'static> {
    let over = if given_sphere { Over::Some } else { Over::All };
    // Floats are shown, not summed.
    let exact = T::EXACTNESS == Exactness::Exact;
    let table = of_rows(mean, over, exact, Into::into);
    if exact && over == Over::All {
        table.summed_by_rows()
    } else {
        table
    }
}

/// Means over random stackings as polynomials in the fault probability `q`, a place a row, with the columns of [`mean`].
///
/// # Examples
/// ```
/// use cannonpile::disorder::{FirstSign, RandomPiles, RandomStackings};
/// use cannonpile::lattice::Region;
/// use cannonpile::table::{self, FileFormat, NumberFormat};
///
/// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(3, FirstSign::Plus)?);
/// let mut csv = Vec::new();
/// let table = table::mean_of_polynomials(piles.by_faults()?.polynomial()?);
/// table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert!(String::from_utf8(csv)?.contains("\n0,0,q,5 q/3,0,0\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn mean_of_polynomials(mean: Mean<Polynomial>) -> Table<'static> {
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
        Over::All => "means, over all stackings with none counted as 0, at bottom places",
        Over::Some => "means, over the stackings with a sphere there, at bottom places",
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

/// The normal forces by place and number of faults, summed over the stackings with so many: `a, b, faults, stackings,
/// normal`, with the number of those that have a sphere there.
///
/// # Examples
/// ```
/// use cannonpile::disorder::{FirstSign, RandomPiles, RandomStackings};
/// use cannonpile::lattice::Region;
/// use cannonpile::table::{self, FileFormat, NumberFormat};
///
/// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(3, FirstSign::Plus)?);
/// let by_faults = piles.by_faults()?;
/// let mut csv = Vec::new();
/// table::by_faults(&by_faults).write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// assert!(String::from_utf8(csv)?.starts_with("a,b,faults,stackings,normal\n-2,-2,0,1,5/3\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn by_faults(by_faults: &ByFaults) -> Table<'_> {
    let mut columns: Vec<_> = ["a", "b", "faults", "stackings"].map(Column::plain).into();
    columns.push(Column::measured("normal", "mg"));
    let row = |row: Result<FaultForce, Error>| {
        let FaultForce {
            place,
            faults,
            stackings,
            normal,
            ..
        } = row?;
        Ok(vec![
            place.a.into(),
            place.b.into(),
            i128::from(faults).into(),
            Cell::Integer(BigInt::from(stackings)),
            normal.into(),
        ])
    };
    let noun = "sums, over the stackings with so many faults, at bottom places";
    Table::of_rows(columns, noun, by_faults.rows().map(row))
}
