//! Regions and stackings as the parsers read them.

use alloc::format;
use alloc::string::{String, ToString};

use crate::lattice::Region;
use crate::stacking::Pattern;

/// What [`stacking`](super::parse::stacking) reads.
pub(crate) fn pattern(pattern: &Pattern) -> String {
    match pattern {
        Pattern::Fcc => "fcc".into(),
        Pattern::Hcp => "hcp".into(),
        Pattern::Dhcp => "dhcp".into(),
        Pattern::Spelled(stacking) => stacking.to_string(),
    }
}

/// What [`region`](super::parse::region) reads: by its sides if it is a triangle or hexagon about (0, 0), else by its
/// bounds.
pub(crate) fn shape(region: &Region) -> String {
    // Within ±10³⁶.
    let (p, q) = (region.x().end() + 1, 1 - region.x().start());
    if Region::hexagon(p, q).as_ref() != Ok(region) {
        return format!("region:{region}");
    }
    match (p, q) {
        (p, 1) if p > 1 => format!("triangle:{p}"),
        (p, q) if p == q => format!("hexagon:{p}"),
        (p, q) => format!("hexagon:{p},{q}"),
    }
}
