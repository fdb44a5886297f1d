//! The kinds of figures.

use cannonpile::Pile;
use cannonpile::lattice::Site;
use cannonpile_figure as figure;
use cannonpile_figure::{Error, Figure, Subject};
use pyo3::PyResult;
use pyo3::exceptions::PyValueError;

/// A kind of figure of a pile.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    Pile,
    Indexing,
    Sphere,
    Shear,
    Base,
    Bounds,
    Network,
    Response,
}

/// The layer of the index figure, as in the paper.
const INDEXED: i128 = 3;

impl Kind {
    pub(crate) fn named(name: &str) -> PyResult<Self> {
        Ok(match name {
            "pile" => Self::Pile,
            "indexing" => Self::Indexing,
            "sphere" => Self::Sphere,
            "shear" => Self::Shear,
            "base" => Self::Base,
            "bounds" => Self::Bounds,
            "network" => Self::Network,
            "response" => Self::Response,
            _ => {
                return Err(PyValueError::new_err(format!(
                    "kind: '{name}' is not one of pile, indexing, sphere, shear, base, bounds, network, response"
                )));
            }
        })
    }

    /// Draws the figure, for a layer or a sphere if the kind has one.
    pub(crate) fn draw(
        self,
        (subject, pile): (&Subject<'_>, &Pile),
        layer: Option<i128>,
        site: Option<Site>,
    ) -> Result<Figure, Error> {
        let last = pile.layers() - 1;
        match self {
            Self::Pile => figure::pile(subject),
            Self::Indexing => figure::indexing(subject, layer.unwrap_or(INDEXED.min(last))),
            Self::Sphere => {
                let site = site.map_or_else(|| figure::example_site(pile), Ok)?;
                figure::sphere(subject, site)
            }
            Self::Shear => figure::shear(subject),
            Self::Base => figure::base(subject),
            Self::Bounds => figure::bounds(subject),
            Self::Network => match layer {
                Some(k) => figure::layer(subject, k),
                None => figure::section(subject),
            },
            Self::Response => figure::response(subject, layer.unwrap_or(last)),
        }
    }
}
