//! The formulas of the theorems, each replaceable by a wrong one.

use crate::formula;
use crate::geometry;
use crate::geometry::{Load, Vector};
use crate::lattice::{Direction, Sign, count};
use crate::scalar::{Algebra, Polynomial};

/// Three values: for the directions α, β, γ, or for the bounds of i, j and i+j.
type Three<P> = [P; 3];
/// The unit vectors ê_a, ê_b, ê_c.
type Directions<P> = [Vector<P>; 3];
/// A function of i, j, lower and upper bounds, the number of steps and their sign. It returns four numbers for each
/// line.
type BoundsAbove<P> = fn(&P, &P, &Three<P>, &Three<P>, &P, Sign) -> [[P; 4]; 3];
/// A function of the forces and directions below, the forces and directions above, and the weight.
type Unbalanced<P> = fn(&Three<P>, &Directions<P>, &Three<P>, &Directions<P>, &P) -> Vector<P>;

/// The formulas of the crate. On polynomials they prove theorems. They also run on any scalar `P` that is its own ring
/// of numerators. Each field links to the meaning of its formula.
///
/// Each is called by an engine or by a query of some crate. A test checks this in the source code.
// Not `non_exhaustive`, because other crates build changed values, `Formulas { weight, ..Formulas::LIBRARY }`, and the
// attribute would forbid this. With `..`, such code also compiles after a formula is added.
#[derive(Debug)]
pub struct Formulas<P = Polynomial> {
    /// [`count::above`].
    pub above: fn(&P, &P, &P) -> Three<P>,
    /// [`count::bounds_above`].
    pub bounds_above: BoundsAbove<P>,
    /// [`Sign::descent`].
    pub descent: fn(Sign, Direction) -> [i128; 2],
    /// [`count::spheres`].
    pub spheres: fn(&P, u32) -> P,
    /// [`count::spheres_in_layer`].
    pub spheres_in_layer: fn(&P, u32) -> P,
    /// [`count::contacts`].
    pub contacts: fn(&P, u32) -> P,
    /// [`count::contacts_of_strength`].
    pub contacts_of_strength: fn(&P, &P, u32) -> P,
    /// [`geometry::directions`].
    pub directions: fn(&P) -> Directions<P>,
    /// [`geometry::disc_directions`].
    pub disc_directions: fn() -> Directions<P>,
    /// [`Vector::turned_about_z`].
    pub turned_about_z: fn(Vector<P>) -> Vector<P>,
    /// [`geometry::position`].
    pub position: fn(&Three<P>, &Directions<P>) -> Vector<P>,
    /// [`geometry::squared_distance`].
    pub squared_distance: fn(&Three<P>, &P, &P) -> P,
    /// [`formula::increments`].
    pub increments: fn(&P) -> Three<P>,
    /// [`formula::load_increments`].
    pub load_increments: fn(&Load<P>, &P, Sign) -> Three<P>,
    /// [`formula::disc_load_increments`].
    pub disc_load_increments: fn(&Load<P>, Sign) -> Three<P>,
    /// [`formula::weight`].
    pub weight: fn(&[P]) -> P,
    /// [`formula::force`].
    pub force: fn(P, &P) -> P,
    /// [`formula::transmitted`].
    pub transmitted: fn(P, &P) -> P,
    /// [`formula::resultant`].
    pub resultant: fn(&Three<P>, &Directions<P>) -> Vector<P>,
    /// [`formula::support_load`].
    pub support_load: fn(&Three<P>, &Directions<P>, &P) -> Vector<P>,
    /// [`formula::unbalanced`].
    pub unbalanced: Unbalanced<P>,
    /// [`formula::half_turn`].
    pub half_turn: fn(&Three<P>) -> Three<P>,
    /// [`formula::tripled_half_turn`].
    pub tripled_half_turn: fn(&Three<P>) -> Three<P>,
    /// [`formula::tripled_apart`].
    pub tripled_apart: fn(&Three<P>) -> Three<P>,
    /// [`formula::pushed`].
    pub pushed: fn(&P, [Direction; 2], bool) -> Three<P>,
    /// [`formula::beside`].
    pub beside: fn(P, &P, &P, Sign) -> P,
}

// Not derived, because a derived implementation would require `P: Clone`.
impl<P> Clone for Formulas<P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P> Copy for Formulas<P> {}

/// A set of formulas with the functions of the crate.
pub trait Library {
    /// The functions that engines call.
    const LIBRARY: Self;
}

impl<P: Algebra<Numerator = P>> Library for Formulas<P> {
    const LIBRARY: Self = Self::LIBRARY;
}

impl<P: Algebra<Numerator = P>> Formulas<P> {
    /// The functions that engines call.
    pub const LIBRARY: Self = Self {
        above: count::above,
        bounds_above: count::bounds_above,
        descent: Sign::descent,
        spheres: count::spheres,
        spheres_in_layer: count::spheres_in_layer,
        contacts: count::contacts,
        contacts_of_strength: count::contacts_of_strength,
        directions: geometry::directions,
        disc_directions: geometry::disc_directions,
        turned_about_z: Vector::turned_about_z,
        position: geometry::position,
        squared_distance: geometry::squared_distance,
        increments: formula::increments,
        load_increments: formula::load_increments,
        disc_load_increments: formula::disc_load_increments,
        weight: formula::weight,
        force: formula::force,
        transmitted: formula::transmitted,
        resultant: formula::resultant,
        support_load: formula::support_load,
        unbalanced: formula::unbalanced,
        half_turn: formula::half_turn::<P>,
        tripled_half_turn: formula::tripled_half_turn,
        tripled_apart: formula::tripled_apart,
        pushed: formula::pushed,
        beside: formula::beside,
    };
}
