//! A dump written by LAMMPS (version 22Jul2025): four layers at a/R = 6/5, `pair_style gran/hooke` with k = 1e7 mg/R
//! and no tangential force. It has two snapshots: at the start and at rest.
//!
//! ```text
//! compute      ids all property/local patom1 patom2
//! compute      f all pair/local dist force fx fy fz
//! dump         d all local 40000 pile.dump index c_ids[1] c_ids[2] c_f[1] c_f[2] c_f[3] c_f[4] c_f[5]
//! dump_modify  d units yes format float %.17g colname c_ids[1] id1 colname c_ids[2] id2 colname c_f[2] force &
//!              colname c_f[3] fx colname c_f[4] fy colname c_f[5] fz
//! ```

use cannonpile::{Packing, Pile};
use cannonpile_dem::verify::{self, Reader, Refusal};
use contact_tables::Error;

use super::{magnitudes, packing, ratio};

const DUMP: &str = include_str!("lammps.dump");

fn with_packing(test: impl FnOnce(&Packing<'_>)) {
    let pile = Pile::triangular(4).unwrap();
    test(&packing(&pile, ratio(6, 5)));
}

#[test]
fn lammps_is_accepted_within_the_error_of_its_springs() {
    let reading = verify::read(DUMP.as_bytes()).unwrap();
    with_packing(|packing| {
        let read = Reader::new().compare(packing, DUMP.as_bytes()).unwrap();
        assert_eq!((read.steps, read.step.as_deref()), (2, Some("40000")));
        let comparison = read.comparison;
        assert_eq!((comparison.matched(), comparison.missing()), (30, 0));
        assert!(comparison.accepted(1e-6), "{comparison}");
        // Springs of finite stiffness cause an error of about 0.48 L mg/(kR). The measured one is of this size.
        let error = comparison.largest_error().unwrap();
        assert!((5e-8..3e-7).contains(&error), "{error}");
        // The vectors and their signs are correct too.
        let alone = magnitudes(&reading);
        let alone = verify::Comparison::new(packing, alone).unwrap();
        assert!(alone.largest_error().unwrap() <= error);
    });
}

/// In the first snapshot the spheres do not overlap yet.
#[test]
fn spheres_that_have_not_settled_are_rejected() {
    let second = DUMP.match_indices("ITEM: TIMESTEP").nth(1).unwrap().0;
    with_packing(|packing| {
        let read = Reader::new()
            .compare(packing, &DUMP.as_bytes()[..second])
            .unwrap();
        assert_eq!((read.steps, read.step.as_deref()), (1, Some("0")));
        let comparison = read.comparison;
        assert_eq!((comparison.matched(), comparison.missing()), (1, 29));
        assert!(!comparison.accepted(0.1));
    });
}

/// A dump truncated after any byte is rejected, unless it ends with a complete snapshot.
#[test]
fn truncated_dumps_are_rejected() {
    let second = DUMP.match_indices("ITEM: TIMESTEP").nth(1).unwrap().0;
    for cut in 0..=DUMP.len() {
        let whole = cut == second || cut == DUMP.len();
        match verify::read(&DUMP.as_bytes()[..cut]) {
            Ok(_) => assert!(whole, "accepted {cut} bytes"),
            Err(Refusal::Table(Error::Line { line, .. } | Error::NoColumn { line, .. })) => {
                assert!(!whole, "refused {cut} bytes");
                let lines = DUMP[..cut].lines().count().max(1);
                let line = usize::try_from(line).unwrap();
                assert!(line == lines || line + 1 == lines, "{line} of {lines}");
            }
            Err(other) => panic!("{other}"),
        }
    }
}

#[test]
fn dumps_may_have_any_line_ends_and_labels() {
    let reading = verify::read(DUMP.as_bytes()).unwrap();
    let spellings = [
        DUMP.replace('\n', "\r\n"),
        DUMP.replace("ENTRIES", "CONTACTS"),
        DUMP.replace("ITEM: TIMESTEP", "ITEM: TIME\n0.25\nITEM: TIMESTEP"),
        // Blank lines between snapshots.
        format!(
            "\n{}\n \n",
            DUMP.replace("ITEM: TIMESTEP", "\nITEM: TIMESTEP")
        ),
        DUMP.replace("id1 id2", "patom1 patom2"),
        DUMP.replace("id1 id2", "natom1 natom2"),
        DUMP.replace("BOX BOUNDS ff ff ff", "BOX BOUNDS xy xz yz ff ff ff"),
    ];
    for spelling in spellings {
        let again = verify::read(spelling.as_bytes()).unwrap();
        assert_eq!(again, reading);
    }
}
