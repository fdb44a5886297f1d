//! The files `spheres.csv`, `contacts.csv` and `base.csv`, and the meaning of their columns.

use std::io::Write;

use super::numbered::{NumberedContact, NumberedPile, stresses};
use super::weights::{PerSphere, nearest_rational};
use crate::error::bug;
use crate::table::{WriteError, in_dimension};
use cannonpile::FloorForce;
use cannonpile::lattice::{Dimension, Site};

/// Writes the position, size, mass and load of every sphere, and its stress.
pub(super) fn write_spheres(
    pile: &NumberedPile<'_>,
    with_stress: bool,
    out: &mut dyn Write,
    row: &mut dyn FnMut(),
) -> Result<(), WriteError> {
    write_heads(out, "spheres.csv", (pile, with_stress))?;
    let radius = nearest_rational(pile.packing().radius(), "radius")?;
    let place = Place::of(pile);
    let (masses, loads) = (PerSphere::masses(pile)?, PerSphere::loads(pile)?);
    let along = has_horizontal_loads(pile).then(|| PerSphere::horizontal_loads(pile));
    let along = along.transpose()?;
    let axes = pile.pile().dimension().directions().len() - 1;
    let floor = pile.pile().layers() - 1;
    let mut stresses = with_stress.then(|| stresses(pile.packing())).transpose()?;
    for (id, centre) in (1_u64..).zip(pile.centres()?) {
        let (site, [x, y, z]) = centre?;
        let (mass, load) = (masses.of(site), loads.of(site));
        write!(out, "{id},")?;
        place.write(site, out)?;
        let fixed = u8::from(site.k == floor);
        write!(
            out,
            ",{x:?},{y:?},{z:?},{radius:?},{mass:?},{fixed},{load:?}"
        )?;
        for along in along.iter().flatten().take(axes) {
            write!(out, ",{:?}", along.of(site))?;
        }
        if let Some(stresses) = &mut stresses {
            let stress = stresses.next();
            let stress = stress.ok_or_else(|| bug("every sphere has a stress"))??;
            for part in in_dimension(pile.pile(), stress) {
                write!(out, ",{part:?}")?;
            }
        }
        writeln!(out)?;
        row();
    }
    Ok(())
}

/// Writes the force of every contact.
pub(super) fn write_contacts(
    pile: &NumberedPile<'_>,
    out: &mut dyn Write,
    row: &mut dyn FnMut(),
) -> Result<(), WriteError> {
    write_heads(out, "contacts.csv", (pile, false))?;
    let place = Place::of(pile);
    for contact in pile.forces()? {
        let NumberedContact {
            ids: [upper, lower],
            site,
            direction,
            force,
            vector: [x, y, z],
        } = contact?;
        write!(out, "{upper},{lower},{force:?},{x:?},{y:?},{z:?},")?;
        place.write(site, out)?;
        writeln!(out, ",{}", direction.name())?;
        row();
    }
    Ok(())
}

/// Writes the force of every bottom sphere on the floor.
pub(super) fn write_base(
    pile: &NumberedPile<'_>,
    out: &mut dyn Write,
    row: &mut dyn FnMut(),
) -> Result<(), WriteError> {
    write_heads(out, "base.csv", (pile, false))?;
    let flat = pile.pile().dimension() == Dimension::Two;
    for force in pile.on_floor()? {
        let (
            id,
            FloorForce {
                site,
                normal,
                shear_x,
                shear_y,
            },
        ) = force?;
        let Site { i, j, .. } = site;
        if flat {
            writeln!(out, "{i},{normal:?},{shear_x:?},{id}")?;
        } else {
            writeln!(out, "{i},{j},{normal:?},{shear_x:?},{shear_y:?},{id}")?;
        }
        row();
    }
    Ok(())
}

/// Writes a row for each column of the other files.
pub(super) fn write_columns(
    pile: &NumberedPile<'_>,
    with_stress: bool,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    for line in columns(pile, with_stress) {
        writeln!(out, "{line}")?;
    }
    Ok(())
}

/// Returns the lines of `columns.csv` for a pile: file, column, unit, meaning. Discs have no j and no forces along y.
/// Vertical loads have no components along x and y.
fn columns(
    pile: &NumberedPile<'_>,
    with_stress: bool,
) -> impl Iterator<Item = &'static str> + use<> {
    let flat = pile.pile().dimension() == Dimension::Two;
    let vertical = !has_horizontal_loads(pile);
    let lines = include_str!("columns.csv").lines();
    lines.filter(move |line| match line.split(',').nth(1) {
        Some("j" | "shear_y") => !flat,
        Some("stress_xx" | "stress_zz" | "stress_xz") => with_stress,
        Some("stress_yy" | "stress_xy" | "stress_yz") => with_stress && !flat,
        Some("load_x") => !vertical,
        Some("load_y") => !vertical && !flat,
        _ => true,
    })
}

fn has_horizontal_loads(pile: &NumberedPile<'_>) -> bool {
    pile.pile().loads().any(|(_, load)| !load.is_vertical())
}

fn write_heads(
    out: &mut dyn Write,
    file: &str,
    (pile, with_stress): (&NumberedPile<'_>, bool),
) -> std::io::Result<()> {
    let columns = columns(pile, with_stress).map(|line| line.split(','));
    let columns =
        columns.filter_map(|mut fields| (fields.next()? == file).then(|| fields.next())?);
    writeln!(out, "{}", columns.collect::<Vec<_>>().join(","))
}

/// The format of a site: `k,i,j`, or `k,i` for a disc.
#[derive(Clone, Copy)]
struct Place(Dimension);

impl Place {
    fn of(pile: &NumberedPile<'_>) -> Self {
        Self(pile.pile().dimension())
    }

    fn write(self, Site { i, j, k }: Site, out: &mut dyn Write) -> std::io::Result<()> {
        match self.0 {
            Dimension::Two => write!(out, "{k},{i}"),
            Dimension::Three => write!(out, "{k},{i},{j}"),
        }
    }
}
