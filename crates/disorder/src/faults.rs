//! Sums over all stackings with the same number of faults, which give the mean for every fault probability.

use cannonpile::scalar::{Polynomial, Symbol};
use num_bigint::{BigInt, BigUint};
use num_integer::binomial;
use num_rational::BigRational;
use num_traits::{Zero, pow};

use super::domain::{Domain, check_words};
use super::floor::FLOOR_UNIT;
use super::mean::{Mean, MeanForce, over};
use super::piles::RandomPiles;
use super::place::Place;
use super::stackings::check_fault_probability;
use super::transfer::{Spot, run_in_integers};
use super::width::{Width, bits_of_counts, bits_of_sources, words_of_big};
use crate::Error;
use crate::error::bug;

/// The forces at one place of the bottom layer, summed over all stackings with the same number of faults.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{FirstSign, Place, RandomPiles, RandomStackings};
/// use cannonpile::lattice::Region;
///
/// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(3, FirstSign::Plus)?);
/// let rows: Result<Vec<_>, _> = piles.by_faults()?.rows().collect();
/// // At the place below the apex only HCP, the stacking +-, has a sphere.
/// let middle = rows?.into_iter().find(|row| row.place == Place { a: 0, b: 0 }).unwrap();
/// assert_eq!((middle.faults, middle.stackings, middle.normal.to_string()), (1, 1_u32.into(), "5/3".into()));
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct FaultForce {
    /// The place.
    pub place: Place,
    /// The number d of faults.
    pub faults: u32,
    /// The number of stackings with d faults that have a sphere at the place.
    pub stackings: BigUint,
    /// The sum of the normal forces on the floor, in mg. It is an integer over 3^(d+1) times the common denominator of
    /// the loads.
    pub normal: BigRational,
    /// The sum of the shear forces along x, in mg·tanθ. Its denominator is at most twice that of `normal`.
    pub shear_x: BigRational,
    /// The sum of the shear forces along y, in √3·mg·tanθ. Its denominator is at most twice that of `normal`.
    pub shear_y: BigRational,
}

cannonpile::engine::equality!(FaultForce);

/// The forces on the floor, summed over the stackings with each number of faults. They give the exact mean for every
/// fault probability.
///
/// Let S_d be the sum over the stackings with d faults. For a given first sign their number is C(n−1,d). Then the mean
/// at the fault probability q is Σ_d S_d q^d (1−q)^(n−1−d), or half of it for a random first sign. It is a polynomial
/// in q of degree n − 1 at most.
///
/// The sums are stored as integers over 2·3^(d+1) times the common denominator of the loads. The coefficient of q^j of
/// the mean contains S_d for d ≤ j only. So its denominator divides 2·3^(j+1) times the denominator of the loads, and
/// 3^(j+1) times it for normal forces. With a random first sign both bounds double.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{FirstSign, Place, RandomPiles, RandomStackings};
/// use cannonpile::lattice::Site;
/// use num_rational::BigRational;
///
/// let plane = RandomPiles::plane(RandomStackings::new(3, FirstSign::Plus)?).weightless();
/// let plane = plane.with_load(Site::APEX, BigRational::from_integer(1.into()))?;
/// let by_faults = plane.by_faults()?;
/// // At the place below the load HCP has a sphere with the normal force −1/3. FCC has no sphere there.
/// let place = Place { a: 0, b: 0 };
/// assert_eq!(by_faults.polynomial()?.at(place).unwrap().normal.to_string(), "-q/3");
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct ByFaults {
    /// The results in order of places. The sums for d faults have the denominator 3^d times that of the loads.
    spots: Vec<Spot<BigInt>>,
    most_faults: usize,
    /// The common denominator of the loads.
    denominator: BigInt,
    /// The number of possible first signs.
    firsts: BigInt,
}

impl RandomPiles {
    /// Returns the forces on the floor by number of faults.
    ///
    /// The cost is about 20 n⁴ additions of integers for a single load or a single sphere on top, with n = L − 1. The
    /// integers have 64 bits up to about n = 28, and 128 bits up to about n = 60.
    ///
    /// # Errors
    /// * [`TooLarge`](cannonpile::Error::TooLarge) if the sums do not fit in memory.
    /// * [`Error::NotAResponse`] for a plane with weight or without loads.
    /// * [`Error::NoStacking`] for a base that supports no stacking of this height.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(6, FirstSign::Plus)?);
    /// let by_faults = piles.by_faults()?;
    /// assert_eq!(by_faults.most_faults(), 4);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn by_faults(&self) -> Result<ByFaults, Error> {
        let denominator = self.denominator();
        let growth = bits_of_counts(self.stackings.steps());
        let most_faults = self.stackings.most_faults();
        let classes = most_faults.unsigned_abs() + 1;
        let domain = Domain::new(self, classes, Width::of(growth).words(growth))?;
        let bits = growth + bits_of_sources(&domain, &denominator)?;
        let most_faults = usize::try_from(most_faults).map_err(|_| bug("the size was checked"))?;
        let width = Width::of(bits);
        // Each place has four sums for each number of faults, first of this width and then as big integers.
        let each = width.words(bits) + words_of_big(bits);
        let of_place = BigUint::from(most_faults + 1) * 4_u32 * each;
        domain.check_memory(width.words(bits), &of_place)?;
        let mut spots = run_in_integers(width, &domain, most_faults + 1, &denominator, None)?;
        spots.sort_by_key(|spot| spot.place);
        Ok(ByFaults {
            spots,
            most_faults,
            firsts: self.firsts().get().into(),
            denominator,
        })
    }
}

impl ByFaults {
    /// Returns the greatest number of faults, n − 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(4, FirstSign::Plus)?);
    /// assert_eq!(piles.by_faults()?.most_faults(), 2);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn most_faults(&self) -> usize {
        self.most_faults
    }

    /// Returns a common denominator of the sums of normal forces over the stackings with d faults: 3^(d+1) times the
    /// denominator of the loads. The shears have twice this denominator.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(4, FirstSign::Plus)?);
    /// assert_eq!(piles.by_faults()?.denominator(2), 27.into());
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn denominator(&self, faults: u32) -> BigInt {
        BigInt::from(3).pow(faults) * 3 * &self.denominator
    }

    /// Iterates over the sums, by place and number of faults. Numbers of faults for which no stacking has a sphere at
    /// the place are omitted.
    ///
    /// # Errors
    /// An item is [`Bug`](cannonpile::Error::Bug) if an invariant is violated.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(3, FirstSign::Plus)?);
    /// // Six places of FCC, without faults, and seven places of HCP, with one fault.
    /// assert_eq!(piles.by_faults()?.rows().count(), 13);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn rows(&self) -> impl Iterator<Item = Result<FaultForce, Error>> + '_ {
        self.spots.iter().flat_map(move |spot| {
            let classes = (0..).zip(&spot.classes);
            classes.filter_map(move |(d, sums)| self.row(spot.place, d, sums).transpose())
        })
    }

    fn row(
        &self,
        place: Place,
        faults: u32,
        sums: &[BigInt; 4],
    ) -> Result<Option<FaultForce>, Error> {
        if sums[0].is_zero() {
            return Ok(None);
        }
        let power = BigInt::from(3).pow(faults);
        let scale = &power * &self.denominator * FLOOR_UNIT.get();
        let row = MeanForce::of(place, sums.clone(), over, [&power, &scale])?;
        Ok(Some(FaultForce {
            place,
            faults,
            stackings: row.probability.to_integer().into_parts().1,
            normal: row.normal,
            shear_x: row.shear_x,
            shear_y: row.shear_y,
        }))
    }

    /// Returns the mean at the fault probability `q`.
    ///
    /// # Errors
    /// [`Error::FaultProbability`] unless 0 ≤ `q` ≤ 1.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    /// use num_rational::BigRational;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(6, FirstSign::Random)?);
    /// let q = BigRational::new(1.into(), 3.into());
    /// assert_eq!(piles.by_faults()?.at(&q)?, piles.exact(&q)?);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn at(&self, q: &BigRational) -> Result<Mean<BigRational>, Error> {
        check_fault_probability(q)?;
        let (a, b) = &q.reduced().into_raw();
        let [faults, straight] = [a.clone(), (b - a) * 3];
        let most = self.most_faults();
        // With q = a/b the mean is Σ_d 3^d S_d a^d (3(b−a))^(n−1−d), over (3b)^(n−1).
        let shares = (0..=self.most_faults)
            .map(|d| pow(faults.clone(), d) * pow(straight.clone(), most - d));
        let shares: Vec<_> = shares.collect();
        let scale = pow(b * 3, most) * &self.firsts;
        self.mean(&scale, over, |sums| {
            let mut totals = [(); 4].map(|()| BigInt::zero());
            for (share, sums) in shares.iter().zip(sums) {
                for (total, sum) in totals.iter_mut().zip(sums) {
                    *total += share * sum;
                }
            }
            totals
        })
    }

    /// Returns the mean as polynomials in the fault probability, with the symbol `q`.
    ///
    /// # Errors
    /// [`Bug`](cannonpile::Error::Bug) if an invariant is violated.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, Place, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Region;
    ///
    /// let piles = RandomPiles::under(Region::SITE, RandomStackings::new(4, FirstSign::Plus)?);
    /// let polynomials = piles.by_faults()?.polynomial()?;
    /// let row = polynomials.at(Place { a: -1, b: -1 }).unwrap();
    /// assert_eq!(row.probability.to_string(), "q");
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn polynomial(&self) -> Result<Mean<Polynomial>, Error> {
        let most = self.most_faults();
        self.check_memory_of_polynomials()?;
        // q^d (1−q)^m = Σ_i C(m,i) (−1)^i q^(d+i), with m = n−1−d. The common denominator is 3^(n−1).
        let powers = (0..=self.most_faults).map(|d| {
            let third = pow(BigInt::from(3), most - d);
            let terms = (0..=most - d).map(|i| {
                let term = binomial(BigInt::from(most - d), BigInt::from(i)) * &third;
                if i % 2 == 0 { term } else { -term }
            });
            terms.collect::<Vec<_>>()
        });
        let powers: Vec<_> = powers.collect();
        let scale = pow(BigInt::from(3), most) * &self.firsts;
        let over = |terms: Vec<BigInt>, scale: &BigInt| {
            Polynomial::in_powers(Symbol("q"), terms, scale.clone())
        };
        self.mean(&scale, over, |sums| {
            let mut totals = [(); 4].map(|()| vec![BigInt::zero(); self.most_faults + 1]);
            for (d, (powers, sums)) in powers.iter().zip(sums).enumerate() {
                for (total, sum) in totals.iter_mut().zip(sums) {
                    if sum.is_zero() {
                        continue;
                    }
                    for (coefficient, power) in total.iter_mut().skip(d).zip(powers) {
                        *coefficient += power * sum;
                    }
                }
            }
            totals
        })
    }

    /// Fails unless the process can allocate the polynomials and their text.
    fn check_memory_of_polynomials(&self) -> Result<(), Error> {
        let classes = self.spots.iter().flat_map(|spot| &spot.classes).flatten();
        let greatest = classes.map(BigInt::bits).fold(0, u64::max);
        // The factors are at most C(n−1,i) 3^(n−1), and less than 3^(2n).
        let terms = self.most_faults as u64 + 1;
        let bits = greatest + 4 * terms;
        // A term has a big integer, its power, and its place in a tree, which may be half full. Its text has three bits in
        // a byte, and a denominator.
        let term = 2 * words_of_big(bits) + 20 + bits / 12;
        let polynomials = BigUint::from(self.spots.len() + 1) * 4_u32 + terms;
        check_words(&(polynomials * terms * term))
    }

    /// Returns the mean. `totals` combines the sums of one place, and `scale` is the denominator of probabilities.
    fn mean<U, T>(
        &self,
        scale: &BigInt,
        over: impl Fn(U, &BigInt) -> Option<T>,
        totals: impl Fn(&[[BigInt; 4]]) -> [U; 4],
    ) -> Result<Mean<T>, Error> {
        let forces = scale * &self.denominator * FLOOR_UNIT.get();
        let rows = self
            .spots
            .iter()
            .map(|spot| MeanForce::of(spot.place, totals(&spot.classes), &over, [scale, &forces]));
        Ok(Mean::of(rows.collect::<Result<_, Error>>()?))
    }
}
