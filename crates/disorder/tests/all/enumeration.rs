//! Comparison of means with enumeration over all stackings, and of the enumeration with piles of single stackings.

use std::collections::BTreeMap;

use cannonpile::Pile;
use cannonpile::lattice::{Region, Sign, Site};
use cannonpile::scalar::{DoubleDouble, Polynomial, Symbol};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile_disorder::{FirstSign, Place};
use cannonpile_testkit::real::Bounded;
use num_rational::BigRational;
use num_traits::{One, Signed, pow};

use cannonpile_testkit::answers::ratio;
use cannonpile_testkit::disorder::{
    Anchor, Piles, Sums, agrees, alike, by_faults, named, near, numbers, probabilities,
};

const FIRSTS: [FirstSign; 3] = [FirstSign::Plus, FirstSign::Minus, FirstSign::Random];

fn tops() -> [Region; 5] {
    [
        Region::SITE,
        Region::triangle(2).unwrap(),
        Region::hexagon(2, 2).unwrap(),
        Region::new(-1..=2, 3..=3, 2..=5).unwrap(),
        Region::new(0..=0, 0..=2, 0..=2).unwrap(),
    ]
}

fn bases() -> [Region; 6] {
    [
        Region::SITE,
        Region::triangle(5).unwrap(),
        Region::hexagon(3, 3).unwrap(),
        Region::hexagon(4, 2).unwrap(),
        Region::hexagon(1, 6).unwrap(),
        Region::new(-1..=2, 3..=6, 2..=9).unwrap(),
    ]
}

fn hold(described: &Piles) {
    if let Err(difference) = agrees(described) {
        panic!("{described:?}: {difference}");
    }
}

#[test]
fn means_of_one_load_agree() {
    for steps in 0..=8 {
        for first in FIRSTS {
            if first != FirstSign::Minus || steps < 6 {
                hold(&Piles::response(steps, first));
            }
        }
    }
}

#[test]
fn means_of_several_loads_agree() {
    for steps in 0..=4 {
        for first in FIRSTS {
            let mut described = Piles::response(steps, first);
            described.loads.push(([2, -1], ratio(2, 5)));
            described.loads.push(([-9, 4], ratio(7, 3)));
            described.loads.push(([0, 0], ratio(1, 4)));
            hold(&described);
        }
    }
}

#[test]
fn means_under_one_sphere_agree() {
    for steps in 0..=7 {
        hold(&Piles::heavy(
            Anchor::Top(Region::SITE),
            steps,
            FirstSign::Plus,
        ));
    }
    for steps in 0..=5 {
        for first in [FirstSign::Minus, FirstSign::Random] {
            hold(&Piles::heavy(Anchor::Top(Region::SITE), steps, first));
        }
    }
}

#[test]
fn means_under_other_tops_agree() {
    for top in tops() {
        for (steps, first) in [
            (1, FirstSign::Plus),
            (3, FirstSign::Minus),
            (4, FirstSign::Random),
        ] {
            let mut described = Piles::heavy(Anchor::Top(top), steps, first);
            hold(&described);
            let corner = top.corners()[1].map(|x| i64::try_from(x).unwrap());
            described.loads = vec![(corner, ratio(3, 2))];
            hold(&described);
            described.weightless = true;
            hold(&described);
        }
    }
}

#[test]
fn means_on_bases_agree() {
    for base in bases() {
        for steps in 0..=5 {
            let first = FIRSTS[steps % 3];
            hold(&Piles::heavy(Anchor::Base(base), steps, first));
        }
    }
    hold(&Piles::heavy(
        Anchor::Base(Region::hexagon(3, 3).unwrap()),
        4,
        FirstSign::Random,
    ));
}

/// A triangle of side L supports L layers only in FCC. Its normal forces are all (L+2)/3. The rows are sorted by b,
/// then a.
#[test]
fn complete_triangles_are_fcc() {
    for layers in 1..=6_usize {
        let side = layers as i128;
        let base = Anchor::Base(Region::triangle(side).unwrap());
        let piles = Piles::heavy(base, layers - 1, FirstSign::Plus)
            .piles()
            .unwrap();
        let mean = piles.exact(&ratio(1, 3)).unwrap();
        assert_eq!(mean.rows().len(), layers * (layers + 1) / 2);
        let probability = pow(ratio(2, 3), layers.saturating_sub(2));
        let normal = BigRational::new((side + 2).into(), 3.into());
        for row in mean.rows() {
            assert_eq!(row.probability, probability);
            assert_eq!(row.normal, &normal * &probability, "{}", row.place);
        }
        let by_faults = piles.by_faults().unwrap();
        let rows = by_faults.rows().map(Result::unwrap);
        let rows: Vec<_> = rows.map(|row| (row.place, row.faults)).collect();
        let places = mean.rows().iter().map(|row| (row.place, 0));
        assert!(rows.into_iter().eq(places.clone()) && places.is_sorted());
    }
}

/// Returns the sums over all stackings, computed from piles.
fn of_piles(anchor: Anchor, steps: usize, load: Option<Site>) -> Sums {
    let described = Piles::heavy(anchor, steps, FirstSign::Plus);
    let mut sums = Sums::new();
    for signs in described.stackings() {
        let sign = |sign: &i64| if *sign > 0 { Sign::Plus } else { Sign::Minus };
        let stacking = Stacking::from_signs(signs.iter().map(sign)).unwrap();
        let (pile, net) = match anchor {
            Anchor::Top(top) => (Pile::under(top, stacking), signs.iter().sum::<i64>()),
            Anchor::Base(base) => (Pile::on(base, stacking), 0),
            Anchor::Plane => unreachable!("a pile has an end"),
        };
        // A base does not support every stacking.
        let Ok(mut pile) = pile else { continue };
        if let Some(site) = load {
            pile = pile.with_load(site, ratio(5, 2)).unwrap();
        }
        let faults = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        for force in pile.forces::<BigRational>().base(Selection::Base).unwrap() {
            let force = force.unwrap();
            let place = Place::of([force.site.i, force.site.j], net.into()).unwrap();
            let sum = sums.entry((named(place), faults)).or_default();
            sum.0 += 1_u32;
            for (sum, force) in sum
                .1
                .iter_mut()
                .zip([force.normal, force.shear_x, force.shear_y])
            {
                *sum += force;
            }
        }
    }
    sums
}

#[test]
fn enumeration_agrees_with_piles() {
    for (top, steps) in tops().into_iter().zip([7, 4, 4, 4, 4]) {
        let [i, j] = top.corners()[0];
        for load in [None, Some(Site { i, j, k: 0 })] {
            let mut described = Piles::heavy(Anchor::Top(top), steps, FirstSign::Plus);
            if load.is_some() {
                let at = [i, j].map(|x| i64::try_from(x).unwrap());
                described.loads = vec![(at, ratio(5, 2))];
            }
            let sums = by_faults(&described.piles().unwrap()).unwrap();
            alike("piles", &of_piles(described.anchor, steps, load), &sums).unwrap();
        }
    }
    for base in bases() {
        let described = Piles::heavy(Anchor::Base(base), 3, FirstSign::Plus);
        let sums = described.piles().unwrap();
        let expected = of_piles(described.anchor, 3, None);
        if !expected.is_empty() {
            alike("piles", &expected, &by_faults(&sums).unwrap()).unwrap();
        }
    }
}

/// q = 0 is FCC, and q = 1 is HCP.
#[test]
fn probabilities_0_and_1_are_fcc_and_hcp() {
    for top in tops() {
        let piles = Piles::heavy(Anchor::Top(top), 6, FirstSign::Plus)
            .piles()
            .unwrap();
        let ends = [
            (ratio(0, 1), Stacking::fcc(7).unwrap(), 6),
            (ratio(1, 1), Stacking::hcp(7).unwrap(), 0),
        ];
        for (q, stacking, net) in ends {
            let pile = Pile::under(top, stacking).unwrap();
            let mut expected = BTreeMap::new();
            for force in pile.forces::<BigRational>().base(Selection::Base).unwrap() {
                let force = force.unwrap();
                let place = Place::of([force.site.i, force.site.j], net).unwrap();
                let numbers = [force.normal, force.shear_x, force.shear_y];
                expected.insert(named(place), numbers);
            }
            let mean = piles.exact(&q).unwrap();
            let there = mean.rows().iter().filter(|row| row.probability.is_one());
            let there = there.map(|row| {
                let numbers = [&row.normal, &row.shear_x, &row.shear_y].map(Clone::clone);
                (named(row.place), numbers)
            });
            alike("an end", &expected, &there.collect()).unwrap();
            assert_eq!(mean.given_sphere().rows().len(), expected.len());
        }
    }
}

/// The recursion by probability in every scalar: rationals and polynomials are exact, and double-doubles are far more
/// accurate than floats.
#[test]
fn all_scalars_agree() {
    let described = [
        Piles::response(5, FirstSign::Random),
        Piles::heavy(
            Anchor::Top(Region::triangle(2).unwrap()),
            4,
            FirstSign::Plus,
        ),
        Piles::heavy(
            Anchor::Base(Region::hexagon(3, 3).unwrap()),
            3,
            FirstSign::Random,
        ),
    ];
    for described in described {
        let piles = described.piles().unwrap();
        let polynomials = piles.by_faults().unwrap().polynomial().unwrap();
        assert_eq!(
            piles.mean(&Polynomial::from(Symbol("q"))).unwrap(),
            polynomials
        );
        for q in probabilities() {
            let exact = piles.exact(&q).unwrap();
            assert_eq!(piles.mean(&q).unwrap(), exact);
            let double = piles.mean(&DoubleDouble::from_rational(&q)).unwrap();
            for (double, exact) in double.into_rows().into_iter().zip(exact.into_rows()) {
                assert_eq!(double.place, exact.place);
                for (double, exact) in numbers(double).into_iter().zip(numbers(exact)) {
                    let error = double.enclosure().unwrap().lower - exact;
                    assert!(
                        error.abs() < ratio(1, 10_i64.pow(14)) * ratio(1, 10_i64.pow(14)),
                        "{error}"
                    );
                }
            }
        }
    }
}

#[test]
fn conditional_means_agree() {
    let described = Piles::heavy(Anchor::Top(Region::SITE), 5, FirstSign::Plus);
    let half = ratio(1, 2);
    let given = described
        .piles()
        .unwrap()
        .exact(&half)
        .unwrap()
        .given_sphere();
    let sums = described.sums();
    for row in given.rows() {
        let at = named(row.place);
        let of_place = sums.iter().filter(|((place, _), _)| *place == at);
        let (mut stackings, mut normal) = (ratio(0, 1), ratio(0, 1));
        for (_, (count, floor)) in of_place {
            stackings += BigRational::from_integer(count.clone().into());
            normal += &floor[0];
        }
        assert_eq!(row.normal, normal / stackings, "{at:?}");
    }
}

/// The comparison detects minimal errors.
#[test]
fn planted_faults_are_detected() {
    let described = Piles::heavy(Anchor::Top(Region::SITE), 4, FirstSign::Plus);
    let piles = described.piles().unwrap();
    let expected = described.sums();
    let answer = by_faults(&piles).unwrap();
    alike("by faults", &expected, &answer).unwrap();
    let key = *answer.keys().nth(20).unwrap();
    let mut normal = answer.clone();
    normal.get_mut(&key).unwrap().1[0] += ratio(1, 243);
    let mut shear = answer.clone();
    shear.get_mut(&key).unwrap().1[2] += ratio(1, 243);
    let mut count = answer.clone();
    count.get_mut(&key).unwrap().0 += 1_u32;
    let mut missing = answer.clone();
    missing.remove(&key);
    let mut more = answer;
    more.insert(([9, 9], 0), more[&key].clone());
    for wrong in [normal, shear, count, missing, more] {
        assert!(alike("by faults", &expected, &wrong).is_err());
    }
    // Another first sign, another weight, and floats at another probability.
    let minus = Piles {
        first: FirstSign::Minus,
        ..described.clone()
    };
    assert!(alike("first", &minus.sums(), &expected).is_err());
    let weightless = Piles {
        weightless: true,
        ..described
    };
    assert!(alike("weight", &weightless.sums(), &expected).is_err());
    let exact = piles.exact(&ratio(1, 3)).unwrap();
    near(&exact, &piles.mean(&(1.0 / 3.0)).unwrap(), 1e-13).unwrap();
    assert!(near(&exact, &piles.mean(&(1.0 / 3.0 + 1e-12)).unwrap(), 1e-13).is_err());
}
