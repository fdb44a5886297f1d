//! The tables of theorems.

use cannonpile::theorem::Proof;
use cannonpile_dem::table::{Cell, Column, Row, Table};
use cannonpile_proof::Theorem;

/// Returns the theorems, a row each: `name, statement, symbols, holds`.
pub(crate) fn theorems(proved: impl Iterator<Item = (Theorem, Proof)> + 'static) -> Table<'static> {
    let columns = ["name", "statement", "symbols", "holds"].map(Column::plain);
    let row = |(theorem, proof): (Theorem, Proof)| -> Row {
        Ok(vec![
            theorem.name.into(),
            theorem.statement.into(),
            theorem.symbols.into(),
            Cell::Flag(proof.holds()),
        ])
    };
    Table::of_rows(columns.into(), "theorems", proved.map(row))
}

/// Returns the names of the theorems in Coq, a row for each theorem: `name, coq`.
pub(crate) fn in_coq() -> Table<'static> {
    let columns = ["name", "coq"].map(Column::plain);
    let row = |theorem: Theorem| -> Row {
        let names = match theorem.coq {
            [] => "not in Coq yet".to_owned(),
            names => names.join(" "),
        };
        Ok(vec![theorem.name.into(), Cell::Word(names.into())])
    };
    Table::of_rows(columns.into(), "theorems", cannonpile_proof::all().map(row))
}

#[cfg(test)]
mod tests {
    use super::super::test::csv;
    use super::*;

    #[test]
    fn each_theorem_is_a_row() {
        let theorem = cannonpile_proof::find("counts").expect("a theorem");
        let table = theorems([(theorem, theorem.prove())].into_iter());
        let csv = csv(table);
        assert!(csv.starts_with("name,statement,symbols,holds\ncounts,"));
        assert!(csv.ends_with(",1\n"), "{csv}");
    }

    #[test]
    fn names_in_coq() {
        let csv = csv(in_coq());
        assert!(csv.starts_with("name,coq\n"));
        assert!(csv.contains("\nrotation,Straight.rotation\n"));
    }
}
