//! The title of a card.

use num_rational::BigRational;

use crate::numbered::NumberedPile;
use crate::scene::State;
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

pub(super) fn layers(pile: &Pile) -> String {
    match pile.layers() {
        1 => "1 layer".into(),
        layers => format!("{layers} layers"),
    }
}
