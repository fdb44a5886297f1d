//! The error of a number type, in units of its last place.

use cannonpile::lattice::Region;
use cannonpile::num_bigint::BigInt;
use cannonpile::num_rational::BigRational;
use cannonpile::num_traits::{Signed, ToPrimitive};
use cannonpile::scalar::Algebra;
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Forces, Pile};

/// The unit of an error.
#[derive(Clone, Copy)]
pub enum Unit {
    /// 2^−bits of the greatest force: the unit roundoff u of a float.
    Roundoff(i32),
    /// 2^−bits f₀, the resolution of a fixed point.
    Resolution(i32),
    /// Any error is a failure.
    None,
}

/// Returns HCP under a hexagon with four spheres on a side.
pub fn pile(layers: i128) -> Result<Pile, Error> {
    Pile::under(Region::hexagon(4, 4)?, Stacking::hcp(layers)?)
}

/// Exact contact forces below the last but one layer, over one denominator.
pub struct Reference {
    pub pile: Pile,
    pub numerators: Vec<BigInt>,
    pub denominator: BigInt,
}

impl Reference {
    pub fn new(layers: i128) -> Result<Self, Error> {
        let pile = pile(layers)?;
        let exact = pile.forces::<BigRational>();
        let mut exact = exact.layers(Selection::Layer(layers - 2))?.numerators()?;
        let layer = exact.next_layer()?.expect("the pile has this layer");
        let denominator = layer.denominator();
        let mut slices = [(); 3].map(|()| vec![BigInt::ZERO; layer.sphere_count()]);
        let [alpha, beta, gamma] = &mut slices;
        layer.fill([alpha, beta, gamma])?;
        let numerators = slices.concat();
        Ok(Self {
            pile,
            numerators,
            denominator,
        })
    }

    /// Returns the worst error of all forces, which `ends` converts into rationals: a value, or the ends of an interval.
    pub fn worst_error<T, const N: usize>(
        &self,
        forces: &[T],
        unit: Unit,
        ends: impl Fn(&T) -> [BigRational; N],
    ) -> f64 {
        assert_eq!(
            forces.len(),
            self.numerators.len(),
            "a force for each contact"
        );
        let float = |n: &BigInt| n.to_f64().expect("a float");
        let greatest = self
            .numerators
            .iter()
            .map(|n| float(&n.abs()))
            .fold(0.0, f64::max);
        let unit = match unit {
            Unit::Roundoff(bits) => greatest / float(&self.denominator) * 2.0_f64.powi(-bits),
            Unit::Resolution(bits) => 2.0_f64.powi(-bits),
            Unit::None => 1.0,
        };
        let errors = forces
            .iter()
            .zip(&self.numerators)
            .flat_map(|(force, exact)| {
                ends(force).map(|end| {
                    let difference = end.numer() * &self.denominator - exact * end.denom();
                    float(&difference.abs()) / float(&(end.denom() * &self.denominator)) / unit
                })
            });
        errors.fold(0.0, f64::max)
    }
}

/// Returns the contact forces below a layer.
pub fn below<T: Algebra>(forces: &Forces<'_, T>, k: i128) -> Result<Vec<T>, Error> {
    let mut layers = forces.layers(Selection::Layer(k))?;
    let layer = layers.next_layer()?.expect("the pile has this layer");
    let mut slices = [(); 3].map(|()| vec![T::zero(); layer.sphere_count()]);
    let [alpha, beta, gamma] = &mut slices;
    layer.fill([alpha, beta, gamma])?;
    Ok(slices.concat())
}
