//! Contacts are judged as a table lists them: with a force of 0, in two rows, and with the floor.

use std::fmt::Write;

use cannonpile::lattice::Site;
use cannonpile::shape::Selection;
use cannonpile::{Packing, Pile};
use cannonpile_dem::table::FileFormat;
use cannonpile_dem::verify::{
    Columns, Comparison, Fault, FindingKind, Force, Level, Measured, Placed, Reader, Refusal,
    Report,
};

use super::{compare, magnitudes, packing, perfect, piles, ratio};

/// Returns the number of each bottom sphere, with the exact normal force of the floor.
pub(super) fn on_floor(packing: &Packing<'_>) -> Vec<(u64, f64)> {
    let numbering = packing.pile().numbering().unwrap();
    let base = packing.base(Selection::Base).unwrap();
    let forces = base.map(|force| {
        let force = force.unwrap();
        let normal = force.normal.nearest::<f64>().unwrap();
        (numbering.id(force.site).unwrap(), normal)
    });
    forces.collect()
}

fn refused(packing: &Packing<'_>, measured: &[Measured]) -> Fault {
    match Comparison::new(packing, measured.iter().copied()) {
        Err(Refusal::Entry { fault, .. }) => fault,
        other => panic!("{other:?}"),
    }
}

fn report(comparison: &Comparison, format: FileFormat) -> String {
    let mut out = Vec::new();
    Report::new(comparison, 1e-6)
        .write(format, &mut out)
        .unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn a_force_of_0_is_a_measurement_with_an_error_of_1() {
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let exact = perfect(&packing);
    for place in 0..exact.len() {
        let ids = exact[place].ids;
        for zero in [
            Measured::new(ids, 0.0),
            Measured::new(ids, -0.0),
            Measured::of_vector(ids, [0.0, -0.0, 0.0]),
        ] {
            let mut measured = exact.clone();
            measured[place] = zero;
            let comparison = compare(&packing, &measured);
            assert_eq!((comparison.matched(), comparison.missing()), (30, 0));
            assert_eq!(comparison.largest_error(), Some(1.0));
            assert_eq!(comparison.beyond(1.0_f64.next_down()), 1);
            assert_eq!(comparison.worst().unwrap().ids, ids);
            assert!(comparison.worst().unwrap().measured.is_some());
            let [finding] = &comparison.findings(1e-6)[..] else {
                panic!();
            };
            let said = "a force of 0 was measured at 1 of the contacts with a force";
            assert_eq!(finding.to_string(), said);
        }
    }
    let zeros: Vec<_> = exact
        .iter()
        .map(|one| Measured::new(one.ids, 0.0))
        .collect();
    let comparison = compare(&packing, &zeros);
    assert_eq!(comparison.beyond(0.5), 30);
    assert_eq!(comparison.largest_error(), Some(1.0));
    let [finding] = &comparison.findings(1e-6)[..] else {
        panic!();
    };
    assert!(finding.to_string().starts_with("all measured forces are 0"));
    // Other patterns are found beside zeros.
    let doubled = exact[1..]
        .iter()
        .map(|one| Measured::new(one.ids, 2.0 * one.force));
    let doubled: Vec<_> = zeros[..1].iter().copied().chain(doubled).collect();
    let findings = compare(&packing, &doubled).findings(1e-6);
    let kinds: Vec<_> = findings.iter().map(|finding| finding.kind).collect();
    assert_eq!(kinds, [FindingKind::Zero, FindingKind::Factor]);
    assert!(findings[1].text.starts_with("all forces are 2.0 times"));
}

#[test]
fn a_force_that_underflows_is_measured() {
    let pile = Pile::triangular(2).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let reader = Reader::new();
    for zero in ["0", "-0", "1e-400", "0.000"] {
        let table = format!("id1,id2,force\n1,2,0.46225\n1,3,{zero}\n1,4,0.46225\n");
        let read = reader.compare(&packing, table.as_bytes()).unwrap();
        assert_eq!(
            (read.comparison.matched(), read.comparison.missing()),
            (3, 0)
        );
        assert_eq!(read.comparison.largest_error(), Some(1.0));
    }
}

#[test]
fn errors_of_nothing_are_missing() {
    for pile in piles() {
        let packing = packing(&pile, ratio(6, 5));
        let comparison = compare(&packing, &[]);
        assert_eq!(
            (comparison.largest_error(), comparison.rms_error()),
            (None, None)
        );
        assert_eq!(comparison.floor_error(), None);
        // Only a pile without contacts is accepted without a row.
        let has_forces = comparison.largest_force() > 0.0;
        assert_eq!(comparison.accepted(1.0), !has_forces);
        let json = report(&comparison, FileFormat::Json);
        for name in ["largest_error", "rms_error", "floor_error", "worst"] {
            assert!(json.contains(&format!("\"{name}\": null")), "{json}");
        }
        let csv = report(&comparison, FileFormat::Csv);
        let cells = |row: usize| csv.lines().nth(row).unwrap().split(',');
        for (_, cell) in cells(0)
            .zip(cells(1))
            .filter(|(name, _)| name.ends_with("_error"))
        {
            assert_eq!(cell, "");
        }
        let level = Level::new(1e6, &comparison, 1e-6);
        assert!(level.largest_error.is_infinite() && level.rms_error.is_infinite());
    }
}

#[test]
fn a_pair_may_be_listed_once_in_each_order() {
    for pile in piles() {
        let packing = packing(&pile, ratio(6, 5));
        let exact = perfect(&packing);
        for rows in [exact.clone(), magnitudes(&exact)] {
            let both = rows.iter().flat_map(|one| [one.reversed(), *one]);
            let comparison = compare(&packing, &both.collect::<Vec<_>>());
            assert!(comparison.accepted(0.0), "{comparison}");
            let contacts = rows.len() as u64;
            let counts = (comparison.matched(), comparison.repeated());
            assert_eq!(counts, (contacts, contacts));
            // The same rows twice, one after the other.
            let comparison = compare(&packing, &[&rows[..], &rows].concat());
            assert!(comparison.accepted(0.0), "{comparison}");
            assert_eq!(comparison.repeated(), contacts);
        }
    }
}

#[test]
fn rows_of_a_contact_are_repetitions_or_shares() {
    for pile in piles() {
        let packing = packing(&pile, ratio(6, 5));
        let exact = perfect(&packing);
        let floor = on_floor(&packing);
        let floor = floor
            .iter()
            .map(|(id, normal)| Measured::new([*id, 0], *normal));
        let all: Vec<_> = exact.iter().copied().chain(floor).collect();
        let half = |one: &Measured| Measured {
            force: one.force / 2.0,
            vector: one.vector.map(|vector| vector.map(|x| x / 2.0)),
            ..*one
        };
        let halves: Vec<_> = all.iter().map(half).collect();
        let rows = all.len() as u64;
        for (rows, counts) in [
            ([&all[..], &all].concat(), (rows, 0)),
            ([&halves[..], &halves].concat(), (0, rows)),
        ] {
            let comparison = compare(&packing, &rows);
            assert!(comparison.accepted(1e-15), "{comparison}");
            assert_eq!((comparison.repeated(), comparison.shares()), counts);
        }
        // Half of each force alone is wrong.
        assert!(!compare(&packing, &halves).accepted(0.4));
    }
}

#[test]
fn two_different_forces_of_a_pair_contradict_each_other() {
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let exact = perfect(&packing);
    for place in 0..exact.len() {
        // Of a row of 0 and a right one the sum is right, but they are not shares.
        for (is_first, factor) in [(false, 1.25), (true, 1.25), (false, 0.0), (true, 0.0)] {
            let mut wrong = exact[place].reversed();
            wrong.force *= factor;
            let mut measured = exact.clone();
            if is_first {
                measured.insert(0, wrong);
            } else {
                measured.push(wrong);
            }
            let comparison = compare(&packing, &measured);
            assert!(!comparison.accepted(0.2));
            let error = comparison.largest_error().unwrap();
            let wanted = f64::abs(factor - 1.0);
            assert!((error - wanted).abs() < 1e-15, "{error}");
            assert_eq!(comparison.worst().unwrap().ids, exact[place].ids);
            assert_eq!(
                (comparison.contradictory(0.2), comparison.contradictory(1.1)),
                (1, 0)
            );
            assert_eq!((comparison.matched(), comparison.repeated()), (30, 1));
            let found = comparison.findings(0.2);
            let said = "two rows disagree on the force of 1 of the pairs";
            let is_said = found.iter().any(|finding| finding.text.starts_with(said));
            assert!(is_said, "{found:?}");
        }
    }
    // Each of two forces is within the accepted error, but not their difference.
    let mut measured = magnitudes(&exact);
    measured[7].force *= 1.001;
    let mut other = measured[7].reversed();
    other.force *= 0.998;
    measured.push(other);
    let comparison = compare(&packing, &measured);
    assert_eq!(
        (comparison.beyond(1.5e-3), comparison.contradictory(1.5e-3)),
        (0, 1)
    );
    assert!(!comparison.accepted(1.5e-3) && comparison.accepted(2.5e-3));
    // Vectors contradict each other too.
    let mut turned = exact[5].reversed();
    turned.vector = turned.vector.map(|[x, y, z]| [y, x, z]);
    let comparison = compare(&packing, &[&exact[..], &[turned]].concat());
    assert_eq!(comparison.contradictory(1e-3), 1);
}

#[test]
fn a_third_row_or_another_force_in_the_same_order_is_refused() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    // A contact, neighbours without a contact, and two bottom spheres.
    for ids in [[1, 2], [2, 3], [5, 6]] {
        let one = Measured::new(ids, 0.5);
        let other = Measured::new(ids, 0.75);
        for rows in [
            [one, other, other],
            [one, one, one],
            [one, one.reversed(), one],
            [one, other.reversed(), one],
            [one.reversed(), other.reversed(), one],
        ] {
            let first = 1;
            assert_eq!(refused(&packing, &rows), Fault::Twice { ids, first });
        }
        assert!(Comparison::new(&packing, [one, other.reversed()]).is_ok());
    }
    let table = "id1,id2,force\n1,2,0.5\n1,3,0.5\n1,2,0.6\n";
    let refusal = Reader::new()
        .compare(&packing, table.as_bytes())
        .unwrap_err();
    assert_eq!(
        refusal.to_string(),
        "line 4: spheres 1 and 2 are already on line 2: list each pair once, or once in each order; if the table holds \
         several steps, name their column with step=COLUMN in --columns, or leave one step"
    );
}

#[test]
fn the_greater_of_two_forces_without_a_contact_is_judged() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let exact = perfect(&packing);
    let with = |one: f64, other: f64| {
        let rows = [Measured::new([2, 3], one), Measured::new([3, 2], other)];
        compare(&packing, &[&exact[..], &rows].concat())
    };
    for (one, other) in [(0.1, 0.3), (0.3, 0.1)] {
        let comparison = with(one, other);
        assert_eq!((comparison.extra(0.0), comparison.repeated()), (1, 1));
        assert_eq!(comparison.extra_pairs()[0].force, 0.3);
        assert_eq!(comparison.contradictory(0.1), 1);
    }
    assert_eq!(with(0.3, 0.3).contradictory(0.0), 0);
    assert!(with(1e-9, 1e-8).accepted(1e-6));
}

#[test]
fn a_contact_may_be_listed_twice_by_place() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let centre = |id: u64| {
        let site = pile.numbering().unwrap().site(id).unwrap();
        packing
            .position(site)
            .unwrap()
            .map(|x| x.nearest::<f64>().unwrap())
    };
    let exact = perfect(&packing);
    let centres = |one: &Measured| one.ids.map(centre);
    let point = |one: &Measured| {
        let [[x, y, z], [u, v, w]] = centres(one);
        [x.midpoint(u), y.midpoint(v), z.midpoint(w)]
    };
    let force = |one: &Measured| Force::Both(one.force, one.vector.unwrap());
    let compared = |rows: Vec<Placed>| Comparison::of_places(&packing, rows, 0.1).unwrap().0;
    let both = exact.iter().flat_map(|one| [*one, one.reversed()]);
    let between = |one: Measured| Placed::between(centres(&one), force(&one));
    for rows in [
        both.clone().map(between).collect::<Vec<_>>(),
        both.clone()
            .map(|one| Placed::at(point(&one), force(&one)))
            .collect(),
        both.map(|one| Placed::at(point(&one), Force::Along(one.force)))
            .collect(),
    ] {
        let comparison = compared(rows);
        assert!(comparison.accepted(1e-12), "{comparison}");
        assert_eq!((comparison.matched(), comparison.repeated()), (12, 12));
    }
    // A point does not tell the order, so that two different forces contradict each other.
    let rows = exact
        .iter()
        .map(|one| Placed::at(point(one), Force::Along(one.force)));
    let wrong = Placed::at(point(&exact[4]), Force::Along(2.0 * exact[4].force));
    let comparison = compared(rows.chain([wrong]).collect());
    assert_eq!(
        (comparison.matched(), comparison.contradictory(0.5)),
        (12, 1)
    );
    assert_eq!(comparison.worst().unwrap().ids, exact[4].ids);
}

#[test]
fn the_floor_is_judged() {
    for pile in piles() {
        let packing = packing(&pile, ratio(6, 5));
        let (exact, floor) = (perfect(&packing), on_floor(&packing));
        let spheres = u64::try_from(pile.sphere_count()).unwrap();
        for wall in [0, spheres + 1, spheres + 7, u64::MAX] {
            let rows = floor.iter().map(|(id, normal)| {
                let one = Measured::new([*id, wall], *normal);
                if id % 2 == 0 { one } else { one.reversed() }
            });
            let rows: Vec<_> = exact.iter().copied().chain(rows).collect();
            let comparison = compare(&packing, &rows);
            assert!(comparison.accepted(0.0), "{comparison}");
            assert_eq!(comparison.floor(), floor.len() as u64);
            assert_eq!(comparison.floor_error(), Some(0.0));
            // Each wrong force is found.
            let last = rows.len() - 1;
            let mut wrong = rows.clone();
            wrong[last].force += 0.5 * comparison.largest_force().max(1.0);
            let comparison = compare(&packing, &wrong);
            assert!(!comparison.accepted(1e-3), "{comparison}");
            let found = comparison.findings(1e-3);
            let said = "the normal force of the floor is wrong at 1 of the bottom spheres";
            assert!(found[0].text.starts_with(said), "{found:?}");
            assert_eq!(found.len(), 1, "{found:?}");
        }
    }
}

#[test]
fn the_vertical_forces_of_several_walls_are_added_up() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let floor = on_floor(&packing);
    let (wall, ground) = (0, 11);
    let mut rows = perfect(&packing);
    for (id, normal) in &floor {
        // The wall carries a quarter of the weight by friction.
        rows.push(Measured::of_vector(
            [*id, ground],
            [0.1, 0.2, 0.75 * normal],
        ));
        rows.push(Measured::of_vector([wall, *id], [0.3, 0.2, -0.25 * normal]));
    }
    let comparison = compare(&packing, &rows);
    assert!(comparison.accepted(1e-15), "{comparison}");
    assert_eq!(comparison.floor(), 12);
    // Both rows again, in the reverse order.
    let reversed = rows[12..].iter().map(|one| one.reversed());
    let doubled: Vec<_> = rows.iter().copied().chain(reversed).collect();
    let comparison = compare(&packing, &doubled);
    assert!(comparison.accepted(1e-15), "{comparison}");
    assert_eq!((comparison.floor(), comparison.repeated()), (12, 12));
    let mut wrong = doubled;
    let last = wrong.last_mut().unwrap();
    last.vector = last.vector.map(|[x, y, z]| [x, y, 1.5 * z]);
    let comparison = compare(&packing, &wrong);
    assert_eq!(comparison.contradictory(0.1), 1);
    assert!((comparison.floor_error().unwrap() - 0.125).abs() < 1e-12);
    // Of magnitudes, the vertical parts are unknown.
    let table = |second: &str| {
        let mut table = String::from("id1,id2,force\n");
        for one in perfect(&packing) {
            let [a, b] = one.ids;
            writeln!(table, "{a},{b},{:?}", one.force).unwrap();
        }
        for (id, normal) in &floor {
            writeln!(table, "{id},-1,{normal:?}\n{id},-4,{second}").unwrap();
        }
        table
    };
    let read = |table: &str| Reader::new().compare(&packing, table.as_bytes()).unwrap();
    let several = read(&table("0.5"));
    assert!(several.comparison.accepted(0.0));
    assert_eq!((several.walls, several.comparison.floor()), (12, 0));
    // A wall without a force has no vertical part.
    let one = read(&table("0"));
    assert_eq!((one.walls, one.comparison.floor()), (0, 12));
    assert_eq!(one.comparison.floor_error(), Some(0.0));
}

#[test]
fn each_contact_with_the_floor_may_have_a_number_of_its_own() {
    for pile in piles() {
        let packing = packing(&pile, ratio(6, 5));
        let spheres = u64::try_from(pile.sphere_count()).unwrap();
        let walls = (spheres + 1..).zip(on_floor(&packing));
        let walls: Vec<_> = walls
            .map(|(wall, (id, normal))| Measured::new([id, wall], normal))
            .collect();
        let mut rows = [perfect(&packing), walls.clone()].concat();
        let comparison = compare(&packing, &rows);
        assert!(comparison.accepted(0.0), "{comparison}");
        assert_eq!(comparison.floor(), walls.len() as u64);
        let last = rows.last_mut().unwrap();
        last.force += 0.5 * comparison.largest_force().max(1.0);
        assert!(!compare(&packing, &rows).accepted(1e-3));
    }
}

#[test]
fn only_bottom_spheres_touch_walls() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    for (ids, wrong) in [([0, 4], 0), ([4, 11], 11), ([3, 0], 0), ([12, 0], 12)] {
        let id = wrong;
        let (first, spheres) = (1, 10);
        assert_eq!(
            refused(&packing, &[Measured::new(ids, 1.0)]),
            Fault::NoSuchSphere { id, first, spheres }
        );
    }
}

#[test]
fn the_table_of_a_higher_pile_is_refused() {
    for (higher, lower) in [
        (Pile::triangular(4).unwrap(), Pile::triangular(3).unwrap()),
        (Pile::triangular(3).unwrap(), Pile::triangular(2).unwrap()),
        (Pile::discs(5).unwrap(), Pile::discs(4).unwrap()),
        (Pile::discs(3).unwrap(), Pile::discs(2).unwrap()),
    ] {
        let rows = perfect(&packing(&higher, ratio(6, 5)));
        let lower = packing(&lower, ratio(6, 5));
        for rows in [magnitudes(&rows), rows] {
            let fault = refused(&lower, &rows);
            assert!(
                matches!(fault, Fault::NoSuchSphere { first: 1, .. }),
                "{fault}"
            );
        }
    }
}

#[test]
fn a_force_and_its_vector_that_disagree_are_reported() {
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let exact = perfect(&packing);
    let planted = |change: fn(&mut Measured)| {
        let mut rows = exact.clone();
        rows.iter_mut().skip(2).for_each(change);
        let [finding] = &compare(&packing, &rows).findings(1e-6)[..] else {
            panic!();
        };
        assert_eq!(finding.kind, FindingKind::Disagreement);
        finding.to_string()
    };
    let found = |forces_are_exact, vectors_are_exact| {
        let which = match (forces_are_exact, vectors_are_exact) {
            (true, _) => "all forces are the exact ones",
            (_, true) => "all vectors are the exact ones",
            _ => "neither are the exact ones at all contacts",
        };
        format!("force and vector disagree at 28 of the contacts: {which}")
    };
    assert_eq!(planted(|one| one.force = 0.0), found(false, true));
    assert_eq!(planted(|one| one.force *= 2.0), found(false, true));
    assert_eq!(
        planted(|one| one.vector = Some([0.0; 3])),
        found(true, false)
    );
    let neither = planted(|one| {
        one.force *= 2.0;
        one.vector = one.vector.map(|vector| vector.map(|x| 3.0 * x));
    });
    assert_eq!(neither, found(false, false));
    // A factor of all forces would be another explanation.
    let mut rows = exact.clone();
    for one in &mut rows {
        one.force *= 1e3;
    }
    let [finding] = &compare(&packing, &rows).findings(1e-6)[..] else {
        panic!();
    };
    assert_eq!(
        finding.to_string(),
        "force and vector disagree at 30 of the contacts: all vectors are the exact ones"
    );
}

#[test]
fn errors_have_the_numbers_of_the_table() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let read = |first: u64, rows: &str| {
        let reader = Reader::new().with_columns(Columns::default().with_first_id(first));
        let table = format!("id1,id2,force\n{rows}");
        let refusal = reader.compare(&packing, table.as_bytes()).unwrap_err();
        refusal.to_string()
    };
    let ten = "the spheres of this scene are numbered 0 to 9, from the top";
    assert_eq!(
        read(0, "3,10,0.4\n"),
        format!(
            "line 2: no sphere 10: {ten}; does the table have more layers, or several numbers for one wall?"
        )
    );
    assert_eq!(
        read(0, "3,-1,0.4\n"),
        format!("line 2: no sphere -1: {ten}")
    );
    assert_eq!(
        read(1, "0,1,0.4\n"),
        "line 2: no sphere 0: the spheres of this scene are numbered 1 to 10, from the top; if the table counts from 0, \
         use --first-id 0"
    );
    let twice = read(0, "0,1,0.4\n0,1,0.5\n");
    assert!(
        twice.starts_with("line 3: spheres 0 and 1 are already on line 2: "),
        "{twice}"
    );
    let one = read(100, "103,103,0.4\n");
    assert!(
        one.starts_with("line 2: sphere 103 is paired with itself"),
        "{one}"
    );
}

/// The exact floor force of a loaded pile contains the load.
#[test]
fn a_load_reaches_the_floor() {
    let pile = Pile::triangular(2).unwrap().weightless();
    let pile = pile.with_load(Site::APEX, ratio(6, 1)).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let rows = [2, 3, 4].map(|id| Measured::new([id, 0], 2.0));
    assert_eq!(compare(&packing, &rows).floor_error(), Some(0.0));
}
