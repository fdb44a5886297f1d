//! `pile.data` and `pile.in` for LAMMPS.

use std::io::Write;

use super::numbered::NumberedPile;
use super::springs::{Springs, density};
use super::template::fill;
use super::weights::{burdens, find, inertias};
use crate::table::WriteError;
use crate::{Each, Error};
use cannonpile::engine::refuse_beyond;
use cannonpile::lattice::Dimension;

/// The maximal number of atoms in a standard build of LAMMPS.
const MAX_ATOMS: u64 = i32::MAX as u64;

/// Writes the spheres in a box with room to fall. Bottom spheres have type 2.
pub(super) fn write_data(
    pile: &NumberedPile<'_>,
    out: &mut dyn Write,
    row: &mut dyn FnMut(),
) -> Result<(), WriteError> {
    let spheres = pile.numbering().sphere_count();
    refuse_beyond(
        "the atoms of LAMMPS",
        spheres,
        MAX_ATOMS,
        "use fewer layers, or a smaller top or base",
    )?;
    let springs = Springs::of(pile)?;
    let layers = pile.pile().layers();
    writeln!(
        out,
        "cannonpile: {spheres} spheres in {layers} layers, exact positions\n"
    )?;
    writeln!(out, "{spheres} atoms\n2 atom types\n")?;
    let margin = 4.0 * springs.radius;
    for (name, [least, greatest]) in ["x", "y", "z"].iter().zip(springs.bounds) {
        let (low, high) = (least - margin, greatest + margin);
        writeln!(out, "{low:?} {high:?} {name}lo {name}hi")?;
    }
    writeln!(out, "\nAtoms # sphere\n")?;
    let diameter = 2.0 * springs.radius;
    let ordinary = density(springs.mass, springs.radius)?;
    let inertias = inertias(pile)?;
    for (id, centre) in (1_u64..).zip(pile.centres()?) {
        let (site, [x, y, z]) = centre?;
        let kind = if site.k + 1 == layers { 2 } else { 1 };
        let density = match find(&inertias, site) {
            None => ordinary,
            Some(mass) => density(mass, springs.radius)?,
        };
        writeln!(
            out,
            "{id} {kind} {diameter:?} {density:?} {x:?} {y:?} {z:?}"
        )?;
        row();
    }
    Ok(())
}

/// Writes a script that relaxes the pile, and writes the forces of the final state.
pub(super) fn write_input(pile: &NumberedPile<'_>, out: &mut dyn Write) -> Result<(), WriteError> {
    let springs = Springs::of(pile)?;
    let weight = match gravity(springs.gravity) {
        None => String::new(),
        Some(gravity) => format!("fix             weight all {gravity}\n"),
    };
    let mut texts = texts_of(pile, &springs);
    texts.extend([
        ("weight", weight),
        ("loads", loads(pile, "# Loads, in N.\n", WORDS)?),
    ]);
    Ok(out.write_all(fill(include_str!("pile.in"), &texts).as_bytes())?)
}

/// Returns the texts of the script for a rough floor, but for friction and loads.
pub(super) fn script_texts(pile: &NumberedPile<'_>) -> Result<Vec<(&'static str, String)>, Error> {
    let springs = Springs::of(pile)?;
    let weight = match springs.gravity {
        [_, _, 0.0] => String::new(),
        [_, _, z] => format!(
            "variable        weight equal {:?}*v_part\nfix             weight all gravity v_weight vector 0 0 -1\n",
            -z
        ),
    };
    let mut texts = texts_of(pile, &springs);
    texts.extend([
        ("weight", weight),
        // The mass of the pair of a sphere and the floor is m.
        (
            "wall_damping",
            format!("{:?}", springs.dashpot() / springs.mass),
        ),
    ]);
    Ok(texts)
}

fn texts_of(pile: &NumberedPile<'_>, springs: &Springs) -> Vec<(&'static str, String)> {
    let plane = match pile.pile().dimension() {
        Dimension::Two => {
            "# Discs stay in their plane.\nfix             plane all setforce NULL 0.0 NULL\n"
        }
        Dimension::Three => "",
    };
    let number = |x: f64| format!("{x:?}");
    vec![
        ("stiffness", number(springs.stiffness)),
        // LAMMPS multiplies this number by the mass of the pair, m/2.
        ("damping", number(springs.dashpot() / (springs.mass / 2.0))),
        ("skin", number(0.2 * springs.radius)),
        ("drag", number(springs.drag())),
        ("plane", plane.to_owned()),
        ("timestep", number(springs.timestep)),
        ("last_digit", number(springs.last_digit)),
        ("rest", number(springs.rest())),
        ("most_steps", springs.most_steps.to_string()),
    ]
}

/// Returns the style and the arguments of the fix for this gravity, or `None` for weightless spheres.
pub(super) fn gravity([x, y, z]: [f64; 3]) -> Option<String> {
    if z == 0.0 {
        return None;
    }
    Some(if x == 0.0 && y == 0.0 {
        format!("gravity {:?} vector 0 0 -1", -z)
    } else {
        let magnitude = x.hypot(y).hypot(z);
        format!("gravity {magnitude:?} vector {x:?} {y:?} {z:?}")
    })
}

/// Returns the commands that apply loads to spheres, or an empty text without loads. Each command begins with the word
/// of its kind: `fix`, `set` or `variable`. `note` precedes the commands.
pub(super) fn loads(
    pile: &NumberedPile<'_>,
    note: &str,
    [fix, set, variable]: [&str; 3],
) -> Result<String, Error> {
    let burdens = burdens(pile)?;
    if burdens.is_empty() {
        return Ok(String::new());
    }
    let is_used = |axis: usize| burdens.iter().any(|(_, force)| force[axis] != 0.0);
    let names = match [0, 1].each(is_used) {
        [false, false] => [None, None, Some("load")],
        [along_x, along_y] => [
            along_x.then_some("load_x"),
            along_y.then_some("load_y"),
            is_used(2).then_some("load_z"),
        ],
    };
    let each = |words: &dyn Fn(&str) -> String| {
        let words = names.iter().flatten().map(|name| words(name));
        words.collect::<String>()
    };
    let properties = each(&|name| format!(" d_{name}"));
    let sets = burdens.iter().map(|(id, force)| {
        let parts = names.iter().zip(force);
        let parts = parts.filter_map(|(name, part)| Some(format!(" d_{} {part:?}", (*name)?)));
        format!("{set} atom {id}{}\n", parts.collect::<String>())
    });
    let sets: String = sets.collect();
    let variables = each(&|name| format!("{variable} {name} atom d_{name}\n"));
    let forces = names.each(|name| name.map_or_else(|| "0.0".into(), |name| format!("v_{name}")));
    let forces = forces.join(" ");
    Ok(format!(
        "{note}{fix} load all property/atom{properties}\n{sets}{variables}{fix} push all addforce {forces}\n"
    ))
}

/// The words of commands, in columns.
const WORDS: [&str; 3] = ["fix            ", "set            ", "variable       "];
