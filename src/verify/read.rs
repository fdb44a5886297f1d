//! Files of either kind.

use std::io::BufRead;

use super::csv_file::read_rows;
use super::dump::{ITEM, read_snapshots};
use super::lines::Lines;
use super::pairs::Scope;
use super::reading::Reading;
use super::refusal::Refusal;
use crate::Packing;

/// Reads measured forces from a file of either kind: a LAMMPS dump if its first line begins with `ITEM:`, else csv.
///
/// Of what scene they are is not known yet: [`read_for`] refuses sooner what does not fit.
///
/// # Errors
/// Those of [`read_csv`](super::read_csv) and [`read_dump`](super::read_dump).
///
/// # Examples
/// ```
/// use cannonpile::verify;
///
/// let reading = verify::read(&b"id1,id2,force\n1,2,0.5\n"[..])?;
/// assert_eq!((reading.entries().len(), reading.snapshots()), (1, 0));
/// # Ok::<(), cannonpile::verify::Refusal>(())
/// ```
pub fn read(input: impl BufRead) -> Result<Reading, Refusal> {
    read_either(input, None)
}

/// Reads measured forces as [`read`] does, and refuses at its line what is not of this packing: the number of a sphere
/// that it has not got, a pair that is there twice, and more pairs than its spheres have neighbours.
///
/// Memory does not grow beyond what the packing can take, whatever the file.
///
/// # Errors
/// Those of [`read`] and of [`Comparison::new`](super::Comparison::new), with the line of the file.
///
/// # Examples
/// ```
/// use cannonpile::geometry::Spacing;
/// use cannonpile::{Packing, Pile, verify};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
/// let repeated = [&b"id1,id2,force\n1,2,0.5\n2,1,0.5\n"[..], &[b'1'; 1 << 20]].concat();
/// assert_eq!(
///     verify::read_for(&packing, &*repeated).unwrap_err().to_string(),
///     "line 3: spheres 1 and 2 again, after line 2: list each pair once",
/// );
/// # Ok::<(), cannonpile::verify::Refusal>(())
/// ```
pub fn read_for(packing: &Packing<'_>, input: impl BufRead) -> Result<Reading, Refusal> {
    read_either(input, Some(Scope::new(packing)?))
}

fn read_either(input: impl BufRead, scope: Option<Scope>) -> Result<Reading, Refusal> {
    let reading = Reading::begin(scope);
    let mut lines = Lines::new(input);
    let first = lines.next()?;
    let is_dump = first.is_some_and(|line| line.text.starts_with(ITEM));
    lines.put_back();
    let reading = if is_dump {
        read_snapshots(lines, reading)
    } else {
        read_rows(lines, reading)
    };
    Ok(reading?.end())
}
