//! Measured forces, held against the exact ones.

use cannonpile::Packing;
use cannonpile::lattice::Site;
use cannonpile_dem::verify;
use cannonpile_dem::verify::{Fault, Force, Measured, Placed, Refusal};
use num_bigint::BigInt;
use numpy::{Element, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::exception::Raised;

/// What was measured: where, and how much.
pub(crate) struct Measurement {
    places: Places,
    forces: Option<Vec<f64>>,
    vectors: Option<Vec<[f64; 3]>>,
}

/// How contacts are known.
enum Places {
    Ids(Vec<[u64; 2]>),
    Points(Vec<[f64; 3]>),
    Centres(Vec<[[f64; 3]; 2]>),
}

/// A copy of an array, which others may write to meanwhile, as rows of so many numbers.
fn rows<V: Element + Copy, const N: usize>(
    array: &PyReadonlyArray1<'_, V>,
) -> PyResult<Vec<[V; N]>> {
    Ok(array.as_slice()?.as_chunks::<N>().0.to_vec())
}

impl Measurement {
    /// What arrays hold, each contiguous and as long as the others.
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
                    "give one of ids, points and centres: which spheres the contacts are between",
                ));
            }
        };
        if forces.is_none() && vectors.is_none() {
            return Err(PyValueError::new_err(
                "give forces, or vectors, or both: what was measured",
            ));
        }
        Ok(Self {
            places,
            forces: forces
                .map(|forces| forces.as_slice().map(<[f64]>::to_vec))
                .transpose()?,
            vectors: vectors.map(rows).transpose()?,
        })
    }

    /// Compares it with the exact forces.
    pub(crate) fn compare(
        &self,
        packing: &Packing<'_>,
        within: f64,
    ) -> Result<verify::Comparison, Raised> {
        let places = match self.places {
            Places::Ids(_) => "ids",
            Places::Points(_) => "points",
            Places::Centres(_) => "centres",
        };
        self.compared(packing, within)
            .map_err(|refusal| match refusal {
                Refusal::Entry {
                    fault: Fault::NotFinite { .. },
                    ..
                } => refusal.into(),
                Refusal::Entry { .. } | Refusal::Elsewhere { .. } => {
                    Raised::Argument(places, Box::new(refusal))
                }
                other => other.into(),
            })
    }

    fn compared(&self, packing: &Packing<'_>, within: f64) -> Result<verify::Comparison, Refusal> {
        let of_places = |(comparison, _)| comparison;
        match &self.places {
            Places::Ids(ids) => {
                let measured = (0..).zip(ids).map(|(n, ids)| match self.force(n) {
                    Force::Along(force) => Measured::new(*ids, force),
                    Force::Vector(vector) => Measured::of_vector(*ids, vector),
                    Force::Both(force, vector) => Measured::new(*ids, force).with_vector(vector),
                });
                verify::Comparison::new(packing, measured)
            }
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

    fn force(&self, n: usize) -> Force {
        let force = self.forces.as_ref().and_then(|forces| forces.get(n));
        let vector = self.vectors.as_ref().and_then(|vectors| vectors.get(n));
        match (force, vector) {
            (Some(force), Some(vector)) => Force::Both(*force, *vector),
            (None, Some(vector)) => Force::Vector(*vector),
            (Some(force), None) => Force::Along(*force),
            // The library says that it is not finite.
            (None, None) => Force::Along(f64::NAN),
        }
    }
}

/// The numbers of an entry, if spheres can have them.
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

/// A contact: ids, k, i, j, direction, exact force, measured force, relative error, and all of it in words.
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

/// Measured forces, held against the exact ones.
#[pyclass(frozen, module = "cannonpile._cannonpile")]
pub(crate) struct Comparison(verify::Comparison);

impl Comparison {
    pub(crate) fn new(comparison: verify::Comparison) -> Self {
        Self(comparison)
    }
}

#[pymethods]
impl Comparison {
    /// How many contacts the pile has.
    #[getter]
    fn contacts(&self) -> u64 {
        self.0.contacts()
    }

    /// How many were measured.
    #[getter]
    fn matched(&self) -> u64 {
        self.0.matched()
    }

    /// How many have a force and were not measured.
    #[getter]
    fn missing(&self) -> u64 {
        self.0.missing()
    }

    /// How many pairs of bottom spheres were left out.
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
    fn largest_error(&self) -> f64 {
        self.0.largest_error()
    }

    /// The root of the mean square of the relative errors.
    #[getter]
    fn rms_error(&self) -> f64 {
        self.0.rms_error()
    }

    /// The contact with the largest error.
    #[getter]
    fn worst(&self) -> Option<Row> {
        self.0.worst().map(row)
    }

    /// The first of the missing contacts.
    fn missing_contacts(&self) -> Vec<Row> {
        self.0.missing_contacts().iter().map(row).collect()
    }

    /// How many pairs carry a force without being contacts.
    fn extra(&self, rtol: f64) -> u64 {
        self.0.extra(rtol)
    }

    /// The first pair that does, in words.
    fn worst_extra(&self) -> Option<String> {
        self.0.extra_pairs().first().map(ToString::to_string)
    }

    /// How many have a larger error.
    fn beyond(&self, rtol: f64) -> u64 {
        self.0.beyond(rtol)
    }

    /// Whether nothing is missing, extra or wrong.
    fn accepted(&self, rtol: f64) -> bool {
        self.0.accepted(rtol)
    }

    /// What the differences have in common.
    fn findings(&self, rtol: f64) -> Vec<String> {
        self.0
            .findings(rtol)
            .iter()
            .map(ToString::to_string)
            .collect()
    }

    /// One line.
    fn __str__(&self) -> String {
        self.0.to_string()
    }
}
