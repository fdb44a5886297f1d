//! Whether there are forces that only push.

use alloc::collections::BTreeMap;
use alloc::vec::Vec;
use core::iter::repeat_n;

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::census::DecidedBy;
use super::network::{Column, MOST_CERTIFIED, MOST_EQUATIONS, Network};
use super::program::{Aim, Closeness, Program, accepted};
use crate::certificate::{Certificate, Claim};
use crate::error::bug;
use crate::shape::Anchor;
use crate::stacking::{Run, Stacking};
use crate::{Error, Pile};

/// The layers above the one that is held in the first beginning that is looked at, if the pile fails no further down.
const FIRST: i128 = 6;

/// What all pulls may come to in floats, of weights of order 1, if there are none.
const NO_PULL: f64 = 1e-5;

impl Pile {
    /// Returns a certificate that the pile stands at a = R, with horizontal contacts, or that it cannot.
    ///
    /// A run that is too long before a change of sign is found at once ([`census`](crate::horizontal::census)). Where the
    /// sloping contacts alone bear it nothing is computed but [`standing`](Self::standing). Below the last
    /// change of sign nothing has to be looked at, since there every force only grows; and of what is above it first the
    /// beginnings, since a pile stands only if each of them does. Of a pile of more than 10⁵ spheres the certificate is
    /// that of its first layers, by the same reasons: its [`pile`](Certificate::pile) are these.
    ///
    /// The horizontal forces that a pile was given are left out.
    ///
    /// # Errors
    /// [`Error::NoHorizontalContacts`]; [`Error::TooLarge`] if more than 15,000 equations would have to be solved;
    /// [`Error::NotSolved`] if they are, in floats, and what comes of it is no proof; as for
    /// [`standing`](Self::standing).
    ///
    /// # Examples
    /// ```
    /// use cannonpile::Pile;
    /// use cannonpile::certificate::Claim;
    /// use cannonpile::lattice::Region;
    ///
    /// // Six layers of HCP do not stand without horizontal contacts.
    /// let pile = Pile::under(Region::SITE, "+-+-+".parse()?)?;
    /// assert_eq!(pile.first_failure()?, Some(4));
    /// let certificate = pile.equilibrium()?;
    /// assert_eq!(certificate.claim, Claim::Stands);
    /// assert_eq!(certificate.check(), Ok(()));
    /// # Ok::<(), cannonpile::Error>(())
    /// ```
    pub fn equilibrium(&self) -> Result<Certificate, Error> {
        self.decided().map(|(certificate, _)| certificate)
    }

    /// Whether it is in equilibrium, with the proof, and what decides it.
    pub(super) fn decided(&self) -> Result<(Certificate, DecidedBy), Error> {
        self.check_horizontal()?;
        self.clone().without_horizontal_forces().decided_bare()
    }

    fn decided_bare(&self) -> Result<(Certificate, DecidedBy), Error> {
        if let Some(certificate) = self.too_long_run()? {
            return Ok((certificate, DecidedBy::Run));
        }
        // Held is what lies under the last change of sign.
        let shape = self.shape();
        let last_run = shape.stretch(shape.stacking().changes());
        let Some(failure) = self.first_failure()? else {
            let pile = match last_run {
                Some(run) => self.certified_down_to(run.from + 1)?,
                None => self.clone(),
            };
            return Ok((pile.certified(Claim::Stands), DecidedBy::Sloping));
        };
        let last_run = last_run.ok_or_else(|| bug("a pile that fails has a step"))?;
        let last = last_run.from + 1;
        let mut floor = (failure + 1).max(FIRST).min(last);
        loop {
            let certificate = self.equilibrium_above(floor, floor == last)?;
            match certificate.claim {
                Claim::CannotStand => return Ok((certificate, DecidedBy::Work)),
                _ if floor == last => return Ok((certificate, DecidedBy::Horizontal)),
                _ => floor = (floor + floor / 2).min(last),
            }
        }
    }

    /// Whether it is known that no forces balance it which only push.
    pub(super) fn cannot_stand(&self) -> bool {
        let certificate = self.equilibrium();
        certificate.is_ok_and(|certificate| certificate.claim == Claim::CannotStand)
    }

    /// Why a program over its forces, of so many equations, has no solution.
    pub(super) fn unsolved(&self, equations: usize) -> Error {
        if self.cannot_stand() {
            Error::CannotStand
        } else {
            Error::NotSolved { equations }
        }
    }

    /// The pile itself, or, if it is large, its layers down to one.
    pub(super) fn certified_down_to(&self, floor: i128) -> Result<Self, Error> {
        if self.sphere_count() <= MOST_CERTIFIED.into() {
            Ok(self.clone())
        } else {
            self.beginning(floor)
        }
    }

    /// The layers down to one, as a pile of their own.
    fn beginning(&self, floor: i128) -> Result<Self, Error> {
        let shape = self.shape();
        let mut left = floor;
        let runs = shape.stacking().runs().map_while(|run| {
            let steps = run.steps.min(left);
            left -= steps;
            (steps > 0).then_some(Run { steps, ..run })
        });
        let stacking = Stacking::from_runs(runs)?;
        let pile = match shape.anchor() {
            Anchor::Top(top) => Self::under(top, stacking)?,
            Anchor::Base(_) => Self::on(shape.layer(floor)?, stacking)?,
        };
        let mut pile = if self.is_weightless() {
            pile.weightless()
        } else {
            pile
        };
        for (site, weight) in self.weights().filter(|(site, _)| site.k <= floor) {
            pile = pile.with_weight(site, weight.clone())?;
        }
        for (site, load) in self.loads().filter(|(site, _)| site.k <= floor) {
            pile = pile.with_load(site, load.clone())?;
        }
        Ok(pile)
    }

    pub(super) fn certified(self, claim: Claim) -> Certificate {
        Certificate {
            pile: self,
            claim,
            horizontal: BTreeMap::new(),
            field: BTreeMap::new(),
        }
    }

    /// Of the layers above one that is held: the least sum of all pulls is 0, or a field proves that it is not. Below
    /// them forces only grow, if they are the whole.
    fn equilibrium_above(&self, floor: i128, is_whole: bool) -> Result<Certificate, Error> {
        let network = Network::above(self, floor, MOST_EQUATIONS)?;
        let (equations, unknowns) = (network.weights.len(), network.columns.len());
        let not_solved = || Error::NotSolved { equations };
        let pulls = network.columns[..equations].iter();
        let pulls = pulls.map(|column| {
            column
                .iter()
                .map(|(equation, c)| (*equation, -c.clone()))
                .collect()
        });
        let cost =
            repeat_n(BigRational::zero(), unknowns).chain(repeat_n(BigRational::one(), equations));
        let with_pulls: Vec<Column> = network.columns.iter().cloned().chain(pulls).collect();
        let program = Program {
            columns: with_pulls.as_slice().into(),
            sums: network.weights.clone(),
            aim: Aim::Cost(cost.collect()),
        };
        let (program, scale) = program.scaled();
        let mut guess = program.guess(Closeness::Tight).ok_or_else(not_solved)?;
        // What is said is checked, whatever floats say.
        let stands = guess.unknowns[unknowns..].iter().sum::<f64>() < NO_PULL;
        // What cannot stand cannot with more below it; what stands does so as far as it was looked at.
        let pile = if is_whole || !stands {
            self.certified_down_to(floor)?
        } else {
            self.beginning(floor)?
        };
        let certificate = if stands {
            // Without the pulls.
            guess.unknowns.truncate(unknowns);
            guess.positive.truncate(unknowns);
            program.exact_unknowns(&guess).map(|forces| {
                let forces = network.horizontal(&forces);
                Certificate {
                    horizontal: forces
                        .map(|(contact, force)| (contact, force * &scale))
                        .collect(),
                    ..pile.certified(Claim::Stands)
                }
            })
        } else {
            program
                .exact_multipliers(&guess)
                .map(|multipliers| Certificate {
                    field: network.field(&multipliers).collect(),
                    ..pile.certified(Claim::CannotStand)
                })
        };
        accepted(certificate.ok_or_else(not_solved)?, not_solved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lattice::Region;

    #[test]
    fn what_has_no_solution_cannot_stand_or_was_not_solved() {
        let unsolved = |stacking: &str| {
            let pile = Pile::under(Region::SITE, stacking.parse().unwrap()).unwrap();
            pile.unsolved(7)
        };
        assert_eq!(unsolved("+++"), Error::NotSolved { equations: 7 });
        // A run of five steps before a change of sign.
        assert_eq!(unsolved("+++++-"), Error::CannotStand);
    }
}
