//! The exact engine on both sides of every switch of its bit width. Its values equal those of trees, of the oracle and of
//! brute force. The proved width is exact or a few bits too large.

use std::collections::BTreeSet;

use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::pow;

use cannonpile_testkit::cases::{Bounds, Case, Random, all_signs, limbs, repeated};
use cannonpile_testkit::compare::agrees;
use cannonpile_testkit::oracles::balance::{direction, ratio};
use cannonpile_testkit::oracles::brute::{self, LayerForces};

/// The bits of each limb except the top one.
const LIMB: u32 = 55;

/// The bits of the numbers of a sweep, as proved.
fn bits(case: &Case) -> u64 {
    case.pile.plan(Selection::Base).unwrap().bits
}

/// The limbs of each number of a sweep.
fn planes(case: &Case) -> u64 {
    limbs(bits(case))
}

fn power(base: u32, exponent: u32) -> BigInt {
    BigInt::from(base).pow(exponent)
}

/// A value with `limbs` limbs, each as large as possible after a carry.
fn full(limbs: u32) -> BigInt {
    let limb = power(2, LIMB - 1) - 1;
    (0..limbs).map(|p| &limb * power(2, p * LIMB)).sum()
}

/// The bits of the greatest value of a sweep, including the intermediate sums of a half-turn.
fn needed(case: &Case) -> u64 {
    let passed = brute::all(&case.balance);
    let greatest = passed.iter().map(|passed| passed.greatest.bits());
    greatest.max().unwrap_or(0)
}

/// Bits needed ≤ bits proved. The proved bits exceed the needed ones by at most `loose`.
fn is_wide_enough(case: &Case, loose: u64) {
    let (bits, needed) = (bits(case), needed(case));
    let witness = format!("{needed} {bits} {}", case.balance.signs);
    assert!(needed <= bits && bits <= needed + loose, "{witness}");
}

#[test]
fn the_bound_holds_and_is_tight_to_7_bits() {
    for signs in (2..=9).flat_map(all_signs) {
        let case = Case::under(&Bounds::SITE, &signs);
        if !case.pile.shape().stacking().is_straight() {
            is_wide_enough(&case, 7);
        }
    }
    for period in ["+-", "++--", "+--", "+++---"] {
        for steps in [20, 40, 60] {
            is_wide_enough(&Case::under(&Bounds::SITE, &repeated(period, steps)), 7);
        }
    }
    let mut random = Random(71);
    for _ in 0..20 {
        let signs = format!("+-{}", random.signs(10));
        is_wide_enough(&Case::under(&random.bounds(5), &signs), 7);
    }
}

#[test]
fn the_bound_holds_for_one_load_and_is_tight_to_5_bits() {
    for signs in ["+-", "+-+-", "++-", "+-+-+-+-+-"] {
        for exponent in 0..130 {
            let load = BigRational::from(power(2, exponent));
            let case = Case::under(&Bounds::SITE, signs);
            is_wide_enough(&case.clone().with_load((0, 0, 0), &load), 5);
            is_wide_enough(&case.clone().with_load((1, 0, 1), &load.recip()), 7);
            is_wide_enough(&case.weightless().with_load((1, 1, 0), &load), 5);
        }
    }
}

#[test]
fn the_bound_holds_for_many_loads() {
    let mut random = Random(72);
    for _ in 0..100 {
        let signs = format!("+-{}", random.signs(5));
        let mut case = Case::under(&random.bounds(3), &signs);
        // A load in the bottom layer counts towards the bound but is never on a line.
        let places: Vec<_> = case.balance.places().filter(|at| at.0 < 7).collect();
        for _ in 0..10 {
            case = case.with_load(places[random.below(places.len())], &random.rational());
        }
        // The bound adds the norms of ten loads on different spheres, which overestimates by at most √10.
        is_wide_enough(&case, 10);
    }
}

#[test]
fn light_spheres_do_not_offset_a_load() {
    for signs in ["+-+-+-+-+-", "+-+++++++++++", "+-+-+++++++++++"] {
        let mut case = Case::under(&Bounds::SITE, signs);
        let below: Vec<_> = case.balance.places().skip(1).collect();
        let load = ratio(i64::try_from(below.len()).unwrap(), 1);
        for place in below {
            case = case.with_weight(place, &ratio(0, 1));
        }
        is_wide_enough(&case.with_load((0, 0, 0), &load), 8);
    }
}

/// Returns whether x = n/d, without reduction to lowest terms, which would dominate the run time.
fn is_quotient(x: &BigRational, n: &BigInt, d: &BigInt) -> bool {
    x.numer() * d == n * x.denom()
}

/// Compares the sweep of a part with brute force, and the tree for some of its contacts.
fn agrees_with_brute_force(case: &Case, selection: Selection) {
    let (passed, d) = (brute::all(&case.balance), brute::denominator(&case.balance));
    let forces = case.pile.forces::<BigRational>();
    let contacts = forces.contacts(selection).unwrap();
    for (n, contact) in contacts.enumerate() {
        let contact = contact.unwrap();
        let Site { i, j, k } = contact.site;
        let LayerForces {
            forces: numerators,
            below,
            ..
        } = &passed[usize::try_from(k).unwrap()];
        let numerator = &numerators[&(j, i)][contact.direction.index()];
        let over = &d * pow(BigInt::from(3), below.changes);
        let force = &contact.force;
        assert!(
            is_quotient(force, numerator, &over),
            "{} {force}",
            contact.site
        );
        if n % 499 == 0 {
            let one = forces.contact(contact.site, contact.direction);
            assert_eq!(one, Ok(contact.force));
        }
    }
    let front = &passed.last().expect("a step").below;
    let weight = brute::numerator(&case.balance, &d);
    let unit = pow(BigInt::from(3), front.changes);
    let base = forces.base(Selection::Base).unwrap();
    for force in base {
        let force = force.unwrap();
        let Site { i, j, k } = force.site;
        let above: BigInt = front.from_above[&(j, i)].iter().sum();
        let normal = above + weight((k, j, i)) * &unit * 3;
        let is_brute = is_quotient(&force.normal, &normal, &(&d * &unit * 3));
        assert!(is_brute, "{} {}", force.site, force.normal);
    }
}

/// The numbers of steps at which a periodic stacking needs one more limb plane.
fn switches(period: &str, most: usize) -> Vec<usize> {
    let planes = |steps: usize| planes(&bare(period, steps));
    (6..most)
        .filter(|steps| planes(steps - 1) < planes(*steps))
        .collect()
}

/// A case for the plan only, without the oracle's sites.
fn bare(period: &str, steps: usize) -> Case {
    let mut case = Case::under(&Bounds::SITE, "");
    let stacking = cannonpile_testkit::cases::stacking(&repeated(period, steps));
    case.pile = cannonpile::Pile::under(Bounds::SITE.region(), stacking).unwrap();
    case
}

#[test]
fn high_stackings_around_the_first_switches() {
    let mut met = BTreeSet::new();
    // Debug builds take eight seconds for one period.
    let periods = 1 + usize::from(!cfg!(debug_assertions));
    for (period, most) in [("+-", 106), ("+--", 60)].into_iter().take(periods) {
        for steps in switches(period, most) {
            // Release builds try the upper neighbour too, which takes debug builds four seconds.
            let above = usize::from(!cfg!(debug_assertions));
            for steps in steps - 1..=steps + above {
                let case = Case::under(&Bounds::SITE, &repeated(period, steps));
                met.insert(planes(&case));
                let lowest = case.pile.layers() - 2;
                let whole = steps < 40;
                let selection = if whole {
                    Selection::All
                } else {
                    Selection::Layer(lowest)
                };
                agrees_with_brute_force(&case, selection);
            }
        }
    }
    assert_eq!(met.into_iter().collect::<Vec<_>>(), [1, 2, 3, 4]);
}

#[test]
fn loads_at_any_power_of_two() {
    let mut met = BTreeSet::new();
    // Exponents from a limb boundary on, and near 62 bits, where the first limb ends.
    let near = |e: &u32| {
        [0..4, 7..20, LIMB - 1..LIMB]
            .iter()
            .any(|near| near.contains(&(e % LIMB)))
    };
    for exponent in (0..380).filter(near) {
        let load = BigRational::from(power(2, exponent));
        let case = Case::under(&Bounds::SITE, "+-+-");
        for load in [&load - ratio(1, 1), load.clone(), load.recip()] {
            let case = case.clone().with_load((1, 0, 0), &load);
            met.insert(planes(&case));
            agrees(&case).unwrap();
        }
    }
    assert_eq!(met.into_iter().collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6, 7]);
}

#[test]
fn full_and_empty_limbs() {
    // Limbs over one denominator, each as large as after a carry, or 0 and 1.
    for (limbs, signs) in [
        (1, "+-+-+-+-+-"),
        (2, "-+-+-++-+-"),
        (3, "+-+--+-+"),
        (5, "+-+-+-+"),
    ] {
        let least = BigRational::from(power(2, limbs * LIMB)).recip();
        let full = &least * BigRational::from(full(limbs));
        let mut case = Case::under(&Bounds::triangle(2), signs);
        for (n, place) in case.balance.clone().places().enumerate() {
            let weight = match n % 3 {
                0 => continue,
                1 => full.clone(),
                _ => least.clone(),
            };
            case = case.with_weight(place, &weight);
        }
        assert!(planes(&case) > 1);
        agrees(&case).unwrap();
    }
}

#[test]
fn many_half_turns_between_carries() {
    // A denominator whose limbs are all at their maximum fills the lower limbs of every increment.
    for limbs in [1, 2] {
        let load = BigRational::new(1.into(), full(limbs));
        let case = Case::under(&Bounds::SITE, &repeated("+-", 23));
        let case = case.with_load((0, 0, 0), &load);
        assert!(planes(&case) > 1);
        agrees_with_brute_force(&case, Selection::All);
    }
}

#[test]
fn single_layers_equal_the_whole_pile() {
    let load = BigRational::from(power(2, 100));
    let case = Case::under(&Bounds::SITE, "+-+-++--+-").with_load((3, 0, 0), &load);
    let forces = case.balance.forces();
    for (at, forces) in &forces.below {
        for (m, force) in forces.iter().enumerate() {
            let one = case.pile.forces::<BigRational>();
            let one = one.contact(
                cannonpile_testkit::oracles::balance::site(*at),
                direction(m),
            );
            assert_eq!(one.as_ref(), Ok(force));
        }
    }
    for k in 0..10 {
        cannonpile_testkit::compare::contacts_in_rows(&case.pile, Selection::Layer(k), &forces)
            .unwrap();
    }
}
