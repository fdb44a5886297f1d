//! The paper's figures, and more, as SVG.
//!
//! Most are drawn of a [`Subject`], a pile with a spacing and units, from exact answers that are rounded once. A [`Figure`]
//! is an SVG document that needs no fonts but the viewer's, and whose marks carry the numbers they stand for.
//!
//! | function | what it shows |
//! |---|---|
//! | [`pile()`] | the pile in perspective (paper, fig. 1) |
//! | [`indexing()`] | the indices of a layer (paper, fig. 2) |
//! | [`sphere()`] | the forces on one sphere (paper, fig. 3) |
//! | [`shear()`] | the shear on the floor as arrows (paper, fig. 4) |
//! | [`base()`] | the normal force on the floor as a map |
//! | [`section()`], [`layer()`] | contact forces as lines: in a vertical section, or of a layer |
//! | `bounds`, with the feature `horizontal` | what bottom spheres can bear at a = R, at least and at most |
//! | [`response()`] | what a layer feels of a load on the top |
//! | `distribution`, with the feature `ensemble` | how often forces occur over random stackings |
//! | [`ladder()`] | the errors of a code at several stiffnesses or time steps, and their order |
//! | [`mean_response()`], [`mean_profile()`] | what the floor feels of it in the mean over random stackings: as maps, and by distance |
//!
//! Axes are those of the exported files: x and y the paper's, z **up**. What is seen from above therefore has x to the right
//! and y upwards, as every program shows the files from above. In the paper z points down: its figures 2 and 4 show the
//! layer from below, and are the mirror images of these.
//!
//! # Examples
//! ```
//! use cannonpile::Pile;
//! use cannonpile::figure::{self, Subject};
//! use cannonpile::geometry::Spacing;
//! use num_rational::BigRational;
//!
//! let pile = Pile::triangular(10)?;
//! let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
//! let svg = figure::shear(&Subject::of_pile(&pile, &spacing)?)?.to_string();
//! // 54 arrows: under the apex the shear vanishes.
//! assert_eq!(svg.matches("class=\"arrow\"").count(), 54);
//! # Ok::<(), cannonpile::Error>(())
//! ```

mod base;
#[cfg(feature = "horizontal")]
mod bounds;
mod caption;
mod chart;
mod colour;
#[cfg(feature = "ensemble")]
mod distribution;
mod indexing;
mod ladder;
mod layer;
mod map;
mod mark;
mod mean;
mod network;
mod page;
mod panel;
mod pile;
mod response;
mod shear;
mod sphere;
mod subject;
mod ticks;
mod view;

pub use base::base;
#[cfg(feature = "horizontal")]
#[cfg_attr(docsrs, doc(cfg(feature = "horizontal")))]
pub use bounds::bounds;
#[cfg(feature = "ensemble")]
#[cfg_attr(docsrs, doc(cfg(feature = "ensemble")))]
pub use distribution::distribution;
pub use indexing::indexing;
pub use ladder::ladder;
pub use mean::{mean_profile, mean_response};
pub use network::{layer, section};
pub use page::{Figure, Layout};
pub use pile::pile;
pub use response::{of_unit_load, response};
pub use shear::shear;
pub use sphere::{example, sphere};
pub use subject::Subject;
