//! The mean square of the response, compared with enumeration.

use cannonpile::scalar::{Polynomial, Symbol};
use cannonpile_disorder::FirstSign;
use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero, pow};

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{Piles, faults};

/// Returns the mean over all stackings of the sum of squared normal forces.
fn enumerated(described: &Piles, q: &BigRational) -> BigRational {
    let choices = described.steps.saturating_sub(1);
    let stackings = described.stackings();
    let random = described.first == FirstSign::Random && described.steps > 0;
    let firsts = ratio(if random { 2 } else { 1 }, 1);
    let terms = stackings.iter().map(|signs| {
        let d = faults(signs);
        let share = pow(q.clone(), d) * pow(BigRational::one() - q, choices - d) / &firsts;
        let bottom = described.bottom(signs).into_values();
        let squares = bottom.map(|[normal, ..]| &normal * &normal);
        squares.sum::<BigRational>() * share
    });
    terms.sum()
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
fn mean_squares_agree_with_enumeration() {
    for described in described() {
        let piles = described.piles().unwrap();
        for q in [ratio(0, 1), ratio(1, 3), ratio(1, 1)] {
            let expected = enumerated(&described, &q);
            let found = piles.mean_square(&q).unwrap();
            assert_eq!(found, expected, "{described:?} {q}");
            let float = piles.mean_square(&q.to_f64().unwrap()).unwrap();
            assert!((float - expected.to_f64().unwrap()).abs() < 1e-13);
        }
    }
}

/// The reference values are 9^(d+1) Σ v², summed over the stackings with d faults.
#[test]
fn mean_squares_by_faults() {
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

/// At great depth the load and both horizontal components contribute equally: 1/3 each, but 1/2 for the load in HCP.
#[test]
fn mean_squares_at_great_depth() {
    let piles = Piles::response(60, FirstSign::Plus).piles().unwrap();
    let [fcc, half, hcp] = [0.0, 0.5, 1.0].map(|q: f64| piles.mean_square(&q).unwrap());
    assert!((fcc - 1.0 / 3.0).abs() < 1e-13);
    assert!((half - 1.0 / 3.0).abs() < 0.02, "{half}");
    assert!((hcp - 0.5).abs() < 0.05, "{hcp}");
}

/// Another probability or another number of steps changes the mean square.
#[test]
fn planted_faults_are_detected() {
    let right = Piles::response(4, FirstSign::Plus);
    let piles = right.piles().unwrap();
    let q = ratio(1, 3);
    let squares = piles.mean_square(&q).unwrap();
    assert_eq!(enumerated(&right, &q), squares);
    assert_ne!(enumerated(&right, &ratio(1, 4)), squares);
    let longer = Piles::response(5, FirstSign::Plus);
    assert_ne!(enumerated(&longer, &q), squares);
}

/// If no sphere receives forces of both loads, the squares add up at every distance.
#[test]
fn mean_squares_of_distant_loads_add_up() {
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

/// Checks floats at q = 1/4, for the largest numbers of steps that are enumerated.
#[test]
fn mean_squares_of_more_steps() {
    for steps in [5, 6] {
        let described = Piles::response(steps, FirstSign::Plus);
        let squares = enumerated(&described, &ratio(1, 4));
        let found = described.piles().unwrap().mean_square(&0.25).unwrap();
        assert!((found - squares.to_f64().unwrap()).abs() < 1e-14, "{found}");
    }
}
