//! Comparison of measured forces with the exact ones.

use cannonpile::Packing;
use cannonpile::lattice::Site;
use cannonpile_dem::verify;
use cannonpile_dem::verify::{Fault, Force, Measured, Placed, Refusal};
use num_bigint::BigInt;
use numpy::{Element, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::exception::Raised;

/// Measured contacts: their identification and their forces.
pub(crate) struct Measurement {
    places: Places,
    forces: Option<Vec<f64>>,
    vectors: Option<Vec<[f64; 3]>>,
    /// On a rough floor, the tangential forces on the first spheres.
    tangential: Option<Vec<[f64; 3]>>,
    /// On a rough floor, the forces of the floor on the bottom spheres.
    on_base: Option<Vec<[f64; 3]>>,
}

/// The identification of contacts.
enum Places {
    Ids(Vec<[u64; 2]>),
    Points(Vec<[f64; 3]>),
    Centres(Vec<[[f64; 3]; 2]>),
}

/// Copies an array as rows of a given length. Other threads may write to the array meanwhile.
fn rows<V: Element + Copy, const N: usize>(
    array: &PyReadonlyArray1<'_, V>,
) -> PyResult<Vec<[V; N]>> {
    Ok(array.as_slice()?.as_chunks::<N>().0.to_vec())
}

impl Measurement {
    /// Reads the measurement from arrays, which must be contiguous and of equal length.
    pub(crate) fn new(
        ids: Option<&PyReadonlyArray1<'_, i64>>,
        [points, centres]: [Option<&PyReadonlyArray1<'_, f64>>; 2],
        forces: Option<&PyReadonlyArray1<'_, f64>>,
        vectors: Option<&PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<Self> {
        let places = match (ids, points, centres) {
            (Some(ids), None, None) => Places::Ids(
                (1..)
                    .zip(rows::<_, 2>(ids)?)
                    .map(numbered)
                    .collect::<PyResult<_>>()?,
            ),
            (None, Some(points), None) => Places::Points(rows(points)?),
            (None, None, Some(centres)) => {
                let centres = rows::<_, 6>(centres)?.into_iter();
                Places::Centres(
                    centres
                        .map(|[a, b, c, x, y, z]| [[a, b, c], [x, y, z]])
                        .collect(),
                )
            }
            _ => {
                return Err(PyValueError::new_err(
                    "give exactly one of ids, points and centres, to identify the contacts",
                ));
            }
        };
        if forces.is_none() && vectors.is_none() {
            return Err(PyValueError::new_err(
                "give forces, vectors or both, the measured values",
            ));
        }
        Ok(Self {
            places,
            forces: forces
                .map(|forces| forces.as_slice().map(<[f64]>::to_vec))
                .transpose()?,
            vectors: vectors.map(rows).transpose()?,
            tangential: None,
            on_base: None,
        })
    }

    /// Adds the tangential forces of the contacts, and the forces of the floor on the bottom spheres.
    pub(crate) fn with_friction(
        self,
        tangential: Option<&PyReadonlyArray1<'_, f64>>,
        on_base: Option<&PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<Self> {
        Ok(Self {
            tangential: tangential.map(rows).transpose()?,
            on_base: on_base.map(rows).transpose()?,
            ..self
        })
    }

    /// Compares the measurement with the exact forces.
    pub(crate) fn compare(
        &self,
        packing: &Packing<'_>,
        within: f64,
    ) -> Result<verify::Comparison, Raised> {
        self.compared(packing, within)
            .map_err(|refusal| self.named(refusal))
    }

    /// Compares the measurement, whose contacts are identified by ids, with the exact forces on a rough floor.
    pub(crate) fn compare_on_rough_floor(
        &self,
        packing: &Packing<'_>,
    ) -> Result<verify::Comparison, Raised> {
        let Places::Ids(ids) = &self.places else {
            let bug = cannonpile::engine::bug("contacts on a rough floor are identified by ids");
            return Err(bug.into());
        };
        let first = packing.pile().numbering()?.first_on_floor();
        let base = (first..).zip(self.on_base.iter().flatten());
        // Sphere 0 is the floor.
        let base = base.map(|(id, force)| Measured::of_vector([id, 0], *force));
        verify::Comparison::on_rough_floor(packing, self.measured(ids).chain(base))
            .map_err(|refusal| self.named(refusal))
    }

    /// Adds the name of the argument with the invalid measurement to an error.
    fn named(&self, refusal: Refusal) -> Raised {
        let places = match self.places {
            Places::Ids(_) => "ids",
            Places::Points(_) => "points",
            Places::Centres(_) => "centres",
        };
        match refusal {
            Refusal::Entry {
                fault: Fault::NotFinite { .. },
                ..
            } => refusal.into(),
            Refusal::Entry { .. } | Refusal::Elsewhere { .. } => {
                Raised::Argument(places, Box::new(refusal))
            }
            other => other.into(),
        }
    }

    fn compared(&self, packing: &Packing<'_>, within: f64) -> Result<verify::Comparison, Refusal> {
        let of_places = |(comparison, _)| comparison;
        match &self.places {
            Places::Ids(ids) => verify::Comparison::new(packing, self.measured(ids)),
            Places::Points(points) => {
                let points = (0..).zip(points);
                let placed = points.map(|(n, point)| Placed::at(*point, self.force(n)));
                verify::Comparison::of_places(packing, placed, within).map(of_places)
            }
            Places::Centres(centres) => {
                let centres = (0..).zip(centres);
                let placed = centres.map(|(n, pair)| Placed::between(*pair, self.force(n)));
                verify::Comparison::of_places(packing, placed, within).map(of_places)
            }
        }
    }

    /// Returns the forces between pairs of numbered spheres.
    fn measured(&self, ids: &[[u64; 2]]) -> impl Iterator<Item = Measured> {
        (0..).zip(ids).map(|(n, ids)| {
            let measured = match self.force(n) {
                Force::Along(force) => Measured::new(*ids, force),
                Force::Vector(vector) => Measured::of_vector(*ids, vector),
                Force::Both(force, vector) => Measured::new(*ids, force).with_vector(vector),
            };
            let tangential = self.tangential.as_ref().and_then(|all| all.get(n));
            Measured {
                tangential: tangential.copied(),
                ..measured
            }
        })
    }

    fn force(&self, n: usize) -> Force {
        let force = self.forces.as_ref().and_then(|forces| forces.get(n));
        let vector = self.vectors.as_ref().and_then(|vectors| vectors.get(n));
        match (force, vector) {
            (Some(force), Some(vector)) => Force::Both(*force, *vector),
            (None, Some(vector)) => Force::Vector(*vector),
            (Some(force), None) => Force::Along(*force),
            // The library reports values that are not finite.
            (None, None) => Force::Along(f64::NAN),
        }
    }
}

/// Returns the ids of an entry if they are valid.
fn numbered((entry, ids): (u64, [i64; 2])) -> PyResult<[u64; 2]> {
    let [one, other] = ids.map(|id| {
        u64::try_from(id).map_err(|_| {
            PyValueError::new_err(format!(
                "ids: entry {entry}: no sphere {id}: the spheres of a pile are numbered from 1"
            ))
        })
    });
    Ok([one?, other?])
}

/// A contact: ids, k, i, j, direction, exact force, measured force, relative error, and a description in words.
type Row = (
    (u64, u64),
    BigInt,
    BigInt,
    BigInt,
    &'static str,
    f64,
    Option<f64>,
    f64,
    String,
);

fn row(difference: &verify::Difference) -> Row {
    let Site { i, j, k } = difference.site;
    (
        difference.ids.into(),
        k.into(),
        i.into(),
        j.into(),
        difference.direction.name(),
        difference.exact,
        difference.measured.map(|measured| measured.force),
        difference.error,
        difference.to_string(),
    )
}

/// The comparison of measured forces with the exact ones.
#[pyclass(frozen, module = "cannonpile._cannonpile")]
pub(crate) struct Comparison(verify::Comparison);

impl Comparison {
    pub(crate) fn new(comparison: verify::Comparison) -> Self {
        Self(comparison)
    }
}

#[pymethods]
impl Comparison {
    /// The number of contacts of the pile.
    #[getter]
    fn contacts(&self) -> u64 {
        self.0.contacts()
    }

    /// The number of measured contacts.
    #[getter]
    fn matched(&self) -> u64 {
        self.0.matched()
    }

    /// The number of contacts with a force that were not measured.
    #[getter]
    fn missing(&self) -> u64 {
        self.0.missing()
    }

    /// The number of entries that list a pair a second time.
    #[getter]
    fn repeated(&self) -> u64 {
        self.0.repeated()
    }

    /// The number of contacts with the floor that are judged.
    #[getter]
    fn floor(&self) -> u64 {
        self.0.floor()
    }

    /// The largest relative error of the floor.
    #[getter]
    fn floor_error(&self) -> Option<f64> {
        self.0.floor_error()
    }

    /// The number of contacts with a measured tangential force.
    #[getter]
    fn tangential(&self) -> u64 {
        self.0.tangential()
    }

    /// The largest error of a tangential force.
    #[getter]
    fn tangential_error(&self) -> Option<f64> {
        self.0.tangential_error()
    }

    /// The largest error of the friction of the floor.
    #[getter]
    fn floor_friction_error(&self) -> Option<f64> {
        self.0.floor_friction_error()
    }

    /// The sphere with the greatest net moment, and this moment.
    #[getter]
    fn net_moment(&self) -> Option<(u64, f64)> {
        self.0.net_moment()
    }

    /// The number of pairs with two different forces.
    fn contradictory(&self, rtol: f64) -> u64 {
        self.0.contradictory(rtol)
    }

    /// The number of ignored pairs of bottom spheres.
    #[getter]
    fn fixed(&self) -> u64 {
        self.0.fixed()
    }

    /// The largest exact force.
    #[getter]
    fn largest_force(&self) -> f64 {
        self.0.largest_force()
    }

    /// The largest relative error.
    #[getter]
    fn largest_error(&self) -> Option<f64> {
        self.0.largest_error()
    }

    /// The root mean square of the relative errors.
    #[getter]
    fn rms_error(&self) -> Option<f64> {
        self.0.rms_error()
    }

    /// The contact with the largest error.
    #[getter]
    fn worst(&self) -> Option<Row> {
        self.0.worst().map(row)
    }

    /// The first missing contacts.
    fn missing_contacts(&self) -> Vec<Row> {
        self.0.missing_contacts().iter().map(row).collect()
    }

    /// The number of pairs with a force that are not contacts.
    fn extra(&self, rtol: f64) -> u64 {
        self.0.extra(rtol)
    }

    /// The first such pair, in words.
    fn worst_extra(&self) -> Option<String> {
        self.0.extra_pairs().first().map(ToString::to_string)
    }

    /// The number of measured contacts with a larger error.
    fn beyond(&self, rtol: f64) -> u64 {
        self.0.beyond(rtol)
    }

    /// True if no contact is missing, extra or wrong.
    fn accepted(&self, rtol: f64) -> bool {
        self.0.accepted(rtol)
    }

    /// Explanations of the differences.
    fn findings(&self, rtol: f64) -> Vec<String> {
        self.0
            .findings(rtol)
            .iter()
            .map(ToString::to_string)
            .collect()
    }

    /// A summary of one line.
    fn __str__(&self) -> String {
        self.0.to_string()
    }
}
