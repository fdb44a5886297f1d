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

use super::contacts::on_floor;
use super::{packing, perfect, ratio, site};

/// The frame of the scene.
fn own() -> Frame {
    upright(Axes::OWN, 0.0, [0.0; 3])
}

/// Returns the frame that permutes the axes, turns about z by an angle in radians, and then shifts.
fn upright(axes: Axes, angle: f64, shift: [f64; 3]) -> Frame {
    Frame { axes, angle, shift }
}

/// Returns a frame with another vertical axis.
fn lying(shift: [f64; 3]) -> Frame {
    upright(
        Axes::new([Y, Z, X].map(TableAxis::from)).unwrap(),
        0.0,
        shift,
    )
}

/// Returns a table of centres or of contact points, as seen from another frame. Every `left_out`-th contact is missing.
fn table(packing: &Packing<'_>, seen: &Frame, by_point: bool, left_out: usize) -> String {
    let keeps = |n: usize, _: &Measured| left_out == 0 || !n.is_multiple_of(left_out);
    table_of(packing, seen, by_point, keeps, |centre| centre)
}

/// Returns a table of some contacts, with displaced centres.
fn table_of(
    packing: &Packing<'_>,
    seen: &Frame,
    by_point: bool,
    keeps: impl Fn(usize, &Measured) -> bool,
    displaced: impl Fn([f64; 3]) -> [f64; 3],
) -> String {
    let places = packing.positions(Selection::All).unwrap();
    let centres: Vec<[f64; 3]> = places
        .map(|place| displaced(place.unwrap().map(|x| x.nearest::<f64>().unwrap())))
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
        if !keeps(n, &row) {
            continue;
        }
        let row = if n % 3 == 0 { row.reversed() } else { row };
        let [a, b] = row
            .ids
            .map(|id| seen.place(centres[usize::try_from(id - 1).unwrap()]));
        let force = seen.turned(row.vector.unwrap());
        text += &line(by_point, [a, b], force, row.force);
    }
    text
}

fn line(by_point: bool, [a, b]: [[f64; 3]; 2], vector: [f64; 3], force: f64) -> String {
    let middle = [0, 1, 2].map(|x: usize| a[x].midpoint(b[x]));
    let numbers = if by_point {
        [&middle[..], &vector, &[force]].concat()
    } else {
        [&a[..], &b, &vector, &[force]].concat()
    };
    let texts: Vec<String> = numbers.iter().map(|x| format!("{x:?}")).collect();
    texts.join(",") + "\n"
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
        (Axes::OWN, 0.0, [0.0; 3]),
        (Axes::OWN, 0.0, [3.0, -20.0, 0.5]),
        (Axes::OWN, 0.3, [0.0; 3]),
        (Axes::OWN, -2.5, [1.0, 1.0, 1.0]),
        (turned([Y, Z, X], [f; 3]), 0.0, [0.0; 3]),
        (turned([X, Z, Y], [f, f, t]), 0.0, [5.0, 6.0, 7.0]),
        (turned([Z, Y, X], [t, f, f]), 0.0, [-1.0, 0.0, 0.0]),
        (turned([X, Y, Z], [f, t, t]), 0.0, [0.0, 0.0, 9.0]),
    ];
    for pile in piles() {
        let packing = packing(&pile, ratio(11, 10));
        for (axes, angle, shift) in frames {
            let seen = upright(axes, angle, shift);
            for by_point in [false, true] {
                let read = read(&packing, &table(&packing, &seen, by_point, 0)).unwrap();
                assert!(
                    read.comparison.accepted(1e-9),
                    "{seen:?} {by_point} {:?}: {}",
                    read.frame,
                    read.comparison
                );
                assert_eq!(read.comparison.missing(), 0);
                assert_eq!(read.frame.is_none(), seen == own());
                assert!(read.frame.is_none_or(|frame| !frame.axes.is_mirrored()));
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
        let seen = upright(Axes::OWN, angle, [shift * radius, 0.0, 0.0]);
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
    let seen = upright(Axes::OWN, 0.7, [4.0; 3]);
    for left_out in [3, 10, 60] {
        let read = read(&packing, &table(&packing, &seen, false, left_out)).unwrap();
        let count = read.comparison.contacts();
        assert_eq!(read.comparison.missing(), count.div_ceil(left_out as u64));
        assert!(
            read.comparison.largest_error().unwrap() < 1e-9,
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
    let axes = Axes::new([Y, X, Z].map(TableAxis::from)).unwrap();
    let seen = upright(axes, 0.0, [0.0; 3]);
    let read = read(&packing, &table(&packing, &seen, false, 0)).unwrap();
    // A rotation also matches all positions, so only the forces show the mirror image.
    assert!(read.frame.unwrap().axes.is_mirrored());
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
    assert!(read.frame.unwrap().axes.is_mirrored());
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
    let text = table(&small, &own(), false, 0);
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
            let seen = upright(Axes::OWN, angle, shift);
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
    let table = table(&packing, &own(), true, 0);
    for row in table.lines().skip(1).map(|line| line.split(',')) {
        let x: Vec<f64> = row.map(|x| x.parse().unwrap()).collect();
        let (point, vector) = ([x[0], x[1], x[2]], [x[3], x[4], x[5]]);
        for force in [Force::Along(x[6]), Force::Vector(vector)] {
            let measured = [Placed::at(point, force)];
            let (comparison, _) = Comparison::of_places(&packing, measured, 0.1).unwrap();
            assert_eq!(comparison.matched(), 1);
            assert!(comparison.largest_error().unwrap() < 1e-12, "{comparison}");
        }
        // With the opposite sign the force is tensile.
        let measured = [Placed::at(point, Force::Along(-x[6]))];
        let (comparison, _) = Comparison::of_places(&packing, measured, 0.1).unwrap();
        assert!((comparison.largest_error().unwrap() - 2.0).abs() < 1e-12);
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
    let said = refused(&[good, good, good], 0.1);
    assert!(
        said.starts_with("entry 3: ") && said.contains("list each pair once"),
        "{said}"
    );
    assert!(refused(&[good], 0.5).contains("0.5 radii are not between 0 and 0.5"));
    let off = Placed::at([0.0, 0.0, 50.0], Force::Along(1.0));
    let said = refused(&[good, off], 0.1);
    assert!(said.contains("no contact at"), "{said}");
}

#[test]
fn a_table_that_leans_is_refused_with_a_remedy() {
    for pile in piles() {
        let packing = packing(&pile, ratio(11, 10));
        for degrees in [12.0_f64, 30.0, 61.0, 144.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let lean = |[x, y, z]: [f64; 3]| [cos * x - sin * z, y, sin * x + cos * z];
            for by_point in [false, true] {
                let table = table(&packing, &own(), by_point, 0);
                let mut lines = table.lines();
                let mut leaning = format!("{}\n", lines.next().unwrap());
                for line in lines {
                    let x: Vec<f64> = line.split(',').map(|x| x.parse().unwrap()).collect();
                    let vectors = x.chunks_exact(3).flat_map(|v| lean([v[0], v[1], v[2]]));
                    let numbers = vectors.chain(x.last().copied());
                    let numbers: Vec<String> = numbers.map(|x| format!("{x:?}")).collect();
                    leaning += &(numbers.join(",") + "\n");
                }
                let said = read(&packing, &leaning).unwrap_err().to_string();
                assert!(
                    said.contains("turn positions and vectors"),
                    "{degrees} {said}"
                );
            }
        }
    }
}

#[test]
fn the_words_for_a_frame_are_those_of_its_kind() {
    let axes = |axes: [TableAxis; 3]| upright(Axes::new(axes).unwrap(), 0.0, [0.0; 3]);
    let down = TableAxis {
        is_reversed: true,
        ..Z.into()
    };
    let third = std::f64::consts::FRAC_PI_3;
    for (frame, words) in [
        (own(), ""),
        (
            upright(Axes::OWN, third, [0.0, -1e-9, 2.0]),
            "turned about z by 60.000000 degrees; moved by (0.000000, 0.000000, 2.000000) m",
        ),
        (
            axes([Y.into(), Z.into(), X.into()]),
            "x, y, z of the scene are y, z, x of the table",
        ),
        (
            axes([Y.into(), X.into(), Z.into()]),
            "x, y, z of the scene are y, x, z of the table, a mirror image",
        ),
        (
            axes([Y.into(), X.into(), down]),
            "x, y, z of the scene are y, x, -z of the table",
        ),
        (
            upright(
                Axes::new([Y, Z, X].map(TableAxis::from)).unwrap(),
                third,
                [0.0; 3],
            ),
            "x, y, z of the scene are y, z, x of the table; turned about z by 60.000000 degrees",
        ),
    ] {
        assert_eq!(frame.to_string(), words);
    }
}

/// Returns the rows of the contacts of bottom spheres with the floor: each sphere, and a point at a depth below it. At
/// the depth 2R, the contact point is R below.
fn floor_rows(packing: &Packing<'_>, seen: &Frame, by_point: bool, depth: f64) -> String {
    let places = packing.positions(Selection::Base).unwrap();
    let rows = places.zip(on_floor(packing)).map(|(place, (id, normal))| {
        let [x, y, z] = place.unwrap().map(|x| x.nearest::<f64>().unwrap());
        let (mut ends, mut force) = ([[x, y, z], [x, y, z - depth]], [0.0, 0.0, normal]);
        if id % 2 == 0 {
            ends.reverse();
            force = force.map(|x| -x);
        }
        let ends = ends.map(|end| seen.place(end));
        line(by_point, ends, seen.turned(force), normal)
    });
    rows.collect()
}

#[test]
fn contacts_with_the_floor_are_recognised_in_any_frame() {
    let pile = Pile::triangular(5).unwrap();
    let packing = packing(&pile, ratio(11, 10));
    let shift = [1.0, 2.0, 3.0];
    for seen in [own(), upright(Axes::OWN, 0.4, shift), lying(shift)] {
        for (by_point, depth) in [(true, 2.0), (false, 1.0), (false, 1.5), (false, 2.0)] {
            let contacts = table(&packing, &seen, by_point, 0);
            let floor = floor_rows(&packing, &seen, by_point, depth);
            let read = read(&packing, &(contacts + &floor)).unwrap();
            let comparison = &read.comparison;
            assert_eq!(comparison.beyond(1e-9), 0, "{by_point} {depth}");
            assert_eq!(comparison.matched(), comparison.contacts());
            assert_eq!(comparison.floor(), 15, "{by_point} {depth}");
            assert!(comparison.floor_error().unwrap() < 1e-9);
            // One force is wrong.
            let contacts = table(&packing, &seen, by_point, 0);
            let force = format!("{:?}\n", on_floor(&packing)[4].1);
            let wrong = floor.replacen(&force, "0.5\n", 1);
            assert_ne!(floor, wrong);
            let magnitudes = |text: &str| text.replace("fx,fy,fz,force", "a,b,c,force");
            let text = magnitudes(&(contacts + &wrong));
            let read = Reader::new().by_place(0.1).unwrap();
            let read = read.compare(&packing, text.as_bytes()).unwrap();
            assert!(read.comparison.floor_error().unwrap() > 0.1);
        }
        // Points at other depths are on no contact.
        for (by_point, depth) in [(true, 2.3), (false, 0.7), (false, 2.3)] {
            let contacts = table(&packing, &seen, by_point, 0);
            let floor = floor_rows(&packing, &seen, by_point, depth);
            let said = read(&packing, &(contacts + &floor))
                .unwrap_err()
                .to_string();
            assert!(said.starts_with("line 62: no contact at"), "{said}");
        }
    }
}

/// The contacts of one layer with the next are missing.
#[test]
fn a_missing_layer_does_not_hide_the_frame() {
    let pile = Pile::triangular(6).unwrap();
    let packing = packing(&pile, ratio(11, 10));
    let seen = upright(Axes::OWN, 0.4, [1.0, 2.0, 3.0]);
    for layer in 0..5_i128 {
        for by_point in [false, true] {
            let keeps = |_, measured: &Measured| site(&pile, measured).k != layer;
            let table = table_of(&packing, &seen, by_point, keeps, |centre| centre);
            let read = read(&packing, &table).unwrap();
            let comparison = &read.comparison;
            let case = format!("{layer} {by_point}: {comparison}");
            assert_eq!(comparison.beyond(1e-9), 0, "{case}");
            let spheres = u64::try_from((layer + 1) * (layer + 2) / 2).unwrap();
            assert_eq!(comparison.missing(), 3 * spheres, "{case}");
        }
    }
}

/// Spheres on springs are displaced, by less than a tenth of R. Neighbours in a layer have no force.
#[test]
fn displaced_spheres_and_neighbours_without_force_do_not_hide_the_frame() {
    for pile in piles() {
        let packing = packing(&pile, ratio(11, 10));
        let displaced = |[x, y, z]: [f64; 3]| {
            let sunk = 0.01 * z + 0.003 * x;
            [x * 1.004 + 0.01 * (3.0 * z).sin(), y * 1.004, z - sunk]
        };
        let shift = [1.0, 2.0, 3.0];
        for seen in [upright(Axes::OWN, 0.4, shift), lying(shift)] {
            for by_point in [false, true] {
                let table = table_of(&packing, &seen, by_point, |_, _| true, displaced);
                let open = line(by_point, [[0.0; 3], [2.2, 0.0, 0.0]], [0.0; 3], 0.0);
                let read = read(&packing, &(table + &open.repeat(20))).unwrap();
                let comparison = &read.comparison;
                let case = format!("{seen:?} {by_point} {:?}: {comparison}", read.frame);
                assert_eq!(comparison.missing(), 0, "{case}");
                assert_eq!(comparison.beyond(0.03), 0, "{case}");
                if seen.axes == Axes::OWN {
                    let said = read.frame.unwrap().to_string();
                    assert!(said.starts_with("turned about z by"), "{said}");
                }
            }
        }
    }
}

#[test]
fn a_lying_table_of_another_pile_is_rejected() {
    let [small, other] = [Pile::triangular(6), Pile::discs(9)].map(Result::unwrap);
    let flat = Pile::on(Region::hexagon(4, 3).unwrap(), "+-".parse().unwrap()).unwrap();
    let seen = lying([1.0, 2.0, 3.0]);
    let wide = packing(&small, ratio(6, 5));
    let packings = [&small, &other, &flat].map(|pile| packing(pile, ratio(1, 1)));
    for (n, one) in packings.iter().enumerate() {
        for (m, another) in packings.iter().chain([&wide]).enumerate() {
            for by_point in [false, true] {
                let read = read(another, &table(one, &seen, by_point, 0));
                assert_eq!(read.is_err(), n != m, "{n} {m} {by_point} {read:?}");
            }
        }
    }
}
