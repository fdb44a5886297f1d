//! The serialised form of an ensemble. Reading calls the checked constructors.

use cannonpile::data::{as_text, number};
use cannonpile::lattice::Region;
use cannonpile::shape::Anchor;
use num_rational::BigRational;
use serde::{Deserialize, Serialize};

use super::Ensemble;
use crate::Error;
use crate::{FirstSign, RandomStackings};

as_text!(FirstSign);

/// The serialised form of an [`Ensemble`]. It has either a top or a base.
#[derive(Serialize, Deserialize)]
#[serde(rename = "Ensemble", deny_unknown_fields)]
pub(super) struct EnsembleParts {
    #[serde(with = "number")]
    layers: i128,
    first: FirstSign,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    top: Option<Region>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    base: Option<Region>,
    loads: Vec<Load>,
    weightless: bool,
    horizontal_contacts: bool,
    #[serde(with = "number")]
    bins: BigRational,
}

/// A load on a sphere of the top layer.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Load {
    #[serde(with = "number")]
    i: i128,
    #[serde(with = "number")]
    j: i128,
    #[serde(with = "number")]
    weight: BigRational,
}

impl From<Ensemble> for EnsembleParts {
    fn from(ensemble: Ensemble) -> Self {
        let (top, base) = match ensemble.anchor() {
            Anchor::Top(top) => (Some(top), None),
            Anchor::Base(base) => (None, Some(base)),
        };
        let loads = ensemble.layer.loads().map(|(site, weight)| Load {
            i: site.i,
            j: site.j,
            weight: weight.down.clone(),
        });
        Self {
            layers: ensemble.stackings().layers(),
            first: ensemble.stackings().first(),
            top,
            base,
            loads: loads.collect(),
            weightless: ensemble.layer.is_weightless(),
            horizontal_contacts: ensemble.has_horizontal_contacts(),
            bins: ensemble.bin_width().clone(),
        }
    }
}

impl TryFrom<EnsembleParts> for Ensemble {
    type Error = Error;

    fn try_from(parts: EnsembleParts) -> Result<Self, Error> {
        let stackings = RandomStackings::new(parts.layers, parts.first)?;
        let ensemble = match (parts.top, parts.base) {
            (Some(top), None) => Self::under(top, stackings)?,
            (None, Some(base)) => Self::on(base, stackings)?,
            (Some(_), Some(_)) => return Err(Error::syntax("top, base", EXPECTED)),
            (None, None) => return Err(Error::syntax("", EXPECTED)),
        };
        let mut ensemble = ensemble.with_bin_width(parts.bins)?;
        for Load { i, j, weight } in parts.loads {
            ensemble = ensemble.with_load([i, j], weight)?;
        }
        if parts.weightless {
            ensemble = ensemble.weightless();
        }
        if parts.horizontal_contacts {
            ensemble = ensemble.with_horizontal_contacts()?;
        }
        Ok(ensemble)
    }
}

const EXPECTED: &str = "one layer: either a top or a base";
