//! Σf and Σf² depend on the weights only. Their means follow from the mean sizes and weights of the layers.

use cannonpile::Pile;
use cannonpile::lattice::{Region, Sign, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{Anchor, Piles, faults, probabilities};

fn whole(n: i64) -> BigRational {
    BigRational::from_integer(n.into())
}

fn square(x: &BigRational) -> BigRational {
    x * x
}

/// Returns the means of Σf and Σf² over the contacts below layer k. Each stacking is computed as a pile, and weighted
/// with its probability.
fn enumerated(described: &Piles, q: &BigRational, k: i128) -> [BigRational; 2] {
    let Anchor::Top(top) = described.anchor else {
        unreachable!("only tops are asked");
    };
    let choices = described.steps - 1;
    let [mut sum, mut squares] = [BigRational::zero(), BigRational::zero()];
    for signs in described.stackings() {
        let d = faults(&signs);
        let share = pow(q.clone(), d) * pow(whole(1) - q, choices - d);
        let sign = |sign: &i64| if *sign > 0 { Sign::Plus } else { Sign::Minus };
        let stacking = Stacking::from_signs(signs.iter().map(sign)).unwrap();
        let mut pile = Pile::under(top, stacking).unwrap();
        for ([i, j], load) in &described.loads {
            let (i, j) = (i128::from(*i), i128::from(*j));
            pile = pile.with_load(Site { i, j, k: 0 }, load.clone()).unwrap();
        }
        if described.weightless {
            pile = pile.weightless();
        }
        let forces = pile.forces::<BigRational>();
        for contact in forces.contacts(Selection::Layer(k)).unwrap() {
            let force = contact.unwrap().force;
            sum += &force * &share;
            squares += square(&force) * &share;
        }
    }
    let firsts = if described.first == FirstSign::Random {
        2
    } else {
        1
    };
    [sum, squares].map(|sum| sum / whole(firsts))
}

/// From the mean sizes of the layers only: Σf = 3W_k and Σf² = Σ_j (3n_j + 6W_(j−1)) over j ≤ k, including the loads on
/// the top layer.
fn of_means(described: &Piles, q: &BigRational, k: usize) -> [BigRational; 2] {
    let weight = whole(i64::from(!described.weightless));
    let mean = |steps: usize| {
        let piles = Piles {
            steps,
            ..described.clone()
        };
        let mean = piles.piles().unwrap().exact(q).unwrap();
        let total = |of: fn(&cannonpile_disorder::MeanForce<BigRational>) -> &BigRational| {
            mean.rows().iter().map(of).sum::<BigRational>()
        };
        [total(|row| &row.probability), total(|row| &row.normal)]
    };
    let top = described.piles().unwrap();
    assert_eq!(top.is_weightless(), described.weightless);
    let loads = |site: [i64; 2]| {
        let on = described.loads.iter().filter(|(at, _)| *at == site);
        on.map(|(_, load)| load.clone()).sum::<BigRational>()
    };
    let Anchor::Top(region) = described.anchor else {
        unreachable!("only tops are asked");
    };
    let sites = region
        .rows(0)
        .flat_map(|row| row.i.map(move |i| [i, row.j]));
    let sites = sites.map(|site| site.map(|x| i64::try_from(x).unwrap()));
    let mut squares: BigRational = sites
        .map(|site| square(&(&weight + loads(site))) * whole(3))
        .sum();
    let [_, mut borne] = mean(0);
    for steps in 1..=k {
        let [spheres, with_it] = mean(steps);
        squares += (spheres * whole(3) + borne * whole(6)) * &weight;
        borne = with_it;
    }
    [borne * whole(3), squares]
}

#[test]
fn sums_under_gravity_and_loads() {
    let tops = [
        Region::SITE,
        Region::triangle(2).unwrap(),
        Region::new(-1..=2, 3..=3, 2..=5).unwrap(),
    ];
    for top in tops {
        for first in [FirstSign::Plus, FirstSign::Minus, FirstSign::Random] {
            let mut described = Piles::heavy(Anchor::Top(top), 5, first);
            let row = top.rows(0).next().unwrap();
            let [i, j] = [row.i.start, row.j].map(|x| i64::try_from(x).unwrap());
            for (load, weightless) in [(0, false), (5, false), (5, true)] {
                described.loads = vec![([i, j], ratio(load, 2))];
                described.weightless = weightless;
                for q in [ratio(1, 3), ratio(1, 1)] {
                    for k in 0..5_usize {
                        let found = enumerated(&described, &q, k as i128);
                        assert_eq!(of_means(&described, &q, k), found, "{described:?} {q} {k}");
                    }
                }
            }
        }
    }
}

/// The square of the mean response is less than the mean of the square, unless there is only one stacking.
#[test]
fn squares_of_the_mean_are_less_than_mean_squares() {
    for steps in 1..=6 {
        let stackings = RandomStackings::new(steps + 1, FirstSign::Plus).unwrap();
        let plane = RandomPiles::plane(stackings).weightless();
        let plane = plane.with_load(Site::APEX, whole(2)).unwrap();
        let plane = plane
            .with_load(Site { i: 2, j: -1, k: 0 }, ratio(1, 3))
            .unwrap();
        for q in probabilities() {
            let mean = plane.exact(&q).unwrap();
            let of_mean: BigRational = mean.rows().iter().map(|row| square(&row.normal)).sum();
            let mean_square = plane.mean_square(&q).unwrap();
            let is_one_stacking = q.is_zero() || q.is_one() || steps == 1;
            assert_eq!(of_mean == mean_square, is_one_stacking, "{steps} {q}");
            assert!(of_mean <= mean_square);
        }
    }
}
