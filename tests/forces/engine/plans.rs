//! Exact plans and counters. Each number was worked out by hand from its definition.

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::shape::Selection;
use cannonpile::{Counters, Error, Method, Pile, Quantity, Question};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use num_traits::ToPrimitive;

use cannonpile_testkit::cases::stacking;
use cannonpile_testkit::oracles::balance::ratio;

/// The maximal number of values in a sweep.
const MAX_NUMBERS: u64 = 134_217_728;

fn under_one_sphere(signs: &str) -> Pile {
    Pile::under(Region::SITE, stacking(signs)).unwrap()
}

/// Returns a pile under one row of `n` spheres.
fn under_a_row(n: i128, signs: &str) -> Pile {
    let row = Region::new(0..=n - 1, 0..=0, 0..=n - 1).unwrap();
    Pile::under(row, stacking(signs)).unwrap()
}

fn by(method: Method, part: Selection) -> Question {
    Question::from(part).with_method(method)
}

/// The layers have 1, 3, 7, 12, 19 and 27 spheres.
#[test]
fn a_sweep_to_the_floor_of_six_layers() {
    let pile = under_one_sphere("+-+-+");
    let plan = pile.plan(Selection::Base).unwrap();
    assert_eq!(plan.method, Method::Sweep);
    // 27 on the floor, and 3 + 7 + 12 + 19 at the sign changes.
    assert_eq!(plan.visited, 68_u32.into());
    assert_eq!(plan.rows, 27_u32.into());
    // 3·27 values.
    assert_eq!(plan.bytes, (81_u32 * 8).into());
    // ⌊√(36·6·69)⌋ + 1 = 123, tripled for each sign change but the first: 123·27 = 3321 < 2¹².
    assert_eq!(plan.bits, 12);

    let counters = Counters::default();
    let forces = pile.forces::<BigRational>().with_counters(&counters);
    assert_eq!(forces.base(Selection::Base).unwrap().plan(), &plan);
    assert_eq!(forces.base(Selection::Base).unwrap().count(), 27);
    // The pile has threefold symmetry. So 27 of the 41 spheres are enough.
    assert_eq!((counters.passes(), counters.turned()), (5, 27));
    assert_eq!((counters.visited(), counters.rows()), (27, 27));
    let printed = "27 visited, 27 turned, 5 passes, 27 rows";
    assert_eq!(counters.to_string(), printed);
    // A sweep to layer 2 does not visit its own sign change: 7 spheres, and 3 at the change above.
    let plan = pile.plan(by(Method::Sweep, Selection::Layer(2))).unwrap();
    assert_eq!(plan.visited, 10_u32.into());
}

/// A layer at a sign change transmits forces after a half-turn. The bit width includes this half-turn.
#[test]
fn the_bit_width_includes_the_last_sign_change() {
    let (layer, pile) = (Selection::Layer(2), under_one_sphere("+-+"));
    let bits = |pile: &Pile| pile.plan(by(Method::Sweep, layer)).unwrap().bits;
    // ⌊√(36·3·11)⌋ + 1 = 35, tripled once: 105 < 2⁷.
    assert_eq!(bits(&pile), 7);
    // For loads only: six times 7/2, over the denominator 2, tripled: 126 < 2⁷.
    let response = pile.weightless().with_load(Site::APEX, ratio(7, 2));
    assert_eq!(bits(&response.unwrap()), 7);
}

/// The pile has 11 spheres above the bottom layer, in 3 layers of at most 3 rows. This gives 9 pieces, each below at most 3
/// spheres at the sign change in layer 1.
#[test]
fn trees_are_planned_piece_by_piece() {
    let pile = under_one_sphere("+-+");
    let plan = pile.plan(by(Method::Tree, Selection::All)).unwrap();
    assert_eq!(plan.visited, (9_u32 * 3 + 11).into());
    // One layer has 3 pieces.
    let layer = pile.plan(by(Method::Tree, Selection::Layer(2))).unwrap();
    assert_eq!(layer.visited, (3_u32 * 3 + 7).into());
    // One sphere depends on three at the last sign change and on nine of ten at the first.
    let pile = under_one_sphere("+++---+++");
    let one = Selection::One(Site { i: 0, j: 0, k: 8 });
    let plan = pile.plan(one).unwrap();
    assert_eq!(plan.method, Method::Tree);
    assert_eq!(plan.visited, (9_u32 + 3 + 1).into());
}

#[test]
fn a_plan_prints_as_one_line() {
    let printed = |signs, question: Question| {
        let plan = under_one_sphere(signs).plan(question).unwrap();
        plan.to_string()
    };
    let one = Selection::One(Site::APEX);
    let closed = "closed: 10 spheres visited";
    assert_eq!(printed("+++", Selection::All.into()), closed);
    let swept = "sweep: 68 spheres visited, 648 bytes for numbers of 12 bits";
    assert_eq!(printed("+-+-+", Selection::Base.into()), swept);
    assert_eq!(printed("+-+", one.into()), "tree: 1 spheres visited");
}

#[test]
fn a_sphere_inside_a_run_depends_on_three_at_the_change() {
    let pile = under_one_sphere("+--");
    let nodes = |i, j, k| {
        Direction::ALL.map(|line| {
            let counters = Counters::default();
            let forces = pile.forces::<BigRational>().with_counters(&counters);
            forces.contact(Site { i, j, k }, line).unwrap();
            counters.turned()
        })
    };
    assert_eq!(nodes(0, 0, 0), [0; 3]);
    // At the sign change: the sphere itself.
    assert_eq!(nodes(0, 0, 1), [1; 3]);
    // Each line comes from one of the three spheres at the change.
    assert_eq!(nodes(0, 0, 2), [1; 3]);
    let counters = Counters::default();
    let forces = pile.forces::<BigRational>().with_counters(&counters);
    forces.from_above(Site { i: 0, j: 0, k: 2 }).unwrap();
    // The three spheres and the sphere itself.
    assert_eq!((counters.turned(), counters.visited()), (3, 4));
}

#[test]
fn a_bare_selection_is_a_question_about_contacts_or_the_floor() {
    let quantity = |part| Question::from(part).quantity;
    assert_eq!(quantity(Selection::Base), Quantity::Floor);
    for part in [
        Selection::All,
        Selection::Layer(1),
        Selection::One(Site::APEX),
    ] {
        assert_eq!(quantity(part), Quantity::Contacts);
    }
}

/// Three layers under a row of n spheres have n, 2n + 1 and 3n + 4 spheres.
#[test]
fn a_sweep_has_at_most_2_to_the_27_values() {
    let plan = |n| under_a_row(n, "+-").plan(by(Method::Sweep, Selection::Base));
    let (most, more) = (
        BigUint::from(MAX_NUMBERS - 5),
        BigUint::from(MAX_NUMBERS + 4),
    );
    match plan(14_913_079) {
        // The address space of 32 bits may have no room for them in one piece.
        Err(Error::TooLarge { needed, limit, .. }) if cfg!(target_pointer_width = "32") => {
            assert!(needed == most && limit < MAX_NUMBERS - 5);
        }
        plan => assert_eq!(plan.unwrap().bytes, most * 8_u32),
    }
    let refused = Error::TooLarge {
        quantity: "a sweep down to this layer",
        needed: more,
        limit: MAX_NUMBERS,
        remedy: "ask for one sphere, or for fewer layers",
    };
    assert_eq!(plan(14_913_080), Err(refused));
}

/// A float takes one word. An exact integer takes its own struct plus one word of digits.
#[test]
fn a_rejected_sweep_reports_the_words_it_needs() {
    let n = 50_000_000;
    let (pile, site) = (under_a_row(n, "+-"), Site { i: 7, j: 0, k: 1 });
    let refused = |result: Result<(), Error>| match result {
        Err(Error::TooLarge { needed, .. }) => needed,
        other => panic!("{other:?}"),
    };
    let floats = pile.forces::<f64>().with_method(Method::Sweep).unwrap();
    let numbers = BigUint::from(3 * (2 * n + 1).unsigned_abs());
    assert_eq!(refused(floats.from_above(site).map(|_| ())), numbers);
    let exact = pile
        .forces::<BigRational>()
        .with_method(Method::Sweep)
        .unwrap();
    let words = size_of::<BigInt>().div_ceil(8) + 1;
    assert_eq!(refused(exact.from_above(site).map(|_| ())), numbers * words);
}

#[test]
fn floats_below_sign_changes_are_close_to_exact_forces() {
    let pile = under_one_sphere("+-++-");
    let (floats, exact) = (pile.forces::<f64>(), pile.forces::<BigRational>());
    let by_sweep = floats.clone().with_method(Method::Sweep).unwrap();
    for contact in exact.contacts(Selection::All).unwrap() {
        let contact = contact.unwrap();
        let near = contact.force.to_f64().unwrap();
        for floats in [&floats, &by_sweep] {
            let float = floats.contact(contact.site, contact.direction).unwrap();
            assert!((float - near).abs() < 1e-12, "{contact:?} {float}");
        }
    }
}
