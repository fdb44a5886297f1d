//! Denominators of the coefficients of means: at most 3^(j+1) for q^j times the denominator of the loads, and twice
//! that for shears.

use cannonpile::lattice::Region;
use cannonpile::scalar::{Polynomial, Symbol};
use cannonpile_disorder::{FirstSign, MeanForce};
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{Anchor, Piles};

const Q: Symbol = Symbol("q");

/// Returns the coefficients of the powers of q.
fn coefficients(polynomial: &Polynomial) -> Vec<BigRational> {
    let mut rest = polynomial.clone();
    let mut coefficients = Vec::new();
    while !rest.is_zero() {
        let first = rest.evaluate(&[(Q, BigRational::zero())]).unwrap();
        rest = (rest - &Polynomial::constant(&first))
            .divide_exactly(&Polynomial::from(Q))
            .unwrap();
        coefficients.push(first);
    }
    coefficients
}

/// Returns the least common denominators of the coefficients of normal forces and of shears, by power of q.
fn denominators(described: &Piles) -> Vec<[BigInt; 2]> {
    let polynomials = described
        .piles()
        .unwrap()
        .by_faults()
        .unwrap()
        .polynomial()
        .unwrap();
    let mut denominators: Vec<[BigInt; 2]> = Vec::new();
    for MeanForce {
        normal,
        shear_x,
        shear_y,
        ..
    } in polynomials.rows()
    {
        for (kind, polynomial) in [(0, normal), (1, shear_x), (1, shear_y)] {
            for (j, coefficient) in coefficients(polynomial).into_iter().enumerate() {
                let most = denominators.len().max(j + 1);
                denominators.resize(most, [BigInt::one(), BigInt::one()]);
                let one = &mut denominators[j][kind];
                *one = one.lcm(coefficient.denom());
            }
        }
    }
    denominators
}

#[test]
fn denominators_of_every_power_of_q() {
    let tops = [Region::SITE, Region::triangle(3).unwrap()];
    for steps in 0..=7 {
        for (first, firsts) in [(FirstSign::Plus, 1), (FirstSign::Random, 2)] {
            let mut all = vec![(Piles::response(steps, first), 1)];
            let mut loaded = Piles::response(steps, first);
            loaded.loads.push(([1, 1], ratio(2, 35)));
            all.push((loaded, 35));
            all.extend(tops.map(|top| (Piles::heavy(Anchor::Top(top), steps, first), 1)));
            if steps < 4 {
                let base = Region::hexagon(3, 3).unwrap();
                all.push((Piles::heavy(Anchor::Base(base), steps, first), 1));
            }
            for (described, of_loads) in all {
                for (j, [normal, shear]) in denominators(&described).into_iter().enumerate() {
                    let bound: BigInt = pow(BigInt::from(3), j + 1) * of_loads * firsts;
                    assert!(
                        bound.is_multiple_of(&normal),
                        "{described:?} q^{j}: {normal}"
                    );
                    let twice: BigInt = bound * 2;
                    assert!(twice.is_multiple_of(&shear), "{described:?} q^{j}: {shear}");
                }
            }
        }
    }
}

/// For a unit load the bound is attained by all normal forces of up to seven steps with one exception, and by the
/// shears without sign changes.
#[test]
fn bounds_of_denominators_are_attained() {
    for steps in 1..=7_usize {
        let found = denominators(&Piles::response(steps, FirstSign::Plus));
        assert_eq!(found[0][1], BigInt::from(6));
        let normals = found.into_iter().map(|[normal, _]| normal);
        let bounds = (0..steps).map(|j| match (steps, j) {
            (7, 5) => BigInt::from(243),
            _ => pow(BigInt::from(3), j + 1),
        });
        assert_eq!(normals.collect::<Vec<_>>(), bounds.collect::<Vec<_>>());
    }
}

/// The sums of normal forces are integers over 3^(d+1) times the least common denominator of the loads, and the shears
/// over twice that.
#[test]
fn denominators_of_sums_by_faults() {
    let mut described = Piles::response(4, FirstSign::Plus);
    described.loads = vec![([0, 0], ratio(2, 15)), ([1, 1], ratio(3, 10))];
    let by_faults = described.piles().unwrap().by_faults().unwrap();
    let denominators = (0..4).map(|d| by_faults.denominator(d));
    assert!(denominators.eq([90, 270, 810, 2430].map(BigInt::from)));
    for row in by_faults.rows() {
        let row = row.unwrap();
        let denominator = by_faults.denominator(row.faults);
        assert!((row.normal * &denominator).is_integer());
        for shear in [row.shear_x, row.shear_y] {
            assert!((shear * &denominator * BigInt::from(2)).is_integer());
        }
    }
}
