//! The exact forces of a pile, checked for equilibrium, and the error of other forces.

use cannonpile::Pile;
use cannonpile::geometry::Vector;
use cannonpile::lattice::Direction;
use cannonpile::scalar::Algebra;
use cannonpile::shape::Selection;
use cannonpile_testkit::real::{Bounded, Enclosure};
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{Signed, Zero};

use crate::peers;
use crate::peers::network::Network;

/// The unit of the forces of a method.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Unit {
    /// f₀ = mg/(3 cosθ).
    PileUnits,
    /// mg, at the spacing of the peers.
    Weights,
}

/// The exact contact forces, in f₀, three for each sphere above the floor.
pub(crate) struct Reference {
    pub(crate) forces: Vec<[BigRational; 3]>,
    /// The largest force.
    pub(crate) greatest: BigRational,
    /// mg/f₀ = 3 cosθ to 60 digits.
    weight: BigRational,
}

impl Reference {
    /// Returns the exact forces of the library, and checks them.
    ///
    /// Every sphere must be in exact equilibrium. There are as many equations as forces, so the solution is unique.
    pub(crate) fn new(pile: &Pile, network: &Network) -> Self {
        let contacts = pile.forces::<BigRational>().contacts(Selection::All);
        let contacts = contacts.expect("a plan");
        let forces: Vec<BigRational> = contacts.map(|c| c.expect("a force").force).collect();
        let forces = by_sphere(forces);
        certify(pile, network, &forces);

        let magnitudes = forces.iter().flatten().map(Signed::abs);
        let greatest = magnitudes.max().expect("a contact");
        // 3 cosθ = √(9 cos²θ), rounded down to 60 digits.
        let digits = BigInt::from(10).pow(60);
        let square = peers::inclination().cos2() * BigInt::from(9) * &digits * &digits;
        Self {
            forces,
            greatest,
            weight: BigRational::new(square.to_integer().sqrt(), digits),
        }
    }

    /// Returns the largest error of a force, relative to the largest exact force. It is 0 if and only if all are exact.
    ///
    /// The error of an enclosure is the largest error of its values.
    pub(crate) fn error<T: Bounded>(&self, forces: &[[T; 3]], unit: Unit) -> f64 {
        let scaled = |bound: BigRational| match unit {
            Unit::PileUnits => bound,
            Unit::Weights => bound * &self.weight,
        };
        let errors = self.compared(forces).flat_map(|(force, exact)| {
            let Enclosure { lower, upper } = force.enclosure().expect("a finite force");
            [lower, upper].map(|bound| (scaled(bound) - exact).abs())
        });
        self.relative(errors.max().expect("a contact"))
    }

    /// Returns whether every enclosure contains the exact force.
    pub(crate) fn is_enclosed_by<T: Bounded>(&self, forces: &[[T; 3]]) -> bool {
        let mut compared = self.compared(forces);
        compared.all(|(force, exact)| {
            let enclosure = force.enclosure();
            enclosure.is_some_and(|enclosure| enclosure.contains(exact))
        })
    }

    /// Returns a force in f₀ relative to the largest exact one.
    pub(crate) fn relative(&self, force: BigRational) -> f64 {
        let exact = force.is_zero();
        let relative = f64::from_rational(&(force / &self.greatest));
        assert!(exact || relative > 0.0, "an error underflows");
        relative
    }

    fn compared<'a, T>(
        &'a self,
        forces: &'a [[T; 3]],
    ) -> impl Iterator<Item = (&'a T, &'a BigRational)> {
        assert_eq!(forces.len(), self.forces.len(), "all forces");
        forces.iter().flatten().zip(self.forces.iter().flatten())
    }
}

/// Contact forces, three for each sphere.
pub(crate) fn by_sphere<T>(forces: Vec<T>) -> Vec<[T; 3]> {
    let mut forces = forces.into_iter();
    let mut spheres = Vec::with_capacity(forces.len() / 3);
    while let (Some(a), Some(b), Some(c)) = (forces.next(), forces.next(), forces.next()) {
        spheres.push([a, b, c]);
    }
    spheres
}

/// Asserts that the contact forces and the weight, 3 f₀ cosθ, of each sphere above the floor sum to zero.
fn certify(pile: &Pile, network: &Network, transmitted: &[[BigRational; 3]]) {
    let forces = pile.forces::<BigRational>();
    let mut left = vec![Vector::zero(); network.sites.len()];
    for (sum, &site) in left.iter_mut().zip(&network.sites) {
        sum.z = pile.sphere_weight(site).expect("a sphere") * BigRational::from_integer(3.into());
    }
    let mut directions = Vec::new();
    for (upper, (below, transmitted)) in network.below.iter().zip(transmitted).enumerate() {
        let site = network.sites[upper];
        if upper == 0 || network.sites[upper - 1].k < site.k {
            directions = Vec::from(Direction::ALL.map(|direction| {
                forces
                    .contact_direction(site, direction)
                    .expect("a contact")
            }));
        }
        for ((&lower, force), direction) in below.iter().zip(transmitted).zip(&directions) {
            let push = direction.clone().scaled(force);
            left[upper] = left[upper].clone() + &push;
            left[lower] = left[lower].clone() + &push.map(|x| -x);
        }
    }
    let balanced = left[..network.below.len()]
        .iter()
        .all(|left| *left == Vector::zero());
    assert!(balanced, "every sphere is in equilibrium");
}
