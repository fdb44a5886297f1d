//! Rows of correctly rounded floats equal single queries, in pieces of any length and by any method. So do sums.

use std::ops::Range;

use cannonpile::lattice::{Direction, Region, Row, Site};
use cannonpile::scalar::{CorrectlyRounded, Surd};
use cannonpile::shape::Selection;
use cannonpile::{Counters, Error, FloorForce, Method, Packing, Pile};
use num_rational::BigRational;
use num_traits::Zero;

use super::layers::{packing_of, piles};
use cannonpile_testkit::answers::ratio;

/// Rows in pieces of `size` spheres. Every fifth piece is left out.
fn pieces(pile: &Pile, size: i128) -> impl Iterator<Item = Row> {
    let rows = pile.rows(Selection::All).expect("rows");
    let pieces: Vec<Row> = rows.flat_map(|row| row.pieces(size)).collect();
    pieces
        .into_iter()
        .enumerate()
        .filter(|(n, _)| n % 5 != 3)
        .map(|(_, row)| row)
}

fn columns<F: CorrectlyRounded + Default>(row: &Row) -> [Vec<F>; 3] {
    let spheres = row.i.clone().count();
    [(); 3].map(|()| vec![F::default(); spheres])
}

fn nearest<F: CorrectlyRounded>(exact: &Surd) -> F {
    exact.nearest().expect("a float")
}

fn rows_are_correctly_rounded<F>(packing: &Packing<'_>, size: i128)
where
    F: CorrectlyRounded + Default + PartialEq + core::fmt::Debug,
{
    let pile = packing.pile();
    let floor = pile.layers() - 1;
    let mut layers = packing.layers::<F>(Selection::All).expect("layers");
    let places = packing.places::<F>();
    for row in pieces(pile, size) {
        let mut centres = columns::<F>(&row);
        places
            .fill_row(&row, centres.each_mut().map(Vec::as_mut_slice))
            .expect("places");
        for (n, site) in row.clone().into_iter().enumerate() {
            let exact = packing.position(site).expect("a position");
            assert_eq!(
                centres.each_ref().map(|x| x[n]),
                exact.each_ref().map(nearest),
                "{site}"
            );
        }
        let mut forces = columns::<F>(&row);
        if row.k == floor {
            let slices = forces.each_mut().map(Vec::as_mut_slice);
            layers.fill_row_of_base(&row, slices).expect("a base");
            for (n, site) in row.clone().into_iter().enumerate() {
                let FloorForce {
                    normal,
                    shear_x,
                    shear_y,
                    ..
                } = packing.on_floor(site).expect("a force");
                let exact = [normal, shear_x, shear_y];
                assert_eq!(
                    forces.each_ref().map(|x| x[n]),
                    exact.each_ref().map(nearest)
                );
            }
            continue;
        }
        // The order of the queries does not matter.
        let mut vectors = [(); 3].map(|()| columns::<F>(&row));
        let slices = vectors
            .each_mut()
            .map(|of| of.each_mut().map(Vec::as_mut_slice));
        layers.fill_row_of_vectors(&row, slices).expect("vectors");
        layers
            .fill_row(&row, forces.each_mut().map(Vec::as_mut_slice))
            .expect("forces");
        for direction in pile.dimension().directions() {
            let mut points = columns::<F>(&row);
            let slices = points.each_mut().map(Vec::as_mut_slice);
            places
                .fill_row_of_contacts(&row, *direction, slices)
                .expect("points");
            for (n, site) in row.clone().into_iter().enumerate() {
                let line = direction.index();
                let exact = packing.contact(site, *direction).expect("a contact");
                assert_eq!(forces[line][n], nearest(&exact), "{site} {direction}");
                let exact = packing.contact_vector(site, *direction).expect("a contact");
                let vector = vectors.each_ref().map(|component| component[line][n]);
                assert_eq!(vector, exact.each_ref().map(nearest), "{site} {direction}");
                let exact = packing.contact_point(site, *direction).expect("a contact");
                let point = points.each_ref().map(|x| x[n]);
                assert_eq!(point, exact.each_ref().map(nearest), "{site} {direction}");
            }
        }
    }
}

/// The three components of the forces on a row take one computation of the row.
#[test]
fn vectors_visit_each_sphere_once() {
    let pile = Pile::under(Region::SITE, "+-+--+".parse().unwrap()).unwrap();
    for method in [Method::Tree, Method::Sweep] {
        let [forces, vectors] = [false, true].map(|as_vectors| {
            let counters = Counters::default();
            let exact = pile.forces::<BigRational>().with_counters(&counters);
            let layers = exact.with_method(method).unwrap().layers(Selection::All);
            let mut layers = layers.unwrap().nearest::<f64>().unwrap();
            for row in pile.rows(Selection::Layer(4)).unwrap() {
                let mut out = [(); 3].map(|()| columns::<f64>(&row));
                let [x, y, z] = out
                    .each_mut()
                    .map(|of| of.each_mut().map(Vec::as_mut_slice));
                if as_vectors {
                    layers.fill_row_of_vectors(&row, [x, y, z]).unwrap();
                } else {
                    layers.fill_row(&row, x).unwrap();
                }
            }
            counters.to_string()
        });
        assert_eq!(vectors, forces, "{method}");
    }
}

#[test]
fn rows_hold_correctly_rounded_values() {
    for (n, pile) in (1..).zip(piles()) {
        let packing = packing_of(&pile);
        rows_are_correctly_rounded::<f64>(&packing, n % 4 + 1);
        rows_are_correctly_rounded::<f32>(&packing, 1024);
    }
}

#[test]
fn rows_of_any_method_are_correctly_rounded() {
    let mut compared = 0;
    for pile in piles() {
        for method in [Method::Closed, Method::Tree, Method::Sweep] {
            if let Ok(packing) = packing_of(&pile).with_method(method) {
                rows_are_correctly_rounded::<f64>(&packing, 3);
                compared += 1;
            }
        }
    }
    assert!(compared > 40, "{compared}");
}

#[test]
fn invalid_rows_are_rejected() {
    let pile = Pile::triangular(5).expect("a pile");
    let packing = packing_of(&pile);
    let mut layers = packing.layers::<f64>(Selection::All).expect("layers");
    let mut fill = |k, j, i, n: usize| {
        let mut columns = [(); 3].map(|()| vec![0.0; n]);
        layers.fill_row(&Row { k, j, i }, columns.each_mut().map(Vec::as_mut_slice))
    };
    assert_eq!(fill(2, 0, 0..3, 3), Ok(()));
    assert_eq!(fill(2, 1, 0..2, 2), Ok(()));
    assert!(matches!(
        fill(1, 0, 0..2, 2),
        Err(Error::OtherLayer {
            layer: 1,
            at: 2,
            ..
        })
    ));
    assert!(matches!(
        fill(2, 0, 0..3, 2),
        Err(Error::Length {
            needed: 3,
            given: 2,
            ..
        })
    ));
    assert!(matches!(
        fill(2, 0, 0..4, 4),
        Err(Error::SiteOutside { .. })
    ));
    assert!(matches!(
        fill(3, -1, 0..1, 1),
        Err(Error::SiteOutside { .. })
    ));
    assert!(matches!(fill(4, 0, 0..1, 1), Err(Error::OnFloor { .. })));
    assert_eq!(fill(2, 0, 3..3, 0), Ok(()));
    let reversed = Range { start: 3, end: 1 };
    assert_eq!(fill(2, 0, reversed, 0), Ok(()));
    let endless = Row {
        k: 2,
        j: 0,
        i: i128::MIN..i128::MAX,
    };
    assert!(matches!(
        fill(2, 0, endless.i.clone(), 1),
        Err(Error::TooLarge { .. })
    ));
    let mut place = [[0.0]; 3];
    let slices = place.each_mut().map(<[f64; 1]>::as_mut_slice);
    let refused = packing.places().fill_row(&endless, slices);
    assert_eq!(
        refused.map_err(|error| error.to_string()),
        Err(format!(
            "a row would take {} numbers, more than {}: ask for pieces of it",
            u128::MAX,
            usize::MAX
        ))
    );
    let mut base = [[0.0]; 3];
    let slices = base.each_mut().map(<[f64; 1]>::as_mut_slice);
    let above = layers.fill_row_of_base(
        &Row {
            k: 3,
            j: 0,
            i: 0..1,
        },
        slices,
    );
    assert!(matches!(above, Err(Error::NotOnFloor { .. })));
}

/// With their own weight, these spheres would carry 5/3 of a unit, and the greatest float is 8/5 of it.
#[test]
fn weightless_spheres_do_not_overflow_with_their_neighbours() {
    let stacking = || "+-".parse().expect("signs");
    let light = |sites: Vec<Site>| {
        let pile = Pile::under(Region::SITE, stacking()).expect("a pile");
        sites.into_iter().fold(pile, |pile, site| {
            pile.with_weight(site, BigRational::zero())
                .expect("a weight")
        })
    };
    let ordinary = light(Vec::new());
    let heaviest: Vec<Site> = ordinary
        .forces::<BigRational>()
        .base(Selection::Base)
        .expect("a base")
        .map(|force| force.expect("a force"))
        .filter(|force| force.normal == ratio(5, 3))
        .map(|force| force.site)
        .collect();
    assert!((1..7).contains(&heaviest.len()), "{heaviest:?}");
    let second: Vec<Site> = ordinary
        .rows(Selection::Layer(1))
        .expect("rows")
        .flatten()
        .collect();
    let greatest = BigRational::from_float(f64::MAX).expect("a number") * ratio(5, 8);
    for (part, sites) in [(Selection::Base, heaviest), (Selection::Layer(1), second)] {
        let on_floor = part == Selection::Base;
        for (pile, fits) in [(&light(sites), true), (&ordinary, false)] {
            let packing = packing_of(pile);
            let unit = if on_floor {
                Surd::from(packing.sphere_weight())
            } else {
                packing.unit_force()
            };
            let unit = BigRational::from_float(nearest::<f64>(&unit)).expect("a number");
            let mass = packing.mass() * &greatest / unit;
            let packing = packing.with_mass(mass).expect("a mass");
            let packing = packing.with_method(Method::Sweep).expect("a sweep");
            let mut layers = packing.layers::<f64>(part).expect("layers");
            let mut compared = 0;
            let mut refused = false;
            for row in pile.rows(part).expect("rows") {
                let mut floats = columns::<f64>(&row);
                let slices = floats.each_mut().map(Vec::as_mut_slice);
                let filled = if on_floor {
                    layers.fill_row_of_base(&row, slices)
                } else {
                    layers.fill_row(&row, slices)
                };
                if let Err(Error::Overflow { .. }) = filled {
                    refused = true;
                    continue;
                }
                assert_eq!(filled, Ok(()));
                for (n, site) in row.into_iter().enumerate() {
                    let exact = if on_floor {
                        let force = packing.on_floor(site).expect("a force");
                        [force.normal, force.shear_x, force.shear_y]
                    } else {
                        Direction::ALL.map(|m| packing.contact(site, m).expect("a contact"))
                    };
                    let floats = floats.each_ref().map(|x| x[n].to_bits());
                    let exact = exact.each_ref().map(nearest::<f64>);
                    assert_eq!(floats, exact.map(f64::to_bits), "{site}");
                    compared += 1;
                }
            }
            assert_eq!(refused, !fits, "{part:?} {compared}");
        }
    }
}

/// A layer must not count as filled if none of its forces has a float.
#[test]
fn layers_without_a_float_are_rejected() {
    let pile = Pile::under(Region::SITE, "+-+-".parse().expect("signs")).expect("a pile");
    let packing = packing_of(&pile);
    let heavy = BigRational::from_float(1e60).expect("a number");
    let packing = packing.with_mass(heavy).expect("a mass");
    let packing = packing.with_method(Method::Sweep).expect("a sweep");
    let mut layers = packing.layers::<f32>(Selection::All).expect("layers");
    let mut refused = 0;
    while let Some(layer) = layers.next_layer().expect("a sweep within its limit") {
        let mut floats = [(); 3].map(|()| vec![0.0; layer.sphere_count()]);
        let slices = floats.each_mut().map(Vec::as_mut_slice);
        let filled = if layer.is_floor() {
            layer.fill_base(slices)
        } else {
            layer.fill(slices)
        };
        assert!(matches!(filled, Err(Error::Overflow { .. })), "{filled:?}");
        refused += 1;
    }
    assert_eq!(refused, 5);
}

#[test]
fn sums_equal_those_of_all_rows() {
    let on_floor = Site { i: 0, j: 0, k: 5 };
    let special = Pile::triangular(6).expect("a pile");
    let special = special.with_load(on_floor, ratio(7, 3)).expect("a load");
    let special = special
        .with_weight(on_floor, ratio(5, 2))
        .expect("a weight");
    for pile in piles().into_iter().chain([special]) {
        let forces = pile.forces::<BigRational>();
        let one = pile.shape().sites().last().expect("a sphere");
        let layers = (0..pile.layers()).map(Selection::Layer);
        let parts = [
            Selection::All,
            Selection::Base,
            Selection::One(Site::APEX),
            Selection::One(one),
        ];
        for part in parts.into_iter().chain(layers) {
            let Ok(contacts) = forces.contacts(part) else {
                // The apex of a pile on a base may lie elsewhere.
                assert!(forces.sum_of_contacts(part).is_err());
                continue;
            };
            let sum = contacts
                .map(|contact| contact.expect("a force").force)
                .sum();
            assert_eq!(forces.sum_of_contacts(part), Ok(sum), "{pile:?} {part:?}");
            let Ok(base) = forces.base(part) else {
                assert!(forces.sum_on_floor(part).is_err());
                continue;
            };
            let mut sums = [(); 3].map(|()| BigRational::zero());
            for force in base {
                let force = force.expect("a force");
                for (sum, x) in sums
                    .iter_mut()
                    .zip([force.normal, force.shear_x, force.shear_y])
                {
                    *sum += x;
                }
            }
            assert_eq!(forces.sum_on_floor(part), Ok(sums), "{pile:?} {part:?}");
        }
    }
}

#[test]
fn sums_of_huge_piles() {
    let pile = Pile::triangular(10_i128.pow(36)).expect("a pile");
    let forces = pile.forces::<BigRational>();
    let refused = forces.sum_of_contacts(Selection::All);
    assert!(
        matches!(refused, Err(Error::TooLarge { .. })),
        "{refused:?}"
    );
    // All spheres above.
    let layer = forces
        .sum_of_contacts(Selection::Layer(10_i128.pow(30)))
        .expect("a sum");
    let spheres = pile.shape().before(Site {
        i: 0,
        j: 0,
        k: 10_i128.pow(30) + 1,
    });
    assert_eq!(
        layer,
        BigRational::from_integer((spheres.expect("a sphere") * 3_u32).into())
    );
    let [normal, x, y] = forces.sum_on_floor(Selection::Base).expect("sums");
    assert_eq!(
        (normal, x, y),
        (pile.weight(), BigRational::zero(), BigRational::zero())
    );
}

/// Subnormal forces, and zeros.
#[test]
fn subnormal_results_are_reported() {
    let pile = Pile::triangular(4).expect("a pile");
    let layers = |exponent: i32| {
        let mass = num_traits::pow(ratio(1, 10), exponent.unsigned_abs() as usize);
        let packing = packing_of(&pile).with_mass(mass).expect("a mass");
        let double = packing
            .layers::<f64>(Selection::All)
            .expect("layers")
            .keeps_digits();
        (
            double,
            packing
                .layers::<f32>(Selection::All)
                .expect("layers")
                .keeps_digits(),
        )
    };
    assert_eq!(layers(0), (true, true));
    assert_eq!(layers(-36), (true, true));
    assert_eq!(layers(-39), (true, false));
    assert_eq!(layers(-306), (true, false));
    assert_eq!(layers(-309), (false, false));
}

/// In `f32` the unit 3^−78 is normal, and the unit 3^−80 is subnormal.
#[test]
fn a_normal_unit_keeps_all_digits() {
    let pile = Pile::under(Region::SITE, "+-".repeat(41).parse().unwrap()).unwrap();
    let keeps_digits = |k| {
        let layers = pile.forces::<BigRational>().layers(Selection::Layer(k));
        let layers = layers.unwrap().nearest::<f32>().unwrap();
        layers.keeps_digits()
    };
    assert_eq!([78, 80].map(keeps_digits), [true, false]);
}
