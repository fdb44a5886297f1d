//! Springs that only push, exactly: a contact that pulls is opened until it does not.
//!
//! In the state of least energy each contact bears a force and has no gap, or has a gap and bears no force. It is found
//! from any choice of open contacts whose gaps are none of them negative: one that pulls is opened wider and wider, until
//! its force is zero; an open one whose gap comes to an end on the way is shut, and bears a force from there on. With each
//! contact that has been opened the energy is greater, so that no choice comes twice, whatever the weights are. This is the
//! dual active-set method of D. Goldfarb and A. Idnani, "A numerically stable dual method for solving strictly convex
//! quadratic programs", Mathematical Programming 27 (1983) 1, in rationals.
//!
//! Guesses of floats have gaps that are a little wrong where contacts bear nothing and have no gap either. As long as none
//! pulls, contacts that overlap are therefore shut first, one by one, and what would pull on the way is opened: the primal
//! active-set method, which takes fewer steps from there.

use std::collections::{BTreeMap, BTreeSet};

use cannonpile::engine::{bug, check_interrupt};
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::Error;
use crate::exact::{Equation, changes_of_nothing, near};
use crate::network::Network;

/// A pile of springs: κ = 1, κ′ the stiffness ratio. Contacts have the numbers of the network's unknowns, sloping ones
/// first.
pub(crate) struct Springs<'p> {
    pub(crate) network: Network<'p>,
    pub(crate) stiffness_ratio: &'p BigRational,
}

/// Forces and gaps of contacts, and the field that goes with them.
pub(crate) struct State {
    /// By contact; negative where it pulls.
    pub(crate) forces: Vec<BigRational>,
    /// By contact, as the force that would shut it: f − D or X − κ′ c; negative where the two ends overlap.
    gaps: Vec<BigRational>,
    /// By equation.
    pub(crate) field: Vec<BigRational>,
}

/// What springs answer to.
#[derive(Clone, Copy)]
enum Cause {
    Weights,
    /// A gap of 1 in a contact that is not open, without weights.
    Gap(usize),
}

/// Which contacts are open, and the equations of that.
struct System {
    open: BTreeSet<usize>,
    /// By unknown: the horizontal contacts that are shut, whose force is unknown, and the sloping ones that are open, whose gap
    /// is; the rest follows from above and from below. A row says that a contact's gap or force is zero, without what a cause
    /// adds; its coefficients are by unknown, and symmetric (reciprocity).
    rows: BTreeMap<usize, BTreeMap<usize, BigRational>>,
}

impl Springs<'_> {
    /// Returns the state in which all horizontal contacts are open, and no others.
    pub(crate) fn without_horizontal(&self) -> Result<State, Error> {
        let contacts = self.sloping()..self.network.columns.len();
        self.state(&self.system(contacts.collect())?, Cause::Weights)
    }

    /// Returns the state of least energy: the sooner, the fewer contacts are wrongly guessed to be open or shut. Guesses are
    /// gaps by contact, zero where it is shut.
    ///
    /// # Errors
    /// [`Error::CannotStand`]; [`Interrupted`](cannonpile::Error::Interrupted).
    pub(crate) fn least_energy(&self, guess: Vec<f64>) -> Result<State, Error> {
        let contacts = guess.iter().enumerate().filter(|(_, gap)| **gap > 0.0);
        let open = contacts.map(|(contact, _)| contact).collect();
        let mut system = self.system(open)?;
        self.shut_idle(&mut system, guess)?;
        let mut state = self.state(&system, Cause::Weights)?;
        // Where contacts without a force are opened and shut for each other primal steps might go in circles.
        let mut primal_steps = self.network.columns.len();
        loop {
            let overlapping = state.overlapping(&system.open);
            match (overlapping.first(), state.pulling()) {
                (None, None) => return Ok(state),
                (None, Some(contact)) => {
                    self.open_wider(contact, &mut system)?;
                    state = self.state(&system, Cause::Weights)?;
                    debug_assert!(
                        state.overlapping(&system.open).is_empty(),
                        "others are shut where their gaps come to an end"
                    );
                }
                (Some(contact), None) if primal_steps > 0 => {
                    primal_steps -= 1;
                    state = self.pressed(*contact, state.forces, &mut system)?;
                }
                (Some(_), _) => {
                    for contact in overlapping {
                        self.shut(contact, &mut system)?;
                    }
                    state = self.state(&system, Cause::Weights)?;
                }
            }
        }
    }

    /// The state once an overlapping contact has been shut, from forces of which none pulls: on the way there each contact that
    /// would begin to pull is opened. The energy is no greater than before.
    fn pressed(
        &self,
        overlapping: usize,
        mut forces: Vec<BigRational>,
        system: &mut System,
    ) -> Result<State, Error> {
        self.shut(overlapping, system)?;
        loop {
            let state = self.state(system, Cause::Weights)?;
            let changes = forces.iter().zip(&state.forces).enumerate();
            let pulling = changes.filter(|(_, (_, after))| after.is_negative());
            let first =
                pulling.map(|(contact, (before, after))| (before / (before - after), contact));
            let Some((share, contact)) = first.min() else {
                return Ok(state);
            };
            for (force, after) in forces.iter_mut().zip(&state.forces) {
                *force += &share * (after - &*force);
            }
            debug_assert!(
                forces[contact].is_zero() && forces.iter().all(|force| !force.is_negative()),
                "each contact is opened where it would begin to pull"
            );
            self.open(contact, system)?;
        }
    }

    /// Shuts open contacts that bear nothing since others do not: with gaps for all of them no system has one solution. Gaps
    /// are changed for each other, none below zero, until one of them is gone.
    fn shut_idle(&self, system: &mut System, mut gaps: Vec<f64>) -> Result<(), Error> {
        let unknowns: Vec<usize> = system.rows.keys().copied().collect();
        let mut changes = changes_of_nothing(system.equations()).ok_or_else(unsolvable)?;
        while let Some(change) = changes.pop() {
            // Not a default: what is too great for a float is too great for a guess.
            let float = |exact: &BigRational| exact.to_f64().unwrap_or(f64::INFINITY);
            let changing = (0..unknowns.len()).filter(|number| !change[*number].is_zero());
            let step = |number: usize| -gaps[unknowns[number]] / float(&change[number]);
            let gone =
                changing.min_by(|one, other| step(*one).abs().total_cmp(&step(*other).abs()));
            let gone = gone.ok_or_else(|| bug("a change of nothing changes something"))?;
            let step = step(gone);
            for (unknown, change) in unknowns.iter().zip(&change) {
                gaps[*unknown] += step * float(change);
            }
            self.shut(unknowns[gone], system)?;
            for other in &mut changes {
                let factor = &other[gone] / &change[gone];
                for (other, change) in other.iter_mut().zip(&change) {
                    *other -= &factor * change;
                }
            }
        }
        Ok(())
    }

    /// Opens a contact that pulls until it does not, and shuts others where their gaps come to an end.
    fn open_wider(&self, pulling: usize, system: &mut System) -> Result<(), Error> {
        loop {
            let state = self.state(system, Cause::Weights)?;
            let change = self.state(system, Cause::Gap(pulling))?;
            let closing = system
                .open
                .iter()
                .filter(|c| change.gaps[**c].is_negative());
            let closing = closing
                .map(|c| (-&state.gaps[*c] / &change.gaps[*c], *c))
                .min();
            let enough = change.forces[pulling]
                .is_positive()
                .then(|| -&state.forces[pulling] / &change.forces[pulling]);
            match (closing, enough) {
                (Some((gap, contact)), enough) if enough.as_ref().is_none_or(|e| gap < *e) => {
                    self.shut(contact, system)?;
                }
                (_, Some(_)) => return self.open(pulling, system),
                // It pulls as much however wide it is opened.
                (_, None) => return Err(Error::CannotStand),
            }
        }
    }

    /// How many contacts are sloping, and equations of balance.
    fn sloping(&self) -> usize {
        self.network.weights.len()
    }

    fn system(&self, open: BTreeSet<usize>) -> Result<System, Error> {
        let shut = (self.sloping()..self.network.columns.len()).filter(|c| !open.contains(c));
        let unknowns: Vec<usize> = shut.chain(open.range(..self.sloping()).copied()).collect();
        let mut system = System {
            open,
            rows: BTreeMap::new(),
        };
        for unknown in unknowns {
            self.add_unknown(unknown, &mut system)?;
        }
        Ok(system)
    }

    fn open(&self, contact: usize, system: &mut System) -> Result<(), Error> {
        system.open.insert(contact);
        if contact < self.sloping() {
            self.add_unknown(contact, system)?;
        } else {
            system.remove_unknown(contact);
        }
        Ok(())
    }

    fn shut(&self, contact: usize, system: &mut System) -> Result<(), Error> {
        system.open.remove(&contact);
        if contact < self.sloping() {
            system.remove_unknown(contact);
        } else {
            self.add_unknown(contact, system)?;
        }
        Ok(())
    }

    fn add_unknown(&self, unknown: usize, system: &mut System) -> Result<(), Error> {
        check_interrupt()?;
        let nothing = vec![BigRational::zero(); self.sloping()];
        let alone = self.following(nothing, &[(unknown, BigRational::one())]);
        let mut row = BTreeMap::new();
        for contact in system.rows.keys().copied().chain([unknown]) {
            let coefficient = self.to_vanish(contact, &alone);
            if !coefficient.is_zero() {
                row.insert(contact, coefficient);
            }
        }
        for (contact, other) in &mut system.rows {
            if let Some(coefficient) = row.get(contact) {
                other.insert(unknown, coefficient.clone());
            }
        }
        system.rows.insert(unknown, row);
        Ok(())
    }

    /// What is zero of an unknown in the end: the force of a sloping contact, and c − X/κ′ of a horizontal one.
    fn to_vanish(&self, contact: usize, state: &State) -> BigRational {
        if contact < self.sloping() {
            state.forces[contact].clone()
        } else {
            -&state.gaps[contact] / self.stiffness_ratio
        }
    }

    /// What a cause makes of a system.
    fn state(&self, system: &System, cause: Cause) -> Result<State, Error> {
        let (mut sums, mut given) = (vec![BigRational::zero(); self.sloping()], Vec::new());
        let mut gap = None;
        match cause {
            Cause::Weights => sums.clone_from(&self.network.weights),
            Cause::Gap(contact) if contact < self.sloping() => {
                given.push((contact, BigRational::one()));
            }
            Cause::Gap(contact) => gap = Some(contact),
        }
        let alone = self.following(sums.clone(), &given);
        let mut equations = system.equations();
        for ((_, sum), contact) in equations.iter_mut().zip(system.rows.keys()) {
            *sum -= self.to_vanish(*contact, &alone);
            if gap == Some(*contact) {
                *sum -= self.stiffness_ratio.recip();
            }
        }
        let solution = near(equations, &vec![0.0; system.rows.len()], |_| true);
        let solution = solution.ok_or_else(unsolvable)?;
        given.extend(system.rows.keys().copied().zip(solution));
        Ok(self.following(sums, &given))
    }

    /// What follows from these sums of the equations of balance, forces of horizontal contacts and gaps of sloping ones.
    fn following(&self, mut sums: Vec<BigRational>, given: &[(usize, BigRational)]) -> State {
        let columns = &self.network.columns;
        let (sloping, all) = (self.sloping(), columns.len());
        let mut horizontal = vec![BigRational::zero(); all - sloping];
        let mut gaps = vec![BigRational::zero(); sloping];
        for (contact, number) in given {
            if *contact < sloping {
                gaps[*contact] = number.clone();
                continue;
            }
            for (equation, coefficient) in &columns[*contact] {
                sums[*equation] -= coefficient * number;
            }
            horizontal[contact - sloping] = number.clone();
        }
        let mut forces = self.network.sloping(sums);
        let drops = forces.iter().zip(&gaps).map(|(force, gap)| force - gap);
        let field = self.network.field_of(drops.collect());
        let compressions = columns[sloping..].iter().map(|column| {
            let terms = column.iter().map(|(equation, c)| c * &field[*equation]);
            self.stiffness_ratio * terms.sum::<BigRational>()
        });
        gaps.extend(
            horizontal
                .iter()
                .zip(compressions)
                .map(|(force, c)| force - c),
        );
        forces.append(&mut horizontal);
        State {
            forces,
            gaps,
            field,
        }
    }
}

impl System {
    /// The rows, whose unknowns are numbered as they come.
    fn equations(&self) -> Vec<Equation> {
        let numbers: BTreeMap<usize, usize> = self.rows.keys().copied().zip(0..).collect();
        let rows = self.rows.values().map(|row| {
            let coefficients = row.iter().map(|(unknown, c)| (numbers[unknown], c.clone()));
            (coefficients.collect(), BigRational::zero())
        });
        rows.collect()
    }

    fn remove_unknown(&mut self, unknown: usize) {
        self.rows.remove(&unknown);
        for row in self.rows.values_mut() {
            row.remove(&unknown);
        }
    }
}

impl State {
    /// Whether nothing pulls, and no ends overlap.
    pub(crate) fn is_least_energy(&self) -> bool {
        self.forces
            .iter()
            .chain(&self.gaps)
            .all(|number| !number.is_negative())
    }

    /// Those of some open contacts whose ends overlap, most first.
    fn overlapping(&self, open: &BTreeSet<usize>) -> Vec<usize> {
        let overlapping = open.iter().copied();
        let mut overlapping: Vec<usize> = overlapping
            .filter(|c| self.gaps[*c].is_negative())
            .collect();
        overlapping.sort_by(|one, other| self.gaps[*one].cmp(&self.gaps[*other]));
        overlapping
    }

    /// The contact that pulls most.
    fn pulling(&self) -> Option<usize> {
        let forces = self.forces.iter().enumerate();
        let (contact, _) = forces
            .filter(|(_, force)| force.is_negative())
            .min_by_key(|(_, force)| *force)?;
        Some(contact)
    }
}

/// Why equations that have one solution have none.
fn unsolvable() -> cannonpile::Error {
    match check_interrupt() {
        Ok(()) => bug("springs have one state"),
        Err(interrupted) => interrupted,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use cannonpile::Pile;
    use cannonpile::lattice::{Region, Site};

    use crate::stand::cannot_stand;

    fn ratio(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    fn piles() -> Vec<Pile> {
        let under = |stacking: &str| Pile::under(Region::SITE, stacking.parse().unwrap()).unwrap();
        let loaded = |pile: Pile, i, k, load| pile.with_load(Site { i, j: 0, k }, load).unwrap();
        vec![
            Pile::triangular(1).unwrap(),
            Pile::triangular(4).unwrap(),
            under("+-+-+"),
            under("--+-+"),
            loaded(Pile::triangular(5).unwrap(), 1, 2, ratio(30, 7)),
            loaded(Pile::triangular(4).unwrap().weightless(), 0, 1, ratio(1, 3)),
            Pile::discs(6).unwrap(),
            loaded(Pile::discs(5).unwrap().weightless(), 1, 3, ratio(2, 1)),
        ]
    }

    fn springs<'p>(pile: &'p Pile, stiffness_ratio: &'p BigRational) -> Springs<'p> {
        let network = Network::above(pile, pile.layers() - 1, 1000).unwrap();
        Springs {
            network,
            stiffness_ratio,
        }
    }

    /// Guesses of which contacts are open: none, all, the horizontal ones, the sloping ones, and every second and third; but
    /// none by which dozens of horizontal contacts press, whose equations take a minute.
    fn guesses(springs: &Springs<'_>) -> Vec<Vec<f64>> {
        let (sloping, all) = (springs.sloping(), springs.network.columns.len());
        let guess = |is_open: &dyn Fn(usize) -> bool| {
            let gap = |contact| f64::from(u8::from(is_open(contact)));
            (0..all).map(gap).collect()
        };
        let guesses: [Vec<f64>; 6] = [
            guess(&|_| false),
            guess(&|_| true),
            guess(&|contact| contact >= sloping),
            guess(&|contact| contact < sloping),
            guess(&|contact| contact % 2 == 0),
            guess(&|contact| contact % 3 == 1),
        ];
        let pressing =
            |guess: &Vec<f64>| guess[sloping..].iter().filter(|gap| **gap == 0.0).count();
        guesses
            .into_iter()
            .filter(|guess| pressing(guess) < 24)
            .collect()
    }

    /// Weightless spheres included: there contacts bear nothing and have no gap.
    #[test]
    fn every_guess_leads_to_the_one_state() {
        let stiffness_ratio = ratio(2, 7);
        let mut pressed = 0;
        for pile in piles() {
            let springs = springs(&pile, &stiffness_ratio);
            let states = guesses(&springs).into_iter().map(|guess| {
                let state = springs.least_energy(guess).unwrap();
                assert!(state.is_least_energy(), "{pile:?}");
                for (force, gap) in state.forces.iter().zip(&state.gaps) {
                    assert!(force.is_zero() || gap.is_zero(), "{pile:?}");
                }
                state.forces
            });
            let states: Vec<_> = states.collect();
            assert!(states.iter().all(|forces| *forces == states[0]), "{pile:?}");
            let horizontal = &states[0][springs.sloping()..];
            pressed += usize::from(horizontal.iter().any(Signed::is_positive));
        }
        assert_eq!(pressed, 2);
    }

    /// Discs without weight under loads, with these contacts guessed to be open: what overlaps at first, and what pulls.
    fn leads_to_the_one_state(
        (layers, loads): (i128, &[(i128, i128, i64)]),
        guessed: &[usize],
        (overlaps, pulls): (&[usize], Option<usize>),
    ) {
        let pile = loads.iter().fold(
            Pile::discs(layers).unwrap().weightless(),
            |pile, (i, k, load)| {
                let site = Site { i: *i, j: 0, k: *k };
                pile.with_load(site, ratio(*load, 1)).unwrap()
            },
        );
        let one = ratio(1, 1);
        let springs = springs(&pile, &one);
        let system = springs.system(guessed.iter().copied().collect()).unwrap();
        let state = springs.state(&system, Cause::Weights).unwrap();
        assert_eq!(state.overlapping(&system.open), overlaps);
        assert_eq!(state.pulling(), pulls);
        let columns = 0..springs.network.columns.len();
        let guess = columns.map(|contact| f64::from(u8::from(guessed.contains(&contact))));
        let state = springs.least_energy(guess.collect()).unwrap();
        assert!(state.is_least_energy());
        let otherwise = vec![1.0; springs.network.columns.len()];
        let otherwise = springs.least_energy(otherwise).unwrap();
        assert_eq!(state.forces, otherwise.forces);
    }

    /// Once the contact that overlaps is shut the horizontal one pulls from half of the way on, and is opened there.
    #[test]
    fn on_the_way_to_a_shut_contact_another_is_opened() {
        let loads = [(0, 0, 5), (0, 1, 2), (1, 1, 2)];
        leads_to_the_one_state((3, &loads), &[3], (&[3], None));
    }

    /// The contact that pulls is opened by 5; another's gap comes to its end at 5/2.
    #[test]
    fn on_the_way_to_an_open_contact_another_is_shut() {
        let loads = [(0, 0, 1), (0, 1, 2), (2, 2, 1)];
        leads_to_the_one_state((4, &loads), &[12, 14], (&[], Some(13)));
    }

    #[test]
    fn what_cannot_stand_is_found_out_from_every_guess() {
        let pile = Pile::under(Region::SITE, "++++-".parse().unwrap()).unwrap();
        assert!(cannot_stand(&pile));
        let one = ratio(1, 1);
        let springs = springs(&pile, &one);
        for guess in guesses(&springs) {
            assert_eq!(springs.least_energy(guess).err(), Some(Error::CannotStand));
        }
    }
}
