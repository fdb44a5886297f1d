//! A scalar of one's own: dual numbers, which carry a derivative through every formula.
//!
//! A dual number a + a′ε has ε² = 0. The 45 lines below are all that the library needs. Every query then returns a force
//! and its derivative, here by a load and by the tilt of gravity. Run it with `cargo run --example own_scalar`.

use core::num::NonZeroI64;
use core::ops::{Add, Mul, Sub};

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::num_rational::BigRational;
use cannonpile::num_traits::Zero;
use cannonpile::scalar::{Algebra, Exactness, Ring, laws};
use cannonpile::{Error, Pile, ratio};

/// A value and its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Dual(f64, f64);

impl Add<&Self> for Dual {
    type Output = Self;
    fn add(self, other: &Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl Sub<&Self> for Dual {
    type Output = Self;
    fn sub(self, other: &Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

impl Mul<&Self> for Dual {
    type Output = Self;
    fn mul(self, other: &Self) -> Self {
        Self(self.0 * other.0, self.1 * other.0 + self.0 * other.1)
    }
}

// The operators by value, `-a`, zero and one follow.
cannonpile::ring!(Dual);

impl Ring for Dual {
    fn from_integer(n: i128) -> Self {
        Self(f64::from_integer(n), 0.0)
    }
}

impl Algebra for Dual {
    const EXACTNESS: Exactness = f64::EXACTNESS;
    const NAME: &'static str = "Dual";
    type Numerator = Self;

    fn from_rational(r: &BigRational) -> Self {
        Self(f64::from_rational(r), 0.0)
    }

    fn div_int(self, n: NonZeroI64) -> Self {
        Self(self.0.div_int(n), self.1.div_int(n))
    }

    fn checked_div(&self, divisor: &Self) -> Option<Self> {
        let value = self.0.checked_div(&divisor.0)?;
        let slope = (self.1 - value * divisor.1).checked_div(&divisor.0)?;
        Some(Self(value, slope))
    }

    fn is_defined(&self) -> bool {
        self.0.is_finite() && self.1.is_finite()
    }
}

fn main() -> Result<(), Error> {
    // The law suite of the library tests the operators.
    laws::algebra(&Dual(2.0, 1.0), &Dual(-0.5, 3.0), &Dual(4.0, 0.25)).expect("the laws hold");

    // Two layers of FCC under a layer of HCP, and a load on the apex that grows at the rate 1.
    let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    let (site, direction) = (Site::new(0, 0, 2), Direction::Alpha);
    let forces = pile
        .forces::<Dual>()
        .with_load(Site::APEX, Dual(0.0, 1.0))?;
    let Dual(force, slope) = forces.contact(site, direction)?;
    println!("force {force} f0, and {slope} f0 more for each mg on the apex");

    // The exact difference for a load of 1 mg.
    let exact = |pile: &Pile| pile.forces::<BigRational>().contact(site, direction);
    let loaded = pile.clone().with_load(Site::APEX, ratio!(1))?;
    let difference = exact(&loaded)? - exact(&pile)?;
    assert!((slope - f64::from_rational(&difference)).abs() < 1e-15);

    // Gravity that begins to lean along x.
    let forces = pile
        .forces::<Dual>()
        .with_tilt([Dual(0.0, 1.0), Dual::zero()])?;
    let Dual(force, slope) = forces.contact(site, direction)?;
    println!("force {force} f0, and {slope} f0 more for each unit of tilt along x");
    let leaning = pile.clone().with_tilt([ratio!(1), ratio!(0)])?;
    let difference = exact(&leaning)? - exact(&pile)?;
    assert!((slope - f64::from_rational(&difference)).abs() < 1e-15);
    Ok(())
}
