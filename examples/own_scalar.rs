//! A scalar of one's own: dual numbers, which carry a derivative through every formula.
//!
//! A dual number a + a′ε has ε² = 0. The thirty lines of operators below are all that the library needs. Every query
//! then returns a force and its derivative, here by a load and by the tilt of gravity. Run it with `cargo run --example
//! own_scalar`.

use core::num::NonZeroI64;
use core::ops::{Add, Mul, Neg, Sub};

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::num_rational::BigRational;
use cannonpile::num_traits::{One, Zero};
use cannonpile::scalar::{Algebra, Exactness, OwnNumerators, Ring, laws};
use cannonpile::{Error, Pile, ratio};

/// A value and its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Dual(f64, f64);

/// Implements an operator by value and by reference, as [`Ring`] requires.
macro_rules! operator {
    ($name:ident, $method:ident, |$a:ident, $b:ident| $result:expr) => {
        impl $name<&Dual> for Dual {
            type Output = Dual;

            fn $method(self, other: &Dual) -> Dual {
                let ($a, $b) = (self, *other);
                $result
            }
        }

        impl $name for Dual {
            type Output = Dual;

            fn $method(self, other: Dual) -> Dual {
                $name::$method(self, &other)
            }
        }
    };
}

operator!(Add, add, |a, b| Dual(a.0 + b.0, a.1 + b.1));
operator!(Sub, sub, |a, b| Dual(a.0 - b.0, a.1 - b.1));
operator!(Mul, mul, |a, b| Dual(a.0 * b.0, a.1 * b.0 + a.0 * b.1));

impl Neg for Dual {
    type Output = Dual;

    fn neg(self) -> Dual {
        Dual(-self.0, -self.1)
    }
}

impl Zero for Dual {
    fn zero() -> Dual {
        Dual(0.0, 0.0)
    }

    fn is_zero(&self) -> bool {
        *self == Dual::zero()
    }
}

impl One for Dual {
    fn one() -> Dual {
        Dual(1.0, 0.0)
    }
}

impl Ring for Dual {
    fn from_i128(n: i128) -> Dual {
        Dual(f64::from_i128(n), 0.0)
    }
}

impl Algebra for Dual {
    const EXACTNESS: Exactness = f64::EXACTNESS;
    const NAME: &'static str = "Dual";

    fn from_rational(r: &BigRational) -> Dual {
        Dual(f64::from_rational(r), 0.0)
    }

    fn div_int(self, n: NonZeroI64) -> Dual {
        Dual(self.0.div_int(n), self.1.div_int(n))
    }

    fn is_defined(&self) -> bool {
        self.0.is_finite() && self.1.is_finite()
    }
}

impl OwnNumerators for Dual {
    fn ratio(n: Dual, d: &Dual) -> Option<Dual> {
        let value = f64::ratio(n.0, &d.0)?;
        let slope = f64::ratio(n.1 - value * d.1, &d.0)?;
        Some(Dual(value, slope))
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
