//! Properties for any number of layers: moments, symmetries, limiting stackings and totals.

use std::collections::BTreeMap;

use cannonpile::lattice::{Region, Sign};
use cannonpile::scalar::{Polynomial, Symbol};
use cannonpile_disorder::{FirstSign, RandomPiles, RandomStackings};
use num_bigint::BigUint;
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{
    Anchor, Means, Piles, Place, Sums, by_faults, by_place, faults, named, probabilities,
};

fn whole(n: i64) -> BigRational {
    BigRational::from_integer(n.into())
}

/// Returns r² and r³ cos 3φ of a place, with φ measured from u_α, in units of ρ.
fn powers([a, b]: Place) -> (i64, BigRational) {
    let cube = whole(a * a * a + b * b * b) - ratio(3, 2) * whole(a * b * (a + b));
    (a * a - a * b + b * b, cube)
}

/// Returns the sum of the normal forces, their moments along u_β and u_γ, and those with r², r⁴ and r³ cos 3φ.
fn moments(normals: &BTreeMap<Place, BigRational>) -> [BigRational; 6] {
    let mut sums = [(); 6].map(|()| BigRational::zero());
    for (place, normal) in normals {
        let (square, cube) = powers(*place);
        let [a, b] = *place;
        let factors = [
            whole(1),
            whole(a),
            whole(b),
            whole(square),
            whole(square * square),
            cube,
        ];
        for (sum, factor) in sums.iter_mut().zip(factors) {
            *sum += factor * normal;
        }
    }
    sums
}

/// Returns the third and the fourth moment of one stacking, which no other test computes.
fn third_and_fourth(signs: &[i64]) -> [BigRational; 2] {
    let n = i64::try_from(signs.len()).unwrap();
    let mut third = 0;
    let mut fourth = whole(n * (2 * n * n * n + 2 * n * n - 2 * n + 1)) / whole(3);
    for (s, sign) in (1..).zip(signs) {
        third += sign * (3 * (n - s) * (2 * s - 1) + 3 * s - 2);
        for (t, other) in (1..).zip(signs).filter(|(t, _)| *t > s) {
            fourth += whole(2 * (2 * n - 2 * t + 1) * (2 * s - 1) * sign * other);
        }
    }
    [whole(third), fourth]
}

fn normals(sums: &Sums, of: usize) -> BTreeMap<Place, BigRational> {
    let of_faults = sums.iter().filter(|((_, faults), _)| *faults == of);
    of_faults
        .map(|((place, _), (_, floor))| (*place, floor[0].clone()))
        .collect()
}

/// Checks the moments of the response for each number of faults.
fn has_the_moments(steps: usize, sums: &Sums) -> Result<(), String> {
    let n = i64::try_from(steps).unwrap();
    let stackings = Piles::response(steps, FirstSign::Plus).stackings();
    for d in 0..steps {
        let of_faults = stackings.iter().filter(|signs| faults(signs) == d);
        let (mut count, mut third, mut fourth) = (0, whole(0), whole(0));
        for signs in of_faults {
            let [one, other] = third_and_fourth(signs);
            (third, fourth, count) = (third + one, fourth + other, count + 1);
        }
        let expected = [
            whole(count),
            whole(0),
            whole(0),
            whole(n * n * count),
            fourth,
            third,
        ];
        let found = moments(&normals(sums, d));
        if found != expected {
            return Err(format!(
                "{steps} steps, {d} faults: {found:?}, not {expected:?}"
            ));
        }
    }
    Ok(())
}

#[test]
fn moments_of_every_number_of_faults() {
    for steps in 1..=11 {
        let piles = Piles::response(steps, FirstSign::Plus).piles().unwrap();
        has_the_moments(steps, &by_faults(&piles).unwrap()).unwrap();
    }
}

#[test]
fn planted_faults_change_the_moments() {
    let piles = Piles::response(5, FirstSign::Plus).piles().unwrap();
    let answer = by_faults(&piles).unwrap();
    let keys = [([1, 0], 2), ([-1, -1], 2)];
    // A small error that keeps the sum.
    let mut wrong = answer.clone();
    for (key, by) in keys.into_iter().zip([ratio(1, 27), ratio(-1, 27)]) {
        wrong.get_mut(&key).unwrap().1[0] += by;
    }
    assert!(has_the_moments(5, &wrong).is_err());
    let mut wrong = answer;
    wrong.get_mut(&keys[0]).unwrap().1[0] += ratio(1, 27);
    assert!(has_the_moments(5, &wrong).is_err());
}

/// The moments of the mean equal closed forms in μ = 1 − 2q.
#[test]
fn moments_of_the_mean() {
    for steps in 1..=14 {
        let piles = Piles::response(steps, FirstSign::Plus).piles().unwrap();
        let n = whole(i64::try_from(steps).unwrap());
        for q in [ratio(1, 3), ratio(1, 2), ratio(5, 7), ratio(1, 1)] {
            let mean = by_place(piles.exact(&q).unwrap());
            let normals = mean
                .into_iter()
                .map(|(place, [_, normal, _, _])| (place, normal));
            let [sum, along_b, along_c, second, fourth, third] = moments(&normals.collect());
            assert_eq!([sum, along_b, along_c], [whole(1), whole(0), whole(0)]);
            assert_eq!(second, &n * &n);
            let mu = whole(1) - &q - &q;
            let last = pow(mu.clone(), steps);
            let less = whole(1) - &mu;
            let [two, three, four] = [2, 3, 4].map(|power| pow(less.clone(), power));
            let square = &mu * &mu;
            let odd = (whole(1) + &mu) * &n * (whole(1) + &last) * whole(3) / &two
                - (&square + &mu * whole(4) + whole(1)) * (whole(1) - &last) * whole(2) / &three;
            assert_eq!(third, odd, "{steps} {q}");
            let cube = &n * &n * &n;
            let even = (&cube * &n * whole(2) + &cube * whole(2) - &n * &n * whole(2) + &n)
                / whole(3)
                + &mu * &cube * ratio(4, 3) / &less
                - &mu * &n * &n * whole(4) / &two
                + &mu * (&square + &mu * whole(4) + whole(7)) * &n * ratio(2, 3) / &three
                - &mu * pow(whole(1) + &mu, 2) * (whole(1) - &last) * whole(2) / &four;
            assert_eq!(fourth, even, "{steps} {q}");
        }
    }
}

/// Returns the forces at each place after a rotation by 120° or a reflection: the normal force, and the shear as a
/// vector.
fn image(mean: &Means, place: fn(Place) -> Place) -> Means {
    let rows = mean.iter().map(|(at, [probability, normal, x, y])| {
        // Along u_β and u_γ, in twice the unit.
        let along = [y + y, x + y];
        // The rotation is linear, so the images of both unit vectors determine it.
        let [[ba, bb], [ca, cb]] = [place([1, 0]), place([0, 1])];
        let [b, c] = [
            &along[0] * whole(ba) + &along[1] * whole(ca),
            &along[0] * whole(bb) + &along[1] * whole(cb),
        ];
        let y = b / whole(2);
        let x = c - &y;
        (place(*at), [probability.clone(), normal.clone(), x, y])
    });
    rows.collect()
}

fn turned([a, b]: Place) -> Place {
    [-b, a - b]
}

fn mirrored([a, b]: Place) -> Place {
    [b, a]
}

fn opposite([a, b]: Place) -> Place {
    [-a, -b]
}

#[test]
fn symmetries() {
    let tops = [
        Region::SITE,
        Region::triangle(2).unwrap(),
        Region::hexagon(2, 2).unwrap(),
    ];
    let mut all = vec![
        Piles::response(6, FirstSign::Plus),
        Piles::response(5, FirstSign::Random),
    ];
    for first in [FirstSign::Plus, FirstSign::Random] {
        all.extend(tops.map(|top| Piles::heavy(Anchor::Top(top), 5, first)));
        let base = Region::hexagon(3, 3).unwrap();
        all.push(Piles::heavy(Anchor::Base(base), 3, first));
    }
    for described in all {
        // The triangle has its centre elsewhere, and differs from its image under a rotation by 180°.
        let triangle = described.anchor == Anchor::Top(Region::triangle(2).unwrap());
        let q = ratio(1, 3);
        let mean = by_place(described.piles().unwrap().exact(&q).unwrap());
        let moved: Means = if triangle {
            let shift = |([a, b], row): (Place, _)| ([3 * a - 3, 3 * b - 3], row);
            mean.into_iter().map(shift).collect()
        } else {
            mean
        };
        assert_eq!(image(&moved, turned), moved, "{described:?}");
        assert_eq!(image(&moved, mirrored), moved, "{described:?}");
        let both = described.first == FirstSign::Random && !triangle;
        let alike = image(&moved, opposite) == moved;
        let on_base = matches!(described.anchor, Anchor::Base(_));
        assert!(alike == both || on_base, "{described:?}");
    }
}

/// Piles with the first sign − are those with + after a rotation by 180°.
#[test]
fn other_first_sign_rotates_the_pile() {
    let mean = |first| {
        let piles = Piles::response(6, first).piles().unwrap();
        by_place(piles.exact(&ratio(2, 5)).unwrap())
    };
    let [plus, minus, random] = [FirstSign::Plus, FirstSign::Minus, FirstSign::Random].map(mean);
    let opposite = image(&minus, opposite);
    assert_eq!(opposite, plus);
    for (place, [probability, normal, _, _]) in &random {
        // A missing row stands for a place without sphere.
        let of = |means: &Means, n: usize| {
            means
                .get(place)
                .map_or_else(BigRational::zero, |row| row[n].clone())
        };
        assert_eq!(probability * whole(2), of(&plus, 0) + of(&minus, 0));
        assert_eq!(normal * whole(2), of(&plus, 1) + of(&minus, 1));
    }
}

/// At the ends of the three straight lines only FCC has a load: (1−q)^(n−1)/3.
#[test]
fn ends_of_straight_lines_are_fcc() {
    let q = Polynomial::from(Symbol("q"));
    for steps in 1..=12 {
        let piles = Piles::response(steps, FirstSign::Plus).piles().unwrap();
        let polynomials = piles.by_faults().unwrap().polynomial().unwrap();
        let n = steps as i128;
        let straight = Polynomial::one() - &q;
        let expected = (1..steps).fold(Polynomial::constant(&ratio(1, 3)), |power, _| {
            power * &straight
        });
        for [a, b] in [[-n, -n], [n, 0], [0, n]] {
            let row = polynomials.at(cannonpile_disorder::Place { a, b }).unwrap();
            assert_eq!(row.normal, expected);
        }
    }
}

/// v_(n+1) = 2P v_n − v_(n−1) on the honeycomb lattice, the recursion of Chebyshev polynomials.
#[test]
fn hcp_is_a_chebyshev_polynomial() {
    let mean_of_neighbours = |loads: &BTreeMap<Place, BigRational>, sign: i64| {
        let mut sums: BTreeMap<Place, BigRational> = BTreeMap::new();
        for ([a, b], load) in loads {
            for [u, v] in [[-1, -1], [1, 0], [0, 1]] {
                *sums.entry([a + sign * u, b + sign * v]).or_default() += load / whole(3);
            }
        }
        sums
    };
    let mut before = BTreeMap::from([([0, 0], whole(1))]);
    let mut loads = mean_of_neighbours(&before, 1);
    for steps in 1..=12_usize {
        let piles = Piles::response(steps, FirstSign::Plus).piles().unwrap();
        let mean = by_place(piles.exact(&ratio(1, 1)).unwrap());
        for (place, [_, normal, _, _]) in &mean {
            assert_eq!(
                *normal,
                loads.get(place).cloned().unwrap_or_default(),
                "{steps} {place:?}"
            );
        }
        let sign = if steps % 2 == 0 { 1 } else { -1 };
        let mut next = mean_of_neighbours(&loads, sign);
        for load in next.values_mut() {
            *load *= whole(2);
        }
        for (place, load) in &before {
            *next.entry(*place).or_default() -= load;
        }
        (before, loads) = (loads, next);
    }
}

/// The normal forces sum to the mean weight of the piles and their loads.
#[test]
fn normal_forces_sum_to_the_weight() {
    let top = Region::hexagon(2, 3).unwrap();
    let base = Region::hexagon(3, 3).unwrap();
    for (anchor, load) in [(Anchor::Top(top), true), (Anchor::Base(base), false)] {
        let mut described = Piles::heavy(anchor, 4, FirstSign::Random);
        if load {
            described.loads.push(([0, 0], ratio(7, 2)));
        }
        let piles = described.piles().unwrap();
        for q in probabilities() {
            let mean = piles.exact(&q).unwrap();
            let borne: BigRational = mean.rows().iter().map(|row| row.normal.clone()).sum();
            let [x, y]: [BigRational; 2] = [
                mean.rows().iter().map(|row| row.shear_x.clone()).sum(),
                mean.rows().iter().map(|row| row.shear_y.clone()).sum(),
            ];
            assert!(x.is_zero() && y.is_zero());
            let mut weight = BigRational::zero();
            for signs in described.stackings() {
                let d = faults(&signs);
                let share = pow(q.clone(), d) * pow(whole(1) - &q, 3 - d) / whole(2);
                let Some(spheres) = spheres(anchor, &signs) else {
                    continue;
                };
                let loads: BigRational = described.loads.iter().map(|(_, load)| load.clone()).sum();
                weight += (BigRational::from_integer(spheres.into()) + loads) * share;
            }
            assert_eq!(borne, weight, "{anchor:?} {q}");
        }
    }
}

/// Returns the number of spheres of the pile of a stacking, from its regions. `None` if there is no such pile.
fn spheres(anchor: Anchor, signs: &[i64]) -> Option<BigUint> {
    let sign = |sign: &i64| if *sign > 0 { Sign::Plus } else { Sign::Minus };
    let mut layers = match anchor {
        Anchor::Top(region) | Anchor::Base(region) => vec![region],
        Anchor::Plane => unreachable!("it has no end"),
    };
    let on_base = matches!(anchor, Anchor::Base(_));
    let steps: Vec<Sign> = if on_base {
        signs.iter().rev().map(sign).collect()
    } else {
        signs.iter().map(sign).collect()
    };
    for step in steps {
        let last = layers.last().unwrap();
        layers.push(if on_base {
            last.eroded(step)?
        } else {
            last.dilated(step).unwrap()
        });
    }
    Some(layers.iter().map(Region::site_count).sum())
}

#[test]
fn bases_support_stackings_with_a_top_layer() {
    let bases = [(5, 1), (6, 1), (3, 3), (4, 2)].map(|(p, q)| Region::hexagon(p, q).unwrap());
    for base in bases {
        for steps in 0..=5 {
            let described = Piles::heavy(Anchor::Base(base), steps, FirstSign::Random);
            let stackings = described.stackings();
            let carried = stackings
                .iter()
                .filter(|signs| spheres(described.anchor, signs).is_some());
            let carried = carried.count();
            let piles = described.piles().unwrap();
            let Ok(sums) = by_faults(&piles) else {
                assert_eq!(carried, 0);
                continue;
            };
            let place = named(piles.exact(&ratio(1, 2)).unwrap().rows()[0].place);
            let of_place = sums.iter().filter(|((at, _), _)| *at == place);
            let found: BigUint = of_place.map(|(_, (count, _))| count.clone()).sum();
            assert_eq!(found, BigUint::from(carried), "{base} {steps}");
        }
    }
}

/// A number of stackings that is too large to enumerate.
#[test]
fn many_layers() {
    let stackings = RandomStackings::new(41, FirstSign::Plus).unwrap();
    let plane = RandomPiles::plane(stackings).weightless();
    let plane = plane
        .with_load(cannonpile::lattice::Site::APEX, whole(1))
        .unwrap();
    let exact = plane.exact(&ratio(1, 2)).unwrap();
    let [sum, along_b, along_c, second, ..] = moments(
        &exact
            .rows()
            .iter()
            .map(|row| (named(row.place), row.normal.clone()))
            .collect(),
    );
    assert_eq!([sum, along_b, along_c, second], [1, 0, 0, 1600].map(whole));
    cannonpile_testkit::disorder::near(&exact, &plane.mean(&0.5).unwrap(), 1e-15).unwrap();
}
