//! The option parsers for scenes and tables never panic, and they read printed values back.

use arbitrary::Unstructured;
use cannonpile::lattice::Dimension;
use cannonpile::{Load, Pile};
use cannonpile_dem::scene::State;
use cannonpile_dem::scene::parse;
use cannonpile_dem::scene::parse::At;
use cannonpile_dem::verify::{Columns, Preset};

use super::parsers::{reads_back, round_trips};
use super::{Checked, one_line};
use crate::generators::{pile, text};

/// Runs the parsers of layers and of sites on any text.
pub fn any_text(u: &mut Unstructured<'_>) -> Checked {
    let text = text::any(u)?;
    match parse::layers(&text) {
        Ok(value) => {
            reads_back(parse::layers, &value, &value)?;
            Pile::triangular(value)?;
        }
        Err(refusal) => one_line(&refusal)?,
    }
    site(&text, Dimension::Two)?;
    site(&text, Dimension::Three)
}

fn site(text: &str, dimension: Dimension) -> Checked {
    let parse = |text: &str| parse::at(text, dimension);
    match parse(text) {
        Ok(value) => {
            // The parser does not know the pile. A later check rejects sites outside it.
            let _ = value.site(i128::MIN);
            let shown = written(&value, dimension);
            reads_back(parse, &shown.replace(',', " , "), &value)?;
            reads_back(parse, &shown, &value)
        }
        Err(refusal) => one_line(&refusal),
    }
}

/// Checks that a printed number of layers is read as the same number.
pub fn layers(u: &mut Unstructured<'_>) -> Checked {
    let layers = pile::layers(u)?;
    reads_back(parse::layers, &layers, &layers)
}

/// Runs the parsers of states, columns, presets, loads and tilts on any word. All parsed values but columns are printed, and
/// read as the same value.
pub fn any_word(u: &mut Unstructured<'_>) -> Checked {
    let text = text::word(u)?;
    round_trips::<State>(&text)?;
    let columns = text.parse::<Columns>();
    columns.map_or_else(|refusal| one_line(&refusal), |_| Ok(()))?;
    round_trips::<Preset>(&text)?;
    for dimension in [Dimension::Two, Dimension::Three] {
        load(&text, dimension)?;
        tilt(&text, dimension)?;
    }
    Ok(())
}

fn tilt(text: &str, dimension: Dimension) -> Checked {
    let parse = |text: &str| parse::tilt(text, dimension);
    match parse(text) {
        Ok(value) => {
            let [x, y] = &value;
            reads_back(parse, &format!("{x},{y}"), &value)
        }
        Err(refusal) => one_line(&refusal),
    }
}

fn load(text: &str, dimension: Dimension) -> Checked {
    let parse = |text: &str| parse::load(text, dimension);
    match parse(text) {
        Ok(value) => {
            let Load { down, x, y } = &value.1;
            let shown = format!("{}={down},{x},{y}", written(&value.0, dimension));
            reads_back(parse, &shown, &value)
        }
        Err(refusal) => one_line(&refusal),
    }
}

/// Returns the site as `K,I,J`, or as `I,J` without a layer. In two dimensions J is left out.
fn written(at: &At, dimension: Dimension) -> String {
    let last = (dimension == Dimension::Three).then_some(at.j);
    let parts = [at.layer, Some(at.i), last];
    let parts: Vec<_> = parts.into_iter().flatten().map(|n| n.to_string()).collect();
    parts.join(",")
}

#[cfg(test)]
mod injected_faults {
    use super::*;

    #[test]
    fn a_site_without_its_layer_is_caught() {
        let at = parse::at("3,1,2", Dimension::Three).unwrap();
        let parse = |text: &str| parse::at(text, Dimension::Three);
        assert!(reads_back(parse, &written(&at, Dimension::Three), &at).is_ok());
        let cut = At { layer: None, ..at };
        assert!(reads_back(parse, &written(&cut, Dimension::Three), &at).is_err());
    }
}
