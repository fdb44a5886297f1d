//! Short descriptions of stackings and anchors.

use num_traits::One;

use cannonpile::Pile;
use cannonpile::lattice::Dimension;
use cannonpile::shape::Shape;

/// Returns the name of the stacking, or its first Hägg signs; `None` for discs and for a single layer.
#[must_use]
pub fn stacking(pile: &Pile) -> Option<String> {
    let stacking = pile.shape().stacking();
    let name = || match stacking.name() {
        Some(name) => name.to_uppercase(),
        None => brief(&stacking.to_string(), 25),
    };
    (pile.dimension() == Dimension::Three && pile.layers() > 1).then(name)
}

/// Returns the top or base that the pile grows from; `None` for one sphere on top.
#[must_use]
pub fn anchor(shape: &Shape) -> Option<String> {
    let base = shape.base();
    let grown = Shape::on(base, shape.stacking().clone());
    if grown.is_ok_and(|grown| grown == *shape) {
        return Some(format!("base {}", brief(&format!("{base:#}"), 40)));
    }
    let top = shape
        .layer(0)
        .ok()
        .filter(|top| !top.site_count().is_one())?;
    Some(format!("top {}", brief(&format!("{top:#}"), 40)))
}

/// Returns a text of at most `most` characters. A longer text is cut, and ends with an ellipsis.
#[must_use]
pub fn brief(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.into();
    }
    let mut short: String = text.chars().take(most - 1).collect();
    short.push('…');
    short
}
