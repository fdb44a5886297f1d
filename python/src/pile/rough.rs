//! The class `RoughFloor`: two layers on a rough floor.

use std::path::PathBuf;

use cannonpile::Packing;
use cannonpile::scalar::SurdSum;
use cannonpile::shape::Selection;
use cannonpile_dem::scene::{Floor, Scene, parse};
use cannonpile_dem::table::refuse_beyond;
use cannonpile_dem::verify::{Preset, Reader};
use cannonpile_dem::{PileExport, PileFormat};
use cannonpile_stability::RoughPacking;
use num_bigint::BigInt;
use num_rational::BigRational;
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyType;

use super::{Case, Pile, cases_on, checked_pile};
use crate::comparison::{Comparison, Measurement};
use crate::error::Error;
use crate::exception::Raised;
use crate::input::read;
use crate::work::work;

/// A pile of two layers on a rough floor. The class `cannonpile.RoughFloor` wraps it.
#[pyclass(frozen, module = "cannonpile._cannonpile")]
pub(crate) struct RoughFloor {
    /// Its floor is rough.
    scene: Scene,
    exact: cannonpile::Pile,
}

impl RoughFloor {
    /// Returns the pile of a scene, after validation.
    fn of(py: Python<'_>, scene: Scene) -> PyResult<Self> {
        let exact = work(py, || {
            scene.check_sizes()?;
            let pile = checked_pile(&scene)?;
            // Friction depends on the spacing, also on the default one.
            RoughPacking::new(&scene.packing(&pile)?)?;
            Ok::<_, Raised>(pile)
        })?;
        Ok(Self { scene, exact })
    }

    fn packing(&self) -> Result<Packing<'_>, Error> {
        Ok(self.scene.packing(&self.exact)?)
    }
}

/// A coefficient of friction: rounded, and as a sum of roots.
type Coefficient = (f64, String);

#[pymethods]
impl RoughFloor {
    /// Put a pile on a rough floor, with the given coefficients of friction.
    #[new]
    fn new(
        py: Python<'_>,
        pile: &Pile,
        friction: Option<&str>,
        floor_friction: Option<&str>,
    ) -> PyResult<Self> {
        let number = |name, text: Option<&str>| {
            text.map(|text| read(name, text, parse::rational))
                .transpose()
        };
        let scene = Scene {
            floor: Floor::Rough,
            friction: number("friction", friction)?,
            floor_friction: number("floor_friction", floor_friction)?,
            ..pile.scene.clone()
        };
        Self::of(py, scene)
    }

    /// Read a scene file with a rough floor.
    #[classmethod]
    fn from_toml(class: &Bound<'_, PyType>, text: &str) -> PyResult<Self> {
        let scene = Scene::from_toml(text).map_err(|error| Raised::from(error).into_exception())?;
        if scene.floor != Floor::Rough {
            return Err(PyValueError::new_err(
                "floor: the floor of this scene has glue: add floor = \"rough\", or use Pile.from_toml",
            ));
        }
        Self::of(class.py(), scene)
    }

    /// Return the scene file.
    fn to_toml(&self) -> String {
        self.scene.to_toml()
    }

    /// Return the pile on a floor with glue.
    fn pile(&self, py: Python<'_>) -> PyResult<Pile> {
        let scene = Scene {
            floor: Floor::Glued,
            friction: None,
            floor_friction: None,
            ..self.scene.clone()
        };
        Pile::of(py, scene)
    }

    /// The given coefficient of friction between spheres.
    #[getter]
    fn friction(&self) -> Option<BigRational> {
        self.scene.friction.clone()
    }

    /// The given coefficient of friction of the floor.
    #[getter]
    fn floor_friction(&self) -> Option<BigRational> {
        self.scene.floor_friction.clone()
    }

    /// The coefficients of friction that the pile needs: between spheres, and of the floor.
    #[getter]
    fn needed(&self, py: Python<'_>) -> PyResult<[Coefficient; 2]> {
        work(py, || {
            let rough = RoughPacking::new(&self.packing()?)?;
            let coefficient = |needed: &SurdSum| {
                let float = rounded(needed, "a coefficient of friction")?;
                Ok::<_, Error>((float, needed.to_string()))
            };
            Ok::<_, Error>([
                coefficient(&rough.contact_friction())?,
                coefficient(&rough.floor_friction()?)?,
            ])
        })
    }

    /// True if the pile stands, None if no coefficient of friction is given.
    #[getter]
    fn stands(&self, py: Python<'_>) -> PyResult<Option<bool>> {
        work(py, || {
            let stands = self.scene.stands_with_friction(&self.packing()?);
            Ok::<_, Error>(stands?)
        })
    }
}

/// Returns a correctly rounded number.
fn rounded(number: &SurdSum, quantity: &'static str) -> Result<f64, Error> {
    let overflow = || cannonpile::Error::overflow(quantity, "f64");
    // Adding 0 turns −0 into 0.
    Ok(number.nearest::<f64>().ok_or_else(overflow)? + 0.0)
}

/// Returns a correctly rounded force.
fn rounded_force<T: Into<SurdSum>>(force: [T; 3]) -> Result<[f64; 3], Error> {
    let [x, y, z] = force.map(|part| rounded(&part.into(), "a force"));
    Ok([x?, y?, z?])
}

/// A contact: ids, k, i, j, direction, normal force in mg, and both forces on the upper sphere in N.
type Contact = (
    (u64, u64),
    BigInt,
    BigInt,
    BigInt,
    &'static str,
    BigRational,
    (f64, f64, f64),
    (f64, f64, f64),
);

/// The contacts between spheres.
#[pyfunction]
pub(crate) fn rough_contacts(floor: &RoughFloor, py: Python<'_>) -> PyResult<Vec<Contact>> {
    work(py, || {
        let pile = &floor.exact;
        refuse_beyond(&pile.contact_count(), "use a smaller top or base")?;
        let numbering = pile.numbering()?;
        let multiples = cannonpile_stability::RoughFloor::new(pile)?.contacts(Selection::All)?;
        let in_si = RoughPacking::new(&floor.packing()?)?.contacts(Selection::All)?;
        let contacts = multiples.zip(in_si).map(|(multiple, contact)| {
            let (multiple, contact) = (multiple?, contact?);
            let (site, direction) = (contact.site, contact.direction);
            let below = pile.shape().below(site, direction);
            let below = below.ok_or(cannonpile::Error::OnFloor { site })?;
            Ok((
                (numbering.id(site)?, numbering.id(below)?),
                site.k.into(),
                site.i.into(),
                site.j.into(),
                direction.name(),
                multiple.force,
                rounded_force(contact.normal_vector)?.into(),
                rounded_force(contact.tangential_vector)?.into(),
            ))
        });
        contacts.collect::<Result<_, Error>>()
    })
}

/// The forces of the base on the floor, in N: normal, and friction along x and y.
#[pyfunction]
pub(crate) fn rough_base(floor: &RoughFloor, py: Python<'_>) -> PyResult<Vec<[f64; 3]>> {
    work(py, || {
        refuse_beyond(
            &floor.exact.base_sphere_count(),
            "use a smaller top or base",
        )?;
        let forces = RoughPacking::new(&floor.packing()?)?.base(Selection::Base)?;
        let forces = forces.map(|force| {
            let force = force?;
            rounded_force([force.normal, force.shear_x, force.shear_y])
        });
        forces.collect::<Result<_, Error>>()
    })
}

/// Compare measured forces with the exact ones.
#[pyfunction]
pub(crate) fn compare_rough(
    floor: &RoughFloor,
    py: Python<'_>,
    ids: Option<PyReadonlyArray1<'_, i64>>,
    forces: Option<PyReadonlyArray1<'_, f64>>,
    vectors: Option<PyReadonlyArray1<'_, f64>>,
    tangential: Option<PyReadonlyArray1<'_, f64>>,
    on_base: Option<PyReadonlyArray1<'_, f64>>,
) -> PyResult<Comparison> {
    let measurement = Measurement::new(ids.as_ref(), [None; 2], forces.as_ref(), vectors.as_ref())?
        .with_friction(tangential.as_ref(), on_base.as_ref())?;
    work(py, || measurement.compare_on_rough_floor(&floor.packing()?)).map(Comparison::new)
}

/// Compare the tables of a simulation with the exact forces.
#[pyfunction]
pub(crate) fn compare_rough_tables(
    floor: &RoughFloor,
    py: Python<'_>,
    contacts: &[u8],
    floor_table: Option<&[u8]>,
    preset: &str,
    folder: PathBuf,
) -> PyResult<Comparison> {
    let preset: Preset = read("preset", preset, |text| {
        text.parse().map_err(cannonpile_dem::Error::from)
    })?;
    let reader = Reader::of(preset).on_floor(Floor::Rough).in_folder(folder);
    let compared = work(py, || {
        let packing = floor.packing()?;
        let compared = match floor_table {
            Some(table) => reader.compare_with_floor(&packing, contacts, table),
            None => reader.compare(&packing, contacts),
        };
        Ok::<_, Raised>(compared?)
    })?;
    Ok(Comparison::new(compared.comparison))
}

/// Write files and return their names.
#[pyfunction]
pub(crate) fn export_rough(
    floor: &RoughFloor,
    py: Python<'_>,
    folder: PathBuf,
    formats: Vec<String>,
) -> PyResult<Vec<String>> {
    let formats = formats.iter().map(|name| format_named(name));
    let formats: Vec<PileFormat> = formats.collect::<PyResult<_>>()?;
    work(py, || {
        let packing = floor.packing()?;
        let mut export = PileExport::new(&packing)?.with_scene(floor.scene.to_toml());
        if let Some(friction) = floor.scene.friction(&packing)? {
            export = export.on_rough_floor(friction)?;
        }
        let written = export.write(&formats, &folder, &mut |_| {})?;
        let names = written.iter().map(|written| written.name().to_owned());
        Ok::<_, Raised>(names.collect())
    })
}

/// Returns a format that supports a rough floor.
fn format_named(name: &str) -> PyResult<PileFormat> {
    match name {
        "lammps" => Ok(PileFormat::Lammps),
        "yade" => Ok(PileFormat::Yade),
        "card" => Ok(PileFormat::Card),
        _ => Err(PyValueError::new_err(format!(
            "formats: '{name}' is not one of lammps, yade, card, the formats for a rough floor"
        ))),
    }
}

/// Return the benchmark cases on a rough floor.
#[pyfunction]
pub(crate) fn friction_cases(py: Python<'_>) -> PyResult<Vec<Case<RoughFloor>>> {
    cases_on(Floor::Rough, |scene| RoughFloor::of(py, scene))
}
