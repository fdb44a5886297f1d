//! The tilts of gravity that a pile bears at a = R, with horizontal contacts.

use cannonpile::Pile;
use cannonpile::lattice::{Dimension, Region};
use cannonpile::shape::Anchor;
use cannonpile_stability::{Affine, Margin, Tilts, above_last_run, tilts_by_oracle};
use num_rational::BigRational;

use crate::certificate::{Certificate, Claim, work};
use crate::{Each, Error, equilibrium};

/// Returns the tilts of gravity that a pile bears at a = R, where horizontal contacts may help, in the units of
/// [`Pile::with_tilt`].
///
/// The polygon is found as in [`cannonpile_stability::tilts`], with [`equilibrium`] in place of the forces of the
/// sloping contacts. A certificate that the pile is unstable under some tilt has the virtual work Σ w φ > 0. This work
/// is an affine function of the tilt, so the same field proves the pile unstable on one side of a line. The margin
/// names the certificate of its line, for a tilt beyond it.
///
/// # Errors
/// As for [`equilibrium`]; [`NoWeight`](cannonpile_stability::Error::NoWeight) for a pile that no tilt affects.
///
/// # Examples
/// ```
/// use cannonpile::lattice::Region;
/// use cannonpile::{Pile, ratio};
/// use cannonpile_horizontal::tilts;
///
/// // Without horizontal contacts three layers of discs bear the tilt 1. With them they bear no more, as the top disc
/// // rolls off.
/// let tilts = tilts(&Pile::discs(3)?)?;
/// assert_eq!(tilts.margin.unwrap().squared, ratio!(1));
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
pub fn tilts(pile: &Pile) -> Result<Tilts<Certificate>, Error> {
    let pile = pile.clone().without_horizontal_forces();
    tilts_by_oracle(&pile, |tilt| {
        let certificate = equilibrium(&pile.clone().with_tilt(tilt.clone())?)?;
        if certificate.claim == Claim::Stands {
            return Ok(None);
        }
        let along_y = i128::from(pile.dimension() == Dimension::Three);
        let tension = |tilt: [i128; 2]| {
            let tilt = tilt.each(|n| BigRational::from_integer(n.into()));
            let leaning = pile.clone().with_tilt(tilt)?;
            Ok::<_, Error>(-work(&leaning, &certificate.field))
        };
        let force = Affine::through([tension([0, 0])?, tension([1, 0])?, tension([0, along_y])?]);
        Ok(Some((force, certificate)))
    })
}

/// Returns the least tilt at which a pile becomes unstable at a = R, as [`tilts`] does.
///
/// A pile under one sphere is cut off below its last sign change, like in [`cannonpile_stability::margin`], and the
/// certificate is for the upper part. The top sphere has no horizontal contacts, so the margin is at most ½, and up to
/// this tilt no further layer changes it.
///
/// # Errors
/// As for [`tilts`].
///
/// # Examples
/// ```
/// use cannonpile::{Pile, ratio};
/// use cannonpile_horizontal::margin;
///
/// let pile = Pile::triangular(10_i128.pow(30))?;
/// assert_eq!(margin(&pile)?.unwrap().squared, ratio!(1/4));
/// # Ok::<(), cannonpile_horizontal::Error>(())
/// ```
pub fn margin(pile: &Pile) -> Result<Option<Margin<Certificate>>, Error> {
    let one_sphere = pile.shape().anchor() == Anchor::Top(Region::SITE);
    let short = if one_sphere {
        above_last_run(pile)?
    } else {
        None
    };
    Ok(tilts(short.as_ref().unwrap_or(pile))?.margin)
}
