//! Regions, their bounds, and small piles on them: the generators of the core, by the names of the claims.

pub use cannonpile::arbitrary::{
    Description as Described, bounds, description as described, light_description as lightly,
    light_weight as light, position_near as site_about, region, small_region,
    tiny_description as tiny, weight,
};
