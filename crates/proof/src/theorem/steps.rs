//! Horizontal steps of contacts, as complex numbers.

use cannonpile::each::Each;
use cannonpile::geometry::Vector;
use cannonpile::theorem::Formulas;
use cannonpile::theorem::setting::{P, Setting, int};
use num_traits::Zero;

use super::terms::unit;

/// A complex number x + iy√3, in units of ρ.
pub(super) type Complex = Vector<P>;

pub(super) fn complex(x: P, y: P) -> Complex {
    Vector { x, y, z: P::zero() }
}

pub(super) fn times(a: &Complex, b: &Complex) -> Complex {
    complex(
        a.x.clone() * &b.x - &(int(3) * &(a.y.clone() * &b.y)),
        a.x.clone() * &b.y + &(a.y.clone() * &b.x),
    )
}

pub(super) fn conjugate(a: &Complex) -> Complex {
    complex(a.x.clone(), -a.y.clone())
}

/// Returns Re(a b̄).
pub(super) fn dot(a: &Complex, b: &Complex) -> P {
    times(a, &conjugate(b)).x
}

/// Returns the horizontal parts of the three contacts, under + and under −.
pub(super) fn steps_down(f: &Formulas) -> [[Complex; 3]; 2] {
    let setting = Setting::equilateral(f);
    [setting.directions.clone(), setting.turned_directions(f)].each(|directions| {
        [0, 1, 2].each(|line| {
            let Vector { x, y, .. } = (f.position)(&unit(line), &directions);
            complex(x, y)
        })
    })
}
