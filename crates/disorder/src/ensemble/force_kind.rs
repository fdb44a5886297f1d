//! Selection of a histogram: contact forces or normal forces.

use super::{Histogram, WithFaults};
use crate::Each;

/// The forces that a histogram counts.
///
/// # Examples
/// See [`histograms`](Self::histograms).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ForceKind {
    /// Contact forces, in f₀.
    Contact,
    /// Normal forces of bottom spheres, in mg.
    Normal,
}

impl ForceKind {
    /// Returns the histograms of these forces, of all stackings and of the standing ones with the same number of
    /// faults.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{ForceKind, Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(2, FirstSign::Plus)?;
    /// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
    /// let [all, standing] = ForceKind::Normal.histograms(&tally.faults[0]);
    /// // The normal force of the three bottom spheres is 4/3, in the fifth bin of width 1/3.
    /// assert_eq!((all.count(4), standing.count(4)), (3_u32.into(), 3_u32.into()));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn histograms(self, with: &WithFaults) -> [&Histogram; 2] {
        let of = [&with.all, &with.standing];
        match self {
            Self::Contact => of.each(|of| &of.forces),
            Self::Normal => of.each(|of| &of.normals),
        }
    }
}
