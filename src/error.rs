//! What can be wrong with a question: one enum, each variant with the numbers and the remedy.

use alloc::boxed::Box;
use alloc::string::String;
use core::fmt;

use num_bigint::{BigInt, BigUint};
use num_rational::BigRational;

use crate::geometry::{Apart, Bound, Spacing};
use crate::lattice::{Dimension, Direction, MAX_LAYERS, Region, Site};

/// Why a pile, a site, a geometry or a number was refused.
///
/// The message is one line, names the value and says what would be accepted.
///
/// # Examples
/// ```
/// let error = cannonpile::Pile::triangular(0).unwrap_err();
/// assert_eq!(error.to_string(), "layers must be at least 1 and at most 10^36, not 0");
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// The number of layers is not between 1 and [`MAX_LAYERS`].
    Layers {
        /// The number asked for.
        given: BigInt,
    },
    /// sin φ is not strictly between 0 and 1.
    SinPhi {
        /// The value asked for.
        given: BigRational,
    },
    /// sin φ was given for a pile of discs, which has none.
    SinPhiOfDiscs,
    /// The pile has no such site.
    SiteOutside {
        /// The site asked for.
        site: Site,
        /// The layers of the pile.
        layers: i128,
        /// Discs or spheres.
        dimension: Dimension,
        /// The sites of that layer, if the pile has it and is not a straight one under one sphere.
        region: Option<Box<Region>>,
    },
    /// The pile has no such layer.
    LayerOutside {
        /// The layer asked for.
        layer: i128,
        /// The layers of the pile.
        layers: i128,
    },
    /// A contact below a sphere of the bottom layer: it rests on the floor.
    OnFloor {
        /// The sphere asked for.
        site: Site,
    },
    /// A force on the floor from a sphere that does not touch it.
    NotOnFloor {
        /// The sphere asked for.
        site: Site,
        /// The bottom layer.
        floor: i128,
    },
    /// A pile of discs has no contacts in this direction.
    NoSuchDirection {
        /// The direction asked for.
        direction: Direction,
    },
    /// A region of the lattice without a site.
    EmptyRegion {
        /// The region as it was asked for.
        region: Box<Region>,
    },
    /// A region whose coordinates leave ±10³⁶.
    RegionTooLarge {
        /// The region, or the one that was to grow.
        region: Box<Region>,
    },
    /// The side of a triangle or hexagon is not between 1 and 10³⁶.
    RegionSide {
        /// The side asked for.
        given: i128,
    },
    /// A run of a stacking has a negative length.
    RunLength {
        /// The length asked for.
        given: i128,
    },
    /// A stacking changes its sign too often to be kept.
    TooManyRuns {
        /// The most runs.
        limit: usize,
    },
    /// A stacking that is spelled out, and another number of layers.
    LayersOfStacking {
        /// The number of layers asked for.
        layers: i128,
        /// The layers of the stacking.
        spelled: i128,
    },
    /// No site is left on a base before all layers are there.
    TooHigh {
        /// The layers asked for.
        layers: i128,
        /// The most there are.
        greatest: i128,
        /// The base.
        base: Box<Region>,
    },
    /// A weight or load that is negative.
    NegativeLoad {
        /// `load` or `weight`.
        quantity: &'static str,
        /// The sphere.
        site: Site,
        /// The value asked for.
        given: Box<BigRational>,
    },
    /// Two options of a scene that exclude each other.
    Excluded {
        /// The one.
        given: &'static str,
        /// The other.
        beside: &'static str,
    },
    /// An answer that would take more memory than is sensible.
    TooLarge {
        /// What would be computed.
        quantity: &'static str,
        /// How many numbers it would keep.
        needed: BigUint,
        /// How many are allowed.
        limit: u64,
        /// The narrower question.
        remedy: &'static str,
    },
    /// A length, mass, gravity or spacing that is not positive.
    NotPositive {
        /// What it is.
        quantity: &'static str,
        /// The value asked for.
        given: BigRational,
    },
    /// Spheres would overlap at this spacing.
    Overlap {
        /// The spacing asked for.
        spacing: Box<Spacing>,
        /// Which spheres overlap.
        apart: Apart,
        /// The least and the greatest spacing allowed, where there is one.
        allowed: Box<(Option<Spacing>, Option<Spacing>)>,
    },
    /// The contacts would be horizontal, or no contacts at all.
    TooFlat {
        /// The spacing asked for.
        spacing: Box<Spacing>,
        /// What it must stay below.
        limit: Box<Spacing>,
    },
    /// No spacing at all keeps the spheres of this pile apart.
    NoSpacing {
        /// sin φ of the pile.
        sin_phi: BigRational,
        /// The layers of the pile.
        layers: i128,
    },
    /// An answer does not fit the number type asked for.
    Overflow {
        /// What was asked for.
        quantity: &'static str,
        /// The number type.
        scalar: &'static str,
    },
    /// The root of a negative number.
    NegativeRadicand {
        /// The number.
        given: BigRational,
    },
    /// A text that is not what was expected.
    Syntax {
        /// The text, shortened if it is long.
        text: String,
        /// What was expected, with an example.
        expected: &'static str,
    },
    /// More rows than anybody can read.
    TooManyRows {
        /// How many there would be.
        rows: BigUint,
        /// How many are allowed.
        limit: u64,
        /// The narrower question.
        remedy: &'static str,
    },
}

impl Error {
    pub(crate) fn overlap(
        spacing: &Spacing,
        apart: Apart,
        allowed: (Option<Spacing>, Option<Spacing>),
    ) -> Self {
        Self::Overlap {
            spacing: Box::new(spacing.clone()),
            apart,
            allowed: Box::new(allowed),
        }
    }

    /// A syntax error that quotes `text`, cut where it gets long.
    pub(crate) fn syntax(text: &str, expected: &'static str) -> Self {
        const LONGEST: usize = 60;
        let mut quoted: String = text
            .chars()
            .take(LONGEST)
            .flat_map(char::escape_debug)
            .collect();
        if text.chars().nth(LONGEST).is_some() {
            quoted.push('…');
        }
        Self::Syntax {
            text: quoted,
            expected,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Layers { given } => {
                let digits = MAX_LAYERS.ilog10();
                write!(
                    f,
                    "layers must be at least 1 and at most 10^{digits}, not {given}"
                )
            }
            Self::SinPhi { given } => write!(
                f,
                "sin phi must lie between 0 and 1, both excluded, not {given}; 1/2 is the equilateral base"
            ),
            Self::SinPhiOfDiscs => {
                f.write_str("a pile of discs has no sin phi: leave it out, or use dimension 3")
            }
            Self::SiteOutside {
                site,
                layers,
                dimension,
                region,
            } => {
                if let Some(region) = region {
                    let Site { i, j, k } = site;
                    return write!(
                        f,
                        "no sphere at k={k}, i={i}, j={j}: layer {k} has the sites {region} of i, j and i+j"
                    );
                }
                let sites = match dimension {
                    Dimension::Two => "0 <= i <= k, j = 0",
                    Dimension::Three => "0 <= j <= k, 0 <= i <= k-j",
                };
                let Site { i, j, k } = site;
                write!(
                    f,
                    "no sphere at k={k}, i={i}, j={j}: the pile has the sites 0 <= k <= {}, {sites}",
                    layers - 1
                )
            }
            Self::LayerOutside { layer, layers } => write!(
                f,
                "no layer {layer}: the layers run from 0 at the top to {} on the floor",
                layers - 1
            ),
            Self::OnFloor { site } => write!(
                f,
                "the sphere (i,j,k) = {site} rests on the floor and has no contact below; ask for the force on the floor"
            ),
            Self::NotOnFloor { site, floor } => write!(
                f,
                "the sphere (i,j,k) = {site} does not touch the floor; spheres of layer k = {floor} do"
            ),
            Self::NoSuchDirection { direction } => write!(
                f,
                "a pile of discs has no {direction} contacts; its directions are alpha and beta"
            ),
            _ => self.fmt_shape(f),
        }
    }
}

impl Error {
    /// Errors of the shape of a pile: regions, stackings, loads.
    fn fmt_shape(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::EmptyRegion { region } => write!(
                f,
                "the region {region} has no site: its bounds must leave some i, j and i+j"
            ),
            Self::RegionTooLarge { region } => write!(
                f,
                "the region {region} reaches beyond +-10^{}: use a smaller one, or fewer layers",
                MAX_LAYERS.ilog10()
            ),
            Self::RegionSide { given } => write!(
                f,
                "a side must be at least 1 and at most 10^{} spheres, not {given}",
                MAX_LAYERS.ilog10()
            ),
            Self::RunLength { given } => {
                write!(f, "a run of a stacking has at least 1 step, not {given}")
            }
            Self::TooManyRuns { limit } => write!(
                f,
                "a stacking of more than {limit} runs is too long to keep: use fewer sign changes"
            ),
            Self::LayersOfStacking { layers, spelled } => write!(
                f,
                "the stacking has {spelled} layers, not {layers}: leave one of the two out"
            ),
            Self::TooHigh {
                layers,
                greatest,
                base,
            } => write!(
                f,
                "{layers} layers are too many on the base {base}: with this stacking it carries at most {greatest}"
            ),
            Self::NegativeLoad {
                quantity,
                site,
                given,
            } => write!(
                f,
                "the {quantity} of sphere {site} must not be negative, but is {given}"
            ),
            _ => self.fmt_rest(f),
        }
    }

    /// Errors of sizes, numbers and texts.
    fn fmt_rest(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotPositive { quantity, given } => {
                write!(f, "{quantity} must be positive, not {given}")
            }
            Self::Overlap {
                spacing,
                apart,
                allowed,
            } => {
                write!(f, "spacing {spacing} lets spheres {apart} overlap: ")?;
                write_allowed(f, allowed)
            }
            Self::TooFlat { spacing, limit } => write!(
                f,
                "spacing {spacing} is too wide for a sphere to rest on those below: a/R must be below {}",
                Bound {
                    spacing: limit,
                    up: false
                }
            ),
            Self::NoSpacing { sin_phi, layers } => write!(
                f,
                "no spacing keeps the spheres of {layers} layers apart at sin phi = {sin_phi}: use sin phi at most 5/6"
            ),
            Self::Overflow { quantity, scalar } => write!(
                f,
                "{quantity} does not fit in {scalar}: ask for it in exact numbers"
            ),
            Self::NegativeRadicand { given } => {
                write!(
                    f,
                    "the root of {given} is not real: the radicand must not be negative"
                )
            }
            Self::Syntax { text, expected } => write!(f, "'{text}' is not {expected}"),
            Self::TooManyRows {
                rows,
                limit,
                remedy,
            } => {
                write!(
                    f,
                    "{rows} rows are too many to print, at most {limit}: {remedy}"
                )
            }
            Self::Excluded { given, beside } => write!(
                f,
                "{given} has no meaning beside {beside}: leave one of the two out"
            ),
            Self::TooLarge {
                quantity,
                needed,
                limit,
                remedy,
            } => write!(
                f,
                "{quantity} would keep {needed} numbers, at most {limit}: {remedy}"
            ),
            // Every variant has its text in one of the three.
            _ => write!(f, "{self:?}"),
        }
    }
}

/// `a/R must be at least 1 and at most 2/3*sqrt(6) = 1.632993…`.
fn write_allowed(
    f: &mut fmt::Formatter<'_>,
    (least, most): &(Option<Spacing>, Option<Spacing>),
) -> fmt::Result {
    let bound = |spacing, up| Bound { spacing, up };
    f.write_str("a/R must be ")?;
    match (least, most) {
        (Some(least), Some(most)) => {
            let (least, most) = (bound(least, true), bound(most, false));
            write!(f, "at least {least} and at most {most}")
        }
        (Some(least), None) => write!(f, "at least {}", bound(least, true)),
        (None, Some(most)) => write!(f, "at most {}", bound(most, false)),
        // Something set the bound that was broken.
        (None, None) => f.write_str("another"),
    }
}

impl core::error::Error for Error {}
