//! Symmetries of a pile of equal spheres under one sphere: permutations of the three contact directions.
//!
//! Example: four layers have 30 balance equations. The bottom sphere on the axis is fixed by all six permutations.
//! Equations that are images of each other form an orbit, and one variable for each orbit suffices: 7 equations
//! remain.

use std::collections::HashMap;

use cannonpile::engine::bug;
use cannonpile::lattice::{Dimension, Direction, Region, Site};
use cannonpile::shape::{Anchor, Shape};
use cannonpile::{Error, Pile};
use num_rational::BigRational;
use num_traits::Zero;

use crate::exact::{Sparse, place};
use crate::exact_simplex::Program;
use crate::{Each, network::Network};

/// A symmetric shape. Its sites have coordinates n = (o − i − j, i, j), with o the net number of + steps above. A
/// permutation of n maps sites to sites, and contacts to contacts of the permuted directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AxisSymmetry<'p>(&'p Shape);

impl<'p> AxisSymmetry<'p> {
    /// Returns the symmetry of a pile of spheres under one sphere with equal loads; `None` for other piles.
    pub(crate) fn of(pile: &'p Pile) -> Option<Self> {
        let shape = pile.shape();
        let is_symmetric = pile.dimension() == Dimension::Three
            && shape.anchor() == Anchor::Top(Region::SITE)
            && pile.clone().without_horizontal_forces().is_uniform();
        is_symmetric.then_some(Self(shape))
    }

    /// Returns n by direction.
    pub(crate) fn coordinates(self, site: Site) -> [i128; 3] {
        let shift = self.0.shift_from_origin(site.k);
        [shift - site.i - site.j, site.i, site.j]
    }

    fn image(self, site: Site, permutation: [usize; 3]) -> Site {
        let n = self.coordinates(site);
        let [_, i, j] = permutation.each(|from| n[from]);
        Site { i, j, ..site }
    }

    /// Returns the permutations that fix a site. Entry l is the direction that is mapped to direction l.
    fn fixing(self, site: Site) -> impl Iterator<Item = [usize; 3]> {
        PERMUTATIONS
            .into_iter()
            .filter(move |permutation| self.image(site, *permutation) == site)
    }
}

const PERMUTATIONS: [[usize; 3]; 6] = [
    [0, 1, 2],
    [0, 2, 1],
    [1, 0, 2],
    [1, 2, 0],
    [2, 0, 1],
    [2, 1, 0],
];

/// The orbits of equations and unknowns under the permutations that fix a bottom sphere.
pub(crate) struct Orbits {
    /// The orbits of the equations.
    equations: Grouping,
    /// The orbits of the unknowns.
    unknowns: Grouping,
}

/// A partition into orbits: the orbit of each member, and for each orbit its first member and its size.
struct Grouping {
    orbits: Vec<usize>,
    first: Vec<usize>,
    sizes: Vec<u32>,
}

impl Orbits {
    /// Returns the orbits, or `None` if only the identity fixes the sphere.
    ///
    /// # Errors
    /// [`Error::Bug`] if an image is not in the network.
    pub(crate) fn of(network: &Network<'_>, site: Site) -> Result<Option<Self>, Error> {
        let Some(symmetry) = AxisSymmetry::of(network.pile) else {
            return Ok(None);
        };
        let permutations: Vec<_> = symmetry.fixing(site).collect();
        if permutations.len() == 1 {
            return Ok(None);
        }
        let equations = network.spheres.iter().flat_map(|sphere| {
            Direction::ALL.each(|direction| {
                let images = permutations.iter().map(|permutation| {
                    // The image of this direction.
                    let to = Direction::ALL
                        .into_iter()
                        .zip(permutation)
                        .find(|(_, from)| **from == direction.index());
                    let (to, _) =
                        to.ok_or_else(|| bug("a permutation contains every direction"))?;
                    network.equation(symmetry.image(*sphere, *permutation), to)
                });
                least(images)
            })
        });
        let sloping: Vec<usize> = equations.collect::<Result<_, _>>()?;
        let mut ends = HashMap::new();
        for (number, contact) in network.contacts.iter().enumerate() {
            ends.insert(sorted(network.ends(*contact)?), sloping.len() + number);
        }
        let horizontal = network.contacts.iter().map(|contact| {
            let pair = network.ends(*contact)?;
            least(permutations.iter().map(|permutation| {
                let image = pair.each(|end| symmetry.image(end, *permutation));
                let image = ends.get(&sorted(image)).copied();
                image.ok_or_else(|| bug("a symmetry maps neighbours to neighbours"))
            }))
        });
        let horizontal: Vec<usize> = horizontal.collect::<Result<_, _>>()?;
        let unknowns = sloping.iter().copied().chain(horizontal);
        Ok(Some(Self {
            unknowns: Grouping::of(unknowns),
            equations: Grouping::of(sloping.iter().copied()),
        }))
    }

    /// Returns the program for solutions that are constant on each orbit. Its minimum is that of the full program:
    /// the average over all images of a minimiser is again a minimiser.
    pub(crate) fn quotient(&self, network: &Network<'_>, cost: &[BigRational]) -> Program<'static> {
        let mut columns = vec![Sparse::new(); self.unknowns.first.len()];
        for (column, orbit) in network.columns.iter().zip(&self.unknowns.orbits) {
            for (equation, coefficient) in column {
                let row = self.equations.orbits[*equation];
                if self.equations.first[row] == *equation {
                    let column = &mut columns[*orbit];
                    match place(column, row) {
                        Ok(entry) => column[entry].1 += coefficient,
                        Err(entry) => column.insert(entry, (row, coefficient.clone())),
                    }
                }
            }
        }
        for column in &mut columns {
            column.retain(|(_, coefficient)| !coefficient.is_zero());
        }
        let mut costs = vec![BigRational::zero(); self.unknowns.first.len()];
        for (cost, orbit) in cost.iter().zip(&self.unknowns.orbits) {
            costs[*orbit] += cost;
        }
        let sums = self.equations.first.iter();
        Program {
            columns: columns.into(),
            sums: sums.map(|first| network.weights[*first].clone()).collect(),
            cost: costs,
        }
    }

    /// Expands a primal solution of the quotient to the full program.
    pub(crate) fn unknowns(&self, of_quotient: &[BigRational]) -> Vec<BigRational> {
        let orbits = self.unknowns.orbits.iter();
        orbits.map(|orbit| of_quotient[*orbit].clone()).collect()
    }

    /// Expands a dual solution of the quotient: each orbit distributes its multiplier equally.
    pub(crate) fn multipliers(&self, of_quotient: &[BigRational]) -> Vec<BigRational> {
        let orbits = self.equations.orbits.iter();
        let share = |orbit: &usize| {
            &of_quotient[*orbit] / BigRational::from_integer(self.equations.sizes[*orbit].into())
        };
        orbits.map(share).collect()
    }
}

impl Grouping {
    /// Builds the partition from the least element of the orbit of each member.
    fn of(least: impl Iterator<Item = usize>) -> Self {
        let (mut orbits, mut first, mut sizes) = (Vec::new(), Vec::new(), Vec::new());
        let mut numbers = HashMap::new();
        for member in least {
            let orbit = *numbers.entry(member).or_insert_with(|| {
                first.push(member);
                sizes.push(0);
                first.len() - 1
            });
            sizes[orbit] += 1;
            orbits.push(orbit);
        }
        Self {
            orbits,
            first,
            sizes,
        }
    }
}

fn sorted([one, other]: [Site; 2]) -> [Site; 2] {
    [one.min(other), one.max(other)]
}

fn least(images: impl Iterator<Item = Result<usize, Error>>) -> Result<usize, Error> {
    let images: Vec<usize> = images.collect::<Result<_, _>>()?;
    let least = images.into_iter().min();
    least.ok_or_else(|| bug("an orbit is not empty"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::MAX_EQUATIONS;

    /// Returns the numbers of equations and unknowns that remain for a bottom sphere of a straight pile of four
    /// layers.
    fn left(i: i128, j: i128) -> Result<Option<[usize; 2]>, Error> {
        let pile = Pile::triangular(4)?;
        let network = Network::above(&pile, 3, MAX_EQUATIONS)?;
        let orbits = Orbits::of(&network, Site { i, j, k: 3 })?;
        Ok(orbits.map(|orbits| [orbits.equations.first.len(), orbits.unknowns.first.len()]))
    }

    #[test]
    fn quotient_sizes_depend_on_sphere() -> Result<(), Error> {
        // Of 30 equations those of one direction per orbit remain: 1 for the top, then 2, then 4. Layer 1 has 2
        // orbits, one for directions to a corner and one for directions to a side. The horizontal contacts have 1
        // orbit in layer 1 and 2 in layer 2.
        assert_eq!(left(1, 1)?, Some([1 + 2 + 4, 1 + 2 + 4 + 1 + 2]));
        assert!(left(3, 0)?.is_some_and(|[equations, _]| equations < 30));
        assert_eq!(left(2, 0)?, None);
        Ok(())
    }

    #[test]
    fn load_off_axis_breaks_symmetry() -> Result<(), Error> {
        let site = Site { i: 1, j: 0, k: 1 };
        let pile = Pile::triangular(4)?.with_load(site, BigRational::from_integer(1.into()))?;
        let network = Network::above(&pile, 3, MAX_EQUATIONS)?;
        assert!(Orbits::of(&network, Site { i: 1, j: 1, k: 3 })?.is_none());
        Ok(())
    }
}
