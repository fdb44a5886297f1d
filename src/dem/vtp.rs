//! `spheres.vtp` and `contacts.vtp` for ParaView.

use std::io::Write;

use super::PileExport;
use super::polydata::{Array, Kind, PolyData, Section};
use super::progress::Progress;
use super::rounded::{Centres, Forces, Touch, Touches, contacts, nearest, nearest_rational};
use crate::Error;
use crate::lattice::Site;
use crate::shape::Selection;
use crate::table::WriteError;

/// A point and a vertex for each sphere.
pub(super) fn write_spheres(
    export: &PileExport<'_>,
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<(), WriteError> {
    let (pile, packing) = (export.pile(), &export.packing);
    let n = export.numbering.spheres();
    let sections = [
        Section {
            tag: "PointData",
            arrays: vec![
                Array::new("id", Kind::Int64, 1, n),
                Array::new("layer", Kind::Int64, 1, n),
                Array::new("radius", Kind::Float64, 1, n),
                Array::new("weight", Kind::Float64, 1, n),
                Array::new("load", Kind::Float64, 1, n),
                Array::new("reaction", Kind::Float64, 3, n),
            ],
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
    let sites = || Ok::<_, Error>(pile.rows(Selection::All)?.flatten());

    data.array()?;
    (1..=n).try_for_each(|id| data.integer(id))?;
    data.array()?;
    for site in sites()? {
        // Numbered, and so a small number.
        data.integer(u64::try_from(site.k).unwrap_or_default())?;
    }
    data.array()?;
    let radius = nearest_rational(packing.radius(), "radius")?;
    (0..n).try_for_each(|_| data.float(radius))?;
    let mg = packing.sphere_weight();
    data.array()?;
    let ordinary = nearest_rational(&(pile.loading().ordinary() * &mg), "weight")?;
    for site in sites()? {
        if pile.loading().is_ordinary(site) {
            data.float(ordinary)?;
        } else {
            data.float(nearest_rational(
                &(pile.loading().weight(site) * &mg),
                "weight",
            )?)?;
        }
    }
    data.array()?;
    for site in sites()? {
        data.float(nearest_rational(
            &(pile.loading().load(site) * &mg),
            "load",
        )?)?;
    }
    data.array()?;
    write_reactions(export, &mut data)?;
    data.array()?;
    let mut centres = Centres::new(packing);
    for site in sites()? {
        data.vector(centres.of(site)?)?;
        progress.row();
    }
    data.array()?;
    data.count_up(n)?;
    data.array()?;
    data.multiples(1, n)?;
    Ok(data.end()?)
}

/// The force of the floor on each sphere: none off it.
fn write_reactions(export: &PileExport<'_>, data: &mut PolyData<'_>) -> Result<(), WriteError> {
    for _ in 1..export.numbering.first_on_floor() {
        data.vector([0.0; 3])?;
    }
    for force in export.packing.base(Selection::Base)? {
        let force = force?;
        let quantity = "a reaction";
        data.vector([
            nearest(&-force.shear_x, quantity)?,
            nearest(&-force.shear_y, quantity)?,
            nearest(&force.normal, quantity)?,
        ])?;
    }
    Ok(())
}

/// A line for each contact, with two points of its own, so that the force can be at both ends: tubes are as wide as
/// what their points say.
pub(super) fn write_contacts(
    export: &PileExport<'_>,
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<(), WriteError> {
    let (packing, numbering) = (&export.packing, &export.numbering);
    // Not more than the most rows.
    let n = u64::try_from(export.pile().contacts()).unwrap_or_default();
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
    each_force(export, |[force, ..]| {
        data.float(force)?;
        data.float(force)
    })?;
    data.array()?;
    each_force(export, |[force, ..]| data.float(force))?;
    data.array()?;
    each_force(export, |[_, x, y, z]| data.vector([x, y, z]))?;
    data.array()?;
    for touch in Touches::new(numbering)? {
        let place = touch?.direction.index();
        data.byte(u8::try_from(place).unwrap_or_default())?;
    }
    data.array()?;
    for touch in Touches::new(numbering)? {
        data.integer(touch?.upper)?;
    }
    data.array()?;
    for touch in Touches::new(numbering)? {
        data.integer(touch?.lower)?;
    }
    data.array()?;
    // Two of them: each keeps the row that it is in.
    let (mut upper, mut lower) = (Centres::new(packing), Lower::new(export));
    for touch in Touches::new(numbering)? {
        let touch = touch?;
        data.vector(upper.of(touch.site)?)?;
        data.vector(lower.of(&touch)?)?;
        progress.row();
    }
    data.array()?;
    data.count_up(2 * n)?;
    data.array()?;
    data.multiples(2, n)?;
    Ok(data.end()?)
}

/// All forces in turn: magnitude, and vector on the upper sphere.
///
/// Once for each array, because an array is written to its end before the next, and none has room in memory.
fn each_force(
    export: &PileExport<'_>,
    mut write: impl FnMut([f64; 4]) -> std::io::Result<()>,
) -> Result<(), WriteError> {
    let mut forces = Forces::new(&export.packing, |force, [x, y, z]| [force, x, y, z]);
    for contact in contacts(&export.packing, &export.numbering)? {
        let (touch, multiple) = contact?;
        write(*forces.of(&touch, multiple)?)?;
    }
    Ok(())
}

/// The centres of lower spheres: along each direction they follow each other in a row.
struct Lower<'a, 'p> {
    export: &'a PileExport<'p>,
    centres: [Centres<'a, 'p>; 3],
}

impl<'a, 'p> Lower<'a, 'p> {
    fn new(export: &'a PileExport<'p>) -> Self {
        let centres = [(); 3].map(|()| Centres::new(&export.packing));
        Self { export, centres }
    }

    fn of(&mut self, touch: &Touch) -> Result<[f64; 3], Error> {
        let Touch {
            site, direction, ..
        } = *touch;
        let below = self.export.pile().shape().below(site, direction);
        let below: Site = below.ok_or(Error::OnFloor { site })?;
        let [alpha, beta, gamma] = &mut self.centres;
        match direction {
            crate::lattice::Direction::Alpha => alpha,
            crate::lattice::Direction::Beta => beta,
            crate::lattice::Direction::Gamma => gamma,
        }
        .of(below)
    }
}

/// The points of cells, and where those of each end.
fn cells(points: u64, cells: u64) -> Vec<Array> {
    vec![
        Array::new("connectivity", Kind::Int64, 1, points),
        Array::new("offsets", Kind::Int64, 1, cells),
    ]
}
