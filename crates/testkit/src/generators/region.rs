//! Regions, their bounds, and small piles on them. These are the core's generators under the names that the claims use.

pub use cannonpile::arbitrary::{
    Description as Described, bounds, description as described, light_description as lightly,
    light_weight as light, position_near as site_about, region, small_region,
    tiny_description as tiny, weight,
};
