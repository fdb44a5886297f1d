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
use crate::scalar::ByValue;
use crate::shape::Anchor;
use crate::stacking::Stacking;
use crate::{Error, Load, Pile};

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
    #[serde(default)]
    tilt: Tilt,
    weights: Vec<Weight>,
    loads: Vec<Loaded>,
    #[serde(default, with = "listed")]
    horizontal: BTreeMap<HorizontalContact, BigRational>,
}

/// The weight of a sphere, or the load on it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Weight {
    site: Site,
    #[serde(with = "number")]
    weight: BigRational,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Loaded {
    site: Site,
    /// The force downwards.
    #[serde(with = "number")]
    weight: BigRational,
    #[serde(default, with = "number")]
    x: BigRational,
    #[serde(default, with = "number")]
    y: BigRational,
}

/// The horizontal part of gravity.
#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Tilt {
    #[serde(with = "number")]
    x: BigRational,
    #[serde(with = "number")]
    y: BigRational,
}

impl Parts {
    fn of(pile: &Pile) -> Self {
        let weighed = |(site, weight): (Site, &BigRational)| Weight {
            site,
            weight: weight.clone(),
        };
        let loaded = |(site, load): (Site, &Load)| {
            let Load { down, x, y } = load.clone();
            Loaded {
                site,
                weight: down,
                x,
                y,
            }
        };
        let [x, y] = pile.tilt().clone();
        let (shape, loading) = (pile.shape(), &pile.loading);
        Self {
            dimension: pile.dimension(),
            sin_phi: pile.sin_phi().clone(),
            stacking: shape.stacking().clone(),
            anchor: shape.anchor(),
            weightless: loading.is_weightless(),
            tilt: Tilt { x, y },
            weights: loading.weights().map(weighed).collect(),
            loads: loading.loads().into_iter().map(loaded).collect(),
            horizontal: pile
                .horizontal_forces()
                .map(|(contact, force)| (contact, force.clone()))
                .collect(),
        }
    }

    fn pile(self) -> Result<Pile, Invalid> {
        let mut pile = self.bare()?;
        if self.weightless {
            pile = pile.weightless();
        }
        pile = pile.with_tilt([self.tilt.x, self.tilt.y])?;
        for Weight { site, weight } in self.weights {
            pile = pile.with_weight(site, weight)?;
        }
        for Loaded { site, weight, x, y } in self.loads {
            pile = pile.with_load(site, Load { down: weight, x, y })?;
        }
        for (contact, force) in self.horizontal {
            pile = pile.with_horizontal_force(contact, force)?;
        }
        Ok(pile)
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
        let given = if ByValue(pile.sin_phi()) != ByValue(&self.sin_phi) {
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
