//! The checker of certificates: balance of each sphere, its transpose, and signs.

use std::collections::BTreeMap;

use cannonpile::engine::{bug, common_multiple, refuse_beyond_memory};
use cannonpile::formula::{beside, increments, pushed, resultant, tripled_half_turn, weight};
use cannonpile::geometry::{Vector, directions, disc_directions};
use cannonpile::lattice::{Axis, Dimension, Direction, HorizontalContact, Sign, Site};
use cannonpile::scalar::ByValue;
use cannonpile::shape::Selection;
use cannonpile::{Error, Pile};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::refusal::Relation;
use super::{AllForces, Certificate, Claim, Condition, Extreme, Refusal};
use crate::{Each, formula};

/// The largest total size of the numbers of one direction, in words of 64 bits.
const MAX_WORDS: u64 = 4_000_000;

/// Three numbers of a sphere, indexed by direction.
type Triple = [BigRational; 3];

impl Certificate {
    /// Checks every equation and inequality of the claim.
    ///
    /// The cost is a few rational operations for each contact of the pile. For [`Claim::CannotStand`] only contacts
    /// near the spheres of the field are checked, so the cost does not depend on the size of the pile.
    ///
    /// # Errors
    /// Returns the first condition that is violated. Returns [`Refusal::Pile`] with [`TooLarge`](Error::TooLarge)
    /// if the numbers would not fit into memory.
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile_horizontal::certificate::Certificate;
    ///
    /// let mut certificate = Certificate::of_forces(&Pile::triangular(4)?)?;
    /// assert_eq!(certificate.check(), Ok(()));
    /// certificate.pile = Pile::triangular(5)?;
    /// let refusal = certificate.check().unwrap_err();
    /// assert_eq!(refusal.to_string(), "the forces of the sphere (0,0,3) are missing");
    /// # Ok::<(), cannonpile_horizontal::Error>(())
    /// ```
    pub fn check(&self) -> Result<(), Refusal> {
        let pile = &self.pile;
        let has_only_forces = matches!(self.claim, Claim::Forces(_)) && self.horizontal.is_empty();
        if !(pile.is_regular() || has_only_forces) {
            let sin_phi = pile.sin_phi();
            let text = format!(
                "the neighbours of a layer touch at a = R only if sin phi is 1/2, not {sin_phi}"
            );
            return Err(Refusal::of(Condition::Pile, &text));
        }
        if let Some((contact, _)) = pile.horizontal_forces().next() {
            let text = format!(
                "the pile itself has a force in the horizontal contact {contact}; move it to the certificate"
            );
            return Err(Refusal::of(Condition::Pile, &text));
        }
        self.fits()?;
        let floor = pile.layers() - 1;
        for (contact, force) in &self.horizontal {
            let mut from = contacts(pile, contact.site).into_iter();
            if !from.any(|(there, _)| there == *contact) {
                let text = format!("there is no horizontal contact {contact} above the floor");
                return Err(Refusal::of(Condition::Place, &text));
            }
            if force.is_negative() {
                let text =
                    format!("the horizontal contact {contact} is tensile: its force is {force}");
                return Err(Refusal::of(Condition::HorizontalTension, &text));
            }
        }
        let outside = |site: &&Site| !pile.shape().contains(**site) || site.k == floor;
        if let Some(site) = self.field.keys().find(outside) {
            return Err(no_sphere(*site, "above"));
        }
        match &self.claim {
            Claim::Stands => self.forces().map(drop),
            Claim::CannotStand => {
                self.one_sided(Relation::AtMost, None)?;
                let work = work(&self.pile, &self.field);
                if work.is_positive() {
                    Ok(())
                } else {
                    let text =
                        format!("the virtual work of the weights must be positive, not {work}");
                    Err(Refusal::of(Condition::Work, &text))
                }
            }
            Claim::Least(extreme) => self.extreme(extreme, Relation::AtMost),
            Claim::Greatest(extreme) => self.extreme(extreme, Relation::AtLeast),
            Claim::Elastic { stiffness_ratio } => self.elastic(stiffness_ratio),
            Claim::Forces(given) => self.all_forces(given),
        }
    }

    /// Checks that all numbers fit into memory: one for each sphere, over the common denominator of all given
    /// numbers.
    fn fits(&self) -> Result<(), Error> {
        let one = BigRational::one();
        let loads = self.pile.loads();
        let loads = loads.flat_map(|(_, load)| [&load.down, &load.x, &load.y]);
        let balanced = core::iter::once(&one)
            .chain(self.pile.weights().map(|(_, weight)| weight))
            .chain(self.pile.tilt())
            .chain(loads)
            .chain(self.horizontal.values());
        // Each half-turn adds a factor 3, less than two bits, to the denominator. The sums add less than one word.
        let turns: u64 = self.pile.shape().stacking().runs().map(|_| 2).sum();
        let (spheres, turns) = match self.claim {
            // The check is restricted to the field and crosses one sign change only.
            Claim::CannotStand => (self.field.len().into(), 2),
            _ => (self.pile.sphere_count(), turns),
        };
        let (mut common, mut longest) = (BigInt::one(), 0);
        for number in balanced.chain(self.field.values().flatten()) {
            longest = longest.max(number.numer().bits());
            common = common_multiple(common, number.denom());
            let needed = &spheres * ((common.bits() + longest + turns) / 64 + 1);
            refuse_beyond_memory(
                "a check of every sphere",
                &needed,
                (MAX_WORDS, size_of::<u64>()),
                "certify a smaller pile, or use shorter numbers",
            )?;
        }
        Ok(())
    }

    /// Returns the forces of all sloping contacts, from the top, by the balance of each sphere.
    fn balance(&self) -> Result<BTreeMap<Site, Triple>, Error> {
        let mut forces = BTreeMap::new();
        for site in above_the_floor(&self.pile) {
            let transmitted = self.transmitted(&forces, site)?;
            forces.insert(site, transmitted);
        }
        Ok(forces)
    }

    /// Returns the refusal for the first tensile contact, from the top.
    fn tension(&self, forces: &BTreeMap<Site, Triple>) -> Option<Refusal> {
        let directions = self.pile.dimension().directions();
        above_the_floor(&self.pile).find_map(|site| {
            let transmitted = forces.get(&site)?;
            let force = |direction: &&Direction| transmitted[direction.index()].is_negative();
            let direction = *directions.iter().find(force)?;
            let force = &transmitted[direction.index()];
            let text = format!("the contact {site} {direction} is tensile: its force is {force}");
            Some(Refusal::of(Condition::Tension, &text))
        })
    }

    /// Returns the same forces. A tensile force is refused.
    fn forces(&self) -> Result<BTreeMap<Site, Triple>, Refusal> {
        let forces = self.balance()?;
        match self.tension(&forces) {
            Some(tension) => Err(tension),
            None => Ok(forces),
        }
    }

    /// Checks that all given forces are close to the exact ones, and that none is missing.
    fn all_forces(&self, given: &AllForces) -> Result<(), Refusal> {
        let (pile, exact) = (&self.pile, self.balance()?);
        let compressive = self.tension(&exact).is_none();
        if given.compressive != compressive {
            let text = ["a contact is tensile", "no contact is tensile"][usize::from(compressive)];
            return Err(Refusal::of(Condition::Sign, text));
        }
        let within = &given.within;
        let close = |site, what, given: &BigRational, exact: &BigRational| {
            if ByValue(&(given - exact).abs()) <= ByValue(within) {
                return Ok(());
            }
            let text = format!(
                "the force {what} of the sphere {site} is {exact}, not {given} within {within}"
            );
            Err(Refusal::of(Condition::Force, &text))
        };
        let missing = |site| {
            let text = format!("the forces of the sphere {site} are missing");
            Refusal::of(Condition::Complete, &text)
        };
        if let Some(site) = given.contacts.keys().find(|site| !exact.contains_key(site)) {
            return Err(no_sphere(*site, "above"));
        }
        for site in above_the_floor(pile) {
            let both = given.contacts.get(&site).zip(exact.get(&site));
            let (given, exact) = both.ok_or_else(|| missing(site))?;
            for direction in Direction::ALL {
                let l = direction.index();
                close(site, direction.name(), &given[l], &exact[l])?;
            }
        }
        let mut floor = BTreeMap::new();
        for force in &given.floor {
            let force = force.clone();
            floor.insert(force.site, [force.normal, force.shear_x, force.shear_y]);
        }
        let last = pile.layers() - 1;
        for site in pile.sites(Selection::Layer(last))? {
            let force = floor.get(&site);
            let [normal, x, y] = force.ok_or_else(|| missing(site))?;
            let exact = self.on_floor(&exact, site);
            close(site, "normal", normal, &exact.z)?;
            close(site, "shear_x", x, &exact.x)?;
            close(site, "shear_y", y, &exact.y)?;
        }
        let is_on_floor = |site: &Site| site.k == last && pile.shape().contains(*site);
        match floor.into_keys().find(|site| !is_on_floor(site)) {
            Some(site) => Err(no_sphere(site, "on")),
            None => Ok(()),
        }
    }

    /// Returns the force of a bottom sphere on the floor: what it receives, over the sum of the increments, and its load.
    fn on_floor(&self, forces: &BTreeMap<Site, Triple>, site: Site) -> Vector<BigRational> {
        let pile = &self.pile;
        let along = match pile.dimension() {
            Dimension::Two => disc_directions(),
            Dimension::Three => directions(pile.sin_phi()),
        };
        // A single layer receives nothing, whatever the directions.
        let along = match pile.shape().sign_below(site.k - 1) {
            Some(Sign::Minus) => along.each(Vector::turned_about_z),
            _ => along,
        };
        let from_above = resultant(&received(pile, forces, site), &along);
        let (weight, load) = (weight(&increments(pile.sin_phi())), pile.total_load(site));
        Vector {
            x: from_above.x / &weight + load.x,
            y: from_above.y / &weight + load.y,
            z: from_above.z / &weight + load.down,
        }
    }

    /// Returns the forces of the sloping contacts below a sphere, from those above it.
    fn transmitted(&self, forces: &BTreeMap<Site, Triple>, site: Site) -> Result<Triple, Error> {
        let pile = &self.pile;
        let mut balance = turned(pile, site.k, &received(pile, forces, site));
        let (own, horizontal, sign) = (
            pile.own_increments(site),
            self.pushed(site),
            sigma(pile, site.k)?,
        );
        for direction in pile.dimension().directions() {
            let l = direction.index();
            balance[l] = beside(balance[l].clone(), &own[l], &horizontal[l], sign);
        }
        Ok(balance)
    }

    /// Returns H, the contribution of the horizontal contacts to the balance of a sphere.
    fn pushed(&self, site: Site) -> Triple {
        let mut sum = zeros();
        for (contact, leads_away) in around(site) {
            if let Some(force) = self.horizontal.get(&contact) {
                let entries = pushed(force, contact.axis.ends(), leads_away);
                for (sum, entry) in sum.iter_mut().zip(entries) {
                    *sum += entry;
                }
            }
        }
        sum
    }

    fn field(&self, site: Site) -> Triple {
        // φ is zero by definition on spheres that are not listed.
        self.field.get(&site).cloned().unwrap_or_else(zeros)
    }

    /// Returns D for the contacts below a sphere: the transpose of the balance equations, applied to the field.
    fn drops(&self, site: Site) -> Triple {
        let (pile, mut drops) = (&self.pile, self.field(site));
        for direction in pile.dimension().directions() {
            if let Some(support) = pile.shape().below(site, *direction) {
                let l = direction.index();
                let below = turned(pile, support.k, &self.field(support));
                drops[l] = formula::contact_drop(drops[l].clone(), &below[l]);
            }
        }
        drops
    }

    /// Returns c for a horizontal contact.
    fn compression(
        &self,
        contact: HorizontalContact,
        neighbour: Site,
    ) -> Result<BigRational, Error> {
        let [here, there] = [contact.site, neighbour].each(|site| self.field(site));
        let sign = sigma(&self.pile, contact.site.k)?;
        Ok(formula::compression(
            &here,
            &there,
            contact.axis.ends(),
            sign,
        ))
    }

    /// Checks D at the contacts of the spheres, and c times the stiffness ratio, against the required relation and
    /// value.
    fn conditions(
        &self,
        spheres: &mut dyn Iterator<Item = Site>,
        stiffness_ratio: &BigRational,
        of_drop: &dyn Fn(Site, Direction) -> (Relation, BigRational),
        of_compression: &dyn Fn(HorizontalContact) -> (Relation, BigRational),
    ) -> Result<(), Refusal> {
        let pile = &self.pile;
        for site in spheres {
            for (direction, drop) in Direction::ALL.into_iter().zip(self.drops(site)) {
                let (relation, needed) = of_drop(site, direction);
                let is_there = pile.dimension().directions().contains(&direction);
                if is_there && !relation.holds(&drop, &needed) {
                    let text = format!(
                        "the drop along the contact {site} {direction} is {drop}, but must be {relation} {needed}"
                    );
                    return Err(Refusal::of(Condition::Drop, &text));
                }
            }
            for (contact, neighbour) in contacts(pile, site) {
                let compression = stiffness_ratio * self.compression(contact, neighbour)?;
                let (relation, needed) = of_compression(contact);
                if !relation.holds(&compression, &needed) {
                    let text = format!(
                        "the compression of the horizontal contact {contact} is {compression}, but must be {relation} {needed}"
                    );
                    return Err(Refusal::of(Condition::Compression, &text));
                }
            }
        }
        Ok(())
    }

    /// Returns the spheres at which D or c can differ from zero, and the spheres that touch the bottom sphere, in row
    /// order.
    ///
    /// These are the spheres of the field, the spheres supported by them, and their neighbours.
    fn around_the_field(&self, bottom: Option<Site>) -> Vec<Site> {
        let shape = self.pile.shape();
        let mut spheres = Vec::new();
        for site in self.field.keys() {
            for (contact, _) in around(*site) {
                spheres.extend(Some(contact.site).filter(|site| shape.contains(*site)));
            }
        }
        for site in self.field.keys().chain(&bottom) {
            for direction in Direction::ALL {
                spheres.extend(shape.above(*site, direction));
            }
        }
        spheres.sort_unstable();
        spheres.dedup();
        spheres
    }

    /// Checks that D satisfies the relation to 1 at the contacts of the bottom sphere, if given, and to 0 at all
    /// others, and that every c satisfies the relation to 0.
    fn one_sided(&self, relation: Relation, bottom: Option<Site>) -> Result<(), Refusal> {
        let shape = self.pile.shape();
        let of_drop = |site, direction| {
            let bears = bottom.is_some() && shape.below(site, direction) == bottom;
            (relation, BigRational::from_integer(i32::from(bears).into()))
        };
        let mut spheres = self.around_the_field(bottom).into_iter();
        self.conditions(&mut spheres, &BigRational::one(), &of_drop, &|_| {
            (relation, BigRational::zero())
        })
    }

    fn extreme(&self, extreme: &Extreme, relation: Relation) -> Result<(), Refusal> {
        let (pile, site) = (&self.pile, extreme.site);
        if site.k != pile.layers() - 1 || !pile.shape().contains(site) {
            return Err(no_sphere(site, "on"));
        }
        self.one_sided(relation, Some(site))?;
        let directions = BigRational::from_integer(pile.dimension().number().into());
        let normal = |sum: BigRational| pile.total_load(site).down + sum / &directions;
        let (claimed, proved) = (&extreme.normal, normal(work(pile, &self.field)));
        if ByValue(&proved) != ByValue(claimed) {
            let text = format!("the field proves the bound {proved}, not {claimed}");
            return Err(Refusal::of(Condition::Bound, &text));
        }
        if extreme.attained {
            let received = received(pile, &self.forces()?, site);
            let attained = normal(received.into_iter().sum());
            if ByValue(&attained) != ByValue(claimed) {
                let text = format!("the forces attain the normal force {attained}, not {claimed}");
                return Err(Refusal::of(Condition::Attained, &text));
            }
        }
        Ok(())
    }

    fn elastic(&self, stiffness_ratio: &BigRational) -> Result<(), Refusal> {
        if !stiffness_ratio.is_positive() {
            let text = format!("the stiffness ratio must be positive, not {stiffness_ratio}");
            return Err(Refusal::of(Condition::Stiffness, &text));
        }
        let forces = self.forces()?;
        // Complementary slackness: equality if the contact carries a force, an inequality if it is open.
        let of_spring = |force: Option<&BigRational>| match force {
            Some(force) if force.is_positive() => (Relation::Equal, force.clone()),
            _ => (Relation::AtMost, BigRational::zero()),
        };
        let of_drop = |site: Site, direction: Direction| {
            let forces = forces.get(&site);
            of_spring(forces.map(|forces| &forces[direction.index()]))
        };
        let mut spheres = above_the_floor(&self.pile);
        self.conditions(&mut spheres, stiffness_ratio, &of_drop, &|contact| {
            of_spring(self.horizontal.get(&contact))
        })
    }
}

/// Returns the refusal for a sphere that is not `above` the floor, or not `on` it.
fn no_sphere(site: Site, place: &str) -> Refusal {
    let text = format!("there is no sphere {site} {place} the floor");
    Refusal::of(Condition::Place, &text)
}

/// Returns the virtual work Σ w φ of the weights.
pub(crate) fn work(pile: &Pile, field: &BTreeMap<Site, Triple>) -> BigRational {
    let directions = pile.dimension().directions();
    let mut work = BigRational::zero();
    for (site, field) in field {
        let own = pile.own_increments(*site);
        work += directions
            .iter()
            .map(|l| &own[l.index()] * &field[l.index()])
            .sum::<BigRational>();
    }
    work
}

fn zeros() -> Triple {
    [(); 3].each(|()| BigRational::zero())
}

/// Returns the spheres above the floor, from the top.
fn above_the_floor(pile: &Pile) -> impl Iterator<Item = Site> + '_ {
    let floor = pile.layers() - 1;
    pile.shape().sites().take_while(move |site| site.k < floor)
}

/// Returns the forces that a sphere receives from above, by direction.
fn received(pile: &Pile, forces: &BTreeMap<Site, Triple>, site: Site) -> Triple {
    Direction::ALL.each(|direction| {
        let above = pile
            .shape()
            .above(site, direction)
            .and_then(|above| forces.get(&above));
        above.map_or_else(BigRational::zero, |forces| {
            forces[direction.index()].clone()
        })
    })
}

/// Applies T of layer k: the half-turn if the sign changes there, otherwise the identity.
fn turned(pile: &Pile, k: i128, numbers: &Triple) -> Triple {
    let signs = [k - 1, k].each(|k| pile.shape().sign_below(k));
    match signs {
        [Some(above), Some(below)] if above != below => {
            tripled_half_turn(numbers).each(|tripled| tripled / BigRational::from_integer(3.into()))
        }
        _ => numbers.clone(),
    }
}

/// Returns the sign σ of the step below a layer.
fn sigma(pile: &Pile, k: i128) -> Result<Sign, Error> {
    let sign = pile.shape().sign_below(k);
    sign.ok_or_else(|| bug("every layer above the floor has a step below it"))
}

/// Returns the six possible horizontal contacts of a sphere, and whether each one leads away from it.
fn around(site: Site) -> Vec<(HorizontalContact, bool)> {
    let mut around = Vec::with_capacity(6);
    for axis in Axis::ALL {
        around.push((HorizontalContact { site, axis }, true));
        let back = before(site, axis).map(|site| (HorizontalContact { site, axis }, false));
        around.extend(back);
    }
    around
}

/// Returns the site p − d_b + d_a, where a horizontal contact with p begins. `None` if its coordinates overflow.
fn before(Site { i, j, k }: Site, axis: Axis) -> Option<Site> {
    let [[a_i, a_j], [b_i, b_j]] = axis.ends().each(|end| Sign::Plus.descent(end));
    let (i, j) = (i.checked_add(a_i - b_i)?, j.checked_add(a_j - b_j)?);
    Some(Site { i, j, k })
}

/// Returns the horizontal contacts that lead away from a sphere above the floor.
fn contacts(pile: &Pile, site: Site) -> Vec<(HorizontalContact, Site)> {
    let shape = pile.shape();
    let mut contacts = Vec::new();
    if site.k < pile.layers() - 1 && shape.contains(site) {
        for axis in Axis::ALL {
            let contact = HorizontalContact { site, axis };
            let neighbour = contact.neighbour().filter(|site| shape.contains(*site));
            contacts.extend(neighbour.map(|neighbour| (contact, neighbour)));
        }
    }
    contacts
}

#[cfg(test)]
mod tests {
    use super::*;
    use cannonpile::lattice::Region;
    use cannonpile::stacking::Stacking;

    /// Pseudo-random rationals from −9 to 9 with denominators 1, 2, 3 and 7.
    struct Numbers(u64);

    impl Numbers {
        fn next(&mut self) -> BigRational {
            // Knuth's linear congruential generator. The upper bits are random enough.
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005) + 1;
            let [numer, denom] = [self.0 >> 40, self.0 >> 50].map(i128::from);
            let denom: i128 = [1, 2, 3, 7][usize::from(denom.to_le_bytes()[0] % 4)];
            BigRational::new((numer % 19 - 9).into(), denom.into())
        }
    }

    /// Returns both sides of Σ f D + Σ X c = Σ w φ, with X and φ of any sign on all contacts and spheres above the
    /// floor.
    fn both_sides(pile: Pile, numbers: &mut Numbers) -> [BigRational; 2] {
        let mut certificate = Certificate {
            claim: Claim::Stands,
            horizontal: BTreeMap::new(),
            field: BTreeMap::new(),
            pile,
        };
        let floor = certificate.pile.layers() - 1;
        let sites: Vec<Site> = certificate.pile.shape().sites().collect();
        let above = || sites.iter().copied().filter(|site| site.k < floor);
        for site in above() {
            for (contact, _) in contacts(&certificate.pile, site) {
                certificate.horizontal.insert(contact, numbers.next());
            }
            let field = [(); 3].map(|()| numbers.next());
            certificate.field.insert(site, field);
        }
        let (mut forces, mut done) = (BTreeMap::new(), BigRational::zero());
        for site in above() {
            let transmitted = certificate.transmitted(&forces, site).unwrap();
            let drops = certificate.drops(site);
            for direction in certificate.pile.dimension().directions() {
                done += &transmitted[direction.index()] * &drops[direction.index()];
            }
            forces.insert(site, transmitted);
        }
        for (contact, force) in &certificate.horizontal {
            let neighbour = contact.neighbour().unwrap();
            done += force * certificate.compression(*contact, neighbour).unwrap();
        }
        [done, work(&certificate.pile, &certificate.field)]
    }

    #[test]
    fn virtual_work() {
        let mut numbers = Numbers(1998);
        let heavy = BigRational::new(17.into(), 5.into());
        for layers in 1..=6 {
            let discs = Pile::discs(layers).unwrap();
            let [done, work] = both_sides(discs, &mut numbers);
            assert_eq!(done, work, "discs, {layers}");
        }
        for signs in 0..1_u32 << 5 {
            let sign = |n: u32| match signs >> n & 1 {
                0 => Sign::Plus,
                _ => Sign::Minus,
            };
            let steps = 1 + signs % 5;
            let stacking = Stacking::from_signs((0..steps).map(sign).collect::<Vec<_>>()).unwrap();
            let top = Region::new(-1..=1, 0..=2, -1..=2).unwrap();
            for pile in [
                Pile::under(Region::SITE, stacking.clone()),
                Pile::under(top, stacking.clone()),
                Pile::on(Region::hexagon(6, 5).unwrap(), stacking),
            ] {
                let pile = pile.unwrap();
                let site = pile.shape().sites().next().unwrap();
                let pile = pile.with_load(site, heavy.clone()).unwrap();
                let [done, work] = both_sides(pile.clone(), &mut numbers);
                assert_eq!(done, work, "{:?}", pile.shape());
                assert_ne!(work, BigRational::zero());
                let [done, work] = both_sides(pile.weightless(), &mut numbers);
                assert_eq!(done, work);
            }
        }
    }
}
