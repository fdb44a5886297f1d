//! The commands, one a file, and what they have in common.

pub(crate) mod bounds;
pub(crate) mod cases;
pub(crate) mod census;
pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod ensemble;
pub(crate) mod explain;
pub(crate) mod export;
pub(crate) mod forces;
pub(crate) mod man;
pub(crate) mod mean;
pub(crate) mod plot;
pub(crate) mod prove;
pub(crate) mod scene;
pub(crate) mod spheres;
pub(crate) mod summary;
pub(crate) mod verify;

use cannonpile::Pile;
use cannonpile::geometry::Spacing;
use cannonpile::shape::Selection;
use cannonpile_dem::scene::parse;
use cannonpile_dem::table::{Cell, Table};
use cannonpile_disorder::check_fault_probability;
use num_rational::BigRational;
use num_traits::One;

use crate::Error;
use crate::output::{Failure, complain};
use crate::progress::Progress;

/// Reads the probability of a change of sign.
fn fault_probability(text: &str) -> Result<BigRational, Error> {
    let q = parse::rational(text)?;
    check_fault_probability(&q)?;
    Ok(q)
}

/// Whether neighbours of a layer touch, at the spacing that is given for all stackings of some layers; or why nothing is said of
/// which stand at it. A pile of them with a change of sign leaves the least room.
fn has_horizontal_contacts(
    spacing: Option<&BigRational>,
    with_a_change: impl FnOnce() -> Result<Pile, cannonpile::Error>,
) -> Result<bool, Failure> {
    let Some(spacing) = spacing.filter(|spacing| !spacing.is_one()) else {
        return Ok(spacing.is_some());
    };
    let clearance = with_a_change()?.clearance();
    let touching = clearance.check(&Spacing::new(spacing.clone())?)?;
    if touching.is_empty() {
        return Ok(false);
    }
    Err(Failure::Message(format!(
        "--spacing {spacing}: where the sign changes spheres two layers apart touch, and whether they hold what pulls is \
         not decided: use 1, or more than 1 and less than 3/2"
    )))
}

/// Says in one line on stderr that no pile can bear such forces, if that is so.
fn note_if_it_falls(pile: &Pile) {
    if pile.is_weightless() {
        return;
    }
    let progress = Progress::begin("finding out whether the pile stands");
    let failure = pile.first_failure();
    drop(progress);
    match failure {
        Ok(None) => {}
        Ok(Some(layer)) => complain(&format!(
            "note: this pile does not stand without further contacts: below layer k = {layer} spheres would have to pull; \
             no other forces of these contacts are in balance"
        )),
        Err(error) => complain(&format!(
            "note: whether this pile stands is not known: {error}"
        )),
    }
}

/// What the rows of a table say of whether the pile stands, where the question is of a part of it: that of the whole may
/// take much longer.
struct Tension {
    /// The column with the force, positive for a push.
    column: &'static str,
    seen: std::cell::Cell<bool>,
}

impl Tension {
    const fn in_column(column: &'static str) -> Self {
        Self {
            column,
            seen: std::cell::Cell::new(false),
        }
    }

    /// Looks at the rows as they are written.
    fn watch<'t>(&'t self, table: Table<'t>) -> Table<'t> {
        let mut columns = table.columns().iter();
        let Some(place) = columns.position(|column| column.name == self.column) else {
            return table;
        };
        table.inspect(move |row| {
            if row.get(place).is_some_and(Cell::is_negative) {
                self.seen.set(true);
            }
        })
    }

    /// Says in one line on stderr that no pile can bear such forces: of the whole pile, or for what was seen of a part.
    fn note(&self, pile: &Pile, selection: Selection) {
        match selection {
            Selection::All | Selection::Base => note_if_it_falls(pile),
            Selection::Layer(_) | Selection::One(_) if self.seen.get() && !pile.is_weightless() => {
                complain(
                    "note: this pile does not stand without further contacts: spheres would have to pull here; no other \
                     forces of these contacts are in balance",
                );
            }
            Selection::Layer(_) | Selection::One(_) => {}
        }
    }
}
