//! Files, figures and comparisons with measured forces.

use std::io::Write;
use std::path::PathBuf;

use cannonpile_dem::scene::{State, parse};
use cannonpile_dem::{OtherFile, PileExport, PileFormat};
use cannonpile_figure as figure;
use cannonpile_figure::viewer::Page;
use cannonpile_figure::{Figure, Layout, Subject};
use num_bigint::BigInt;
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use super::Pile;
use crate::comparison::{Comparison, Measurement};
use crate::error::Error;
use crate::exception::Raised;
use crate::figure::Kind;
use crate::input::{coordinate, read};
use crate::work::work;

/// A figure of the pile: its SVG and a warning about the pile.
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

/// An interactive page of the pile.
#[pyfunction]
pub(crate) fn page(pile: &Pile, py: Python<'_>) -> PyResult<String> {
    work(py, || {
        let page = Page::new(&pile.packing()?)?;
        Ok::<_, Error>(page.with_scene(pile.scene.to_toml()).to_html()?)
    })
}

/// Write files and return their names.
#[pyfunction]
pub(crate) fn export(
    pile: &Pile,
    py: Python<'_>,
    folder: PathBuf,
    formats: Vec<String>,
) -> PyResult<Vec<String>> {
    let formats: Vec<Format> = formats
        .iter()
        .map(|name| format_named(name))
        .collect::<PyResult<_>>()?;
    let with_page = formats.iter().any(|format| matches!(format, Format::Page));
    let formats: Vec<PileFormat> = formats
        .into_iter()
        .filter_map(|format| match format {
            Format::Files(format) => Some(format),
            Format::Page => None,
        })
        .collect();
    work(py, || {
        let packing = pile.packing()?;
        let scene = pile.scene.to_toml();
        let export = PileExport::new(&packing)?.with_scene(scene.clone());
        let page = if with_page {
            Some(Page::new(&packing)?.with_scene(scene))
        } else {
            None
        };
        let page = page.as_ref();
        let write = page.map(|page| move |out: &mut dyn Write| page.write(out));
        let others = write.as_ref().map(|write| OtherFile {
            name: "pile.html",
            write,
        });
        let written = export.write_with(&formats, others.as_slice(), &folder, &mut |_| {})?;
        let names = written.iter().map(|written| written.name().to_owned());
        Ok::<_, Raised>(names.collect())
    })
}

/// Compare measured forces with the exact ones.
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
    /// Draws a figure of the pile in its equilibrium state.
    fn figure(
        &self,
        kind: Kind,
        si: bool,
        draw: impl FnOnce(&Subject<'_>, &cannonpile::Pile) -> Result<Figure, figure::Error>,
    ) -> Result<Figure, Error> {
        if kind == Kind::Bounds {
            self.scene.check_touching()?;
        }
        let response = match kind {
            Kind::Response => Some(figure::with_load_on_top(
                self.exact.clone(),
                cannonpile::ratio!(1),
            )?),
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
        Ok(draw(&subject, pile)?)
    }
}

/// A format of an export.
enum Format {
    Files(PileFormat),
    Page,
}

fn format_named(name: &str) -> PyResult<Format> {
    Ok(Format::Files(match name {
        "csv" => PileFormat::Csv,
        "lammps" => PileFormat::Lammps,
        "vtp" => PileFormat::Vtp,
        "yade" => PileFormat::Yade,
        "card" => PileFormat::Card,
        "mtx" => PileFormat::Mtx,
        "html" => return Ok(Format::Page),
        _ => {
            return Err(PyValueError::new_err(format!(
                "formats: '{name}' is not one of csv, lammps, vtp, yade, card, mtx, html"
            )));
        }
    }))
}
