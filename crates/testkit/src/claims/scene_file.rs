//! A scene that is written down, as TOML or JSON, is read back; and a file is read exactly or refused in one line.

use arbitrary::Unstructured;
use cannonpile_dem::Error;
use cannonpile_dem::scene::Scene;

use super::{Checked, demand, json, one_line, same};
use crate::generators::{scene, text};

/// Written and read back, a scene is the same; and so is what was read of any file.
pub fn written(u: &mut Unstructured<'_>) -> Checked {
    reads_back(&scene::scene(u)?)
}

fn reads_back(scene: &Scene) -> Checked {
    let text = scene.to_toml();
    let witness = |error: &Error| format!("{error}, in {text}");
    let read = Scene::from_toml(&text).map_err(|error| super::Failure::Refuted(witness(&error)))?;
    same("the scene read back", &read, scene)?;
    same("the file written again", &read.to_toml(), &text)
}

/// Any lines at all.
pub fn any_file(u: &mut Unstructured<'_>) -> Checked {
    let file = scene::file(u)?;
    match Scene::from_toml(&file) {
        Ok(scene) => reads_back(&scene),
        Err(refusal) => {
            one_line(&refusal)?;
            let line = match refusal {
                Error::NotToml { line, .. }
                | Error::UnknownKey { line, .. }
                | Error::InFile { line, .. } => line,
                other => return Err(other.into()),
            };
            let lines = file.split('\n').count();
            demand((1..=lines).contains(&line), || {
                format!("line {line} of {file:?}")
            })
        }
    }
}

/// A number means what it says, bare where TOML has such numbers, and as a string always.
pub fn a_number(u: &mut Unstructured<'_>) -> Checked {
    let written = text::number(u)?;
    let spacing = |file: &str| Scene::from_toml(file).map(|scene| scene.spacing);
    let value = Some(written.value);
    same(
        "a string",
        &spacing(&format!("spacing = '{}'", written.text))?,
        &value,
    )?;
    match spacing(&format!("spacing = {}", written.text)) {
        Ok(read) => same("a bare number", &read, &value),
        Err(refusal) => demand(matches!(refusal, Error::NotToml { .. }), || {
            refusal.to_string()
        }),
    }
}

/// A scene comes back from JSON, whatever it says.
pub fn json(u: &mut Unstructured<'_>) -> Checked {
    json::reads_back(&scene::scene(u)?)
}

/// The JSON of a scene with some letters exchanged is a scene or none, and its pile is one or is refused.
pub fn damaged_json(u: &mut Unstructured<'_>) -> Checked {
    let whole = scene::scene(u)?;
    let Some(scene) = json::reads_damaged(u, &whole)? else {
        return Ok(());
    };
    scene.pile().err().as_ref().map_or(Ok(()), one_line)
}
