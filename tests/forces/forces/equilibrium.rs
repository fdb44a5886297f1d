//! Every sphere of every pile up to a size is in exact equilibrium, and the base supports the pile.

use cannonpile::geometry::Vector;
use cannonpile_testkit::answers::{Answers, Shape};
use num_rational::BigRational;

use crate::theorems::{Verdict, balance, base};

/// Checks all theorems about a pile of this shape.
fn theorems_hold(shape: &Shape, layers: i128) -> Verdict {
    let pile = Answers::of(shape, layers);
    balance::every_sphere_is_balanced(&pile)?;
    balance::neighbours_agree(&pile)?;
    balance::forces_lie_along_contacts(&pile)?;
    base::base_supports_the_weight(&pile)?;
    base::base_has_the_moment_of_the_weights(&pile)?;
    base::base_is_as_published(&pile)?;
    let extremes = shape.pile(layers).base_extremes();
    let greatest = extremes.map_err(|error| error.to_string())?.max_shear_ratio;
    base::base_shear_is_at_most(&pile, &greatest.to_rational().unwrap_or_default())?;
    if shape.pile(layers).is_regular() {
        balance::resultants_are_central(&pile)?;
    }
    Ok(())
}

#[test]
fn equilateral_piles_up_to_40_layers() {
    for layers in 1..=40 {
        theorems_hold(&Shape::equilateral(), layers).unwrap();
    }
}

#[test]
fn isosceles_piles_up_to_12_layers() {
    for shape in Shape::isosceles() {
        for layers in 1..=12 {
            theorems_hold(&shape, layers).unwrap();
        }
    }
}

#[test]
fn discs_up_to_40_layers() {
    for layers in 1..=40 {
        theorems_hold(&Shape::Discs, layers).unwrap();
    }
}

#[test]
fn the_unbalanced_force_is_zero() {
    let tall = [Shape::equilateral(), Shape::Discs].map(|shape| (shape, 40));
    for (shape, layers) in tall
        .into_iter()
        .chain(Shape::isosceles().map(|shape| (shape, 12)))
    {
        let pile = shape.pile(layers);
        let forces = pile.forces::<BigRational>();
        for site in shape.sites(layers - 1) {
            assert_eq!(
                forces.unbalanced(site),
                Ok(Vector::zero()),
                "{shape:?} {site}"
            );
        }
    }
}

#[test]
fn only_an_equilateral_base_is_uniform() {
    for shape in Shape::isosceles() {
        let pile = Answers::of(&shape, 12);
        let mut normals = pile.floor.values().map(|force| &force.z);
        let first = normals.next().unwrap();
        let even = normals.all(|normal| normal == first);
        assert_eq!(even, shape == Shape::equilateral(), "{shape:?}");
    }
}
