//! How a pile is grown, in a few words.

use num_traits::One;

use cannonpile::Pile;
use cannonpile::lattice::Dimension;
use cannonpile::shape::Shape;

/// Returns the stacking by its name, or the first of its Hägg signs; none of discs, or of one layer.
#[must_use]
pub fn stacking(pile: &Pile) -> Option<String> {
    let stacking = pile.shape().stacking();
    let name = || match stacking.name() {
        Some(name) => name.to_uppercase(),
        None => brief(&stacking.to_string(), 25),
    };
    (pile.dimension() == Dimension::Three && pile.layers() > 1).then(name)
}

/// Returns the layer that all others are grown from, unless it is the top and one sphere.
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

/// Returns a text without what exceeds some letters.
#[must_use]
pub fn brief(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.into();
    }
    let mut short: String = text.chars().take(most - 1).collect();
    short.push('…');
    short
}
