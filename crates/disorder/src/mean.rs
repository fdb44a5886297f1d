//! What bottom spheres bear in the mean.

use core::num::NonZeroI64;

use cannonpile::scalar::{Algebra, Field, Numerators};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::pow;

use super::floor::FLOOR_UNIT;
use super::frame::{Frame, Load};
use super::number::{Number, Part};
use super::piles::RandomPiles;
use super::place::Place;
use super::stackings::check_fault_probability;
use super::transfer::{Spot, Transfer, shares};
use super::width::{Width, bits_of_sources};
use crate::Error;
use crate::error::bug;
use crate::{ONE, TWO};

/// What is at one place of the bottom layer, in the mean over all stackings.
///
/// A stacking without a sphere at the place counts as one whose sphere bears nothing, so that the normals of all rows add up to the mean
/// weight of a pile and its loads.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{FirstSign, MeanForce, Place, RandomPiles, RandomStackings};
/// use cannonpile::lattice::Region;
///
/// // Three spheres under one, each with a third of it.
/// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(2, FirstSign::Plus)?);
/// let mean = piles.mean(&0.5)?;
/// let place = Place { a: -1, b: -1 };
/// let [normal, shear_x, shear_y] = [4.0 / 3.0, -1.0 / 6.0, -1.0 / 6.0];
/// assert_eq!(mean.rows()[0], MeanForce { place, probability: 1.0, normal, shear_x, shear_y });
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeanForce<T> {
    /// The place.
    pub place: Place,
    /// The probability that a sphere is there.
    pub probability: T,
    /// The mean normal force on the floor, in mg, the sphere's own weight included.
    pub normal: T,
    /// The mean shear along x, in mg·tanθ.
    pub shear_x: T,
    /// The mean shear along y, in √3·mg·tanθ.
    pub shear_y: T,
}

impl<T> MeanForce<T> {
    /// Returns the row with `f` applied to each number.
    ///
    /// # Errors
    /// Those of `f`.
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

/// What the bottom layer bears in the mean over all stackings, by place.
///
/// The rows are those places at which some stacking has a sphere, and in the plane a load may be felt; in order of b, then a.
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
/// // Far down one of the three straight lines of contacts nothing but FCC has a load: (1−q)³/3.
/// let corner = mean.at(Place { a: 4, b: 0 }).unwrap();
/// assert!((corner.normal - 1.0 / 24.0).abs() < 1e-15);
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mean<T> {
    rows: Vec<MeanForce<T>>,
}

impl<T> Mean<T> {
    /// Puts rows in their order.
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
    /// // Six places of FCC, seven of HCP.
    /// assert_eq!(piles.mean(&0.5)?.rows().len(), 13);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn rows(&self) -> &[MeanForce<T>] {
        &self.rows
    }

    /// Returns the rows themselves.
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

    /// Returns the row of a place, if there is one.
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
    /// Returns the mean over those stackings that have a sphere at the place: normal and shears over the probability. Places
    /// where the probability is 0 are left out.
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
    /// // One sphere of three layers of HCP.
    /// assert_eq!(given.at(Place { a: 0, b: 0 }).unwrap().normal.to_string(), "5/3");
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn given_sphere(&self) -> Self {
        let rows = self.rows.iter().filter_map(|row| {
            let given = |force: &T| force.checked_div(&row.probability);
            Some(MeanForce {
                place: row.place,
                probability: row.probability.clone(),
                normal: given(&row.normal)?,
                shear_x: given(&row.shear_x)?,
                shear_y: given(&row.shear_y)?,
            })
        });
        Self {
            rows: rows.collect(),
        }
    }
}

impl RandomPiles {
    /// Returns the mean over all stackings at the fault probability `q`, in any scalar; all of its operations are in that scalar.
    ///
    /// Takes about 40 n³ operations for a single load or sphere on top, n = L − 1; of a base about n times the square of its
    /// number of sites. A step is orthogonal, so that nothing is amplified: `f64` errs in its last digits only. 0 ≤ `q` ≤ 1 is not
    /// asked of a scalar that may have no order.
    ///
    /// # Errors
    /// [`TooLarge`](cannonpile::Error::TooLarge) of what would not fit in memory; [`Error::OnlyOfLoads`] for a plane with weight or without loads;
    /// [`Error::NoStacking`] for a base that carries no stacking; [`Overflow`](cannonpile::Error::Overflow) of a scalar.
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
        let frame = Frame::new(
            self,
            Load {
                classes: 1,
                words: 1,
            },
        )?;
        let [same, change] = shares(q).map(Part);
        let loads = self.loads().iter();
        // A load of W mg adds W to each line, as a weight of mg adds 1.
        let loads = loads.map(|(site, load)| (*site, T::from_rational(load)));
        let transfer = Transfer {
            frame: &frame,
            classes: 1,
            same,
            change,
            weight: T::from_rational(&self.weight()),
            loads: loads.collect(),
        };
        let firsts = |sum: T| sum.div_int(self.firsts());
        let force = |sum: T| firsts(sum).div_int(FLOOR_UNIT);
        let row = |spot: Spot<T>| {
            let (probability, floor) = one_class(spot.classes)?;
            let row = MeanForce {
                place: spot.place,
                probability: firsts(probability),
                normal: force(floor.normal),
                shear_x: force(floor.shear_x),
                shear_y: force(floor.shear_y),
            };
            row.try_map(defined)
        };
        let rows: Result<Vec<_>, Error> = transfer.run()?.into_iter().map(row).collect();
        Ok(Mean::of(rows?))
    }

    /// Returns the mean over all stackings at a rational fault probability, exactly.
    ///
    /// With q = a/b the forces after k steps are integers over (3b)^k times the denominator of the loads: 64 or 128 bits, or as many as they get, by a bound that is
    /// computed beforehand; each is reduced once.
    ///
    /// # Errors
    /// [`Error::FaultProbability`] unless 0 ≤ `q` ≤ 1; others as for [`mean`](Self::mean).
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
        let denominator = self.denominator();
        let tripled: BigInt = q.denom() * 3;
        // Each step but the first and the last multiplies by 3b.
        let choices = self.stackings.most_faults();
        // Not a default: what has no such number of steps is refused for its size.
        let steps = u64::try_from(choices.max(1)).unwrap_or(u64::MAX);
        let growth = tripled.bits().saturating_mul(steps);
        let rough = Load {
            classes: 1,
            words: Width::of(growth).words(growth),
        };
        let frame = Frame::new(self, rough)?;
        let bits = growth.saturating_add(bits_of_sources(&frame, &denominator)?);
        let width = Width::of(bits);
        let choices = usize::try_from(choices).map_err(|_| bug("the size was checked"))?;
        let question = Question {
            frame: &frame,
            q,
            denominator: &denominator,
            scale: pow(tripled, choices),
        };
        match width {
            Width::Narrow => question.answer(|n| i64::try_from(n).ok()),
            Width::Wide => question.answer(|n| i128::try_from(n).ok()),
            Width::Big => question.answer(|n| Some(n.clone())),
        }
    }

    /// How many signs the first step can have: each begins with a share of one.
    pub(super) fn firsts(&self) -> NonZeroI64 {
        match self.stackings.first_signs() {
            [_, _] => TWO,
            _ => ONE,
        }
    }
}

/// A mean that is asked for exactly.
struct Question<'f> {
    frame: &'f Frame<'f>,
    q: &'f BigRational,
    /// Of the loads.
    denominator: &'f BigInt,
    /// (3b)^(n−1).
    scale: BigInt,
}

impl Question<'_> {
    fn answer<T>(&self, number: impl Fn(&BigInt) -> Option<T>) -> Result<Mean<BigRational>, Error>
    where
        T: Number + Into<BigInt>,
    {
        let number = |n: &BigInt| number(n).ok_or_else(|| bug("the bound is that of all numbers"));
        let piles = self.frame.piles;
        let (a, b) = (self.q.numer(), self.q.denom());
        let over = |x: &BigRational| number(&(x.numer() * (self.denominator / x.denom())));
        let loads = piles
            .loads()
            .iter()
            .map(|(site, load)| Ok((*site, over(load)?)));
        let loads: Result<Vec<_>, Error> = loads.collect();
        let transfer = Transfer {
            frame: self.frame,
            classes: 1,
            same: Part(number(&((b - a) * 3))?),
            change: Part(number(a)?),
            weight: over(&piles.weight())?,
            loads: loads?,
        };
        let firsts = BigInt::from(piles.firsts().get());
        let shares = &self.scale * &firsts;
        let forces = &shares * self.denominator * FLOOR_UNIT.get();
        let row = |spot: Spot<T>| {
            let (probability, floor) = one_class(spot.classes)?;
            let of = |n: T, scale: &BigInt| {
                BigRational::from_ratio(n.into(), scale)
                    .ok_or_else(|| bug("denominators are not zero"))
            };
            Ok(MeanForce {
                place: spot.place,
                probability: of(probability, &shares)?,
                normal: of(floor.normal, &forces)?,
                shear_x: of(floor.shear_x, &forces)?,
                shear_y: of(floor.shear_y, &forces)?,
            })
        };
        let rows: Result<Vec<_>, Error> = transfer.run()?.into_iter().map(row).collect();
        Ok(Mean::of(rows?))
    }
}

/// The one class of a recursion by probability.
fn one_class<C>(classes: Vec<C>) -> Result<C, Error> {
    let class = classes.into_iter().next();
    class.ok_or_else(|| bug("there is one class"))
}

/// Refuses what is no number.
pub(super) fn defined<T: Algebra>(value: T) -> Result<T, Error> {
    if value.is_defined() {
        return Ok(value);
    }
    Err(cannonpile::Error::overflow("a mean over random stackings", T::NAME).into())
}
