//! Measured forces against exact ones.

use core::fmt;

use super::difference::{Difference, Extra};
use super::finding::Finding;
use super::ledger::Ledger;
use super::measured::Measured;
use super::refusal::Refusal;
use super::tally::Judged;
use cannonpile::{Interrupt, Packing};

/// What was measured, compared with the exact forces of a pile: see [`verify`](super) for what that means.
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
    /// Compares measured forces with those of a packing. Their order does not matter, nor which sphere of a pair is named
    /// first.
    ///
    /// Memory grows with what was measured; the exact forces are made row by row.
    ///
    /// # Errors
    /// [`Refusal::Entry`] for a number that no sphere has, a sphere paired with itself, a pair that is there twice, and a
    /// force that is not finite. [`Refusal::Scene`] with [`Error::TooLarge`](cannonpile::Error::TooLarge) for more contacts than are kept;
    /// [`Refusal::OutOfRange`] for exact forces beyond the normal `f64`.
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
    /// // A pair is listed once, whichever sphere is named first.
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

    /// What a ledger has judged.
    pub(super) fn of(judged: Judged) -> Self {
        Self(judged)
    }

    /// How many contacts the pile has.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::Comparison;
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(10)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Measured or not.
    /// assert_eq!(Comparison::new(&packing, [])?.contacts(), 495);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn contacts(&self) -> u64 {
        self.0.contacts
    }

    /// How many of them were measured.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Neither a force of 0 where there is one, nor a pair that is no contact.
    /// let measured = [([1, 2], 0.46), ([1, 3], 0.0), ([2, 3], 0.1)].map(|(ids, force)| Measured::new(ids, force));
    /// assert_eq!(Comparison::new(&packing, measured)?.matched(), 1);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn matched(&self) -> u64 {
        self.0.matched()
    }

    /// How many have a force and were not measured.
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
    /// // The load goes down on three lines; the other contacts have no force.
    /// let comparison = Comparison::new(&packing, [])?;
    /// assert_eq!((comparison.missing(), comparison.contacts()), (6, 12));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn missing(&self) -> u64 {
        self.0.missing
    }

    /// The first thousand of the missing contacts, from the top.
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

    /// How many pairs that are no contacts of the pile carry more than `tolerance` times the largest exact force.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Spheres 2 and 3 are on the floor, and not judged: nothing is extra, though three contacts are missing.
    /// let comparison = Comparison::new(&packing, [Measured::new([2, 3], 0.46)])?;
    /// assert_eq!((comparison.extra(1e-6), comparison.fixed(), comparison.missing()), (0, 1, 3));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn extra(&self, tolerance: f64) -> u64 {
        Judged::over(&self.0.strays, tolerance)
    }

    /// How many pairs that are no contacts of the pile carry something, but no more than that.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Neighbours in a layer, which do not touch at a = 1.2 R.
    /// let comparison = Comparison::new(&packing, [Measured::new([2, 3], 0.001)])?;
    /// assert_eq!((comparison.noise(0.01), comparison.noise(1e-6)), (1, 0));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn noise(&self, tolerance: f64) -> u64 {
        self.0.strays.len() as u64 - self.extra(tolerance)
    }

    /// The thousand pairs that carry the most without being contacts, from the greatest down, noise included.
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

    /// How many pairs of spheres of the bottom layer were left out.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Spheres 5 to 10 are on the floor; a pair with one above it is judged.
    /// let measured = [[5, 6], [10, 7], [1, 5]].map(|ids| Measured::new(ids, 0.1));
    /// let comparison = Comparison::new(&packing, measured)?;
    /// assert_eq!((comparison.fixed(), comparison.extra(0.0)), (2, 1));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn fixed(&self) -> u64 {
        self.0.fixed
    }

    /// The largest exact force, by magnitude.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::Comparison;
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(3)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Of two spheres on a line, whatever was measured.
    /// let comparison = Comparison::new(&packing, [])?;
    /// assert_eq!(comparison.largest_force(), 2.0 * 0.46225016352102427);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn largest_force(&self) -> f64 {
        self.0.largest_force
    }

    /// The largest relative error of a contact that was measured; infinite if there is a force where the whole pile has
    /// none.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?.weightless();
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Nothing presses anywhere.
    /// let compare = |force| Comparison::new(&packing, [Measured::new([1, 2], force)]);
    /// assert_eq!([compare(0.0)?, compare(1e-9)?].map(|compared| compared.largest_error()), [0.0, f64::INFINITY]);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn largest_error(&self) -> f64 {
        self.0.worst.as_ref().map_or(0.0, |worst| worst.error)
    }

    /// How many of the contacts that were measured have a relative error over `tolerance`.
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

    /// The factor by which all measured forces differ from the exact ones, if there is one other than 1: they are the
    /// exact ones times this, with relative errors up to `tolerance`. None for fewer than two contacts with a force.
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

    /// What the differences have in common, where the data show it: see [`Finding`]; nothing if all is accepted.
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

    /// The root of the mean square of the relative errors of the contacts that were measured, to some 1e-8 of itself.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // One force right, and one twice what it should be.
    /// let measured = [([1, 2], 0.46225016352102427), ([1, 3], 2.0 * 0.46225016352102427)];
    /// let comparison = Comparison::new(&packing, measured.map(|(ids, force)| Measured::new(ids, force)))?;
    /// assert!((comparison.rms_error() - 0.5_f64.sqrt()).abs() < 1e-8);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn rms_error(&self) -> f64 {
        self.0.rms_error()
    }

    /// The contact with the largest relative error, the first of several; none if there was no contact measured.
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

    /// Whether nothing is missing, nothing extra, and no error over `tolerance`.
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
    /// One line, for the message of an assertion.
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
