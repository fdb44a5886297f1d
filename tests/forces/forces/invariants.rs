//! Invariants of every stacking on every region (`paper`, "Invariants"): weight, first and second moments, zero torsion.
//!
//! Horizontal positions are in thirds of the two lattice vectors of a layer, so all values are rational. The lattice vectors
//! have length √3·2R sinθ and meet at 60°. So (p, q) has the distance √((p² + pq + q²)/3)·2R sinθ from the axis. The height
//! over the base is n·2R cosθ, and (n·2R cosθ)² tan²θ = n² in the unit (2R sinθ)².

use cannonpile::Forces;
use cannonpile::shape::Selection;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};

use cannonpile_testkit::cases::{Bounds, Case, Random, all_signs, repeated};
use cannonpile_testkit::oracles::balance::{Balance, Place, ratio};

/// The forces on the floor: position, normal force in mg, shear in mg·tanθ and √3·mg·tanθ.
pub(crate) type Base = Vec<(Place, [BigRational; 3])>;

pub(crate) fn base(case: &Case) -> Base {
    let forces: Forces<BigRational> = case.pile.forces();
    let bottom = forces.base(Selection::Base).unwrap().map(|force| {
        let force = force.unwrap();
        let place = (force.site.k, force.site.j, force.site.i);
        (place, [force.normal, force.shear_x, force.shear_y])
    });
    bottom.collect()
}

/// The squared distance from the axis, in (2R sinθ)².
pub(crate) fn square([p, q]: &[BigInt; 2]) -> BigRational {
    BigRational::new(p * p + p * q + q * q, 3.into())
}

/// The normal forces have the total weight and its first and second moments.
pub(crate) fn has_the_moments(balance: &Balance, base: &Base) -> Result<(), String> {
    let same = |what: &str, base: &BigRational, spheres: &BigRational| {
        let parted = format!("{what}: {base} on the base, {spheres} of the spheres");
        if base == spheres { Ok(()) } else { Err(parted) }
    };
    let over_base = |of: &dyn Fn(Place) -> BigRational| -> BigRational {
        base.iter().map(|(at, [n, ..])| n * of(*at)).sum()
    };
    let over_spheres = |of: &dyn Fn(Place) -> BigRational| -> BigRational {
        balance.places().map(|at| balance.weight(at) * of(at)).sum()
    };
    let one = |_| BigRational::one();
    same("weight", &over_base(&one), &over_spheres(&one))?;
    for axis in [0, 1] {
        let along = |at| BigRational::from(balance.position(at)[axis].clone());
        same("moment", &over_base(&along), &over_spheres(&along))?;
    }
    let floor = balance.layers.len() - 1;
    let second = |at: Place| {
        let height = BigInt::from(floor) - at.0;
        square(&balance.position(at)) + BigRational::from(&height * &height)
    };
    same("second moment", &over_base(&second), &over_spheres(&second))
}

/// The total shear and the torsion are zero.
pub(crate) fn has_no_shear_or_torsion(balance: &Balance, base: &Base) -> Result<(), String> {
    let [mut x, mut y, mut torsion] = [0; 3].map(|_: i32| BigRational::zero());
    for (at, [_, shear_x, shear_y]) in base {
        let [p, q] = balance.position(*at).map(BigRational::from);
        // (p, q) is (q/2, (p + q/2)/3) in units of 2R sinθ and √3·2R sinθ.
        let half = &q / BigInt::from(2);
        let across = (p + &half) / BigInt::from(3);
        torsion += half * shear_y - across * shear_x;
        x += shear_x;
        y += shear_y;
    }
    if [&x, &y, &torsion].into_iter().all(BigRational::is_zero) {
        return Ok(());
    }
    Err(format!("shear {x} {y}, torsion {torsion}"))
}

fn holds(case: &Case) {
    let base = base(case);
    has_the_moments(&case.balance, &base).unwrap();
    has_no_shear_or_torsion(&case.balance, &base).unwrap();
}

#[test]
fn of_every_stacking_under_one_sphere_up_to_8_layers() {
    for steps in 0..8 {
        for signs in all_signs(steps) {
            holds(&Case::under(&Bounds::SITE, &signs));
        }
    }
}

#[test]
fn of_random_piles_with_weights_and_loads() {
    let mut random = Random(31);
    for round in 0..120 {
        let (steps, loads) = (random.below(10), random.below(6));
        let signs = random.signs(steps);
        let mut case = Case::under(&random.bounds(4), &signs);
        if round % 3 == 0 {
            case = case.weightless();
        }
        holds(&case.with_random_loads(loads, &mut random));
        if let Some(case) = Case::on(&random.bounds(12), &signs) {
            holds(&case.with_random_loads(loads, &mut random));
        }
    }
}

#[test]
fn of_piles_of_40_layers() {
    for signs in [
        repeated("+-", 39),
        repeated("++--", 39),
        repeated("+--", 39),
        Random(32).signs(39),
    ] {
        holds(&Case::under(&Bounds::SITE, &signs));
    }
    let base = Bounds::hexagon(12, 12);
    holds(&Case::on(&base, &repeated("+-", 12)).expect("it fits"));
}

#[test]
fn a_slightly_wrong_force_is_caught() {
    let case = Case::under(&Bounds::triangle(2), "+-+");
    let right = base(&case);
    for n in 0..right.len() {
        for component in 0..3 {
            let mut wrong = right.clone();
            wrong[n].1[component] += ratio(1, 81);
            let noticed = has_the_moments(&case.balance, &wrong)
                .and(has_no_shear_or_torsion(&case.balance, &wrong));
            assert!(noticed.is_err(), "{n} {component}");
        }
    }
    // One sphere gives some force to another at the same distance from the axis. The weight and the second moment stay the
    // same.
    let mut wrong = right.clone();
    wrong[0].1[0] += ratio(1, 81);
    wrong[1].1[0] -= ratio(1, 81);
    assert!(has_the_moments(&case.balance, &wrong).is_err());
}
