//! At the limits of floats every way to compute is as far off as the table in `tests/stress/table.md` says, and no more
//! than its bound.

use std::fs;

use crate::stress::cases::{self, Case};
use crate::stress::table;

#[test]
fn errors_at_the_limits_are_those_of_the_table() {
    let cases: Vec<Case> = cases::all();
    let rows = cases.iter().map(table::rows).collect::<Result<String, _>>();
    let measured = table::HEAD.to_owned() + &rows.unwrap_or_else(|fault| panic!("{fault}"));
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/stress/table.md");
    if std::env::var_os("STRESS_TABLE_RENEW").is_some() {
        fs::write(path, &measured).expect("the table is written");
    }
    let table = fs::read_to_string(path).expect("the table");
    for (measured, written) in measured.lines().zip(table.lines()) {
        assert_eq!(
            measured, written,
            "if that is right, renew the table: STRESS_TABLE_RENEW=1 cargo test --test suite stress_table"
        );
    }
    assert_eq!(measured.lines().count(), table.lines().count());
}
