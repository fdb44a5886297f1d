//! Forces on the floor, sphere by sphere and summed over real piles.

use cannonpile::geometry::Vector;
use cannonpile::lattice::{Direction, Site};
use cannonpile::shape::Selection;
use cannonpile::theorem::{Formulas, find};
use cannonpile::{FloorForce, Pile};
use num_rational::BigRational as Q;
use num_traits::Zero;

use super::{RIGHT, equilateral_piles, evaluated, int, piles, prove, value};

const LAYERS: i128 = 12;

type Values = Vec<(&'static str, Q)>;

/// A bottom sphere: its force in mg/W and f₀, its horizontal position in 2R, and the values of L, i, j and s.
struct Bottom {
    force: FloorForce<Q>,
    x: Q,
    y: Q,
    values: Values,
}

fn base(pile: &Pile) -> Vec<Bottom> {
    let forces = pile.forces::<Q>();
    let weight = forces.increment_sum().expect("W");
    let of_force = |force: FloorForce<Q>| {
        let at = forces.position(force.site).expect("a position");
        let mut values = at_layers(pile);
        values.extend([("i", int(force.site.i)), ("j", int(force.site.j))]);
        let force = FloorForce {
            normal: force.normal * &weight,
            shear_x: force.shear_x * &weight,
            shear_y: force.shear_y * &weight,
            ..force
        };
        Bottom {
            force,
            x: at.x,
            y: at.y,
            values,
        }
    };
    let bottom = forces.base(Selection::Base).expect("rows");
    bottom
        .map(|force| of_force(force.expect("a force")))
        .collect()
}

fn at_layers(pile: &Pile) -> Values {
    vec![("L", int(pile.layers())), ("s", pile.sin_phi().clone())]
}

/// Σ over the base.
fn over(base: &[Bottom], term: impl Fn(&Bottom) -> Q) -> Q {
    base.iter().map(term).sum()
}

/// Σ over all spheres, times their weight W.
fn weighed(pile: &Pile, term: impl Fn(Site, Q, Q) -> Q) -> Q {
    let forces = pile.forces::<Q>();
    let of_sphere = |site| {
        let at = forces.position(site).expect("a position");
        term(site, at.x, at.y)
    };
    pile.shape().sites().map(of_sphere).sum::<Q>() * forces.increment_sum().expect("W")
}

#[test]
fn normal_forces() {
    let (normal, uniform) = (prove("base-normal"), prove("uniform-base"));
    for pile in piles(6) {
        let base = base(&pile);
        for here in &base {
            assert_eq!(
                value(&normal, "the normal force on the floor", &here.values),
                here.force.normal
            );
            if pile.is_regular() {
                assert_eq!(
                    value(&normal, "for s = 1/2", &here.values),
                    here.force.normal
                );
            }
            for there in &base {
                let mut values = here.values.clone();
                values.extend([
                    ("i'", int(there.force.site.i)),
                    ("j'", int(there.force.site.j)),
                ]);
                let difference = value(&uniform, "difference of two", &values);
                assert_eq!(difference, &here.force.normal - &there.force.normal);
                let rows = here.force.site.j - there.force.site.j;
                let alike = pile.is_regular() || rows == 0;
                assert_eq!(difference.is_zero(), alike);
                assert_eq!(value(&uniform, "divided", &values), int(rows));
            }
        }
    }
}

#[test]
fn the_weight_on_the_base() {
    let proof = prove("weight");
    for pile in piles(LAYERS) {
        let total = value(&proof, "ΣF_z", &at_layers(&pile));
        assert_eq!(
            total,
            over(&base(&pile), |sphere| sphere.force.normal.clone())
        );
        assert_eq!(total, weighed(&pile, |_, _, _| int(1)));
    }
}

#[test]
fn shears() {
    let [shear, on_axis, ratio] = ["shear", "shear-on-axis", "shear-ratio"].map(prove);
    for pile in equilateral_piles(LAYERS) {
        let mut greatest = Q::zero();
        let last = pile.layers() - 1;
        for Bottom {
            force,
            x,
            y,
            values,
        } in base(&pile)
        {
            let FloorForce {
                shear_x,
                shear_y,
                normal,
                ..
            } = force;
            assert_eq!(value(&shear, "2F_x", &values), &shear_x * int(2));
            assert_eq!(value(&shear, "2F_y", &values), &shear_y * int(2));
            assert_eq!(value(&on_axis, "F_x", &values), shear_x);
            assert_eq!(value(&on_axis, "F_y", &values), shear_y);
            assert_eq!((&shear_x, &shear_y), (&x, &y));
            // |shear|² in units of sin²θ: y has √3 in its unit.
            let square = &shear_x * &shear_x + int(3) * &shear_y * &shear_y;
            assert_eq!(
                value(&ratio, "(L−1)² − |shear|²", &values),
                int(last * last) - &square
            );
            assert_eq!(value(&ratio, "L+2 everywhere", &values), normal);
            greatest = greatest.max(square / (&normal * &normal));
        }
        let values = at_layers(&pile);
        for corner in Direction::ALL {
            let square = value(&ratio, &format!("|shear|² at the {corner}"), &values);
            let normal = int(last + 3);
            assert_eq!(square / (&normal * &normal), greatest);
        }
        let corner = pile.base_extremes().expect("corners").max_shear_ratio;
        let corner = corner.to_rational().expect("a fraction");
        assert_eq!(&corner * &corner, greatest);
    }
}

#[test]
fn total_shear_and_moments() {
    let [shear, moment] = ["total-shear", "total-moment"].map(prove);
    for pile in piles(LAYERS) {
        let (base, values) = (base(&pile), at_layers(&pile));
        assert_eq!(
            value(&shear, "ΣF_x", &values),
            over(&base, |b| b.force.shear_x.clone())
        );
        assert_eq!(
            value(&shear, "ΣF_y", &values),
            over(&base, |b| b.force.shear_y.clone())
        );
        let torsion = over(&base, |b| &b.x * &b.force.shear_y - &b.y * &b.force.shear_x);
        assert_eq!(value(&moment, "Σ(x F_y − y F_x)", &values), torsion);
        let about_y = value(&moment, "ΣF_z x", &values);
        assert_eq!(about_y, over(&base, |b| &b.force.normal * &b.x));
        assert_eq!(about_y, weighed(&pile, |_, x, _| x));
        let about_x = value(&moment, "ΣF_z y", &values);
        assert_eq!(about_x, over(&base, |b| &b.force.normal * &b.y));
        assert_eq!(about_x, weighed(&pile, |_, _, y| y));
    }
}

/// Forces rotated by a right angle have a moment equal to their former radial component.
#[test]
fn rotated_forces_have_a_moment() {
    let turned: Formulas = Formulas {
        support_load: |above, directions, weight| {
            let Vector { x, y, z } = (RIGHT.support_load)(above, directions, weight);
            Vector { x: -y, y: x, z }
        },
        ..RIGHT
    };
    let proof = find("total-moment").expect("a theorem").prove_for(&turned);
    let about_axis = &proof.steps[0];
    assert!(about_axis.claim.starts_with("Σ(x F_y"));
    for pile in piles(5) {
        let outwards = over(&base(&pile), |b| {
            &b.x * &b.force.shear_x + &b.y * &b.force.shear_y
        });
        let [moment, claimed] = evaluated(about_axis, &at_layers(&pile));
        assert_eq!(moment, outwards);
        assert!(claimed.is_zero());
    }
}

#[test]
fn second_moments() {
    let proof = prove("second-moment");
    for pile in piles(LAYERS) {
        let s = pile.sin_phi();
        let square = |x: &Q, y: &Q| x * x + int(4) * (int(1) - s * s) * y * y;
        let total = value(&proof, "ΣF_z r_b²", &at_layers(&pile));
        assert_eq!(
            total,
            over(&base(&pile), |b| &b.force.normal * square(&b.x, &b.y))
        );
        let of_weights = weighed(&pile, |site, x, y| {
            let height = pile.layers() - 1 - site.k;
            square(&x, &y) + int(height * height)
        });
        assert_eq!(total, of_weights);
    }
}
