//! Selection of a histogram: of contact forces, or of normal forces on the floor.

use super::{Histogram, WithFaults};

/// The forces that a histogram counts.
///
/// # Examples
/// See [`histograms`](Self::histograms).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Binned {
    /// Contact forces, in f₀.
    Forces,
    /// Normal forces of bottom spheres, in mg.
    Normals,
}

impl Binned {
    /// Returns the histograms of these forces: of all stackings with some number of faults, and of those that stand.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{Binned, Choice, Ensemble, FirstSign, RandomStackings, Shard};
    /// use cannonpile::lattice::Region;
    ///
    /// let stackings = RandomStackings::new(2, FirstSign::Plus)?;
    /// let tally = Ensemble::under(Region::SITE, stackings)?.run(&Choice::All, Shard::WHOLE)?;
    /// let [all, standing] = Binned::Normals.histograms(&tally.faults[0]);
    /// // Three bottom spheres bear 4/3, the fifth bin of a third.
    /// assert_eq!((all.count(4), standing.count(4)), (3_u32.into(), 3_u32.into()));
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn histograms(self, with: &WithFaults) -> [&Histogram; 2] {
        let of = [&with.all, &with.standing];
        match self {
            Self::Forces => of.map(|of| &of.forces),
            Self::Normals => of.map(|of| &of.normals),
        }
    }
}
