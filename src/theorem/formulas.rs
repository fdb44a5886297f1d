//! The formulas that theorems are about, each replaceable by a wrong one.

use crate::formula;
use crate::geometry::{self, Vector};
use crate::lattice::{Direction, Sign, count};
use crate::scalar::{Algebra, Polynomial};

/// By direction α, β, γ; of bounds, those of i, j and i+j.
type Three<P> = [P; 3];
/// ê_a, ê_b, ê_c.
type Directions<P> = [Vector<P>; 3];
/// From i, j, lower and upper bounds, steps and their sign: four numbers for each line.
type BoundsAbove<P> = fn(&P, &P, &Three<P>, &Three<P>, &P, Sign) -> [[P; 4]; 3];
/// From forces and directions below, those above, and the weight.
type Unbalanced<P> = fn(&Three<P>, &Directions<P>, &Three<P>, &Directions<P>, &P) -> Vector<P>;

/// The formulas of the crate, run on polynomials, which prove, or on any scalar `P` that is its own ring of numerators: what
/// each one means is said where it links to.
///
/// They are exactly the functions that engines and answers call: a test reads the sources for it.
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
    /// [`formula::weight`].
    pub weight: fn(&[P]) -> P,
    /// [`formula::force`].
    pub force: fn(P, &P) -> P,
    /// [`formula::passed_on`].
    pub passed_on: fn(P, &P) -> P,
    /// [`formula::resultant`].
    pub resultant: fn(&Three<P>, &Directions<P>) -> Vector<P>,
    /// [`formula::handed_on`].
    pub handed_on: fn(&Three<P>, &Directions<P>, &P) -> Vector<P>,
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
    /// [`formula::lowered`].
    pub lowered: fn(P, &P) -> P,
    /// [`formula::compression`].
    pub compression: fn(&Three<P>, &Three<P>, [Direction; 2], Sign) -> P,
    /// [`formula::elastic_field`].
    pub elastic_field: fn(&P, &P) -> P,
    /// [`formula::corner_field`].
    pub corner_field: fn(Direction, bool) -> Three<P>,
    /// [`formula::least_on_corner`].
    pub least_on_corner: fn(&P) -> P,
    /// [`formula::greatest_on_corner`].
    pub greatest_on_corner: fn(&P) -> P,
    /// [`formula::greatest_inside`].
    pub greatest_inside: fn(&Three<P>) -> P,
    /// [`formula::greatest_on_edge`].
    pub greatest_on_edge: fn(&P, &P, &P) -> P,
    /// [`formula::third_moment`].
    pub third_moment: fn(&P, &P) -> P,
    /// [`formula::fourth_moment`].
    pub fourth_moment: fn(&P) -> P,
    /// [`formula::fourth_moment_of_pair`].
    pub fourth_moment_of_pair: fn(&P, &P, &P) -> P,
    /// [`formula::mean_third_moment`].
    pub mean_third_moment: fn(&P, &P, &P) -> P,
    /// [`formula::mean_fourth_moment_of_pairs`].
    pub mean_fourth_moment_of_pairs: fn(&P, &P, &P) -> P,
    /// [`formula::wave`].
    pub wave: fn(&P) -> [P; 2],
    /// [`formula::registry_excess`].
    pub registry_excess: fn(&P, &P, &P) -> P,
    /// [`formula::arch`].
    pub arch: fn(&Three<P>) -> Three<P>,
}

// Derived, they would ask it of P.
impl<P> Clone for Formulas<P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P> Copy for Formulas<P> {}

impl<P: Algebra<Numerator = P>> Formulas<P> {
    /// The functions that engines and answers call.
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
        weight: formula::weight,
        force: formula::force,
        passed_on: formula::passed_on,
        resultant: formula::resultant,
        handed_on: formula::handed_on,
        unbalanced: formula::unbalanced,
        half_turn: formula::half_turn::<P>,
        tripled_half_turn: formula::tripled_half_turn,
        tripled_apart: formula::tripled_apart,
        pushed: formula::pushed,
        beside: formula::beside,
        lowered: formula::lowered,
        compression: formula::compression,
        elastic_field: formula::elastic_field,
        corner_field: formula::corner_field,
        least_on_corner: formula::least_on_corner,
        greatest_on_corner: formula::greatest_on_corner,
        greatest_inside: formula::greatest_inside,
        greatest_on_edge: formula::greatest_on_edge,
        arch: formula::arch,
        third_moment: formula::third_moment,
        fourth_moment: formula::fourth_moment,
        fourth_moment_of_pair: formula::fourth_moment_of_pair,
        mean_third_moment: formula::mean_third_moment,
        mean_fourth_moment_of_pairs: formula::mean_fourth_moment_of_pairs,
        wave: formula::wave,
        registry_excess: formula::registry_excess,
    };
}
