//! The least contact and the first failure: piles with special weights, early ends of a search, and the limits of a search.

use cannonpile::lattice::{Axis, Direction, HorizontalContact, Region, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Error, Pile, Standing};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;

use cannonpile_testkit::cases::{Bounds, Case, Random, limbs, repeated, stacking};
use cannonpile_testkit::compare::{agrees, standing};
use cannonpile_testkit::oracles::balance::ratio;
use cannonpile_testkit::oracles::brute;

fn least(case: &Case) -> (Site, Direction, BigRational) {
    standing(&case.pile, &case.balance.forces()).unwrap();
    let least = case.pile.standing().unwrap().least.unwrap();
    (least.site, least.direction, least.force)
}

/// The sphere below both top spheres receives 1, 1 and 0, which a half-turn changes to 1/3, 1/3 and 4/3. At a sign change,
/// the force of a line is not the weight of its first sphere, here 0.
#[test]
fn no_line_begins_at_a_change_of_sign() {
    let pair = Bounds {
        x: (0, 1),
        y: (0, 0),
        s: (0, 1),
    };
    let between = Site { i: 1, j: 0, k: 1 };
    for signs in ["+--", "+-"] {
        let case = Case::under(&pair, signs).with_weight((1, 0, 1), &ratio(0, 1));
        let expected = (between, Direction::Alpha, ratio(1, 3));
        assert_eq!(least(&case), expected, "{signs}");
    }
}

#[test]
fn a_light_sphere_at_a_surface_has_the_least_force() {
    let case = Case::under(&Bounds::SITE, "+++").with_weight((1, 0, 1), &ratio(1, 7));
    let light = Site { i: 1, j: 0, k: 1 };
    assert_eq!(least(&case), (light, Direction::Alpha, ratio(1, 7)));
}

/// Two neighbours press each other in a straight pile. One has a tensile contact below it, although no line begins there.
#[test]
fn horizontal_forces_can_cause_tension() {
    let mut case = Case::under(&Bounds::SITE, "+++");
    let contact = HorizontalContact {
        site: Site { i: 0, j: 0, k: 2 },
        axis: Axis::AlphaBeta,
    };
    let pushed = case.pile.with_horizontal_force(contact, ratio(5, 1));
    case.pile = pushed.unwrap();
    case.balance
        .add_horizontal_force((2, 0, 0), [1, 0], &ratio(5, 1));
    agrees(&case).unwrap();
    let standing = case.pile.standing().unwrap();
    assert_eq!(standing.first_failure, Some(2));
    assert!(standing.least.unwrap().force < ratio(0, 1));
}

#[test]
fn a_pile_with_horizontal_forces_agrees_with_the_oracle() {
    let mut random = Random(12);
    for signs in ["+-+", "++-", "-+"] {
        let case = Case::under(&Bounds::hexagon(2, 2), signs)
            .with_random_horizontal_forces(3, &mut random);
        assert!(case.pile.horizontal_forces().len() > 0);
        agrees(&case).unwrap();
    }
}

/// Many sign changes under tops with threefold symmetry. The sweep computes a third of each layer, in several sub-triangles.
#[test]
fn high_piles_agree_with_the_oracle() {
    for (top, signs) in [
        (Bounds::SITE, repeated("+-", 13)),
        (Bounds::hexagon(2, 1), repeated("+-++-", 13)),
    ] {
        let case = Case::under(&top, &signs);
        standing(&case.pile, &case.balance.forces()).unwrap();
        extremes_agree_with_the_oracle(&case);
    }
}

fn extremes_agree_with_the_oracle(case: &Case) {
    let floor = case.balance.forces().floor;
    let extremes = case.pile.base_extremes().unwrap();
    let normals = || floor.values().map(|[normal, ..]| normal);
    assert_eq!(Some(&extremes.normal_min), normals().min());
    assert_eq!(Some(&extremes.normal_max), normals().max());
    let squared = floor.values();
    let squared = squared.map(|[n, x, y]| (x * x + y * y * ratio(3, 1)) / (n * n));
    assert_eq!(Some(extremes.max_shear_ratio.square()), squared.max());
}

/// Values of two limbs, compared with brute force.
#[test]
fn the_least_value_of_two_limbs_equals_brute_force() {
    let case = Case::under(&Bounds::SITE, &repeated("+-", 40));
    assert_eq!(limbs(case.pile.plan(Selection::Base).unwrap().bits), 2);
    let passed = brute::all(&case.balance);
    let contacts = (0..).zip(&passed).flat_map(|(k, passed)| {
        let over = BigInt::from(3).pow(u32::try_from(passed.below.changes).unwrap());
        passed.forces.iter().flat_map(move |(&(j, i), forces)| {
            let over = over.clone();
            let forces = forces.iter().zip(Direction::ALL);
            forces.map(move |(force, direction)| {
                let force = BigRational::new(force.clone(), over.clone());
                (force, Site { i, j, k }, direction)
            })
        })
    });
    // The first of several minima.
    let least = contacts.min_by(|one, other| one.0.cmp(&other.0)).unwrap();
    let found = case.pile.standing().unwrap().least.unwrap();
    assert_eq!((found.force, found.site, found.direction), least);
}

/// The force of a weightless bottom sphere must not be taken for that of its neighbours, which receive the same load
/// from above.
#[test]
fn a_light_bottom_sphere_does_not_hide_others() {
    let row = Bounds {
        x: (0, 7),
        y: (0, 0),
        s: (0, 7),
    };
    let bottom = Case::under(&row, "+-").balance.layers[2].clone();
    for (j, i) in bottom {
        let case = Case::under(&row, "+-").with_weight((2, j, i), &ratio(0, 1));
        extremes_agree_with_the_oracle(&case);
    }
    // Of two maxima, this is the first.
    let top = Bounds {
        x: (-1, 2),
        y: (-1, 1),
        s: (-1, 2),
    };
    let case = Case::under(&top, "+-").with_weight((2, 0, 0), &ratio(0, 1));
    extremes_agree_with_the_oracle(&case);
}

/// The ratios have units of 2cosφ, which are irrational here.
#[test]
fn the_greatest_ratio_of_an_isosceles_pile_is_found() {
    for s in [ratio(1, 3), ratio(4, 5), ratio(5, 7)] {
        let pile = Pile::isosceles(5, s.clone()).unwrap();
        let across = ratio(4, 1) * (ratio(1, 1) - &s * &s);
        let forces = pile.forces::<BigRational>();
        let base = forces.base(Selection::Base).unwrap();
        let squared = base.map(|force| {
            let (n, x, y) = force.map(|f| (f.normal, f.shear_x, f.shear_y)).unwrap();
            (&x * &x + &y * &y * &across) / (&n * &n)
        });
        let extremes = pile.base_extremes().unwrap();
        assert_eq!(Some(extremes.max_shear_ratio.square()), squared.max());
    }
}

/// The search stops at a failure. It ignores a sign change a nonillion layers below.
#[test]
fn the_search_stops_at_a_failure_near_the_top() {
    let stacking = format!("(1,1,1,1,{},1)", 10_i128.pow(30));
    let pile = Pile::under(Region::SITE, stacking.parse().unwrap()).unwrap();
    assert_eq!(pile.first_failure(), Ok(Some(4)));
}

/// Nine rows of n to n + 8 spheres at the only sign change, after eight steps below a row of n: 9n + 36 spheres.
fn ridge(n: i128) -> Pile {
    let row = Region::new(0..=n - 1, 0..=0, 0..=n - 1).unwrap();
    Pile::under(row, stacking("++++++++-")).unwrap()
}

/// A long ridge fails at its ends, like a short one.
fn fails_as_a_short_one(found: &Standing) {
    let bounds = Bounds {
        x: (0, 29),
        y: (0, 0),
        s: (0, 29),
    };
    let short = Case::under(&bounds, "++++++++-");
    let (_, direction, force) = least(&short);
    let least = found.least.as_ref().unwrap();
    assert_eq!((&least.force, least.direction), (&force, direction));
    assert_eq!(found.first_failure, Some(8));
}

/// Three values per sphere at a sign change, at most 10⁹ in total. So the limit is 333,333,333 spheres.
#[test]
fn the_search_examines_at_most_a_billion_values() {
    let most = ridge(37_037_033);
    let at_the_change = most.rows(Selection::Layer(8)).unwrap().site_count();
    assert_eq!(at_the_change, 333_333_333_u32.into());
    fails_as_a_short_one(&most.standing().unwrap());
    let more = ridge(37_037_034).standing().unwrap();
    assert_eq!((more.first_failure, more.least), (Some(8), None));
}

/// The limit counts limbs. One load in the bottom layer just fits into the limb of the weights, and the next needs a second
/// limb.
#[test]
fn longer_values_reduce_the_number_of_spheres() {
    let pile = ridge(30_000_000);
    let bottom = Site { i: 0, j: 0, k: 9 };
    // 2√3·B·D ≤ √(36·K·N) + 6·W < 2⁶².
    let root = (pile.sphere_count() * 360_u32).sqrt() + 1_u32;
    let most: BigUint = ((BigUint::from(1_u32) << 62_u32) - 1_u32 - root) / 6_u32;
    let loaded = |load: BigUint| {
        let load = BigRational::from_integer(BigInt::from(load));
        pile.clone().with_load(bottom, load).unwrap()
    };
    fails_as_a_short_one(&loaded(most.clone()).standing().unwrap());
    let longer = loaded(most + 1_u32).standing().unwrap();
    assert_eq!((longer.first_failure, longer.least), (Some(8), None));
}

/// Sign changes in layers of 8 and 9 rows, below a row of n spheres with a load. This needs 14 values for each row, 9 for
/// each of the 8n + 28 spheres at the first change, and 18 for the load.
fn refused(n: i128, load: BigRational, loaded: fn(i128) -> Site) {
    let row = Region::new(5..=4 + n, 3..=3, 8..=7 + n).unwrap();
    let pile = Pile::under(row, stacking("+++++++-+")).unwrap();
    let pile = pile.with_load(loaded(n), load);
    let starts = 8 * n.unsigned_abs() + 28;
    let refused = Error::TooLarge {
        quantity: "the verdict on this pile",
        needed: BigUint::from(14 * (8 + 9) + 9 * (starts + 2)),
        limit: 134_217_728,
        remedy: "move the sign changes closer to the top",
    };
    assert_eq!(pile.unwrap().standing(), Err(refused));
}

/// A sweep fits down to the last sign change, but not one layer further.
#[test]
fn the_error_of_a_large_verdict_states_its_size() {
    refused(4_600_000, ratio(2, 1), |_| Site { i: 6, j: 3, k: 0 });
}

/// Rows of 10¹² spheres, and 10¹² of them, are not visited one by one. The stacking "-(10¹²,3)" is that of "(10¹²,3)" as seen
/// in a mirror.
#[test]
fn long_rows_are_refused_at_once() {
    let refused = |pile: Pile| matches!(pile.stands(), Err(Error::TooLarge { .. }));
    for stacking in [
        "(1000000000000,3)",
        "-(1000000000000,3)",
        "(3,1000000000000,2)",
    ] {
        let pile = Pile::under(Region::SITE, stacking.parse().unwrap()).unwrap();
        assert!(refused(pile), "{stacking}");
        let base = Region::hexagon(20_000_000_000_000, 20_000_000_000_000).unwrap();
        let pile = Pile::on(base, stacking.parse().unwrap()).unwrap();
        assert!(refused(pile), "{stacking} on a base");
    }
}

/// Here one limb each would fit, but the load needs two: 3·(√(36·K·N) + 6·W) ≥ 2⁶² for all ten layers, and for no fewer.
#[test]
fn the_limbs_of_the_last_layer_count_towards_the_limit() {
    let n = 4_400_000;
    let row = Region::new(5..=4 + n, 3..=3, 8..=7 + n).unwrap();
    let spheres = Pile::under(row, stacking("+++++++-+")).unwrap();
    let root = (spheres.sphere_count() * 360_u32).sqrt() + 1_u32;
    let least = ((BigUint::from(1_u32) << 62_u32) / 3_u32 + 1_u32 - root) / 6_u32 + 1_u32;
    let load = BigRational::from_integer(BigInt::from(least));
    refused(n, load, |n| Site {
        i: n / 2,
        j: 4,
        k: 9,
    });
}

/// The base has two rows: n + 1 spheres that support two each, or one at the ends, and n that support one. The search
/// examines few spheres, among them the loaded one.
#[test]
fn a_load_on_the_floor_is_found_in_long_rows() {
    let n = 100_000;
    let row = Region::new(0..=n - 1, 0..=0, 0..=n - 1).unwrap();
    let pile = Pile::under(row, stacking("+")).unwrap();
    let bottom = Site {
        i: 5_000,
        j: 0,
        k: 1,
    };
    let loaded = pile.with_load(bottom, ratio(50, 1)).unwrap();
    let extremes = loaded.base_extremes().unwrap();
    assert_eq!(extremes.normal_min, ratio(4, 3));
    assert_eq!(extremes.normal_max, ratio(155, 3));
}

/// The load is on the whole top layer. The search must not look for the start of a line in other layers, because every
/// run has only one step.
#[test]
fn a_load_on_the_top_of_a_million_layers() {
    let hcp = Stacking::hcp(1_000_000).unwrap();
    let pile = Pile::under(Region::SITE, hcp).unwrap();
    for load in [ratio(1, 1), ratio(1, 1000)] {
        let pile = pile.clone().with_load(Site::APEX, load).unwrap();
        assert_eq!(pile.first_failure(), Ok(Some(4)));
    }
}
