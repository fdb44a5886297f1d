//! `spheres.txt` and `pile.py` for YADE.

use std::io::Write;

use super::numbered::NumberedPile;
use super::springs::{Springs, density};
use super::template::fill;
use super::weights::{burdens, inertias, normal};
use crate::Error;
use crate::table::WriteError;
use cannonpile::lattice::Dimension;

/// Writes the spheres in the format of `ymport.text`: one line `x y z r` per sphere.
pub(super) fn write_spheres(
    pile: &NumberedPile<'_>,
    out: &mut dyn Write,
    row: &mut dyn FnMut(),
) -> Result<(), WriteError> {
    let radius = normal(pile.packing().radius(), "radius")?;
    for centre in pile.centres()? {
        let (_, [x, y, z]) = centre?;
        writeln!(out, "{x:?} {y:?} {z:?} {radius:?}")?;
        row();
    }
    Ok(())
}

/// Writes a script that relaxes the pile, and writes the forces of the final state.
pub(super) fn write_script(pile: &NumberedPile<'_>, out: &mut dyn Write) -> Result<(), WriteError> {
    let script = fill(include_str!("pile.py"), &texts(pile)?);
    Ok(out.write_all(script.as_bytes())?)
}

/// Returns the texts of a pile for the scripts.
pub(super) fn texts(pile: &NumberedPile<'_>) -> Result<Vec<(&'static str, String)>, Error> {
    let springs = Springs::of(pile)?;
    let masses = inertias(pile)?.into_iter();
    let masses = masses.map(|(site, mass)| Ok((pile.numbering().id(site)?, mass)));
    let number = |x: f64| format!("{x:?}");
    Ok(vec![
        ("first", pile.numbering().first_on_floor().to_string()),
        ("stiffness", number(springs.stiffness)),
        ("radius", number(springs.radius)),
        ("rest", number(2.0 * springs.rest())),
        ("most_steps", springs.most_steps.to_string()),
        ("loads", by_id(burdens(pile)?.into_iter().map(with_vector))),
        (
            "masses",
            by_id(
                masses
                    .collect::<Result<Vec<_>, Error>>()?
                    .into_iter()
                    .map(with_number),
            ),
        ),
        ("density", number(density(springs.mass, springs.radius)?)),
        ("blocked", blocked(pile).to_owned()),
        ("gravity", vector(springs.gravity)),
        ("timestep", number(springs.timestep)),
    ])
}

/// Returns the fixed degrees of freedom. Rotations have no effect without friction.
fn blocked(pile: &NumberedPile<'_>) -> &'static str {
    match pile.pile().dimension() {
        Dimension::Two => "yXYZ",
        Dimension::Three => "XYZ",
    }
}

/// Returns a Python dictionary.
pub(super) fn by_id(entries: impl Iterator<Item = (u64, String)>) -> String {
    let entries = entries.map(|(id, text)| format!("    {id}: {text},\n"));
    format!("{{\n{}}}", entries.collect::<String>())
}

fn with_number((id, number): (u64, f64)) -> (u64, String) {
    (id, format!("{number:?}"))
}

pub(super) fn with_vector((id, force): (u64, [f64; 3])) -> (u64, String) {
    (id, vector(force))
}

/// Returns a Python tuple.
fn vector([x, y, z]: [f64; 3]) -> String {
    format!("({x:?}, {y:?}, {z:?})")
}
