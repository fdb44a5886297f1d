//! The caption of a figure: layers, stacking, loads and spacing of the pile.

use cannonpile::{Load, Pile};
use cannonpile_dem::{anchor, brief, stacking};
use num_bigint::{BigInt, BigUint};
use num_traits::{One, Zero};

use super::subject::{Subject, spacing};
use crate::Error;

/// Returns the caption.
pub(super) fn caption(subject: &Subject<'_>) -> Result<String, Error> {
    let pile = subject.pile();
    let discs = subject.is_of_discs();
    let mut parts = vec![counted(&pile.layers().into(), "layer")];
    if discs {
        parts.push("discs".into());
    } else {
        parts.extend(stacking(pile));
        parts.extend(anchor(pile.shape()));
    }
    if !pile.is_regular() && !discs {
        let s = pile.sin_phi().to_string();
        parts.push(format!("sin φ = {}", brief(&s, 20)));
    }
    if pile.is_weightless() {
        parts.push("spheres without weight".into());
    }
    if let Some(tilt) = tilt(pile) {
        parts.push(brief(&tilt, 30));
    }
    let mut loads = pile.loads();
    match (loads.len(), loads.next()) {
        (0, _) | (_, None) => {}
        (1, Some((site, load))) => {
            let place = format!("{},{}", site.k, subject.indices(site));
            parts.push(brief(&of_load(load, &place), 20));
        }
        (count, _) => parts.push(counted(&count.into(), "load")),
    }
    parts.extend(subject.horizontal_state());
    let spacing = spacing(subject.packing())?.ratio().to_string();
    parts.push(format!("a/R = {}", brief(&spacing, 20)));
    Ok(parts.join(", "))
}

/// Returns the tilt of gravity as text, or `None` for upright gravity.
pub(super) fn tilt(pile: &Pile) -> Option<String> {
    let [x, y] = pile.tilt();
    (!x.is_zero() || !y.is_zero()).then(|| format!("gravity tilted by ({x}, {y})"))
}

/// Returns a number with its noun: `1 layer`, `10 layers`.
pub(super) fn counted(count: &BigInt, noun: &str) -> String {
    let plural = if count.is_one() { "" } else { "s" };
    format!("{count} {noun}{plural}")
}

/// Describes a load. Vertical loads have a unit; the components of other loads have several.
fn of_load(load: &Load, place: &str) -> String {
    let unit = if load.is_vertical() { " mg" } else { "" };
    format!("{load}{unit} on {place}")
}

/// The largest number of spheres or cells of a figure.
pub(super) const LIMIT: u32 = 20_000;

/// Checks that a figure has at most `limit` glyphs.
pub(super) fn readable(
    glyphs: &BigUint,
    limit: u32,
    kind: &'static str,
    remedy: &'static str,
) -> Result<(), Error> {
    if glyphs <= &limit.into() {
        return Ok(());
    }
    let glyphs = glyphs.clone();
    Err(Error::TooManyGlyphs {
        glyphs,
        kind,
        limit,
        remedy,
    })
}
