//! Certificates of all forces of a pile.

use cannonpile::lattice::{Region, Site};
use cannonpile::{Load, Pile};
use cannonpile_horizontal::certificate::{
    AllForces, Certificate, Claim, Condition, read_certificate, write_certificate,
};
use cannonpile_horizontal::elastic;
use num_rational::BigRational;
use num_traits::Zero;

use super::python::agreed;
use super::{at, violated};
use cannonpile_testkit::answers::ratio;

fn piles() -> Vec<Pile> {
    let third = ratio(1, 3);
    let load = Load {
        down: ratio(7, 2),
        x: ratio(1, 5),
        y: ratio(0, 1),
    };
    let isosceles = Pile::isosceles(4, third).unwrap();
    vec![
        Pile::triangular(5).unwrap(),
        Pile::triangular(1).unwrap(),
        Pile::under(Region::SITE, "-".parse().unwrap()).unwrap(),
        Pile::under(Region::SITE, "+-+-+".parse().unwrap()).unwrap(),
        Pile::on(Region::hexagon(4, 3).unwrap(), "+-".parse().unwrap()).unwrap(),
        isosceles
            .with_tilt([ratio(1, 7), ratio(1, 9)])
            .unwrap()
            .with_load(Site::APEX, load.clone())
            .unwrap(),
        Pile::discs(5).unwrap().with_load(Site::APEX, load).unwrap(),
    ]
}

fn forces(certificate: &mut Certificate) -> &mut AllForces {
    match &mut certificate.claim {
        Claim::Forces(forces) => forces,
        claim => panic!("{claim}"),
    }
}

/// Calls `f` with the certificate after each change of a single number.
fn each_changed(certificate: &Certificate, f: impl Fn(Certificate)) {
    let given = forces(&mut certificate.clone()).clone();
    for change in [ratio(1, 1), ratio(-1, 1_000_000)] {
        for site in given.contacts.keys() {
            for l in 0..3 {
                let mut changed = certificate.clone();
                forces(&mut changed).contacts.get_mut(site).unwrap()[l] += &change;
                f(changed);
            }
        }
        for n in 0..given.floor.len() {
            for l in 0..3 {
                let mut changed = certificate.clone();
                let force = &mut forces(&mut changed).floor[n];
                *[&mut force.normal, &mut force.shear_x, &mut force.shear_y][l] += &change;
                f(changed);
            }
        }
    }
}

#[test]
fn exact_forces_are_accepted_and_every_changed_number_is_refused() {
    for pile in piles() {
        let certificate = Certificate::of_forces(&pile).unwrap();
        assert!(agreed(&certificate), "{pile:?}");
        each_changed(&certificate, |changed| {
            assert_eq!(violated(&changed).0, Condition::Force);
            assert!(!agreed(&changed));
        });
        let mut text = Vec::new();
        write_certificate(&certificate, &mut text).unwrap();
        assert_eq!(read_certificate(&*text).unwrap(), certificate);
    }
}

#[test]
fn floats_are_accepted_within_their_error_and_not_within_less() {
    for pile in piles() {
        let rounded = Certificate::of_forces(&pile).unwrap().rounded().unwrap();
        assert!(agreed(&rounded), "{pile:?}");
        let mut less = rounded.clone();
        let within = &mut forces(&mut less).within;
        if !within.is_zero() {
            assert!(*within < ratio(1, 1 << 50));
            *within *= ratio(99, 100);
            assert!(!agreed(&less), "{pile:?}");
        }
    }
}

/// Returns the refusal of both checkers.
fn refused(certificate: &Certificate) -> String {
    assert!(!agreed(certificate));
    certificate.check().unwrap_err().to_string()
}

#[test]
fn each_sphere_occurs_once() {
    let whole = Certificate::of_forces(&Pile::triangular(3).unwrap()).unwrap();
    let mut one = whole.clone();
    forces(&mut one).contacts.remove(&at(1, 0, 1));
    assert_eq!(
        refused(&one),
        "the forces of the sphere (1,0,1) are missing"
    );

    let mut one = whole.clone();
    forces(&mut one)
        .contacts
        .insert(at(5, 5, 1), Default::default());
    assert_eq!(refused(&one), "there is no sphere (5,5,1) above the floor");

    let mut one = whole.clone();
    let last = forces(&mut one).floor.pop().unwrap();
    assert_eq!(
        refused(&one),
        "the forces of the sphere (0,2,2) are missing"
    );

    let mut one = whole.clone();
    let elsewhere = cannonpile::FloorForce {
        site: at(9, 9, 2),
        ..last
    };
    forces(&mut one).floor.push(elsewhere);
    assert_eq!(refused(&one), "there is no sphere (9,9,2) on the floor");

    let mut one = whole.clone();
    let first = forces(&mut one).floor[0].clone();
    forces(&mut one).floor.push(first);
    let mut text = Vec::new();
    write_certificate(&one, &mut text).unwrap();
    let error = read_certificate(&*text).unwrap_err().to_string();
    let expected = "two forces of the sphere (0,0,2) on the floor: leave one of them out";
    assert!(error.starts_with(expected), "{error}");
}

#[test]
fn a_wrong_sign_is_refused() {
    for pile in piles() {
        let mut certificate = Certificate::of_forces(&pile).unwrap();
        forces(&mut certificate).compressive ^= true;
        let refusal = refused(&certificate);
        assert!(refusal.contains("is tensile"), "{refusal}");
    }
}

/// With horizontal forces the other forces are those of the elastic state.
#[test]
fn forces_with_horizontal_contacts() {
    let pile = Pile::under(Region::SITE, "+-+-+".parse().unwrap()).unwrap();
    let state = elastic(&pile, &ratio(1, 1)).unwrap();
    let mut certificate = Certificate::of_forces(state.pile()).unwrap();
    certificate.horizontal = state.certificate().unwrap().horizontal.clone();
    certificate.pile = pile;
    assert!(forces(&mut certificate).compressive);
    assert!(agreed(&certificate));
    let force = certificate.horizontal.values_mut().next().unwrap();
    *force += BigRational::from_integer(1.into());
    assert!(!agreed(&certificate));
}
