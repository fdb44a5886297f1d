//! The page `docs/number-types.md`, compared with the results.

use cannonpile::lattice::Region;
use cannonpile::{Error, Pile, ratio};

use crate::plain;
use crate::table::Row;

const PAGE: &str = include_str!("../../docs/number-types.md");

/// Checks that the page has each row, apart from its time, and no other row.
pub fn compare(rows: &[Row]) {
    let table = PAGE.lines().skip_while(|line| !line.starts_with("| type "));
    let mut page: Vec<_> = table
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .collect();
    for Row { columns, .. } in rows {
        let at = page.iter().position(|line| line.starts_with(columns));
        let at = at.unwrap_or_else(|| panic!("docs/number-types.md needs the row {columns}"));
        page.remove(at);
    }
    page.retain(|line| cfg!(feature = "malachite") || !line.starts_with("| malachite "));
    assert_eq!(page, [""; 0], "rows that no type gave");
}

/// Runs the programs for types without glue, and counts their lines. The exact force is 5/3 f₀.
pub fn programs() -> Result<(), Error> {
    let source = include_str!("plain.rs").lines();
    let mut lines = 0;
    for line in source {
        lines = if line.starts_with("pub fn ") {
            1
        } else {
            lines + 1
        };
        assert!(line != "}" || lines <= 5, "a program of {lines} lines");
    }
    let pile = Pile::under(Region::SITE, "+-+".parse()?)?;
    let exact = ratio!(5 / 3);
    assert_eq!(plain::rational_of_num(&pile)?, exact);
    assert_eq!(plain::rational_of_dashu(&pile)?.to_string(), "5/3");
    let floats = [
        (f64::from(plain::half_precision(&pile)?), 11),
        (f64::from(plain::brain_float(&pile)?), 8),
        (f64::from(plain::single(&pile)?), 24),
        (plain::double(&pile)?, 53),
        (plain::posit(&pile)?.to_f64(), 28),
        (plain::fixed_point(&pile)?.to_num(), 32),
        (f64::from(plain::two_floats(&pile)?), 52),
    ];
    for (force, bits) in floats {
        let error = (force - 5.0 / 3.0).abs();
        assert!(
            error <= 4.0 * 2.0_f64.powi(-bits),
            "{force} with {bits} bits"
        );
    }
    let error = plain::two_floats(&pile)? * 3.0 - 5.0;
    assert!(f64::from(error).abs() < 1e-15, "a quotient of {error:?}");
    let derivative = plain::derivative(&pile)?;
    // The force is (6 − p)/3 under the load p.
    let errors = [derivative.re - 4.0 / 3.0, derivative.eps + 1.0 / 3.0];
    assert!(errors.into_iter().all(|error| error.abs() < 1e-15));
    let refused = plain::ratio_of_words(&pile).expect_err("a ratio that may wrap");
    assert!(refused.to_string().contains("use FixedRational"));
    Ok(())
}
