//! Scenes that can be written down, valid or not, and scene files, valid and damaged.

use arbitrary::{Result, Unstructured};
use cannonpile::Load;
use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Dimension, MAX_LAYERS};
use cannonpile::stacking::{Pattern, Stacking};
use cannonpile_dem::scene::parse::At;
use cannonpile_dem::scene::{Anchor, Floor, Scene, State};
use num_rational::BigRational;

use super::{number, region, stacking};
use super::{rarely, text};

/// A scene with any values that the parsers accept. Its options may exclude each other, and its sizes may be negative.
pub fn scene(u: &mut Unstructured<'_>) -> Result<Scene> {
    let dimension = *u.choose(&[Dimension::Three, Dimension::Two])?;
    let layers = match u.int_in_range(0..=3)? {
        0 => None,
        1 => Some(u.int_in_range(1..=12)?),
        2 => Some(MAX_LAYERS - u.int_in_range(0..=3)?),
        _ => Some(u.int_in_range(1..=MAX_LAYERS)? >> u.int_in_range(0..=100)?)
            .map(|n: i128| n.max(1)),
    };
    let anchor = match u.int_in_range(0..=2)? {
        0 => None,
        1 => Some(Anchor::Top(region::region(u)?)),
        _ => Some(Anchor::Base(region::region(u)?)),
    };
    let loads = (0..u.int_in_range(0..=3)?).map(|_| Ok((at(u, dimension)?, load(u, dimension)?)));
    let loads = loads.collect::<Result<_>>()?;
    let tilt = if rarely(u, 2)? {
        horizontal(u, dimension)?
    } else {
        Default::default()
    };
    let floor = if rarely(u, 4)? {
        Floor::Rough
    } else {
        Floor::Glued
    };
    let coefficient = |u: &mut Unstructured<'_>| {
        let is_given = floor == Floor::Rough && u.arbitrary()?;
        is_given.then(|| number::quantity(u)).transpose()
    };
    Ok(Scene {
        layers,
        dimension,
        sin_phi: maybe(u)?,
        stacking: pattern(u)?,
        anchor,
        loads,
        tilt,
        weightless: u.arbitrary()?,
        spacing: spacing(u)?,
        radius: number::rational(u)?,
        mass: number::quantity(u)?,
        gravity: number::quantity(u)?,
        state: *u.choose(&[State::Isostatic, State::Elastic])?,
        stiffness_ratio: number::quantity(u)?,
        friction: coefficient(u)?,
        floor_friction: coefficient(u)?,
        floor,
    })
}

fn load(u: &mut Unstructured<'_>, dimension: Dimension) -> Result<Load> {
    let down = number::rational(u)?;
    if u.arbitrary()? {
        return Ok(down.into());
    }
    let [x, y] = horizontal(u, dimension)?;
    Ok(Load { down, x, y })
}

/// A horizontal vector. For discs it is mostly within their plane.
fn horizontal(u: &mut Unstructured<'_>, dimension: Dimension) -> Result<[BigRational; 2]> {
    let in_plane = dimension == Dimension::Two && !rarely(u, 8)?;
    let y = if in_plane {
        BigRational::default()
    } else {
        number::rational(u)?
    };
    Ok([number::rational(u)?, y])
}

fn maybe(u: &mut Unstructured<'_>) -> Result<Option<BigRational>> {
    let given: bool = u.arbitrary()?;
    given.then(|| number::rational(u)).transpose()
}

fn spacing(u: &mut Unstructured<'_>) -> Result<Option<Spacing>> {
    let given: bool = u.arbitrary()?;
    let square = given.then(|| number::quantity(u)).transpose()?;
    let rational: bool = u.arbitrary()?;
    Ok(square.and_then(|square| {
        let spacing = if rational {
            Spacing::new(square)
        } else {
            Spacing::from_square(square)
        };
        spacing.ok()
    }))
}

fn pattern(u: &mut Unstructured<'_>) -> Result<Option<Pattern>> {
    Ok(match u.int_in_range(0..=5)? {
        0 => None,
        1 => Some(Pattern::Fcc),
        2 => Some(Pattern::Hcp),
        3 => Some(Pattern::Dhcp),
        4 => {
            let runs = stacking::runs(u)?;
            Some(Stacking::from_runs(runs).map_or(Pattern::Fcc, Pattern::Spelled))
        }
        _ => {
            let signs = stacking::signs(u, 80)?;
            Some(Pattern::Spelled(
                Stacking::from_signs(signs).expect("few steps"),
            ))
        }
    })
}

fn at(u: &mut Unstructured<'_>, dimension: Dimension) -> Result<At> {
    let layer = if u.arbitrary()? {
        Some(number::machine_integer(u)?)
    } else {
        None
    };
    Ok(At {
        layer,
        i: number::machine_integer(u)?,
        j: match dimension {
            Dimension::Two => 0,
            Dimension::Three => number::machine_integer(u)?,
        },
    })
}

/// Lines that may form a scene file: keys, and values of correct kinds, of wrong kinds, and damaged.
pub fn file(u: &mut Unstructured<'_>) -> Result<String> {
    if rarely(u, 4)? {
        return Ok(u.arbitrary::<&str>()?.to_owned());
    }
    let mut lines = if rarely(u, 4)? {
        scene(u)?.to_toml()
    } else {
        String::new()
    };
    for _ in 0..u.int_in_range(0..=4)? {
        let line = format!("{} = {}\n", key(u)?, value(u)?);
        lines.push_str(&line);
    }
    Ok(lines)
}

fn key(u: &mut Unstructured<'_>) -> Result<&'static str> {
    u.choose(&[
        "layers",
        "stacking",
        "top",
        "base",
        "dimension",
        "sin-phi",
        "load",
        "tilt",
        "weightless",
        "spacing",
        "radius",
        "mass",
        "gravity",
        "sin_phi",
        "spacing.x",
        "\"\"",
        "\"a\\nb\"",
        "[load]\nat",
        "[[load]]\nat",
        "weight",
        "x",
        "at",
    ])
    .copied()
}

fn value(u: &mut Unstructured<'_>) -> Result<String> {
    Ok(match u.int_in_range(0..=6)? {
        0 => text::number(u)?.text,
        1 => format!("'{}'", text::any(u)?.replace(['\'', '\n'], "")),
        2 => text::any(u)?,
        3 => format!("{:#x}", u.arbitrary::<u128>()?),
        4 => format!("[{}]", value(u)?),
        5 => format!("{{at = {}, weight = {}}}", value(u)?, value(u)?),
        _ => [
            "true",
            "inf",
            "nan",
            "1979-05-27",
            "'hcp'",
            "'hexagon:3'",
            "'0,0,0=1'",
            "1_000",
            "0b11",
        ][u.choose_index(9)?]
        .to_owned(),
    })
}
