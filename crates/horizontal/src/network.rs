//! A pile at a = R as a system of equations.

use std::collections::HashMap;

use cannonpile::engine::{bug, refuse_beyond_memory};
use cannonpile::formula::{pushed, tripled_half_turn};
use cannonpile::lattice::{Direction, HorizontalContact, Site};
use cannonpile::{Error, Pile};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, Zero};

/// The most equations, three for each sphere off the floor, of which a program is solved: 31 layers under one sphere.
pub(crate) const MOST_EQUATIONS: u64 = 15_000;

/// What a program takes for an equation, its factors above all: 118 MB for the 14,880 of 31 layers, where no symmetry helps.
const BYTES_AN_EQUATION: usize = 8_000;

/// The most spheres of a pile whose certificate has numbers for all of them, where fewer would do.
pub(crate) const MOST_CERTIFIED: u32 = 100_000;

/// The coefficients of an unknown force, by equation.
pub(crate) type Column = Vec<(usize, BigRational)>;

/// The equations of balance: one for each sphere off the floor and each direction, numbered so; the unknowns are
/// the sloping forces in the same order, and then the horizontal ones.
pub(crate) struct Network<'p> {
    pub(crate) pile: &'p Pile,
    /// The spheres above `floor`.
    pub(crate) spheres: Vec<Site>,
    pub(crate) contacts: Vec<HorizontalContact>,
    pub(crate) columns: Vec<Column>,
    /// What each sphere adds to its lines, by equation.
    pub(crate) weights: Vec<BigRational>,
    numbers: HashMap<Site, usize>,
    /// The layer that holds what rests on it.
    floor: i128,
}

impl<'p> Network<'p> {
    /// The spheres above layer `floor`, which is taken to be held: the floor of the pile, or a layer above it; of so many
    /// equations at most.
    ///
    /// # Errors
    /// [`Error::NoHorizontalContacts`]; [`Error::TooLarge`].
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
            let weight = pile.total_load(*site);
            weights.extend(directions.iter().map(|_| weight.clone()));
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

    /// Whether a program over it is solved.
    pub(crate) fn check_size(&self) -> Result<(), Error> {
        fits(&self.weights.len().into(), MOST_EQUATIONS)
    }

    fn all_columns(&self) -> Result<Vec<Column>, Error> {
        let directions = self.pile.dimension().directions();
        let mut columns = Vec::with_capacity(self.weights.len() + self.contacts.len());
        for site in &self.spheres {
            for direction in directions {
                let mut column = vec![(self.equation(*site, *direction)?, BigRational::one())];
                if let Some(support) = self.support(*site, *direction) {
                    // f enters the balance of the support as what T makes of it.
                    let passed = self.transferred(support.k, *direction);
                    for (to, share) in directions.iter().zip(passed) {
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
            let sign = sign.ok_or_else(|| bug("a step leads from every layer above the floor"))?;
            let sigma = BigRational::from_integer(sign.factor().into());
            let (ends, mut column) = (contact.axis.ends(), Vec::new());
            for (sphere, leads_away) in [(sphere, true), (neighbour, false)] {
                let entries = pushed(&sigma, ends, leads_away);
                for end in ends {
                    let entry = entries[end.index()].clone();
                    column.push((self.equation(sphere, end)?, entry));
                }
            }
            columns.push(column);
        }
        Ok(columns)
    }

    /// The support of a sphere, if it is not held.
    fn support(&self, site: Site, direction: Direction) -> Option<Site> {
        let support = self.pile.shape().below(site, direction);
        support.filter(|support| support.k < self.floor)
    }

    /// The number of an equation, and of the sloping force in its direction.
    pub(crate) fn equation(&self, site: Site, direction: Direction) -> Result<usize, Error> {
        let sphere = self.numbers.get(&site);
        let sphere = sphere.ok_or_else(|| bug("a sphere of the network has a number"))?;
        Ok(sphere * self.pile.dimension().directions().len() + direction.index())
    }

    /// The two spheres of a horizontal contact.
    pub(crate) fn ends(&self, contact: HorizontalContact) -> Result<[Site; 2], Error> {
        Ok([contact.site, self.pile.shape().neighbour(contact)?])
    }

    /// T of layer k, of a unit force in a direction.
    fn transferred(&self, k: i128, direction: Direction) -> [BigRational; 3] {
        let mut unit: [BigRational; 3] = core::array::from_fn(|_| BigRational::zero());
        unit[direction.index()] = BigRational::one();
        let shape = self.pile.shape();
        if shape.sign_below(k - 1) == shape.sign_below(k) {
            unit
        } else {
            tripled_half_turn(&unit).map(|tripled| tripled / BigRational::from_integer(3.into()))
        }
    }

    /// The unknowns of the forces on a bottom sphere.
    pub(crate) fn onto(&self, site: Site) -> Result<Vec<usize>, Error> {
        let directions = self.pile.dimension().directions();
        let above = directions.iter().filter_map(|direction| {
            let above = self.pile.shape().above(site, *direction)?;
            Some(self.equation(above, *direction))
        });
        above.collect()
    }

    /// The sloping forces for these sums of the equations, without horizontal ones: from the top, since an equation has one
    /// that is in none before it.
    pub(crate) fn sloping(&self, mut sums: Vec<BigRational>) -> Vec<BigRational> {
        for unknown in 0..sums.len() {
            let force = sums[unknown].clone();
            for (equation, coefficient) in self.columns[unknown].iter().skip(1) {
                sums[*equation] -= coefficient * &force;
            }
        }
        sums
    }

    /// The field with these drops, from below.
    pub(crate) fn field_of(&self, mut drops: Vec<BigRational>) -> Vec<BigRational> {
        for unknown in (0..drops.len()).rev() {
            for (equation, coefficient) in self.columns[unknown].iter().skip(1) {
                let further = coefficient * &drops[*equation];
                drops[unknown] -= further;
            }
        }
        drops
    }

    /// The horizontal forces that are not zero.
    pub(crate) fn horizontal(
        &self,
        unknowns: &[BigRational],
    ) -> impl Iterator<Item = (HorizontalContact, BigRational)> {
        let forces = unknowns.iter().skip(self.weights.len());
        let bearing = self
            .contacts
            .iter()
            .zip(forces)
            .filter(|(_, force)| !force.is_zero());
        bearing.map(|(contact, force)| (*contact, force.clone()))
    }

    /// The field by sphere, where it is not zero.
    pub(crate) fn field(
        &self,
        multipliers: &[BigRational],
    ) -> impl Iterator<Item = (Site, [BigRational; 3])> {
        let by_sphere = self.by_sphere(multipliers);
        by_sphere.filter(|(_, field)| field.iter().any(|number| !number.is_zero()))
    }

    /// Numbers of sloping contacts or equations, by sphere.
    pub(crate) fn by_sphere(
        &self,
        numbers: &[BigRational],
    ) -> impl Iterator<Item = (Site, [BigRational; 3])> {
        let directions = self.pile.dimension().directions().len();
        let spheres = self.spheres.iter().zip(numbers.chunks(directions));
        spheres.map(|(site, numbers)| {
            // Not a default: discs have no third direction.
            let number = |l: usize| numbers.get(l).cloned().unwrap_or_else(BigRational::zero);
            (*site, [number(0), number(1), number(2)])
        })
    }
}

fn fits(equations: &BigUint, limit: u64) -> Result<(), Error> {
    refuse_beyond_memory(
        "a program over all contacts",
        equations,
        (limit, BYTES_AN_EQUATION),
        "ask for a smaller pile",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three equations for each of 1 + 3 + 6 spheres, two for each of 1 + 2 + 3 discs.
    #[test]
    fn as_many_equations_as_are_allowed() {
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
