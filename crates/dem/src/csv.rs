//! `spheres.csv`, `contacts.csv`, `base.csv`, and what is in their columns.

use std::io::Write;

use super::numbered::{NumberedContact, NumberedPile};
use super::weights::{PerSphere, nearest_rational};
use crate::table::WriteError;
use cannonpile::FloorForce;
use cannonpile::lattice::{Dimension, Site};

/// Writes where every sphere is, and what it weighs and bears.
pub(super) fn write_spheres(
    pile: &NumberedPile<'_>,
    out: &mut dyn Write,
    row: &mut dyn FnMut(),
) -> Result<(), WriteError> {
    write_heads(out, SPHERES, pile)?;
    let radius = nearest_rational(pile.packing().radius(), "radius")?;
    let place = Place::of(pile);
    let (masses, loads) = (PerSphere::masses(pile)?, PerSphere::loads(pile)?);
    let floor = pile.pile().layers() - 1;
    for (id, centre) in (1_u64..).zip(pile.centres()?) {
        let (site, [x, y, z]) = centre?;
        let (mass, load) = (masses.of(site), loads.of(site));
        write!(out, "{id},")?;
        place.write(site, out)?;
        let fixed = u8::from(site.k == floor);
        writeln!(
            out,
            ",{x:?},{y:?},{z:?},{radius:?},{mass:?},{fixed},{load:?}"
        )?;
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
    write_heads(out, CONTACTS, pile)?;
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
    write_heads(out, BASE, pile)?;
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
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record(["file", "column", "unit", "meaning"])?;
    for (file, columns) in [
        ("spheres.csv", SPHERES),
        ("contacts.csv", CONTACTS),
        ("base.csv", BASE),
    ] {
        for (column, unit, meaning) in columns_of(columns, pile) {
            csv.write_record([file, column, unit, meaning])?;
        }
    }
    Ok(csv.flush()?)
}

/// A column, its unit, and what is in it.
type Described = (&'static str, &'static str, &'static str);

const SPHERES: &[Described] = &[
    (
        "id",
        "",
        "number of the sphere, from 1 in row order from the top",
    ),
    ("k", "", "layer, from 0 at the top"),
    ("i", "", "place in the layer"),
    ("j", "", "row in the layer"),
    (
        "x",
        "m",
        "centre; 0 at i = j = 0 of the top layer, of the base for a pile given by its base",
    ),
    ("y", "m", "centre, as x"),
    ("z", "m", "centre, upwards; 0 in the bottom layer"),
    ("radius", "m", "radius"),
    ("mass", "kg", "mass, without the load"),
    (
        "fixed",
        "",
        "1 for a sphere of the bottom layer, 0 for any other",
    ),
    (
        "load",
        "N",
        "force downwards on the sphere besides its weight",
    ),
];

const CONTACTS: &[Described] = &[
    (
        "id1",
        "",
        "number of the upper sphere; of two neighbours that of the one that names their contact",
    ),
    (
        "id2",
        "",
        "number of the lower sphere, or of the other neighbour",
    ),
    ("force", "N", "contact force; positive is push"),
    ("fx", "N", "force on sphere id1 along x"),
    ("fy", "N", "force on sphere id1 along y"),
    ("fz", "N", "force on sphere id1 upwards"),
    (
        "k",
        "",
        "layer of the upper sphere, from 0 at the top; of two neighbours, of the one that names their contact",
    ),
    ("i", "", "place of that sphere in its layer"),
    ("j", "", "row of that sphere in its layer"),
    (
        "direction",
        "",
        "where the other sphere lies: alpha, beta or gamma below; alpha-beta, alpha-gamma or gamma-beta in the same layer",
    ),
];

const BASE: &[Described] = &[
    ("i", "", "place of the bottom sphere in its layer"),
    ("j", "", "row of the bottom sphere in its layer"),
    ("normal", "N", "force of the sphere on the floor, downwards"),
    ("shear_x", "N", "force of the sphere on the floor along x"),
    ("shear_y", "N", "force of the sphere on the floor along y"),
    ("id", "", "number of the sphere"),
];

/// The columns that a pile has: discs have no row, and no shear out of their plane.
fn columns_of<'c>(
    columns: &'c [Described],
    pile: &NumberedPile<'_>,
) -> impl Iterator<Item = Described> + use<'c> {
    let flat = pile.pile().dimension() == Dimension::Two;
    let left_out = move |name: &str| flat && matches!(name, "j" | "shear_y");
    columns
        .iter()
        .copied()
        .filter(move |(name, ..)| !left_out(name))
}

fn write_heads(
    out: &mut dyn Write,
    columns: &[Described],
    pile: &NumberedPile<'_>,
) -> std::io::Result<()> {
    let names: Vec<&str> = columns_of(columns, pile).map(|(name, ..)| name).collect();
    writeln!(out, "{}", names.join(","))
}

/// How the place of a sphere is written: `k,i,j`, of a disc `k,i`.
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
