//! Which stackings stand at a = R, horizontal contacts included: each with a certificate.
//!
//! # Under one sphere
//! Of L layers there stand, one of each mirror pair, with horizontal contacts and without
//!
//! | L | 1 | 2 | 3 | 4 | 5 | 6 and more |
//! |---|---|---|---|---|---|---|
//! | with | 1 | 1 | 2 | 4 | 8 | 12 |
//! | [without](cannonpile::census) | 1 | 1 | 2 | 4 | 8 | 11 |
//!
//! The one more is (1,1,1,1,*) in Zhdanov's notation: five layers of HCP, and then straight for ever. The proof that the
//! number stops growing has four parts; f and X ≥ 0 are the forces of [`certificate`](crate::certificate).
//!
//! 1. *A run before a change has at most three steps from the top, four after a change.* Within a run of + steps take the
//!    spheres with the largest i of each layer. Nothing rests on them but along β, and no contact of theirs leads further
//!    out, so that of the horizontal ones those that push on them add to β what is ≥ 0: f_β = g_β + 1 + (≥ 0). After r
//!    steps from the top g_β ≥ r; after r steps from a change, where all that is known is f_β ≥ 0, g_β ≥ r − 1. If the sign
//!    changes there, g_α = g_γ = 0, and the same contacts now take away: f_β = 1 − g_β/3 − (≥ 0). So g_β ≤ 3. As a
//!    certificate: φ_β = 1 on four spheres of the edge, −3 on the fifth, where the sign changes. Then D ≤ 0 and c ≤ 0, and
//!    the work is 4 − 3 > 0. This holds under any top, and however far down.
//! 2. *The beginnings of what stands stand.* What lies below a layer changes no equation above it, and it can be held.
//! 3. *What stands does so with its last step repeated.* Below the last change of sign let X = 0: f = g + w ≥ 0.
//! 4. *The rest is a finite search* ([`under_one_sphere`] carries it out): by 2 from the top, by 3 run after run, and by 1
//!    with runs of at most four steps before a change. Each beginning that fails has a certificate, and none with a fifth
//!    change of sign is left.
//!
//! # On a base
//! As without horizontal contacts every stacking is carried as high as it goes ([`on_base`]), and looked at there.

use cannonpile::Pile;
use cannonpile::census::{Judged, carried_up, search};
use cannonpile::lattice::Region;

use crate::Error;
use crate::certificate::{Certificate, Claim};
use crate::stand::decided;

pub use crate::stand::DecidedBy;

/// A stacking, and the proof that it stands at a = R, or cannot.
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
    /// The pile of this stacking.
    pub pile: Pile,
    /// The proof; of its first layers, if it has more than 10⁵ spheres ([`equilibrium`](crate::equilibrium)).
    pub certificate: Certificate,
    /// What the proof rests on.
    pub decided_by: DecidedBy,
}

impl Entry {
    /// Whether it stands.
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

impl Judged for Entry {
    type Error = Error;

    const ENTRIES: [i128; 2] = [12, 56];

    fn judge(pile: Pile) -> Result<Self, Error> {
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

/// The stackings of `layers` layers under one sphere that stand at a = R, one of each mirror pair (the one that begins with
/// +); with `failing`, also the shortest beginnings that cannot. In order of their runs.
///
/// Of those that stand there are at most twelve (module documentation); with what fails there are 12L − 56 for six
/// layers or more.
///
/// # Errors
/// [`Layers`](cannonpile::Error::Layers) unless 1 ≤ `layers` ≤ 10³⁶; [`TooManyRows`](cannonpile::Error::TooManyRows) for
/// more than [`MAX_ENTRIES`](cannonpile::census::MAX_ENTRIES) with what fails. An entry is no error: all that is not decided by the lemmas is small, and was decided.
///
/// # Examples
/// ```
/// use cannonpile_horizontal::census;
///
/// // However many layers there are, no more than these stand.
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

/// Every stacking of a base, carried up as in [`census::on_base`](cannonpile::census::on_base), with whether it stands at a = R.
///
/// # Errors
/// [`TooManyRows`](cannonpile::Error::TooManyRows) as there; in an entry those of [`equilibrium`](crate::equilibrium).
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
