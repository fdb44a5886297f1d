//! Forces as vectors and positions, for any stacking, compared with the positions of the oracle.

use cannonpile::Forces;
use cannonpile::geometry::Vector;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

use cannonpile_testkit::cases::{Bounds, Case, Random, all_signs};
use cannonpile_testkit::oracles::balance::{Balance, Place, direction, ratio, site};

/// A horizontal displacement in thirds of lattice vectors, and a number of layers down, in the basis of the paper's (1): 2R
/// times sinθ, √3·sinθ, cosθ. In this basis the lattice vectors are (0, 1) and (3/2, 1/2).
fn vector([p, q]: &[BigInt; 2], down: i128) -> Vector<BigRational> {
    Vector {
        x: BigRational::new(q.clone(), 2.into()),
        y: BigRational::new(2 * p + q, 6.into()),
        z: BigRational::from_integer(down.into()),
    }
}

/// The displacement from a sphere to the next one along a contact.
fn displacement(balance: &Balance, from: Place, to: Place) -> Vector<BigRational> {
    let [[p0, q0], [p1, q1]] = [from, to].map(|at| balance.position(at));
    vector(&[p1 - p0, q1 - q0], to.0 - from.0)
}

fn agrees(case: &Case) {
    let (balance, known) = (&case.balance, case.balance.forces());
    let forces: Forces<BigRational> = case.pile.forces();
    let first = balance.places().next().expect("a sphere");
    let origin = forces.position(site(first)).unwrap();
    for at in balance.places() {
        let from_first = forces.position(site(at)).unwrap() - &origin;
        assert_eq!(from_first, displacement(balance, first, at), "{at:?}");
        let mut resultant = Vector::zero();
        for m in 0..3 {
            if let Some(above) = balance.above(at, m) {
                let force = &known.above[&at][m];
                resultant = resultant + &displacement(balance, above, at).map(|c| c * force);
            }
        }
        assert_eq!(forces.resultant_above(site(at)), Ok(resultant), "{at:?}");
        let Some(below) = known.below.get(&at) else {
            continue;
        };
        for (m, force) in below.iter().enumerate() {
            let to = balance.below(at, m).expect("off the floor");
            // The force on the upper sphere points away from the lower one.
            let expected = displacement(balance, to, at).map(|c| c * force);
            let vector = forces.contact_vector(site(at), direction(m));
            assert_eq!(vector, Ok(expected), "{at:?} {m}");
        }
        assert_eq!(forces.unbalanced(site(at)), Ok(Vector::zero()), "{at:?}");
    }
}

#[test]
fn of_every_stacking_under_one_sphere_up_to_6_layers() {
    for signs in (0..6).flat_map(all_signs) {
        agrees(&Case::under(&Bounds::SITE, &signs));
    }
}

#[test]
fn of_random_piles_with_loads() {
    let mut random = Random(101);
    for _ in 0..40 {
        let signs = random.signs(6);
        agrees(&Case::under(&random.bounds(3), &signs).with_random_loads(3, &mut random));
        if let Some(case) = Case::on(&random.bounds(10), &signs) {
            agrees(&case.with_random_loads(3, &mut random));
        }
    }
}

#[test]
fn positions_are_relative_to_the_apex() {
    let case = Case::under(&Bounds::SITE, "+-++-");
    let apex = case.pile.forces::<BigRational>().position(site((0, 0, 0)));
    assert_eq!(apex, Ok(Vector::zero()));
}

#[test]
fn a_moved_sphere_is_caught() {
    let balance = Case::under(&Bounds::SITE, "+-").balance;
    let [here, there] = [(2, 0, 0), (2, 0, 1)].map(|at| displacement(&balance, (0, 0, 0), at));
    assert!(here.x.is_zero() && here.y.is_zero());
    assert_eq!((there.x, there.y), (ratio(0, 1), ratio(1, 1)));
}
