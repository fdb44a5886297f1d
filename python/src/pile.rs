//! The class `Pile`: a scene and its pile.

pub(crate) mod answers;
pub(crate) mod arrays;
mod options;
pub(crate) mod rough;
pub(crate) mod tools;

use std::sync::OnceLock;

use cannonpile::geometry::Spacing;
use cannonpile::lattice::Dimension;
use cannonpile::{Packing, Verdict};
use cannonpile_dem::scene;
use cannonpile_dem::scene::{Floor, Scene, State};
use cannonpile_dem::table::{Summary, Units};
use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyType;

use crate::error::Error;
use crate::exception::Raised;
use crate::input::read;
use crate::work::{work, work_of_long_steps};

/// A pile and its sizes. The class `cannonpile.Pile` wraps it.
#[pyclass(frozen, module = "cannonpile._cannonpile")]
pub(crate) struct Pile {
    scene: Scene,
    /// The pile in the equilibrium state of the scene.
    exact: cannonpile::Pile,
    stands: OnceLock<Option<Verdict>>,
}

impl Pile {
    /// Returns the pile of a scene, after validation.
    fn of(py: Python<'_>, scene: Scene) -> PyResult<Self> {
        if scene.floor != Floor::Glued {
            return Err(PyValueError::new_err(
                "floor: a Pile has a floor with glue, but the floor of this scene is rough: use RoughFloor.from_toml, or \
                 remove floor and call on_rough_floor",
            ));
        }
        let wanted = scene.clone();
        let exact = work_of_long_steps(py, move || {
            let scene = wanted;
            scene.check_sizes()?;
            Ok::<_, Raised>(scene.in_state(checked_pile(&scene)?)?)
        })?;
        Ok(Self {
            scene,
            exact,
            stands: OnceLock::new(),
        })
    }

    fn packing(&self) -> Result<Packing<'_>, Error> {
        Ok(self.scene.packing(&self.exact)?)
    }

    fn verdict(&self) -> Result<Option<Verdict>, Error> {
        if let Some(known) = self.stands.get() {
            return Ok(*known);
        }
        let touching = self.exact.clearance().check(&self.scene.spacing()?).ok();
        let summary = Summary::new(&Units::of_pile(&self.exact), touching)?;
        Ok(*self.stands.get_or_init(|| summary.verdict()))
    }
}

/// Returns the pile of a scene, checked.
fn checked_pile(scene: &Scene) -> Result<cannonpile::Pile, Raised> {
    // The only sites in a scene are those of loads.
    scene.pile().map_err(|error| match error.into() {
        error @ Error::Core(cannonpile::Error::SiteOutside { .. }) => {
            Raised::Named("loads", Box::new(error))
        }
        other => other.into(),
    })
}

#[pymethods]
impl Pile {
    /// Make a pile from options, named as in scene files, and from loads with their sites and weights.
    #[new]
    fn new(
        py: Python<'_>,
        options: Vec<(String, String)>,
        loads: Vec<(String, String)>,
    ) -> PyResult<Self> {
        Self::of(py, options::scene(&options, &loads)?)
    }

    /// Make the pile of a scene file.
    #[classmethod]
    fn from_toml(class: &Bound<'_, PyType>, text: &str) -> PyResult<Self> {
        let scene = Scene::from_toml(text).map_err(|error| Raised::from(error).into_exception())?;
        Self::of(class.py(), scene)
    }

    /// Return the scene file.
    fn to_toml(&self) -> String {
        self.scene.to_toml()
    }

    /// Return the pile in its elastic state.
    fn elastic(&self, py: Python<'_>, stiffness_ratio: &str) -> PyResult<Self> {
        let stiffness_ratio = read("stiffness_ratio", stiffness_ratio, scene::parse::rational)?;
        let scene = Scene {
            state: State::Elastic,
            stiffness_ratio,
            ..self.scene.clone()
        };
        Self::of(py, scene)
    }

    /// The number of layers.
    #[getter]
    fn layers(&self) -> BigInt {
        self.exact.layers().into()
    }

    /// The name of the stacking, or its steps.
    #[getter]
    fn stacking(&self) -> String {
        if self.exact.dimension() == Dimension::Two {
            return "discs".into();
        }
        let shape = self.exact.shape();
        let stacking = if shape.is_grown_from_base() {
            shape.stacking().reversed()
        } else {
            shape.stacking().clone()
        };
        stacking
            .name()
            .map_or_else(|| stacking.to_string(), Into::into)
    }

    /// 2 for discs, 3 for spheres.
    #[getter]
    fn dimension(&self) -> u32 {
        self.exact.dimension().number()
    }

    /// The equilibrium state.
    #[getter]
    fn state(&self) -> &'static str {
        self.scene.state.name()
    }

    /// The radius of a sphere.
    #[getter]
    fn radius(&self) -> BigRational {
        self.scene.radius.clone()
    }

    /// The mass of a sphere.
    #[getter]
    fn mass(&self) -> BigRational {
        self.scene.mass.clone()
    }

    /// The gravity.
    #[getter]
    fn gravity(&self) -> BigRational {
        self.scene.gravity.clone()
    }

    /// Half the distance of neighbours in a layer divided by the radius.
    #[getter]
    fn spacing<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let spacing = self
            .scene
            .spacing()
            .map_err(|error| Raised::from(error).into_exception())?;
        match spacing.ratio().to_rational() {
            Some(ratio) => ratio.into_bound_py_any(py),
            None => spacing.to_string().into_bound_py_any(py),
        }
    }

    /// The number of spheres.
    #[getter]
    fn sphere_count(&self) -> BigUint {
        self.exact.sphere_count()
    }

    /// The number of contacts.
    #[getter]
    fn contact_count(&self) -> BigUint {
        self.exact.contact_count() + self.exact.horizontal_forces().len()
    }

    /// The number of bottom spheres.
    #[getter]
    fn base_count(&self) -> BigUint {
        self.exact.base_sphere_count()
    }

    /// The weight of spheres and loads.
    #[getter]
    fn weight(&self) -> BigRational {
        self.exact.weight()
    }

    /// True if the pile is stable, None if this is undecided.
    #[getter]
    fn stands(&self, py: Python<'_>) -> PyResult<Option<bool>> {
        Ok(match work(py, || self.verdict())? {
            Some(Verdict::Yes) => Some(true),
            Some(Verdict::No) => Some(false),
            _ => None,
        })
    }

    /// The unit of contact forces in N.
    #[getter]
    fn unit_force(&self) -> PyResult<f64> {
        let unit = self.packing().map(|packing| packing.unit_force().nearest());
        let unit = unit.and_then(|unit| {
            let overflow = || cannonpile::Error::overflow("the unit of contact forces", "f64");
            Ok(unit.ok_or_else(overflow)?)
        });
        unit.map_err(|error| Raised::from(error).into_exception())
    }

    /// True if the other pile has the same spheres and sizes.
    fn equals(&self, other: &Self) -> bool {
        let spacing = |pile: &Self| {
            pile.scene
                .spacing()
                .ok()
                .map(|s: Spacing| s.square().clone())
        };
        let sizes = |pile: &Self| {
            let Scene {
                radius,
                mass,
                gravity,
                state,
                ..
            } = &pile.scene;
            (radius.clone(), mass.clone(), gravity.clone(), *state)
        };
        self.exact == other.exact && sizes(self) == sizes(other) && spacing(self) == spacing(other)
    }

    /// The Python call that makes this pile.
    fn __repr__(&self) -> String {
        options::call(&self.scene)
    }
}

/// A benchmark case: name, pile, title, purpose and stability.
type Case<P> = (&'static str, P, &'static str, &'static str, Option<bool>);

/// Returns the benchmark cases on a floor, with the pile of each scene.
fn cases_on<P>(floor: Floor, pile_of: impl Fn(Scene) -> PyResult<P>) -> PyResult<Vec<Case<P>>> {
    let mut found = Vec::new();
    for case in scene::cases() {
        let scene = case
            .scene()
            .map_err(|error| Raised::from(error).into_exception())?;
        if scene.floor != floor {
            continue;
        }
        let stands = match case.stands() {
            Some(Verdict::Yes) => Some(true),
            Some(Verdict::No) => Some(false),
            _ => None,
        };
        let pile = pile_of(scene)?;
        found.push((case.name(), pile, case.title(), case.purpose(), stands));
    }
    Ok(found)
}

/// Return the benchmark cases on a floor with glue.
#[pyfunction]
pub(crate) fn cases(py: Python<'_>) -> PyResult<Vec<Case<Pile>>> {
    cases_on(Floor::Glued, |scene| Pile::of(py, scene))
}
