//! `pile.data` and `pile.in` for LAMMPS.

use std::io::Write;

use super::numbered::NumberedPile;
use super::springs::{Springs, density};
use super::template::fill;
use super::weights::{burdens, inertias};
use crate::Error;
use crate::table::WriteError;
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
        let density = match inertias.get(&site) {
            None => ordinary,
            Some(mass) => density(*mass, springs.radius)?,
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
    let weight = match springs.gravity {
        0.0 => String::new(),
        g => format!("fix             weight all gravity {g:?} vector 0 0 -1\n"),
    };
    let plane = match pile.pile().dimension() {
        Dimension::Two => {
            "# Discs stay in their plane.\nfix             plane all setforce NULL 0.0 NULL\n"
        }
        Dimension::Three => "",
    };
    let number = |x: f64| format!("{x:?}");
    let script = fill(
        include_str!("pile.in"),
        &[
            ("stiffness", number(springs.stiffness)),
            // LAMMPS multiplies this number by the mass of the pair, m/2.
            ("damping", number(springs.dashpot() / (springs.mass / 2.0))),
            ("skin", number(0.2 * springs.radius)),
            ("weight", weight),
            ("loads", loads(pile, LOADS)?),
            ("drag", number(springs.drag())),
            ("plane", plane.to_owned()),
            ("timestep", number(springs.timestep)),
            ("last_digit", number(springs.last_digit)),
            ("rest", number(springs.rest())),
            ("most_steps", springs.most_steps.to_string()),
        ],
    );
    Ok(out.write_all(script.as_bytes())?)
}

/// Returns the commands that apply loads to spheres, or an empty text without loads. Each set command begins with
/// `set`. The other texts precede and follow the set commands.
pub(super) fn loads(
    pile: &NumberedPile<'_>,
    [before, set, after]: [&str; 3],
) -> Result<String, Error> {
    let burdens = burdens(pile)?;
    if burdens.is_empty() {
        return Ok(String::new());
    }
    let sets = burdens.into_iter().map(|(id, force)| {
        let upwards = -force;
        format!("{set} atom {id} d_load {upwards:?}\n")
    });
    Ok(format!("{before}{}{after}", sets.collect::<String>()))
}

const LOADS: [&str; 3] = [
    "# Loads, in N.\nfix             load all property/atom d_load\n",
    "set            ",
    "variable        load atom d_load\nfix             push all addforce 0.0 0.0 v_load\n",
];
