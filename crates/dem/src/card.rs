//! The benchmark card of a pile: `card.md` for readers, and `card.json` for programs.

mod extremes;
mod lists;
mod page;
mod record;
mod rough;

use std::io::Write;

use num_rational::BigRational;
use serde_json::Value as Json;

use super::numbered::NumberedPile;
use crate::scene::State;
use crate::table::WriteError;
use crate::{Error, Friction};
use cannonpile::Pile;
use cannonpile::lattice::Dimension;

/// The texts and options on a card that the pile itself does not determine.
///
/// # Examples
/// ```
/// use cannonpile_dem::{CardTitle, PileExport, PileFormat};
/// use cannonpile::geometry::Spacing;
/// use cannonpile::{Packing, Pile};
/// use num_rational::BigRational;
///
/// let pile = Pile::triangular(3)?;
/// let packing = Packing::new(&pile, &Spacing::new(BigRational::new(6.into(), 5.into()))?)?;
/// let title = CardTitle { title: "Three layers".into(), ..CardTitle::default() };
/// let folder = tempfile::tempdir()?;
/// PileExport::new(&packing)?.with_title(title).write(&[PileFormat::Card], folder.path(), &mut |_| {})?;
/// let card = std::fs::read_to_string(folder.path().join("card.md"))?;
/// assert!(card.starts_with("# Three layers\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct CardTitle {
    /// The name of a benchmark case (`scene::cases`), such as `C2`; empty for any other pile.
    pub case: String,
    /// A short description of the pile. If it is empty, the card generates one.
    pub title: String,
    /// The purpose of the benchmark; may be empty.
    pub purpose: String,
    /// The state whose forces the pile has.
    pub state: State,
    /// κ′/κ of the elastic state; 1 if absent.
    pub stiffness_ratio: Option<BigRational>,
}

cannonpile::engine::equality!(CardTitle);

/// The maximal number of contacts, and of spheres, that `card.md` lists.
const FOR_PEOPLE: u32 = 130;

/// The maximal number of contacts, and of spheres, that `card.json` lists.
const FOR_MACHINES: u32 = 10_000;

/// Returns a description of the pile in one line.
#[must_use]
pub fn heading(pile: &NumberedPile<'_>, title: &CardTitle) -> String {
    let own = if title.title.is_empty() {
        let kind = match pile.pile().dimension() {
            Dimension::Two => "discs",
            Dimension::Three => "spheres",
        };
        let count = pile.numbering().sphere_count();
        format!("A pile of {count} {kind} in {}", layers(pile.pile()))
    } else {
        title.title.clone()
    };
    let heading = match &*title.case {
        "" => own,
        case => format!("{case}: {own}"),
    };
    heading.replace(char::is_control, " ")
}

fn layers(pile: &Pile) -> String {
    match pile.layers() {
        1 => "1 layer".into(),
        layers => format!("{layers} layers"),
    }
}

/// Writes the card in Markdown. With friction, the pile is on a rough floor.
pub(super) fn write_markdown(
    pile: &NumberedPile<'_>,
    title: &CardTitle,
    friction: Option<&Friction>,
    scene: Option<&str>,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let card = card(pile, title, friction, scene, FOR_PEOPLE)?;
    let layout = match friction {
        None => page::Layout::GLUED,
        Some(_) => rough::LAYOUT,
    };
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
