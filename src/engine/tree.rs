//! The methods by lines: *closed*, and *tree*, a memoised recursion on the dependency cone of a sphere.
//!
//! Without a sign change above, the force on a line is the increment of its direction times the number of spheres above
//! on the line: (8) and (9) of the paper. Each load on the line adds one term. So a force takes O(1) operations,
//! whatever the height: *closed* is a tree without levels.
//!
//! Below sign changes a force depends on few other forces. Within a run the force on a line grows linearly with a count
//! of spheres, so the recursion skips the run. It continues only where a line crosses a sign change. At the change it
//! needs the three forces on the sphere there, so a node may need three nodes of the next level.
//!
//! Plain recursion would visit 3^d nodes below d sign changes. But many branches end at the same sphere. Let the sign
//! change in every layer, and take a sphere at (0, 0):
//!
//! ```text
//! one sign change above       (0,0) (−1,0) (0,−1)
//! two above, 9 branches       (0,0) three times, (1,0) (0,1) (−1,0) (−1,1) (0,−1) (1,−1)
//! ```
//!
//! The 9 branches end at 7 spheres. In general a level has at most as many nodes as its layer has spheres.
//!
//! So the recursion is evaluated by levels. A level is a list of distinct sites, sorted. The lists are built upwards
//! from the question, and the forces are computed downwards again. The call stack does not grow. The cost depends on
//! the sign changes, not on the layers between them.

use alloc::vec::Vec;

use num_traits::Zero;

use super::interrupt::check as check_interrupt;
use super::lines::{LineForces, SphereForces, start_of};
use super::meter::Meter;
use crate::Error;
use crate::each::Each;
use crate::error::{bug, refuse_beyond_memory};
use crate::formula;
use crate::lattice::{Direction, Site};
use crate::scalar::Algebra;
use crate::shape::{RunLayers, Shape};
use crate::sorted::distinct;

/// The maximum number of nodes in a tree.
pub(crate) const MAX_NODES: usize = 4_000_000;

/// Up to this number of nodes, the memory limit is not checked.
const FEW_NODES: usize = 10_000;

/// The bytes for each node: its site, in a list that grows by doubling, and three numerators of the level below it.
const BYTES_A_NODE: usize = 256;

/// A level of a tree: spheres of one layer whose forces from above are needed, sorted and distinct.
struct Level {
    run: RunLayers,
    k: i128,
    sites: Vec<[i128; 2]>,
    /// The lines whose forces are needed.
    wanted: LineSelection,
}

/// The lines of a sphere that an answer needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LineSelection {
    One(Direction),
    All,
}

impl LineSelection {
    fn includes(self, direction: Direction) -> bool {
        self == Self::All || self == Self::One(direction)
    }
}

/// Returns the number of spheres at sign changes on which the forces on these spheres depend.
///
/// # Errors
/// [`Error::TooLarge`] for more than 4 million.
pub(crate) fn size_of_tree(shape: &Shape, k: i128, sites: &[[i128; 2]]) -> Result<usize, Error> {
    levels(shape, k, sites, LineSelection::All).map(|levels| nodes_above(&levels))
}

/// Returns the number of nodes above the spheres of the question.
fn nodes_above(levels: &[Level]) -> usize {
    levels.iter().skip(1).map(|level| level.sites.len()).sum()
}

/// Returns the levels of the tree of some spheres, from the question upwards.
fn levels(
    shape: &Shape,
    k: i128,
    sites: &[[i128; 2]],
    wanted: LineSelection,
) -> Result<Vec<Level>, Error> {
    let mut levels = Vec::new();
    let (mut k, mut sites, mut wanted) = (k, sites.to_vec(), wanted);
    let mut nodes = 0;
    while let (Some(run), false) = (shape.run_to(k), sites.is_empty()) {
        check_interrupt()?;
        sites = distinct(sites);
        nodes += sites.len();
        if nodes > FEW_NODES {
            refuse_beyond_memory(
                "the forces on spheres this far below so many sign changes",
                &nodes.into(),
                (MAX_NODES as u64, BYTES_A_NODE),
                "ask for fewer layers or spheres",
            )?;
        }
        // Lines of one direction start at sorted places.
        let mut starts = [(); 3].each(|()| Vec::new());
        if run.index > 0 {
            for site in &sites {
                let counts = shape.spheres_above(&run, k, *site);
                let lines = Direction::ALL.into_iter().zip(counts).zip(&mut starts);
                for ((direction, count), starts) in lines {
                    if count == k - run.from && wanted.includes(direction) {
                        starts.push(start_of(*site, direction, run.sign, count));
                    }
                }
            }
        }
        levels.push(Level {
            run,
            k,
            sites,
            wanted,
        });
        (k, sites, wanted) = (run.from, starts.concat(), LineSelection::All);
    }
    Ok(levels)
}

impl<T: Algebra> LineForces<'_, T> {
    /// Returns the forces from above on a sphere, and zero on lines outside `wanted`. The caller has checked the site.
    ///
    /// # Errors
    /// As for [`forces_above`](Self::forces_above).
    pub(crate) fn above(
        &self,
        site: Site,
        wanted: LineSelection,
        meter: Meter<'_>,
    ) -> Result<SphereForces<T>, Error> {
        let (k, place) = (site.k, [site.i, site.j]);
        let run = self.shape.run_to(k);
        // Without a sign change above, the tree has no level.
        let forces = match run {
            Some(run) if run.index > 0 => {
                let above = self
                    .forces_above(k, &[place], wanted, meter)?
                    .into_iter()
                    .next();
                return above.ok_or_else(|| bug("a tree above one sphere has its forces"));
            }
            Some(run) => self.on_sphere(&run, site, wanted, None, |_| Ok(T::Numerator::zero()))?,
            None => zeros::<T>(),
        };
        meter.visit(1);
        Ok(SphereForces { forces, changes: 0 })
    }

    /// Returns the forces from above on spheres of layer `k`, and zero on lines outside `wanted`. The caller has
    /// checked the sites.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if the tree has more than 4 million nodes.
    pub(crate) fn forces_above(
        &self,
        k: i128,
        sites: &[[i128; 2]],
        wanted: LineSelection,
        meter: Meter<'_>,
    ) -> Result<Vec<SphereForces<T>>, Error> {
        let levels = levels(self.shape, k, sites, wanted)?;
        let nodes = nodes_above(&levels);
        meter.visit(nodes + sites.len());
        meter.turn(nodes);
        let mut levels = levels.into_iter().rev();
        let Some(mut level) = levels.next() else {
            let none = |_| SphereForces {
                forces: zeros::<T>(),
                changes: 0,
            };
            return Ok(sites.iter().map(none).collect());
        };
        let mut forces = self.on_level(&level, &[], &[])?;
        for next in levels {
            let turned: Vec<_> = forces.iter().map(formula::half_turn::<T>).collect();
            forces = self.on_level(&next, &level.sites, &turned)?;
            level = next;
        }
        let of_site = |site: &[i128; 2]| {
            let place = level.sites.binary_search(site).ok();
            let forces = place.and_then(|place| forces.get(place)).cloned();
            let missing = || bug("the last level of a tree has every sphere asked for");
            Ok(SphereForces {
                forces: forces.ok_or_else(missing)?,
                changes: level.run.index,
            })
        };
        sites.iter().map(of_site).collect()
    }

    /// Returns the forces from above on the spheres of a level. `turned` are the forces on the spheres `starts` at the
    /// sign change above, after the half-turn.
    fn on_level(
        &self,
        level: &Level,
        starts: &[[i128; 2]],
        turned: &[[T::Numerator; 3]],
    ) -> Result<Vec<[T::Numerator; 3]>, Error> {
        let (run, k) = (&level.run, level.k);
        let unit = self.power(run.index);
        let mut forces = Vec::with_capacity(level.sites.len());
        for &[i, j] in &level.sites {
            check_interrupt()?;
            let carried = |direction| {
                let start = start_of([i, j], direction, run.sign, k - run.from);
                let place = starts.binary_search(&start).ok();
                let carried = place.and_then(|place| turned.get(place));
                let carried =
                    carried.ok_or_else(|| bug("a line that crosses a sign change starts there"))?;
                Ok(carried[direction.index()].clone())
            };
            let site = Site { i, j, k };
            forces.push(self.on_sphere(run, site, level.wanted, unit.as_ref(), carried)?);
        }
        Ok(forces)
    }

    /// Returns the forces from above on a sphere below `run`, and zero on lines outside `wanted`. `unit` converts
    /// increments to the denominator below the sign changes. `carried` returns the force with which a line begins at the
    /// sign change above the run.
    fn on_sphere(
        &self,
        run: &RunLayers,
        site: Site,
        wanted: LineSelection,
        unit: Option<&T::Numerator>,
        carried: impl Fn(Direction) -> Result<T::Numerator, Error>,
    ) -> Result<[T::Numerator; 3], Error> {
        let counts = self.shape.spheres_above(run, site.k, [site.i, site.j]);
        let mut forces = zeros::<T>();
        for (direction, force) in Direction::ALL.into_iter().zip(&mut forces) {
            if !wanted.includes(direction) {
                continue;
            }
            let n = counts[direction.index()];
            let counted = self.counted(run, site, direction, n);
            let counted = match unit {
                Some(unit) => counted * unit,
                None => counted,
            };
            *force = if run.index > 0 && n == site.k - run.from {
                formula::transmitted(carried(direction)?, &counted)
            } else {
                counted
            };
        }
        Ok(forces)
    }
}

fn zeros<T: Algebra>() -> [T::Numerator; 3] {
    [(); 3].each(|()| T::Numerator::zero())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pile;
    use crate::lattice::Region;

    /// A row of n spheres has n + 1 supports in the next layer.
    #[test]
    fn a_tree_has_four_million_nodes_at_most() {
        let most = 4_000_000;
        let row = Region::new(0..=most, 0..=0, 0..=most).unwrap();
        let pile = Pile::under(row, "+".parse().unwrap()).unwrap();
        let mut sites: Vec<[i128; 2]> = (0..=most).map(|i| [i, 0]).collect();
        let refused = size_of_tree(pile.shape(), 1, &sites);
        assert!(matches!(
            refused,
            Err(Error::TooLarge { needed, limit: 4_000_000, .. }) if needed == 4_000_001_u32.into()
        ));
        sites.pop();
        assert_eq!(size_of_tree(pile.shape(), 1, &sites), Ok(0));
    }
}
