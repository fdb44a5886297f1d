//! Mean forces on the floor.

use core::num::NonZeroI64;

use cannonpile::engine::quotient;
use cannonpile::scalar::{Algebra, Field, Ring};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use super::domain::Domain;
use super::floor::FLOOR_UNIT;
use super::number::times;
use super::piles::RandomPiles;
use super::place::Place;
use super::stackings::check_fault_probability;
use super::transfer::{Transfer, run_in_integers, shares};
use super::width::{Width, bits_of_sources, words_of_big};
use crate::Error;
use crate::error::bug;
use crate::{Each, ONE, TWO};

/// The mean forces at one place of the bottom layer, over all stackings.
///
/// A stacking without a sphere at the place contributes 0. So the normal forces of all rows sum to the mean weight of a
/// pile and its loads.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{FirstSign, MeanForce, Place, RandomPiles, RandomStackings};
/// use cannonpile::lattice::Region;
///
/// // Three spheres support one, each with a third of its weight.
/// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(2, FirstSign::Plus)?);
/// let mean = piles.mean(&0.5)?;
/// let place = Place { a: -1, b: -1 };
/// let [normal, shear_x, shear_y] = [4.0 / 3.0, -1.0 / 6.0, -1.0 / 6.0];
/// assert_eq!(mean.rows()[0], MeanForce { place, probability: 1.0, normal, shear_x, shear_y });
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct MeanForce<T> {
    /// The place.
    pub place: Place,
    /// The probability that a sphere is at the place.
    pub probability: T,
    /// The mean normal force on the floor, in mg. It includes the weight of the sphere itself.
    pub normal: T,
    /// The mean shear along x, in mg·tanθ.
    pub shear_x: T,
    /// The mean shear along y, in √3·mg·tanθ.
    pub shear_y: T,
}

cannonpile::engine::equality!(MeanForce<T>, T: Ring; |Self { place, probability, normal, shear_x, shear_y }|
    (place, [probability, normal, shear_x, shear_y].map(Ring::comparison_key)));

impl<T> MeanForce<T> {
    /// Returns the row for sums of a probability and three forces. `over` divides a sum by a scale, and the scales are
    /// those of probabilities and of forces.
    pub(super) fn of<U, D>(
        place: Place,
        [probability, normal, shear_x, shear_y]: [U; 4],
        over: impl Fn(U, &D) -> Option<T>,
        [ones, forces]: [&D; 2],
    ) -> Result<Self, Error> {
        let over =
            |sum: U, scale: &D| over(sum, scale).ok_or_else(|| bug("denominators are not zero"));
        Ok(Self {
            place,
            probability: over(probability, ones)?,
            normal: over(normal, forces)?,
            shear_x: over(shear_x, forces)?,
            shear_y: over(shear_y, forces)?,
        })
    }

    /// Returns the row with a function applied to its three forces.
    fn try_forces<E>(self, mut f: impl FnMut(T) -> Result<T, E>) -> Result<Self, E> {
        Ok(Self {
            normal: f(self.normal)?,
            shear_x: f(self.shear_x)?,
            shear_y: f(self.shear_y)?,
            ..self
        })
    }

    /// Returns the row with `f` applied to each value.
    ///
    /// # Errors
    /// The first error of `f`.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{MeanForce, Place};
    ///
    /// let place = Place { a: 0, b: 0 };
    /// let row = MeanForce { place, probability: 2, normal: 4, shear_x: 0, shear_y: -2 };
    /// let half = row.try_map(|n: i32| Ok::<_, ()>(n / 2)).unwrap();
    /// assert_eq!((half.probability, half.normal, half.shear_y), (1, 2, -1));
    /// ```
    pub fn try_map<U, E>(self, mut f: impl FnMut(T) -> Result<U, E>) -> Result<MeanForce<U>, E> {
        Ok(MeanForce {
            place: self.place,
            probability: f(self.probability)?,
            normal: f(self.normal)?,
            shear_x: f(self.shear_x)?,
            shear_y: f(self.shear_y)?,
        })
    }
}

/// The mean forces on the floor over all stackings, by place.
///
/// There is a row for each place at which some stacking has a sphere. In the plane some load must also reach that
/// sphere. The rows are sorted by b, then a.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{FirstSign, Place, RandomPiles, RandomStackings};
/// use cannonpile::lattice::Site;
/// use num_rational::BigRational;
///
/// let plane = RandomPiles::plane(RandomStackings::new(5, FirstSign::Plus)?).weightless();
/// let mean = plane.with_load(Site::APEX, BigRational::from_integer(1.into()))?.mean(&0.5_f64)?;
/// assert_eq!(mean.rows().len(), 61);
/// // At the end of each straight line of contacts only FCC has a load: (1−q)³/3.
/// let corner = mean.at(Place { a: 4, b: 0 }).unwrap();
/// assert!((corner.normal - 1.0 / 24.0).abs() < 1e-15);
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Mean<T> {
    rows: Vec<MeanForce<T>>,
}

cannonpile::engine::equality!(Mean<T>, T: Ring; |Self { rows }| rows);

impl<T> Mean<T> {
    /// Sorts the rows.
    pub(super) fn of(mut rows: Vec<MeanForce<T>>) -> Self {
        rows.sort_by_key(|row| row.place);
        Self { rows }
    }

    /// Returns the rows.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(3, FirstSign::Plus)?);
    /// // Six places of FCC, seven places of HCP.
    /// assert_eq!(piles.mean(&0.5)?.rows().len(), 13);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn rows(&self) -> &[MeanForce<T>] {
        &self.rows
    }

    /// Converts the mean into its rows.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(2, FirstSign::Plus)?);
    /// let total: f64 = piles.mean(&0.5)?.into_rows().into_iter().map(|row| row.normal).sum();
    /// assert!((total - 4.0).abs() < 1e-15);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn into_rows(self) -> Vec<MeanForce<T>> {
        self.rows
    }

    /// Returns the row of a place, if it exists.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, Place, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(2, FirstSign::Plus)?);
    /// assert_eq!(piles.mean(&0.5)?.at(Place { a: 0, b: 0 }), None);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn at(&self, place: Place) -> Option<&MeanForce<T>> {
        let found = self.rows.binary_search_by_key(&place, |row| row.place);
        self.rows.get(found.ok()?)
    }
}

impl<T: Field> Mean<T> {
    /// Returns the mean over the stackings that have a sphere at the place. Forces are divided by the probability, and
    /// rows with probability 0 are omitted.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, Place, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(3, FirstSign::Plus)?);
    /// let q = BigRational::new(1.into(), 3.into());
    /// let given = piles.exact(&q)?.given_sphere();
    /// // In three layers of HCP this sphere has the normal force 5/3.
    /// assert_eq!(given.at(Place { a: 0, b: 0 }).unwrap().normal.to_string(), "5/3");
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn given_sphere(&self) -> Self {
        let rows = self.rows.iter().filter_map(|row| {
            let given = |force: T| force.checked_div(&row.probability).ok_or(());
            row.clone().try_forces(given).ok()
        });
        Self {
            rows: rows.collect(),
        }
    }
}

impl RandomPiles {
    /// Returns the mean over all stackings at the fault probability `q`, in any scalar. All operations are in that
    /// scalar.
    ///
    /// The cost is about 40 n³ operations for a single load or a single sphere on top, with n = L − 1. For piles on a
    /// base it is about n times the square of the number of base sites. A step is an orthogonal map, so rounding errors
    /// are not amplified, and `f64` is accurate to its last digits. The scalar may have no order, so 0 ≤ `q` ≤ 1 is not
    /// checked.
    ///
    /// # Errors
    /// * [`TooLarge`](cannonpile::Error::TooLarge) if the forces do not fit in memory.
    /// * [`Error::NotAResponse`] for a plane with weight or without loads.
    /// * [`Error::NoStacking`] for a base that supports no stacking of this height.
    /// * [`Overflow`](cannonpile::Error::Overflow) if the scalar overflows.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, Place, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    /// use cannonpile::scalar::{Polynomial, Symbol};
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(3, FirstSign::Plus)?);
    /// let place = Place { a: 0, b: 0 };
    /// assert_eq!(piles.mean(&0.25)?.at(place).unwrap().probability, 0.25);
    /// let symbolic = piles.mean(&Polynomial::from(Symbol("q")))?;
    /// assert_eq!(symbolic.at(place).unwrap().normal.to_string(), "5 q/3");
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn mean<T: Algebra>(&self, q: &T) -> Result<Mean<T>, Error> {
        match self.mean_halved(q, 0) {
            // The recursion exceeds its result by a few bits.
            Err(Error::Core(cannonpile::Error::Overflow { .. })) => self.mean_halved(q, 16),
            mean => mean,
        }
    }

    /// Returns the mean, computed with loads and weights that are halved so many times.
    fn mean_halved<T: Algebra>(&self, q: &T, halvings: usize) -> Result<Mean<T>, Error> {
        let domain = Domain::new(self, 1, 1)?;
        // Each place has four numbers, in a list of its own and then in a row.
        domain.check_memory(1, &BigUint::from(30_u32))?;
        let power = BigRational::from_integer(BigInt::one() << halvings);
        let back = (halvings > 0).then(|| T::from_rational(&power));
        // A load of W mg adds W to the force of each contact, as a weight of mg adds 1.
        let scalar = |x: &BigRational| Ok(T::from_rational(&(x / &power)));
        let transfer = Transfer::new(&domain, 1, shares(q).each(Some), scalar)?;
        // An interval would widen even in a division by 1.
        let over = |sum: T, unit: &Option<NonZeroI64>| {
            let mean = sum.div_int(self.firsts());
            Some(match unit {
                Some(unit) => mean.div_int(*unit),
                None => mean,
            })
        };
        let rows = transfer.run()?.into_iter().map(|spot| {
            let row = MeanForce::of(
                spot.place,
                one_class(spot.classes)?,
                over,
                [&None, &Some(FLOOR_UNIT)],
            )?;
            let row = row.try_forces(|force| Ok::<_, Error>(times(force, back.as_ref())))?;
            row.try_map(defined)
        });
        Ok(Mean::of(rows.collect::<Result<_, Error>>()?))
    }

    /// Returns the exact mean over all stackings at a rational fault probability.
    ///
    /// With q = a/b the forces after k steps are integers over (3b)^k times the denominator of the loads. A bound
    /// computed beforehand decides between 64-bit, 128-bit and big integers. Each result is reduced to lowest terms
    /// once.
    ///
    /// # Errors
    /// [`Error::FaultProbability`] unless 0 ≤ `q` ≤ 1. Otherwise as for [`mean`](Self::mean).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, Place, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(4, FirstSign::Random)?);
    /// let mean = piles.exact(&BigRational::new(1.into(), 3.into()))?;
    /// assert_eq!(mean.at(Place { a: 3, b: 0 }).unwrap().probability.to_string(), "2/9");
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn exact(&self, q: &BigRational) -> Result<Mean<BigRational>, Error> {
        check_fault_probability(q)?;
        let q = &q.reduced();
        let denominator = self.denominator();
        let tripled: BigInt = q.denom() * 3;
        // Each step except the first and the last multiplies the denominator by 3b.
        let choices = self.stackings.most_faults();
        // A number of steps that does not fit in a `u64` exceeds the memory limit anyway.
        let steps = u64::try_from(choices.max(1)).unwrap_or(u64::MAX);
        let growth = tripled.bits().saturating_mul(steps);
        let domain = Domain::new(self, 1, Width::of(growth).words(growth))?;
        let bits = growth.saturating_add(bits_of_sources(&domain, &denominator)?);
        let choices = usize::try_from(choices).map_err(|_| bug("the size was checked"))?;
        // Each place has four sums, first of this width and then as big integers, and then four rationals.
        let (width, big) = (Width::of(bits), words_of_big(bits));
        let of_place = 4 * width.words(bits) + 12 * big + 20;
        domain.check_memory(width.words(bits), &of_place.into())?;
        let shares = [(q.denom() - q.numer()) * 3, q.numer().clone()];
        let spots = run_in_integers(width, &domain, 1, &denominator, Some(shares))?;
        let scale = pow(tripled, choices) * self.firsts().get();
        let forces = &scale * denominator * FLOOR_UNIT.get();
        let rows = spots.into_iter().map(|spot| {
            let sums = one_class(spot.classes)?;
            MeanForce::of(spot.place, sums, over, [&scale, &forces])
        });
        Ok(Mean::of(rows.collect::<Result<_, Error>>()?))
    }

    /// Returns the number of possible first signs. Each of them starts with a total probability of 1.
    pub(super) fn firsts(&self) -> NonZeroI64 {
        match self.stackings.first_signs() {
            [_, _] => TWO,
            _ => ONE,
        }
    }
}

/// Returns n/d, or `None` if d is zero.
pub(super) fn over(n: BigInt, d: &BigInt) -> Option<BigRational> {
    (!d.is_zero()).then(|| quotient(n, d))
}

/// Returns the only class of a recursion by probability.
fn one_class<C>(classes: Vec<C>) -> Result<C, Error> {
    let class = classes.into_iter().next();
    class.ok_or_else(|| bug("there is one class"))
}

/// Returns an overflow error for an undefined value.
pub(super) fn defined<T: Algebra>(value: T) -> Result<T, Error> {
    if value.is_defined() {
        return Ok(value);
    }
    Err(cannonpile::Error::overflow("a mean over random stackings", T::NAME).into())
}
