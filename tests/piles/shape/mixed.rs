//! The sites, contacts and counts of a pile, compared with sets of sites.

use cannonpile::shape::Selection;
use num_bigint::BigUint;

use cannonpile_testkit::cases::{Bounds, Case, Random, all_on, all_signs};
use cannonpile_testkit::oracles::balance::{Place, Sites, direction, place, site};

fn big(n: usize) -> BigUint {
    n.into()
}

/// Makes all comparisons for one pile.
fn agrees(case: &Case) {
    sites_in_order(case);
    counts(case);
    neighbours(case);
}

fn sites_in_order(Case { pile, balance, .. }: &Case) {
    let places: Vec<Place> = balance.places().collect();
    let sites: Vec<Place> = pile.shape().sites().map(place).collect();
    assert_eq!(sites, places, "{}", balance.signs);
    let rows = pile.rows(Selection::All).unwrap();
    assert_eq!(rows.site_count(), big(places.len()));
    assert!(rows.flatten().map(place).eq(places.iter().copied()));
    for (n, at) in places.iter().enumerate() {
        assert_eq!(pile.shape().before(site(*at)), Ok(big(n)));
    }
    for (k, layer) in (0..).zip(&balance.layers) {
        let rows = pile.rows(Selection::Layer(k)).unwrap();
        let there: Vec<Place> = rows.flatten().map(place).collect();
        assert!(there.into_iter().eq(layer.iter().map(|&(j, i)| (k, j, i))));
        assert_eq!(
            pile.shape().layer(k).unwrap().site_count(),
            big(layer.len())
        );
    }
}

fn counts(Case { pile, balance, .. }: &Case) {
    let spheres: usize = balance.layers.iter().map(Sites::len).sum();
    let bottom = balance.layers.last().expect("a layer").len();
    assert_eq!(pile.layers(), i128::try_from(balance.layers.len()).unwrap());
    assert_eq!(pile.sphere_count(), big(spheres));
    assert_eq!(pile.shape().sphere_count(), big(spheres));
    assert_eq!(pile.contact_count(), big(3 * (spheres - bottom)));
    assert_eq!(pile.base_sphere_count(), big(bottom));
}

/// Compares every site and all positions around it.
fn neighbours(Case { pile, balance, .. }: &Case) {
    let shape = pile.shape();
    let around = |(k, j, i): Place| {
        [
            (k, j, i),
            (k, j, i - 1),
            (k, j - 1, i),
            (k, j + 1, i + 1),
            (k - 1, j, i),
            (k + 1, j, i),
        ]
    };
    for at in balance.places().flat_map(around) {
        assert_eq!(shape.contains(site(at)), balance.has(at), "{at:?}");
        assert_eq!(shape.check(site(at)).is_ok(), balance.has(at), "{at:?}");
        for m in 0..3 {
            let here = balance.has(at);
            let below = balance.below(at, m).filter(|_| here);
            if let Some(below) = below {
                assert!(
                    balance.has(below),
                    "every sphere has three supports: {at:?}"
                );
            }
            let above = balance.above(at, m).filter(|_| here);
            assert_eq!(shape.below(site(at), direction(m)), below.map(site));
            assert_eq!(shape.above(site(at), direction(m)), above.map(site));
        }
    }
}

#[test]
fn sites_have_the_order_of_the_oracle() {
    let mut random = Random(11);
    let mut any = || random.up_to(6) - 3;
    for _ in 0..300 {
        let (a, b): (Place, Place) = ((any(), any(), any()), (any(), any(), any()));
        assert_eq!(site(a).cmp(&site(b)), a.cmp(&b));
    }
}

#[test]
fn every_stacking_under_one_sphere_up_to_7_layers() {
    for steps in 0..7 {
        for signs in all_signs(steps) {
            agrees(&Case::under(&Bounds::SITE, &signs));
        }
    }
}

#[test]
fn every_stacking_on_small_hexagons() {
    for (p, q) in [
        (1, 1),
        (2, 1),
        (1, 3),
        (4, 1),
        (2, 2),
        (3, 2),
        (2, 4),
        (3, 3),
    ] {
        let base = Bounds::hexagon(p, q);
        for signs in all_on(&base) {
            agrees(&Case::on(&base, &signs).expect("found by the oracle"));
        }
    }
}

#[test]
fn random_regions_and_stackings() {
    let mut random = Random(12);
    for _ in 0..150 {
        let steps = random.below(8);
        let signs = random.signs(steps);
        agrees(&Case::under(&random.bounds(5), &signs));
        if let Some(case) = Case::on(&random.bounds(10), &signs) {
            agrees(&case);
        }
    }
}

#[test]
fn long_runs_are_counted_in_pieces() {
    let mut random = Random(13);
    for _ in 0..25 {
        let runs = [random.below(14), random.below(14), random.below(14)];
        let signs = ["+", "-", "+"]
            .iter()
            .zip(runs)
            .map(|(sign, n)| sign.repeat(n));
        let signs: String = signs.collect();
        counts(&Case::under(&random.bounds(4), &signs));
        let base = random.bounds(40);
        for steps in (0..signs.len()).rev() {
            if let Some(case) = Case::on(&base, &signs[..steps]) {
                sites_in_order(&case);
                counts(&case);
                break;
            }
        }
    }
}

#[test]
fn the_error_of_a_pile_too_high_names_the_greatest_height() {
    use cannonpile::{Error, Pile};

    let mut random = Random(14);
    let mut refused = 0;
    for _ in 0..200 {
        let (base, steps) = (random.bounds(6), 1 + random.below(8));
        let signs = random.signs(steps);
        if Case::on(&base, &signs).is_some() {
            continue;
        }
        refused += 1;
        // The layers next to the base exist. So this counts how many of the last signs fit.
        let fits = (0..=steps)
            .rev()
            .find(|n| Case::on(&base, &signs[steps - n..]).is_some());
        let greatest = i128::try_from(fits.expect("the base itself") + 1).unwrap();
        let given = Pile::on(base.region(), cannonpile_testkit::cases::stacking(&signs));
        let Err(Error::TooHigh {
            greatest: named,
            layers,
            ..
        }) = given
        else {
            panic!("{base:?} {signs}: {given:?}");
        };
        assert_eq!(
            (named, layers),
            (greatest, i128::try_from(steps + 1).unwrap())
        );
    }
    assert!(refused > 50);
}
