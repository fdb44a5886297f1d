//! `spheres.csv`: where every sphere is.

use std::io::Write;

use super::PileExport;
use super::progress::Progress;
use super::rounded::{Centres, nearest_rational};
use crate::Error;
use crate::lattice::{Dimension, Site};
use crate::shape::Selection;
use crate::table::WriteError;

pub(super) fn write(
    export: &PileExport<'_>,
    out: &mut dyn Write,
    progress: &mut Progress<'_>,
) -> Result<(), WriteError> {
    let pile = export.pile();
    let flat = pile.dimension() == Dimension::Two;
    let j = if flat { "" } else { "j," };
    writeln!(out, "id,k,i,{j}x,y,z,radius,mass,fixed")?;
    let radius = nearest_rational(export.packing.radius(), "radius")?;
    let mut centres = Centres::new(&export.packing);
    let masses = Masses::of(export)?;
    let floor = pile.layers() - 1;
    for (id, site) in (1_u64..).zip(pile.rows(Selection::All)?.flatten()) {
        let [x, y, z] = centres.of(site)?;
        let (Site { i, j, k }, mass) = (site, masses.of_sphere(site)?);
        write!(out, "{id},{k},{i},")?;
        if !flat {
            write!(out, "{j},")?;
        }
        let fixed = u8::from(k == floor);
        writeln!(out, "{x:?},{y:?},{z:?},{radius:?},{mass:?},{fixed}")?;
        progress.row();
    }
    Ok(())
}

/// The masses of spheres, rounded: that of an ordinary one once.
pub(super) struct Masses<'a, 'p> {
    export: &'a PileExport<'p>,
    ordinary: f64,
}

impl<'a, 'p> Masses<'a, 'p> {
    pub(super) fn of(export: &'a PileExport<'p>) -> Result<Self, Error> {
        let mass = export.pile().loading().ordinary() * export.packing.mass();
        let ordinary = nearest_rational(&mass, "mass")?;
        Ok(Self { export, ordinary })
    }

    pub(super) fn of_sphere(&self, site: Site) -> Result<f64, Error> {
        if self.export.pile().loading().is_ordinary(site) {
            return Ok(self.ordinary);
        }
        nearest_rational(&self.export.packing.mass_of(site)?, "mass")
    }
}
