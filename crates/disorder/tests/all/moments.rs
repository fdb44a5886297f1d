//! Second moments: of all stackings one by one.

use std::collections::BTreeMap;

use cannonpile::scalar::{Polynomial, Symbol};
use cannonpile_disorder::{FirstSign, Place};
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero, pow};

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{Piles, named, probabilities};
use cannonpile_testkit::oracles::one_by_one::{self, faults};

/// The products of the normals of every two places, in the mean.
fn products(
    described: &Piles,
    q: &BigRational,
) -> BTreeMap<(one_by_one::Place, one_by_one::Place), BigRational> {
    let choices = described.steps.saturating_sub(1);
    let stackings = described.stackings();
    let mut products = BTreeMap::new();
    for signs in &stackings {
        let d = faults(signs);
        let share = pow(q.clone(), d) * pow(BigRational::one() - q, choices - d);
        let firsts = if described.first == FirstSign::Random && described.steps > 0 {
            2
        } else {
            1
        };
        let share = share / ratio(firsts, 1);
        let bottom = described.bottom(signs);
        for (x, first) in &bottom {
            for (y, second) in &bottom {
                let product = &first[0] * &second[0] * &share;
                *products.entry((*x, *y)).or_insert_with(BigRational::zero) += product;
            }
        }
    }
    products
}

fn described() -> Vec<Piles> {
    let mut all = Vec::new();
    for steps in 0..=6 {
        for first in [FirstSign::Plus, FirstSign::Minus, FirstSign::Random] {
            all.push(Piles::response(steps, first));
            if steps <= 3 {
                let mut several = Piles::response(steps, first);
                several.loads.push(([1, 0], ratio(2, 5)));
                several.loads.push(([-1, 3], ratio(1, 3)));
                several.loads.push(([40, -7], ratio(1, 2)));
                all.push(several);
            }
        }
    }
    all
}

#[test]
fn squares_and_products_of_all_stackings() {
    for described in described() {
        let piles = described.piles().unwrap();
        for q in [ratio(0, 1), ratio(1, 3), ratio(1, 1)] {
            let expected = products(&described, &q);
            let diagonal = expected.iter().filter(|((x, y), _)| x == y);
            let squares: BigRational = diagonal.map(|(_, product)| product.clone()).sum();
            let found = piles.mean_square(&q).unwrap();
            assert_eq!(found, squares, "{described:?} {q}");
            let float = piles.mean_square(&q.to_f64().unwrap()).unwrap();
            assert!((float - squares.to_f64().unwrap()).abs() < 1e-13);
            if described.steps > 4 {
                continue;
            }
            let pairs = piles.pair_moments(&q).unwrap();
            let names = pairs.pairs().map(|(x, y)| ((named(x), named(y)), (x, y)));
            let names: BTreeMap<_, _> = names.collect();
            for (pair, product) in &expected {
                let found = names.get(pair).map(|(x, y)| pairs.normals(*x, *y));
                // Both bear something together in some stacking, or the sum of products is 0.
                assert_eq!(
                    found.unwrap_or_else(BigRational::zero),
                    *product,
                    "{described:?} {pair:?}"
                );
            }
            let sum: BigRational = names.values().map(|(x, y)| pairs.normals(*x, *y)).sum();
            let load: BigRational = described.loads.iter().map(|(_, load)| load.clone()).sum();
            assert_eq!(sum, &load * &load);
        }
    }
}

/// 9^(d+1) Σ v², summed over the stackings with d faults.
#[test]
fn squares_by_faults() {
    let q = Polynomial::from(Symbol("q"));
    let straight = Polynomial::one() - &q;
    for (steps, squares) in [(1, vec![3]), (2, vec![3, 33]), (3, vec![3, 54, 435])] {
        let piles = Piles::response(steps, FirstSign::Plus).piles().unwrap();
        let terms = squares.iter().enumerate().map(|(d, square)| {
            let scale = BigRational::new((*square).into(), pow(num_bigint::BigInt::from(9), d + 1));
            let shares = Polynomial::constant(&scale) * &pow(q.clone(), d);
            shares * &pow(straight.clone(), steps - 1 - d)
        });
        let expected = terms.fold(Polynomial::zero(), |sum, term| sum + &term);
        assert_eq!(piles.mean_square(&q).unwrap(), expected);
    }
}

/// Of the forces along the lines: a third of the sum of squares is kept in every stacking, and their correlations vanish.
#[test]
fn forces_keep_their_sum_of_squares() {
    for steps in 1..=6 {
        let piles = Piles::response(steps, FirstSign::Random).piles().unwrap();
        for q in probabilities() {
            let pairs = piles.pair_moments(&q).unwrap();
            let mut squares = BigRational::zero();
            for (x, y) in pairs.pairs().filter(|(x, y)| x == y) {
                let products = pairs.from_above(x, y);
                squares += (0..3)
                    .map(|line| products[line][line].clone())
                    .sum::<BigRational>();
            }
            assert_eq!(squares, ratio(3, 1), "{steps} {q}");
        }
    }
    let nowhere = Place { a: 99, b: 0 };
    let piles = Piles::response(3, FirstSign::Plus).piles().unwrap();
    assert_eq!(
        piles
            .pair_moments(&ratio(1, 2))
            .unwrap()
            .normals(nowhere, nowhere),
        ratio(0, 1)
    );
}

/// Deep down loads and both components of the force share the squares evenly: 1/3, but 1/2 in HCP.
#[test]
fn squares_deep_down() {
    let piles = Piles::response(60, FirstSign::Plus).piles().unwrap();
    let [fcc, half, hcp] = [0.0, 0.5, 1.0].map(|q: f64| piles.mean_square(&q).unwrap());
    assert!((fcc - 1.0 / 3.0).abs() < 1e-13);
    assert!((half - 1.0 / 3.0).abs() < 0.02, "{half}");
    assert!((hcp - 0.5).abs() < 0.05, "{hcp}");
}

/// Another sign of the half-turn, one half-turn instead of two, a place off by a step: each would show.
#[test]
fn planted_faults_are_found() {
    let right = Piles::response(4, FirstSign::Plus);
    let piles = right.piles().unwrap();
    let q = ratio(1, 3);
    let squares = piles.mean_square(&q).unwrap();
    let diagonal = |products: &BTreeMap<_, BigRational>| {
        let of = |((x, y), product): (&(one_by_one::Place, one_by_one::Place), &BigRational)| {
            (x == y).then(|| product.clone())
        };
        products.iter().filter_map(of).sum::<BigRational>()
    };
    assert_eq!(diagonal(&products(&right, &q)), squares);
    assert_ne!(diagonal(&products(&right, &ratio(1, 4))), squares);
    let longer = Piles::response(5, FirstSign::Plus);
    assert_ne!(diagonal(&products(&longer, &q)), squares);
}
