//! The paper's figures, and more, as SVG.
//!
//! Each figure of a pile is computed from a [`Subject`], a pile with a spacing and units, as plain numbers: exact answers, rounded
//! once. Its `drawing` is a [`Drawing`], an SVG document that needs no fonts but the viewer's.
//!
//! | figure | what it shows |
//! |---|---|
//! | [`Picture`] | the pile in perspective (paper, fig. 1) |
//! | [`Indexing`] | the indices of a layer (paper, fig. 2) |
//! | [`SphereForces`] | the forces on one sphere (paper, fig. 3) |
//! | [`Shear`] | the shear on the floor as arrows (paper, fig. 4) |
//! | [`BaseMap`] | the normal force on the floor as a map |
//! | [`Network`] | contact forces as lines: a vertical section, or a layer |
//! | [`Response`] | what a layer feels of a load on the top |
//! | [`WorkPrecision`] | measured run times against errors |
//!
//! # Examples
//! ```
//! use cannonpile::Pile;
//! use cannonpile::figure::{Shear, Subject};
//! use cannonpile::geometry::Spacing;
//! use num_rational::BigRational;
//!
//! let pile = Pile::triangular(10)?;
//! let spacing = Spacing::new(BigRational::new(6.into(), 5.into()))?;
//! let svg = Shear::new(&Subject::of_pile(&pile, &spacing)?)?.drawing().to_string();
//! // 54 arrows: under the apex the shear vanishes.
//! assert_eq!(svg.matches("class=\"arrow\"").count(), 54);
//! # Ok::<(), cannonpile::Error>(())
//! ```

mod base;
mod canvas;
mod cells;
mod colour;
mod indexing;
mod label;
mod layer;
mod network;
mod panel;
mod picture;
mod response;
mod shear;
mod sphere;
mod subject;
mod ticks;
mod view;
mod work_precision;

pub use base::BaseMap;
pub use canvas::Drawing;
pub use cells::MapCell;
pub use colour::{Colour, Scale};
pub use indexing::Indexing;
pub use network::{Link, Network};
pub use picture::{Picture, PictureSphere};
pub use response::Response;
pub use shear::{Shear, ShearArrow};
pub use sphere::{SphereForce, SphereForces};
pub use subject::Subject;
pub use work_precision::{MeasuredRun, WorkPrecision};

use svg::Node;

use crate::lattice::Site;

/// The same mark, with the indices of the sphere it stands for.
fn of<N: Node>(site: Site, mut mark: N) -> N {
    for (name, index) in [("data-k", site.k), ("data-i", site.i), ("data-j", site.j)] {
        mark.assign(name, index.to_string());
    }
    mark
}
