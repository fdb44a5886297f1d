//! Census of the stackings that are stable at a = R with horizontal contacts, each with a certificate.
//!
//! # Under one sphere
//! Numbers of stable stackings of L layers, counting one of each mirror pair:
//!
//! | L | 1 | 2 | 3 | 4 | 5 | 6 and more |
//! |---|---|---|---|---|---|---|
//! | with horizontal contacts | 1 | 1 | 2 | 4 | 8 | 12 |
//! | [without](cannonpile_stability::census) | 1 | 1 | 2 | 4 | 8 | 11 |
//!
//! The additional stacking is (1,1,1,1,*) in Zhdanov's notation: five layers of HCP, continued by equal steps. The
//! proof that the number stops growing has four parts. The forces f and X ≥ 0 are those of
//! [`certificate`](crate::certificate).
//!
//! 1. *A run that ends in a sign change has at most three steps from the top, and at most four after a sign
//!    change.* Consider a run of + steps, and in each layer the spheres with the largest i. Only the contact along
//!    β loads such a sphere from above, and no horizontal contact leads further outwards. Hence the horizontal
//!    forces on it only add to f_β: f_β = g_β + 1 + (≥ 0). After r steps from the top, g_β ≥ r. After r steps from
//!    a sign change, f_β ≥ 0 is all that is known there, so g_β ≥ r − 1. At the next sign change g_α = g_γ = 0, and
//!    the same horizontal forces subtract: f_β = 1 − g_β/3 − (≥ 0). So g_β ≤ 3. The Farkas certificate is φ_β = 1
//!    on four spheres of the edge and −3 on the fifth, at the sign change. It has D ≤ 0, c ≤ 0 and work 4 − 3 > 0.
//!    The argument holds under any top and at any depth.
//! 2. *The first layers of a stable stacking are stable.* The layers below do not occur in the balance of the
//!    layers above, and the last of the first layers can serve as a fixed floor.
//! 3. *A stable stacking stays stable if its last step is repeated.* Below the last sign change X = 0 is
//!    admissible: f = g + w ≥ 0.
//! 4. *The remaining search is finite*, and [`under_one_sphere`] performs it. By 2 it proceeds from the top, by 3
//!    run by run, and by 1 with at most four steps in a run before a sign change. Each unstable prefix has a
//!    certificate. No stacking with five sign changes remains.
//!
//! # On a base
//! As without horizontal contacts, every stacking is extended upwards as far as the base permits ([`on_base`]), and
//! then tested.

use cannonpile::Pile;
use cannonpile::lattice::Region;
use cannonpile_stability::census::{StabilityTest, carried_up, search};

use crate::Error;
use crate::certificate::{Certificate, Claim};
use crate::stand::decided;

pub use crate::stand::DecidedBy;

/// A stacking with the proof that it is stable or unstable at a = R.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::census;
///
/// for entry in census::under_one_sphere(6, true)? {
///     assert_eq!(entry?.certificate.check(), Ok(()));
/// }
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Entry {
    /// The pile of the stacking.
    pub pile: Pile,
    /// The proof. For a pile of more than 10⁵ spheres it is about its first layers
    /// ([`equilibrium`](crate::equilibrium)).
    pub certificate: Certificate,
    /// The kind of proof.
    pub decided_by: DecidedBy,
}

impl Entry {
    /// Returns whether the stacking is stable.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_horizontal::census;
    ///
    /// let entries: Result<Vec<_>, _> = census::under_one_sphere(7, true)?.collect();
    /// assert_eq!(entries?.iter().filter(|entry| entry.stands()).count(), 12);
    /// # Ok::<(), cannonpile_horizontal::Error>(())
    /// ```
    #[must_use]
    pub fn stands(&self) -> bool {
        self.certificate.claim == Claim::Stands
    }
}

impl StabilityTest for Entry {
    type Error = Error;

    const ENTRIES: [i128; 2] = [12, 56];

    fn test(pile: Pile) -> Result<Self, Error> {
        let (certificate, decided_by) = decided(&pile)?;
        Ok(Self {
            pile,
            certificate,
            decided_by,
        })
    }

    fn stands(&self) -> bool {
        self.stands()
    }
}

/// Returns the stackings of `layers` layers under one sphere that are stable at a = R, ordered by their runs.
///
/// Of each mirror pair the one that begins with + is listed. With `failing` the shortest unstable prefixes are
/// listed as well. At most twelve stackings are stable (see the module documentation). Together with the unstable
/// prefixes there are 12L − 56 entries for L ≥ 6 layers.
///
/// # Errors
/// * [`Layers`](cannonpile::Error::Layers) unless 1 ≤ `layers` ≤ 10³⁶.
/// * [`TooManyRows`](cannonpile::Error::TooManyRows) if `failing` would give more than
///   [`MAX_ENTRIES`](cannonpile_stability::census::MAX_ENTRIES) entries.
///
/// The items contain no errors: a lemma or a small linear program decides every entry, and each of these programs has
/// been solved.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::census;
///
/// // The number does not depend on the number of layers.
/// let standing: Result<Vec<_>, _> = census::under_one_sphere(10_i128.pow(36), false)?.collect();
/// let standing = standing?;
/// assert_eq!(standing.len(), 12);
/// assert!(standing.iter().all(|entry| entry.certificate.check() == Ok(())));
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
pub fn under_one_sphere(
    layers: i128,
    failing: bool,
) -> Result<impl Iterator<Item = Result<Entry, Error>>, Error> {
    Ok(search(layers, failing)?)
}

/// Returns every stacking on a base, extended upwards as in [`census::on_base`](cannonpile_stability::census::on_base), with
/// the proof that it is stable or unstable at a = R.
///
/// # Errors
/// Returns [`TooManyRows`](cannonpile::Error::TooManyRows) if `cannonpile_stability::census::on_base` does so. Items
/// contain the errors of [`equilibrium`](crate::equilibrium).
///
/// # Examples
/// ```
/// use cannonpile::lattice::Region;
/// use cannonpile_horizontal::census;
///
/// let entries: Result<Vec<_>, _> = census::on_base(Region::hexagon(3, 4)?)?.collect();
/// let entries = entries?;
/// let horizontal = entries.iter().find(|entry| entry.decided_by == census::DecidedBy::Horizontal);
/// assert_eq!(horizontal.unwrap().pile.shape().stacking().to_string(), "-+-+-");
/// assert_eq!(entries.iter().filter(|entry| !entry.stands()).count(), 3);
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
pub fn on_base(base: Region) -> Result<impl Iterator<Item = Result<Entry, Error>>, Error> {
    Ok(carried_up(base)?)
}
