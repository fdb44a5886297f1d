//! The numbers in slices equal those of the files and tables bit by bit, in the same order.

use cannonpile::Pile;
use cannonpile::lattice::{ContactKind, HorizontalContact};
use cannonpile::shape::Selection;
use cannonpile_dem::table::{self, FileFormat, NumberFormat, Units};
use cannonpile_dem::{Error, PileArrays, PileFile};
use cannonpile_testkit::scenes::{columns, for_each_pile, packing, text};
use num_bigint::BigInt;
use num_rational::BigRational;

/// Returns the rows of some columns of a csv file.
fn rows<const N: usize>(csv: &str, names: [&str; N]) -> Vec<[f64; N]> {
    let columns = columns(csv);
    let length = columns[names[0]].len();
    let row = |n: usize| names.map(|name| columns[name][n]);
    (0..length).map(row).collect()
}

#[test]
fn arrays_equal_the_files_in_their_order() {
    for_each_pile(|scene, export| {
        let arrays = PileArrays::of_packing(export.packing()).expect("arrays");
        let contacts = text(export, PileFile::ContactsCsv);
        let mut ids = vec![[0_u32; 2]; arrays.contacts()];
        arrays.fill_ids(&mut ids).expect("ids");
        let ids: Vec<[f64; 2]> = ids.iter().map(|ids| ids.map(f64::from)).collect();
        assert_eq!(ids, rows(&contacts, ["id1", "id2"]), "{scene:?}");
        let mut forces = vec![0.0; arrays.contacts()];
        arrays.fill_forces(&mut forces).expect("forces");
        let forces: Vec<[f64; 1]> = forces.into_iter().map(|force| [force]).collect();
        assert_eq!(forces, rows(&contacts, ["force"]), "{scene:?}");
        let mut vectors = vec![[0.0; 3]; arrays.contacts()];
        arrays.fill_vectors(&mut vectors).expect("vectors");
        assert_eq!(vectors, rows(&contacts, ["fx", "fy", "fz"]), "{scene:?}");
        let mut centres = vec![[0.0; 3]; arrays.spheres()];
        arrays.fill_centres(&mut centres).expect("centres");
        let spheres = text(export, PileFile::SpheresCsv);
        assert_eq!(centres, rows(&spheres, ["x", "y", "z"]), "{scene:?}");
        let on_floor = text(export, PileFile::BaseCsv);
        let on_floor = rows(&on_floor, ["normal", "shear_x"]);
        let mut base = vec![[0.0; 3]; on_floor.len()];
        arrays.fill_base(&mut base).expect("a base");
        let base: Vec<[f64; 2]> = base.iter().map(|[n, x, _]| [*n, *x]).collect();
        assert_eq!(base, on_floor, "{scene:?}");
    });
}

#[test]
fn points_equal_the_table_and_are_between_the_centres() {
    for_each_pile(|scene, export| {
        let arrays = PileArrays::of_packing(export.packing()).expect("arrays");
        let mut points = vec![[0.0; 3]; arrays.contacts()];
        arrays.fill_points(&mut points).expect("points");
        let units = Units::of_packing(export.packing().clone());
        let table = table::contacts(&units, Selection::All).expect("a table");
        let mut csv = Vec::new();
        table
            .write(FileFormat::Csv, NumberFormat::F64, &mut csv)
            .expect("a table");
        let mut wanted = rows(&String::from_utf8(csv).expect("text"), ["x", "y", "z"]);
        let mut sorted = points.clone();
        for rows in [&mut wanted, &mut sorted] {
            rows.sort_by(|one, other| one.partial_cmp(other).expect("numbers"));
        }
        assert_eq!(sorted, wanted, "{scene:?}");
        let mut centres = vec![[0.0; 3]; arrays.spheres()];
        let mut ids = vec![[0_usize; 2]; arrays.contacts()];
        arrays.fill_centres(&mut centres).expect("centres");
        let mut narrow = vec![[0_u16; 2]; arrays.contacts()];
        arrays.fill_ids(&mut narrow).expect("ids");
        for (ids, narrow) in ids.iter_mut().zip(narrow) {
            *ids = narrow.map(usize::from);
        }
        let radius = nearest(export.packing().radius());
        for ([one, other], point) in ids.into_iter().zip(points) {
            for axis in 0..3 {
                let middle = centres[one - 1][axis].midpoint(centres[other - 1][axis]);
                assert!(
                    (middle - point[axis]).abs() < 1e-14 * 20.0 * radius,
                    "{scene:?}"
                );
            }
        }
    });
}

fn nearest(number: &BigRational) -> f64 {
    let number = cannonpile::scalar::Surd::from(number.clone());
    number.nearest().expect("a float")
}

/// Returns the exact force of each contact, from a separate query for each.
fn one_by_one(pile: &Pile) -> Vec<BigRational> {
    let forces = pile.forces::<BigRational>();
    let sloping = forces.contacts(Selection::All).expect("contacts");
    let sloping = sloping.map(|contact| contact.expect("a force").force);
    let horizontal = pile.horizontal_forces();
    sloping
        .chain(horizontal.map(|(_, force)| force.clone()))
        .collect()
}

#[test]
fn multiples_and_sites_equal_single_evaluations() {
    for_each_pile(|scene, export| {
        let pile = export.packing().pile();
        let arrays = PileArrays::of_pile(pile).expect("arrays");
        let mut wide = vec![BigInt::ZERO; arrays.contacts()];
        let denominator = arrays.fill_multiples(&mut wide).expect("numerators");
        let over = |n: &BigInt| BigRational::new(n.clone(), denominator.clone());
        let exact: Vec<BigRational> = wide.iter().map(over).collect();
        assert_eq!(exact, one_by_one(pile), "{scene:?}");
        let mut narrow = vec![0_i64; arrays.contacts()];
        assert_eq!(arrays.fill_multiples(&mut narrow), Ok(denominator.clone()));
        let widened: Vec<BigInt> = narrow.into_iter().map(BigInt::from).collect();
        assert_eq!(widened, wide, "{scene:?}");
        let mut forces = vec![0.0; arrays.contacts()];
        arrays.fill_forces(&mut forces).expect("forces");
        let rounded: Vec<f64> = exact.iter().map(nearest).collect();
        assert_eq!(forces, rounded, "{scene:?}");
        let mut sites = vec![[0_i64; 3]; arrays.spheres()];
        arrays.fill_sites(&mut sites).expect("sites");
        let wanted = pile.shape().sites().map(|site| [site.k, site.i, site.j]);
        let sites = sites.iter().map(|site| site.map(i128::from));
        assert!(sites.eq(wanted), "{scene:?}");
    });
}

#[test]
fn slices_that_do_not_fit_are_refused() {
    let pile = Pile::triangular(4).expect("a pile");
    let arrays = PileArrays::of_pile(&pile).expect("arrays");
    let length = |needed, given| Err(Error::Core(cannonpile::Error::Length { needed, given }));
    assert_eq!(arrays.fill_forces(&mut [0.0; 29]), length(30, 29));
    assert_eq!(arrays.fill_ids(&mut [[0_u8; 2]; 31]), length(30, 31));
    assert_eq!(arrays.fill_sites(&mut [[0_i8; 3]; 19]), length(20, 19));
    assert_eq!(arrays.fill_base(&mut [[0.0; 3]; 9]), length(10, 9));
    // A pile without sizes has no positions.
    for refused in [
        arrays.fill_centres(&mut [[0.0; 3]; 20]),
        arrays.fill_points(&mut [[0.0; 3]; 30]),
    ] {
        assert!(
            matches!(
                refused,
                Err(Error::NeedsUnits {
                    quantity: "positions",
                    ..
                })
            ),
            "{refused:?}"
        );
    }
    assert!(arrays.fill_vectors(&mut [[0.0; 3]; 30]).is_err());
    // The pile has 220 spheres above the floor and 286 in all, so one byte is too small for the numbers.
    let pile = Pile::triangular(11).expect("a pile");
    let arrays = PileArrays::of_packing(&packing(&pile)).expect("arrays");
    let mut ids = vec![[0_u8; 2]; arrays.contacts()];
    assert!(matches!(
        arrays.fill_ids(&mut ids),
        Err(Error::Core(cannonpile::Error::Overflow { .. }))
    ));
    let stacking = "+-+-+-+".parse().expect("a stacking");
    let pile = Pile::under(cannonpile::lattice::Region::SITE, stacking).expect("a pile");
    let arrays = PileArrays::of_pile(&pile).expect("arrays");
    let mut numerators = vec![0_i8; arrays.contacts()];
    let refused = arrays.fill_multiples(&mut numerators);
    assert!(
        matches!(
            refused,
            Err(Error::Core(cannonpile::Error::Overflow { .. }))
        ),
        "{refused:?}"
    );
}

#[test]
fn horizontal_contacts_come_last_with_the_sphere_that_names_them_first() {
    let stacking = "+-+-+".parse().expect("a stacking");
    let bare = Pile::under(cannonpile::lattice::Region::SITE, stacking).expect("a pile");
    let one = BigRational::from_integer(1.into());
    let elastic = cannonpile_horizontal::elastic(&bare, &one).expect("a state");
    let arrays = PileArrays::of_pile(elastic.pile()).expect("arrays");
    let mut ids = vec![[0_u64; 2]; arrays.contacts()];
    arrays.fill_ids(&mut ids).expect("ids");
    let numbering = elastic.pile().numbering().expect("numbers");
    let contacts = elastic.pile().horizontal_forces();
    let named = contacts.map(|(HorizontalContact { site, axis }, _)| {
        assert!(ContactKind::from(axis).direction().is_none());
        numbering.id(site).expect("a number")
    });
    let last = ids[ids.len() - 3..].iter().map(|[first, _]| *first);
    assert!(last.eq(named));
}
