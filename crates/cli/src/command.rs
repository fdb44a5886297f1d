//! The commands, one a file, and their common functions.

pub(crate) mod bounds;
pub(crate) mod cases;
pub(crate) mod census;
pub(crate) mod check;
pub(crate) mod completions;
pub(crate) mod ensemble;
pub(crate) mod explain;
pub(crate) mod export;
pub(crate) mod forces;
pub(crate) mod mean;
pub(crate) mod plot;
pub(crate) mod prove;
pub(crate) mod response;
pub(crate) mod scene;
pub(crate) mod sensitivity;
pub(crate) mod spheres;
pub(crate) mod stability;
pub(crate) mod summary;
pub(crate) mod verify;

use std::fmt::Display;
use std::io;
use std::path::Path;

use cannonpile::Pile;
use cannonpile::geometry::Spacing;
use cannonpile::shape::Selection;
use cannonpile_dem::Key;
use cannonpile_dem::scene::parse;
use cannonpile_dem::table::{Cell, Table};
use cannonpile_disorder::check_fault_probability;
use cannonpile_horizontal::certificate::read_certificates;
use num_rational::BigRational;
use num_traits::{One, Signed};

use crate::Error;
use crate::output::{Failure, InputError, print_message, write_to};
use crate::progress::Progress;

/// The message for `--certificate` with `--floor rough`.
const CERTIFICATE_ON_ROUGH_FLOOR: &str = "--certificate: forces on a rough floor need no certificate, because they are unique: leave it out";

/// Writes certificates into the file of `--certificate`, if `check` accepts them.
fn write_accepted(
    file: &Path,
    write: impl FnOnce(&mut Vec<u8>) -> io::Result<()>,
) -> Result<(), Failure> {
    let refused = |reason: &dyn Display| {
        let text = format!("--certificate: leave it out, because check would refuse it: {reason}");
        Failure::Message(text)
    };
    let mut text = Vec::new();
    let certificates = write(&mut text).and_then(|()| read_certificates(text.as_slice()));
    for certificate in certificates.map_err(|error| refused(&error))? {
        certificate.check().map_err(|error| refused(&error))?;
    }
    write_to("certificate", Some(file), |out| Ok(out.write_all(&text)?))
}

/// Parses the probability of a sign change.
fn fault_probability(text: &str) -> Result<BigRational, Error> {
    let q = parse::rational(text)?;
    check_fault_probability(&q)?;
    Ok(q)
}

/// Attributes the error of a pile without weight above the floor: a single layer, or weightless spheres.
fn of_weight(pile: &Pile, error: impl Into<Error>) -> InputError {
    match error.into() {
        error @ Error::Stability(cannonpile_stability::Error::NoWeight) if pile.layers() == 1 => {
            InputError::of(Key::Layers, error)
        }
        error => error.into(),
    }
}

/// Returns whether neighbours in a layer touch at this spacing, a = R.
///
/// `with_a_change` returns a pile with a sign change, which has the smallest gaps of all stackings.
///
/// # Errors
/// The spacing is too wide for this pile, or spheres two layers apart touch, so that stability is undetermined.
fn has_horizontal_contacts(
    spacing: Option<&Spacing>,
    with_a_change: impl FnOnce() -> Result<Pile, cannonpile::Error>,
) -> Result<bool, Failure> {
    let Some(spacing) = spacing.filter(|spacing| !spacing.square().is_one()) else {
        return Ok(spacing.is_some());
    };
    let clearance = with_a_change()?.clearance();
    let touching = clearance.check(spacing)?;
    if touching.is_empty() {
        return Ok(false);
    }
    Err(Failure::Message(format!(
        "--spacing {spacing}: at a sign change spheres two layers apart touch, so that stability is undetermined: use 1, or \
         more than 1 and less than 3/2"
    )))
}

/// Returns the message that a pile is unstable, without the contacts that `without` names.
fn instability(pile: &Pile, without: &str) -> String {
    let reason = match pile.first_failure() {
        Ok(Some(layer)) => format!(": below layer k = {layer} some contact needs tension"),
        _ => String::new(),
    };
    format!("this pile is unstable{without}{reason}")
}

/// Why the elastic state visits all spheres.
const ELASTIC: &str = "the springs of the elastic state couple all forces";

/// Prints a note on stderr if the pile is unstable.
fn note_instability(pile: &Pile) {
    if pile.is_weightless() {
        return;
    }
    let progress = Progress::begin("checking the stability of the pile");
    let failure = pile.first_failure();
    drop(progress);
    match failure {
        Ok(None) => {}
        Ok(Some(layer)) => print_message(&format!(
            "note: this pile is unstable without further contacts: below layer k = {layer} some contact needs tension; these \
             forces are the only ones in equilibrium"
        )),
        Err(error) => print_message(&format!(
            "note: the stability of this pile is unknown: {error}"
        )),
    }
}

/// Finds tensile forces in the rows of a table.
///
/// For a part of a pile this replaces the check of the whole pile, which may take much longer.
struct TensionCheck {
    /// The column with the force, positive in compression.
    column: &'static str,
    seen: std::cell::Cell<bool>,
}

impl TensionCheck {
    const fn in_column(column: &'static str) -> Self {
        Self {
            column,
            seen: std::cell::Cell::new(false),
        }
    }

    /// Watches the rows while they are written.
    fn watch<'t, 'a: 't>(&'t self, table: Table<'a>) -> Table<'t> {
        let mut columns = table.columns().iter();
        let place = columns.position(|column| column.name == self.column);
        table.inspect(move |row| {
            let cell = place.and_then(|place| row.get(place));
            if cell.is_some_and(Cell::is_negative) {
                self.seen.set(true);
            }
        })
    }

    /// Looks at a force that is in no row.
    fn find(&self, force: &BigRational) {
        if force.is_negative() {
            self.seen.set(true);
        }
    }

    /// Prints a note on stderr if the pile is unstable. For a part of it, only the rows written so far count.
    fn note(&self, pile: &Pile, selection: Selection) {
        match selection {
            Selection::All | Selection::Base => note_instability(pile),
            Selection::Layer(_) | Selection::One(_) if self.seen.get() && !pile.is_weightless() => {
                print_message(
                    "note: this pile is unstable without further contacts: some contact here needs tension; these forces are \
                     the only ones in equilibrium",
                );
            }
            Selection::Layer(_) | Selection::One(_) => {}
        }
    }
}
