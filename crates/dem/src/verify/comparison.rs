//! Comparison of measured forces with exact forces.

mod findings;
mod verdict;

use super::difference::{Difference, Extra};
use super::ledger::Ledger;
use super::measured::{Measured, over};
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
/// assert!((0.08..0.09).contains(&comparison.largest_error().unwrap()));
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
    /// * [`Refusal::Entry`] for a sphere paired with itself, and for a force that is not finite.
    /// * [`Refusal::Entry`] for a third entry of a pair, and for a second one in the same order with another force.
    /// * [`Refusal::Entry`] for a sphere number outside the pile. A bottom sphere may touch a wall of any other number.
    /// * [`Refusal::Scene`] with [`Error::TooLarge`](cannonpile::Error::TooLarge) for a pile with too many contacts.
    /// * [`Refusal::OutOfRange`] for exact forces outside the normal range of `f64`.
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
    /// // Each pair is listed once, or once in each order.
    /// assert_eq!(Comparison::new(&packing, [one, one.reversed()])?.repeated(), 1);
    /// assert!(Comparison::new(&packing, [one, one, one]).is_err());
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    pub fn new(
        packing: &Packing<'_>,
        measured: impl IntoIterator<Item = Measured>,
    ) -> Result<Self, Refusal> {
        Self::fill(Ledger::new(packing)?, measured)
    }

    fn fill(
        mut ledger: Ledger<'_>,
        measured: impl IntoIterator<Item = Measured>,
    ) -> Result<Self, Refusal> {
        for (entry, measured) in (1..).zip(measured) {
            Interrupt::check()?;
            ledger.count(entry).map_err(of_entry)?;
            let admitted = ledger.admit(&measured, entry);
            admitted.map_err(|fault| Refusal::Entry { entry, fault })?;
        }
        let (judged, _) = ledger.judge().map_err(of_entry)?;
        Ok(Self(judged))
    }

    /// Compares measured forces with those of a pile on a rough floor: normal and tangential forces, and the whole forces of the
    /// floor. A vector without [`tangential`](Measured::tangential) is the whole force on the first sphere.
    ///
    /// # Errors
    /// As for [`new`](Self::new) and [`RoughPacking::new`](cannonpile_stability::RoughPacking::new).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_dem::verify::{Comparison, Measured};
    /// use cannonpile::{Packing, Pile};
    ///
    /// let pile = Pile::discs(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// // The force on the upper disc has a vertical part of 1/2 mg, and a horizontal one of 1/2 mg·tan(θ/2), here 1/6.
    /// let measured = [([1, 2], 1.0), ([1, 3], -1.0)];
    /// let measured = measured.map(|(ids, x)| Measured::of_vector(ids, [x / 6.0, 0.0, 0.5]));
    /// // The floor has the number 0.
    /// let floor = [([2, 0], 1.0), ([3, 0], -1.0)];
    /// let floor = floor.map(|(ids, x)| Measured::of_vector(ids, [x / 6.0, 0.0, 1.5]));
    /// let comparison = Comparison::on_rough_floor(&packing, measured.into_iter().chain(floor))?;
    /// assert_eq!((comparison.matched(), comparison.tangential()), (2, 2));
    /// assert!(comparison.accepted(1e-12));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    pub fn on_rough_floor(
        packing: &Packing<'_>,
        measured: impl IntoIterator<Item = Measured>,
    ) -> Result<Self, Refusal> {
        Self::fill(Ledger::on_rough_floor(packing)?, measured)
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
    /// // A force of 0 is a measurement. The last pair has no contact.
    /// let measured = [([1, 2], 0.46), ([1, 3], 0.0), ([2, 3], 0.1)].map(|(ids, force)| Measured::new(ids, force));
    /// assert_eq!(Comparison::new(&packing, measured)?.matched(), 2);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn matched(&self) -> u64 {
        self.0.matched()
    }

    /// Returns the number of second entries of pairs whose entries are added up, since for most pairs the sum is nearer to the
    /// exact force than each entry.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// let halves = [2, 3, 4, 2, 3, 4].map(|id| Measured::new([1, id], 0.46225016 / 2.0));
    /// let comparison = Comparison::new(&packing, halves)?;
    /// assert!(comparison.accepted(1e-6));
    /// assert_eq!((comparison.shares(), comparison.repeated()), (3, 0));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn shares(&self) -> u64 {
        self.0.shares
    }

    /// Returns the number of entries that list a pair a second time.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let measured = [[1, 2], [2, 1], [1, 3], [4, 1], [1, 4]].map(|ids| Measured::new(ids, 0.46));
    /// let comparison = Comparison::new(&packing, measured)?;
    /// assert_eq!((comparison.matched(), comparison.repeated()), (3, 2));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn repeated(&self) -> u64 {
        self.0.repeated
    }

    /// Returns the number of pairs with two entries whose forces differ by more than `tolerance` times the exact force.
    /// The worse of the two forces is judged.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let measured = [([1, 2], 0.46), ([2, 1], 0.47), ([1, 3], 0.46), ([1, 4], 0.46)];
    /// let comparison = Comparison::new(&packing, measured.map(|(ids, force)| Measured::new(ids, force)))?;
    /// assert_eq!([0.01, 0.1].map(|tolerance| comparison.contradictory(tolerance)), [1, 0]);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn contradictory(&self, tolerance: f64) -> u64 {
        over(&self.0.contradictions, tolerance)
    }

    /// Returns the number of contacts with the floor whose normal forces were judged.
    ///
    /// A number outside the pile is that of the floor or of a wall, if the other sphere is at the bottom. The vertical
    /// forces on a bottom sphere are added up. They are not judged if several walls push it and only the magnitudes of
    /// their forces were measured.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// // Sphere 0 is the floor. Each bottom sphere carries its own weight and a third of the top sphere.
    /// let measured = [2, 3, 4].map(|id| Measured::new([id, 0], 4.0 / 3.0));
    /// let comparison = Comparison::new(&packing, measured)?;
    /// assert_eq!((comparison.floor(), comparison.floor_error()), (3, Some(0.0)));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn floor(&self) -> u64 {
        self.0.floor
    }

    /// Returns the largest relative error of the normal force of the floor on a bottom sphere. `None` if no such force
    /// was judged.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile::geometry::Spacing;
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// # use num_rational::BigRational;
    /// let pile = Pile::triangular(2)?;
    /// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
    /// let on_floor = |force| Comparison::new(&packing, [Measured::new([0, 3], force)]);
    /// assert_eq!(on_floor(8.0 / 3.0)?.floor_error(), Some(1.0));
    /// // Vectors act on the first sphere. This one pushes the floor down.
    /// let pushed = Measured::of_vector([0, 3], [0.1, 0.0, -4.0 / 3.0]);
    /// assert_eq!(Comparison::new(&packing, [pushed])?.floor_error(), Some(0.0));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn floor_error(&self) -> Option<f64> {
        self.0.floor_errors.first().copied()
    }

    /// Returns whether the floor is rough, so that tangential forces are judged.
    pub(super) const fn has_friction(&self) -> bool {
        self.0.friction.is_some()
    }

    /// Returns the number of contacts whose tangential forces were measured. It is 0 on a floor with glue.
    ///
    /// # Examples
    /// See [`on_rough_floor`](Self::on_rough_floor).
    #[must_use]
    pub fn tangential(&self) -> u64 {
        let friction = self.0.friction.as_ref();
        friction.map_or(0, |friction| friction.contacts.errors.len() as u64)
    }

    /// Returns the largest error of a tangential force, as a vector, relative to the exact one. It is relative to the
    /// largest exact tangential force where the exact one is 0. `None` if no such force was measured.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// let pile = Pile::discs(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// // Only the normal force is right.
    /// let normal = Measured::of_vector([1, 2], [0.3, 0.0, 0.4]).with_tangential([0.0; 3]);
    /// let comparison = Comparison::on_rough_floor(&packing, [normal])?;
    /// assert_eq!((comparison.largest_error(), comparison.tangential_error()), (Some(0.0), Some(1.0)));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn tangential_error(&self) -> Option<f64> {
        let friction = self.0.friction.as_ref()?;
        friction.contacts.errors.first().copied()
    }

    /// Returns the largest error of the friction of a rough floor, as for [`tangential_error`](Self::tangential_error). `None` if
    /// no vector of a floor force was measured.
    ///
    /// # Examples
    /// See [`Reader::compare_with_floor`](super::Reader::compare_with_floor).
    #[must_use]
    pub fn floor_friction_error(&self) -> Option<f64> {
        let friction = self.0.friction.as_ref()?;
        friction.floor.errors.first().copied()
    }

    /// Returns the sphere with the greatest net moment, and this moment over R times the largest exact tangential force. Only
    /// spheres count whose forces were all measured. `None` if there is none, or the floor has glue.
    ///
    /// # Examples
    /// ```
    /// # use cannonpile_dem::verify::{Comparison, Measured};
    /// # use cannonpile::{Packing, Pile};
    /// let pile = Pile::discs(2)?;
    /// let packing = Packing::new(&pile, &"1.2".parse()?)?;
    /// // The tangential forces turn the upper disc: both have the same sign along x.
    /// let measured = [([1, 2], 0.3), ([1, 3], -0.3)].map(|(ids, x)| {
    ///     Measured::of_vector(ids, [x, 0.0, 0.4]).with_tangential([-2.0 / 15.0, 0.0, x / 3.0])
    /// });
    /// let comparison = Comparison::on_rough_floor(&packing, measured)?;
    /// let (sphere, moment) = comparison.net_moment().unwrap();
    /// assert!(sphere == 1 && (moment - 2.0).abs() < 1e-12);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn net_moment(&self) -> Option<(u64, f64)> {
        let net = self.0.friction.as_ref()?.moment()?;
        Some((net.sphere, net.moment))
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
        over(&self.0.strays, tolerance)
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
    /// without any force. `None` if no contact was measured.
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
    /// assert_eq!(compare(0.0)?.largest_error(), Some(0.0));
    /// assert_eq!(compare(1e-9)?.largest_error(), Some(f64::INFINITY));
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn largest_error(&self) -> Option<f64> {
        self.0.errors.first().copied()
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
        over(&self.0.errors, tolerance)
    }

    /// Returns the root mean square of the relative errors of the measured contacts, accurate to about 1e-8 of its
    /// value. `None` if no contact was measured.
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
    /// assert!((comparison.rms_error().unwrap() - 0.5_f64.sqrt()).abs() < 1e-8);
    /// assert_eq!(Comparison::new(&packing, [])?.rms_error(), None);
    /// # Ok::<(), cannonpile_dem::verify::Refusal>(())
    /// ```
    #[must_use]
    pub fn rms_error(&self) -> Option<f64> {
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
}

/// Converts the line of an error to the number of an entry.
pub(super) fn of_entry(refusal: Refusal) -> Refusal {
    match refusal {
        Refusal::Line { line, fault } => Refusal::Entry { entry: line, fault },
        other => other,
    }
}
