//! Figures of sphere piles as SVG, and an interactive HTML viewer.
//!
//! A [`Subject`] is a pile with a spacing and units. The functions below draw it from exact forces, which are rounded once.
//! The result is a [`Figure`]: an SVG document whose glyphs have their values as attributes. It embeds no fonts.
//!
//! # Examples
//! ```
//! use cannonpile::Pile;
//! use cannonpile::geometry::Spacing;
//! use cannonpile_figure::Subject;
//! use num_rational::BigRational;
//!
//! let pile = Pile::triangular(10)?;
//! let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
//! let svg = cannonpile_figure::shear(&Subject::of_pile(&pile, &spacing)?)?.to_string();
//! // 54 arrows for 55 spheres: the shear force under the apex is zero.
//! assert_eq!(svg.matches("class=\"arrow\"").count(), 54);
//! # Ok::<(), cannonpile_figure::Error>(())
//! ```
//!
//! # Map
//! | item | contents |
//! |---|---|
//! | [`pile()`] | the pile in perspective (paper, fig. 1) |
//! | [`indexing()`] | the indices of a layer (paper, fig. 2) |
//! | [`sphere()`] | the forces on one sphere (paper, fig. 3) |
//! | [`shear()`] | the base shear forces as arrows (paper, fig. 4) |
//! | [`friction()`] | the forces on a lower sphere of two layers on a rough floor |
//! | [`base()`] | the base normal forces as a map |
//! | [`section()`], [`layer()`] | contact forces as lines: in a vertical section, or of a layer |
//! | [`bounds()`] | the smallest and largest normal force of each bottom sphere at a = R |
//! | [`stability()`] | the tilts of gravity that a pile bears |
//! | [`response()`] | the forces in a layer under a load on the top |
//! | [`mean_response()`], [`mean_profile()`] | the mean response of the base over random stackings: as maps, and by distance |
//! | [`distribution()`] | the distribution of contact forces or base normal forces over random stackings |
//! | [`viewer`] | an HTML viewer of the pile and its forces |
//! | [`Error`] | the errors of this crate |
//!
//! # Axes
//! The axes are those of the files that `cannonpile-dem` exports: x and y as in the paper, z **up**. A view from above
//! has x to the right and y upwards. In the paper z points down, so its figures 2 and 4 show a layer from below. They
//! are mirror images of the figures here.
//!
//! # Features
//! `rayon` uses all cores.

mod base;
mod bounds;
mod caption;
mod chart;
mod colour;
mod distribution;
mod error;
mod friction;
mod glyph;
mod indexing;
mod layer;
mod map;
mod mean;
mod network;
mod page;
mod panel;
mod pile;
mod response;
mod shear;
mod sphere;
mod stability;
mod subject;
mod ticks;
mod view;
pub mod viewer;

pub use base::base;
pub use bounds::bounds;
pub use distribution::distribution;
pub use error::Error;
pub use friction::friction;
pub use indexing::indexing;
pub use mean::{mean_profile, mean_response};
pub use network::{layer, section};
pub use page::{Figure, Layout};
pub use pile::pile;
pub use response::{response, with_load_on_top};
pub use shear::shear;
pub use sphere::{example_site, sphere};
pub use stability::stability;
pub use subject::Subject;

/// The examples of README.md, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
