//! `spheres.vtp` and `contacts.vtp` for ParaView.

use std::io::Write;

use super::numbered::{NumberedPile, stresses};
use super::polydata::{Array, Kind, PolyData, Section};
use super::weights::{PerSphere, nearest_rational};
use crate::table::WriteError;
use cannonpile::lattice::{Axis, ContactKind, Direction};

/// Writes one point and one vertex for each sphere.
pub(super) fn write_spheres(
    pile: &NumberedPile<'_>,
    with_stress: bool,
    out: &mut dyn Write,
    row: &mut dyn FnMut(),
) -> Result<(), WriteError> {
    let n = pile.numbering().sphere_count();
    let stress = with_stress.then(|| Array::new("stress", Kind::Float64, 9, n));
    let sections = [
        Section {
            tag: "PointData",
            arrays: [
                Array::new("id", Kind::Int64, 1, n),
                Array::new("layer", Kind::Int64, 1, n),
                Array::new("radius", Kind::Float64, 1, n),
                Array::new("weight", Kind::Float64, 1, n),
                Array::new("load", Kind::Float64, 1, n),
                Array::new("reaction", Kind::Float64, 3, n),
            ]
            .into_iter()
            .chain(stress)
            .collect(),
        },
        Section {
            tag: "Points",
            arrays: vec![Array::new("centres", Kind::Float64, 3, n)],
        },
        Section {
            tag: "Verts",
            arrays: cells(n, n),
        },
    ];
    let mut data = PolyData::begin(out, n, [n, 0], &sections)?;

    data.array()?;
    (1..=n).try_for_each(|id| data.integer(id))?;
    data.array()?;
    for site in pile.sites()? {
        // There are at most as many layers as spheres, and sphere numbers fit in a `u64`.
        let layer = u64::try_from(site.k).map_err(std::io::Error::other)?;
        data.integer(layer)?;
    }
    data.array()?;
    let radius = nearest_rational(pile.packing().radius(), "radius")?;
    (0..n).try_for_each(|_| data.float(radius))?;
    for forces in [PerSphere::weights(pile)?, PerSphere::loads(pile)?] {
        data.array()?;
        for site in pile.sites()? {
            data.float(forces.of(site))?;
        }
    }
    data.array()?;
    write_reactions(pile, &mut data)?;
    if with_stress {
        data.array()?;
        for stress in stresses(pile.packing())? {
            let [xx, yy, zz, xy, xz, yz] = stress?;
            for row in [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] {
                data.vector(row)?;
            }
        }
    }
    data.array()?;
    for centre in pile.centres()? {
        let (_, centre) = centre?;
        data.vector(centre)?;
        row();
    }
    data.array()?;
    data.count_up(n)?;
    data.array()?;
    data.multiples(1, n)?;
    Ok(data.end()?)
}

/// Writes the force from the floor on each sphere: zero for spheres above the floor.
fn write_reactions(pile: &NumberedPile<'_>, data: &mut PolyData<'_>) -> Result<(), WriteError> {
    for _ in 1..pile.numbering().first_on_floor() {
        data.vector([0.0; 3])?;
    }
    for force in pile.on_floor()? {
        let (_, force) = force?;
        // The subtraction yields 0, never −0.
        data.vector([0.0 - force.shear_x, 0.0 - force.shear_y, force.normal])?;
    }
    Ok(())
}

/// Writes one line for each contact, with two points of its own. Both points store the force, because the width of
/// tubes is a value of points.
pub(super) fn write_contacts(
    pile: &NumberedPile<'_>,
    out: &mut dyn Write,
    row: &mut dyn FnMut(),
) -> Result<(), WriteError> {
    // The number of contacts does not exceed the maximal number of rows.
    let n = u64::try_from(pile.contact_count()).map_err(std::io::Error::other)?;
    let sections = [
        Section {
            tag: "PointData",
            arrays: vec![Array::new("force", Kind::Float64, 1, 2 * n)],
        },
        Section {
            tag: "CellData",
            arrays: vec![
                Array::new("force", Kind::Float64, 1, n),
                Array::new("force_vector", Kind::Float64, 3, n),
                Array::new("direction", Kind::UInt8, 1, n),
                Array::new("id1", Kind::Int64, 1, n),
                Array::new("id2", Kind::Int64, 1, n),
            ],
        },
        Section {
            tag: "Points",
            arrays: vec![Array::new("centres", Kind::Float64, 3, 2 * n)],
        },
        Section {
            tag: "Lines",
            arrays: cells(2 * n, n),
        },
    ];
    let mut data = PolyData::begin(out, 2 * n, [0, n], &sections)?;

    data.array()?;
    each_force(pile, |[force, ..]| {
        data.float(force)?;
        data.float(force)
    })?;
    data.array()?;
    each_force(pile, |[force, ..]| data.float(force))?;
    data.array()?;
    each_force(pile, |[_, x, y, z]| data.vector([x, y, z]))?;
    data.array()?;
    for touch in pile.touches()? {
        let (link, _) = touch?;
        data.byte(match link {
            ContactKind::Sloping(Direction::Alpha) => 0,
            ContactKind::Sloping(Direction::Beta) => 1,
            ContactKind::Sloping(Direction::Gamma) => 2,
            ContactKind::Horizontal(Axis::AlphaBeta) => 3,
            ContactKind::Horizontal(Axis::AlphaGamma) => 4,
            ContactKind::Horizontal(Axis::GammaBeta) => 5,
        })?;
    }
    for end in [0, 1] {
        data.array()?;
        for touch in pile.touches()? {
            let (_, ids) = touch?;
            data.integer(ids[end])?;
        }
    }
    data.array()?;
    for link in pile.links()? {
        let [upper, lower] = link?;
        data.vector(upper)?;
        data.vector(lower)?;
        row();
    }
    data.array()?;
    data.count_up(2 * n)?;
    data.array()?;
    data.multiples(2, n)?;
    Ok(data.end()?)
}

/// Calls `write` with each force: its magnitude, and its vector on the upper sphere.
///
/// Each array iterates again, because an array is complete before the next begins, and the forces do not fit in memory.
fn each_force(
    pile: &NumberedPile<'_>,
    mut write: impl FnMut([f64; 4]) -> std::io::Result<()>,
) -> Result<(), WriteError> {
    for contact in pile.forces()? {
        let contact = contact?;
        let [x, y, z] = contact.vector;
        write([contact.force, x, y, z])?;
    }
    Ok(())
}

/// Returns the arrays of cells: the points, and the offset of each cell's end.
fn cells(points: u64, cells: u64) -> Vec<Array> {
    vec![
        Array::new("connectivity", Kind::Int64, 1, points),
        Array::new("offsets", Kind::Int64, 1, cells),
    ]
}
