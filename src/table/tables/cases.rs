//! The benchmark cases.

use crate::Error;
use crate::scene::{Case, cases as all_cases};
use crate::table::cell::Cell;
use crate::table::rows::{Column, Row, Table};

/// The benchmark cases, one a row: `name, title, dimension, layers, spheres, contacts, stands, command`.
///
/// `stands` is empty where the spheres weigh nothing, and it is not asked; `command` exports the case. What a case tests is
/// in its [`purpose`](Case::purpose), and in the card that `command` writes.
///
/// # Examples
/// ```
/// use cannonpile::table::{self, FileFormat, NumberFormat};
///
/// let mut csv = Vec::new();
/// table::cases().write(FileFormat::Csv, NumberFormat::Exact, &mut csv)?;
/// let csv = String::from_utf8(csv)?;
/// assert!(csv.contains("\nC13,\"Discs in a plane, eight layers\",2,8,36,56,yes,\"cannonpile export C13 --case C13"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn cases() -> Table<'static> {
    let names = [
        "name",
        "title",
        "dimension",
        "layers",
        "spheres",
        "contacts",
        "stands",
        "command",
    ];
    let columns = names.map(Column::plain).into();
    Table::of_rows(columns, "cases", all_cases().iter().map(row))
}

fn row(case: &Case) -> Row {
    let pile = case.scene()?.pile()?;
    let name = case.name();
    let stands = case.stands().map(|verdict| Cell::from(verdict.name()));
    let command = format!("cannonpile export {name} --case {name} --to csv,card");
    Ok::<_, Error>(vec![
        name.into(),
        case.title().into(),
        i128::from(pile.dimension().number()).into(),
        pile.layers().into(),
        Cell::Integer(pile.sphere_count().into()),
        Cell::Integer(pile.contact_count().into()),
        stands.unwrap_or(Cell::Missing),
        Cell::Word(command.into()),
    ])
}
