//! A scene with any values yields the pile that it describes, or is rejected in one line.

use core::ops::Add;

use arbitrary::Unstructured;
use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Dimension, MAX_LAYERS};
use cannonpile::stacking::Pattern;
use cannonpile::{Load, Pile};
use cannonpile_dem::scene::State;
use cannonpile_dem::scene::{Anchor, Scene};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::{Checked, demand, one_line, same};
use crate::generators::{self, number, pile, rarely};

/// Checks the pile, the packing and the state of a scene. Every value of the scene may be wrong.
pub fn any_scene(u: &mut Unstructured<'_>) -> Checked {
    let scene = if u.arbitrary()? {
        generators::scene::scene(u)?
    } else {
        scene(u)?
    };
    let pile = match scene.pile() {
        Ok(pile) => pile,
        Err(refusal) => return one_line(&refusal),
    };
    is_as_described(&scene, &pile)?;
    in_units(&scene, &pile)?;
    in_state(&scene, &pile)
}

fn is_as_described(scene: &Scene, pile: &Pile) -> Checked {
    let layers = pile.layers();
    demand((1..=MAX_LAYERS).contains(&layers), || {
        format!("a pile of {layers} layers")
    })?;
    let spelled = scene.stacking.as_ref().and_then(Pattern::layers);
    let given_layers = scene.layers.or(spelled);
    // A base without a number of layers supports as many layers as possible.
    if given_layers.is_some() || !matches!(scene.anchor, Some(Anchor::Base(_))) {
        same("layers", &layers, &given_layers.unwrap_or(Scene::LAYERS))?;
    }
    match scene.anchor {
        Some(Anchor::Top(top)) => same("the top", &pile.shape().layer(0)?, &top)?,
        Some(Anchor::Base(base)) => same("the base", &pile.shape().base(), &base)?,
        None => {}
    }
    same("dimension", &pile.dimension(), &scene.dimension)?;
    let s = scene.sin_phi.clone();
    let s = s.unwrap_or_else(|| match scene.dimension {
        Dimension::Two => BigRational::zero(),
        Dimension::Three => number::ratio(1, 2),
    });
    same("sin phi", pile.sin_phi(), &s)?;
    same("weightless", &pile.is_weightless(), &scene.weightless)?;
    same("the tilt", pile.tilt(), &scene.tilt)?;
    let given = scene.loads.iter().map(|(_, load)| load);
    let loads = pile.loads().map(|(_, load)| load);
    let [given, loads] = [
        given.fold(Load::zero(), Load::add),
        loads.fold(Load::zero(), Load::add),
    ];
    same("the loads", &loads, &given)
}

fn in_units(scene: &Scene, pile: &Pile) -> Checked {
    let sizes = [&scene.radius, &scene.mass, &scene.gravity];
    let positive = sizes.iter().all(|size| size.is_positive());
    let checked = positive && scene.stiffness_ratio.is_positive();
    same("sizes", &scene.check_sizes().is_ok(), &checked)?;
    match scene.packing(pile) {
        Ok(packing) => {
            same("radius", packing.radius(), &scene.radius)?;
            let weight = &scene.mass * &scene.gravity;
            same("weight", &packing.sphere_weight(), &weight)
        }
        Err(refusal) => {
            // A given spacing was checked with the pile. The default may not fit.
            demand(!positive || scene.spacing.is_none(), || refusal.to_string())?;
            one_line(&refusal)
        }
    }
}

/// The chosen state belongs to the pile, and its horizontal forces are compressive.
fn in_state(scene: &Scene, pile: &Pile) -> Checked {
    let is_small = pile.sphere_count() <= 24_u32.into();
    if scene.state == State::Elastic && !is_small {
        return Ok(());
    }
    match scene.in_state(pile.clone()) {
        Ok(state) => {
            let pushes = state
                .horizontal_forces()
                .all(|(_, force)| !force.is_negative());
            demand(pushes, || format!("{state:?}"))?;
            same("the pile", &state.without_horizontal_forces(), pile)
        }
        Err(refusal) => one_line(&refusal),
    }
}

/// A scene whose values are mostly valid, so that often only one value is wrong.
fn scene(u: &mut Unstructured<'_>) -> arbitrary::Result<Scene> {
    let mut size = || -> arbitrary::Result<BigRational> {
        if rarely(u, 16)? {
            number::rational(u)
        } else {
            number::quantity(u)
        }
    };
    let (radius, mass, gravity) = (size()?, size()?, size()?);
    let layers = if rarely(u, 8)? {
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
        1 => Spacing::from_square(number::rational(u)?).ok(),
        2 => Spacing::from_square(BigRational::one() + number::fraction(u)?).ok(),
        _ => Spacing::new(BigRational::one() + number::fraction(u)?).ok(),
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
