//! Conversion between the options of a scene and Python arguments.

use std::fmt::Display;

use cannonpile::lattice::Dimension;
use cannonpile_dem::scene::{Anchor, Scene, State, parse};
use num_rational::BigRational;
use num_traits::{One, Zero};
use pyo3::prelude::*;

use crate::exception::of_argument;
use crate::input::read;

/// Returns the scene for options given as texts of the command line.
pub(super) fn scene(options: &[(String, String)], loads: &[(String, String)]) -> PyResult<Scene> {
    let mut scene = Scene::default();
    for (name, text) in options {
        match name.as_str() {
            "layers" => scene.layers = Some(read(name, text, parse::layers)?),
            "stacking" => scene.stacking = Some(read(name, text, str::parse)?),
            "top" => scene.anchor = Some(Anchor::Top(read(name, text, str::parse)?)),
            "base" => scene.anchor = Some(Anchor::Base(read(name, text, str::parse)?)),
            "dimension" => scene.dimension = read(name, text, str::parse)?,
            "sin_phi" => scene.sin_phi = Some(read(name, text, parse::rational)?),
            "weightless" => scene.weightless = true,
            "spacing" => scene.spacing = Some(read(name, text, str::parse)?),
            "radius" => scene.radius = read(name, text, parse::rational)?,
            "mass" => scene.mass = read(name, text, parse::rational)?,
            "gravity" => scene.gravity = read(name, text, parse::rational)?,
            "state" => scene.state = read(name, text, str::parse)?,
            "tilt" => scene.tilt = read(name, text, |text| parse::tilt(text, scene.dimension))?,
            "stiffness_ratio" => scene.stiffness_ratio = read(name, text, parse::rational)?,
            _ => {
                return Err(of_argument(
                    name,
                    &cannonpile::engine::bug("every option of Pile is an option of scenes").into(),
                ));
            }
        }
    }
    for (at, load) in loads {
        let text = format!("{at}={load}");
        let load = read("loads", &text, |text| parse::load(text, scene.dimension))?;
        scene.loads.push(load);
    }
    Ok(scene)
}

/// Returns the Python call that makes the pile of a scene.
pub(super) fn call(scene: &Scene) -> String {
    let mut given = Vec::new();
    let mut give = |name: &str, value: String| given.push(format!("{name}={value}"));
    if let Some(layers) = scene.layers {
        give("layers", layers.to_string());
    }
    if let Some(stacking) = &scene.stacking {
        give("stacking", quoted(stacking));
    }
    if let Some(anchor) = &scene.anchor {
        let (Anchor::Top(region) | Anchor::Base(region)) = anchor;
        give(anchor.name(), quoted(format_args!("{region:#}")));
    }
    if scene.dimension == Dimension::Two {
        give("dimension", "2".into());
    }
    if let Some(s) = &scene.sin_phi {
        give("sin_phi", number(s));
    }
    if !scene.loads.is_empty() {
        let loads = scene.loads.iter().map(|(at, load)| {
            let mut place: Vec<i128> = at.layer.into_iter().chain([at.i]).collect();
            if scene.dimension == Dimension::Three {
                place.push(at.j);
            }
            let place: Vec<String> = place.iter().map(ToString::to_string).collect();
            let comma = if place.len() == 1 { "," } else { "" };
            let load = if load.is_vertical() {
                number(&load.down)
            } else {
                let parts = [&load.down, &load.x, &load.y].map(number);
                tuple(&parts[..scene.dimension.directions().len()])
            };
            format!("({}{comma}): {load}", place.join(", "))
        });
        let loads: Vec<String> = loads.collect();
        give("loads", format!("{{{}}}", loads.join(", ")));
    }
    if !scene.tilt.iter().all(Zero::is_zero) {
        let [x, y] = scene.tilt.each_ref().map(number);
        give(
            "tilt",
            if scene.dimension == Dimension::Two {
                x
            } else {
                tuple(&[x, y])
            },
        );
    }
    if scene.weightless {
        give("weightless", "True".into());
    }
    if let Some(spacing) = &scene.spacing {
        give(
            "spacing",
            match spacing.ratio().to_rational() {
                Some(ratio) => number(&ratio),
                None => quoted(spacing),
            },
        );
    }
    for (name, size) in [
        ("radius", &scene.radius),
        ("mass", &scene.mass),
        ("gravity", &scene.gravity),
    ] {
        if !size.is_one() {
            give(name, number(size));
        }
    }
    if scene.state == State::Elastic {
        give("state", quoted(scene.state));
    }
    if !scene.stiffness_ratio.is_one() {
        give("stiffness_ratio", number(&scene.stiffness_ratio));
    }
    format!("Pile({})", given.join(", "))
}

/// Returns a Python tuple of several items.
fn tuple(items: &[String]) -> String {
    format!("({})", items.join(", "))
}

/// Returns a Python string literal. The texts contain no characters that need escapes.
fn quoted(text: impl Display) -> String {
    format!("'{text}'")
}

/// Returns an exact number as a Python literal.
fn number(number: &BigRational) -> String {
    if number.is_integer() {
        number.to_string()
    } else {
        quoted(number)
    }
}
