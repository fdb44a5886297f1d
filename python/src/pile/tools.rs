//! Files, figures, and measured forces.

use std::path::PathBuf;

use cannonpile::Error;
use cannonpile::dem::{Page, PileExport, PileFormat};
use cannonpile::figure::{self, Figure, Layout, Subject};
use cannonpile::scene::{State, parse};
use cannonpile::table::WriteError;
use num_bigint::BigInt;
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::Pile;
use crate::comparison::{Comparison, Measurement};
use crate::exception::Raised;
use crate::figure::Kind;
use crate::input::{coordinate, read};
use crate::work::work;

/// A figure of the pile: its SVG, and what is to be said of it.
#[pyfunction]
pub(crate) fn plot(
    pile: &Pile,
    py: Python<'_>,
    kind: &str,
    layer: Option<BigInt>,
    at: Option<&str>,
    si: bool,
    width: u32,
    title: bool,
) -> PyResult<(String, Option<String>)> {
    let kind = Kind::named(kind)?;
    let layer = layer.map(|k| coordinate("layer", &k)).transpose()?;
    let at = at.map(|at| read("at", at, |at| parse::at(at, pile.exact.dimension())));
    let site = at.transpose()?.map(|at| at.site(pile.exact.layers()));
    let layout = Layout {
        width: f64::from(width),
        title,
    };
    work(py, || {
        let figure = pile.figure(kind, si, |subject, pile| {
            kind.draw((subject, pile), layer, site)
        })?;
        let figure = figure.laid_out(layout);
        Ok::<_, Error>((figure.to_string(), figure.note().map(Into::into)))
    })
}

/// A page to look into the pile.
#[pyfunction]
pub(crate) fn page(pile: &Pile, py: Python<'_>) -> PyResult<String> {
    work(py, || {
        let page = Page::new(&pile.packing()?)?;
        page.with_scene(pile.scene.to_toml()).to_html()
    })
}

/// Write files, and return their names.
#[pyfunction]
pub(crate) fn export(
    pile: &Pile,
    py: Python<'_>,
    folder: PathBuf,
    formats: Vec<String>,
) -> PyResult<Vec<String>> {
    let formats: Vec<PileFormat> = formats
        .iter()
        .map(|name| format_named(name))
        .collect::<PyResult<_>>()?;
    work(py, || {
        let packing = pile.packing()?;
        let export = PileExport::new(&packing)?.with_scene(pile.scene.to_toml());
        let written = export.write(&formats, &folder, &mut |_| {})?;
        let names = written.iter().map(|written| written.file.name().to_owned());
        Ok::<_, WriteError>(names.collect())
    })
}

/// Hold measured forces against the exact ones.
#[pyfunction]
pub(crate) fn compare(
    pile: &Pile,
    py: Python<'_>,
    ids: Option<PyReadonlyArray1<'_, i64>>,
    points: Option<PyReadonlyArray1<'_, f64>>,
    centres: Option<PyReadonlyArray1<'_, f64>>,
    forces: Option<PyReadonlyArray1<'_, f64>>,
    vectors: Option<PyReadonlyArray1<'_, f64>>,
    within: f64,
) -> PyResult<Comparison> {
    let measurement = Measurement::new(
        ids.as_ref(),
        [points.as_ref(), centres.as_ref()],
        forces.as_ref(),
        vectors.as_ref(),
    )?;
    let packing = pile
        .packing()
        .map_err(|error| Raised::from(error).into_exception())?;
    work(py, || measurement.compare(&packing, within)).map(Comparison::new)
}

impl Pile {
    /// A figure of the pile in the state that is meant.
    fn figure(
        &self,
        kind: Kind,
        si: bool,
        draw: impl FnOnce(&Subject<'_>, &cannonpile::Pile) -> Result<Figure, Error>,
    ) -> Result<Figure, Error> {
        if kind == Kind::Bounds {
            self.scene.check_touching()?;
        }
        let response = match kind {
            Kind::Response => Some(figure::of_unit_load(self.exact.clone())?),
            _ => None,
        };
        let pile = response.as_ref().unwrap_or(&self.exact);
        let spacing = match kind {
            Kind::Bounds => "1".parse()?,
            _ => self.scene.spacing()?,
        };
        let mut subject = if si {
            Subject::of_packing(
                cannonpile::Packing::new(pile, &spacing)?
                    .with_radius(self.scene.radius.clone())?
                    .with_mass(self.scene.mass.clone())?
                    .with_gravity(self.scene.gravity.clone())?,
            )
        } else {
            Subject::of_pile(pile, &spacing)?
        };
        if self.scene.state == State::Elastic && matches!(kind, Kind::Network | Kind::Base) {
            subject = subject.with_horizontal_contacts();
        }
        draw(&subject, pile)
    }
}

fn format_named(name: &str) -> PyResult<PileFormat> {
    Ok(match name {
        "csv" => PileFormat::Csv,
        "lammps" => PileFormat::Lammps,
        "vtp" => PileFormat::Vtp,
        "yade" => PileFormat::Yade,
        "card" => PileFormat::Card,
        "html" => PileFormat::Html,
        "lammps-test" => PileFormat::LammpsTest,
        "yade-check" => PileFormat::YadeCheck,
        _ => {
            return Err(PyValueError::new_err(format!(
                "formats: '{name}' is not one of csv, lammps, vtp, yade, card, html, lammps-test, yade-check"
            )));
        }
    })
}
