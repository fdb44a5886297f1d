use cannonpile_dem::verify::{Columns, Reader};

use super::read;

/// A table of the tests of the command line.
macro_rules! table {
    ($path:literal) => {
        include_bytes!(concat!("../../../../../cli/tests/all/cli/tables/", $path))
    };
}

/// The columns of the force chains of MFiX.
const MFIX: &str = "id1=FORCE_CHAIN_GLOBAL_ID1,id2=FORCE_CHAIN_GLOBAL_ID2,force=FORCE_CHAIN_FN_MAG";

/// Each file has the exact forces of three layers.
#[test]
fn files_with_the_exact_forces_are_accepted() {
    let by_place = || Reader::new().by_place(Reader::WITHIN).unwrap();
    let mfix = || Reader::new().with_columns(MFIX.parse::<Columns>().unwrap());
    let vector = "fx=FORCE_CHAIN_FN_x,fy=FORCE_CHAIN_FN_y,fz=FORCE_CHAIN_FN_z";
    let mfix_by_place = by_place().with_columns(vector.parse().unwrap());
    let cases: [(&str, &[u8], Reader, f64); 9] = [
        (
            "one vertex before the lines",
            table!("vtp-one-vertex-before-lines/in.vtp"),
            by_place(),
            0.0,
        ),
        (
            "each point is a vertex",
            table!("vtp-points-as-vertices-and-lines/in.vtp"),
            by_place(),
            0.0,
        ),
        (
            "a piece of a parallel file",
            table!("pvtp/part0.vtp"),
            by_place(),
            0.0,
        ),
        ("bits", table!("vtp-bit-array/in.vtp"), by_place(), 0.0),
        (
            "a text",
            table!("vtp-string-in-field-data/in.vtp"),
            by_place(),
            0.0,
        ),
        (
            "-nan(ind)",
            table!("vtp-velocity-nan-ind/in.vtp"),
            by_place(),
            0.0,
        ),
        (
            "contacts as vertices",
            table!("contacts-as-vertices/in.vtp"),
            mfix(),
            0.0,
        ),
        (
            "contact points of vertices",
            table!("contacts-as-vertices/in.vtp"),
            mfix_by_place,
            1e-15,
        ),
        // The numbers are floats of 32 bits.
        (
            "points without cells",
            table!("mfix-force-chain/in.vtp"),
            mfix(),
            6e-8,
        ),
    ];
    for (case, file, reader, accept) in cases {
        let comparison = read(&reader, file).unwrap().comparison;
        assert_eq!(
            (comparison.matched(), comparison.missing()),
            (12, 0),
            "{case}"
        );
        assert!(comparison.accepted(accept), "{case}: {comparison}");
    }
}

#[test]
fn files_without_readable_contacts_are_refused() {
    let cases: [(&[u8], &str); 5] = [
        (
            table!("vtp-array-longer-than-cells/in.vtp"),
            "array force: 13 values for 12 cells of 1 component",
        ),
        (
            table!("pvtp/in.pvtp"),
            "the contacts are in other files: give 'part0.vtp' instead",
        ),
        (
            table!("pvtu-of-lethe/in.pvtu"),
            "the contacts are in other files: give 'chains.00000.vtu', 'chains.00001.vtu' instead",
        ),
        (
            table!("xml-that-is-no-vtk/in.xml"),
            "an XML spreadsheet: save it as csv",
        ),
        (
            b"<!DOCTYPE html>\n<html><head><title>404</title></head><body><p>Not found<br></body></html>\n",
            "this is an HTML page: give the table of contacts itself",
        ),
    ];
    for (file, said) in cases {
        let reader = Reader::new().by_place(Reader::WITHIN).unwrap();
        let refusal = read(&reader, file).unwrap_err();
        assert_eq!(refusal.to_string(), said);
    }
}
