//! Positions written along rows equal those of single queries.

use cannonpile::geometry::Spacing;
use cannonpile::lattice::{Direction, Region, Row, Site};
use cannonpile::scalar::Surd;
use cannonpile::shape::Selection;
use cannonpile::{Error, Method, Packing, Pile};

use cannonpile_testkit::answers::ratio;

fn packing(pile: &Pile) -> Packing<'_> {
    let spacing = Spacing::new(ratio(6, 5)).unwrap();
    let packing = Packing::new(pile, &spacing).unwrap();
    packing.with_radius(ratio(3, 7)).unwrap()
}

fn nearest(exact: &Surd) -> f64 {
    exact.nearest().unwrap()
}

/// The values x, y and z of each sphere of a row.
fn filled(row: &Row, fill: impl FnOnce([&mut [f64]; 3])) -> Vec<[f64; 3]> {
    let [mut x, mut y, mut z] = [(); 3].map(|()| vec![0.0; row.clone().into_iter().count()]);
    fill([&mut x, &mut y, &mut z]);
    let places = x.into_iter().zip(y).zip(z);
    places.map(|((x, y), z)| [x, y, z]).collect()
}

fn rows_agree(pile: &Pile, rows: impl Iterator<Item = Row>) {
    let packing = packing(pile);
    let places = packing.places::<f64>();
    for row in rows {
        let single = row.clone().into_iter().map(|site| {
            let exact = packing.position(site).unwrap();
            exact.each_ref().map(nearest)
        });
        let centres = filled(&row, |slices| places.fill_row(&row, slices).unwrap());
        assert_eq!(centres, single.collect::<Vec<_>>(), "{row:?}");
        if row.k == pile.layers() - 1 {
            continue;
        }
        for direction in pile.dimension().directions() {
            let single = row.clone().into_iter().map(|site| {
                let exact = packing.contact_point(site, *direction).unwrap();
                exact.each_ref().map(nearest)
            });
            let points = filled(&row, |slices| {
                places
                    .fill_row_of_contacts(&row, *direction, slices)
                    .unwrap();
            });
            assert_eq!(points, single.collect::<Vec<_>>(), "{row:?} {direction}");
        }
    }
}

#[test]
fn centres_and_contact_points_are_correctly_rounded() {
    let hcp = Pile::under(Region::hexagon(2, 1).unwrap(), "+-+".parse().unwrap()).unwrap();
    for pile in [
        Pile::triangular(4).unwrap(),
        Pile::isosceles(4, ratio(2, 5)).unwrap(),
        Pile::discs(4).unwrap(),
        hcp,
    ] {
        rows_agree(&pile, pile.rows(Selection::All).unwrap());
    }
}

/// Coordinates that exceed every machine integer.
#[test]
fn far_from_the_axis_too() {
    let far = 10_i128.pow(25);
    for pile in [
        Pile::triangular(10 * far).unwrap(),
        Pile::isosceles(10 * far, ratio(2, 5)).unwrap(),
    ] {
        let row = |k, j| Row {
            k,
            j,
            i: far..far + 5,
        };
        rows_agree(&pile, [row(8 * far, 0), row(9 * far, far)].into_iter());
    }
}

/// Close to the axis, where neighbouring floats are distinct.
#[test]
fn of_many_digits() {
    let sin_phi = ratio(412_345_678_901_234_567, 1_000_000_000_000_000_003);
    let pile = Pile::isosceles(9, sin_phi).unwrap();
    rows_agree(&pile, pile.rows(Selection::All).unwrap());
}

/// Neighbouring layers have the same distance, for any signs of the steps.
#[test]
fn layers_are_equally_spaced() {
    for signs in ["----", "+-+-", "-++-"] {
        let pile = Pile::under(Region::SITE, signs.parse().unwrap()).unwrap();
        let packing = packing(&pile);
        let height = |site| packing.position(site).unwrap()[2].clone();
        let first = |k| pile.rows(Selection::Layer(k)).unwrap().flatten().next();
        let step = height(first(3).unwrap());
        for site in pile.shape().sites() {
            assert_eq!(
                height(site),
                step.scaled(&ratio(4 - i64::try_from(site.k).unwrap(), 1))
            );
        }
    }
}

#[test]
fn rows_outside_the_pile_are_rejected() {
    let pile = Pile::triangular(3).unwrap();
    let places = packing(&pile).places::<f64>();
    let [mut x, mut y, mut z] = [[0.0; 4]; 3];
    for i in [0..4, -1..3] {
        let row = Row { k: 2, j: 0, i };
        let refused = places.fill_row(&row, [&mut x, &mut y, &mut z]);
        assert!(matches!(refused, Err(Error::SiteOutside { .. })), "{row:?}");
    }
}

/// The contact point is the midpoint of both centres.
#[test]
fn contact_points_are_midpoints() {
    let pile = Pile::isosceles(3, ratio(1, 3)).unwrap();
    let packing = packing(&pile);
    let places = packing.places::<f64>();
    let apex = Row {
        k: 0,
        j: 0,
        i: 0..1,
    };
    for (direction, [i, j]) in Direction::ALL.into_iter().zip([[0, 0], [1, 0], [0, 1]]) {
        let point = filled(&apex, |slices| {
            places
                .fill_row_of_contacts(&apex, direction, slices)
                .unwrap();
        });
        let ends = [Site::APEX, Site { i, j, k: 1 }];
        let [from, to] = ends.map(|site| packing.position(site).unwrap().each_ref().map(nearest));
        for axis in 0..3 {
            let middle = f64::midpoint(from[axis], to[axis]);
            assert!(
                (point[0][axis] - middle).abs() < 1e-15,
                "{direction} {axis}"
            );
        }
    }
}

#[test]
fn method_returns_the_chosen_method() {
    let pile = Pile::triangular(3).unwrap();
    assert_eq!(packing(&pile).method(), None);
    for method in [Method::Closed, Method::Tree, Method::Sweep] {
        assert_eq!(
            packing(&pile).with_method(method).unwrap().method(),
            Some(method)
        );
        let forces = pile.forces::<f64>();
        assert_eq!(
            (
                forces.method(),
                forces.with_method(method).unwrap().method()
            ),
            (None, Some(method))
        );
    }
}

#[test]
fn masses_follow_the_weights() {
    let heavy = Site { i: 1, j: 0, k: 1 };
    let pile = Pile::triangular(3).unwrap();
    let pile = pile.with_weight(heavy, ratio(5, 2)).unwrap();
    let packing = packing(&pile).with_mass(ratio(3, 7)).unwrap();
    assert_eq!(packing.mass_of(heavy), Ok(ratio(15, 14)));
    assert_eq!(packing.mass_of(Site::APEX), Ok(ratio(3, 7)));
}
