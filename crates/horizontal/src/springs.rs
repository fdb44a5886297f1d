//! Exact equilibrium of unilateral springs, by an active-set method in rationals.
//!
//! In the state of least energy each contact either carries a force and has no gap, or has a gap and carries no
//! force.
//!
//! # Dual steps
//! The method starts from any set of open contacts whose gaps are not negative. A tensile contact is opened
//! gradually until its force is zero. If the gap of another contact reaches zero on the way, that contact is closed
//! and can carry a force from there on. Each opened contact increases the energy, so no set occurs twice and the
//! method terminates for all weights. This is the dual active-set method of D. Goldfarb and A. Idnani, "A
//! numerically stable dual method for solving strictly convex quadratic programs", Mathematical Programming 27
//! (1983) 1.
//!
//! # Primal steps
//! The float solution that provides the first set has slightly negative gaps at contacts with neither force nor
//! gap. As long as no contact is tensile, such overlapping contacts are closed first, one by one. A contact that
//! would become tensile on the way is opened. This primal active-set method needs fewer steps from a good guess.
//!
//! # Example
//! Three layers of discs with κ′ = κ have one horizontal contact, with forces 2 + X and 1 − X below the middle
//! layer (see [`certificate`](crate::certificate)). Start with all contacts closed. The energy is least at
//! 2(2 + X) − 2(1 − X) + X = 0, so X = −2/5, which is tensile. The contact is opened until X = 0. Then all forces
//! are compressive, and its gap, −κ′c = 2, is positive: this is the elastic state.

use cannonpile::engine::{bug, check_interrupt};
use cannonpile::scalar::ByValue;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::Error;
use crate::exact::{Equation, Sparse, null_space, place, solution};
use crate::network::Network;

/// The springs of a pile: κ = 1, and κ′ is the stiffness ratio. Contacts are numbered like the unknowns of the
/// network, sloping ones first.
pub(crate) struct Springs<'p> {
    pub(crate) network: Network<'p>,
    pub(crate) stiffness_ratio: &'p BigRational,
}

/// Forces and gaps of all contacts, and the displacement field.
pub(crate) struct State {
    /// The force of each contact, negative if tensile.
    pub(crate) forces: Vec<BigRational>,
    /// The gap of each contact, as the force that would close it: f − D or X − κ′ c. Negative if the ends overlap.
    gaps: Vec<BigRational>,
    /// The displacement field, by equation.
    pub(crate) field: Vec<BigRational>,
}

/// A cause of forces and gaps in the springs.
#[derive(Clone, Copy)]
enum Cause {
    Weights,
    /// A unit gap imposed on a closed contact, without weights.
    Gap(usize),
}

/// The set of open contacts, and the reduced equations for it.
struct System {
    /// `true` for each open contact.
    open: Vec<bool>,
    /// The matrix of the reduced equations, by row and unknown, in ascending order of both.
    ///
    /// The unknowns are the forces of closed horizontal contacts and the gaps of open sloping contacts. All other
    /// quantities follow by substitution. The row of a closed horizontal contact states that its gap is zero, the
    /// row of an open sloping contact that its force is zero. Right-hand sides depend on the cause. The matrix is
    /// symmetric (reciprocity).
    rows: Vec<(usize, Sparse)>,
}

impl Springs<'_> {
    /// Returns the state with all horizontal contacts open and all sloping contacts closed.
    pub(crate) fn without_horizontal(&self) -> Result<State, Error> {
        let contacts = 0..self.network.columns.len();
        let open = contacts.map(|contact| contact >= self.sloping());
        self.state(&self.system(open.collect())?, Cause::Weights)
    }

    /// Returns the state of least energy. `guess` is a gap for each contact, zero if it is closed.
    ///
    /// The cost grows with the number of contacts whose state is guessed wrongly.
    ///
    /// # Errors
    /// [`Error::CannotStand`] or [`Interrupted`](cannonpile::Error::Interrupted).
    pub(crate) fn least_energy(&self, guess: Vec<f64>) -> Result<State, Error> {
        let open = guess.iter().map(|gap| *gap > 0.0);
        let mut system = self.system(open.collect())?;
        self.close_idle(&mut system, guess)?;
        let mut state = self.state(&system, Cause::Weights)?;
        // The limit prevents cycling, which degenerate contacts (zero force and zero gap) could otherwise cause in
        // primal steps.
        let mut primal_steps = self.network.columns.len();
        loop {
            let overlapping = state.overlapping(&system.open);
            match (overlapping.first(), state.most_tensile()) {
                (None, None) => return Ok(state),
                (None, Some(contact)) => {
                    self.open_gradually(contact, &mut system)?;
                    state = self.state(&system, Cause::Weights)?;
                    debug_assert!(
                        state.overlapping(&system.open).is_empty(),
                        "no gap becomes negative in a dual step"
                    );
                }
                (Some(contact), None) if primal_steps > 0 => {
                    primal_steps -= 1;
                    state = self.close_overlapping(*contact, state.forces, &mut system)?;
                }
                (Some(_), _) => {
                    for contact in overlapping {
                        self.close(contact, &mut system)?;
                    }
                    state = self.state(&system, Cause::Weights)?;
                }
            }
        }
    }

    /// Closes an overlapping contact, starting from forces without tension, and returns the new state.
    ///
    /// On the way each contact that would become tensile is opened. The energy does not increase.
    fn close_overlapping(
        &self,
        overlapping: usize,
        mut forces: Vec<BigRational>,
        system: &mut System,
    ) -> Result<State, Error> {
        self.close(overlapping, system)?;
        loop {
            let state = self.state(system, Cause::Weights)?;
            let changes = forces.iter().zip(&state.forces).enumerate();
            let tensile = changes.filter(|(_, (_, after))| after.is_negative());
            let first =
                tensile.map(|(contact, (before, after))| (before / (before - after), contact));
            let Some((share, contact)) = least(first) else {
                return Ok(state);
            };
            for (force, after) in forces.iter_mut().zip(&state.forces) {
                *force += &share * (after - &*force);
            }
            debug_assert!(
                forces[contact].is_zero() && forces.iter().all(|force| !force.is_negative()),
                "no force becomes tensile in a primal step"
            );
            self.open(contact, system)?;
        }
    }

    /// Closes some open contacts without a force, so that the system becomes nonsingular.
    ///
    /// If too many contacts are open, the gaps are not unique: the null space of the system is not zero. The gaps
    /// are moved along each null vector until the first of them is zero, and that contact is closed. No gap becomes
    /// negative.
    fn close_idle(&self, system: &mut System, mut gaps: Vec<f64>) -> Result<(), Error> {
        let unknowns: Vec<usize> = system.rows.iter().map(|(unknown, _)| *unknown).collect();
        let mut null_vectors = null_space(&system.equations()).ok_or_else(unsolvable)?;
        while let Some(change) = null_vectors.pop() {
            // A value outside the range of `f64` is beyond the accuracy of a guess, so an infinity suffices.
            let float = |exact: &BigRational| exact.to_f64().unwrap_or(f64::INFINITY);
            let changing = (0..unknowns.len()).filter(|number| !change[*number].is_zero());
            let step = |number: usize| -gaps[unknowns[number]] / float(&change[number]);
            let gone =
                changing.min_by(|one, other| step(*one).abs().total_cmp(&step(*other).abs()));
            let gone = gone.ok_or_else(|| bug("a null vector has an entry that is not zero"))?;
            let step = step(gone);
            for (unknown, change) in unknowns.iter().zip(&change) {
                gaps[*unknown] += step * float(change);
            }
            self.close(unknowns[gone], system)?;
            for other in &mut null_vectors {
                let factor = &other[gone] / &change[gone];
                for (other, change) in other.iter_mut().zip(&change) {
                    *other -= &factor * change;
                }
            }
        }
        Ok(())
    }

    /// Opens a tensile contact until its force is zero, and closes contacts whose gaps reach zero on the way.
    fn open_gradually(&self, tensile: usize, system: &mut System) -> Result<(), Error> {
        loop {
            let state = self.state(system, Cause::Weights)?;
            let change = self.state(system, Cause::Gap(tensile))?;
            let contacts = (0..system.open.len()).filter(|c| system.open[*c]);
            let closing = contacts.filter(|c| change.gaps[*c].is_negative());
            let closing = least(closing.map(|c| (-&state.gaps[c] / &change.gaps[c], c)));
            let enough = change.forces[tensile]
                .is_positive()
                .then(|| -&state.forces[tensile] / &change.forces[tensile]);
            match (closing, enough) {
                (Some((gap, contact)), enough)
                    if enough.as_ref().is_none_or(|e| (&gap - e).is_negative()) =>
                {
                    self.close(contact, system)?;
                }
                (_, Some(_)) => return self.open(tensile, system),
                // The contact stays tensile at any gap.
                (_, None) => return Err(Error::CannotStand),
            }
        }
    }

    /// Returns the number of sloping contacts, which equals the number of balance equations.
    fn sloping(&self) -> usize {
        self.network.weights.len()
    }

    fn system(&self, open: Vec<bool>) -> Result<System, Error> {
        let unknowns: Vec<usize> = (0..open.len())
            .filter(|contact| open[*contact] == (*contact < self.sloping()))
            .collect();
        let mut system = System {
            open,
            rows: Vec::new(),
        };
        for unknown in unknowns {
            self.add_unknown(unknown, &mut system)?;
        }
        Ok(system)
    }

    fn open(&self, contact: usize, system: &mut System) -> Result<(), Error> {
        self.set_open(contact, true, system)
    }

    fn close(&self, contact: usize, system: &mut System) -> Result<(), Error> {
        self.set_open(contact, false, system)
    }

    fn set_open(&self, contact: usize, open: bool, system: &mut System) -> Result<(), Error> {
        system.open[contact] = open;
        if open == (contact < self.sloping()) {
            self.add_unknown(contact, system)?;
        } else {
            system.remove_unknown(contact);
        }
        Ok(())
    }

    fn add_unknown(&self, unknown: usize, system: &mut System) -> Result<(), Error> {
        check_interrupt()?;
        let Err(new) = place(&system.rows, unknown) else {
            return Ok(());
        };
        let nothing = vec![BigRational::zero(); self.sloping()];
        let alone = self.substitute(nothing, &[(unknown, BigRational::one())]);
        system.rows.insert(new, (unknown, Sparse::new()));
        for row in 0..system.rows.len() {
            let contact = system.rows[row].0;
            let coefficient = self.residual(contact, &alone);
            if coefficient.is_zero() {
                continue;
            }
            if row != new {
                let other = &mut system.rows[row].1;
                let place = place(other, unknown).unwrap_or_else(|place| place);
                other.insert(place, (unknown, coefficient.clone()));
            }
            system.rows[new].1.push((contact, coefficient));
        }
        Ok(())
    }

    /// Returns the quantity that must vanish for an unknown: the force of a sloping contact, or c − X/κ′ of a
    /// horizontal one.
    fn residual(&self, contact: usize, state: &State) -> BigRational {
        if contact < self.sloping() {
            state.forces[contact].clone()
        } else {
            -&state.gaps[contact] / self.stiffness_ratio
        }
    }

    /// Returns the state that a cause produces with the given set of open contacts.
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
        let alone = self.substitute(sums.clone(), &given);
        let mut equations = system.equations();
        for ((_, sum), (contact, _)) in equations.iter_mut().zip(&system.rows) {
            *sum -= self.residual(*contact, &alone);
            if gap == Some(*contact) {
                *sum -= self.stiffness_ratio.recip();
            }
        }
        let solution = solution(&equations).ok_or_else(unsolvable)?;
        for ((unknown, _), number) in system.rows.iter().zip(solution) {
            given.push((*unknown, number));
        }
        Ok(self.substitute(sums, &given))
    }

    /// Returns the state that follows from right-hand sides of the balance equations, forces of horizontal contacts
    /// and gaps of sloping ones.
    fn substitute(&self, mut sums: Vec<BigRational>, given: &[(usize, BigRational)]) -> State {
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
    /// Returns the reduced equations, with unknowns numbered consecutively and right-hand sides zero.
    fn equations(&self) -> Vec<Equation> {
        let numbered = |(_, row): &(usize, Sparse)| {
            let numbered = row
                .iter()
                .filter_map(|(unknown, c)| Some((place(&self.rows, *unknown).ok()?, c.clone())));
            (numbered.collect(), BigRational::zero())
        };
        self.rows.iter().map(numbered).collect()
    }

    fn remove_unknown(&mut self, unknown: usize) {
        self.rows.retain(|(row, _)| *row != unknown);
        for (_, row) in &mut self.rows {
            row.retain(|(other, _)| *other != unknown);
        }
    }
}

impl State {
    /// Returns `true` if no contact is tensile and no gap is negative.
    pub(crate) fn is_least_energy(&self) -> bool {
        self.forces
            .iter()
            .chain(&self.gaps)
            .all(|number| !number.is_negative())
    }

    /// Returns the open contacts with negative gaps, the most negative first.
    fn overlapping(&self, open: &[bool]) -> Vec<usize> {
        let mut overlapping: Vec<usize> = (0..open.len())
            .filter(|c| open[*c] && self.gaps[*c].is_negative())
            .collect();
        overlapping.sort_by_key(|contact| ByValue(&self.gaps[*contact]));
        overlapping
    }

    /// Returns the contact with the largest tensile force.
    fn most_tensile(&self) -> Option<usize> {
        let forces = self.forces.iter().enumerate();
        let (contact, _) = forces
            .filter(|(_, force)| force.is_negative())
            .min_by_key(|(_, force)| ByValue(force))?;
        Some(contact)
    }
}

/// Returns the least number with its contact; of several, that of the first contact.
fn least(numbers: impl Iterator<Item = (BigRational, usize)>) -> Option<(BigRational, usize)> {
    numbers.min_by(|(a, first), (b, second)| (ByValue(a), first).cmp(&(ByValue(b), second)))
}

/// Returns the error for a system without a solution: cancellation, or a violated invariant.
fn unsolvable() -> cannonpile::Error {
    match check_interrupt() {
        Ok(()) => bug("the reduced equations are nonsingular"),
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

    /// Returns guesses for the set of open contacts: none, all, the horizontal ones, the sloping ones, every second
    /// and every third. Guesses with 24 or more closed horizontal contacts are left out, because their dense
    /// equations take a minute.
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

    /// The piles include weightless spheres, whose contacts have neither force nor gap.
    #[test]
    fn state_is_independent_of_guess() {
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

    /// Weightless discs under loads, with `guessed` contacts open at the start. Asserts which contacts overlap and
    /// which is tensile at first, and that the final state does not depend on the guess.
    fn assert_unique_state(
        (layers, loads): (i128, &[(i128, i128, i64)]),
        guessed: &[usize],
        (overlapping, tensile): (&[usize], Option<usize>),
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
        let columns = 0..springs.network.columns.len();
        let open = columns.map(|contact| guessed.contains(&contact));
        let system = springs.system(open.collect()).unwrap();
        let state = springs.state(&system, Cause::Weights).unwrap();
        assert_eq!(state.overlapping(&system.open), overlapping);
        assert_eq!(state.most_tensile(), tensile);
        let columns = 0..springs.network.columns.len();
        let guess = columns.map(|contact| f64::from(u8::from(guessed.contains(&contact))));
        let state = springs.least_energy(guess.collect()).unwrap();
        assert!(state.is_least_energy());
        let otherwise = vec![1.0; springs.network.columns.len()];
        let otherwise = springs.least_energy(otherwise).unwrap();
        assert_eq!(state.forces, otherwise.forces);
    }

    /// While the overlapping contact is closed, the horizontal contact becomes tensile half-way, and is opened at that
    /// point.
    #[test]
    fn closing_a_contact_opens_another() {
        let loads = [(0, 0, 5), (0, 1, 2), (1, 1, 2)];
        assert_unique_state((3, &loads), &[3], (&[3], None));
    }

    /// The tensile contact needs a gap of 5, but the gap of another contact reaches zero at 5/2.
    #[test]
    fn opening_a_contact_closes_another() {
        let loads = [(0, 0, 1), (0, 1, 2), (2, 2, 1)];
        assert_unique_state((4, &loads), &[12, 14], (&[], Some(13)));
    }

    #[test]
    fn unstable_pile_is_detected_from_every_guess() {
        let pile = Pile::under(Region::SITE, "++++-".parse().unwrap()).unwrap();
        assert_eq!(cannot_stand(&pile), Ok(true));
        let one = ratio(1, 1);
        let springs = springs(&pile, &one);
        for guess in guesses(&springs) {
            assert_eq!(springs.least_energy(guess).err(), Some(Error::CannotStand));
        }
    }
}
