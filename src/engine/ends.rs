//! Candidate sites for the extremes of the forces in a layer.
//!
//! Along a row the forces are piecewise linear, with few pieces. A linear function of the three forces takes its
//! extremes at the ends of a piece. So does the ratio of shear to normal force. [`paper`](crate::paper#extremes) gives
//! the lemma with its reason. A search therefore visits the ends of the pieces: a few sites for each row, instead of
//! all its spheres.
//!
//! For example, the count of spheres on a line may vary along a row as follows:
//!
//! ```text
//! site     0  1  2  3  4  5  6  7
//! count    1  2  3  3  3  3  2  1
//! ends     x     x        x     x
//! ```

use alloc::vec::Vec;

use num_bigint::BigUint;

use super::lines::{LineForces, start_of};
use crate::Error;
use crate::lattice::Direction;
use crate::scalar::Algebra;
use crate::shape::RunLayers;
use crate::sorted::{Sorted, distinct};

/// The maximum number of ends in an ordinary row: the two ends of the row, and four sites for each of the three lines.
const ENDS_OF_A_ROW: u32 = 14;

impl<T: Algebra> LineForces<'_, T> {
    /// Returns an upper bound of the number of sites that [`ends_of_pieces`](Self::ends_of_pieces) yields.
    pub(crate) fn most_ends_of_pieces(&self, k: i128) -> Result<BigUint, Error> {
        let region = self.shape.layer(k)?;
        let rows = BigUint::from((region.y().end() - region.y().start() + 1).unsigned_abs());
        let starts = match self.shape.run_to(k) {
            Some(run) if run.index > 0 => self.shape.layer(run.from)?.site_count(),
            _ => BigUint::ZERO,
        };
        Ok(rows * ENDS_OF_A_ROW + (starts + self.extra_loads.len()) * 9_u32)
    }

    /// Returns the rows of layer `k`, each with the sites at which a linear piece of the forces ends.
    ///
    /// They include every sphere on a line that begins at a sign change, and its neighbours. They also include every
    /// sphere on a line with an extra weight of the last run, and its neighbours.
    pub(crate) fn ends_of_pieces(
        &self,
        k: i128,
    ) -> Result<impl Iterator<Item = (i128, Vec<[i128; 2]>)> + use<'_, T>, Error> {
        let run = self.shape.run_to(k);
        let special = self.ends_of_extras(k, run);
        let rows = self.shape.layer(k)?.rows(k);
        Ok(rows.map(move |row| {
            let mut ends = Vec::from([row.i.start, row.i.end - 1]);
            if let Some(run) = run {
                let steps = k - run.from;
                let start = row.i.start;
                for count in self.shape.row_counts(&run, k, [start, row.j]) {
                    // A count that does not rise, or does not fall, is level up to that end of the row.
                    let level = (
                        match count.rises {
                            Some(rises) => start - rises + count.cap,
                            None => start,
                        },
                        match count.falls {
                            Some(falls) => start + falls - count.cap,
                            None => row.i.end - 1,
                        },
                    );
                    ends.extend([level.0, level.1]);
                    if let (Some(rises), Some(falls)) = (count.rises, count.falls) {
                        let top = start + (falls - rises).div_euclid(2);
                        ends.extend([top, top + 1]);
                    }
                    if run.index > 0 && count.cap == steps {
                        let within = (level.0 - 1).max(row.i.start)..(level.1 + 2).min(row.i.end);
                        ends.extend(within);
                    }
                }
            }
            ends.extend(special.get(&row.j).into_iter().flatten());
            let inside = distinct(ends).into_iter().filter(|i| row.i.contains(i));
            (row.j, inside.map(|i| [i, row.j]).collect())
        }))
    }

    /// Returns, by row, the sites of layer `k` with an extra weight, or with one above them on a line of the run `run`.
    /// Their neighbours in the row are included.
    fn ends_of_extras(&self, k: i128, run: Option<RunLayers>) -> Sorted<i128, Vec<i128>> {
        let mut rows: Sorted<i128, Vec<i128>> = Sorted::new();
        let mut insert_around = |[i, j]: [i128; 2]| {
            rows.entry(j, Vec::new()).extend([i - 1, i, i + 1]);
        };
        for site in self.extras_in(k..k + 1) {
            insert_around([site.i, site.j]);
        }
        if let Some(run) = run {
            for site in self.extras_in(run.from..k) {
                for direction in Direction::ALL {
                    insert_around(start_of([site.i, site.j], direction, run.sign, site.k - k));
                }
            }
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use num_rational::BigRational;

    use super::*;
    use crate::Pile;
    use crate::engine::{LineSelection, Meter};
    use crate::lattice::{Region, Site};

    /// Returns piles with and without sign changes, with lines of odd and of even length. Each pile has a variant with
    /// a load inside, one with a load near the floor, and one without loads.
    fn piles() -> Vec<Pile> {
        let tops = [
            Region::SITE,
            Region::hexagon(4, 2).unwrap(),
            Region::new(-3..=3, -4..=4, -2..=5).unwrap(),
            Region::triangle(7).unwrap(),
        ];
        let stackings = ["(9)", "-(8)", "(1,8)", "(6,1,5)", "-(2,9)"];
        let mut piles = Vec::new();
        for (n, top) in tops.into_iter().enumerate() {
            for (m, stacking) in stackings.into_iter().enumerate() {
                let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
                let sites: Vec<Site> = pile.shape().sites().collect();
                let load = BigRational::from_integer(100.into());
                let last = pile.clone().with_load(sites[sites.len() - 9], load.clone());
                let inside = sites[sites.len() / (2 + m) + n];
                piles.extend([pile.with_load(inside, load).unwrap(), last.unwrap()]);
                piles.push(Pile::under(top, stacking.parse().unwrap()).unwrap());
            }
        }
        piles
    }

    /// At a site that is not listed, each force is the mean of the forces on its two neighbours. So no end is missing.
    #[test]
    fn forces_are_linear_between_them() {
        let unlisted = check_linearity(piles());
        assert!(unlisted > 1000, "{unlisted}");
    }

    /// Tests lines that end at a surface within the run, on rows of odd and even length.
    #[test]
    fn forces_under_a_few_spheres_are_linear_between_them() {
        let low = Region::new(-3..=3, -4..=4, -2..=5).unwrap();
        let piles = [
            (low, "(9)"),
            (low, "-(1,8)"),
            (Region::triangle(6).unwrap(), "(2,9)"),
        ];
        let pile = |(top, runs): (Region, &str)| Pile::under(top, runs.parse().unwrap()).unwrap();
        let unlisted = check_linearity(piles.into_iter().map(pile));
        assert!(unlisted > 100, "{unlisted}");
    }

    /// Tests bases with a corner cut off. The counts rise and fall before they reach the length of the run. Their
    /// maximum covers one site or two.
    #[test]
    fn forces_on_a_base_are_linear_between_them() {
        let cut = Region::new(0..=12, 0..=18, 9..=18).unwrap();
        let opposite = Region::new(-12..=0, -18..=0, -18..=-9).unwrap();
        let piles = [(cut, "(9)"), (cut, "(1,8)"), (opposite, "-(9)")];
        let pile = |(base, runs): (Region, &str)| Pile::on(base, runs.parse().unwrap()).unwrap();
        let unlisted = check_linearity(piles.into_iter().map(pile));
        assert!(unlisted > 100, "{unlisted}");
    }

    /// In the top layer no line has begun.
    #[test]
    fn a_row_of_the_top_has_its_ends() {
        let pile = Pile::under(Region::triangle(4).unwrap(), "+".parse().unwrap()).unwrap();
        let lines = LineForces::<BigRational>::new(&pile);
        let ends: Vec<_> = lines.ends_of_pieces(0).unwrap().collect();
        let row = |j, ends: &[i128]| (j, ends.iter().map(|i| [*i, j]).collect());
        assert_eq!(
            ends,
            [
                row(0, &[0, 3]),
                row(1, &[0, 2]),
                row(2, &[0, 1]),
                row(3, &[0])
            ]
        );
    }

    /// Returns the number of sites that are not listed. Checks that each has the mean force of its neighbours.
    fn check_linearity(piles: impl IntoIterator<Item = Pile>) -> usize {
        let mut unlisted = 0;
        for pile in piles {
            let lines = LineForces::<BigRational>::new(&pile);
            for k in 1..pile.layers() {
                for (j, ends) in lines.ends_of_pieces(k).unwrap() {
                    let row = pile
                        .shape()
                        .layer(k)
                        .unwrap()
                        .rows(k)
                        .find(|row| row.j == j)
                        .unwrap();
                    let sites: Vec<[i128; 2]> = row.i.map(|i| [i, j]).collect();
                    let forces = lines
                        .forces_above(k, &sites, LineSelection::All, Meter::NONE)
                        .unwrap();
                    for (site, around) in sites.iter().skip(1).zip(forces.windows(3)) {
                        if ends.contains(site) {
                            continue;
                        }
                        unlisted += 1;
                        let [before, here, after] = around else {
                            unreachable!()
                        };
                        let [before, here, after] = [before, here, after].map(|of| &of.forces);
                        for ((a, b), c) in before.iter().zip(here).zip(after) {
                            let stacking = pile.shape().stacking();
                            assert_eq!(a + c, b + b, "{stacking} {site:?} k={k}");
                        }
                    }
                }
            }
        }
        unlisted
    }
}
