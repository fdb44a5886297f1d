//! Extremes over a base, and the least contact force. A search among few spheres must find the extremes of all.

use cannonpile::lattice::{Axis, HorizontalContact, Region, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{BaseExtremes, ContactForce, FloorForce, Pile};
use cannonpile_testkit::rational::ratio;
use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::Zero;

/// Piles with long runs, so that a layer has hundreds of times more spheres than rows.
fn piles() -> Vec<Pile> {
    let tops = [Region::SITE, Region::new(-3..=12, 0..=5, -2..=14).unwrap()];
    let stackings = ["(490)", "(2,1,480)", "-(490,2)", "(300,1,180)"];
    let mut piles = Vec::new();
    for (n, stacking) in stackings.into_iter().enumerate() {
        let top = tops[n % 2];
        let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
        let [[i, j], ..] = top.corners();
        let mut below = pile.rows(Selection::Layer(245)).unwrap().flatten();
        let below = below.nth(770).unwrap();
        let loaded = pile
            .clone()
            .with_load(Site { i, j, k: 0 }, ratio(25, 3))
            .unwrap();
        let loaded = loaded.with_load(below, ratio(5000, 7)).unwrap();
        piles.push(if n < 2 { pile } else { loaded.weightless() });
    }
    let pile = Pile::under(tops[0], "(1,480)".parse().unwrap()).unwrap();
    let below = pile
        .rows(Selection::Layer(300))
        .unwrap()
        .flatten()
        .nth(9999)
        .unwrap();
    piles.push(pile.with_load(below, ratio(5000, 7)).unwrap());
    // Special spheres in the bottom layer and in a layer with a sign change. No line of the last run contains them.
    let pile = Pile::triangular(480).unwrap();
    let on_floor = Site {
        i: 150,
        j: 201,
        k: 479,
    };
    piles.push(pile.with_load(on_floor, ratio(1000, 1)).unwrap());
    let pile = Pile::under(tops[0], "(470,2)".parse().unwrap()).unwrap();
    let worst = pile.standing().unwrap().least.unwrap().site;
    let inside = Site {
        i: 100,
        j: 200,
        ..worst
    };
    let lighter = pile.clone().with_weight(worst, ratio(0, 1)).unwrap();
    piles.extend([lighter, pile.with_weight(inside, ratio(0, 1)).unwrap()]);
    let layer = Pile::under(Region::hexagon(300, 300).unwrap(), Stacking::single_layer());
    let pile = layer
        .unwrap()
        .with_load(Site { i: -20, j: 7, k: 0 }, ratio(5, 1));
    piles.push(
        pile.unwrap()
            .with_weight(Site { i: 9, j: 9, k: 0 }, ratio(1, 5))
            .unwrap(),
    );
    let base = Region::hexagon(240, 300).unwrap();
    piles.push(Pile::on(base, "(20,3,200)".parse().unwrap()).unwrap());
    // Trees through so many sign changes cost more than a sweep.
    let changes = format!("({}220)", "1,".repeat(20));
    for top in tops {
        let pile = Pile::under(top, changes.parse().unwrap()).unwrap();
        let inside = Site {
            i: 31,
            j: 12,
            k: 100,
        };
        let loaded = pile.clone().with_load(inside, ratio(77, 3)).unwrap();
        piles.extend([pile, loaded]);
    }
    piles
}

/// The extremes over all bottom spheres.
fn over_all(pile: &Pile) -> [BigRational; 3] {
    let forces = pile.forces::<BigRational>();
    let on_floor: Vec<_> = forces
        .base(Selection::Base)
        .unwrap()
        .map(Result::unwrap)
        .collect();
    let normals = || on_floor.iter().map(|force| force.normal.clone());
    let loaded = on_floor.iter().filter(|force| !force.normal.is_zero());
    // Each sphere compares integers over one denominator, which cancels. Only the greatest is reduced to lowest terms.
    let squares = loaded.map(|force| {
        let FloorForce {
            normal,
            shear_x,
            shear_y,
            ..
        } = force;
        let d = normal.denom().lcm(shear_x.denom()).lcm(shear_y.denom());
        let [n, x, y] = [normal, shear_x, shear_y].map(|part| part.numer() * (&d / part.denom()));
        (&x * &x + &y * &y * 3, &n * &n)
    });
    let steepest = squares.max_by(|(a, b): &(BigInt, BigInt), (c, d)| (a * d).cmp(&(c * b)));
    let ratio = steepest.map(|(shear2, normal2)| BigRational::new(shear2, normal2));
    [normals().min(), normals().max(), ratio].map(Option::unwrap_or_default)
}

/// Piles whose base is swept: without loads, with a load in the bottom layer, with a very large load, and weightless
/// piles with a load.
fn swept() -> Vec<Pile> {
    let skewed = Region::new(-3..=2, 0..=5, -2..=4).unwrap();
    let mut piles = Vec::new();
    for (top, stacking) in [
        (Region::SITE, "+-+-+-+-+-+-+-+-+-+-+-+-+"),
        (Region::hexagon(3, 2).unwrap(), "-++-+---+-++-+-"),
        (Region::triangle(5).unwrap(), "(3,2,1,4,1,1,2)"),
        (skewed, "+-+--++-+-"),
    ] {
        let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
        let sites: Vec<Site> = pile.shape().sites().collect();
        let last = sites[sites.len() - 9];
        let loaded = |site, load| pile.clone().with_load(site, load).unwrap();
        let great = BigRational::from_integer(BigInt::from(7).pow(150));
        piles.extend([
            loaded(last, ratio(1000, 3)),
            loaded(sites[0], ratio(1, 1)).weightless(),
            loaded(sites[1], great.clone()),
            loaded(sites[0], great.recip()).weightless(),
            pile.clone(),
        ]);
    }
    piles
}

#[test]
fn of_the_base() {
    for pile in piles().into_iter().chain(swept()) {
        equals_the_search_over_all(&pile);
    }
}

fn equals_the_search_over_all(pile: &Pile) {
    let BaseExtremes {
        normal_min,
        normal_max,
        max_shear_ratio,
        ..
    } = pile.base_extremes().unwrap();
    let found = [normal_min, normal_max, max_shear_ratio.square()];
    assert_eq!(found, over_all(pile), "{}", pile.shape().stacking());
}

/// Forces along a line only grow within a run. So the least contact force is at the start of a line, and tension occurs
/// only at a sign change.
#[test]
fn of_contacts() {
    let mut failures = 0;
    for pile in piles() {
        let standing = pile.standing().unwrap();
        let forces = pile.forces::<BigRational>();
        let changes = pile.shape().stacking().runs().scan(0, |layer, run| {
            *layer += run.steps;
            Some(*layer)
        });
        // The first two layers are included, because surfaces begin there.
        let layers = changes
            .take(pile.shape().stacking().changes())
            .chain([0, 1]);
        let mut layers: Vec<i128> = layers.filter(|k| *k < pile.layers()).collect();
        layers.sort_unstable();
        let mut least: Option<ContactForce<BigRational>> = None;
        let mut first_failure = None;
        for k in layers {
            for contact in forces.contacts(Selection::Layer(k)).unwrap() {
                let contact = contact.unwrap();
                if contact.force < BigRational::zero() && first_failure.is_none() {
                    first_failure = Some(contact.site.k);
                }
                if least
                    .as_ref()
                    .is_none_or(|least| contact.force < least.force)
                {
                    least = Some(contact);
                }
            }
        }
        let stacking = pile.shape().stacking();
        assert_eq!(standing.first_failure, first_failure, "{stacking}");
        failures += usize::from(first_failure.is_some());
        // Of several minima, the result is the first.
        assert_eq!(standing.least, least, "{stacking}");
    }
    assert!(failures > 1);
}

/// The sphere with the greatest ratio is next to the end of a piece: a neighbour line begins at a sign change or carries
/// more than its own weight. Another program found both ratios over all spheres of the base.
#[test]
fn next_to_the_ends_of_pieces() {
    let top = Region::new(-3..=3, -4..=4, -2..=5).unwrap();
    let next_to_a_change = Pile::under(top, "(1,647)".parse().unwrap()).unwrap();
    let on_top = [
        ([3, -2], 1074),
        ([3, -4], 1),
        ([0, -1], 3840),
        ([-1, 2], 61639),
    ];
    let next_to_a_load = Pile::triangular(480).unwrap();
    let at_the_corners = [
        [0, 0],
        [479, 0],
        [0, 479],
        [0, 1],
        [478, 1],
        [0, 478],
        [1, 478],
    ];
    for (pile, k, loads, ratio2) in [
        (
            next_to_a_change,
            0,
            on_top.to_vec(),
            ratio(4 * 101_443, 619 * 619),
        ),
        (
            next_to_a_load,
            479,
            at_the_corners.map(|at| (at, 100)).to_vec(),
            ratio(228_007, 482 * 482),
        ),
    ] {
        let loaded = loads.iter().fold(pile, |pile, ([i, j], load)| {
            let site = Site { i: *i, j: *j, k };
            pile.with_load(site, ratio(*load, 1)).unwrap()
        });
        let extremes = loaded.base_extremes().unwrap();
        assert_eq!(extremes.max_shear_ratio.square(), ratio2);
    }
}

/// The corner of the base is cut off, so the counts on the lines above rise and fall along its rows. At one position the
/// three lines have 120, 240 and 240 spheres. No other position has the same sum.
#[test]
fn at_the_top_of_a_line() {
    let n = 120;
    let base = Region::new(0..=4 * n, 0..=6 * n, 3 * n..=6 * n).unwrap();
    let pile = Pile::on(base, format!("({})", 3 * n).parse().unwrap()).unwrap();
    let normal_max = pile.base_extremes().unwrap().normal_max;
    assert_eq!(normal_max, ratio((120 + 240 + 240) / 3 + 1, 1));
}

/// A pile that is unstable near the top may have a smaller force further down. So its least contact is `None`.
#[test]
fn an_unstable_pile_has_no_least_contact() {
    let small = Pile::under(Region::SITE, Stacking::hcp(12).unwrap()).unwrap();
    let standing = small.standing().unwrap();
    assert_eq!(standing.first_failure, Some(4));
    let least = standing.least.unwrap();
    assert!(least.site.k > 6, "{least:?}");
    let tall = Pile::under(Region::SITE, Stacking::hcp(100_000).unwrap()).unwrap();
    let standing = tall.standing().unwrap();
    assert_eq!((standing.first_failure, standing.least), (Some(4), None));
}

/// Small piles in which each bottom sphere in turn has another weight. The float of an ordinary sphere must not replace
/// its value.
#[test]
fn of_a_base_with_one_special_sphere() {
    let tiny = BigRational::from_integer(BigInt::from(7).pow(200)).recip();
    for (top, stacking) in [
        (Region::SITE, "+-+-+"),
        (Region::hexagon(2, 1).unwrap(), "-++-"),
        (Region::new(-1..=1, 0..=2, -1..=2).unwrap(), "+--"),
    ] {
        let pile = Pile::under(top, stacking.parse().unwrap()).unwrap();
        let first = pile.shape().sites().next().unwrap();
        let mut changed = vec![
            pile.clone(),
            pile.clone()
                .with_load(first, tiny.clone())
                .unwrap()
                .weightless(),
            // The forces that depend on this load overflow floats.
            pile.clone().with_load(first, tiny.recip().pow(3)).unwrap(),
        ];
        for site in pile.rows(Selection::Base).unwrap().flatten() {
            changed.extend([
                pile.clone().with_weight(site, ratio(0, 1)).unwrap(),
                pile.clone().with_weight(site, ratio(1, 2)).unwrap(),
                pile.clone().with_load(site, ratio(100, 1)).unwrap(),
            ]);
        }
        for pile in changed {
            equals_the_search_over_all(&pile);
        }
    }
}

/// Loads on the spheres with the greatest ratio and the least normal force, and on those with the greatest remaining ratio.
/// Their values without loads must not decide about the spheres between them.
#[test]
fn of_a_base_where_the_extremes_are_loaded() {
    let row = Region::new(0..=2, 0..=0, 0..=2).unwrap();
    let pile = Pile::under(row, "++-".parse().unwrap()).unwrap();
    let loaded = [[0, -1], [2, -1]].into_iter().fold(pile, |pile, [i, j]| {
        let site = Site { i, j, k: 3 };
        pile.with_load(site, ratio(1, 1)).unwrap()
    });
    equals_the_search_over_all(&loaded);
}

/// A load that overflows floats on each sphere in turn. Some forces of a row then have a float, and others do not.
#[test]
fn of_a_base_with_some_overflows() {
    let great = BigRational::from_integer(BigInt::from(7).pow(600));
    let top = Region::new(-1..=1, 0..=2, -1..=2).unwrap();
    let pile = Pile::under(top, "+--".parse().unwrap()).unwrap();
    for site in pile.rows(Selection::Layer(1)).unwrap().flatten() {
        equals_the_search_over_all(&pile.clone().with_load(site, great.clone()).unwrap());
    }
}

/// Four bottom spheres receive separate loads, and the large loads of all others make their ratios small. Two of the
/// four receive three equal loads. For the other two, one load is greater by 7.28 or 7.32 times 2^−537. Floats lose the
/// digits of their squared shears below 2^−1074 and give the first a greater ratio.
#[test]
fn of_ratios_with_underflowing_squares() {
    let power =
        |exponent: u32| BigRational::from_integer(num_bigint::BigInt::from(2).pow(exponent));
    let part = power(537).recip();
    let load = |pile: Pile, [i, j, k]: [i128; 3], load: &BigRational| {
        pile.with_load(Site { i, j, k }, load.clone()).unwrap()
    };
    let row = Region::new(0..=6, 0..=0, 0..=6).unwrap();
    let mut pile = Pile::under(row, "+-".parse().unwrap())
        .unwrap()
        .weightless();
    let pressed = [
        (0, ratio(1, 2)),
        (2, ratio(1, 1)),
        (4, ratio(1, 1)),
        (6, ratio(2, 1)),
    ];
    for (i, normal) in &pressed {
        for [i, j] in [[*i, 0], [i + 1, 0], [*i, 1]] {
            pile = load(pile, [i, j, 1], normal);
        }
    }
    for (at, parts) in [([2, 1, 1], 728), ([5, 0, 1], 732)] {
        pile = load(pile, at, &(&part * ratio(parts, 100)));
    }
    for site in pile
        .rows(Selection::Base)
        .unwrap()
        .flatten()
        .collect::<Vec<_>>()
    {
        if site.j != 0 || pressed.iter().all(|(i, _)| *i != site.i) {
            pile = load(pile, [site.i, site.j, 2], &power(600));
        }
    }
    equals_the_search_over_all(&pile);
    let greatest = pile.base_extremes().unwrap().max_shear_ratio.square();
    // (7.32/3)² parts, and slightly less because of the normal force.
    let parts = greatest / (&part * &part);
    assert!(
        ratio(595, 100) < parts && parts < ratio(596, 100),
        "{parts}"
    );
}

/// Two bottom spheres with known ratios of shear to normal force. The square of one overflows floats.
#[test]
fn of_ratios_with_overflowing_squares() {
    let power = |exponent: u32| BigRational::from_integer(BigInt::from(2).pow(exponent));
    let contact = |i, j| HorizontalContact {
        site: Site { i, j, k: 7 },
        axis: Axis::AlphaBeta,
    };
    let mut pile = Pile::under(Region::SITE, "+-------".parse().unwrap()).unwrap();
    for (at, force) in [((-1, -4), power(520)), ((-3, -1), power(500))] {
        let (i, j) = at;
        pile = pile.with_horizontal_force(contact(i, j), force).unwrap();
    }
    let loads = [
        ([-1, -3], power(521) + power(150) * ratio(3, 1)),
        ([-3, 0], power(501)),
    ];
    for ([i, j], load) in loads {
        pile = pile.with_load(Site { i, j, k: 7 }, load).unwrap();
    }
    equals_the_search_over_all(&pile);
}
