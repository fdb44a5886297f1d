//! Writes the rows of a layer into slices, in row order, with several threads for large layers.

use core::ops::Range;

use super::interrupt::check as check_interrupt;
use super::parallel;
use crate::Error;
use crate::each::Each;
use crate::error::bug;
use crate::lattice::{Region, Row};

/// The smallest number of spheres that justifies a thread.
const WORTH_A_THREAD: usize = 1 << 12;

const LENGTH_INVARIANT: &str = "slices have one entry for each sphere of the layer";

/// Splits the first `n` elements off each slice.
///
/// # Errors
/// [`Error::Bug`] if a slice is shorter.
pub(crate) fn split_front<'a, V>(
    rest: &mut [&'a mut [V]; 3],
    n: usize,
) -> Result<[&'a mut [V]; 3], Error> {
    match rest.each_mut().each(|rest| rest.split_off_mut(..n)) {
        [Some(a), Some(b), Some(c)] => Ok([a, b, c]),
        _ => Err(bug("slices have the length that was checked")),
    }
}

/// Writes the rows of layer `k` into slices with one entry for each sphere. Parts of the layer are written in parallel
/// if there are threads.
///
/// # Errors
/// The errors of `write`, and [`Error::Bug`] for slices of another length.
pub(crate) fn fill_rows<V: Send>(
    layer: &Region,
    k: i128,
    slices: [&mut [V]; 3],
    write: impl Fn(&Row, [&mut [V]; 3]) -> Result<(), Error> + Sync,
) -> Result<(), Error> {
    let worth = slices[0].len() / WORTH_A_THREAD;
    let parts = worth.min(parallel::threads()).max(1);
    let rows = *layer.y().start()..layer.y().end() + 1;
    fill_parts(parts, (layer, k), rows, slices, &write)
}

fn fill_parts<V: Send>(
    parts: usize,
    (layer, k): (&Region, i128),
    rows: Range<i128>,
    mut slices: [&mut [V]; 3],
    write: &(impl Fn(&Row, [&mut [V]; 3]) -> Result<(), Error> + Sync),
) -> Result<(), Error> {
    let row = |j| Row {
        k,
        j,
        i: layer.row(j),
    };
    let cut = || {
        parallel::cut(rows.clone(), parts as i128, |j| {
            layer.row(j).count() as i128
        })
    };
    if let Some((border, spheres)) = (parts > 1).then(cut).flatten() {
        let half = parts / 2;
        let spheres = usize::try_from(spheres).map_err(|_| bug(LENGTH_INVARIANT))?;
        let before = split_front(&mut slices, spheres)?;
        return parallel::share(
            || fill_parts(half, (layer, k), rows.start..border, before, write),
            || fill_parts(parts - half, (layer, k), border..rows.end, slices, write),
        );
    }
    for row in rows.map(row) {
        check_interrupt()?;
        let front = split_front(&mut slices, row.length()?)?;
        write(&row, front)?;
    }
    if slices.iter().all(|slice| slice.is_empty()) {
        Ok(())
    } else {
        Err(bug(LENGTH_INVARIANT))
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;

    /// Each sphere is written once, at its position, for any number of parts.
    #[test]
    fn parts_of_a_layer_are_the_layer() {
        let regions = [
            Region::SITE,
            Region::triangle(9).unwrap(),
            Region::hexagon(7, 4).unwrap(),
        ];
        for layer in regions {
            let sites: Vec<[i128; 3]> = layer.rows(5).flatten().map(|s| [s.i, s.j, s.k]).collect();
            for parts in 1..12 {
                let mut numbers = [(); 3].map(|()| alloc::vec![[0; 3]; sites.len()]);
                let rows = *layer.y().start()..layer.y().end() + 1;
                let slices = numbers.each_mut().map(Vec::as_mut_slice);
                fill_parts(parts, (&layer, 5), rows, slices, &|row, slices| {
                    for (line, slice) in (1..).zip(slices) {
                        for (site, number) in row.clone().into_iter().zip(slice) {
                            *number = [site.i, site.j, site.k].map(|x| x * line);
                        }
                    }
                    Ok(())
                })
                .unwrap();
                for (line, numbers) in (1..).zip(numbers) {
                    let wanted = sites.iter().map(|site| site.map(|x| x * line));
                    assert!(numbers.into_iter().eq(wanted), "{layer} {parts}");
                }
            }
        }
    }

    /// Checks that a column of many rows is cut no more often than there are parts, since each cut waits for both
    /// halves.
    #[test]
    fn rows_are_not_cut_for_less_than_a_part() {
        let column = Region::new(0..=0, 0..=99_999, 0..=99_999).unwrap();
        for parts in [1, 2] {
            let mut numbers = [(); 3].map(|()| alloc::vec![-1; 100_000]);
            let slices = numbers.each_mut().map(Vec::as_mut_slice);
            fill_parts(parts, (&column, 0), 0..100_000, slices, &|row, slices| {
                for slice in slices {
                    slice.fill(row.j);
                }
                Ok(())
            })
            .unwrap();
            assert!(
                numbers
                    .into_iter()
                    .all(|numbers| numbers.into_iter().eq(0..100_000))
            );
        }
    }

    #[test]
    #[cfg_attr(debug_assertions, should_panic(expected = "slices have one entry"))]
    fn slices_longer_than_the_layer_are_a_bug() {
        let layer = Region::triangle(9).unwrap();
        let mut numbers = [(); 3].map(|()| alloc::vec![0; 46]);
        let slices = numbers.each_mut().map(Vec::as_mut_slice);
        let filled = fill_rows(&layer, 5, slices, |_, _| Ok(()));
        assert!(matches!(filled, Err(Error::Bug { .. })));
    }

    /// An error in any row is returned.
    #[test]
    fn an_error_of_any_part_is_returned() {
        let layer = Region::triangle(9).unwrap();
        for parts in 1..6 {
            let rows = *layer.y().start()..layer.y().end() + 1;
            let mut numbers = [(); 3].map(|()| alloc::vec![0; 45]);
            for last in rows.clone() {
                let slices = numbers.each_mut().map(Vec::as_mut_slice);
                let write = |row: &Row, _: [&mut [i32]; 3]| {
                    let written = (row.j != last).then_some(());
                    written.ok_or(Error::Interrupted)
                };
                let filled = fill_parts(parts, (&layer, 5), rows.clone(), slices, &write);
                assert_eq!(filled, Err(Error::Interrupted), "{parts}");
            }
        }
    }
}
