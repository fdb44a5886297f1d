//! Products of the forces that come to every two bottom spheres, in the mean: of all stackings one by one.

use std::collections::BTreeMap;

use cannonpile_disorder::FirstSign;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero, pow};

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{Piles, named};
use cannonpile_testkit::oracles::one_by_one::{Floor, Place, faults};

type Matrix = [[BigRational; 3]; 3];

fn zeros() -> Matrix {
    [(); 3].map(|()| [(); 3].map(|()| BigRational::zero()))
}

/// The forces from above that the floor feels so, in f₀, under a step of this sign: their sum is three times the normal force,
/// and what those of β and γ exceed that of α by is the horizontal force.
fn from_above([normal, shear_x, shear_y]: &Floor, sign: i64) -> [BigRational; 3] {
    let along_b = shear_y * ratio(2 * sign, 1);
    let along_c = (shear_x + shear_y) * ratio(sign, 1);
    let alpha = normal - &along_b - &along_c;
    let [beta, gamma] = [along_b, along_c].map(|more| &alpha + more * ratio(3, 1));
    [alpha, beta, gamma]
}

/// By pair of places: the products of the forces from above, and of the normal forces.
fn enumerated(
    described: &Piles,
    q: &BigRational,
) -> BTreeMap<(Place, Place), (Matrix, BigRational)> {
    let choices = described.steps.saturating_sub(1);
    let stackings = described.stackings();
    let firsts = if described.first == FirstSign::Random && described.steps > 0 {
        2
    } else {
        1
    };
    let mut products = BTreeMap::new();
    for signs in &stackings {
        let d = faults(signs);
        let share = pow(q.clone(), d) * pow(BigRational::one() - q, choices - d) / ratio(firsts, 1);
        let bottom = described.bottom(signs);
        let forces = |floor: &Floor| match signs.last() {
            Some(sign) => from_above(floor, *sign),
            // On a single layer there is nothing.
            None => [(); 3].map(|()| BigRational::zero()),
        };
        for (x, first) in &bottom {
            for (y, second) in &bottom {
                let entry = products.entry((*x, *y));
                let (matrix, normal) = entry.or_insert_with(|| (zeros(), BigRational::zero()));
                *normal += &first[0] * &second[0] * &share;
                for (row, f) in matrix.iter_mut().zip(forces(first)) {
                    for (sum, g) in row.iter_mut().zip(forces(second)) {
                        *sum += &f * g * &share;
                    }
                }
            }
        }
    }
    products.retain(|_, (matrix, normal)| {
        !normal.is_zero() || matrix.iter().flatten().any(|product| !product.is_zero())
    });
    products
}

/// What the library says, without pairs of which all is 0.
fn of_library(
    described: &Piles,
    q: &BigRational,
) -> BTreeMap<(Place, Place), (Matrix, BigRational)> {
    let moments = described.piles().unwrap().pair_moments(q).unwrap();
    let pairs = moments.pairs().map(|(x, y)| {
        let products = (moments.from_above(x, y), moments.normals(x, y));
        ((named(x), named(y)), products)
    });
    let mut pairs: BTreeMap<_, _> = pairs.collect();
    pairs.retain(|_, (matrix, normal)| {
        !normal.is_zero() || matrix.iter().flatten().any(|product| !product.is_zero())
    });
    pairs
}

#[test]
fn of_one_load() {
    for first in [FirstSign::Plus, FirstSign::Minus, FirstSign::Random] {
        for steps in 0..=3 {
            let described = Piles::response(steps, first);
            let q = ratio(2, 7);
            assert_eq!(
                of_library(&described, &q),
                enumerated(&described, &q),
                "{first} {steps}"
            );
        }
    }
}

#[test]
fn of_loads_that_differ() {
    for steps in 0..=2 {
        let mut described = Piles::response(steps, FirstSign::Random);
        described.loads.push(([1, 0], ratio(2, 5)));
        described.loads.push(([-1, 3], ratio(7, 3)));
        let q = ratio(2, 7);
        let found = of_library(&described, &q);
        assert_eq!(found, enumerated(&described, &q), "{steps}");
        let diagonal = found.iter().filter(|((x, y), _)| x == y);
        let squares: BigRational = diagonal.map(|(_, (_, normal))| normal.clone()).sum();
        let piles = described.piles().unwrap();
        assert_eq!(piles.mean_square(&q).unwrap(), squares, "{steps}");
    }
}

/// Loads too far apart for any sphere to feel both: the squares add up, at whatever distance.
#[test]
fn of_loads_that_do_not_meet() {
    for steps in [1, 2] {
        let of_one = Piles::response(steps, FirstSign::Plus);
        let one = of_one.piles().unwrap().mean_square(&ratio(1, 3)).unwrap();
        let far = i64::try_from(steps).unwrap() + 2;
        for i in [-far, -far + 1, 0, far - 1, far] {
            for j in [-far, far] {
                for at in [[i, j], [j, i]] {
                    let mut described = of_one.clone();
                    described.loads.push((at, ratio(3, 1)));
                    let found = described.piles().unwrap().mean_square(&ratio(1, 3));
                    assert_eq!(found.unwrap(), &one * ratio(10, 1), "{steps} {at:?}");
                }
            }
        }
    }
}

/// Five and six steps down, where forces of beginnings that are still far apart come together.
#[test]
fn squares_further_down() {
    for steps in [5, 6] {
        let described = Piles::response(steps, FirstSign::Plus);
        let mut squares = BigRational::zero();
        let q = ratio(1, 4);
        for signs in described.stackings() {
            let d = faults(&signs);
            let share = pow(q.clone(), d) * pow(BigRational::one() - &q, steps - 1 - d);
            let bottom = described.bottom(&signs).into_values();
            let sum: BigRational = bottom.map(|[normal, ..]| &normal * &normal).sum();
            squares += sum * share;
        }
        let found = described.piles().unwrap().mean_square(&0.25).unwrap();
        assert!((found - squares.to_f64().unwrap()).abs() < 1e-14, "{found}");
    }
}
