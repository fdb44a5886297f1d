//! What is proved.

use crate::table::cell::Cell;
use crate::table::rows::{Column, Row, Table};
use crate::theorem::{Proof, Theorem};

/// What is proved for every pile, a theorem a row: `name, statement, symbols, holds`.
///
/// # Examples
/// ```
/// use cannonpile::table;
/// use cannonpile::theorem;
///
/// let table = table::theorems(theorem::all().map(|theorem| (theorem, theorem.prove())));
/// assert_eq!(table.columns().len(), 4);
/// ```
pub fn theorems<'t>(proved: impl Iterator<Item = (&'t Theorem, Proof)> + 't) -> Table<'t> {
    let columns = ["name", "statement", "symbols", "holds"].map(Column::plain);
    let row = |(theorem, proof): (&Theorem, Proof)| -> Row {
        let Theorem {
            name,
            statement,
            symbols,
            ..
        } = *theorem;
        Ok(vec![
            name.into(),
            statement.into(),
            symbols.into(),
            Cell::Flag(proof.holds()),
        ])
    };
    Table::of_rows(columns.into(), "theorems", proved.map(row))
}
