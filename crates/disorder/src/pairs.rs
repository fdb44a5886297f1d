//! Second moments of every two places: how the forces on them go together.
//!
//! M_σ(x, y) = E f(x) f(y)ᵀ obeys the recursion of the [correlations](super::correlation) without their sum over x: both
//! forces move along their contacts, and M_σ ← (1 − q) M'_σ + q G M'_(−σ) G.

use std::collections::BTreeMap;

use cannonpile::engine::refuse_beyond_memory;
use cannonpile::lattice::Sign;
use cannonpile::scalar::Algebra;
use num_bigint::BigUint;

use super::correlation::tripled_both;
use super::number::add;
use super::piles::RandomPiles;
use super::place::Place;
use super::walk::SIGNS;
use crate::Error;
use crate::THREE;
use crate::error::bug;

/// The most numbers that are kept.
const MAX_NUMBERS: u64 = 20_000_000;

/// By pair of places: the products of their forces.
type Products<T> = BTreeMap<(Place, Place), [[T; 3]; 3]>;

/// The mean over all stackings of the products of two forces, for every two places of the bottom layer.
///
/// # Examples
/// ```
/// use cannonpile_disorder::{FirstSign, Place, RandomPiles, RandomStackings};
/// use cannonpile::lattice::Site;
/// use num_rational::BigRational;
///
/// let plane = RandomPiles::plane(RandomStackings::new(3, FirstSign::Plus)?).weightless();
/// let plane = plane.with_load(Site::APEX, BigRational::from_integer(1.into()))?;
/// let pairs = plane.pair_moments(&BigRational::new(1.into(), 2.into()))?;
/// let place = Place { a: 0, b: 0 };
/// // −1/3 under the load in one of two stackings.
/// assert_eq!(pairs.normals(place, place).to_string(), "1/18");
/// # Ok::<(), cannonpile_disorder::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PairMoments<T> {
    products: Products<T>,
    normals: BTreeMap<(Place, Place), T>,
}

impl<T: Algebra> PairMoments<T> {
    /// Returns E g_l(x) g_m(y), with g_l(x) the force from above along direction l on the bottom sphere at x, in f₀²; 0 where no
    /// sphere is.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, Place, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::{Direction, Site};
    /// use num_rational::BigRational;
    ///
    /// let plane = RandomPiles::plane(RandomStackings::new(2, FirstSign::Plus)?).weightless();
    /// let plane = plane.with_load(Site::APEX, BigRational::from_integer(1.into()))?;
    /// let pairs = plane.pair_moments(&0.5)?;
    /// let products = pairs.from_above(Place { a: 1, b: 0 }, Place { a: 0, b: 1 });
    /// assert_eq!(products[Direction::Beta.index()][Direction::Gamma.index()], 1.0);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn from_above(&self, x: Place, y: Place) -> [[T; 3]; 3] {
        // Not a default: two places that are not in the list bear nothing together.
        self.products.get(&(x, y)).cloned().unwrap_or_else(zeros)
    }

    /// Returns E N(x) N(y), with N the normal force on the floor, in mg².
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, Place, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// let plane = RandomPiles::plane(RandomStackings::new(2, FirstSign::Plus)?).weightless();
    /// let plane = plane.with_load(Site::APEX, BigRational::from_integer(3.into()))?;
    /// let pairs = plane.pair_moments(&0.5)?;
    /// assert_eq!(pairs.normals(Place { a: 1, b: 0 }, Place { a: 0, b: 1 }), 1.0);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    #[must_use]
    pub fn normals(&self, x: Place, y: Place) -> T {
        // Not a default: two places that are not in the list bear nothing together.
        self.normals.get(&(x, y)).cloned().unwrap_or_else(T::zero)
    }

    /// Returns the pairs of places that some stacking has forces on together, in order.
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// let plane = RandomPiles::plane(RandomStackings::new(2, FirstSign::Plus)?).weightless();
    /// let plane = plane.with_load(Site::APEX, BigRational::from_integer(1.into()))?;
    /// assert_eq!(plane.pair_moments(&0.5)?.pairs().count(), 9);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn pairs(&self) -> impl Iterator<Item = (Place, Place)> + '_ {
        self.normals.keys().copied()
    }
}

fn zeros<T: Algebra>() -> [[T; 3]; 3] {
    [(); 3].map(|()| [(); 3].map(|()| T::zero()))
}

impl RandomPiles {
    /// Returns the mean over all stackings of the products of the forces on every two bottom spheres: of the response to loads.
    ///
    /// For few layers: there are about 3n⁴ pairs of places.
    ///
    /// # Errors
    /// As for [`mean_square`](Self::mean_square).
    ///
    /// # Examples
    /// ```
    /// use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
    /// use cannonpile::lattice::Site;
    /// use num_rational::BigRational;
    ///
    /// let plane = RandomPiles::plane(RandomStackings::new(5, FirstSign::Plus)?).weightless();
    /// let plane = plane.with_load(Site::APEX, BigRational::from_integer(1.into()))?;
    /// let q = BigRational::new(1.into(), 3.into());
    /// let pairs = plane.pair_moments(&q)?;
    /// // All that comes down is the load, in every stacking.
    /// let sum: BigRational = pairs.pairs().map(|(x, y)| pairs.normals(x, y)).sum();
    /// assert_eq!(sum.to_string(), "1");
    /// // On the diagonal are the mean squares.
    /// let diagonal: BigRational = pairs.pairs().filter(|(x, y)| x == y).map(|(x, y)| pairs.normals(x, y)).sum();
    /// assert_eq!(diagonal, plane.mean_square(&q)?);
    /// # Ok::<(), cannonpile_disorder::Error>(())
    /// ```
    pub fn pair_moments<T: Algebra>(&self, q: &T) -> Result<PairMoments<T>, Error> {
        const QUANTITY: &str = "the pair moments of random stackings";
        self.check_response(QUANTITY)?;
        let steps = self.stackings.steps();
        let n = BigUint::from(steps.unsigned_abs());
        let places = (&n * &n + &n) * 3_u32 + 1_u32;
        let loads = BigUint::from(self.loads().len());
        let needed = places.pow(2) * loads.pow(2) * 6_u32;
        refuse_beyond_memory(
            QUANTITY,
            &needed,
            (MAX_NUMBERS, size_of::<T>()),
            "ask for the mean square, or for fewer layers or loads",
        )?;
        let mut layer = self.first_products()?;
        let (same, change) = (T::one() - q, q.clone().div_int(THREE).div_int(THREE));
        for k in 1..=steps {
            let [plus, minus] = layer;
            let (plus, minus) = (moved(plus, Sign::Plus), moved(minus, Sign::Minus));
            layer = if k < steps {
                [
                    chosen(&plus, &minus, &same, &change),
                    chosen(&minus, &plus, &same, &change),
                ]
            } else {
                [plus, minus]
            };
        }
        let [mut products, minus] = layer;
        for (pair, forces) in minus {
            add_all(products.entry(pair).or_insert_with(zeros), &forces);
        }
        for product in products.values_mut().flatten().flatten() {
            let sum = core::mem::replace(product, T::zero());
            *product = super::mean::defined(sum.div_int(self.firsts()))?;
        }
        let normal = |products: &[[T; 3]; 3]| {
            let products = products.iter().flatten();
            let sum = products.fold(T::zero(), |sum, product| sum + product);
            sum.div_int(THREE).div_int(THREE)
        };
        let normals = products
            .iter()
            .map(|(pair, products)| (*pair, normal(products)));
        let mut normals: BTreeMap<_, _> = normals.collect();
        if steps == 0 {
            // The floor feels the loads at once.
            for (x, first) in self.loads() {
                for (y, second) in self.loads() {
                    let pair = (place_of(x)?, place_of(y)?);
                    normals.insert(pair, T::from_rational(&(first * second)));
                }
            }
        }
        Ok(PairMoments { products, normals })
    }

    /// The loads of the top layer: the same on each line. Of a single layer there are no forces from above.
    fn first_products<T: Algebra>(&self) -> Result<[Products<T>; 2], Error> {
        let mut begun = [Products::new(), Products::new()];
        if self.stackings.steps() == 0 {
            return Ok(begun);
        }
        for (x, first) in self.loads() {
            for (y, second) in self.loads() {
                let product = T::from_rational(&(first * second));
                for (sign, products) in SIGNS.iter().zip(&mut begun) {
                    if self.stackings.first().signs().contains(sign) {
                        let entry = products
                            .entry((place_of(x)?, place_of(y)?))
                            .or_insert_with(zeros);
                        entry
                            .iter_mut()
                            .flatten()
                            .for_each(|sum| add(sum, &product));
                    }
                }
            }
        }
        Ok(begun)
    }
}

fn place_of(site: &[i128; 2]) -> Result<Place, Error> {
    Place::of(*site, 0).ok_or_else(|| bug("loads are within the limit of coordinates"))
}

/// Both forces a step further along their contacts.
fn moved<T: Algebra>(from: Products<T>, sign: Sign) -> Products<T> {
    let contacts = Place::descents(sign);
    let mut to = Products::new();
    for ((x, y), products) in from {
        for (l, products) in products.into_iter().enumerate() {
            for (m, product) in products.into_iter().enumerate() {
                let pair = (x.moved(contacts[l]), y.moved(contacts[m]));
                add(&mut to.entry(pair).or_insert_with(zeros)[l][m], &product);
            }
        }
    }
    to
}

/// What goes on straight, and what makes a half-turn.
fn chosen<T: Algebra>(
    straight: &Products<T>,
    turned: &Products<T>,
    same: &T,
    change: &T,
) -> Products<T> {
    let mut sum = Products::new();
    for (pair, products) in straight {
        let share = products
            .clone()
            .map(|row| row.map(|product| product * same));
        add_all(sum.entry(*pair).or_insert_with(zeros), &share);
    }
    for (pair, products) in turned {
        let share = tripled_both(products).map(|row| row.map(|product| product * change));
        add_all(sum.entry(*pair).or_insert_with(zeros), &share);
    }
    sum
}

fn add_all<T: Algebra>(sums: &mut [[T; 3]; 3], products: &[[T; 3]; 3]) {
    for (sum, product) in sums.iter_mut().flatten().zip(products.iter().flatten()) {
        add(sum, product);
    }
}
