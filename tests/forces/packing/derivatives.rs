//! Geometry of one's own: forces in newtons, differentiated by the spacing.

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::Algebra;
use cannonpile::{Load, Packing, Pile, SiBasis, ratio};
use num_rational::BigRational;

use crate::dual::Dual;

/// Dual numbers in sinθ and cosθ differentiate forces in newtons by the spacing.
#[test]
fn forces_in_newtons_have_a_derivative_by_the_spacing() {
    let pile = Pile::under(Region::SITE, "+-+".parse().unwrap()).unwrap();
    let push = Load {
        down: ratio!(1),
        x: ratio!(1 / 3),
        y: ratio!(-1 / 5),
    };
    let pile = pile.with_load(Site::APEX, push).unwrap();
    let basis = |ratio: f64| {
        // sin²θ = (a/R)²/3.
        let (sin, slope) = (ratio / 3_f64.sqrt(), 1.0 / 3_f64.sqrt());
        let cos = (1.0 - sin * sin).sqrt();
        let constant = Dual::constant;
        SiBasis {
            sin: Dual { value: sin, slope },
            cos: Dual {
                value: cos,
                slope: -sin * slope / cos,
            },
            twice_cos_phi: constant(3_f64.sqrt()),
            weight: constant(2.5),
            radius: constant(0.5),
        }
    };
    let forces = pile.forces::<Dual<f64>>();
    let (site, direction) = (Site::new(1, 0, 2), Direction::Beta);
    let bottom = Site::new(1, 0, 3);
    let all = |basis: &SiBasis<Dual<f64>>| {
        let mut all = vec![basis.contact(&forces, site, direction).unwrap()];
        all.extend(basis.contact_vector(&forces, site, direction).unwrap());
        all.extend(basis.position(&forces, site).unwrap());
        let floor = basis.on_floor(&forces, bottom).unwrap();
        all.extend([floor.normal, floor.shear_x, floor.shear_y]);
        all
    };
    let packing = |ratio: &BigRational| {
        let spacing = cannonpile::geometry::Spacing::new(ratio.clone()).unwrap();
        let packing = Packing::new(&pile, &spacing).unwrap();
        let packing = packing
            .with_mass(ratio!(5 / 2))
            .unwrap()
            .with_radius(ratio!(1 / 2))
            .unwrap();
        let mut all = vec![packing.contact(site, direction).unwrap()];
        all.extend(packing.contact_vector(site, direction).unwrap());
        all.extend(packing.position(site).unwrap());
        let floor = packing.on_floor(bottom).unwrap();
        all.extend([floor.normal, floor.shear_x, floor.shear_y]);
        all.into_iter()
            .map(|surd| surd.to_f64())
            .collect::<Vec<f64>>()
    };
    let (at, step) = (ratio!(6 / 5), ratio!(1 / 100_000));
    let (middle, low, high) = (
        packing(&at),
        packing(&(&at - &step)),
        packing(&(&at + &step)),
    );
    for (n, dual) in all(&basis(f64::from_rational(&at))).into_iter().enumerate() {
        assert!((dual.value - middle[n]).abs() < 1e-12, "{n}");
        let slope = (high[n] - low[n]) / (2.0 * f64::from_rational(&step));
        assert!(
            (dual.slope - slope).abs() < 1e-6 * (1.0 + slope.abs()),
            "{n} {slope} {dual:?}"
        );
    }
}
