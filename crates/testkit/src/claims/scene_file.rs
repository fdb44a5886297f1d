//! A scene survives a round trip through TOML. A file is read exactly or rejected in one line.

use arbitrary::Unstructured;
use cannonpile_dem::Error;
use cannonpile_dem::scene::Scene;

use super::{Checked, demand, one_line, same};
use crate::generators::{scene, text};

/// A scene survives a round trip, and so does a scene from any file.
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

/// Reads arbitrary lines.
pub fn any_file(u: &mut Unstructured<'_>) -> Checked {
    let file = scene::file(u)?;
    match Scene::from_toml(&file) {
        Ok(scene) => {
            // Its pile is valid or is rejected.
            scene.pile().err().as_ref().map_or(Ok(()), one_line)?;
            reads_back(&scene)
        }
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

/// A number is read exactly: without quotes if TOML allows it, and always as a string.
pub fn a_number(u: &mut Unstructured<'_>) -> Checked {
    let written = text::number(u)?;
    let sine = |file: &str| Scene::from_toml(file).map(|scene| scene.sin_phi);
    let value = Some(written.value);
    same(
        "a string",
        &sine(&format!("sin-phi = '{}'", written.text))?,
        &value,
    )?;
    match sine(&format!("sin-phi = {}", written.text)) {
        Ok(read) => same("a bare number", &read, &value),
        Err(refusal) => demand(matches!(refusal, Error::NotToml { .. }), || {
            refusal.to_string()
        }),
    }
}
