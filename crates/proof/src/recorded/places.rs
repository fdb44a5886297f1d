//! Counts and positions: numbers of spheres and contacts, sites, and vectors.

use cannonpile::geometry::Vector;
use cannonpile::lattice::Direction;
use cannonpile::theorem::Formulas;

use super::parts::{E, SIGNS, by_cases, of_numbers, plain, symbol};
use crate::definition::{CaseValue, Definition, Kind, Value};

pub(super) fn above(f: &Formulas<E>) -> Definition {
    let [i, j, k] = ["i", "j", "k"].map(symbol);
    of_numbers(
        "above",
        "The numbers of spheres above the sphere (i, j, k) on its three lines of contacts.",
        &["i", "j", "k"],
        Value::Three((f.above)(&i, &j, &k)),
    )
}

pub(super) fn bounds_above(f: &Formulas<E>) -> Definition {
    let [i, j, steps] = ["i", "j", "steps"].map(symbol);
    let (lower, upper) = (three!("lower"), three!("upper"));
    let bounds = |sign| (f.bounds_above)(&i, &j, &lower, &upper, &steps, sign);
    by_cases(
        "bounds_above",
        "Four upper bounds for each number of spheres above a sphere on a line of contacts. The number is the least.",
        &[
            ("i", Kind::Number),
            ("j", Kind::Number),
            ("lower", Kind::Three),
            ("upper", Kind::Three),
            ("steps", Kind::Number),
            ("sign", Kind::Sign),
        ],
        SIGNS
            .map(|sign| {
                (
                    vec![CaseValue::Sign(sign)],
                    Value::Fours(bounds(sign).into()),
                )
            })
            .into(),
    )
}

pub(super) fn descent(f: &Formulas<E>) -> Definition {
    let cases = SIGNS.into_iter().flat_map(|sign| {
        Direction::ALL.map(|direction| {
            let step = (f.descent)(sign, direction);
            (
                vec![CaseValue::Sign(sign), CaseValue::Direction(direction)],
                Value::Site(step),
            )
        })
    });
    by_cases(
        "descent",
        "The step (i, j) from a sphere to its support in a direction.",
        &[("sign", Kind::Sign), ("direction", Kind::Direction)],
        cases.collect(),
    )
}

pub(super) fn counts(f: &Formulas<E>) -> Vec<Definition> {
    let [layers, k, n] = ["layers", "k", "n"].map(symbol);
    let mut all = Vec::new();
    for d in 2..=6 {
        all.extend([
            of_numbers(
                &format!("spheres_{d}"),
                "The number of spheres of a straight pile, by dimension.",
                &["layers"],
                Value::Number((f.spheres)(&layers, d)),
            ),
            of_numbers(
                &format!("spheres_in_layer_{d}"),
                "The number of spheres in layer k, by dimension.",
                &["k"],
                Value::Number((f.spheres_in_layer)(&k, d)),
            ),
            of_numbers(
                &format!("contacts_{d}"),
                "The number of contacts of a straight pile, by dimension.",
                &["layers"],
                Value::Number((f.contacts)(&layers, d)),
            ),
            of_numbers(
                &format!("contacts_of_strength_{d}"),
                "The number of contacts in one direction that carry a force of n increments.",
                &["layers", "n"],
                Value::Number((f.contacts_of_strength)(&layers, &n, d)),
            ),
        ]);
    }
    all
}

pub(super) fn places(f: &Formulas<E>) -> Vec<Definition> {
    let [s, sin2] = ["s", "sin2"].map(symbol);
    vec![
        of_numbers(
            "directions",
            "The unit vectors along the contacts, in the basis (sin θ, 2 cos φ sin θ, cos θ), for s = sin φ.",
            &["s"],
            Value::Directions((f.directions)(&s).into()),
        ),
        of_numbers(
            "disc_directions",
            "The unit vectors along the contacts of discs.",
            &[],
            Value::Directions((f.disc_directions)().into()),
        ),
        plain(
            "turned_about_z",
            "A vector after a half-turn about the vertical axis.",
            &[("v", Kind::Vector)],
            Value::Vector((f.turned_about_z)(vector!("v"))),
        ),
        plain(
            "position",
            "The position of a sphere relative to the apex, in units of 2R.",
            &[("n", Kind::Three), ("e", Kind::Directions)],
            Value::Vector((f.position)(&three!("n"), &vectors!("e"))),
        ),
        plain(
            "squared_distance",
            "The squared distance of two centres over 4R², if one minus the other is 2R (n_a e_a + n_b e_b + n_c e_c).",
            &[
                ("n", Kind::Three),
                ("s", Kind::Number),
                ("sin2", Kind::Number),
            ],
            Value::Number((f.squared_distance)(&three!("n"), &s, &sin2)),
        ),
    ]
}
