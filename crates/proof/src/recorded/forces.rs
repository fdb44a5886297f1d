//! Forces of a sphere: received, added and transmitted.

use cannonpile::geometry::{Load, Vector};
use cannonpile::lattice::Sign;
use cannonpile::theorem::Formulas;

use super::parts::{E, SIGNS, by_cases, of_numbers, plain, symbol};
use crate::definition::{CaseValue, Definition, Kind, Value};

pub(super) fn forces(f: &Formulas<E>) -> Vec<Definition> {
    let [s, n, increment, received, own, weight] =
        ["s", "n", "increment", "received", "own", "weight"].map(symbol);
    let (from_above, e) = (three!("from_above"), vectors!("e"));
    let whole = [
        ("from_above", Kind::Three),
        ("e", Kind::Directions),
        ("weight", Kind::Number),
    ];
    vec![
        of_numbers(
            "increments",
            "The force increments of a sphere along its three lines of contacts, (6).",
            &["s"],
            Value::Three((f.increments)(&s)),
        ),
        of_numbers(
            "force",
            "The force of n spheres on a line, (8).",
            &["n", "increment"],
            Value::Number((f.force)(n, &increment)),
        ),
        of_numbers(
            "transmitted",
            "The force along a line below a sphere: the force received and its own increment, (10).",
            &["received", "own"],
            Value::Number((f.transmitted)(received, &own)),
        ),
        plain(
            "resultant",
            "The sum of the forces from above on a sphere.",
            &whole[..2],
            Value::Vector((f.resultant)(&from_above, &e)),
        ),
        plain(
            "support_load",
            "The force of a sphere on its three supports, (11).",
            &whole,
            Value::Vector((f.support_load)(&from_above, &e, &weight)),
        ),
        plain(
            "unbalanced",
            "The sum of all forces on a sphere, (3): zero in equilibrium.",
            &[
                ("to_below", Kind::Three),
                ("below", Kind::Directions),
                ("from_above", Kind::Three),
                ("over", Kind::Directions),
                ("weight", Kind::Number),
            ],
            Value::Vector((f.unbalanced)(
                &three!("to_below"),
                &vectors!("below"),
                &from_above,
                &vectors!("over"),
                &weight,
            )),
        ),
    ]
}

/// Returns what a load of any direction adds to the lines. In Coq a load is a vector whose component down is along z.
pub(super) fn loads(f: &Formulas<E>) -> Vec<Definition> {
    let Vector { x, y, z: down } = vector!("load");
    let (load, s) = (Load { down, x, y }, symbol("s"));
    let cases = |increments: &dyn Fn(Sign) -> [E; 3]| {
        let cases = SIGNS.map(|sign| (vec![CaseValue::Sign(sign)], Value::Three(increments(sign))));
        Vec::from(cases)
    };
    let [of_load, of_sign] = [("load", Kind::Vector), ("sign", Kind::Sign)];
    vec![
        by_cases(
            "load_increments",
            "The force increments of a sphere with a load of any direction; the sign is that of the step below it.",
            &[of_load, ("s", Kind::Number), of_sign],
            cases(&|sign| (f.load_increments)(&load, &s, sign)),
        ),
        by_cases(
            "disc_load_increments",
            "The force increments of a disc with a load of any direction.",
            &[of_load, of_sign],
            cases(&|sign| (f.disc_load_increments)(&load, sign)),
        ),
    ]
}

pub(super) fn weights(f: &Formulas<E>) -> Vec<Definition> {
    const ABOUT: &str = "The sum of the increments: the weight of the sphere that adds them, (5).";
    const NAMES: [&str; 6] = ["w_1", "w_2", "w_3", "w_4", "w_5", "w_6"];
    let mut all = vec![plain(
        "weight",
        ABOUT,
        &[("increments", Kind::Three)],
        Value::Number((f.weight)(&three!("increments"))),
    )];
    for d in 2..=6 {
        let names: Vec<_> = NAMES.into_iter().take(d).collect();
        let lines: Vec<_> = names.iter().copied().map(symbol).collect();
        let value = Value::Number((f.weight)(&lines));
        all.push(of_numbers(&format!("weight_{d}"), ABOUT, &names, value));
    }
    all
}

pub(super) fn tripled_half_turn(f: &Formulas<E>) -> Definition {
    plain(
        "tripled_half_turn",
        "Three times the half-turn, without a division.",
        &[("g", Kind::Three)],
        Value::Three((f.tripled_half_turn)(&three!("g"))),
    )
}

pub(super) fn tripled_apart(f: &Formulas<E>) -> Definition {
    plain(
        "tripled_apart",
        "Three times the half-turn, each force named once.",
        &[("g", Kind::Three)],
        Value::Three((f.tripled_apart)(&three!("g"))),
    )
}

pub(super) fn turns(f: &Formulas<E>) -> Vec<Definition> {
    vec![
        plain(
            "half_turn",
            "The transfer of the received forces at a sign change: G g.",
            &[("g", Kind::Three)],
            Value::Three((f.half_turn)(&three!("g"))),
        ),
        tripled_half_turn(f),
        tripled_apart(f),
    ]
}
