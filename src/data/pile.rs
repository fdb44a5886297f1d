//! Serialisation of a pile as its parts. The checked constructors build it again.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::vec::Vec;
use core::fmt;

use ::serde::de::Error as _;
use ::serde::{Deserialize, Deserializer, Serialize, Serializer};
use num_rational::BigRational;

use super::listed;
use crate::data::number;
use crate::lattice::{Dimension, HorizontalContact, Region, Site};
use crate::shape::Anchor;
use crate::stacking::Stacking;
use crate::{Error, Pile};

#[derive(Serialize, Deserialize)]
#[serde(rename = "Pile", deny_unknown_fields)]
struct Parts {
    dimension: Dimension,
    #[serde(with = "number")]
    sin_phi: BigRational,
    /// The stacking from the top, for both anchors.
    stacking: Stacking,
    anchor: Anchor,
    weightless: bool,
    weights: Vec<OnSite>,
    loads: Vec<OnSite>,
    #[serde(default, with = "listed")]
    horizontal: BTreeMap<HorizontalContact, BigRational>,
}

/// The weight of a sphere, or the load on it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct OnSite {
    site: Site,
    #[serde(with = "number")]
    weight: BigRational,
}

impl Parts {
    fn of(pile: &Pile) -> Self {
        let on_sites = |(site, weight): (Site, &BigRational)| OnSite {
            site,
            weight: weight.clone(),
        };
        let (shape, loading) = (pile.shape(), pile.loading());
        Self {
            dimension: pile.dimension(),
            sin_phi: pile.sin_phi().clone(),
            stacking: shape.stacking().clone(),
            anchor: shape.anchor(),
            weightless: loading.is_weightless(),
            weights: loading.weights().map(on_sites).collect(),
            loads: loading.loads().map(on_sites).collect(),
            horizontal: loading.horizontal().map(|(c, f)| (c, f.clone())).collect(),
        }
    }

    fn pile(self) -> Result<Pile, Invalid> {
        let mut pile = self.bare()?;
        for OnSite { site, weight } in self.weights {
            pile = pile.with_weight(site, weight)?;
        }
        for OnSite { site, weight } in self.loads {
            pile = pile.with_load(site, weight)?;
        }
        for (contact, force) in self.horizontal {
            pile = pile.with_horizontal_force(contact, force)?;
        }
        Ok(if self.weightless {
            pile.weightless()
        } else {
            pile
        })
    }

    /// Returns the pile without weights, loads and horizontal forces.
    fn bare(&self) -> Result<Pile, Invalid> {
        let layers = self.stacking.layers();
        let pile = match (self.dimension, self.anchor) {
            (Dimension::Two, _) => Pile::discs(layers)?,
            (Dimension::Three, Anchor::Top(Region::SITE))
                if self.stacking.name() == Some("fcc") =>
            {
                Pile::isosceles(layers, self.sin_phi.clone())?
            }
            (Dimension::Three, Anchor::Top(top)) => Pile::under(top, self.stacking.clone())?,
            (Dimension::Three, Anchor::Base(base)) => Pile::on(base, self.stacking.clone())?,
        };
        // Piles of discs allow only one stacking and top, and most piles of spheres only sin φ = 1/2. Other values are
        // errors.
        let given = if pile.sin_phi() != &self.sin_phi {
            "sin-phi"
        } else if pile.shape().stacking() != &self.stacking {
            "stacking"
        } else if pile.shape().anchor() != self.anchor {
            "top"
        } else {
            return Ok(pile);
        };
        let other = match self.dimension {
            Dimension::Two => "dimension 2",
            Dimension::Three => "stacking",
        };
        Err(Invalid::Excluded { given, other })
    }
}

/// The reason why parts do not form a pile.
enum Invalid {
    Core(Error),
    Excluded {
        given: &'static str,
        other: &'static str,
    },
}

impl From<Error> for Invalid {
    fn from(error: Error) -> Self {
        Self::Core(error)
    }
}

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Core(error) => error.fmt(f),
            Self::Excluded { given, other } => write!(
                f,
                "{given} has no meaning with {other}: leave one of the two out"
            ),
        }
    }
}

impl Serialize for Pile {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Parts::of(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Pile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let parts = Parts::deserialize(deserializer)?;
        // Otherwise one of the two weights would be ignored silently.
        let mut sites: Vec<Site> = parts.weights.iter().map(|weight| weight.site).collect();
        sites.sort_unstable();
        let mut pairs = sites.iter().zip(sites.iter().skip(1));
        if let Some((site, _)) = pairs.find(|(one, next)| one == next) {
            return Err(D::Error::custom(format!(
                "two weights of the sphere (i,j,k) = {site}: leave one of them out"
            )));
        }
        parts.pile().map_err(D::Error::custom)
    }
}
