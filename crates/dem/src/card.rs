//! `card.md` and `card.json`: a pile as a benchmark, for people and for machines.

mod extremes;
mod facts;
mod json;
mod lists;
mod markdown;
mod value;
mod words;

use std::io::Write;

use num_rational::BigRational;

use super::numbered::NumberedPile;
use crate::scene::State;
use crate::table::WriteError;

use facts::Facts;
use lists::Listed;

/// What a card says of a pile beside what the pile itself tells.
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
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CardTitle {
    /// The name of a benchmark case (`scene::cases`), such as `C2`; empty for any other pile.
    pub case: String,
    /// What the pile is, in a few words; if it is empty, the card has words of its own.
    pub title: String,
    /// What the pile tests; may be empty.
    pub purpose: String,
    /// Which forces the pile was given.
    pub state: State,
    /// κ′/κ of the elastic state; 1 if it is not given.
    pub stiffness_ratio: Option<BigRational>,
}

/// What the pile is, in one line.
#[must_use]
pub fn heading(pile: &NumberedPile<'_>, title: &CardTitle) -> String {
    let heading = words::title(pile, title);
    heading.replace(char::is_control, " ")
}

/// Writes the card for people, in Markdown.
pub(super) fn write_markdown(
    pile: &NumberedPile<'_>,
    title: &CardTitle,
    scene: Option<&str>,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let facts = Facts::of(pile, Listed::FOR_PEOPLE)?;
    let text = markdown::text(&facts, title, scene);
    Ok(out.write_all(text.as_bytes())?)
}

/// Writes the card for machines, in JSON.
pub(super) fn write_json(
    pile: &NumberedPile<'_>,
    title: &CardTitle,
    scene: Option<&str>,
    out: &mut dyn Write,
) -> Result<(), WriteError> {
    let facts = Facts::of(pile, Listed::FOR_MACHINES)?;
    let text = json::text(&facts, title, scene)?;
    Ok(out.write_all(text.as_bytes())?)
}
