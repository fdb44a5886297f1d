//! Common parts of tests that are exported for the test suites of other codes. These tests take seconds, and contain the
//! whole pile.

use super::numbered::NumberedPile;
use crate::Error;
use cannonpile::engine::refuse_beyond;

/// The maximal number of spheres, because suites run many tests.
const MAX_SPHERES: u64 = 2000;

/// The accepted error, relative to the greatest force. With the springs of these tests, straight piles have a hundredth
/// of this error.
pub(super) const TOLERANCE: f64 = 1e-5;

/// The expected outcome of a test.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Outcome {
    /// The pile reaches equilibrium with its exact forces.
    Rests,
    /// Contacts are lost, because no compressive forces are in equilibrium.
    Falls,
    /// Undecided: weightless spheres where some contacts need a tensile force, or further contacts may support the
    /// pile.
    Unclear,
}

/// The properties of all contact forces that the tests need.
pub(super) struct Forces {
    /// The greatest force, in N.
    pub(super) greatest: f64,
    /// True if some contact has no force.
    pub(super) has_idle: bool,
    pub(super) outcome: Outcome,
}

impl Forces {
    /// Examines all contacts of a sufficiently small pile.
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
