//! The table of the benchmark cases.

use cannonpile_dem::Error;
use cannonpile_dem::scene::{Case, Floor, cases as all_cases};
use cannonpile_dem::table::{Cell, Column, Row, Table};

/// Returns the benchmark cases, a row each: `name, title, dimension, layers, spheres, contacts, stands, command`.
///
/// `stands` is empty for spheres without weight. `command` exports the case, with a card that explains its
/// [`purpose`](Case::purpose).
#[must_use]
pub(crate) fn cases() -> Table<'static> {
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
    let scene = case.scene()?;
    let pile = scene.pile()?;
    let name = case.name();
    let stands = case.stands().map(|verdict| Cell::from(verdict.name()));
    let files = match scene.floor {
        Floor::Rough => "lammps,yade,card",
        _ => "csv,card",
    };
    let command = format!("cannonpile export {name} --case {name} --to {files}");
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

#[cfg(test)]
mod tests {
    use super::super::test::csv;
    use super::*;

    #[test]
    fn each_case_has_its_export_command() {
        let csv = csv(cases());
        let discs = "\nC13,\"Discs in a plane, eight layers\",2,8,36,56,yes,\"cannonpile export C13 --case C13";
        assert!(csv.contains(discs), "{csv}");
    }
}
