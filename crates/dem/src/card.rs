//! The benchmark card of a pile: `card.md` for readers, and `card.json` for programs.

mod extremes;
mod lists;
mod page;
mod record;
mod rough;
mod title;

pub use title::{CardTitle, heading};

use std::io::Write;

use serde_json::Value as Json;

use super::numbered::NumberedPile;
use crate::table::WriteError;
use crate::{Error, Friction};

/// The maximal number of contacts, and of spheres, that `card.md` lists.
const FOR_PEOPLE: u32 = 130;

/// The maximal number of contacts, and of spheres, that `card.json` lists.
const FOR_MACHINES: u32 = 10_000;

/// Writes the card in Markdown. With friction, the pile is on a rough floor.
pub(super) fn write_markdown(
    pile: &NumberedPile<'_>,
    title: &CardTitle,
    friction: Option<&Friction>,
    scene: Option<&str>,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let card = card(pile, title, friction, scene, FOR_PEOPLE)?;
    let layout = friction.map_or(page::Layout::GLUED, |_| rough::LAYOUT);
    let page = page::page(pile, title, card, &layout)?;
    Ok(out.write_all(page.as_bytes())?)
}

/// Writes the card in JSON.
pub(super) fn write_json(
    pile: &NumberedPile<'_>,
    title: &CardTitle,
    friction: Option<&Friction>,
    scene: Option<&str>,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let (card, _) = card(pile, title, friction, scene, FOR_MACHINES)?;
    serde_json::to_writer_pretty(&mut *out, &card)?;
    Ok(writeln!(out)?)
}

fn card(
    pile: &NumberedPile<'_>,
    title: &CardTitle,
    friction: Option<&Friction>,
    scene: Option<&str>,
    most: u32,
) -> Result<(Json, record::Names), Error> {
    match friction {
        None => record::record(pile, title, scene, most),
        Some(friction) => rough::record(pile, title, friction, scene, most),
    }
}
