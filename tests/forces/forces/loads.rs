//! Random tops, bases, stackings, weights and loads: every answer equals the oracle's.

use cannonpile::lattice::{Region, Site};
use cannonpile::shape::Selection;
use cannonpile::{Load, Pile};
use num_rational::BigRational;
use num_traits::Zero;

use cannonpile_testkit::cases::{Bounds, Case, Random, stacking};
use cannonpile_testkit::compare::{agrees, all_agree};
use cannonpile_testkit::oracles::balance::{Balance, ratio};

#[test]
fn random_tops_without_loads() {
    let mut random = Random(1);
    for _ in 0..150 {
        let top = random.bounds(4);
        let steps = random.below(9);
        agrees(&Case::under(&top, &random.signs(steps))).unwrap();
    }
}

#[test]
fn random_bases_without_loads() {
    let mut random = Random(2);
    let mut compared = 0;
    while compared < 150 {
        let (base, steps) = (random.bounds(9), random.below(7));
        if let Some(case) = Case::on(&base, &random.signs(steps)) {
            agrees(&case).unwrap();
            compared += 1;
        }
    }
}

#[test]
fn random_weights_and_loads_on_random_tops() {
    let mut random = Random(3);
    for _ in 0..250 {
        let top = random.bounds(3);
        let (steps, loads) = (random.below(8), 1 + random.below(12));
        let signs = random.signs(steps);
        let case = Case::under(&top, &signs).with_random_loads(loads, &mut random);
        assert_eq!(case.pile.weight(), case.balance.whole_weight());
        agrees(&case).unwrap();
    }
}

#[test]
fn random_weights_and_loads_on_random_bases() {
    let mut random = Random(4);
    let mut compared = 0;
    while compared < 150 {
        let (base, steps, loads) = (random.bounds(9), random.below(6), 1 + random.below(12));
        if let Some(case) = Case::on(&base, &random.signs(steps)) {
            let case = case.with_random_loads(loads, &mut random);
            assert_eq!(case.pile.weight(), case.balance.whole_weight());
            agrees(&case).unwrap();
            compared += 1;
        }
    }
}

#[test]
fn loads_on_weightless_spheres() {
    let mut random = Random(5);
    for _ in 0..250 {
        let top = random.bounds(3);
        let (steps, loads) = (random.below(8), random.below(6));
        let signs = random.signs(steps);
        let case = Case::under(&top, &signs).weightless();
        let case = case.with_random_loads(loads, &mut random);
        assert_eq!(case.pile.weight(), case.balance.whole_weight());
        agrees(&case).unwrap();
    }
}

#[test]
fn every_sphere_of_small_piles_has_its_own_weight_and_load() {
    let mut random = Random(6);
    for round in 0..60 {
        let signs = random.signs(1 + round % 6);
        let mut case = Case::under(&random.bounds(2), &signs);
        let places: Vec<_> = case.balance.places().collect();
        for place in places {
            // Most weights are zero, so that many lines of contacts begin at a weightless sphere, without an increment.
            let weight = [ratio(0, 1), ratio(0, 1), random.rational()];
            let weight = &weight[random.below(3)];
            case = case.with_weight(place, weight);
            if random.below(3) == 0 {
                case = case.with_load(place, &random.rational());
            }
        }
        agrees(&case).unwrap();
    }
}

#[test]
fn one_load_at_a_time_anywhere() {
    let load = ratio(5, 7);
    for signs in ["+-+-", "++--", "+--+", "-+++"] {
        let case = Case::under(&Bounds::hexagon(2, 2), signs);
        for place in case.balance.places().collect::<Vec<_>>() {
            agrees(&case.clone().with_load(place, &load)).unwrap();
            agrees(&case.clone().weightless().with_load(place, &load)).unwrap();
        }
    }
}

#[test]
fn the_floor_supports_a_load_on_a_single_layer() {
    let case = Case::under(&Bounds::triangle(3), "").with_load((0, 1, 1), &ratio(1, 3));
    agrees(&case).unwrap();
    let standing = case.pile.standing().unwrap();
    assert_eq!((standing.least, standing.first_failure), (None, None));
    let extremes = case.pile.base_extremes().unwrap();
    assert_eq!(extremes.normal_max, ratio(4, 3));
    assert_eq!(
        extremes.max_shear_ratio.to_rational(),
        Some(BigRational::zero())
    );
}

#[test]
fn extremes_over_the_base_equal_the_oracle() {
    let mut random = Random(9);
    for _ in 0..60 {
        let signs = random.signs(5);
        let case = Case::under(&random.bounds(3), &signs).with_random_loads(2, &mut random);
        let floor = case.balance.forces().floor;
        let normals = || floor.values().map(|[normal, ..]| normal);
        let extremes = case.pile.base_extremes().unwrap();
        assert_eq!(Some(&extremes.normal_min), normals().min());
        assert_eq!(Some(&extremes.normal_max), normals().max());
        // The unit of shear along y is √3 times that along x.
        let squared = floor.values().filter(|[normal, ..]| !normal.is_zero());
        let squared = squared.map(|[n, x, y]| (x * x + y * y * ratio(3, 1)) / (n * n));
        assert_eq!(Some(extremes.max_shear_ratio.square()), squared.max());
    }
}

#[test]
fn weights_replace_and_loads_add_up() {
    let at = |i, j, k| Site { i, j, k };
    let pile = Pile::under(Region::SITE, stacking("+-+")).unwrap();
    let (here, there) = (at(1, 0, 1), at(0, 0, 2));
    let pile = pile.with_weight(here, ratio(9, 1)).unwrap();
    let pile = pile.with_load(here, ratio(1, 2)).unwrap();
    let pile = pile.with_weight(here, ratio(3, 1)).unwrap();
    let pile = pile.with_load(here, ratio(1, 3)).unwrap();
    let pile = pile.with_load(there, ratio(2, 1)).unwrap();
    let top = Bounds::SITE.sites();
    let mut balance = Balance::under(&top, "+-+");
    balance.weights.insert((1, 0, 1), ratio(23, 6));
    balance.weights.insert((2, 0, 0), ratio(3, 1));
    all_agree(&pile, &balance.forces()).unwrap();
    assert_eq!(pile.sphere_weight(here), Ok(ratio(3, 1)));
    assert_eq!(pile.sphere_weight(there), Ok(ratio(1, 1)));
    assert_eq!(pile.weight(), balance.whole_weight());
    let pile = pile.weightless();
    balance.ordinary = BigRational::zero();
    balance.weights.insert((1, 0, 1), ratio(5, 6));
    balance.weights.insert((2, 0, 0), ratio(2, 1));
    all_agree(&pile, &balance.forces()).unwrap();
    assert_eq!(pile.sphere_weight(here), Ok(ratio(0, 1)));
    assert_eq!(pile.weight(), balance.whole_weight());
    assert!(pile.clone().with_load(here, ratio(-1, 9)).is_err());
    assert!(pile.clone().with_weight(here, ratio(-1, 9)).is_err());
    assert!(pile.clone().with_load(at(2, 0, 1), ratio(1, 9)).is_err());
}

/// In a weightless pile the weight of one sphere has the forces of a load of this size.
#[test]
fn one_sphere_of_a_weightless_pile_has_a_weight() {
    let site = Site { i: 1, j: 0, k: 1 };
    let pile = Pile::under(Region::SITE, stacking("+-+-")).unwrap();
    let tilt = [ratio(1, 7), ratio(0, 1)];
    let pile = pile.with_weight(Site::APEX, ratio(3, 1)).unwrap();
    let pile = pile.weightless().with_tilt(tilt).unwrap();
    let heavy = pile.clone().with_weight(site, ratio(5, 1)).unwrap();
    let gravity = Load::leaning(ratio(5, 1), heavy.tilt());
    let loaded = pile.with_load(site, gravity).unwrap();
    assert_eq!(heavy.weight(), ratio(5, 1));
    let forces = |pile: &Pile| -> Vec<_> {
        let contacts = pile.forces::<BigRational>().contacts(Selection::All);
        contacts.unwrap().collect::<Result<_, _>>().unwrap()
    };
    assert_eq!(forces(&heavy), forces(&loaded));
}

/// A load of zero and a weight of 1 leave a pile as it is.
#[test]
fn ordinary_weights_and_no_loads_are_not_kept() {
    let pile = Pile::triangular(3).unwrap();
    let along = |x| Load {
        x,
        ..Load::default()
    };
    let kept = pile
        .clone()
        .with_load(Site::APEX, along(ratio(2, 1)))
        .unwrap();
    let kept = kept.with_load(Site::APEX, along(ratio(-2, 1))).unwrap();
    assert_eq!(kept, pile);
    let kept = pile.clone().with_load(Site::APEX, ratio(0, 1)).unwrap();
    let kept = kept.with_weight(Site::APEX, ratio(4, 1)).unwrap();
    assert_ne!(kept, pile);
    let kept = kept.with_weight(Site::APEX, ratio(1, 1)).unwrap();
    assert_eq!((kept.loads().len(), kept.weights().count()), (0, 0));
    assert_eq!(kept, pile);
}
