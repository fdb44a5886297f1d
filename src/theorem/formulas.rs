//! The formulas that theorems are about, each replaceable by a wrong one.

use crate::closed_form::{self, Increments};
use crate::geometry::{self, Vector};
use crate::lattice::{Direction, Symmetry, count};
use crate::scalar::Polynomial;
use crate::transfer;

type P = Polynomial;
/// ê_a, ê_b, ê_c.
type Directions = [Vector<P>; 3];
/// Lower or upper bounds of i, j and i+j.
type Bounds = [P; 3];
/// What a sphere adds to its three lines.
type Added = Increments<P, 3>;

/// The formulas of the crate, run on polynomials. What each one means is said where it links to.
#[derive(Clone, Copy, Debug)]
pub struct Formulas {
    /// [`count::above`].
    pub above: fn(&P, &P, &P) -> [P; 3],
    /// [`Direction::descent`].
    pub descent: fn(Direction) -> [i128; 3],
    /// [`Symmetry::permute`] of [`Symmetry::ROTATION`].
    pub rotate: fn(&[P; 3]) -> [P; 3],
    /// [`count::spheres`].
    pub spheres: fn(&P, u32) -> P,
    /// [`count::spheres_in_layer`].
    pub spheres_in_layer: fn(&P, u32) -> P,
    /// [`count::contacts`].
    pub contacts: fn(&P, u32) -> P,
    /// [`count::contacts_of_strength`].
    pub contacts_of_strength: fn(&P, &P, u32) -> P,
    /// [`count::before`].
    pub before: fn(&P, &P, &P, u32) -> P,
    /// [`count::bounds_above`].
    pub bounds_above: fn(&P, &P, &Bounds, &Bounds, &P) -> [[P; 4]; 3],
    /// [`geometry::directions`].
    pub directions: fn(&P) -> Directions,
    /// [`geometry::disc_directions`].
    pub disc_directions: fn() -> Directions,
    /// [`geometry::position`].
    pub position: fn(&[P; 3], &Directions) -> Vector<P>,
    /// [`geometry::squared_distance`].
    pub squared_distance: fn(&[P; 3], &P, &P) -> P,
    /// [`Increments::isosceles`].
    pub increments: fn(&P) -> Added,
    /// [`Increments::force`].
    pub force: fn(&Added, P, usize) -> P,
    /// [`Increments::from_above`].
    pub from_above: fn(&Added, &[P; 3]) -> [P; 3],
    /// [`Increments::to_below`].
    pub to_below: fn(&Added, &[P; 3]) -> [P; 3],
    /// [`Increments::carried`].
    pub carried: fn(&Added, &[P; 3]) -> P,
    /// [`closed_form::resultant_above`].
    pub resultant_above: fn(&[P; 3], &Added, &Directions) -> Vector<P>,
    /// [`closed_form::force_on_floor`].
    pub force_on_floor: fn(&[P; 3], &Added, &Directions, &P) -> Vector<P>,
    /// [`closed_form::unbalanced`].
    pub unbalanced: fn(&[P; 3], &Added, &Directions, &P) -> Vector<P>,
    /// [`closed_form::corner_shear_ratio`].
    pub corner_shear_ratio: fn(&P, &Added, usize) -> (P, P),
    /// [`transfer::half_turn`].
    pub half_turn: fn(&[P; 3]) -> [P; 3],
    /// [`transfer::tripled_half_turn`].
    pub tripled_half_turn: fn(&[P; 3]) -> [P; 3],
}

impl Formulas {
    /// The functions that users call.
    pub const LIBRARY: Self = Self {
        above: count::above,
        descent: Direction::descent,
        rotate: |above| Symmetry::ROTATION.permute(above),
        spheres: count::spheres,
        spheres_in_layer: count::spheres_in_layer,
        contacts: count::contacts,
        contacts_of_strength: count::contacts_of_strength,
        before: count::before,
        bounds_above: count::bounds_above,
        directions: geometry::directions,
        disc_directions: geometry::disc_directions,
        position: geometry::position,
        squared_distance: geometry::squared_distance,
        increments: Increments::isosceles,
        force: Increments::force,
        from_above: Increments::from_above,
        to_below: Increments::to_below,
        carried: Increments::carried,
        resultant_above: closed_form::resultant_above,
        force_on_floor: closed_form::force_on_floor,
        unbalanced: closed_form::unbalanced,
        corner_shear_ratio: closed_form::corner_shear_ratio,
        half_turn: transfer::half_turn,
        tripled_half_turn: transfer::tripled_half_turn,
    };
}
