//! Measured forces against exact ones.

use core::fmt;

use super::difference::{Difference, Extra};
use super::exact;
use super::pairs::Pairs;
use super::tally::Tally;
use super::{MAX_ENTRIES, Measured, Refusal};
use crate::{Error, Packing};

/// What was measured, compared with the exact forces of a pile: see [`verify`](super) for what that means.
///
/// # Examples
/// ```
/// use cannonpile::geometry::Spacing;
/// use cannonpile::verify::{Comparison, Measured};
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(2)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
/// let measured = [([1, 2], 0.46225016352102427), ([3, 1], 0.5)];
/// let measured = measured.map(|(ids, force)| Measured::new(ids, force));
/// let comparison = Comparison::new(&packing, measured)?;
///
/// assert_eq!((comparison.matched(), comparison.missing(), comparison.extra(0.0)), (2, 1, 0));
/// assert!((0.08..0.09).contains(&comparison.largest_error()));
/// assert_eq!(
///     comparison.worst().unwrap().to_string(),
///     "contact of sphere 1 (k=0, i=0, j=0) with sphere 3 along beta: measured 0.5 N, exact 0.46225016352102427 N",
/// );
/// assert!(!comparison.accepted(0.1));
/// # Ok::<(), cannonpile::verify::Refusal>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    pub(super) contacts: u64,
    pub(super) matched: u64,
    pub(super) missing: u64,
    pub(super) first_missing: Vec<Difference>,
    pub(super) fixed: u64,
    pub(super) largest_force: f64,
    /// What pairs without a contact carry, over the largest force, from the greatest down.
    pub(super) strays: Vec<f64>,
    pub(super) greatest_strays: Vec<Extra>,
    pub(super) worst: Option<Difference>,
    pub(super) rms: f64,
}

impl Comparison {
    /// Compares measured forces with those of a packing. Their order does not matter, nor which sphere of a pair is named
    /// first.
    ///
    /// Memory grows with what was measured; the exact forces are made row by row.
    ///
    /// # Errors
    /// [`Refusal::Entry`] for a number that no sphere has, a sphere paired with itself, a pair that is there twice, and a
    /// force that is not finite. [`Refusal::Scene`] with [`Error::TooLarge`] for more than [`MAX_ENTRIES`] contacts;
    /// [`Refusal::OutOfRange`] for exact forces beyond the normal `f64`.
    pub fn new(
        packing: &Packing<'_>,
        measured: impl IntoIterator<Item = Measured>,
    ) -> Result<Self, Refusal> {
        let pile = packing.pile();
        let contacts = pile.contacts();
        let count = u64::try_from(&contacts).ok();
        let Some(count) = count.filter(|count| *count <= MAX_ENTRIES) else {
            return Err(Refusal::Scene(Error::TooLarge {
                quantity: "a comparison of all contacts",
                needed: contacts,
                limit: MAX_ENTRIES,
                remedy: "use fewer layers, or a smaller top or base",
            }));
        };
        let numbering = pile.numbering()?;
        let mut pairs = Pairs::new(measured, &numbering)?;
        let mut tally = Tally::new(pile.dimension());
        for exact in exact::contacts(packing, &numbering, pairs.has_vectors())? {
            let exact = exact?;
            let measured = pairs.meet(exact.ids);
            tally.add(&exact, measured);
        }
        Ok(tally.close(count, &pairs, &numbering))
    }

    /// How many contacts the pile has.
    #[must_use]
    pub fn contacts(&self) -> u64 {
        self.contacts
    }

    /// How many of them were measured.
    #[must_use]
    pub fn matched(&self) -> u64 {
        self.matched
    }

    /// How many have a force and were not measured.
    #[must_use]
    pub fn missing(&self) -> u64 {
        self.missing
    }

    /// The first thousand of the missing contacts, from the top.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let comparison = Comparison::new(&packing, [Measured::new([1, 3], 0.46)])?;
    /// let ids: Vec<_> = comparison.missing_contacts().iter().map(|contact| contact.ids).collect();
    /// assert_eq!(ids, [[1, 2], [1, 4]]);
    /// # Ok::<(), cannonpile::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn missing_contacts(&self) -> &[Difference] {
        &self.first_missing
    }

    /// How many pairs that are no contacts of the pile carry more than `tolerance` times the largest exact force.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Spheres 2 and 3 are on the floor, and not judged: nothing is extra, though three contacts are missing.
    /// let comparison = Comparison::new(&packing, [Measured::new([2, 3], 0.46)])?;
    /// assert_eq!((comparison.extra(1e-6), comparison.fixed(), comparison.missing()), (0, 1, 3));
    /// # Ok::<(), cannonpile::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn extra(&self, tolerance: f64) -> u64 {
        let extra = self.strays.partition_point(|stray| *stray > tolerance);
        u64::try_from(extra).unwrap_or(u64::MAX)
    }

    /// How many pairs that are no contacts of the pile carry something, but no more than that.
    #[must_use]
    pub fn noise(&self, tolerance: f64) -> u64 {
        let all = u64::try_from(self.strays.len()).unwrap_or(u64::MAX);
        all - self.extra(tolerance)
    }

    /// The thousand pairs that carry the most without being contacts, from the greatest down, noise included.
    #[must_use]
    pub fn extra_pairs(&self) -> &[Extra] {
        &self.greatest_strays
    }

    /// How many pairs of spheres of the bottom layer were left out.
    #[must_use]
    pub fn fixed(&self) -> u64 {
        self.fixed
    }

    /// The largest exact force, by magnitude.
    #[must_use]
    pub fn largest_force(&self) -> f64 {
        self.largest_force
    }

    /// The largest relative error of a contact that was measured; infinite if there is a force where the whole pile has
    /// none.
    #[must_use]
    pub fn largest_error(&self) -> f64 {
        self.worst.as_ref().map_or(0.0, |worst| worst.error)
    }

    /// The root of the mean square of the relative errors of the contacts that were measured, to some 1e-8 of itself.
    #[must_use]
    pub fn rms_error(&self) -> f64 {
        self.rms
    }

    /// The contact with the largest relative error, the first of several; none if there was no contact measured.
    #[must_use]
    pub fn worst(&self) -> Option<&Difference> {
        self.worst.as_ref()
    }

    /// Whether nothing is missing, nothing extra, and no error over `tolerance`.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let measured = [2, 3, 4].map(|id| Measured::new([1, id], 0.462));
    /// let comparison = Comparison::new(&packing, measured)?;
    /// assert!(comparison.accepted(1e-3) && !comparison.accepted(1e-4));
    /// # Ok::<(), cannonpile::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn accepted(&self, tolerance: f64) -> bool {
        self.missing == 0 && self.extra(tolerance) == 0 && self.largest_error() <= tolerance
    }
}

impl fmt::Display for Comparison {
    /// One line, for the message of an assertion.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            contacts,
            matched,
            missing,
            rms,
            ..
        } = self;
        let (extra, largest) = (self.strays.len(), self.largest_error());
        write!(
            f,
            "{matched} of {contacts} contacts measured, {missing} missing, {extra} pairs beside them; \
             largest error {largest:e}, rms {rms:e}"
        )?;
        if let Some(worst) = self.worst() {
            write!(f, "; worst: {worst}")?;
        }
        if let Some(missing) = self.first_missing.first() {
            write!(f, "; missing: {missing}")?;
        }
        if let Some(extra) = self.greatest_strays.first() {
            write!(f, "; extra: {extra}")?;
        }
        Ok(())
    }
}
