//! The tables of the changes of contact forces among unequal spheres.

use cannonpile::Pile;
use cannonpile::lattice::{Direction, Site};
use cannonpile::scalar::Surd;
use cannonpile_dem::table::{Cell, Column, Row, Table, Units, indices, places};
use cannonpile_stability::{ForceChange, Spread};
use num_rational::BigRational;

/// Returns a row for each contact: `k, i, j, direction, force, change`. Discs have no `j`.
pub(crate) fn sensitivity(pile: &Pile, changes: Vec<ForceChange>) -> Table<'static> {
    let names = ["force", "change"];
    let rows = changes.into_iter().map(|contact| -> Row {
        let mut cells = contact_cells(pile, contact.site, contact.direction);
        cells.extend([contact.force, contact.change].map(Cell::from));
        Ok(cells)
    });
    let rows: Vec<Row> = rows.collect();
    Table::of_rows(columns(pile, &names), "contacts", rows.into_iter())
}

/// Returns one row: `k, i, j, direction, force, force_deviation, radius_deviation`. Discs have no `j`. The last one is
/// exact.
pub(crate) fn spread(pile: &Pile, spread: Spread) -> Table<'static> {
    let bearable: Option<BigRational> = spread.bearable_squared();
    let mut cells = contact_cells(pile, spread.site, spread.direction);
    cells.push(spread.force.into());
    cells.push(Surd::root_of(spread.variance).into());
    cells.push(bearable.map_or(Cell::Missing, |square| Surd::root_of(square).into()));
    let mut columns = columns(pile, &["force", "force_deviation"]);
    columns.push(Column::measured("radius_deviation", ""));
    Table::record(columns.into_iter().zip(cells).collect())
}

fn columns(pile: &Pile, forces: &[&'static str]) -> Vec<Column> {
    let unit = Units::of_pile(pile).force();
    let mut columns = indices(pile, &["k"]);
    columns.push(Column::plain("direction"));
    columns.extend(forces.iter().map(|name| Column::measured(name, unit)));
    columns
}

fn contact_cells(pile: &Pile, site: Site, direction: Direction) -> Vec<Cell> {
    let mut cells = vec![site.k.into()];
    cells.extend(places(pile, site));
    cells.push(direction.name().into());
    cells
}

#[cfg(test)]
mod tests {
    use cannonpile::Packing;

    use super::super::test::csv;
    use super::*;

    #[test]
    fn two_layers() {
        let pile = Pile::triangular(2).unwrap();
        let packing = Packing::new(&pile, &"6/5".parse().unwrap()).unwrap();
        // A larger apex is higher, but still in the middle.
        let changes = cannonpile_stability::sensitivity(&packing, Site::APEX).unwrap();
        let table = csv(sensitivity(&pile, changes));
        let head = "k,i,j,direction,force,change\n";
        let row = |direction: &str| format!("0,0,0,{direction},1,-6/13\n");
        let rows = ["alpha", "beta", "gamma"].map(row).concat();
        assert_eq!(table, format!("{head}{rows}"));
        let table = csv(spread(
            &pile,
            cannonpile_stability::spread(&packing).unwrap().unwrap(),
        ));
        assert!(
            table.starts_with(
                "k,i,j,direction,force,force_deviation,radius_deviation\n0,0,0,alpha,1,"
            ),
            "{table}"
        );
    }
}
