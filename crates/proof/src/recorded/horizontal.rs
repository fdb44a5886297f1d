//! Horizontal contacts.

use cannonpile::lattice::Direction;

use super::parts::{E, SIGNS, by_cases, of_numbers, plain, symbol};
use crate::Formulas;
use crate::definition::{CaseValue, Definition, Kind, Value};

/// Returns the formulas of a sphere with horizontal contacts: its balance, drops and compressions.
pub(super) fn horizontal(f: &Formulas<E>) -> Vec<Definition> {
    let [x, received, own, pushed, below, phi] =
        ["x", "received", "own", "pushed", "below", "phi"].map(symbol);
    let ends = [("a", Kind::Direction), ("b", Kind::Direction)];
    let pushes = pairs().flat_map(|[a, b]| {
        [true, false].map(|away| {
            let case = vec![
                CaseValue::Direction(a),
                CaseValue::Direction(b),
                CaseValue::Truth(away),
            ];
            (case, Value::Three((f.core.pushed)(&x, [a, b], away)))
        })
    });
    let compressions = pairs().flat_map(|[a, b]| {
        SIGNS.map(|sign| {
            let case = vec![
                CaseValue::Direction(a),
                CaseValue::Direction(b),
                CaseValue::Sign(sign),
            ];
            let value = (f.compression)(&three!("phi"), &three!("there"), [a, b], sign);
            (case, Value::Number(value))
        })
    });
    let beside = SIGNS.map(|sign| {
        let value = (f.core.beside)(received.clone(), &own, &pushed, sign);
        (vec![CaseValue::Sign(sign)], Value::Number(value))
    });
    vec![
        by_cases(
            "pushed",
            "The contribution to H of a horizontal contact of force x from p to p + d_b - d_a; `away` is true for p.",
            &[("x", Kind::Number), ends[0], ends[1], ("away", Kind::Truth)],
            pushes.collect(),
        ),
        by_cases(
            "beside",
            "The force along a line below a sphere with horizontal contacts.",
            &[
                ("received", Kind::Number),
                ("own", Kind::Number),
                ("pushed", Kind::Number),
                ("sign", Kind::Sign),
            ],
            beside.into(),
        ),
        of_numbers(
            "contact_drop",
            "The drop D of the contact of a sphere with its support.",
            &["phi", "below"],
            Value::Number((f.contact_drop)(phi, &below)),
        ),
        by_cases(
            "compression",
            "The compression c of the horizontal contact of p and p + d_b - d_a.",
            &[
                ("phi", Kind::Three),
                ("there", Kind::Three),
                ends[0],
                ends[1],
                ("sign", Kind::Sign),
            ],
            compressions.collect(),
        ),
    ]
}

/// Closed forms of straight piles with horizontal contacts.
pub(super) fn with_horizontal_contacts(f: &Formulas<E>) -> Vec<Definition> {
    let [n, d, k, j, c] = ["n", "d", "k", "j", "c"].map(symbol);
    let corners = Direction::ALL.into_iter().flat_map(|edge| {
        [true, false].map(|all| {
            let case = vec![CaseValue::Direction(edge), CaseValue::Truth(all)];
            (case, Value::Three((f.corner_field)(edge, all)))
        })
    });
    vec![
        of_numbers(
            "elastic_field",
            "The field of the elastic state of a straight pile, d layers above the floor.",
            &["n", "d"],
            Value::Number((f.elastic_field)(&n, &d)),
        ),
        by_cases(
            "corner_field",
            "The field on an edge that proves a bound for the corner below it.",
            &[("edge", Kind::Direction), ("all", Kind::Truth)],
            corners.collect(),
        ),
        of_numbers(
            "least_on_corner",
            "The smallest load on a corner below k layers.",
            &["k"],
            Value::Number((f.least_on_corner)(&k)),
        ),
        of_numbers(
            "greatest_on_corner",
            "The largest load on a corner below k layers.",
            &["k"],
            Value::Number((f.greatest_on_corner)(&k)),
        ),
        plain(
            "greatest_inside",
            "An upper bound of the load on a bottom sphere.",
            &[("n", Kind::Three)],
            Value::Number((f.greatest_inside)(&three!("n"))),
        ),
        of_numbers(
            "greatest_on_edge",
            "An upper bound of the load on a bottom sphere on an edge.",
            &["k", "j", "c"],
            Value::Number((f.greatest_on_edge)(&k, &j, &c)),
        ),
        plain(
            "arch",
            "The horizontal forces between three spheres that unload the sphere below them.",
            &[("nu", Kind::Three)],
            Value::Three((f.arch)(&three!("nu"))),
        ),
    ]
}

/// All pairs of directions.
fn pairs() -> impl Iterator<Item = [Direction; 2]> {
    let all = Direction::ALL.into_iter();
    all.flat_map(|a| Direction::ALL.map(|b| [a, b]))
}
