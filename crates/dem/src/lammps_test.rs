//! `dem-pile.yaml`: a test in the style of `unittest/granular` of LAMMPS.

use std::io::Write;

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::lammps::{gravity, loads};
use super::numbered::NumberedPile;
use super::springs::{Springs, density};
use super::suite::{Forces, Outcome, TOLERANCE};
use super::sunk::Sunk;
use super::template::fill;
use super::vector::{minus, plus};
use super::weights::{inertias, rounded_newtons};
use crate::table::WriteError;
use crate::{Each, Error};
use cannonpile::Load;
use cannonpile::lattice::Dimension;

/// The accepted relative error of positions if every contact has a force, and if some contacts have none. A sphere
/// settles slowly against contacts without a force.
const BEARING: f64 = 1e-11;
const IDLE: f64 = 1e-9;

/// Writes the test.
pub(super) fn write(
    pile: &NumberedPile<'_>,
    title: &str,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let forces = Forces::of(pile)?;
    if forces.outcome != Outcome::Rests {
        return Err(Error::MustPull {
            remedy: "use --to lammps, or --to yade-check",
        }
        .into());
    }
    Ok(out.write_all(text(pile, title, &forces)?.as_bytes())?)
}

fn text(pile: &NumberedPile<'_>, title: &str, forces: &Forces) -> Result<String, Error> {
    let springs = Springs::of(pile)?;
    let Sunk { rigid, at_rest } = Sunk::of(pile, &springs)?;
    let number = |x: f64| format!("{x:?}");
    let flat = pile.pile().dimension() == Dimension::Two;
    let overlap = forces.greatest / springs.stiffness;
    let has_horizontal = pile.pile().horizontal_forces().len() > 0;
    let epsilon = match (has_horizontal, forces.has_idle) {
        // A sphere may have lost contact with one of its supports.
        (true, _) => 10.0_f64.powf((overlap / springs.radius).log10().ceil() + 1.0),
        (false, true) => IDLE,
        (false, false) => BEARING,
    };
    let compared = if has_horizontal {
        "the shape only".to_owned()
    } else {
        let resolution = epsilon * middle(&at_rest) / overlap;
        format!("forces, to about {resolution:.0e} of the greatest")
    };
    let weight = match gravity(springs.gravity) {
        None => String::new(),
        Some(gravity) => format!("  fix weight all {gravity}\n"),
    };
    let plane = if flat {
        "  fix plane all setforce NULL 0.0 NULL\n"
    } else {
        ""
    };
    let steps = 5000 + 500 * pile.pile().layers();
    Ok(fill(
        include_str!("pile.yaml"),
        &[
            ("version", env!("CARGO_PKG_VERSION").to_owned()),
            ("dimension", if flat { "2" } else { "3" }.to_owned()),
            ("overlap", format!("{overlap:.1e}")),
            ("compared", compared),
            ("accept", number(TOLERANCE)),
            ("epsilon", number(epsilon)),
            ("box", boundaries(&rigid, springs.radius)),
            ("atoms", atoms(pile, &rigid)),
            ("densities", densities(pile, &springs)?),
            ("skin", number(0.2 * springs.radius)),
            ("timestep", number(springs.timestep)),
            ("weight", weight),
            ("loads", loads(pile, "", ["  fix", "  set", "  variable"])?),
            ("drag", number(springs.drag())),
            ("plane", plane.to_owned()),
            ("natoms", rigid.len().to_string()),
            ("diameter", number(2.0 * springs.radius)),
            ("density", number(density(springs.mass, springs.radius)?)),
            ("stiffness", number(springs.stiffness)),
            ("damping", number(springs.dashpot() / (springs.mass / 2.0))),
            ("forces", reactions(pile)?),
            ("steps", steps.to_string()),
            ("positions", positions(&at_rest)),
            // The title comes last, so that names in braces within it are not replaced.
            ("title", title.to_owned()),
        ],
    ))
}

/// Returns the mean of all coordinates.
fn middle(centres: &[[f64; 3]]) -> f64 {
    let all = centres.as_flattened();
    #[expect(
        clippy::cast_precision_loss,
        reason = "a few thousand numbers are exact as a float"
    )]
    let count = all.len() as f64;
    all.iter().sum::<f64>() / count
}

/// Returns `xlo xhi ylo yhi zlo zhi`, with room for motion.
fn boundaries(centres: &[[f64; 3]], radius: f64) -> String {
    let sides = [0, 1, 2].each(|axis| {
        let greatest = centres.iter().map(|centre| centre[axis]);
        let greatest = greatest.fold(radius, f64::max);
        format!("0.0 {:?}", greatest + 4.0 * radius)
    });
    sides.join(" ")
}

fn atoms(pile: &NumberedPile<'_>, centres: &[[f64; 3]]) -> String {
    let first_on_floor = pile.numbering().first_on_floor();
    let atoms = (1_u64..).zip(centres).map(|(id, [x, y, z])| {
        let kind = if id < first_on_floor { 1 } else { 2 };
        format!("  create_atoms {kind} single {x:?} {y:?} {z:?} units box\n")
    });
    atoms.collect()
}

/// Returns commands that set the density of spheres with a weight of their own.
fn densities(pile: &NumberedPile<'_>, springs: &Springs) -> Result<String, Error> {
    let masses = inertias(pile)?.into_iter().map(|(site, mass)| {
        let (id, density) = (pile.numbering().id(site)?, density(mass, springs.radius)?);
        Ok(format!("  set atom {id} density {density:?}\n"))
    });
    masses.collect()
}

/// Returns the force on each sphere at rest, without the force from the floor: zero above the floor.
fn reactions(pile: &NumberedPile<'_>) -> Result<String, Error> {
    let off_the_floor = 1..pile.numbering().first_on_floor();
    let off_the_floor = off_the_floor.map(|id| Ok(format!("  {id} 0.0 0.0 0.0\n")));
    let on_the_floor = pile.on_floor()?.map(|force| {
        let (id, force) = force?;
        let load = pile.pile().load(force.site)?;
        let load = rounded_newtons(pile.packing(), load, "a load")?;
        // LAMMPS assigns a mass, and so a weight, to weightless spheres too.
        let weight = pile.pile().sphere_weight(force.site)?;
        let pulled = if weight.is_zero() && !pile.pile().is_weightless() {
            let weight = Load::leaning(BigRational::one(), pile.pile().tilt());
            rounded_newtons(pile.packing(), weight, "weight")?
        } else {
            [0.0; 3]
        };
        let on_floor = [force.shear_x, force.shear_y, -force.normal];
        // Adding 0 turns −0 into 0.
        let [x, y, z] = plus(minus(on_floor, load), pulled).each(|part| part + 0.0);
        Ok(format!("  {id} {x:?} {y:?} {z:?}\n"))
    });
    off_the_floor.chain(on_the_floor).collect()
}

fn positions(centres: &[[f64; 3]]) -> String {
    let lines = (1_u64..)
        .zip(centres)
        .map(|(id, [x, y, z])| format!("  0 {id} {x:?} {y:?} {z:?}\n"));
    lines.collect()
}
