//! The table of spheres with their stress.

use cannonpile::lattice::Dimension;
use cannonpile::shape::Selection;
use cannonpile_dem::table;
use cannonpile_dem::table::{FileFormat, NumberFormat, Table};
use cannonpile_testkit::scenes::{columns, for_each_pile};

fn csv(table: Table<'_>, numbers: NumberFormat) -> String {
    let mut csv = Vec::new();
    table
        .write(FileFormat::Csv, numbers, &mut csv)
        .expect("a table");
    String::from_utf8(csv).expect("text")
}

/// The stress follows the columns of the table without it. In SI units it is that of the packing, correctly rounded, and
/// within the bound that is checked before the first row.
#[test]
fn the_columns_follow_those_of_the_spheres() {
    for_each_pile(|scene, export| {
        let packing = export.packing();
        let pile = packing.pile();
        let spheres = csv(
            table::spheres(packing, Selection::All).expect("a table"),
            NumberFormat::F64,
        );
        for in_si in [false, true] {
            let with_stress =
                || table::spheres_with_stress(packing, in_si, Selection::All).expect("a table");
            let flat = pile.dimension() == Dimension::Two;
            let names: Vec<_> = with_stress().columns().iter().map(|c| c.name).collect();
            let first = names
                .iter()
                .position(|name| *name == "stress_xx")
                .expect("a stress");
            assert_eq!(names.len() - first, if flat { 3 } else { 6 });
            let written = csv(with_stress(), NumberFormat::F64);
            for (line, without) in written.lines().zip(spheres.lines()) {
                assert!(line.starts_with(&format!("{without},")), "{scene:?} {line}");
            }
            let exact = csv(with_stress(), NumberFormat::Exact);
            assert_eq!(exact.lines().count(), written.lines().count());
            if !in_si {
                let mut stresses = exact.lines().flat_map(|line| line.split(',').skip(first));
                assert!(stresses.all(|cell| !cell.contains("sqrt")), "{scene:?}");
                continue;
            }
            let columns = columns(&written);
            let sites = pile.sites(Selection::All).expect("sites");
            for (row, site) in sites.enumerate() {
                let stress = packing.stress(site).expect("a stress");
                let parts = ["xx", "yy", "zz", "xy", "xz", "yz"];
                for (part, stress) in parts.into_iter().zip(stress) {
                    let column = columns.get(&format!("stress_{part}"));
                    let found = column.map_or(0.0, |column| column[row]);
                    assert_eq!(Some(found), stress.nearest(), "{scene:?} {site} {part}");
                }
            }
        }
    });
}

#[test]
fn an_overflow_is_refused_before_the_first_row() {
    let pile = cannonpile::Pile::triangular(3).expect("a pile");
    let packing = cannonpile::Packing::new(&pile, &"6/5".parse().expect("a spacing"));
    let huge = "1e200".parse::<f64>().expect("a number");
    let huge = num_rational::BigRational::from_float(huge).expect("finite");
    let packing = packing.expect("a packing").with_radius(huge.clone());
    let packing = packing
        .and_then(|packing| packing.with_mass(huge))
        .expect("a packing");
    let mut out = Vec::new();
    let table = table::spheres_with_stress(&packing, true, Selection::All).expect("a table");
    let error = table.write(FileFormat::Csv, NumberFormat::F64, &mut out);
    assert!(
        error
            .expect_err("an overflow")
            .to_string()
            .contains("stress_xx")
    );
    assert!(out.is_empty());
}
