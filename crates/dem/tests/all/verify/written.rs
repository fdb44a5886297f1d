//! Tables of contacts as DEM codes wrote them themselves, at rest: three layers at a = 6/5 R, with linear springs of
//! 10⁷ mg/R and without friction. `examples/peers/README.md` has the commands; `peers/run` runs them.

use cannonpile::Pile;
use cannonpile_dem::verify::{Comparison, Preset, Reader};

use super::{packing, ratio};

fn compare(reader: &Reader, table: &[u8]) -> Comparison {
    let pile = Pile::triangular(3).unwrap();
    let read = reader.compare(&packing(&pile, ratio(6, 5)), table);
    read.unwrap().comparison
}

fn with_columns(reader: &Reader, columns: &str) -> Reader {
    reader.clone().with_columns(columns.parse().unwrap())
}

#[test]
fn tables_written_by_codes_are_accepted_within_the_error_of_their_springs() {
    let dirt = Preset::Mddem.columns();
    let dirt = dirt.overridden(&"force=1e7*overlap".parse().unwrap());
    let liggghts =
        "id1=c_contacts[1],id2=c_contacts[2],fx=c_contacts[4],fy=c_contacts[5],fz=c_contacts[6]";
    let yade = Preset::Yade.columns();
    let yade = yade.overridden(&"fx=f_x,fy=f_y,fz=f_z".parse().unwrap());
    let codes: [(Reader, &[u8], f64); 4] = [
        (
            Reader::of(Preset::Mddem).with_columns(dirt),
            include_bytes!("written/dirt.csv"),
            3e-7,
        ),
        (
            Reader::of(Preset::Kratos),
            include_bytes!("written/kratos.vtu"),
            3e-7,
        ),
        (
            with_columns(&Reader::new(), liggghts),
            include_bytes!("written/liggghts.dump"),
            3e-7,
        ),
        // YADE writes six digits in its legacy files of VTK.
        (
            Reader::new().with_columns(yade),
            include_bytes!("written/yade.vtk"),
            1e-6,
        ),
    ];
    for (reader, table, most) in codes {
        let comparison = compare(&reader, table);
        assert_eq!((comparison.matched(), comparison.missing()), (12, 0));
        let error = comparison.largest_error();
        // Three layers at 10⁷ mg/R leave an error of about 10⁻⁷.
        assert!(
            (3e-8..most).contains(&error.unwrap()),
            "{reader:?}: {comparison}"
        );
    }
}

/// The overlap is not the force, the force on the second sphere has the opposite sign, and tangential forces are 0.
#[test]
fn wrong_columns_are_found() {
    let overlap = compare(
        &Reader::of(Preset::Mddem),
        include_bytes!("written/dirt.csv"),
    );
    assert!(!overlap.accepted(0.9), "{overlap}");
    let turned =
        "id1=c_contacts[2],id2=c_contacts[1],fx=c_contacts[4],fy=c_contacts[5],fz=c_contacts[6]";
    let turned = with_columns(&Reader::new(), turned);
    let turned = compare(&turned, include_bytes!("written/liggghts.dump"));
    assert!(!turned.accepted(0.9), "{turned}");
    let tangential = with_columns(&Reader::of(Preset::Kratos), "force=local_contact_force_x");
    let tangential = compare(&tangential, include_bytes!("written/kratos.vtu"));
    assert!(!tangential.accepted(0.9), "{tangential}");
}
