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
        })
    }

    /// Compares the measurement with the exact forces.
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
