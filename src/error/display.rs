//! The message of each error: one line, with the value and the remedy.

use alloc::string::ToString;
use core::fmt;

use exact_surd::short::numbers;

use super::Error;
use crate::geometry::{Bound, Spacing};
use crate::lattice::{Dimension, MAX_LAYERS, Site};

/// An error with its numbers at full length.
struct Whole<'a>(&'a Error);

impl fmt::Display for Whole<'_> {
    #[expect(
        clippy::too_many_lines,
        reason = "each variant has its text, and one match covers all variants"
    )]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const LONG: usize = 40;
        match self.0 {
            Error::Layers { given } => {
                let digits = MAX_LAYERS.ilog10();
                write!(
                    f,
                    "layers must be at least 1 and at most 10^{digits}, not {given}"
                )
            }
            Error::SinPhi { given } => write!(
                f,
                "sin phi must lie between 0 and 1, both excluded, not {given}; 1/2 is the equilateral base"
            ),
            Error::SiteOutside {
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
            Error::LayerOutside { layer, layers } => write!(
                f,
                "no layer {layer}: the layers run from 0 at the top to {} on the floor",
                layers - 1
            ),
            Error::OnFloor { site } => write!(
                f,
                "the sphere (i,j,k) = {site} is on the floor and has no contact below; ask for the force on the floor"
            ),
            Error::NotOnFloor { site, floor } => write!(
                f,
                "the sphere (i,j,k) = {site} does not touch the floor; spheres of layer k = {floor} do"
            ),
            Error::NoSuchDirection { direction } => write!(
                f,
                "a pile of discs has no {direction} contacts; its directions are alpha and beta"
            ),
            Error::EmptyRegion { region } => write!(
                f,
                "the region {region} has no site: its bounds must allow at least one site"
            ),
            Error::RegionTooLarge { region } => write!(
                f,
                "the region {region} reaches or grows beyond +-10^{}: use a smaller one, or fewer layers",
                MAX_LAYERS.ilog10()
            ),
            Error::RegionSide { given } => write!(
                f,
                "a side must be at least 1 and at most 10^{} spheres, not {given}",
                MAX_LAYERS.ilog10()
            ),
            Error::RunLength { given } => {
                write!(f, "a run cannot have {given} steps: use 0 or more")
            }
            Error::TooManyRuns { limit } => write!(
                f,
                "a stacking of more than {limit} runs is too long to store: use fewer sign changes"
            ),
            Error::LayersOfStacking { layers, spelled } => write!(
                f,
                "the stacking has {spelled} layers, not {layers}: leave one of the two out"
            ),
            Error::TooHigh {
                layers,
                greatest,
                base,
            } => write!(
                f,
                "{layers} layers are too many on the base {base}: with this stacking it carries at most {greatest}"
            ),
            Error::NoSuchMethod { method } => write!(
                f,
                "the method {method} does not apply to this pile: closed forms are for straight stackings, sweeps \
                 for spheres and not for discs; choose another, or none for the cheapest"
            ),
            Error::NoHorizontalContacts { sin_phi } => write!(
                f,
                "neighbours of a layer touch at a = R only if sin phi is 1/2, not {sin_phi}"
            ),
            Error::NotTouching { spacing } => write!(
                f,
                "neighbours of a layer do not touch at a/R = {spacing}: omit the spacing, or use 1"
            ),
            Error::OtherLayer { layer, at } => write!(
                f,
                "a sphere of layer {layer} is not in layer {at}: use a sphere of layer {at}"
            ),
            Error::Length { needed, given } => {
                write!(
                    f,
                    "a slice has {given} elements for {needed} forces: use a slice of {needed} elements"
                )
            }
            Error::NegativeLoad {
                quantity,
                site,
                given,
            } => write!(
                f,
                "the {quantity} of the sphere (i,j,k) = {site} must not be negative, but is {given}"
            ),
            Error::OutOfPlane { quantity } => write!(
                f,
                "the {quantity} of a pile of discs has no component along y: set it to 0"
            ),
            Error::NotPositive { quantity, given } => {
                write!(f, "{quantity} must be positive, not {given}")
            }
            Error::Overlap {
                spacing,
                apart,
                allowed,
            } => {
                write!(f, "spacing {spacing} lets spheres {apart} overlap: ")?;
                write_allowed(f, allowed)
            }
            Error::TooFlat { spacing, limit } => write!(
                f,
                "spacing {spacing} is too wide for a sphere to be supported by those below: a/R must be below {}",
                Bound {
                    spacing: limit,
                    up: false
                }
            ),
            Error::NoSpacing { sin_phi, layers } => write!(
                f,
                "no spacing keeps the spheres of {layers} layers apart at sin phi = {sin_phi}: use sin phi at most 5/6"
            ),
            Error::Overflow { quantity, scalar } => write!(
                f,
                "{quantity} does not fit in {scalar}: ask for it in exact numbers"
            ),
            Error::Misspelled {
                text,
                position,
                found,
            } => {
                write!(f, "the stacking '{text}' ")?;
                match found {
                    Some(found) => write!(f, "has {found:?} as character {position}")?,
                    None => write!(f, "ends after character {}", position - 1)?,
                }
                f.write_str(": use one notation, such as ++-+, ABCBC, chh or (2,1,1)")
            }
            Error::Number(error) => error.fmt(f),
            Error::Syntax { text, expected } => write!(f, "'{text}' is not {expected}"),
            Error::TooManyRows {
                rows,
                limit,
                remedy,
            } => {
                // For so many rows, the order of magnitude is enough.
                let digits = rows.to_string();
                if let Some(power @ LONG..) = digits.len().checked_sub(1) {
                    write!(f, "10^{power} rows and more")?;
                } else {
                    write!(f, "{digits} rows")?;
                }
                write!(f, " are too many, at most {limit}: {remedy}")
            }
            Error::TooLarge {
                quantity,
                needed,
                limit,
                remedy,
            } => write!(
                f,
                "{quantity} would take {needed} numbers, more than {limit}: {remedy}"
            ),
            Error::Interrupted => f.write_str("interrupted"),
            Error::Bug { invariant } => write!(
                f,
                "this is a bug of cannonpile: it does not hold that {invariant} (please report it)"
            ),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&numbers(&Whole(self).to_string()))
    }
}

/// Prints the bounds, as in `a/R must be at least 1 and at most 2/3*sqrt(6) = 1.632993…`.
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
        // Unreachable: an overlap breaks at least one bound.
        (None, None) => f.write_str("another"),
    }
}
