//! The balance equations of a pile at a = R, as a sparse linear system.
//!
//! Example: three layers of discs have three discs above the floor and two directions, hence six equations. The
//! unknowns are six forces of sloping contacts and one horizontal force. The degree of static indeterminacy is the
//! number of horizontal forces, here 1.

use crate::Each;
use std::collections::{BTreeMap, HashMap};

use cannonpile::engine::{bug, refuse_beyond_memory};
use cannonpile::formula::{pushed, tripled_half_turn};
use cannonpile::lattice::{Direction, HorizontalContact, Site};
use cannonpile::{Error, Pile};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::exact::{Sparse, place};

/// The maximum number of equations of a program that is solved: 31 layers under one sphere have 14,880.
pub(crate) const MAX_EQUATIONS: u64 = 15_000;

/// The memory of a program for each equation, mainly for its factors: 118 MB for 14,880 equations without symmetry.
const BYTES_AN_EQUATION: usize = 8_000;

/// The maximum number of spheres in a certificate that lists all of them, if a shorter proof exists.
pub(crate) const MAX_CERTIFIED: u32 = 100_000;

/// The balance equations: one for each sphere above the floor and each direction.
///
/// The unknowns are the sloping forces, numbered like the equations, and then the horizontal forces.
pub(crate) struct Network<'p> {
    pub(crate) pile: &'p Pile,
    /// The spheres above `floor`.
    pub(crate) spheres: Vec<Site>,
    pub(crate) contacts: Vec<HorizontalContact>,
    /// The coefficients of each unknown, by equation.
    pub(crate) columns: Vec<Sparse>,
    /// The weight and load of each sphere, for each of its equations.
    pub(crate) weights: Vec<BigRational>,
    numbers: HashMap<Site, usize>,
    /// The layer whose spheres are fixed.
    floor: i128,
}

impl<'p> Network<'p> {
    /// Returns the equations of the spheres above layer `floor`. The spheres of layer `floor` are fixed. This layer is
    /// the floor of the pile, or a layer above it.
    ///
    /// # Errors
    /// [`Error::NoHorizontalContacts`], and [`Error::TooLarge`] for more than `most` equations.
    pub(crate) fn above(pile: &'p Pile, floor: i128, most: u64) -> Result<Self, Error> {
        pile.check_horizontal()?;
        let directions = pile.dimension().directions();
        let mut equations = BigUint::zero();
        for k in 0..floor {
            equations += pile.shape().layer(k)?.site_count() * pile.dimension().number();
            fits(&equations, most)?;
        }
        let spheres: Vec<Site> = pile
            .shape()
            .sites()
            .take_while(|site| site.k < floor)
            .collect();
        let numbers: HashMap<Site, usize> = spheres.iter().copied().zip(0..).collect();
        let contacts = spheres.iter();
        let contacts = contacts.flat_map(|site| pile.shape().horizontal_contacts(*site));
        let contacts: Vec<_> = contacts.collect();
        let mut weights = Vec::with_capacity(spheres.len() * directions.len());
        for site in &spheres {
            let own = pile.own_increments(*site);
            weights.extend(own.into_iter().take(directions.len()));
        }
        let mut network = Self {
            pile,
            spheres,
            contacts,
            columns: Vec::new(),
            weights,
            numbers,
            floor,
        };
        network.columns = network.all_columns()?;
        Ok(network)
    }

    /// Checks that a program with these equations is small enough to be solved.
    pub(crate) fn check_size(&self) -> Result<(), Error> {
        fits(&self.weights.len().into(), MAX_EQUATIONS)
    }

    fn all_columns(&self) -> Result<Vec<Sparse>, Error> {
        let directions = self.pile.dimension().directions();
        let mut columns = Vec::with_capacity(self.weights.len() + self.contacts.len());
        for site in &self.spheres {
            for direction in directions {
                let mut column = vec![(self.equation(*site, *direction)?, BigRational::one())];
                if let Some(support) = self.support(*site, *direction) {
                    // f enters the balance of the sphere below after the transfer T.
                    let transfer = self.transferred(support.k, *direction);
                    for (to, share) in directions.iter().zip(transfer) {
                        if !share.is_zero() {
                            column.push((self.equation(support, *to)?, -share));
                        }
                    }
                }
                columns.push(column);
            }
        }
        for contact in &self.contacts {
            let [sphere, neighbour] = self.ends(*contact)?;
            let sign = self.pile.shape().sign_below(contact.site.k);
            let sign =
                sign.ok_or_else(|| bug("every layer above the floor has a step below it"))?;
            let sigma = BigRational::from_integer(sign.factor().into());
            let (ends, mut column) = (contact.axis.ends(), Sparse::new());
            for (sphere, leads_away) in [(sphere, true), (neighbour, false)] {
                let entries = pushed(&sigma, ends, leads_away);
                for end in ends {
                    let entry = entries[end.index()].clone();
                    let equation = self.equation(sphere, end)?;
                    let place = place(&column, equation).unwrap_or_else(|place| place);
                    column.insert(place, (equation, entry));
                }
            }
            columns.push(column);
        }
        Ok(columns)
    }

    /// Returns the sphere below in a direction, unless it is fixed.
    fn support(&self, site: Site, direction: Direction) -> Option<Site> {
        let support = self.pile.shape().below(site, direction);
        support.filter(|support| support.k < self.floor)
    }

    /// Returns the number of an equation. The sloping force in its direction has the same number.
    pub(crate) fn equation(&self, site: Site, direction: Direction) -> Result<usize, Error> {
        let sphere = self.numbers.get(&site);
        let sphere = sphere.ok_or_else(|| bug("a sphere of the network has a number"))?;
        Ok(sphere * self.pile.dimension().directions().len() + direction.index())
    }

    /// Returns the two spheres of a horizontal contact.
    pub(crate) fn ends(&self, contact: HorizontalContact) -> Result<[Site; 2], Error> {
        Ok([contact.site, self.pile.shape().neighbour(contact)?])
    }

    /// Returns T of layer k, applied to a unit force in a direction.
    fn transferred(&self, k: i128, direction: Direction) -> [BigRational; 3] {
        let mut unit: [BigRational; 3] = [(); 3].each(|()| BigRational::zero());
        unit[direction.index()] = BigRational::one();
        let shape = self.pile.shape();
        if shape.sign_below(k - 1) == shape.sign_below(k) {
            unit
        } else {
            tripled_half_turn(&unit).each(|tripled| tripled / BigRational::from_integer(3.into()))
        }
    }

    /// Returns the numbers of the unknown forces on a bottom sphere.
    pub(crate) fn onto(&self, site: Site) -> Result<Vec<usize>, Error> {
        let directions = self.pile.dimension().directions();
        let above = directions.iter().filter_map(|direction| {
            let above = self.pile.shape().above(site, *direction)?;
            Some(self.equation(above, *direction))
        });
        above.collect()
    }

    /// Solves for the sloping forces with given right-hand sides and without horizontal forces.
    ///
    /// The matrix of sloping forces is triangular from the top, so forward substitution suffices.
    pub(crate) fn sloping(&self, mut sums: Vec<BigRational>) -> Vec<BigRational> {
        for unknown in 0..sums.len() {
            let force = sums[unknown].clone();
            for (equation, coefficient) in self.columns[unknown].iter().skip(1) {
                sums[*equation] -= coefficient * &force;
            }
        }
        sums
    }

    /// Returns the field with the given drops, by backward substitution from below: the transposed system.
    pub(crate) fn field_of(&self, mut drops: Vec<BigRational>) -> Vec<BigRational> {
        for unknown in (0..drops.len()).rev() {
            for (equation, coefficient) in self.columns[unknown].iter().skip(1) {
                let further = coefficient * &drops[*equation];
                drops[unknown] -= further;
            }
        }
        drops
    }

    /// Returns the horizontal forces that are not zero.
    pub(crate) fn horizontal(
        &self,
        unknowns: &[BigRational],
    ) -> BTreeMap<HorizontalContact, BigRational> {
        let mut bearing = BTreeMap::new();
        for (contact, force) in self.contacts.iter().zip(&unknowns[self.weights.len()..]) {
            if !force.is_zero() {
                bearing.insert(*contact, force.clone());
            }
        }
        bearing
    }

    /// Returns the field by sphere, where it is not zero.
    pub(crate) fn field(&self, multipliers: &[BigRational]) -> BTreeMap<Site, [BigRational; 3]> {
        let directions = self.pile.dimension().directions().len();
        let mut field = BTreeMap::new();
        for (site, numbers) in self.spheres.iter().zip(multipliers.chunks(directions)) {
            if numbers.iter().any(|number| !number.is_zero()) {
                // Discs have no third direction, so its value is zero.
                let number = |l: usize| numbers.get(l).cloned().unwrap_or_else(BigRational::zero);
                field.insert(*site, [number(0), number(1), number(2)]);
            }
        }
        field
    }
}

fn fits(equations: &BigUint, limit: u64) -> Result<(), Error> {
    refuse_beyond_memory(
        "a program over all contacts",
        equations,
        (limit, BYTES_AN_EQUATION),
        "use a smaller pile",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three equations for each of 1 + 3 + 6 spheres, two for each of 1 + 2 + 3 discs.
    #[test]
    fn equation_count_is_limited() {
        for (pile, equations) in [(Pile::triangular(4), 30), (Pile::discs(4), 12)] {
            let pile = pile.unwrap();
            let network = Network::above(&pile, 3, equations).unwrap();
            assert_eq!(u64::try_from(network.weights.len()), Ok(equations));
            let refused = Network::above(&pile, 3, equations - 1).err();
            assert!(matches!(refused, Some(Error::TooLarge { .. })));
        }
        let tall = Pile::triangular(33).unwrap();
        let sized = |floor| Network::above(&tall, floor, 100_000).unwrap().check_size();
        assert_eq!(sized(30), Ok(()));
        assert!(matches!(sized(31), Err(Error::TooLarge { .. })));
    }
}
