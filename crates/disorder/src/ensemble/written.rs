//! An ensemble and which stackings of it are looked at, as what they are made of, and made of it again by the checked
//! constructors.

use cannonpile::data::{as_text, number};
use cannonpile::lattice::Region;
use num_rational::BigRational;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Choice, Ensemble, Samples};
use crate::Error;
use crate::{FirstSign, RandomStackings};

as_text!(FirstSign);

#[derive(Serialize, Deserialize)]
#[serde(rename = "Ensemble", deny_unknown_fields)]
struct Parts {
    #[serde(with = "number")]
    layers: i128,
    first: FirstSign,
    top: Region,
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

impl Parts {
    fn of(ensemble: &Ensemble) -> Self {
        let stackings = ensemble.stackings();
        let loads = ensemble.top().loads().map(|(site, weight)| Load {
            i: site.i,
            j: site.j,
            weight: weight.clone(),
        });
        Self {
            layers: stackings.layers(),
            first: stackings.first(),
            top: ensemble.top().shape().base(),
            loads: loads.collect(),
            weightless: ensemble.top().is_weightless(),
            horizontal_contacts: ensemble.has_horizontal_contacts(),
            bins: ensemble.bins().clone(),
        }
    }

    fn ensemble(self) -> Result<Ensemble, Error> {
        let stackings = RandomStackings::new(self.layers, self.first)?;
        let mut ensemble = Ensemble::under(self.top, stackings)?.with_bins(self.bins)?;
        for Load { i, j, weight } in self.loads {
            ensemble = ensemble.with_load([i, j], weight)?;
        }
        if self.weightless {
            ensemble = ensemble.weightless();
        }
        if self.horizontal_contacts {
            ensemble = ensemble.with_horizontal_contacts()?;
        }
        Ok(ensemble)
    }
}

impl Serialize for Ensemble {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Parts::of(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Ensemble {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let parts = Parts::deserialize(deserializer)?;
        parts.ensemble().map_err(D::Error::custom)
    }
}

#[derive(Serialize, Deserialize)]
#[serde(rename = "Choice", rename_all = "lowercase", deny_unknown_fields)]
enum Chosen {
    All,
    Drawn {
        samples: u64,
        seed: u64,
        #[serde(with = "number")]
        fault_probability: BigRational,
    },
}

impl Serialize for Choice {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let chosen = match self {
            Self::All => Chosen::All,
            Self::Drawn(samples) => Chosen::Drawn {
                samples: samples.count(),
                seed: samples.seed(),
                fault_probability: samples.fault_probability().clone(),
            },
        };
        chosen.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Choice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(match Chosen::deserialize(deserializer)? {
            Chosen::All => Self::All,
            Chosen::Drawn {
                samples,
                seed,
                fault_probability,
            } => {
                let samples = Samples::new(samples, seed, fault_probability);
                Self::Drawn(samples.map_err(D::Error::custom)?)
            }
        })
    }
}
