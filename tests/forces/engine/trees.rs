//! The number of spheres at sign changes that the tree of a contact visits.

use std::collections::BTreeSet;

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Counters, Error, Method, Pile};

use cannonpile_testkit::cases::{Bounds, Case, Random, all_signs, repeated};
use cannonpile_testkit::oracles::balance::{Balance, Place, direction, site};

/// Returns whether the sign changes at layer k.
fn at_a_change(balance: &Balance, k: i128) -> bool {
    balance
        .sign(k - 1)
        .is_some_and(|above| balance.sign(k) != Some(above))
}

/// The spheres at sign changes on which a contact depends. The search follows each line to its start.
fn visited(balance: &Balance, contact: (Place, usize)) -> BTreeSet<Place> {
    let mut found = BTreeSet::new();
    let mut pending = vec![contact];
    while let Some((at, m)) = pending.pop() {
        let mixed = at_a_change(balance, at.0);
        if mixed && !found.insert(at) {
            continue;
        }
        for direction in 0..3 {
            if mixed || direction == m {
                pending.extend(balance.above(at, direction).map(|above| (above, direction)));
            }
        }
    }
    found
}

/// All spheres on the dependency cone of one sphere, itself included.
fn cone(balance: &Balance, at: Place) -> BTreeSet<Place> {
    let mut cone = BTreeSet::new();
    let mut pending = vec![at];
    while let Some(at) = pending.pop() {
        if cone.insert(at) {
            pending.extend((0..3).filter_map(|m| balance.above(at, m)));
        }
    }
    cone
}

/// The number of spheres at sign changes that a contact force visits.
fn turned(pile: &Pile, site: Site, direction: Direction) -> usize {
    let counters = Counters::default();
    let forces = pile.forces::<f64>().with_counters(&counters);
    forces.contact(site, direction).unwrap();
    counters.turned().try_into().unwrap()
}

fn tree_size_is_exact(case: &Case) {
    let balance = &case.balance;
    for at in balance.places().filter(|at| balance.sign(at.0).is_some()) {
        let changes = (0..=at.0).filter(|k| at_a_change(balance, *k)).count();
        let cone = cone(balance, at);
        let at_changes = cone.iter().filter(|at| at_a_change(balance, at.0)).count();
        let most = (3_usize.pow(u32::try_from(changes).unwrap()) - 1) / 2;
        for m in 0..3 {
            let nodes = turned(&case.pile, site(at), direction(m));
            assert_eq!(nodes, visited(balance, (at, m)).len(), "{at:?} {m}");
            assert!(nodes <= most.min(at_changes), "{at:?} {m}");
        }
    }
}

#[test]
fn a_tree_visits_each_dependency_once() {
    for signs in (1..8).flat_map(all_signs) {
        tree_size_is_exact(&Case::under(&Bounds::SITE, &signs));
    }
    tree_size_is_exact(&Case::under(&Bounds::SITE, &repeated("+-", 11)));
    let mut random = Random(81);
    for _ in 0..40 {
        let signs = random.signs(8);
        tree_size_is_exact(&Case::under(&random.bounds(4), &signs));
        if let Some(case) = Case::on(&random.bounds(12), &signs) {
            tree_size_is_exact(&case);
        }
    }
}

#[test]
fn a_sweep_replaces_a_tree_that_is_too_large() {
    let pile = Pile::under(Region::SITE, Stacking::hcp(400).unwrap()).unwrap();
    let middle = Site { i: 0, j: 0, k: 398 };
    let forces = pile.forces::<f64>();
    // An explicit tree is still rejected.
    let by_tree = forces.clone().with_method(Method::Tree).unwrap();
    let refused = by_tree.contact(middle, Direction::Alpha);
    assert!(matches!(refused, Err(Error::TooLarge { .. })));
    // Release builds run the sweep too, twice. It takes debug builds ten seconds.
    if cfg!(debug_assertions) {
        return;
    }
    let one = forces.contact(middle, Direction::Alpha).unwrap();
    let mut contacts = forces
        .contacts(Selection::Layer(398))
        .unwrap()
        .map(Result::unwrap);
    let in_rows = contacts.find(|c| (c.site, c.direction) == (middle, Direction::Alpha));
    assert_eq!(in_rows.map(|contact| contact.force), Some(one));
}

/// The error must not mention a sweep, because the caller did not choose one.
#[test]
fn the_error_names_the_tree_if_both_are_too_large() {
    let pile = Pile::under(Region::SITE, Stacking::hcp(10_000).unwrap()).unwrap();
    let middle = Site {
        i: 0,
        j: 0,
        k: 9_998,
    };
    let refused = pile.forces::<f64>().contact(middle, Direction::Alpha);
    let Err(Error::TooLarge { quantity, .. }) = refused else {
        panic!("{refused:?}");
    };
    assert_eq!(
        quantity,
        "the forces on spheres this far below so many sign changes"
    );
}
