//! A scene of any numbers at all makes the pile that they describe, or is refused in one line.

use arbitrary::Unstructured;
use cannonpile::lattice::{Dimension, MAX_LAYERS};
use cannonpile::scene::Scene;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::{Checked, demand, one_line, same};
use crate::generators::{number, pile};

/// The pile and the packing of a scene whose every number may be wrong.
pub(crate) fn any_scene(u: &mut Unstructured<'_>) -> Checked {
    let scene = scene(u)?;
    let pile = match scene.pile() {
        Ok(pile) => pile,
        Err(refusal) => return one_line(&refusal),
    };
    let layers = scene.layers.unwrap_or(10);
    demand((1..=MAX_LAYERS).contains(&layers), || {
        format!("a pile of {layers} layers")
    })?;
    same("layers", &pile.layers(), &layers)?;
    same("dimension", &pile.dimension(), &scene.dimension)?;
    let s = scene.sin_phi.clone();
    let s = s.unwrap_or_else(|| match scene.dimension {
        Dimension::Two => BigRational::zero(),
        Dimension::Three => number::ratio(1, 2),
    });
    same("sin phi", pile.sin_phi(), &s)?;
    let positive = [&scene.radius, &scene.mass, &scene.gravity]
        .iter()
        .all(|size| size.is_positive());
    same("sizes", &scene.check_sizes().is_ok(), &positive)?;
    match scene.packing(&pile) {
        Ok(packing) => {
            same("radius", packing.radius(), &scene.radius)?;
            same(
                "weight",
                &packing.sphere_weight(),
                &(scene.mass * scene.gravity),
            )
        }
        Err(refusal) => {
            // A spacing that was given has been checked with the pile; the default may not fit.
            demand(!positive || scene.spacing.is_none(), || refusal.to_string())?;
            one_line(&refusal)
        }
    }
}

/// Mostly valid, so that one wrong number is met alone.
fn scene(u: &mut Unstructured<'_>) -> arbitrary::Result<Scene> {
    let mut size = || -> arbitrary::Result<BigRational> {
        if u.ratio(1, 16)? {
            number::rational(u)
        } else {
            number::quantity(u)
        }
    };
    let (radius, mass, gravity) = (size()?, size()?, size()?);
    let layers = if u.ratio(1, 8)? {
        number::machine_integer(u)?
    } else {
        pile::layers(u)?
    };
    let sin_phi = match u.int_in_range(0..=7)? {
        0..=2 => None,
        3 => Some(number::rational(u)?),
        _ => Some(number::sin_phi(u)?),
    };
    let spacing = match u.int_in_range(0..=3)? {
        0 => None,
        1 => Some(number::rational(u)?),
        _ => Some(BigRational::one() + number::fraction(u)?),
    };
    Ok(Scene {
        layers: Some(layers),
        dimension: *u.choose(&[Dimension::Three, Dimension::Three, Dimension::Two])?,
        sin_phi,
        spacing,
        radius,
        mass,
        gravity,
        ..Scene::default()
    })
}
