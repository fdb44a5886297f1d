//! The forces above spheres, from the lines that lead to them.

use alloc::vec::Vec;

use num_traits::{One, Zero};

use super::interrupt::check as check_interrupt;
use super::lines::{Lines, start_of};
use crate::Error;
use crate::error::{bug, refuse_beyond_memory};
use crate::formula;
use crate::lattice::{Direction, Site};
use crate::scalar::Algebra;
use crate::shape::{Shape, Stretch};

/// The most nodes of a tree that are visited for one row.
pub(crate) const MAX_NODES: usize = 4_000_000;

/// Of so many it is not asked whether they fit in memory.
const FEW_NODES: usize = 10_000;

/// Its site, in lists that grow by doubling, and what three numerators of the level below it take.
const BYTES_A_NODE: usize = 256;

/// The forces from above on some spheres of one layer, as numerators.
pub(crate) struct Above<T: Algebra> {
    /// By site, in the order of the question.
    pub(crate) forces: Vec<[T::Numerator; 3]>,
    /// The changes of sign before: the denominator is [`Lines::scale`] of it.
    pub(crate) changes: usize,
    /// The spheres at changes of sign that they depend on.
    pub(crate) nodes: usize,
}

/// Spheres of one layer whose forces from above are needed, in order and each once.
struct Level {
    stretch: Stretch,
    k: i128,
    sites: Vec<[i128; 2]>,
    /// On which of their lines.
    wanted: Wanted,
}

/// The lines of a sphere that an answer needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    One(Direction),
    All,
}

impl Wanted {
    /// What a contact below a sphere needs: its line, or all three where they are mixed by a change of sign.
    pub(crate) fn for_contact(shape: &Shape, site: Site, direction: Direction) -> Self {
        if shape.stacking().is_straight() {
            return Self::One(direction);
        }
        let sign = shape.sign_below(site.k);
        if site.k > 0 && sign != shape.sign_below(site.k - 1) {
            Self::All
        } else {
            Self::One(direction)
        }
    }

    pub(super) fn includes(self, direction: Direction) -> bool {
        self == Self::All || self == Self::One(direction)
    }
}

/// Errors if the forces above these spheres depend on too many others.
pub(crate) fn check_tree(shape: &Shape, k: i128, sites: &[[i128; 2]]) -> Result<(), Error> {
    levels(shape, k, sites, Wanted::All).map(|_| ())
}

/// Returns how many spheres at changes of sign the force of a contact depends on.
pub(crate) fn nodes(shape: &Shape, site: Site, direction: Direction) -> Result<usize, Error> {
    let wanted = Wanted::for_contact(shape, site, direction);
    let levels = levels(shape, site.k, &[[site.i, site.j]], wanted)?;
    let above: usize = levels.iter().skip(1).map(|level| level.sites.len()).sum();
    Ok(above + usize::from(wanted == Wanted::All))
}

/// Returns the levels of the tree above some spheres, from the question up.
fn levels(
    shape: &Shape,
    k: i128,
    sites: &[[i128; 2]],
    wanted: Wanted,
) -> Result<Vec<Level>, Error> {
    let mut levels = Vec::new();
    let (mut k, mut sites, mut wanted) = (k, sites.to_vec(), wanted);
    let mut nodes = 0;
    while let (Some(stretch), false) = (shape.stretch_to(k), sites.is_empty()) {
        check_interrupt()?;
        sites.sort_unstable();
        sites.dedup();
        nodes += sites.len();
        if nodes > FEW_NODES {
            refuse_beyond_memory(
                "the forces on spheres this far below so many changes of sign",
                &nodes.into(),
                (MAX_NODES as u64, BYTES_A_NODE),
                "ask for fewer layers or spheres",
            )?;
        }
        let mut starts = Vec::new();
        if stretch.index > 0 {
            for site in &sites {
                let counts = shape.spheres_above(&stretch, k, *site);
                for (direction, count) in Direction::ALL.into_iter().zip(counts) {
                    if count == k - stretch.from && wanted.includes(direction) {
                        starts.push(start_of(*site, direction, stretch.sign, count));
                    }
                }
            }
        }
        levels.push(Level {
            stretch,
            k,
            sites,
            wanted,
        });
        (k, sites, wanted) = (stretch.from, starts, Wanted::All);
    }
    Ok(levels)
}

impl<T: Algebra> Lines<'_, T> {
    /// The forces from above on spheres of layer `k`, whose sites the caller has checked; zero on lines not wanted.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if the lines above pass more than 4 million spheres at changes of sign.
    pub(crate) fn forces_above(
        &self,
        k: i128,
        sites: &[[i128; 2]],
        wanted: Wanted,
    ) -> Result<Above<T>, Error> {
        let levels = levels(self.shape, k, sites, wanted)?;
        let nodes = levels.iter().skip(1).map(|level| level.sites.len()).sum();
        let mut levels = levels.into_iter().rev();
        let Some(first) = levels.next() else {
            let none = || core::array::from_fn(|_| T::Numerator::zero());
            let forces = sites.iter().map(|_| none()).collect();
            return Ok(Above {
                forces,
                changes: 0,
                nodes: 0,
            });
        };
        let mut forces = self.received(&first, &[], &[])?;
        let mut level = first;
        for next in levels {
            let turned: Vec<_> = forces.iter().map(formula::half_turn::<T>).collect();
            forces = self.received(&next, &level.sites, &turned)?;
            level = next;
        }
        let of_site = |site: &[i128; 2]| {
            let place = level.sites.binary_search(site).ok();
            let force = place.and_then(|place| forces.get(place)).cloned();
            force.ok_or_else(|| bug("the last level of a tree has every sphere asked for"))
        };
        Ok(Above {
            forces: sites.iter().map(of_site).collect::<Result<_, _>>()?,
            changes: level.stretch.index,
            nodes,
        })
    }

    /// Returns the forces from above on the spheres of a level, from what the spheres `starts` at the change of sign above
    /// receive, turned.
    fn received(
        &self,
        level: &Level,
        starts: &[[i128; 2]],
        turned: &[[T::Numerator; 3]],
    ) -> Result<Vec<[T::Numerator; 3]>, Error> {
        let (run, k) = (level.stretch, level.k);
        let unit = self.scaled(T::Numerator::one(), run.index);
        let mut forces = Vec::with_capacity(level.sites.len());
        for site in &level.sites {
            check_interrupt()?;
            let counts = self.shape.spheres_above(&run, k, *site);
            let mut force = core::array::from_fn(|_| T::Numerator::zero());
            for direction in Direction::ALL {
                if !level.wanted.includes(direction) {
                    continue;
                }
                let n = counts[direction.index()];
                let counted = self.counted(run, k, *site, direction, n) * &unit;
                // A line that begins at a change of sign carries on what is turned there.
                let begins_at_change = run.index > 0 && n == k - run.from;
                force[direction.index()] = if begins_at_change {
                    let start = start_of(*site, direction, run.sign, n);
                    let place = starts.binary_search(&start).ok();
                    let carried = place.and_then(|place| turned.get(place));
                    let carried = carried
                        .ok_or_else(|| bug("a line that crosses a change of sign starts there"))?;
                    formula::transmitted(carried[direction.index()].clone(), &counted)
                } else {
                    counted
                };
            }
            forces.push(force);
        }
        Ok(forces)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pile;
    use crate::lattice::Region;

    /// Under a row of n spheres n + 1 of the next layer.
    #[test]
    fn a_tree_has_four_million_nodes_at_most() {
        let most = 4_000_000;
        let row = Region::new(0..=most, 0..=0, 0..=most).unwrap();
        let pile = Pile::under(row, "+".parse().unwrap()).unwrap();
        let mut sites: Vec<[i128; 2]> = (0..=most).map(|i| [i, 0]).collect();
        let refused = check_tree(pile.shape(), 1, &sites);
        assert!(matches!(
            refused,
            Err(Error::TooLarge { needed, limit: 4_000_000, .. }) if needed == 4_000_001_u32.into()
        ));
        sites.pop();
        assert_eq!(check_tree(pile.shape(), 1, &sites), Ok(()));
    }
}
