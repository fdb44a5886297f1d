//! Contacts are matched by position, in any frame and in any order. A table of another pile is rejected.

use cannonpile::lattice::{Direction, Region, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{Packing, Pile};
use cannonpile_dem::verify::Coordinate::{X, Y, Z};
use cannonpile_dem::verify::{
    Axes, Compared, Comparison, Coordinate, Force, Frame, Measured, Placed, Reader, Refusal,
    TableAxis,
};
use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::{packing, perfect, ratio};

fn own_axes() -> Axes {
    Axes::new([X, Y, Z].map(TableAxis::from)).unwrap()
}

/// Returns a table of centres or of contact points, as seen from another frame. Every `left_out`-th contact is missing.
fn table(packing: &Packing<'_>, seen: &Frame, by_point: bool, left_out: usize) -> String {
    let places = packing.positions(Selection::All).unwrap();
    let centres: Vec<[f64; 3]> = places
        .map(|place| place.unwrap().map(|x| x.nearest::<f64>().unwrap()))
        .collect();
    let mut rows: Vec<Measured> = perfect(packing);
    // The rows are in a pseudo-random order, and name either sphere first.
    rows.sort_by_key(|row| row.ids.map(|id| id * 7919 % 101));
    let mut text = String::from(if by_point {
        "x,y,z,fx,fy,fz,force\n"
    } else {
        "x1,y1,z1,x2,y2,z2,fx,fy,fz,force\n"
    });
    for (n, row) in rows.into_iter().enumerate() {
        if left_out > 0 && n % left_out == 0 {
            continue;
        }
        let row = if n % 3 == 0 { row.reversed() } else { row };
        let [a, b] = row
            .ids
            .map(|id| seen.place(centres[usize::try_from(id - 1).unwrap()]));
        let force = seen.turned(row.vector.unwrap());
        let middle = [0, 1, 2].map(|x: usize| a[x].midpoint(b[x]));
        let numbers = if by_point {
            [&middle[..], &force, &[row.force]].concat()
        } else {
            [&a[..], &b, &force, &[row.force]].concat()
        };
        let texts: Vec<String> = numbers.iter().map(|x| format!("{x:?}")).collect();
        text += &texts.join(",");
        text.push('\n');
    }
    text
}

fn read(packing: &Packing<'_>, table: &str) -> Result<Compared, Refusal> {
    let reader = Reader::new().by_place(0.1).unwrap();
    reader.compare(packing, table.as_bytes())
}

fn one(n: i64) -> BigRational {
    BigRational::from_integer(n.into())
}

fn piles() -> Vec<Pile> {
    let middle = Site { i: 1, j: 0, k: 1 };
    vec![
        Pile::triangular(6).unwrap(),
        Pile::under(Region::hexagon(2, 2).unwrap(), Stacking::hcp(5).unwrap()).unwrap(),
        Pile::triangular(5)
            .unwrap()
            .with_load(middle, one(3))
            .unwrap(),
        Pile::discs(6).unwrap(),
    ]
}

#[test]
fn a_table_in_any_frame_is_accepted_and_its_frame_is_reported() {
    let turned = |axes: [Coordinate; 3], signs: [bool; 3]| {
        let mut signs = signs.into_iter();
        let axes = axes.map(|coordinate| TableAxis {
            coordinate,
            is_reversed: signs.next().unwrap(),
        });
        Axes::new(axes).unwrap()
    };
    let [t, f] = [true, false];
    let frames = [
        (own_axes(), 0.0, [0.0; 3]),
        (own_axes(), 0.0, [3.0, -20.0, 0.5]),
        (own_axes(), 0.3, [0.0; 3]),
        (own_axes(), -2.5, [1.0, 1.0, 1.0]),
        (turned([Y, Z, X], [f; 3]), 0.0, [0.0; 3]),
        (turned([X, Z, Y], [f, f, t]), 0.0, [5.0, 6.0, 7.0]),
        (turned([Z, Y, X], [t, f, f]), 0.0, [-1.0, 0.0, 0.0]),
        (turned([X, Y, Z], [f, t, t]), 0.0, [0.0, 0.0, 9.0]),
    ];
    for pile in piles() {
        let packing = packing(&pile, ratio(11, 10));
        for (axes, angle, shift) in frames {
            let seen = Frame { axes, angle, shift };
            for by_point in [false, true] {
                let read = read(&packing, &table(&packing, &seen, by_point, 0)).unwrap();
                assert!(
                    read.comparison.accepted(1e-9),
                    "{seen:?} {by_point} {:?}: {}",
                    read.frame,
                    read.comparison
                );
                assert_eq!(read.comparison.missing(), 0);
                assert_eq!(
                    read.frame.is_none(),
                    seen == Frame {
                        axes: own_axes(),
                        angle: 0.0,
                        shift: [0.0; 3]
                    }
                );
                assert!(read.frame.is_none_or(|frame| !frame.is_mirrored()));
            }
        }
    }
}

/// Angles that exceed 30° by 9/10000 displace the ends of a wide pile by 4 % of R. A shift of the same size exceeds the
/// accepted distance.
#[test]
fn rounding_moves_no_position_beyond_the_accepted_distance() {
    let wide = Pile::discs(40).unwrap();
    let small = Pile::triangular(5).unwrap();
    for (pile, within, angle, shift) in [
        (&wide, 0.02, std::f64::consts::FRAC_PI_6 + 9e-4, 0.0),
        (&wide, 0.02, -9e-4, 0.0),
        (&small, 5e-4, 0.0, 9e-4),
    ] {
        let packing = packing(pile, ratio(11, 10));
        let radius = packing.radius().to_f64().unwrap();
        let seen = Frame {
            axes: own_axes(),
            angle,
            shift: [shift * radius, 0.0, 0.0],
        };
        let reader = Reader::new().by_place(within).unwrap();
        let table = table(&packing, &seen, false, 0);
        let read = reader.compare(&packing, table.as_bytes()).unwrap();
        assert!(read.comparison.accepted(1e-9), "{}", read.comparison);
        assert_eq!(read.comparison.missing(), 0);
    }
}

#[test]
fn missing_contacts_are_counted_in_any_frame() {
    let pile = Pile::triangular(7).unwrap();
    let packing = packing(&pile, ratio(11, 10));
    let (angle, shift) = (0.7, [4.0, 4.0, 4.0]);
    let seen = Frame {
        axes: own_axes(),
        angle,
        shift,
    };
    for left_out in [3, 10, 60] {
        let read = read(&packing, &table(&packing, &seen, false, left_out)).unwrap();
        let count = read.comparison.contacts();
        assert_eq!(read.comparison.missing(), count.div_ceil(left_out as u64));
        assert!(
            read.comparison.largest_error() < 1e-9,
            "{}",
            read.comparison
        );
    }
}

#[test]
fn a_mirror_image_is_reported() {
    // The first load lies off every plane of symmetry. With the second one, no rotation restores the forces.
    let pile = Pile::triangular(5).unwrap();
    let pile = pile.with_load(Site { i: 1, j: 0, k: 2 }, one(3)).unwrap();
    let pile = pile.with_load(Site { i: 0, j: 1, k: 3 }, one(7)).unwrap();
    let packing = packing(&pile, ratio(11, 10));
    let seen = Frame {
        axes: Axes::new([Y, X, Z].map(TableAxis::from)).unwrap(),
        angle: 0.0,
        shift: [0.0; 3],
    };
    let read = read(&packing, &table(&packing, &seen, false, 0)).unwrap();
    // A rotation also matches all positions, so only the forces show the mirror image.
    assert!(read.frame.unwrap().is_mirrored());
    assert!(read.comparison.accepted(1e-9), "{}", read.comparison);
    // In this pile no rotation matches the positions.
    let stacking: Stacking = "+-++-".parse().unwrap();
    let pile = Pile::under(Region::new(0..=3, 0..=2, 0..=4).unwrap(), stacking).unwrap();
    let packing = packing_of(&pile);
    let table = table(&packing, &seen, false, 0);
    let read = Reader::new()
        .by_place(0.1)
        .unwrap()
        .compare(&packing, table.as_bytes())
        .unwrap();
    assert!(read.frame.unwrap().is_mirrored());
    assert!(read.frame.unwrap().to_string().contains("a mirror image"));
    assert!(read.comparison.accepted(1e-9), "{}", read.comparison);
}

fn packing_of(pile: &Pile) -> Packing<'_> {
    packing(pile, ratio(11, 10))
}

#[test]
fn a_table_of_another_pile_is_rejected() {
    let (small, other) = (Pile::triangular(6).unwrap(), Pile::triangular(6).unwrap());
    let (small, other) = (packing(&small, ratio(11, 10)), packing(&other, ratio(1, 1)));
    let own = Frame {
        axes: own_axes(),
        angle: 0.0,
        shift: [0.0; 3],
    };
    let text = table(&small, &own, false, 0);
    let line = read(&other, &text).unwrap_err().to_string();
    assert!(
        line.starts_with(
            "no frame matches the positions of the table to the scene: the best one matches "
        ),
        "{line}"
    );
    // The table has one row at a position without a sphere.
    let text = text + "9,9,9,9,9,11,0,0,1,1\n";
    let line = read(&small, &text).unwrap_err().to_string();
    assert!(
        line.starts_with("line 107: no contact at (9.000000, 9.000000, 10.000000) m"),
        "{line}"
    );
    // A row without a force is ignored.
    let text = text.replace("9,9,9,9,9,11,0,0,1,1", "9,9,9,9,9,9,0,0,0,0");
    assert!(read(&small, &text).unwrap().comparison.accepted(1e-9));
}

#[test]
fn matching_by_position_needs_its_columns() {
    let pile = Pile::triangular(2).unwrap();
    let packing = packing(&pile, ratio(1, 1));
    let line = read(&packing, "id1,id2,force\n1,2,0.4\n")
        .unwrap_err()
        .to_string();
    assert!(
        line.starts_with("line 1: no column x, only 'id1', 'id2', 'force'"),
        "{line}"
    );
    let line = read(&packing, "x1,z1,x2,force\n1,2,0.4,1\n")
        .unwrap_err()
        .to_string();
    assert!(line.starts_with("line 1: no column z2, only"), "{line}");
    assert!(Reader::new().by_place(0.0).is_err() && Reader::new().by_place(f64::NAN).is_err());
}

#[test]
fn any_contact_in_a_pile_of_one_sphere_is_rejected() {
    let pile = Pile::triangular(1).unwrap();
    let packing = packing(&pile, ratio(1, 1));
    let empty = read(&packing, "x,y,z,force\n").unwrap();
    assert!(empty.comparison.accepted(0.0));
    for row in ["0,0,0,0", "0,0,0,1"] {
        let refused = read(&packing, &format!("x,y,z,force\n{row}\n")).unwrap_err();
        assert!(matches!(
            refused,
            Refusal::Elsewhere {
                found: 0,
                sample: 1
            }
        ));
    }
}

/// Returns the rows of a table in memory.
fn placed(table: &str, by_point: bool) -> Vec<Placed> {
    let lines = table.lines().skip(1);
    let row = lines.map(|line| {
        let x: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
        let point = |at: usize| [x[at], x[at + 1], x[at + 2]];
        if by_point {
            Placed::at(point(0), Force::Both(x[6], point(3)))
        } else {
            Placed::between([point(0), point(3)], Force::Both(x[9], point(6)))
        }
    });
    row.collect()
}

#[test]
fn rows_in_memory_give_the_same_result_as_a_file() {
    for pile in piles() {
        let packing = packing(&pile, ratio(11, 10));
        for (angle, shift) in [(0.0, [0.0; 3]), (-2.5, [1.0, 1.0, 1.0])] {
            let axes = own_axes();
            let seen = Frame { axes, angle, shift };
            for (by_point, left_out) in [(false, 0), (true, 0), (true, 10)] {
                let table = table(&packing, &seen, by_point, left_out);
                let of_file = read(&packing, &table).unwrap();
                let placed = placed(&table, by_point);
                let of_memory = Comparison::of_places(&packing, placed, 0.1).unwrap();
                assert_eq!(of_memory, (of_file.comparison, of_file.frame));
            }
        }
    }
}

#[test]
fn a_magnitude_or_a_vector_alone_suffices() {
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, ratio(11, 10));
    let own = Frame {
        axes: own_axes(),
        angle: 0.0,
        shift: [0.0; 3],
    };
    let table = table(&packing, &own, true, 0);
    for row in table.lines().skip(1).map(|line| line.split(',')) {
        let x: Vec<f64> = row.map(|x| x.parse().unwrap()).collect();
        let (point, vector) = ([x[0], x[1], x[2]], [x[3], x[4], x[5]]);
        for force in [Force::Along(x[6]), Force::Vector(vector)] {
            let measured = [Placed::at(point, force)];
            let (comparison, _) = Comparison::of_places(&packing, measured, 0.1).unwrap();
            assert_eq!(comparison.matched(), 1);
            assert!(comparison.largest_error() < 1e-12, "{comparison}");
        }
        // With the opposite sign the force is tensile.
        let measured = [Placed::at(point, Force::Along(-x[6]))];
        let (comparison, _) = Comparison::of_places(&packing, measured, 0.1).unwrap();
        assert!((comparison.largest_error() - 2.0).abs() < 1e-12);
    }
}

#[test]
fn invalid_rows_in_memory_are_rejected_with_their_number() {
    let pile = Pile::triangular(3).unwrap();
    let packing = packing(&pile, ratio(11, 10));
    let point = packing.contact_point(Site::APEX, Direction::Alpha).unwrap();
    let point = point.map(|x| x.nearest::<f64>().unwrap());
    let good = Placed::at(point, Force::Along(0.4));
    let refused = |rows: &[Placed], within: f64| {
        let refused = Comparison::of_places(&packing, rows.iter().copied(), within);
        refused.unwrap_err().to_string()
    };
    for number in [f64::NAN, f64::INFINITY] {
        for bad in [
            Placed::at(point, Force::Along(number)),
            Placed::at(point, Force::Vector([0.0, number, 1.0])),
            Placed::at(point, Force::Both(1.0, [number; 3])),
            Placed::at([0.0, 0.0, number], Force::Along(1.0)),
            Placed::between([point, [0.0, number, 0.0]], Force::Along(0.0)),
        ] {
            let said = refused(&[good, bad], 0.1);
            assert!(
                said.starts_with("entry 2: ") && said.contains("finite"),
                "{said}"
            );
        }
    }
    let said = refused(&[good, good], 0.1);
    assert!(
        said.starts_with("entry 2: ") && said.contains("list each pair once"),
        "{said}"
    );
    assert!(refused(&[good], 0.5).contains("0.5 radii are not between 0 and 0.5"));
    let off = Placed::at([0.0, 0.0, 50.0], Force::Along(1.0));
    let said = refused(&[good, good, off, off, off], 0.1);
    assert!(said.contains("no contact at"), "{said}");
}
