//! The census of stable stackings.

use std::sync::{Mutex, PoisonError};

use cannonpile::Standing;
use cannonpile::lattice::Region;
use cannonpile_dem::scene::parse;
use num_bigint::BigInt;
use num_rational::BigRational;
use pyo3::prelude::*;

use crate::error::Error;
use crate::exception::Raised;
use crate::input::read;
use crate::work::work;

/// The result for one stacking.
struct Entry {
    pile: cannonpile::Pile,
    stands: bool,
}

/// An entry: stacking, layers, stability, smallest contact force, the smallest and largest normal force of its base, and
/// the squared margin.
type Row = (
    String,
    BigInt,
    bool,
    Option<BigRational>,
    Option<BigRational>,
    Option<BigRational>,
    Option<BigRational>,
);

/// For taller piles with sign changes the range of base normal forces is not computed.
const MAX_CHECKED_LAYERS: i128 = 100_000;

/// An iterator over stackings.
#[pyclass(frozen, module = "cannonpile._cannonpile")]
pub(crate) struct Census {
    entries: Mutex<Box<dyn Iterator<Item = Result<Entry, Error>> + Send>>,
    failing: bool,
}

#[pymethods]
impl Census {
    fn __iter__(slf: PyRef<'_, Self>) -> PyRef<'_, Self> {
        slf
    }

    fn __next__(&self, py: Python<'_>) -> PyResult<Option<Row>> {
        work(py, || {
            // After a panic in another thread the iterator continues with the remaining entries.
            let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
            for entry in entries.by_ref() {
                let entry = entry?;
                if entry.stands || self.failing {
                    return entry.row().map(Some);
                }
            }
            Ok::<_, Error>(None)
        })
    }
}

impl Entry {
    fn row(&self) -> Result<Row, Error> {
        let pile = &self.pile;
        let shape = pile.shape();
        let stacking = if shape.is_grown_from_base() {
            shape.stacking().reversed()
        } else {
            shape.stacking().clone()
        };
        let standing = unless_too_large(pile.standing())?;
        let least = standing
            .as_ref()
            .and_then(|standing: &Standing| standing.least.clone());
        let stands = standing.is_some_and(|standing| standing.first_failure.is_none());
        let is_tall = pile.layers() > MAX_CHECKED_LAYERS && stacking.changes() > 0;
        let base = if stands && !is_tall {
            unless_too_large(pile.base_extremes())?
        } else {
            None
        };
        let margin = if stands { margin(pile)? } else { None };
        let (normal_min, normal_max) = base.map(|base| (base.normal_min, base.normal_max)).unzip();
        Ok((
            stacking.to_string(),
            pile.layers().into(),
            self.stands,
            least.map(|contact| contact.force),
            normal_min,
            normal_max,
            margin,
        ))
    }
}

/// Returns the squared margin of a pile, or `None` for a single layer or a pile that is too large.
fn margin(pile: &cannonpile::Pile) -> Result<Option<BigRational>, Error> {
    use cannonpile_stability::Error as Refused;

    match cannonpile_stability::margin(pile) {
        Err(Refused::NoWeight | Refused::Core(cannonpile::Error::TooLarge { .. })) => Ok(None),
        margin => Ok(margin?.map(|margin| margin.squared)),
    }
}

fn unless_too_large<T>(answer: Result<T, cannonpile::Error>) -> Result<Option<T>, Error> {
    match answer {
        Err(cannonpile::Error::TooLarge { .. }) => Ok(None),
        answer => Ok(answer.map(Some)?),
    }
}

/// Return the stackings of a given number of layers under one sphere, or on a base, with or without horizontal
/// contacts.
///
/// Unless only the `standing` ones are requested, the shortest unstable prefixes are included.
#[pyfunction]
pub(crate) fn census(
    layers: &str,
    base: Option<&str>,
    standing: bool,
    horizontal: bool,
) -> PyResult<Census> {
    let layers = read("layers", layers, parse::layers)?;
    let base = base
        .map(|base| read("base", base, str::parse::<Region>))
        .transpose()?;
    let entries = if horizontal {
        with_horizontal_contacts(layers, base, !standing)
    } else {
        without_horizontal_contacts(layers, base, !standing)
    };
    Ok(Census {
        entries: Mutex::new(entries.map_err(|error| Raised::from(error).into_exception())?),
        failing: !standing,
    })
}

type Entries = Box<dyn Iterator<Item = Result<Entry, Error>> + Send>;

fn without_horizontal_contacts(
    layers: i128,
    base: Option<Region>,
    failing: bool,
) -> Result<Entries, Error> {
    use cannonpile_stability::census;
    let entry = |entry: Result<census::Entry, cannonpile::Error>| {
        let entry = entry?;
        Ok(Entry {
            stands: entry.stands(),
            pile: entry.pile,
        })
    };
    Ok(match base {
        Some(base) => Box::new(census::on_base(base)?.map(entry)),
        None => Box::new(census::under_one_sphere(layers, failing)?.map(entry)),
    })
}

fn with_horizontal_contacts(
    layers: i128,
    base: Option<Region>,
    failing: bool,
) -> Result<Entries, Error> {
    use cannonpile_horizontal::census;
    let entry = |entry: Result<census::Entry, cannonpile_horizontal::Error>| {
        let entry = entry?;
        Ok(Entry {
            stands: entry.stands(),
            pile: entry.pile,
        })
    };
    Ok(match base {
        Some(base) => Box::new(census::on_base(base)?.map(entry)),
        None => Box::new(census::under_one_sphere(layers, failing)?.map(entry)),
    })
}
