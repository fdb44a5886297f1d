//! What tests in the suites of other codes have in common: they take seconds, and hold all of their pile.

use super::numbered::NumberedPile;
use crate::Error;
use cannonpile::engine::refuse_beyond;

/// The most spheres of a test that runs beside many others.
const MAX_SPHERES: u64 = 2000;

/// The error that is let pass, of the greatest force: of springs as stiff as here it is a hundredth of that in straight piles.
pub(super) const TOLERANCE: f64 = 1e-5;

/// What a suite is to do with the pile.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Outcome {
    /// It comes to rest with its exact forces.
    Rests,
    /// Contacts are lost: no forces that only push are in balance.
    Falls,
    /// Neither: spheres without weight, some contacts of which would have to pull; or further contacts may hold it.
    Unclear,
}

/// What the tests have to know of all contact forces.
pub(super) struct Forces {
    /// The greatest, in N.
    pub(super) greatest: f64,
    /// Whether a contact bears none.
    pub(super) has_idle: bool,
    pub(super) outcome: Outcome,
}

impl Forces {
    /// Looks at all contacts of a pile that is small enough.
    pub(super) fn of(pile: &NumberedPile<'_>) -> Result<Self, Error> {
        let spheres = pile.numbering().sphere_count();
        refuse_beyond(
            "a test of a suite",
            spheres,
            MAX_SPHERES,
            "use fewer layers, or --to lammps,yade",
        )?;
        let (mut greatest, mut has_idle, mut pulls) = (0.0_f64, false, false);
        for contact in pile.forces()? {
            let force = contact?.force;
            greatest = greatest.max(force.abs());
            has_idle |= force == 0.0;
            pulls |= force < 0.0;
        }
        let may_be_held = !pile.packing().touching().is_empty();
        let outcome = match (pulls, pile.pile().is_weightless() || may_be_held) {
            (false, _) => Outcome::Rests,
            (true, false) => Outcome::Falls,
            (true, true) => Outcome::Unclear,
        };
        Ok(Self {
            greatest,
            has_idle,
            outcome,
        })
    }
}
