//! Every theorem about forces, and the oracle of straight piles, rejects at least one injected fault.

use cannonpile::lattice::{Direction, Site};
use cannonpile_testkit::answers::{Answers, Contact, Shape, ratio};
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::theorems::symmetry::{MIRRORED, Symmetry, TURNS, invariant};
use crate::theorems::{Verdict, agree, balance, base};

const LAYERS: i128 = 5;

/// A sphere in the middle of the pile, and a corner of its base.
const INNER: Site = Site { i: 1, j: 1, k: 3 };
const CORNER: Site = Site { i: 4, j: 0, k: 4 };

/// Checks that the theorem holds for the paper's pile and fails for the pile with the fault.
fn catches(theorem: impl Fn(&Answers) -> Verdict, fault: impl FnOnce(&mut Answers)) {
    let mut pile = Answers::of(&Shape::equilateral(), LAYERS);
    assert_eq!(theorem(&pile), Ok(()));
    fault(&mut pile);
    assert!(theorem(&pile).is_err(), "the theorem misses the fault");
}

fn contact(pile: &mut Answers, site: Site, direction: Direction) -> &mut Contact {
    pile.contacts.get_mut(&(site, direction)).unwrap()
}

/// One contact has one increment too many, as a magnitude and as a vector.
fn one_increment_more(pile: &mut Answers) {
    let contact = contact(pile, INNER, Direction::Beta);
    let more = (&contact.force + BigRational::one()) / &contact.force;
    contact.force = &contact.force * &more;
    contact.vector = contact.vector.clone().scaled(&more);
}

/// Two supports of a sphere are exchanged.
fn neighbours_transposed(pile: &mut Answers) {
    let site = Site { i: 2, j: 0, k: 2 };
    let beta = contact(pile, site, Direction::Beta).clone();
    let gamma = core::mem::replace(contact(pile, site, Direction::Gamma), beta);
    *contact(pile, site, Direction::Beta) = gamma;
}

/// The names α and β are exchanged, but not their contacts.
fn alpha_for_beta(pile: &mut Answers) {
    for site in pile.shape.sites(LAYERS - 1) {
        let alpha = contact(pile, site, Direction::Alpha).force.clone();
        let beta = contact(pile, site, Direction::Beta);
        let beta = core::mem::replace(&mut beta.force, alpha);
        contact(pile, site, Direction::Alpha).force = beta;
    }
}

fn weightless(pile: &mut Answers) {
    pile.weight = BigRational::zero();
}

fn base_without_its_own_weight(pile: &mut Answers) {
    for force in pile.floor.values_mut() {
        force.z -= BigRational::one();
    }
}

/// The reaction of the floor in place of the force on the floor.
fn shear_reversed(pile: &mut Answers) {
    for force in pile.floor.values_mut() {
        force.x = -&force.x;
        force.y = -&force.y;
    }
}

fn one_shear_reversed(pile: &mut Answers) {
    let force = pile.floor.get_mut(&CORNER).unwrap();
    force.x = -&force.x;
}

/// The shears still sum to zero, but their moment does not vanish.
fn shear_turned(pile: &mut Answers) {
    for force in pile.floor.values_mut() {
        let [x, y] = TURNS[1].map(|[x, y]| &force.x * ratio(x, 2) + &force.y * ratio(y, 2));
        (force.x, force.y) = (x, y);
    }
}

/// The total weight is right, but one corner bears a part of the weight on another.
fn load_shifted(pile: &mut Answers) {
    pile.floor.get_mut(&CORNER).unwrap().z += BigRational::one();
    let other = Site { i: 0, j: 4, k: 4 };
    pile.floor.get_mut(&other).unwrap().z -= BigRational::one();
}

fn corner_moved(pile: &mut Answers) {
    pile.spheres.get_mut(&CORNER).unwrap().position.x += ratio(1, 1000);
}

fn received_from_nowhere(pile: &mut Answers) {
    pile.spheres.get_mut(&Site::APEX).unwrap().from_above[2] = BigRational::one();
}

fn resultant_off(pile: &mut Answers) {
    pile.spheres.get_mut(&INNER).unwrap().resultant_above.z += ratio(1, 1000);
}

#[test]
fn balance_of_every_sphere() {
    for fault in [
        one_increment_more,
        weightless,
        neighbours_transposed,
        base_without_its_own_weight,
        shear_reversed,
        one_shear_reversed,
        shear_turned,
        load_shifted,
    ] {
        catches(balance::every_sphere_is_balanced, fault);
    }
}

#[test]
fn action_and_reaction() {
    for fault in [
        one_increment_more,
        neighbours_transposed,
        alpha_for_beta,
        received_from_nowhere,
        resultant_off,
    ] {
        catches(balance::neighbours_agree, fault);
    }
}

#[test]
fn direction_of_forces() {
    for fault in [neighbours_transposed, alpha_for_beta, corner_moved] {
        catches(balance::forces_lie_along_contacts, fault);
    }
    catches(balance::forces_lie_along_contacts, |pile| {
        // Tension along the right line.
        let contact = contact(pile, INNER, Direction::Alpha);
        contact.force = -&contact.force;
        contact.vector = -contact.vector.clone();
    });
}

#[test]
fn central_resultants() {
    for fault in [corner_moved, resultant_off] {
        catches(balance::resultants_are_central, fault);
    }
    let isosceles = Answers::of(&Shape::Spheres(ratio(2, 5)), LAYERS);
    assert!(balance::resultants_are_central(&isosceles).is_err());
}

#[test]
fn weight_on_the_base() {
    for fault in [base_without_its_own_weight, one_shear_reversed] {
        catches(base::base_supports_the_weight, fault);
    }
}

#[test]
fn moment_of_the_base() {
    for fault in [load_shifted, shear_turned, corner_moved] {
        catches(base::base_has_the_moment_of_the_weights, fault);
    }
}

#[test]
fn published_base() {
    for fault in [
        base_without_its_own_weight,
        load_shifted,
        shear_reversed,
        shear_turned,
    ] {
        catches(base::base_is_as_published, fault);
    }
}

#[test]
fn greatest_shear() {
    let at_most = |pile: &Answers| base::base_shear_is_at_most(pile, &ratio(4, 7));
    catches(at_most, |pile| {
        // A comparison with signs would miss this.
        let force = pile.floor.get_mut(&CORNER).unwrap();
        force.x = &force.x * ratio(-2, 1);
    });
    let pile = Answers::of(&Shape::equilateral(), LAYERS);
    assert!(base::base_shear_is_at_most(&pile, &ratio(5, 7)).is_err());
}

#[test]
fn symmetries() {
    for (symmetry, turn) in Symmetry::ALL.into_iter().zip(&TURNS).skip(1) {
        let theorem = |pile: &Answers| invariant(pile, symmetry, turn);
        for fault in [
            neighbours_transposed,
            one_shear_reversed,
            corner_moved,
            load_shifted,
        ] {
            catches(theorem, fault);
        }
        catches(theorem, |pile| {
            pile.contacts
                .remove(&(Site { i: 0, j: 1, k: 3 }, Direction::Alpha));
        });
    }
    // A correct pile with the wrong rotation.
    let pile = Answers::of(&Shape::equilateral(), LAYERS);
    assert!(invariant(&pile, Symmetry::ROTATION, &TURNS[2]).is_err());
    assert!(invariant(&pile, Symmetry::ROTATION, &MIRRORED).is_err());
}

#[test]
fn the_oracle_of_forces() {
    let solved = cannonpile_testkit::oracles::elimination::solve(&Shape::equilateral(), LAYERS);
    let agrees = |pile: &Answers| agree(pile, &solved);
    for fault in [
        one_increment_more,
        neighbours_transposed,
        alpha_for_beta,
        weightless,
        base_without_its_own_weight,
        shear_reversed,
        one_shear_reversed,
        shear_turned,
        load_shifted,
        corner_moved,
        received_from_nowhere,
        resultant_off,
    ] {
        catches(agrees, fault);
    }
    catches(agrees, |pile| {
        pile.contacts.remove(&(INNER, Direction::Gamma));
    });
    catches(agrees, |pile| {
        let there = pile.floor[&CORNER].clone();
        pile.floor.insert(INNER, there);
    });
    // The oracle depends on the shape.
    for other in [Shape::Spheres(ratio(501, 1000)), Shape::Discs] {
        assert!(agree(&Answers::of(&other, LAYERS), &solved).is_err());
    }
    let taller = Answers::of(&Shape::equilateral(), LAYERS + 1);
    assert!(agree(&taller, &solved).is_err());
}
