//! Comparison of measured forces with exact forces.

use core::fmt;

use super::difference::{Difference, Extra};
use super::finding::Finding;
use super::ledger::Ledger;
use super::measured::Measured;
use super::refusal::Refusal;
use super::tally::Judged;
use cannonpile::{Interrupt, Packing};

/// Measured forces compared with the exact forces of a pile. The module [`verify`](super) defines the errors.
///
/// # Examples
/// ```
/// use cannonpile::geometry::Spacing;
/// use cannonpile_dem::verify::{Comparison, Measured};
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
/// # Ok::<(), cannonpile_dem::verify::Refusal>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison(Judged);

impl Comparison {
    /// Compares measured forces with those of a packing. The order of the list does not matter, nor the order of the
    /// two spheres in a pair.
    ///
    /// Memory grows with the number of measured forces. The exact forces are computed row by row.
    ///
    /// # Errors
    /// [`Refusal::Entry`] for a sphere number outside the pile, a sphere paired with itself, a repeated pair, or a
    /// force that is not finite. [`Refusal::Scene`] with [`Error::TooLarge`](cannonpile::Error::TooLarge) for a pile
    /// with too many contacts. [`Refusal::OutOfRange`] for exact forces outside the normal range of `f64`.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let [one, other] = [Measured::new([1, 2], 0.46), Measured::new([3, 1], 0.47)];
    /// let comparison = Comparison::new(&packing, [one, other])?;
    /// assert_eq!(Comparison::new(&packing, [other.reversed(), one.reversed()])?, comparison);
    /// // Each pair is listed once, in either order.
    /// assert!(Comparison::new(&packing, [one, one.reversed()]).is_err());
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    pub fn new(
        packing: &Packing<'_>,
        measured: impl IntoIterator<Item = Measured>,
    ) -> Result<Self, Refusal> {
        let mut ledger = Ledger::new(packing)?;
        for (entry, measured) in (1..).zip(measured) {
            Interrupt::check()?;
            let admitted = ledger.admit(&measured, entry);
            admitted.map_err(|fault| Refusal::Entry { entry, fault })?;
        }
        let (judged, _) = ledger.judge(false)?;
        Ok(Self(judged))
    }

    /// Returns the comparison that a ledger has computed.
    pub(super) fn of(judged: Judged) -> Self {
        Self(judged)
    }

    /// Returns the number of contacts of the pile, measured or not.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::Comparison;
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // No contact was measured here.
    /// assert_eq!(Comparison::new(&packing, [])?.contacts(), 495);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn contacts(&self) -> u64 {
        self.0.contacts
    }

    /// Returns the number of contacts that were measured.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Not counted: a force of 0 at a loaded contact, and a pair without a contact.
    /// let measured = [([1, 2], 0.46), ([1, 3], 0.0), ([2, 3], 0.1)].map(|(ids, force)| Measured::new(ids, force));
    /// assert_eq!(Comparison::new(&packing, measured)?.matched(), 1);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn matched(&self) -> u64 {
        self.0.matched()
    }

    /// Returns the number of contacts with a force that were not measured.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile::lattice::Site;
    /// # use cannonpile_dem::verify::Comparison;
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(3)?.weightless().with_load(Site::APEX, BigRational::from_integer(1.into()))?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Three lines of contacts carry the load. All other contacts have no force.
    /// let comparison = Comparison::new(&packing, [])?;
    /// assert_eq!((comparison.missing(), comparison.contacts()), (6, 12));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn missing(&self) -> u64 {
        self.0.missing
    }

    /// Returns the missing contacts from the top down, at most a thousand.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let comparison = Comparison::new(&packing, [Measured::new([1, 3], 0.46)])?;
    /// let ids: Vec<_> = comparison.missing_contacts().iter().map(|contact| contact.ids).collect();
    /// assert_eq!(ids, [[1, 2], [1, 4]]);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn missing_contacts(&self) -> &[Difference] {
        &self.0.first_missing
    }

    /// Returns the number of pairs without a contact whose force exceeds `tolerance` times the largest exact force.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Spheres 2 and 3 are on the floor, so their pair is not judged. No pair is extra, although three contacts are
    /// // missing.
    /// let comparison = Comparison::new(&packing, [Measured::new([2, 3], 0.46)])?;
    /// assert_eq!((comparison.extra(1e-6), comparison.fixed(), comparison.missing()), (0, 1, 3));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn extra(&self, tolerance: f64) -> u64 {
        Judged::over(&self.0.strays, tolerance)
    }

    /// Returns the number of pairs without a contact whose force is not 0, but at most `tolerance` times the
    /// largest exact force.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Neighbours in a layer do not touch at a = 1.2 R.
    /// let comparison = Comparison::new(&packing, [Measured::new([2, 3], 0.001)])?;
    /// assert_eq!((comparison.noise(0.01), comparison.noise(1e-6)), (1, 0));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn noise(&self, tolerance: f64) -> u64 {
        self.0.strays.len() as u64 - self.extra(tolerance)
    }

    /// Returns the pairs without a contact and with the largest forces, in decreasing order, at most a thousand. They
    /// include noise.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let measured = [Measured::new([2, 3], 0.1), Measured::new([4, 3], 0.2)];
    /// let comparison = Comparison::new(&packing, measured)?;
    /// let ids: Vec<_> = comparison.extra_pairs().iter().map(|pair| pair.ids).collect();
    /// assert_eq!(ids, [[3, 4], [2, 3]]);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn extra_pairs(&self) -> &[Extra] {
        &self.0.greatest_strays
    }

    /// Returns the number of pairs that were not judged because both spheres are in the bottom layer.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Spheres 5 to 10 are on the floor. A pair with one sphere above the floor is judged.
    /// let measured = [[5, 6], [10, 7], [1, 5]].map(|ids| Measured::new(ids, 0.1));
    /// let comparison = Comparison::new(&packing, measured)?;
    /// assert_eq!((comparison.fixed(), comparison.extra(0.0)), (2, 1));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn fixed(&self) -> u64 {
        self.0.fixed
    }

    /// Returns the largest magnitude of an exact force, in N.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::Comparison;
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // The largest force carries the increments of two spheres on a line. The measurement is irrelevant.
    /// let comparison = Comparison::new(&packing, [])?;
    /// assert_eq!(comparison.largest_force(), 2.0 * 0.46225016352102427);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn largest_force(&self) -> f64 {
        self.0.largest_force
    }

    /// Returns the largest relative error of the measured contacts. It is infinite if a force was measured in a pile
    /// without any force.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?.weightless();
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // No contact of this pile has a force.
    /// let compare = |force| Comparison::new(&packing, [Measured::new([1, 2], force)]);
    /// assert_eq!([compare(0.0)?, compare(1e-9)?].map(|compared| compared.largest_error()), [0.0, f64::INFINITY]);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn largest_error(&self) -> f64 {
        self.0.worst.as_ref().map_or(0.0, |worst| worst.error)
    }

    /// Returns the number of measured contacts whose relative error exceeds `tolerance`.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let measured = [([1, 2], 0.46225), ([1, 3], 0.462), ([1, 4], 0.5)];
    /// let comparison = Comparison::new(&packing, measured.map(|(ids, force)| Measured::new(ids, force)))?;
    /// assert_eq!([1e-2, 1e-4, 0.0].map(|tolerance| comparison.beyond(tolerance)), [1, 2, 3]);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn beyond(&self, tolerance: f64) -> u64 {
        Judged::over(&self.0.errors, tolerance)
    }

    /// Returns the common factor between measured and exact forces, if it differs from 1. Each measured force equals
    /// this factor times the exact one, within a relative error of `tolerance`. `None` for fewer than two contacts with
    /// a force.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // A simulation at g = 9.81 m/s², compared with a pile at 1 m/s².
    /// let measured = [2, 3, 4].map(|id| Measured::new([1, id], 9.81 * 0.462250163));
    /// let comparison = Comparison::new(&packing, measured)?;
    /// assert!((comparison.common_factor(1e-6).unwrap() - 9.81).abs() < 1e-6);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn common_factor(&self, tolerance: f64) -> Option<f64> {
        self.0.symptoms.factor(tolerance)
    }

    /// Explains the differences: one wrong factor, swapped axes, a missing layer (see [`Finding`]). The list
    /// is empty if the comparison is accepted at `tolerance`.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Finding, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let weighed = [2, 3, 4].map(|id| Measured::new([1, id], 9.81 * 0.46225016352102427));
    /// let comparison = Comparison::new(&packing, weighed)?;
    /// let [Finding::Factor(factor)] = comparison.findings(1e-6)[..] else { panic!() };
    /// assert!((factor - 9.81).abs() < 1e-12);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn findings(&self, tolerance: f64) -> Vec<Finding> {
        if self.accepted(tolerance) {
            return Vec::new();
        }
        self.0.symptoms.findings(tolerance)
    }

    /// Returns the root mean square of the relative errors of the measured contacts, accurate to about 1e-8 of its
    /// value.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // One force is correct, and the other is twice the exact one.
    /// let measured = [([1, 2], 0.46225016352102427), ([1, 3], 2.0 * 0.46225016352102427)];
    /// let comparison = Comparison::new(&packing, measured.map(|(ids, force)| Measured::new(ids, force)))?;
    /// assert!((comparison.rms_error() - 0.5_f64.sqrt()).abs() < 1e-8);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn rms_error(&self) -> f64 {
        self.0.rms_error()
    }

    /// Returns the measured contact with the largest relative error, or the first of several. `None` if no contact was
    /// measured.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let measured = [([1, 4], 0.5), ([1, 3], 0.5), ([1, 2], 0.46)].map(|(ids, force)| Measured::new(ids, force));
    /// let comparison = Comparison::new(&packing, measured)?;
    /// assert_eq!(comparison.worst().map(|contact| contact.ids), Some([1, 3]));
    /// assert_eq!(Comparison::new(&packing, [])?.worst(), None);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn worst(&self) -> Option<&Difference> {
        self.0.worst.as_ref()
    }

    /// Returns whether no contact is missing, no pair is extra, and every relative error is at most `tolerance`.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let measured = [2, 3, 4].map(|id| Measured::new([1, id], 0.462));
    /// let comparison = Comparison::new(&packing, measured)?;
    /// assert!(comparison.accepted(1e-3) && !comparison.accepted(1e-4));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn accepted(&self, tolerance: f64) -> bool {
        self.missing() == 0 && self.extra(tolerance) == 0 && self.largest_error() <= tolerance
    }
}

impl fmt::Display for Comparison {
    /// Writes one line, for the message of an assertion.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Judged {
            contacts, missing, ..
        } = self.0;
        let (matched, rms) = (self.matched(), self.rms_error());
        let (extra, largest) = (self.0.strays.len(), self.largest_error());
        write!(
            f,
            "{matched} of {contacts} contacts measured, {missing} missing, {extra} pairs besides them; \
             largest error {largest:e}, rms {rms:e}"
        )?;
        if let Some(worst) = self.worst() {
            write!(f, "; worst: {worst}")?;
        }
        if let Some(missing) = self.0.first_missing.first() {
            write!(f, "; missing: {missing}")?;
        }
        if let Some(extra) = self.0.greatest_strays.first() {
            write!(f, "; extra: {extra}")?;
        }
        Ok(())
    }
}
