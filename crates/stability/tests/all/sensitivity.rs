//! Unequal spheres, against piles that are built again.

use std::collections::BTreeMap;

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::scalar::{FixedRational, Interval};
use cannonpile::shape::Selection;
use cannonpile::{Error, Packing, Pile, ratio};
use cannonpile_stability::{ForceChange, sensitivity, spread};
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};

type V = [f64; 3];

fn minus(a: V, b: V) -> V {
    [0, 1, 2].map(|n| a[n] - b[n])
}

fn dot(a: V, b: V) -> f64 {
    (0..3).map(|n| a[n] * b[n]).sum()
}

fn cross(a: V, b: V) -> V {
    [(1, 2), (2, 0), (0, 1)].map(|(m, n)| a[m] * b[n] - a[n] * b[m])
}

/// The solution of three equations row·x = value.
fn solve(rows: [V; 3], values: V) -> V {
    let [a, b, c] = rows;
    let determinant = dot(a, cross(b, c));
    let parts = [cross(b, c), cross(c, a), cross(a, b)];
    [0, 1, 2].map(|n| (0..3).map(|m| parts[m][n] * values[m]).sum::<f64>() / determinant)
}

/// Returns the contact forces of a pile in which one sphere has another radius, in newtons for mg = 1 and R = 1.
///
/// Newton's method places each sphere on its three supports, from the bottom up. Then each sphere is balanced, from the
/// top down.
fn rebuilt(packing: &Packing<'_>, grown: Site, delta: f64) -> BTreeMap<(Site, Direction), f64> {
    let pile = packing.pile();
    let (shape, floor) = (pile.shape(), pile.layers() - 1);
    let radius = |site: Site| if site == grown { 1.0 + delta } else { 1.0 };
    let sites: Vec<Site> = pile.sites(Selection::All).unwrap().collect();
    let mut places: BTreeMap<Site, V> = BTreeMap::new();
    for site in sites.iter().rev() {
        let mut place = packing.position(*site).unwrap().map(|x| x.to_f64());
        if site.k < floor {
            for _ in 0..20 {
                let arms = Direction::ALL.map(|direction| {
                    let support = shape.below(*site, direction).unwrap();
                    (
                        minus(place, places[&support]),
                        radius(*site) + radius(support),
                    )
                });
                let rows = arms.map(|(arm, _)| arm.map(|x| 2.0 * x));
                let step = solve(
                    rows,
                    arms.map(|(arm, length)| length * length - dot(arm, arm)),
                );
                place = [0, 1, 2].map(|n| place[n] + step[n]);
            }
        }
        places.insert(*site, place);
    }
    let mut forces = BTreeMap::new();
    for site in sites.iter().filter(|site| site.k < floor) {
        let mut acting = [0.0, 0.0, -pile.total_load(*site).down.to_f64().unwrap()];
        let unit = |upper: Site, lower: Site| {
            let arm = minus(places[&upper], places[&lower]);
            let length = dot(arm, arm).sqrt();
            arm.map(|x| x / length)
        };
        for direction in Direction::ALL {
            if let Some(above) = shape.above(*site, direction) {
                let force: f64 = forces[&(above, direction)];
                let along = unit(above, *site);
                acting = [0, 1, 2].map(|n| acting[n] - force * along[n]);
            }
        }
        let below =
            Direction::ALL.map(|direction| unit(*site, shape.below(*site, direction).unwrap()));
        // Σ f_m e_m = −acting, by components.
        let rows = [0, 1, 2].map(|n| below.map(|e| e[n]));
        let found = solve(rows, acting.map(|x| -x));
        for (direction, force) in Direction::ALL.into_iter().zip(found) {
            forces.insert((*site, direction), force);
        }
    }
    forces
}

#[test]
fn changes_of_forces_are_those_of_piles_built_again() {
    let one = ratio!(1);
    for (top, stacking) in [
        (Region::SITE, "+++++"),
        (Region::SITE, "+-+"),
        (Region::hexagon(2, 1).unwrap(), "-++-"),
    ] {
        let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
        let pile = pile.with_load(Site::new(0, 0, 1), one.clone()).unwrap();
        let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
        let unit = packing.unit_force().to_f64();
        let grown = pile.sites(Selection::All).unwrap().step_by(7);
        for grown in grown {
            let delta = 1e-5;
            let [more, less] = [delta, -delta].map(|delta| rebuilt(&packing, grown, delta));
            let exact = sensitivity::<BigRational>(&packing, grown).unwrap();
            let floats = sensitivity::<f64>(&packing, grown).unwrap();
            for (
                ForceChange {
                    site,
                    direction,
                    change,
                    ..
                },
                float,
            ) in exact.into_iter().zip(floats)
            {
                let contact = (site, direction);
                let slope = (more[&contact] - less[&contact]) / (2.0 * delta) / unit;
                let change = change.to_f64().unwrap();
                assert!(
                    (slope - change).abs() < 1e-7 * (1.0 + change.abs()),
                    "{grown} {contact:?}"
                );
                assert!((float.change - change).abs() < 1e-10 * (1.0 + change.abs()));
            }
        }
    }
}

/// The largest standard deviation over force of straight piles at a = 1.2 R.
#[test]
fn spreads_of_straight_piles() {
    for (layers, known) in [(4, 6.4), (6, 13.0), (8, 21.0)] {
        let pile = Pile::triangular(layers).unwrap();
        let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
        let spread = spread::<f64>(&packing).unwrap().unwrap();
        let relative = spread.variance.sqrt() / spread.force;
        assert!((relative - known).abs() < 0.5, "{layers} {relative}");
        let bearable = spread.bearable_squared().unwrap().sqrt();
        assert!((bearable * 3.0 * relative - 1.0).abs() < 1e-12);
    }
    let pile = Pile::triangular(3).unwrap();
    let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
    let exact = spread::<BigRational>(&packing).unwrap().unwrap().variance;
    assert!(!exact.is_zero());
    let rounded = spread::<f64>(&packing).unwrap().unwrap().variance;
    assert!((exact.to_f64().unwrap() - rounded).abs() < 1e-9);
}

/// The sums of squares exceed the scalar, or the intervals of equal ratios overlap. None of them names a contact.
#[test]
fn a_scalar_that_cannot_compare_gives_no_spread() {
    let pile = Pile::triangular(6).unwrap();
    let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
    let fixed = spread::<FixedRational<i32>>(&packing);
    assert!(matches!(fixed, Err(Error::Overflow { .. })), "{fixed:?}");
    let interval = spread::<Interval>(&packing);
    assert!(
        matches!(interval, Err(Error::Overflow { .. })),
        "{interval:?}"
    );
}

/// A contact whose force no radius changes is not the one that opens first, and an unstable pile has no such contact.
#[test]
fn spreads_of_other_piles() {
    let spread_of = |pile: Pile| {
        let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
        spread::<BigRational>(&packing).unwrap()
    };
    let load = |pile: Pile| {
        pile.with_load(Site { i: 0, j: 0, k: 1 }, ratio!(1))
            .unwrap()
    };
    let below = spread_of(load(Pile::triangular(3).unwrap().weightless())).unwrap();
    assert_eq!((below.site.k, below.force), (1, ratio!(1)));
    let hcp = Pile::under(Region::SITE, "+-+-+".parse().unwrap()).unwrap();
    assert_eq!(spread_of(hcp), None);
    assert_eq!(spread_of(Pile::triangular(1).unwrap()), None);
    assert_eq!(spread_of(Pile::triangular(3).unwrap().weightless()), None);
}

/// If all spheres grow alike, the pile keeps its shape only if the floor grows too. In a pile of discs every force has a
/// change of zero for a sphere that it does not depend on.
#[test]
fn discs_change_by_their_own_rule() {
    let pile = Pile::discs(4).unwrap();
    let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
    let changes = sensitivity::<BigRational>(&packing, Site::APEX).unwrap();
    // A larger apex is lifted straight up, so its two contacts steepen alike.
    let apex: Vec<_> = changes
        .iter()
        .filter(|change| change.site == Site::APEX)
        .collect();
    assert_eq!(apex.len(), 2);
    assert_eq!(apex[0].change, apex[1].change);
    assert!(apex[0].change < ratio!(0));
}
