//! The symmetries of a pile under one sphere, its spheres all alike: they permute the three directions.

use std::collections::{BTreeMap, HashMap};

use cannonpile::engine::bug;
use cannonpile::lattice::{Dimension, Direction, Region, Site};
use cannonpile::shape::{Anchor, Shape};
use cannonpile::{Error, Pile};
use num_rational::BigRational;
use num_traits::Zero;

use crate::network::{Column, Network};
use crate::program::{Aim, Program};

/// A shape whose sites are n = (o − i − j, i, j), o the net number of + steps above: permuted, they are sites again, and
/// contacts are those of the permuted directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SixFold<'p>(&'p Shape);

impl<'p> SixFold<'p> {
    /// That of a pile of spheres under one sphere, if all bear the same load; `None` of other piles.
    pub(crate) fn of(pile: &'p Pile) -> Option<Self> {
        let shape = pile.shape();
        let is_symmetric = pile.dimension() == Dimension::Three
            && shape.anchor() == Anchor::Top(Region::SITE)
            && pile.clone().without_horizontal_forces().is_uniform();
        is_symmetric.then_some(Self(shape))
    }

    /// n, by direction.
    pub(crate) fn coordinates(self, site: Site) -> [i128; 3] {
        let shift = self.0.shift_from_origin(site.k);
        [shift - site.i - site.j, site.i, site.j]
    }

    fn image(self, site: Site, permutation: [usize; 3]) -> Site {
        let n = self.coordinates(site);
        let [_, i, j] = permutation.map(|from| n[from]);
        Site { i, j, ..site }
    }

    /// The permutations that leave a site where it is: to each direction the one it comes from.
    fn leaving(self, site: Site) -> impl Iterator<Item = [usize; 3]> {
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

/// Equations and unknowns of a network that are images of each other where a bottom sphere stays where it is.
pub(crate) struct Orbits {
    /// By equation.
    equations: Grouping,
    /// By unknown.
    unknowns: Grouping,
}

/// Numbers of orbits, by member; the first member of each and how many it has.
struct Grouping {
    orbits: Vec<usize>,
    first: Vec<usize>,
    sizes: Vec<u32>,
}

impl Orbits {
    /// `None` if nothing but the identity leaves the sphere where it is.
    ///
    /// # Errors
    /// [`Error::Bug`] if an image is not in the network.
    pub(crate) fn of(network: &Network<'_>, site: Site) -> Result<Option<Self>, Error> {
        let Some(six_fold) = SixFold::of(network.pile) else {
            return Ok(None);
        };
        let permutations: Vec<_> = six_fold.leaving(site).collect();
        if permutations.len() == 1 {
            return Ok(None);
        }
        let equations = network.spheres.iter().flat_map(|sphere| {
            Direction::ALL.map(|direction| {
                let images = permutations.iter().map(|permutation| {
                    // Where this direction goes.
                    let to = Direction::ALL
                        .into_iter()
                        .zip(permutation)
                        .find(|(_, from)| **from == direction.index());
                    let (to, _) = to.ok_or_else(|| bug("a permutation has every direction"))?;
                    network.equation(six_fold.image(*sphere, *permutation), to)
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
                let image = pair.map(|end| six_fold.image(end, *permutation));
                let image = ends.get(&sorted(image)).copied();
                image.ok_or_else(|| bug("images of neighbours are neighbours"))
            }))
        });
        let horizontal: Vec<usize> = horizontal.collect::<Result<_, _>>()?;
        let unknowns = sloping.iter().copied().chain(horizontal);
        Ok(Some(Self {
            unknowns: Grouping::of(unknowns),
            equations: Grouping::of(sloping.iter().copied()),
        }))
    }

    /// The program of what is the same throughout each orbit: its minimum is that of the whole, since the mean of the
    /// images of a minimum is one.
    pub(crate) fn quotient(&self, network: &Network<'_>, cost: &[BigRational]) -> Program<'static> {
        let mut columns = vec![BTreeMap::new(); self.unknowns.first.len()];
        for (column, orbit) in network.columns.iter().zip(&self.unknowns.orbits) {
            for (equation, coefficient) in column {
                let row = self.equations.orbits[*equation];
                if self.equations.first[row] == *equation {
                    *columns[*orbit].entry(row).or_insert_with(BigRational::zero) += coefficient;
                }
            }
        }
        let columns = columns.into_iter().map(|column| {
            let column = column.into_iter();
            column.filter(|(_, c)| !c.is_zero()).collect::<Column>()
        });
        let mut costs = vec![BigRational::zero(); self.unknowns.first.len()];
        for (cost, orbit) in cost.iter().zip(&self.unknowns.orbits) {
            costs[*orbit] += cost;
        }
        let sums = self.equations.first.iter();
        Program {
            columns: columns.collect(),
            sums: sums.map(|first| network.weights[*first].clone()).collect(),
            aim: Aim::Cost(costs),
        }
    }

    /// The unknowns of the whole, of those of the quotient.
    pub(crate) fn unknowns(&self, of_quotient: &[BigRational]) -> Vec<BigRational> {
        let orbits = self.unknowns.orbits.iter();
        orbits.map(|orbit| of_quotient[*orbit].clone()).collect()
    }

    /// The multipliers of the whole: an orbit shares its own evenly.
    pub(crate) fn multipliers(&self, of_quotient: &[BigRational]) -> Vec<BigRational> {
        let orbits = self.equations.orbits.iter();
        let share = |orbit: &usize| {
            &of_quotient[*orbit] / BigRational::from_integer(self.equations.sizes[*orbit].into())
        };
        orbits.map(share).collect()
    }
}

impl Grouping {
    /// Of members, each with the least of its orbit.
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
    least.ok_or_else(|| bug("a sphere is an image of itself"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::network::MOST_EQUATIONS;

    /// How many equations and unknowns are left of a straight pile of four layers, on a bottom sphere.
    fn left(i: i128, j: i128) -> Result<Option<[usize; 2]>, Error> {
        let pile = Pile::triangular(4)?;
        let network = Network::above(&pile, 3, MOST_EQUATIONS)?;
        let orbits = Orbits::of(&network, Site { i, j, k: 3 })?;
        Ok(orbits.map(|orbits| [orbits.equations.first.len(), orbits.unknowns.first.len()]))
    }

    #[test]
    fn a_sixth_is_left_under_the_apex_and_all_off_the_planes_of_symmetry() -> Result<(), Error> {
        // Of 30 equations, the first of each layer: one direction of one sphere, then those of (1,0,0) that lead to a corner
        // and to a side, then of (2,0,0) and (1,1,0); of 12 horizontal contacts, one and two.
        assert_eq!(left(1, 1)?, Some([1 + 2 + 4, 1 + 2 + 4 + 1 + 2]));
        assert!(left(3, 0)?.is_some_and(|[equations, _]| equations < 30));
        assert_eq!(left(2, 0)?, None);
        Ok(())
    }

    #[test]
    fn a_load_off_the_axis_leaves_no_symmetry() -> Result<(), Error> {
        let site = Site { i: 1, j: 0, k: 1 };
        let pile = Pile::triangular(4)?.with_load(site, BigRational::from_integer(1.into()))?;
        let network = Network::above(&pile, 3, MOST_EQUATIONS)?;
        assert!(Orbits::of(&network, Site { i: 1, j: 1, k: 3 })?.is_none());
        Ok(())
    }
}
